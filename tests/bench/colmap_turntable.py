"""Computations of colmap_turntable.sh: errors of the steps of calibrated turns against published ones.

    colmap_turntable.py views SET             prints per view of a set: its image, a tab, its photo
    colmap_turntable.py compare OUT CAMERAS   prints a table and CSV of the results in OUT, and writes OUT/steps.csv

Rotations are 3x3 nested lists, camera_from_object. A step is the rotation from one view to the next, R[i+1] R[i]^T;
the last one closes the turn. Angles are about the mean axis of all steps; steps in the opposite direction are negative.
"""

import csv
import json
import math
import struct
import sys
import zlib
from pathlib import Path


def fail(message):
    sys.exit(f"colmap_turntable: {message}")


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def transposed(a):
    return [list(column) for column in zip(*a)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def determinant(a):
    return dot(cross(a[0], a[1]), a[2])


def unit(v):
    length = math.hypot(*v) or 1.0
    return [x / length for x in v]


# ---- Published cameras: the subset of the level 5 MAT format for a cell array of real matrices.


def mat_elements(data):
    at = 0
    while at + 8 <= len(data):
        kind, size = struct.unpack_from("<II", data, at)
        if kind >> 16:  # a small element: its size and up to four bytes share the tag's eight bytes
            yield kind & 0xFFFF, data[at + 4 : at + 4 + (kind >> 16)]
            at += 8
            continue
        yield kind, data[at + 8 : at + 8 + size]
        at += 8 + size
        if kind != 15:
            at = (at + 7) // 8 * 8


def mat_matrices(data):
    """Every matrix of doubles in file order, as (rows, columns, values column by column)."""
    for kind, content in mat_elements(data):
        if kind == 15:
            yield from mat_matrices(zlib.decompress(content))
        elif kind == 14:
            parts = list(mat_elements(content))
            array_class = parts[0][1][0]
            if array_class == 1:  # a cell array: its cells follow flags, sizes and name
                for _, cell in parts[3:]:
                    yield from mat_matrices(struct.pack("<II", 14, len(cell)) + cell)
            elif array_class == 6 and parts[3][0] == 9:
                rows, columns = struct.unpack("<2i", parts[1][1])
                yield rows, columns, struct.unpack(f"<{rows * columns}d", parts[3][1])


def published_steps(path):
    """Degrees between consecutive views. M[i+1] M[i]^-1 of the left 3x3 parts is K R K^-1, whose trace is that of R."""
    data = Path(path).read_bytes()
    if data[124:128] != b"\x00\x01IM":
        fail(f"{path} is not a little-endian level 5 MAT file")
    cameras = [values for rows, columns, values in mat_matrices(data[128:]) if (rows, columns) == (3, 4)]
    lefts = [transposed([p[0:3], p[3:6], p[6:9]]) for p in cameras]
    if len(lefts) < 3:
        fail(f"{path}: contains {len(lefts)} projection matrices; a turn needs at least 3")
    steps = []
    for i, m in enumerate(lefts):
        volume = determinant(m)
        inverse = transposed([[x / volume for x in cross(m[(k + 1) % 3], m[(k + 2) % 3])] for k in range(3)])
        ratio = product(lefts[(i + 1) % len(lefts)], inverse)
        scale = math.copysign(abs(determinant(ratio)) ** (1 / 3), determinant(ratio))
        trace = (ratio[0][0] + ratio[1][1] + ratio[2][2]) / scale
        steps.append(math.degrees(math.acos(max(-1.0, min(1.0, (trace - 1) / 2)))))
    return steps


# ---- The two calibrations


def turntable_rotation(pan, tilt, roll, angle):
    """Rz(roll) Rx(tilt) Ry(pan) Ry(angle), all in degrees: capture/calibration/model/turntable_model.hpp."""
    c, s = math.cos(math.radians(pan + angle)), math.sin(math.radians(pan + angle))
    about_y = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    about_x = [[1, 0, 0], [0, c, -s], [0, s, c]]
    c, s = math.cos(math.radians(roll)), math.sin(math.radians(roll))
    return product([[c, -s, 0], [s, c, 0], [0, 0, 1]], product(about_x, about_y))


def our_turn(summary, photos):
    report = json.loads(Path(summary).read_text())
    turn = {"method": f"rs-capture ({report['method']})", "rotations": {}}
    found = report.get("calibration")
    if not found:
        return turn
    if len(found["angles"]) != len(photos):
        fail(f"{summary}: {len(found['angles'])} angles for {len(photos)} photos")
    for photo, angle in zip(photos, found["angles"]):
        if photo not in report["left_out"]:
            turn["rotations"][photo] = turntable_rotation(
                found["pan_deg"], found["tilt_deg"]["value"], found["roll_deg"]["value"], angle["value"]
            )
    turn.update(f=found["f_px"]["value"], k1=found["k1"]["value"], points=found["points"])
    turn.update(observations=found["observations"], rms_px=found["rms_px"])
    return turn


def rotation_of_quaternion(w, x, y, z):
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def model_lines(path):
    return [line for line in Path(path).read_text().split("\n") if not line.startswith("#")]


def colmap_turn(variant, folder):
    turn = {"method": f"COLMAP ({variant})", "rotations": {}}
    models = [(model_lines(path), path.parent) for path in sorted(Path(folder).glob("*/images.txt"))]
    if not models:
        return turn
    turn["models"] = [len(lines) // 2 for lines, _ in models]
    lines, folder = max(models, key=lambda model: len(model[0]))
    points = {}
    errors = []
    for line in filter(None, model_lines(folder / "points3D.txt")):
        fields = line.split()
        points[fields[0]] = [float(x) for x in fields[1:4]]
        errors.append(float(fields[7]))
    camera = next(filter(None, model_lines(folder / "cameras.txt"))).split()
    if camera[1] != "SIMPLE_RADIAL":
        fail(f"{folder}/cameras.txt: {camera[1]} instead of SIMPLE_RADIAL")
    f, cx, cy, k = (float(x) for x in camera[4:8])
    squares = []
    for head, marks in zip(lines[0::2], lines[1::2]):
        fields = head.split(maxsplit=9)
        rotation = rotation_of_quaternion(*(float(x) for x in fields[1:5]))
        translation = [float(x) for x in fields[5:8]]
        turn["rotations"][fields[9]] = rotation
        marks = marks.split()
        for x_px, y_px, point in zip(marks[0::3], marks[1::3], marks[2::3]):
            if point == "-1":
                continue
            X, Y, Z = (dot(row, points[point]) + t for row, t in zip(rotation, translation))
            x, y = X / Z, Y / Z
            bend = f * (1 + k * (x * x + y * y))
            squares.append((cx + bend * x - float(x_px)) ** 2 + (cy + bend * y - float(y_px)) ** 2)
    turn.update(f=f, k1=k, points=len(points), observations=len(squares))
    turn.update(rms_px=math.sqrt(sum(squares) / len(squares)), mean_px=sum(errors) / len(errors))
    return turn


# ---- Comparison


def steps_of(turn, photos):
    """Per step its degrees, None where a view is missing; and the largest angle of an axis to the mean axis."""
    vectors = []  # axis times twice the angle's sine, and the trace less 1, which is twice its cosine
    for i, photo in enumerate(photos):
        here = turn["rotations"].get(photo)
        there = turn["rotations"].get(photos[(i + 1) % len(photos)])
        if here is None or there is None:
            vectors.append(None)
            continue
        d = product(there, transposed(here))
        vectors.append(([d[2][1] - d[1][2], d[0][2] - d[2][0], d[1][0] - d[0][1]], d[0][0] + d[1][1] + d[2][2] - 1))
    known = [unit(v) for v, _ in filter(None, vectors)]
    if not known:
        return [None] * len(photos), None
    mean = unit([sum(x) for x in zip(*known)])
    steps, spread = [], 0.0
    for vector in vectors:
        if vector is None:
            steps.append(None)
            continue
        sense = math.copysign(1, dot(vector[0], mean))
        steps.append(sense * math.degrees(math.atan2(math.hypot(*vector[0]), vector[1])))
        off_axis = math.hypot(*cross(unit(vector[0]), mean))
        spread = max(spread, math.degrees(math.asin(min(1.0, off_axis))))
    return steps, spread


def differences(steps, others):
    found = [abs(a - b) for a, b in zip(steps, others) if a is not None and b is not None]
    if not found:
        return None, None
    return math.sqrt(sum(x * x for x in found) / len(found)), max(found)


def read_seconds(path):
    seconds = {}
    for line in Path(path).read_text().splitlines():
        fields = line.split()
        if len(fields) == 4:  # the shell adds a line of its own about a program that was killed
            what, wall, user, system = fields
            seconds[what] = (float(wall), float(user) + float(system))
    return seconds


def add_seconds(turn, stages):
    turn["seconds"], turn["cpu_s"] = (sum(x) for x in zip(*stages))


def notes(turn, photos):
    missing = [photo for photo in photos if photo not in turn["rotations"]]
    if len(missing) == len(photos):
        yield f"{turn['method']} FAILED: it calibrated no photo"
    elif missing:
        lost = sum(step is None for step in turn["steps"])
        yield f"{turn['method']} FAILED on {len(missing)} photos, {lost} steps skipped: {' '.join(missing)}"
    if len(turn.get("models", [])) > 1:
        yield f"{turn['method']} split the turn into models of {turn['models']} photos; the largest is compared"


COLUMNS = [  # key, heading, format
    ("method", "method", "s"),
    ("registered", "photos", "d"),
    ("compared", "steps", "d"),
    ("rms_deg", "RMS deg", ".4f"),
    ("largest_deg", "max deg", ".4f"),
    ("open_rms_deg", "open RMS", ".4f"),
    ("open_largest_deg", "open max", ".4f"),
    ("closing_deg", "closing", ".3f"),
    ("axis_deg", "axis deg", ".3f"),
    ("f", "f px", ".1f"),
    ("k1", "k1", ".3f"),
    ("rms_px", "RMS px", ".3f"),
    ("mean_px", "mean px", ".3f"),
    ("points", "points", "d"),
    ("observations", "observ.", "d"),
    ("seconds", "seconds", ".1f"),
    ("cpu_s", "CPU s", ".1f"),
]


def csv_value(value):
    return round(value, 6) if isinstance(value, float) else value


def compare(out, cameras):
    photos = (out / "photos.txt").read_text().splitlines()
    published = published_steps(cameras)
    if len(published) != len(photos):
        fail(f"{cameras}: contains {len(published)} cameras for {len(photos)} photos")
    seconds = read_seconds(out / "seconds.txt")
    turns = [our_turn(out / "import.out", photos)]
    add_seconds(turns[0], [seconds["import"]])
    for variant in ("masks", "no-masks"):
        if (out / f"colmap-{variant}").is_dir():
            turns.append(colmap_turn(variant, out / f"colmap-{variant}"))
            add_seconds(turns[-1], [seconds[f"{variant}.{stage}"] for stage in ("extraction", "matching", "mapping")])
    for turn in turns:
        turn["steps"], turn["axis_deg"] = steps_of(turn, photos)
        turn["registered"] = len(turn["rotations"])
        turn["compared"] = sum(step is not None for step in turn["steps"])
        turn["rms_deg"], turn["largest_deg"] = differences(turn["steps"], published)
        turn["open_rms_deg"], turn["open_largest_deg"] = differences(turn["steps"][:-1], published[:-1])
        turn["closing_deg"] = turn["steps"][-1]

    def cell(turn, key, form):
        value = turn.get(key)
        return "-" if value is None else format(value, form)

    rows = [[heading for _, heading, _ in COLUMNS]]
    rows += [[cell(turn, key, form) for key, _, form in COLUMNS] for turn in turns]
    widths = [max(map(len, column)) for column in zip(*rows)]
    print()
    for row in rows:
        print("  ".join([row[0].ljust(widths[0])] + [text.rjust(width) for text, width in zip(row[1:], widths[1:])]))
    print()
    print(f"published: {len(published)} steps, {sum(published):.3f} degrees in all, the closing {published[-1]:.3f}")
    for turn in turns:
        for note in notes(turn, photos):
            print(note)
    for turn in turns[1:]:
        rms, largest = differences(turn["steps"], turns[0]["steps"])
        if rms is not None:
            against = f"{turn['method']} against {turns[0]['method']}"
            print(f"{against}: RMS {rms:.4f}, largest {largest:.4f} degrees per step")
    print("seconds (wall, CPU): " + ", ".join(f"{what} {wall:.1f} {cpu:.1f}" for what, (wall, cpu) in seconds.items()))
    print()
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(key for key, _, _ in COLUMNS)
    for turn in turns:
        writer.writerow(csv_value(turn.get(key)) for key, _, _ in COLUMNS)
    with open(out / "steps.csv", "w", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["photograph", "published"] + [turn["method"] for turn in turns])
        for photo, *steps in zip(photos, published, *(turn["steps"] for turn in turns)):
            writer.writerow([photo] + [csv_value(step) for step in steps])


def list_views(capture_set):
    for frame in json.loads((capture_set / "transforms.json").read_text())["frames"]:
        print(frame["file_path"], frame["source_file"], sep="\t")


if len(sys.argv) == 3 and sys.argv[1] == "views":
    list_views(Path(sys.argv[2]))
elif len(sys.argv) == 4 and sys.argv[1] == "compare":
    compare(Path(sys.argv[2]), sys.argv[3])
else:
    print(__doc__, file=sys.stderr)
    sys.exit(2)
