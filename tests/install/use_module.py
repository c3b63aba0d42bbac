"""Uses the Python module as its users do: use_module.py OBJECT.rso CAPTURE_SET; the set's photos are what the tools render."""
import sys

import numpy as np
import rayspace

thing = rayspace.Object.open(sys.argv[1])
assert thing.photos == 9 and thing.width == 128 and thing.has_all_photos, thing.name
captured = thing.captured_cameras()
renderer = rayspace.Renderer.create(thing)
views = [renderer.render(c.camera).image for c in captured]
height, width = captured[0].camera.height, captured[0].camera.width
assert all(v.shape == (height, width, 4) and v.dtype == np.uint8 for v in views)
assert all(v[..., 3].max() == 255 for v in views) and (views[0] != views[4]).any()

# Depth is there where something is shown, and only there; the camera is 3.5 units away.
near = rayspace.Camera(captured[0].camera.world_from_camera, 64, 48, fov_x_rad=0.785)
view = renderer.render(near, depth=True)
assert view.depth.dtype == np.float32 and ((view.depth > 0) == (view.image[..., 3] > 0)).all()
assert 0.5 < view.depth[view.depth > 0].mean() < 6, view.depth[view.depth > 0].mean()
assert renderer.render(near).depth is None

compared = rayspace.compare_with_photos(renderer, sys.argv[2])
assert len(compared.views) == 9 and compared.mean_psnr_db >= 99, compared.mean_psnr_db

scalar = rayspace.Renderer.create(thing, executor="scalar")
assert (scalar.render(captured[4].camera).image == views[4]).all()

for wrong, word in ((lambda: rayspace.Object.open("none.rso"), "none.rso"),
                    (lambda: rayspace.Camera(np.eye(3), 8, 8, fov_x_rad=0.7), "4x4"),
                    (lambda: renderer.render(rayspace.Camera(2 * np.eye(4), 8, 8, fov_x_rad=0.7)), "rotation"),
                    (lambda: rayspace.Camera(np.eye(4), 8, 8), "fov_x_rad"),
                    (lambda: renderer.render(rayspace.Camera(np.eye(4), -8, 8, fl_x=40)), "8192"),
                    (lambda: rayspace.Renderer.create(thing, executor="none"), "scalar, core"),
                    (lambda: rayspace.compare_with_photos(renderer, "nowhere"), "nowhere")):
    try:
        wrong()
    except rayspace.Error as error:
        assert word in str(error), error
    else:
        raise AssertionError(f"{word}: no error")
