"""Runs an example as its users do: examples_test.py BUILD EXAMPLES_BUILD EXAMPLE. 77: what it needs is missing."""

import importlib.util
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

BUILD, EXAMPLES_BUILD = map(pathlib.Path, sys.argv[1:3])
SOURCES = pathlib.Path(__file__).resolve().parents[2] / "examples"
sys.path.insert(0, str(BUILD / "bin"))
import rayspace  # noqa: E402

WIDTH, HEIGHT, FOCAL, VIEWS = 96, 80, 120.0, 24
BALLS = [((0.0, 0.0, 0.0), 0.5, (200, 60, 40)), ((0.6, 0.2, 0.1), 0.25, (40, 180, 70)), ((-0.3, -0.5, 0.5), 0.2, (50, 80, 210))]


def run(*command, fails=False):
    environment = os.environ | {"PYTHONPATH": str(BUILD / "bin")}
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, env=environment, check=False)
    assert (done.returncode != 0) == fails, f"{command}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stderr if fails else done.stdout


def pose(azimuth, elevation, distance):
    """World from camera, Y up, looking at the origin."""
    back = np.array([math.sin(azimuth) * math.cos(elevation), math.sin(elevation), math.cos(azimuth) * math.cos(elevation)])
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3] = np.column_stack([right, np.cross(back, right), back, back * distance])
    return matrix


def drawn(matrix):
    """Shaded balls, seen from a camera."""
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    rays = np.stack([(x - WIDTH / 2) / FOCAL, (HEIGHT / 2 - y) / FOCAL, -np.ones_like(x)], axis=-1) @ matrix[:3, :3].T
    image = np.zeros((HEIGHT, WIDTH, 4), np.uint8)
    nearest = np.full((HEIGHT, WIDTH), np.inf)
    for centre, radius, colour in BALLS:
        to_ball = np.array(centre) - matrix[:3, 3]
        along = rays @ to_ball / (rays * rays).sum(-1)
        miss = np.linalg.norm(to_ball - along[..., None] * rays, axis=-1)
        shown = (miss < radius) & (along < nearest)
        shade = 1 - 0.5 * miss / radius
        image[shown, :3] = (np.array(colour) * shade[shown][:, None]).round()
        image[shown, 3] = 255
        nearest[shown] = along[shown]
    return image


def write_set(folder, poses, names="{:03d}", world=np.eye(4)):
    """Photos of the balls; the poses that are written are world @ pose."""
    folder.mkdir()
    frames = []
    for number, matrix in enumerate(poses):
        name = names.format(number)
        (folder / name).parent.mkdir(exist_ok=True)
        rayspace.write_png(folder / (name + ".png"), drawn(matrix))
        frames.append({"file_path": name, "transform_matrix": (world @ matrix).tolist()})
    angle = 2 * math.atan(0.5 * WIDTH / FOCAL)
    (folder / "transforms.json").write_text(json.dumps({"camera_angle_x": angle, "frames": frames}), encoding="utf-8")


def ring(count=VIEWS, elevation=0.15, first=0.0):
    return [pose(first + 2 * math.pi * n / count, elevation, 3.5) for n in range(count)]


def build(work):
    write_set(work / "set", ring())
    built = rayspace.build_object(work / "set", planes=8, quality=90)
    built.object.write(work / "balls.rso")
    return work / "balls.rso"


def render_orbit(work):
    scene = build(work)
    run(EXAMPLES_BUILD / "render_orbit", scene, work / "views", VIEWS)
    for number in (0, 7, VIEWS - 1):
        view = rayspace.read_image(work / "views" / f"{number:04d}.png")
        score = rayspace.compare_images(view, rayspace.Object.open(scene).photo(number))
        assert score.psnr_db > 30, (number, score.psnr_db)
    assert "none.rso" in run(EXAMPLES_BUILD / "render_orbit", work / "none.rso", work / "none", fails=True)


