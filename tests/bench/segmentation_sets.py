#!/usr/bin/env python3
"""Makes photo sets of turntables with known alpha, for segmentation.py.

segmentation_sets.py --data DATA --rs-capture RS_CAPTURE -o OUT [SET ...]

Each set is a folder with photos/NNN.jpg and alpha/NNN.png in the same order (grey, 255 = object). Two sources:

car-*   RGBA photos of a car (DATA/turntable/car52), every third view, in front of a synthetic studio or a static
        panorama.
        The car's alpha includes a soft floor shadow. The shadow is composited, but it is not part of the true alpha
        (see body_alpha).
others  views traced by `rs-capture synth --as-photos`. The tracer writes the true alpha.

JPEG quality is 92, sensor noise 1.2 codes unless stated. DATA/hdr holds interior.exr and courtyard.exr.
Needs python3-opencv with OpenEXR.
"""
import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
import cv2  # noqa: E402  (reads the variable when it is loaded)
import numpy as np  # noqa: E402

REPOSITORY = Path(__file__).resolve().parents[2]
JPEG_QUALITY = 92
NOISE_CODES = 1.2


def panorama_view(file, width, height, yaw_deg, pitch_deg, fov_deg, exposure):
    """Perspective view of an equirectangular HDR panorama, tone-mapped to 8-bit sRGB (BGR)."""
    hdr = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
    if hdr is None:
        sys.exit(f"{file}: cannot be read; give --data a folder with hdr/{file.name}")
    hdr = hdr[:, :, :3].clip(0, 1e4)
    f_px = width / 2 / np.tan(np.radians(fov_deg) / 2)
    x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2, np.arange(height) + 0.5 - height / 2)
    pitch = np.radians(pitch_deg)
    up = -y * np.cos(pitch) + f_px * np.sin(pitch)
    ahead = y * np.sin(pitch) + f_px * np.cos(pitch)
    azimuth = np.arctan2(x, ahead) + np.radians(yaw_deg)
    elevation = np.arctan2(up, np.hypot(x, ahead))
    map_x = (azimuth / (2 * np.pi) + 0.5) % 1 * hdr.shape[1] - 0.5
    map_y = (0.5 - elevation / np.pi) * hdr.shape[0] - 0.5
    light = exposure * hdr / np.median(hdr)
    display = np.rint((light / (1 + light)) ** (1 / 2.2) * 255).astype(np.uint8)
    display = cv2.medianBlur(display, 3)  # removes dark rims that compression leaves beside very bright pixels
    return cv2.remap(display.astype(np.float32), map_x.astype(np.float32), map_y.astype(np.float32),
                     cv2.INTER_CUBIC, borderMode=cv2.BORDER_WRAP).clip(0, 255)


def interior(data, width, height):
    return panorama_view(data / "hdr/interior.exr", width, height, yaw_deg=-55, pitch_deg=-12, fov_deg=80, exposure=0.3)


def courtyard(data, width, height):
    return panorama_view(data / "hdr/courtyard.exr", width, height, yaw_deg=-55, pitch_deg=-10, fov_deg=80, exposure=0.3)


def white(_data, width, height):
    return np.full((height, width, 3), 255, np.float32)


def grey_studio(_data, width, height):
    """Grey backdrop, brighter at the top, with darker corners."""
    y, x = np.mgrid[0:height, 0:width]
    grey = 205 + 30 * (1 - y / height) - 40 * ((x / width - 0.5) ** 2 + (y / height - 0.5) ** 2)
    return np.repeat(grey[:, :, None], 3, 2).astype(np.float32)


def stone_wall(_data, width, height):
    """Wall of rough stones in courses, with mortar, grain and a light that falls from the upper left."""
    rng = np.random.default_rng(7)
    y, x = np.mgrid[0:height, 0:width].astype(np.float32)

    def smooth_noise(cell_px, amplitude):
        grid = rng.normal(size=(height // cell_px + 3, width // cell_px + 3)).astype(np.float32)
        return amplitude * cv2.resize(grid, (width, height), interpolation=cv2.INTER_CUBIC)

    warp_x = x + smooth_noise(24, 3)
    warp_y = y + smooth_noise(24, 3)
    wall = np.zeros((height, width, 3), np.float32)
    relief = np.zeros((height, width), np.float32)
    top = -10.0
    while top < height + 10:
        course = rng.uniform(26, 44)
        left = -rng.uniform(5, 60)
        while left < width + 10:
            length = rng.uniform(36, 95)
            inside = np.minimum(np.minimum(warp_x - left, left + length - warp_x),
                                np.minimum(warp_y - top, top + course - warp_y))
            part = inside > 0
            tone = rng.uniform(70, 175)
            wall[part] = tone * (np.array([0.84, 0.94, 1.0]) + rng.normal(0, 0.02, 3))
            relief[part] = np.minimum(inside[part], 7)
            left += length
        top += course
    wall[relief < 2] = (118, 128, 134)
    relief = relief + smooth_noise(4, 0.7) + smooth_noise(12, 1)
    slope = cv2.Sobel(relief, cv2.CV_32F, 1, 0, scale=0.25) + cv2.Sobel(relief, cv2.CV_32F, 0, 1, scale=0.25)
    wall = wall * (1 + 0.35 * slope[:, :, None]).clip(0.3, 1.6) + rng.normal(0, 5, wall.shape)
    return cv2.GaussianBlur(wall.astype(np.float32), (0, 0), 0.7).clip(0, 255)


def body_alpha(bgra):
    """True alpha of the car without its floor shadow, 0..1.

    Shadow pixels are black (largest channel below 24) with partial alpha, and connected to the floor. Black pixels with
    partial alpha inside the outline (between spokes) belong to the car, and so do panes, whose alpha is about 0.5.
    """
    alpha = bgra[:, :, 3]
    shadow = ((alpha == 0) | ((alpha < 250) & (bgra[:, :, :3].max(2) < 24))).astype(np.uint8)
    # Outside: transparent and shadow pixels that are connected to the frame's border.
    _, labels = cv2.connectedComponents(shadow, connectivity=4)
    border = np.unique(np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]]))
    outside = np.isin(labels, border[border > 0])
    body = np.where(outside, 0, alpha)
    interior_part = cv2.erode((~outside).astype(np.uint8), np.ones((7, 7), np.uint8)) > 0
    body[interior_part] = 255
    # Largest part only: specks in the shadow are dropped.
    _, labels, stats, _ = cv2.connectedComponentsWithStats((body > 40).astype(np.uint8))
    largest = (labels == 1 + np.argmax(stats[1:, cv2.CC_STAT_AREA])).astype(np.uint8)
    return np.where(cv2.dilate(largest, np.ones((3, 3), np.uint8)) > 0, body, 0) / 255.0


