#!/usr/bin/env python3
"""Converts a NeRF data set to a capture set, from which rs-encode builds an object.

    convert_nerf.py lego/transforms_test.json -o lego-set
    rs-encode build lego-set -o lego.rso

Input: a transforms.json with poses (OpenGL camera axes) and RGBA images, as of the NeRF synthetic scenes or nerfstudio.
rs-encode needs the object's vertical axis on Y, the object around the origin, and rings of cameras at one elevation.
The script turns the world so that --up becomes Y, moves the point that the cameras look at to the origin, and keeps the
cameras of the elevation that has the most. It copies the images and writes transforms.json.
"""

import argparse
import json
import math
import pathlib
import shutil
import sys

import cv2
import numpy as np

DISTORTION = ("k1", "k2", "k3", "k4", "p1", "p2")
INTRINSICS = ("camera_angle_x", "fl_x", "fl_y", "cx", "cy", "w", "h")
MOST_PITCH_DEG = 60  # steeper cameras cannot be made upright


def fail(message):
    sys.exit(f"convert_nerf.py: {message}")


def rotation_to_y(up):
    """The rotation that takes the direction `up` to +Y by the shortest way."""
    up = up / np.linalg.norm(up)
    y = np.array([0.0, 1.0, 0.0])
    axis = np.cross(up, y)
    if np.linalg.norm(axis) < 1e-12:
        return np.eye(3) if up[1] > 0 else np.diag([1.0, -1.0, -1.0])
    angle = math.acos(np.clip(up @ y, -1, 1))
    return cv2.Rodrigues(axis / np.linalg.norm(axis) * angle)[0]


def common_target(poses):
    """The point nearest to all optical axes, in the least squares sense."""
    matrix, right = np.zeros((3, 3)), np.zeros(3)
    for pose in poses:
        direction = -pose[:3, 2]
        across = np.eye(3) - np.outer(direction, direction)
        matrix += across
        right += across @ pose[:3, 3]
    if np.linalg.cond(matrix) > 1e8:
        fail("the cameras look in one direction, so the point that they look at is unknown; give --centre x,y,z")
    return np.linalg.solve(matrix, right)


def image_file(folder, name):
    for candidate in (folder / name, folder / (name + ".png")):
        if candidate.is_file():
            return candidate
    fail(f"{folder / name}: there is no such image")


def vector(text):
    numbers = [float(n) for n in text.split(",")]
    if len(numbers) != 3:
        raise argparse.ArgumentTypeError("give three numbers, such as 0,0,1")
    return np.array(numbers)


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("transforms", type=pathlib.Path, help="the data set's transforms.json")
parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="folder to create")
parser.add_argument("--up", type=vector, default="0,0,1", help="the object's vertical axis (default 0,0,1)")
parser.add_argument("--centre", type=vector, help="a point of the axis; the common target of the cameras if not given")
parser.add_argument("--elevation", type=float, help="of the ring, degrees; the one with the most cameras if not given")
parser.add_argument("--tolerance", type=float, default=2.0, help="of the elevation, degrees (default 2)")
arguments = parser.parse_args()

try:
    data = json.loads(arguments.transforms.read_text(encoding="utf-8"))
    poses = [np.array(frame["transform_matrix"], float).reshape(-1, 4)[:3] for frame in data["frames"]]
except (OSError, ValueError, KeyError) as error:
    fail(f"{arguments.transforms}: cannot be read as a NeRF data set: {error}")
if not poses:
    fail(f"{arguments.transforms}: has no frames")
for source in (data, *data["frames"]):
    if any(source.get(key) for key in DISTORTION):
        fail(f"{arguments.transforms}: the images have lens distortion; undistort them first")

turn = rotation_to_y(arguments.up)
centre = arguments.centre if arguments.centre is not None else common_target(poses)
moved = []
for pose in poses:
    matrix = np.eye(4)
    matrix[:3, :3] = turn @ pose[:, :3]
    matrix[:3, 3] = turn @ (pose[:, 3] - centre)
    moved.append(matrix)

elevations = np.degrees([math.atan2(m[1, 3], math.hypot(m[0, 3], m[2, 3])) for m in moved])
pitches = np.degrees([math.asin(np.clip(-m[1, 2], -1, 1)) for m in moved])
usable = np.abs(pitches) <= MOST_PITCH_DEG
if not usable.any():
    fail(f"{arguments.transforms}: every camera looks up or down by more than {MOST_PITCH_DEG} degrees; is --up right?")
ring = arguments.elevation
if ring is None:
    counts = [np.count_nonzero(usable & (np.abs(elevations - e) <= arguments.tolerance)) for e in elevations[usable]]
    ring = elevations[usable][int(np.argmax(counts))]
kept = np.flatnonzero(usable & (np.abs(elevations - ring) <= arguments.tolerance))
if len(kept) < 3:
    fail(f"{arguments.transforms}: {len(kept)} cameras at an elevation of {ring:.1f} degrees; give another --elevation "
         "or a larger --tolerance")

sources = [image_file(arguments.transforms.parent, data["frames"][index]["file_path"]) for index in kept]
for source in sources:
    image = cv2.imread(str(source), cv2.IMREAD_UNCHANGED)
    if image is None or image.ndim != 3 or image.shape[2] != 4:
        fail(f"{source}: has no alpha channel; segment the object first (rs-capture import does)")
try:
    arguments.output.mkdir(parents=True)
except FileExistsError:
    fail(f"{arguments.output}: exists; give another folder")
result = {key: data[key] for key in INTRINSICS if key in data}
result["frames"] = []
for number, (index, source) in enumerate(zip(kept, sources)):
    frame = data["frames"][index]
    name = f"{number:04d}{source.suffix}"
    shutil.copyfile(source, arguments.output / name)
    result["frames"].append({key: frame[key] for key in INTRINSICS if key in frame}
                            | {"file_path": name, "transform_matrix": moved[index].tolist()})
(arguments.output / "transforms.json").write_text(json.dumps(result, indent=1), encoding="utf-8")
print(f"{arguments.output}: {len(kept)} of {len(poses)} views, at an elevation of {ring:.1f} degrees")