def custom_executor(work):
    scene = build(work)
    out = run(EXAMPLES_BUILD / "custom_executor", scene, work / "view.png")
    assert "checked:NAME" in out, out
    renderer = rayspace.Renderer.create(rayspace.Object.open(scene))
    expected = renderer.render(renderer.object.orbit(1)[0]).image
    assert np.array_equal(rayspace.read_image(work / "view.png"), expected)
    assert "checked:NAME" in run(EXAMPLES_BUILD / "custom_executor", scene, work / "view.png", "unknown", fails=True)
    assert "no such executor" in run(EXAMPLES_BUILD / "custom_executor", scene, work / "view.png", "checked:x", fails=True)


def opengl_scene(work):
    scene = build(work)
    os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
    done = subprocess.run([EXAMPLES_BUILD / "opengl_scene", scene, work / "frame.png"], capture_output=True, text=True,
                          check=False)
    if "EGL has no" in done.stderr or "no OpenGL 4.5" in done.stderr:
        print(done.stderr)
        sys.exit(77)
    assert done.returncode == 0, done.stderr
    numbers = [int(word) for word in done.stdout.split(": ")[1].split() if word.isdigit()]
    visible, total = numbers
    assert 0.3 * total < visible < total, done.stdout  # some pillars hide a part of the object
    frame = rayspace.read_image(work / "frame.png").astype(int)
    red = (frame[..., 0] > 2 * frame[..., 1]) & (frame[..., 0] > 2 * frame[..., 2]) & (frame[..., 0] > 90)
    assert red.sum() > 1000, red.sum()  # the large ball is shown in its colour


def compare_with_photos(work):
    scene = build(work)
    script = SOURCES / "compare_with_photos.py"
    held_out = run(sys.executable, script, work / "set", "--every", 3).splitlines()
    assert len(held_out) == VIEWS // 3 + 1 and float(held_out[-1].split()[1]) > 20, held_out
    write_set(work / "between", ring(8, first=0.1))
    for name in ("auto", "bilinear"):
        between = run(sys.executable, script, work / "between", "--object", scene, "--filter", name).splitlines()
        assert len(between) == 9 and float(between[-1].split()[1]) > 20, between
    assert "nowhere" in run(sys.executable, script, work / "nowhere", fails=True)


def convert_nerf(work):
    if importlib.util.find_spec("cv2") is None:
        print("OpenCV's Python module is missing")
        sys.exit(77)
    # Z up, away from the origin, with cameras of other elevations, as NeRF data sets have them.
    world = np.array([[1.0, 0, 0, 5], [0, 0, -1, 2], [0, 1, 0, -3], [0, 0, 0, 1]])
    others = [pose(0.3 + n, 0.5 + 0.1 * n, 3.5) for n in range(5)]
    write_set(work / "nerf", ring() + others + [pose(1.0, 1.4, 3.5)], names="train/r_{:d}", world=world)
    script = SOURCES / "convert_nerf.py"
    out = run(sys.executable, script, work / "nerf" / "transforms.json", "-o", work / "set")
    assert f"{VIEWS} of {VIEWS + 6} views" in out, out
    for camera, truth in zip(rayspace.read_cameras(work / "set"), ring()):
        assert np.allclose(camera.camera.world_from_camera, truth, atol=1e-6), camera.camera.world_from_camera
    run(BUILD / "bin" / "rs-encode", "build", work / "set", "-o", work / "balls.rso", "-q")
    renderer = rayspace.Renderer.create(rayspace.Object.open(work / "balls.rso"))
    write_set(work / "between", ring(8, first=0.1))
    scores = rayspace.compare_with_photos(renderer, work / "between")
    assert scores.mean_psnr_db > 20, scores.mean_psnr_db
    assert "exists" in run(sys.executable, script, work / "nerf" / "transforms.json", "-o", work / "set", fails=True)
    failed = run(sys.executable, script, work / "nerf" / "transforms.json", "-o", work / "x", "--elevation", -40, fails=True)
    assert "0 cameras" in failed, failed


with tempfile.TemporaryDirectory() as folder:
    globals()[sys.argv[3]](pathlib.Path(folder))