def write_photo(file, image, noise_codes, rng):
    noisy = image + rng.normal(0, noise_codes, image.shape) if noise_codes > 0 else image
    cv2.imwrite(str(file), np.rint(noisy).clip(0, 255).astype(np.uint8), [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])


def make_car(folder, data, backdrop, noise_codes):
    width, height, scale, left, top = 800, 540, 0.75, 25, 115
    behind = backdrop(data, width, height)
    rng = np.random.default_rng(52)
    for i, number in enumerate(range(1, 52, 3)):
        bgra = cv2.imread(str(data / f"turntable/car52/{number}.png"), cv2.IMREAD_UNCHANGED)
        alpha = bgra[:, :, 3:] / 255.0
        premultiplied = np.dstack([bgra[:, :, :3] * alpha, alpha])
        layers = np.dstack([cv2.resize(layer, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
                            for layer in (premultiplied, body_alpha(bgra))])
        canvas = np.zeros((height, width, 5))
        canvas[top:top + layers.shape[0], left:left + layers.shape[1]] = layers
        photo = canvas[:, :, :3] + (1 - canvas[:, :, 3:4]) * behind
        write_photo(folder / f"photos/{i:03d}.jpg", photo, noise_codes, rng)
        cv2.imwrite(str(folder / f"alpha/{i:03d}.png"), np.rint(canvas[:, :, 4] * 255).astype(np.uint8))


def make_traced(folder, args, recipe, backdrop, disc, views):
    """Traces a recipe. A backdrop function is drawn to a file first; a string is passed on."""
    traced = folder / "traced"
    shutil.rmtree(traced, ignore_errors=True)
    if callable(backdrop):
        file = folder / "backdrop.png"
        cv2.imwrite(str(file), np.rint(backdrop(args.data, 480, 400)).astype(np.uint8))
        backdrop = str(file)
    command = [args.rs_capture, "synth", str(REPOSITORY / f"datasets-synthetic/recipes/{recipe}.json"),
               "--as-photos", "-o", str(traced), "--views", str(views), "--size", "480x400", "--spp", str(args.spp),
               "--photo-backdrop", backdrop, "--disc", disc, "--noise", str(NOISE_CODES), "--jpeg", str(JPEG_QUALITY)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for name, files in (("photos", traced / "photos"), ("alpha", traced / "truth/alpha")):
        for file in sorted(files.iterdir()):
            shutil.copy(file, folder / name / file.name)
    shutil.rmtree(traced)


CARS = {"car-white": (white, 0), "car-grey": (grey_studio, 1), "car-interior": (interior, NOISE_CODES),
        "car-yard": (courtyard, NOISE_CODES)}
TRACED = {"vase-room": ("vase", interior, "none"), "flower-yard": ("flower", courtyard, "rings"),
          "pot-wall": ("vase", stone_wall, "none"), "doll-white": ("doll", "white", "none"),
          "vase-wall": ("vase", "wall", "rings"), "blocks-wall": ("blocks", "wall", "rings"),
          "flower-wall": ("flower", "wall", "rings"), "lattice-wall": ("lattice", "wall", "rings")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="*", metavar="SET", help="sets to make (default: all): " + ", ".join({**CARS, **TRACED}))
    parser.add_argument("--data", type=Path, required=True, help="folder with turntable/car52 and hdr")
    parser.add_argument("--rs-capture", default="rs-capture", help="program that traces the other sets (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="OUT", help="folder for the sets")
    parser.add_argument("--views", type=int, default=12, help="views of a traced set (default: %(default)s)")
    parser.add_argument("--spp", type=int, default=4, help="samples per pixel of traced sets (default: %(default)s)")
    args = parser.parse_args()
    for name in args.sets or [*CARS, *TRACED]:
        if name not in CARS and name not in TRACED:
            parser.error(f"{name}: no such set")
        folder = args.output / name
        for part in ("photos", "alpha"):
            shutil.rmtree(folder / part, ignore_errors=True)
            (folder / part).mkdir(parents=True)
        if name in CARS:
            make_car(folder, args.data, *CARS[name])
        else:
            make_traced(folder, args, *TRACED[name], args.views)
        print(folder)


if __name__ == "__main__":
    main()
