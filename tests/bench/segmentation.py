#!/usr/bin/env python3
"""Measures the segmentation of `rs-capture import` against known alpha.

segmentation.py SET ... [--rs-capture RS_CAPTURE] [--args "..."] [--eye-photos DIR] [--json]

A SET is a folder with photos/ and alpha/ (grey, 255 = object, the same order), as written by segmentation_sets.py.
Each set is imported with `--calibration nominal`, so that images are aligned with the photos. With --eye-photos, the
parent of the folders of real sets (DIR/boot36/img01.jpg ...), the sets of eye_masks.json are imported too, and
compared in the views that have a mask. Means over the views of a set, per cent where stated:

  iou      intersection over union of alpha > 0.5 and true alpha > 0.5
  mae      mean absolute error of alpha over the image, x 1000
  band     mean absolute error of alpha within 2.5 px of the true contour (a mask by eye is accurate to 1.5 px only)
  signed   mean signed error in the same band: negative if the mask is too small, positive if it is too large
  missing  pixels of the object with alpha <= 0.5, % of the object's area
  added    pixels outside the object with alpha > 0.5, % of the object's area
  floor    added pixels more than 2 px from the object and below its middle row: remaining floor
  worst    lowest IoU of a view

A view whose image is missing, and each view of an import that fails, counts as empty (IoU 0).
Needs python3-opencv. Example:

  segmentation_sets.py --data DATA -o sets
  segmentation.py sets/* --rs-capture build/bin/rs-capture --args "--backdrop white"
"""
import argparse
import json
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np

import eye_masks

BAND_PX = 2.5
FIELDS = ["iou", "mae", "band", "signed", "missing", "added", "floor"]
IMAGES = {".jpg", ".jpeg", ".png"}


def natural_order(folder):
    """Image files of a folder, sorted as rs-capture does: 2.png before 10.png."""
    files = [file for file in folder.iterdir() if file.suffix.lower() in IMAGES]
    return sorted(files, key=lambda file: (len(file.stem), file.stem))


def contour_distance(inside):
    """Distance of every pixel's centre to the contour of a binary mask, px."""
    mask = inside.astype(np.uint8)
    return (cv2.distanceTransform(mask, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
            + cv2.distanceTransform(1 - mask, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) - 0.5)


def compare(alpha, truth):
    """Measures of one view; both images are float, 0..1, of one size."""
    object_found, object_true = alpha > 0.5, truth > 0.5
    area = max(1, np.count_nonzero(object_true))
    union = np.count_nonzero(object_found | object_true)
    error = alpha - truth
    band = contour_distance(object_true) <= BAND_PX
    far_outside = cv2.dilate(object_true.astype(np.uint8), cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (5, 5))) == 0
    rows = np.flatnonzero(object_true.any(axis=1))
    middle = (rows[0] + rows[-1]) // 2 if rows.size else 0
    below = np.arange(truth.shape[0])[:, None] > middle
    return {
        "iou": np.count_nonzero(object_found & object_true) / max(1, union),
        "mae": 1000 * float(np.abs(error).mean()),
        "band": float(np.abs(error[band]).mean()) if band.any() else 0.0,
        "signed": float(error[band].mean()) if band.any() else 0.0,
        "missing": 100 * np.count_nonzero(object_true & ~object_found) / area,
        "added": 100 * np.count_nonzero(object_found & ~object_true) / area,
        "floor": 100 * np.count_nonzero(object_found & far_outside & below) / area,
    }


def draw_error(image, truth):
    """The image over magenta, and beside it the error: red where alpha is too small, blue where it is too large."""
    alpha = image[:, :, 3:] / 255.0
    over = image[:, :, :3] * alpha + (1 - alpha) * np.array([255, 0, 255])
    error = alpha[:, :, 0] - truth
    grey = 255 - image[:, :, :3].mean(axis=2) / 4
    faded = grey * (1 - np.abs(error))
    errors = np.dstack([np.where(error > 0, grey, faded), faded, np.where(error < 0, grey, faded)])
    return np.hstack([over, errors]).astype(np.uint8)


def import_photos(args, photos, folder):
    """Imports photos. Returns the images in order, and an error text or None."""
    command = [args.rs_capture, "import", str(photos), "-o", str(folder), "--calibration", "nominal", "-q",
               *shlex.split(args.args)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=args.timeout)
    except subprocess.TimeoutExpired:
        return [], f"no result after {args.timeout} s"
    if run.returncode != 0:
        return [], (run.stderr.strip() or f"exit status {run.returncode}").splitlines()[-1]
    frames = json.loads((folder / "transforms.json").read_text())["frames"]
    files = []
    for frame in frames:
        file = folder / frame["file_path"]
        files.append(file if file.suffix else file.with_suffix(".png"))
    return files, None


