#!/usr/bin/env python3
"""Draws the figures of docs/concepts.md as SVG: python3 docs/figures/concepts.py (writes beside this file)."""

import math
from pathlib import Path

from drawing import BLUE, GREEN, GREY, INK, LIGHT, RED, Drawing

FOLDER = Path(__file__).parent


def seen_from_above(origin, scale):
    """Object coordinates (x, z) to px, z down: towards the viewer of the page."""
    return lambda x, z: (origin[0] + scale * x, origin[1] + scale * z)


def object_outline(at):
    """A shape that is not round, so that depth matters: farthest point at radius 1."""
    points = []
    for i in range(72):
        angle = 2 * math.pi * i / 72
        r = 0.72 + 0.2 * math.cos(2 * angle + 0.6) + 0.08 * math.cos(5 * angle)
        points.append(at(r * math.sin(angle), r * math.cos(angle)))
    return points


PLANES, RADIUS = 12, 3.5  # reference planes; distance of the cameras


def draw_reference_planes():
    d = Drawing(860, 330)
    # Left: planes, seen from above.
    at = seen_from_above((150, 165), 105)
    d.text((150, 22), "reference planes from above", weight="bold")
    d.text((150, 302), "12 planes: 6 through the axis,\neach seen from both sides", GREY, size=11)
    d.polygon(object_outline(at), "#eee", GREY)
    for k in range(PLANES):
        t = 2 * math.pi * k / PLANES
        tx, tz = math.cos(t), -math.sin(t)
        d.line(at(-tx, -tz), at(tx, tz), BLUE if k in (0, 6) else LIGHT, 2.2 if k in (0, 6) else 1.2)
    d.line(at(0, 0), at(0, 0.62), BLUE, 1.6, arrow=True)
    d.text(at(0.13, 0.66), "n", BLUE)
    d.text(at(1.0, -0.08), "plane 0", BLUE)
    d.circle(at(0, 0), 3.5, INK)
    d.text(at(-0.12, -0.1), "axis", INK)
    # Middle: rays of one viewpoint meet plane 0.
    at = seen_from_above((430, 95), 56)
    d.text((430, 22), "rays of one viewpoint V", weight="bold")
    d.polygon(object_outline(at), "#eee", GREY)
    d.line(at(-1.5, 0), at(1.5, 0), BLUE, 2.2)
    d.text(at(1.5, -0.15), "x", BLUE)
    a, c = RADIUS * math.sin(math.radians(8)), RADIUS * math.cos(math.radians(8))
    viewpoint = at(a, c)
    for x in (-0.8, -0.15, 0.5):
        d.line(viewpoint, at(x, 0), RED, 1.2, arrow=True)
        d.circle(at(x, 0), 3, RED, RED)
    d.line(at(-0.8, 0), at(-0.8, 2.9), GREY, 1, "4 3")
    d.text(at(-0.9, 3.2), "u: tangent of the angle\nbetween ray and normal", GREY, "middle", 12)
    d.camera(viewpoint, at(0, 0), RED)
    d.text((viewpoint[0] + 14, viewpoint[1] + 6), "V = (a, c)", RED, "start")
    # Right: ray space.
    left, top, w, h = 600, 45, 235, 235
    d.text((left + w / 2, 22), "the same rays as points (x, u)", weight="bold")
    limit = math.tan(math.pi / PLANES) * 1.25
    to_px = lambda x, u: (left + w * (x + 1.2) / 2.4, top + h * (limit - u) / (2 * limit))
    d.box(left, top, w, h, "#fff")
    d.line(to_px(-1.2, 0), to_px(1.2, 0), LIGHT)
    d.line(to_px(0, -limit), to_px(0, limit), LIGHT)

    def view_line(a, c, colour, width):
        ends = []
        for u in [i * limit / 200 for i in range(-200, 201)]:
            if abs(a + u * c) <= 1.2:
                ends.append(to_px(a + u * c, u))
        if len(ends) > 1:
            d.line(ends[0], ends[-1], colour, width)

    for step in range(-3, 4):
        phi = math.radians(10 * step)
        view_line(RADIUS * math.sin(phi), RADIUS * math.cos(phi), GREY, 1.2)
    nearer = 2.6
    phi = math.radians(4)
    view_line(nearer * math.sin(phi), nearer * math.cos(phi), RED, 2)
    x = 0.35
    u = (x - nearer * math.sin(phi)) / (nearer * math.cos(phi))
    d.circle(to_px(x, u), 4.5, RED, RED)
    d.text((to_px(x, u)[0] + 8, to_px(x, u)[1] + 15), "one ray", RED, "start")
    d.text((left + w / 2, top + h + 20), "x: where it meets the plane")
    d.text((left - 14, top + h / 2 + 4), "u")
    d.text((left + w / 2, top + h + 38), "grey: photos 10 degrees apart; red: new viewpoint", GREY, size=11)
    d.write("concepts-planes.svg", FOLDER)


