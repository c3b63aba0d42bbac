#!/usr/bin/env python3
"""Draws the masks of eye_masks.json: objects in real turntable photos, without floor shadow and mirror image.

eye_masks.py -o OUT [--photos DIR]

Writes OUT/SET/IMAGE.png (grey, 0 or 255). With --photos, which holds a folder for each set, it also writes
OUT/SET/IMAGE_overlay.png: the photo with the contour in green, enlarged. Needs python3-opencv.
"""
import argparse
import json
import sys
from pathlib import Path

import cv2
import numpy as np

MASKS = Path(__file__).with_name("eye_masks.json")


def load_masks(file=MASKS):
    return json.loads(file.read_text())["masks"]


def draw_mask(entry):
    """Binary mask (uint8, 0 or 255) in the photo's size. Outer polygons first, then holes."""
    mask = np.zeros((entry["height"], entry["width"]), np.uint8)
    for polygon in sorted(entry["polygons"], key=lambda p: p["hole"]):
        points = np.rint(np.array(polygon["points"]) * 16).astype(np.int32)  # 4 fractional bits
        cv2.fillPoly(mask, [points], 0 if polygon["hole"] else 255, shift=4)
    return mask


def draw_overlay(photo, entry, scale=2):
    overlay = cv2.resize(photo, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC)
    for polygon in entry["polygons"]:
        points = (np.array(polygon["points"]) + 0.5) * scale - 0.5
        cv2.polylines(overlay, [np.rint(points).astype(np.int32)], True, (0, 255, 0))
    return overlay


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT", help="folder for the masks")
    parser.add_argument("--photos", type=Path, metavar="DIR", help="folder with SET/IMAGE; adds overlays")
    args = parser.parse_args()
    for entry in load_masks():
        folder = args.output / entry["set"]
        folder.mkdir(parents=True, exist_ok=True)
        stem = Path(entry["image"]).stem
        cv2.imwrite(str(folder / f"{stem}.png"), draw_mask(entry))
        if args.photos:
            file = args.photos / entry["set"] / entry["image"]
            photo = cv2.imread(str(file))
            if photo is None:
                sys.exit(f"{file}: cannot be read; give --photos the folder that holds {entry['set']}")
            cv2.imwrite(str(folder / f"{stem}_overlay.png"), draw_overlay(photo, entry))


if __name__ == "__main__":
    main()
