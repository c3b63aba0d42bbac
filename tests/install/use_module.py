"""Uses the Python module as its users do: use_module.py OBJECT.rso CAPTURE_SET, the pictures of the set being what the tools draw of it."""
import sys

import numpy as np
import rayspace

thing = rayspace.open(sys.argv[1])
assert thing.info["views"] == 9 and thing.info["width"] == 128, thing.info
rig = thing.rig
lens = {key: rig[key] for key in ("fl_x", "fl_y", "cx", "cy")}
views = [thing.render(np.array(f["transform_matrix"]), rig["w"], rig["h"], **lens) for f in rig["frames"]]
assert all(v.shape == (rig["h"], rig["w"], 4) and v.dtype == np.uint8 for v in views)
assert all(v[..., 3].max() == 255 for v in views) and (views[0] != views[4]).any()

# Depth is there where something is shown, and only there; the camera stands 3.5 units away.
picture, depth = thing.render(rig["frames"][0]["transform_matrix"], 64, 48, fov_deg=45, depth=True)
assert depth.dtype == np.float32 and ((depth > 0) == (picture[..., 3] > 0)).all()
assert 0.5 < depth[depth > 0].mean() < 6, depth[depth > 0].mean()

compared = thing.compare(sys.argv[2])
assert len(compared["views"]) == 9 and compared["mean_psnr_db"] >= 99, compared

for wrong, word in ((lambda: rayspace.open("none.rso"), "none.rso"),
                    (lambda: thing.render(np.eye(3), 8, 8, fov_deg=40), "4x4"),
                    (lambda: thing.render(2 * np.eye(4), 8, 8, fov_deg=40), "rigid"),
                    (lambda: thing.render(np.eye(4), 8, 8), "fov_deg"),
                    (lambda: thing.render(np.eye(4), -8, 8, fov_deg=40), "8192"),
                    (lambda: thing.compare("nowhere"), "nowhere")):
    try:
        wrong()
    except rayspace.Error as error:
        assert word in str(error), error
    else:
        raise AssertionError(f"{word}: no error")