def draw_shape_map():
    d = Drawing(860, 390)
    for panel, (title, mode) in enumerate((("one depth: the reference plane", "plane"), ("a depth per cell: the shape map", "shape"))):
        at = seen_from_above((215 + 430 * panel, 130), 80)
        d.text((215 + 430 * panel, 22), title, weight="bold")
        d.polygon(object_outline(at), "#eee", GREY)
        d.circle(at(0, 0), 3, INK)
        views = {}
        for name, degrees, colour in (("A", -13, BLUE), ("B", 13, GREEN), ("V", 3, RED)):
            r = 2.5
            views[name] = (r * math.sin(math.radians(degrees)), r * math.cos(math.radians(degrees)), colour)
        ax, az, _ = views["V"]
        goal = (-0.42, 0.0)  # where the ray meets the plane
        dx, dz = goal[0] - ax, goal[1] - az
        # The surface that the ray meets first.
        inside = lambda x, z: math.hypot(x, z) < 0.72 + 0.2 * math.cos(2 * math.atan2(x, z) + 0.6) + 0.08 * math.cos(5 * math.atan2(x, z))
        f = next(i / 1000 for i in range(1000) if inside(ax + i / 1000 * dx, az + i / 1000 * dz))
        surface = (ax + f * dx, az + f * dz)
        d.line(at(-1.2, 0), at(1.2, 0), BLUE if mode == "plane" else LIGHT, 2 if mode == "plane" else 1.2)
        point = goal if mode == "plane" else surface
        d.line(at(ax, az), at(*point), RED, 1.6)
        for name in ("A", "B"):
            x, z, colour = views[name]
            d.line(at(x, z), at(*point), colour, 1.3, "5 3" if mode == "plane" else None)
            if mode == "plane":  # what this photo shows there instead
                vx, vz = point[0] - x, point[1] - z
                g = next(i / 1000 for i in range(1000) if inside(x + i / 1000 * vx, z + i / 1000 * vz))
                d.circle(at(x + g * vx, z + g * vz), 4, colour, colour)
        if mode == "plane":
            d.circle(at(*point), 4, RED, RED)
            d.text(at(-1.2, -0.15), "plane", BLUE)
            d.text((215, 378), "A and B show different points: the view jumps between photos.", INK, size=12)
        else:
            # The foot: the ray's closest point to the axis; depth is counted from it.
            length = dx * dx + dz * dz
            s = -(ax * dx + az * dz) / length
            foot = (ax + s * dx, az + s * dz)
            d.line(at(*surface), at(*foot), RED, 1.2, "2 3")
            d.circle(at(*foot), 3.2, "#fff", RED)
            d.line(at(0, 0), at(*foot), GREY, 1, "3 3")
            d.text((at(*foot)[0] + 14, at(*foot)[1] - 7), "p", GREY)
            d.text((at(*foot)[0] - 4, at(*foot)[1] + 32), "d", RED, "end")
            d.circle(at(*surface), 4.5, RED, RED)
            d.text((645, 378), "A and B are sampled at the same surface point.", INK, size=12)
        for name, (x, z, colour) in views.items():
            d.camera(at(x, z), at(0, 0), colour)
            d.text((at(x, z)[0], at(x, z)[1] + 22), {"A": "photo A", "B": "photo B", "V": "new view"}[name], colour, size=12,
                   anchor={"A": "end", "B": "start", "V": "middle"}[name])
    d.write("concepts-shape-map.svg", FOLDER)


def draw_pixel():
    d = Drawing(860, 150)
    steps = [("pixel", "ray of the\nnew view"), ("plane", "plane k,\npoint (x, u)"), ("RS map", "gap of two photos\nA, B; weight w"),
             ("shape map", "depth d and\nvisibility"), ("samples", "pixel of A,\npixel of B"), ("blend", "color, alpha,\ndepth")]
    width, gap = 118, 26
    for i, (title, text) in enumerate(steps):
        x = 12 + i * (width + gap)
        d.box(x, 40, width, 74, "#f4f6f8" if i not in (2, 3) else "#e7f0f9")
        d.text((x + width / 2, 60), title, weight="bold")
        d.text((x + width / 2, 81), text, size=12)
        if i:
            d.line((x - gap + 3, 77), (x - 3, 77), INK, 1.4, arrow=True)
    d.text((430, 24), "one pixel: two look-ups (blue), two fetches, one blend; integers only", GREY)
    d.text((430, 138), "made once by rs-encode: RS map, shape map, compressed photos", GREY, size=12)
    d.write("concepts-pixel.svg", FOLDER)


draw_reference_planes()
draw_shape_map()
draw_pixel()
