#!/usr/bin/env python3
"""Compares rendered views with photos that the object was not built from, and prints PSNR and SSIM.

    compare_with_photos.py SET                       holds out every 2nd photo of a capture set and builds from the others
    compare_with_photos.py SET --object OBJECT.rso   compares an existing object with the photos of another set
"""

import argparse
import sys

import rayspace

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("set", help="capture set: a folder with a transforms.json and RGBA photos")
parser.add_argument("--object", help="an object, .rso, in the units of the set")
parser.add_argument("--every", type=int, default=2, help="of each N neighbouring photos one is held out (default 2)")
parser.add_argument("--filter", choices=["auto", "sharp", "bilinear", "smooth"], default="auto",
                    help="with --object: sampling of the photos")
arguments = parser.parse_args()
if not arguments.object and arguments.filter != "auto":
    parser.error("--filter needs --object")

try:
    if arguments.object:
        renderer = rayspace.Renderer.create(rayspace.Object.open(arguments.object))
        scores = rayspace.compare_with_photos(renderer, arguments.set,
                                              filter=rayspace.Filter.__members__[arguments.filter.upper()])
    else:
        scores = rayspace.evaluate_held_out(arguments.set, every=arguments.every)
except rayspace.Error as error:
    sys.exit(f"compare_with_photos.py: {error}")
for view in scores.views:
    print(f"{view.photo:24} {view.score.psnr_db:6.2f} dB  SSIM {view.score.ssim:.4f}")
print(f"{'mean':24} {scores.mean_psnr_db:6.2f} dB  SSIM {scores.mean_ssim:.4f}")
