"""scenes/pictures.py, of scenes whose colours are known in closed form. usage: scenes_pictures_test.py SSRLAB"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from PIL import Image

SCRIPT = Path(__file__).parent.parent / "scenes/pictures.py"
PROGRAM = sys.argv.pop()


def take(folder, *scenes):
    command = [sys.executable, "-B", SCRIPT, "--ssrlab", PROGRAM, "--out", folder, *scenes]
    return subprocess.run(command, capture_output=True, text=True)


class Pictures(unittest.TestCase):
    def test_they_show_the_radiance_at_the_exposure_of_the_camera(self):
        with tempfile.TemporaryDirectory() as folder:
            run = take(folder, "sky_only", "furnace_sphere")
            self.assertEqual(run.returncode, 0, run.stderr)
            # sRGB codes of (0.3, 0.5, 0.9), and of 1 at an exposure of -1.
            for scene, code in (("sky_only", (149, 188, 243)), ("furnace_sphere", (188, 188, 188))):
                picture = Image.open(Path(folder) / f"{scene}.png").convert("RGB")
                self.assertEqual((picture.size, picture.getpixel((2, 3))), ((320, 180), code), scene)

    def test_an_unknown_scene_is_an_error_that_names_it(self):
        with tempfile.TemporaryDirectory() as folder:
            run = take(folder, "fense")
        self.assertEqual(run.returncode, 2)
        self.assertIn("no scene named 'fense'", run.stderr)

    def test_what_cannot_be_written_is_a_fault_that_is_named(self):
        run = take("/proc/none", "sky_only")
        self.assertEqual((run.returncode, run.stderr.count("\n")), (3, 1), run.stderr)
        self.assertIn("/proc/none", run.stderr)


if __name__ == "__main__":
    unittest.main()