def read_bgra(file, shape):
    """Imported image; None where it is missing or has another size."""
    image = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
    if image is None or image.ndim != 3 or image.shape[2] != 4 or image.shape[:2] != shape:
        return None
    return image


def measure(args, name, photos, truths):
    """truths: position of a photo in the set -> true alpha, 0..1. Returns a row of the table."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(args.keep) / name if args.keep else Path(temporary) / "set"
        files, error = import_photos(args, photos, folder)
        views = []
        for position, truth in truths.items():
            image = read_bgra(files[position], truth.shape) if position < len(files) else None
            if image is None:
                error = error or f"view {position} has no image of {truth.shape[1]}x{truth.shape[0]} with alpha"
                image = np.zeros((*truth.shape, 4), np.uint8)
            views.append(compare(image[:, :, 3].astype(np.float32) / 255, truth))
            if args.pictures:
                args.pictures.mkdir(parents=True, exist_ok=True)
                cv2.imwrite(str(args.pictures / f"{name}-{position:03d}.png"), draw_error(image, truth))
    row = {"set": name, "views": len(views)}
    row.update({field: float(np.mean([view[field] for view in views])) for field in FIELDS})
    row["worst"] = min(view["iou"] for view in views)
    if error:
        row["error"] = error
    return row


def measure_set(args, folder):
    truths = {}
    for position, file in enumerate(natural_order(folder / "alpha")):
        truths[position] = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE).astype(np.float32) / 255
    return measure(args, folder.name, folder / "photos", truths)


def measure_eye_sets(args):
    sets = {}
    for entry in eye_masks.load_masks():
        sets.setdefault(entry["set"], []).append(entry)
    for name, entries in sets.items():
        if not (args.eye_photos / name).is_dir():
            continue
        order = [file.name for file in natural_order(args.eye_photos / name)]
        truths = {order.index(entry["image"]): eye_masks.draw_mask(entry).astype(np.float32) / 255 for entry in entries}
        yield measure(args, name, args.eye_photos / name, truths)


def measure_all(args):
    for folder in args.sets:
        yield measure_set(args, folder)
    if args.eye_photos:
        yield from measure_eye_sets(args)


def table_line(row):
    if row is None:
        return (f"{'set':<14}{'views':>6}{'iou':>8}{'worst':>8}{'mae':>8}{'band':>8}"
                f"{'signed':>8}{'missing':>9}{'added':>8}{'floor':>8}")
    line = (f"{row['set']:<14}{row['views']:>6}{row['iou']:>8.4f}{row['worst']:>8.4f}{row['mae']:>8.2f}{row['band']:>8.3f}"
            f"{row['signed']:>8.3f}{row['missing']:>9.2f}{row['added']:>8.2f}{row['floor']:>8.2f}")
    return line + (f"  {row['error']}" if "error" in row else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="*", type=Path, metavar="SET", help="folders with photos/ and alpha/")
    parser.add_argument("--rs-capture", default="rs-capture", help="program to measure (default: %(default)s)")
    parser.add_argument("--args", default="", help="more options for rs-capture import, in one string")
    parser.add_argument("--eye-photos", type=Path, metavar="DIR", help="folder of the real sets in eye_masks.json")
    parser.add_argument("--keep", metavar="DIR", help="folder for the imported sets (default: deleted)")
    parser.add_argument("--pictures", type=Path, metavar="DIR",
                        help="write each view over magenta beside its error (red: too little alpha, blue: too much)")
    parser.add_argument("--timeout", type=float, default=1800, metavar="S", help="limit per import (default: %(default)s)")
    parser.add_argument("--json", action="store_true", help="rows as JSON on stdout, in place of the table")
    args = parser.parse_args()
    if not args.sets and not args.eye_photos:
        parser.error("nothing to measure; give a SET or --eye-photos")
    for folder in args.sets:
        if not (folder / "photos").is_dir() or not (folder / "alpha").is_dir():
            parser.error(f"{folder}: has no photos/ and alpha/; make it with segmentation_sets.py")

    rows = []
    if not args.json:
        print(table_line(None), flush=True)
    for row in measure_all(args):
        rows.append(row)
        if not args.json:
            print(table_line(row), flush=True)
    if args.json:
        json.dump(rows, sys.stdout, indent=2)
        print()


if __name__ == "__main__":
    main()
