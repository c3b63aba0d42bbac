"""Minimal SVG drawing for the figures of docs/."""

import math

INK, GREY, LIGHT, BLUE, RED, GREEN = "#222", "#888", "#ddd", "#1f6fb4", "#c8402a", "#2b8a3e"


class Drawing:
    """An SVG with y up inside panels; text in 13 px sans-serif."""

    def __init__(self, width, height):
        self.size = (width, height)
        self.parts = [f'<rect width="{width}" height="{height}" fill="#fff"/>']

    def line(self, a, b, colour=INK, width=1.2, dash=None, arrow=False):
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        extra += f' marker-end="url(#arrow-{colour[1:]})"' if arrow else ""
        self.parts.append(f'<path d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}" stroke="{colour}" stroke-width="{width}" fill="none"{extra}/>')

    def circle(self, c, r, fill="none", stroke=INK, width=1.2, dash=None):
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<circle cx="{c[0]:.1f}" cy="{c[1]:.1f}" r="{r:.1f}" fill="{fill}" stroke="{stroke}" stroke-width="{width}"{extra}/>')

    def polygon(self, points, fill, stroke="none", width=1.2):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.parts.append(f'<polygon points="{text}" fill="{fill}" stroke="{stroke}" stroke-width="{width}"/>')

    def box(self, x, y, w, h, fill="#f4f6f8", stroke=GREY):
        self.parts.append(f'<rect x="{x}" y="{y}" width="{w}" height="{h}" rx="5" fill="{fill}" stroke="{stroke}"/>')

    def text(self, at, words, colour=INK, anchor="middle", size=13, weight="normal"):
        for i, words_of_line in enumerate(words.split("\n")):
            escaped = words_of_line.replace("&", "&amp;").replace("<", "&lt;")
            self.parts.append(f'<text x="{at[0]:.1f}" y="{at[1] + i * (size + 3):.1f}" fill="{colour}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}">{escaped}</text>')

    def camera(self, at, towards, colour):
        """A small triangle that points from `at` to `towards` (both in px)."""
        angle = math.atan2(towards[1] - at[1], towards[0] - at[0])
        corner = lambda turn, r: (at[0] + r * math.cos(angle + turn), at[1] + r * math.sin(angle + turn))
        self.polygon([corner(0, 9), corner(2.3, 8), corner(-2.3, 8)], colour)

    def write(self, name, folder):
        markers = "".join(
            f'<marker id="arrow-{c[1:]}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z" fill="{c}"/></marker>'
            for c in (INK, GREY, BLUE, RED, GREEN))
        w, h = self.size
        (folder / name).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" font-family="Helvetica, Arial, sans-serif">'
            f"<defs>{markers}</defs>\n" + "\n".join(self.parts) + "\n</svg>\n")
