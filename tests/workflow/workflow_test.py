#!/usr/bin/env python3
"""Runs workflow/Snakefile on tiny objects and compares the results with those of direct calls of the tools.

    workflow_test.py TOOLS_FOLDER [unittest arguments]

Exit status 77: skipped, as snakemake or OpenGL is missing.
"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOLS = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT / "build/release/bin"
SNAKEMAKE = ["snakemake", "-s", str(ROOT / "workflow/Snakefile"), "--configfile", "config.json", "--rerun-incomplete"]
CORES = ["--cores", "2"]
SYNTH = "--views 8 --size 48x40 --spp 1"
BUILD = "--planes 3 --cells 16x16"
HALL = """#VRML V2.0 utf8
Viewpoint { position 0 1 7 }
PointLight { location 1 3 2 }
Shape { appearance Appearance { material Material { diffuseColor .8 .2 .1 } } geometry Sphere { radius 1.3 } }
Transform { translation 0 -1.5 0 children Shape {
  appearance Appearance { material Material { diffuseColor .6 .7 .8 } } geometry Box { size 9 .2 9 } } }
"""


class Workflow(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = Path(folder.name)
        # Snakemake keeps caches in the home folder.
        self.environment = os.environ | {"HOME": folder.name, "XDG_CACHE_HOME": folder.name, "LC_ALL": "C"}

    def tool(self, name, *arguments):
        """A direct call, in the working folder."""
        return subprocess.run([TOOLS / name, *arguments], cwd=self.work, env=self.environment, check=True,
                              capture_output=True, text=True)

    def configure(self, **config):
        (self.work / "config.json").write_text(json.dumps({"tools": str(TOOLS), **config}))

    def recipes(self, *names):
        for name in names:
            recipe = {"name": name, "object": {"generator": name}, "environment": {"studio": {}}}
            (self.work / f"{name}.json").write_text(json.dumps(recipe))
        return {"inputs": [f"{name}.json" for name in names], "options": SYNTH}

    def sets(self, *names):
        """Capture sets given/NAME."""
        (self.work / "given").mkdir()
        self.recipes("vase")
        self.tool("rs-capture", "synth", "vase.json", "-q", "-o", f"given/{names[0]}", *SYNTH.split())
        for name in names[1:]:
            shutil.copytree(self.work / "given" / names[0], self.work / "given" / name)

    def snakemake(self, *arguments, ok=True, cores=CORES):
        """The status and the output, from which a success is required by `ok`."""
        run = subprocess.run([*SNAKEMAKE, *cores, *arguments], cwd=self.work, env=self.environment, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if ok:
            self.assertEqual(run.returncode, 0, run.stdout)
        return run.returncode, run.stdout

    def bytes_of(self, path):
        """{name: bytes} of a folder's files, or of the file."""
        path = self.work / path
        files = [path] if path.is_file() else [p for p in path.rglob("*") if p.is_file()]
        self.assertTrue(files, f"{path} does not exist")
        return {str(file.relative_to(path)): file.read_bytes() for file in files}

    def assert_equal(self, path, other):
        self.assertEqual(self.bytes_of(path), self.bytes_of(other))

    def assert_made_as_directly(self, names):
        for name in names:
            self.tool("rs-capture", "synth", f"{name}.json", "-q", "-o", f"direct-{name}", *SYNTH.split())
            self.tool("rs-encode", "build", f"direct-{name}", "-q", "-o", f"direct-{name}.rso", "--name", name,
                      *BUILD.split())
            self.assert_equal(f"results/sets/{name}", f"direct-{name}")
            self.assert_equal(f"results/objects/{name}.rso", f"direct-{name}.rso")

    def test_makes_everything_once(self):
        self.sets("given-vase")
        self.tool("rs-capture", "synth", "vase.json", "--as-photos", "--views", "12", "--size", "96x80", "--spp", "1",
                  "-q", "-o", "turn")
        (self.work / "turn/photos").rename(self.work / "doll")
        nominal = "--calibration nominal --counter-clockwise"
        config = {"synth": self.recipes("vase", "lamp"), "sets": ["given/*"], "build": {"options": BUILD},
                  "import": {"inputs": ["doll"], "options": nominal}, "evaluate": {"options": "--planes 3"}}
        self.configure(**config)
        self.snakemake()
        self.assert_made_as_directly(["vase", "lamp"])
        self.tool("rs-capture", "import", "doll", "-q", "-o", "direct-doll", *nominal.split())
        self.assert_equal("results/sets/doll", "direct-doll")
        self.tool("rs-engine", "render", "results/objects/lamp.rso", "--orbit", "8", "--sheet", "4", "--size", "240x240",
                  "-o", "direct-sheet.png")
        self.assert_equal("results/sheets/lamp.png", "direct-sheet.png")
        page = (self.work / "results/index.html").read_text()
        for name in ("vase", "lamp", "doll", "given-vase"):
            self.assertIn(f'href="objects/{name}.rso"', page)
            self.assertIn("shape: ", page)
            self.assertIn("<svg", (self.work / f"results/reports/{name}.html").read_text())

        self.assertIn("Nothing to be done", self.snakemake()[1])
        # A changed picture concerns its own object only, other options concern all.
        shutil.copy(self.work / "given/given-vase/001.png", self.work / "given/given-vase/002.png")
        output = self.snakemake("objects")[1]
        self.assertEqual(re.findall(r"rule build:", output), ["rule build:"], output)
        self.assertIn("wildcards: name=given-vase", output)
        self.configure(**config | {"build": {"options": BUILD + " --name all"}})
        self.assertEqual(len(re.findall(r"rule build:", self.snakemake("objects")[1])), 4)

    def test_resumes_after_a_kill(self):
        names = ["vase", "lamp", "blocks"]
        self.configure(synth=self.recipes(*names), build={"options": BUILD}, evaluate={"options": "--planes 3"})
        kills = 0
        for wanted in ("logs/synth/*.log", "sets/*/transforms.json", "objects/[!.]*.rso"):
            process = subprocess.Popen([*SNAKEMAKE, *CORES], cwd=self.work, env=self.environment,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
            while process.poll() is None and not list((self.work / "results").glob(wanted)):
                time.sleep(0.005)
            os.killpg(process.pid, signal.SIGKILL)
            kills += process.wait() == -signal.SIGKILL
            self.assertFalse((self.work / "results/index.html").exists())
            for file in (self.work / "results/objects").glob("[!.]*.rso"):
                self.tool("rs-encode", "verify", file)  # whole, as far as it exists
            self.assertIn("--unlock", self.snakemake(ok=False)[1])
            self.snakemake("--unlock")
        self.assertEqual(kills, 3)
        self.snakemake()
        self.assert_made_as_directly(names)
        self.assertTrue((self.work / "results/index.html").exists())
        self.assertEqual([p for p in (self.work / "results/sets").iterdir() if p.name.startswith(".")], [],
                         "temporary folders of killed tools are left")

    def test_a_bad_item_costs_only_itself(self):
        self.sets("good", "faulty", "other")
        picture = next((self.work / "given/faulty").rglob("*.png"))
        whole = picture.read_bytes()
        picture.write_bytes(whole[:len(whole) // 2])
        self.configure(sets=["given/*"], build={"options": BUILD}, evaluate={"options": "--planes 3"})
        status, output = self.snakemake("--keep-going", "--show-failed-logs", ok=False)
        self.assertEqual(status, 1)
        self.assertIn("results/logs/build/faulty.log", output)
        self.assertIn(f"rs-encode: error: given/faulty/{picture.relative_to(self.work / 'given/faulty')}", output)
        self.assertNotIn("logs/build/good.log (check", output)
        for name in ("good", "other"):
            self.assertTrue((self.work / f"results/objects/{name}.rso").exists())
            self.assertTrue((self.work / f"results/reports/{name}.html").exists())
        self.assertFalse((self.work / "results/objects/faulty.rso").exists())
        self.assertFalse((self.work / "results/index.html").exists())
        picture.write_bytes(whole)
        output = self.snakemake()[1]
        self.assertEqual(len(re.findall(r"rule build:", output)), 1, output)
        self.assertTrue((self.work / "results/index.html").exists())

    def test_equal_names_and_missing_inputs_are_refused(self):
        self.sets("vase")
        self.configure(sets=["given/vase"], synth=self.recipes("vase"))
        status, output = self.snakemake(ok=False)
        self.assertEqual(status, 1)
        self.assertIn("given/vase: has the same name as vase.json; rename one of them", output)
        self.configure(sets=["nowhere/*"])
        self.assertIn("nowhere/*: matches nothing", self.snakemake(ok=False)[1])

    def test_tiles_are_the_frame(self):
        (self.work / "hall.wrl").write_text(HALL)
        outputs = {}
        for method in ("path", "whitted"):
            outputs[f"{method}.png"] = f"hall.wrl --renderer {method} --passes 2 --size 264x260"
        outputs["turn"] = "hall.wrl --renderer whitted --passes 2 --size 64x48 --orbit 3"
        outputs["raster.png"] = "hall.wrl --size 64x48"
        for name, options in outputs.items():
            try:
                self.tool("rs-view", "render", *options.split(), "-q", "-o", f"direct-{name}")
            except subprocess.CalledProcessError as failed:
                if "OpenGL: " in failed.stderr:
                    self.skipTest(failed.stderr)
                raise AssertionError(failed.stderr) from failed
        config = {"outputs": {name: {"options": options, "inputs": ["hall.wrl"]} for name, options in outputs.items()}}
        self.configure(render=config)
        output = self.snakemake()[1]
        self.assertEqual(len(re.findall(r"rule tile:", output)), 4 + 4 + 3, output)
        for name in outputs:
            self.assert_equal(f"results/render/{name}", f"direct-{name}")
        self.assertIn("Nothing to be done", self.snakemake()[1])
        # Another size of the tiles has other tiles, and the same frame.
        self.configure(render=config | {"tile_px": 200})
        self.snakemake("results/render/path.png", "--force")
        self.assert_equal("results/render/path.png", "direct-path.png")
        self.assertEqual(len(list((self.work / "results/tiles/path.png/264x260-200").iterdir())), 4)

    def test_slurm_profile_submits_and_retries(self):
        """The profile with a scheduler that runs jobs at once, and kills the first attempt of each build."""
        self.sets("vase")
        self.configure(sets=["given/*"], build={"options": BUILD})
        bin_ = self.work / "bin"
        bin_.mkdir()
        for name, text in {
            "sbatch": 'for job; do :; done\nid=$(ls slurm | wc -l)\necho "$*" >slurm/$id\n'
                      'case "$*" in *rayspace-build*--mem=15*) echo OUT_OF_MEMORY >$id.state ;;\n'
                      '*) if sh "$job" >>jobs.log 2>&1; then echo COMPLETED; else echo FAILED; fi >$id.state ;; esac\necho $id\n',
            "sacct": 'while [ "$1" != -j ]; do shift; done\ncat "$2.state"\n',
        }.items():
            (bin_ / name).write_text("#!/bin/sh\n" + text)
            (bin_ / name).chmod(0o755)
        (self.work / "slurm").mkdir()
        self.environment["PATH"] = f"{bin_}:{self.environment['PATH']}"
        profile = ["--profile", str(ROOT / "workflow/profiles/slurm"), "--latency-wait", "5"]
        self.snakemake("objects", cores=profile)
        submitted = [(self.work / f"slurm/{i}").read_text() for i in range(len(list((self.work / "slurm").iterdir())))]
        self.assertEqual(len(submitted), 2, submitted)
        memory = [int(re.search(r"--mem=(\d+)M", call)[1]) for call in submitted]
        self.assertEqual(memory, [151, 302])  # ceil(150 + 14 * 8 * 48 * 40 / 10^6), and twice as much
        for call in submitted:
            self.assertIn("--job-name=rayspace-build --cpus-per-task=4 ", call)
        self.assertTrue((self.work / "results/objects/vase.rso").exists())


if __name__ == "__main__":
    if shutil.which("snakemake") is None:
        print("skipped: snakemake is not installed (apt install snakemake)")
        sys.exit(77)
    result = unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2, exit=False).result
    sys.exit(77 if result.skipped and result.wasSuccessful() else not result.wasSuccessful())
