#!/usr/bin/env python3
"""Writes the overview page of workflow/Snakefile: a row for each object with its contact sheet, size and scores.

    page.py OUTPUT.html NAME...

Beside OUTPUT.html are objects/NAME.rso, sheets/NAME.png, reports/NAME.html and reports/NAME.json (of rs-encode evaluate).
"""
import json
import os
import sys
from html import escape
from pathlib import Path
from urllib.parse import quote

HEAD = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Objects</title>
<style>body{font:15px sans-serif;margin:2em}td,th{padding:.3em .8em;border-bottom:1px solid #ccc;text-align:left}
img{max-width:30em;max-height:16em}</style>
<h1>Objects</h1>
<table><tr><th>object<th>views<th>file<th>scores on views held out<th>
"""


def row(root, name):
    size = (root / "objects" / f"{name}.rso").stat().st_size
    scores = json.loads((root / "reports" / f"{name}.json").read_text())
    views = len(scores["views_kept"]) + len(scores["views_held_out"])
    means = "<br>".join(f"{escape(m['method'])}: {m['mean_psnr_db']:.2f} dB, SSIM {m['mean_ssim']:.4f}"
                        for m in scores["methods"])
    at = quote(name)
    return (f'<tr><td>{escape(name)}<td>{views}<td><a href="objects/{at}.rso">{size / 1e6:.2f} MB</a>'
            f'<td>{means}<br><a href="reports/{at}.html">report</a>'
            f'<td><img src="sheets/{at}.png" alt="views of {escape(name)}" loading="lazy">\n')


def main():
    output = Path(sys.argv[1])
    text = HEAD + "".join(row(output.parent, name) for name in sys.argv[2:]) + "</table>\n</html>\n"
    temporary = output.with_name(f".{output.name}.partial")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, output)


if __name__ == "__main__":
    main()
