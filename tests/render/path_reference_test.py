"""Path-traced scenes against their reference pictures, where these are at hand.

With few samples the noise alone is above the references' limits: then the limits on it are wider, as noise falls with the root
of their number. RAYTRACER_REFERENCE_SAMPLES=1024 holds the pictures to the limits themselves."""

import json
import math
import os
import pathlib
import shutil
import tempfile
import unittest

import program
import reference_pictures

SAMPLES = int(os.environ.get("RAYTRACER_REFERENCE_SAMPLES", "64"))
ENOUGH_SAMPLES = 512  # for the references' own limits
SCENES = program.ROOT / "tests" / "data" / "reference"
ASSETS = {"mesh_area": "rabbit.obj", "ggx_row_env": "env_a.exr", "textured_quad": "chart.png"}
ALTERNATIVE = {"ggx_row_env": ["--alt"]}  # facets' masking and shadowing correlated by height, as ours


class PathReference(unittest.TestCase):
    def compare(self, name):
        if not (reference_pictures.REFERENCE / name).exists():
            self.skipTest(f"no reference pictures in {reference_pictures.REFERENCE}")
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            shutil.copy(SCENES / f"{name}.txt", folder)
            if name in ASSETS:
                shutil.copy(reference_pictures.REFERENCE / name / ASSETS[name], folder)
            done = program.run(f"{name}.txt", "-o", "out.exr", "--samples", SAMPLES, "--quiet", cwd=folder, timeout=3000)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            return reference_pictures.compare(name, folder / "out.exr", "--json", *ALTERNATIVE.get(name, []))

    def check(self, name):
        done = self.compare(name)
        is_exact = not (reference_pictures.REFERENCE / name / "limits.json").exists()
        if is_exact or SAMPLES >= ENOUGH_SAMPLES:
            return self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        limits = json.loads((reference_pictures.REFERENCE / name / "limits.json").read_text())
        found = json.loads(done.stdout.splitlines()[-1])
        for ratio in found["mean_ratio"]:
            self.assertLessEqual(abs(ratio - 1), limits["mean_ratio"], done.stdout)
        self.assertLessEqual(found["block_rel"], limits["block_rel"] * math.sqrt(1024 / SAMPLES), done.stdout)
        return None

    def test_every_scene_has_a_test(self):
        names = {path.stem for path in SCENES.glob("*.txt")}
        self.assertEqual(names, {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")} -
                         {"every_scene_has_a_test"})

    def test_cornell_box(self):
        self.check("cornell_box")

    def test_furnace_grey(self):
        self.check("furnace_grey")

    def test_ggx_row_env(self):
        self.check("ggx_row_env")

    def test_glass_box(self):
        self.check("glass_box")

    def test_mesh_area(self):
        self.check("mesh_area")

    def test_textured_quad(self):
        self.check("textured_quad")

    def test_thinlens_dof(self):
        self.check("thinlens_dof")


if __name__ == "__main__":
    unittest.main()
