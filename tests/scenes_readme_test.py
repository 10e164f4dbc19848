"""What scenes/README.md promises: a scene and a camera for each artefact, and for each scene what it tests and a picture."""
import json
import re
import struct
import unittest
from pathlib import Path

SCENES = Path(__file__).parent.parent / "scenes"
README = (SCENES / "README.md").read_text(encoding="utf-8")
NAMES = sorted(file.parent.name for file in SCENES.glob("*/scene.json"))
NOT_SHOWN = {"sponza", "sponza_gallery", "sponza_wet"}  # their files' licence is in doubt


def cameras_of(scene):
    return [camera["name"] for camera in json.loads((SCENES / scene / "scene.json").read_text())["cameras"]]


class Artefacts(unittest.TestCase):
    def test_each_has_a_row_with_scenes_and_cameras_that_exist(self):
        rows = re.findall(r"^\| (A\d+) ([^|]+)\| ([^|]+)\| ([^|]+)\| ([^|]+)\|$", README, re.MULTILINE)
        self.assertEqual([number for number, *_ in rows], [f"A{i}" for i in range(1, 27)])
        for number, artefact, places, look, switch in rows:
            found = re.findall(r"`(\w+)/(\w+)`", places)
            self.assertTrue(found, f"{number} names no `scene/camera`")
            for scene, camera in found:
                self.assertIn(scene, NAMES, number)
                self.assertIn(camera, cameras_of(scene), f"{number}: {scene}")
            for text in (artefact, look, switch):
                self.assertGreater(len(text.strip()), 3, number)


class About(unittest.TestCase):
    def test_each_scene_says_in_a_sentence_what_it_tests(self):
        for scene in NAMES:
            about = (SCENES / scene / "about.txt").read_text(encoding="utf-8")
            # 150 letters: with the name before it, a line of `ssrlab list scenes` stays below 180.
            self.assertRegex(about, r"\A[A-Z][^\n|]{20,148}\.\n\Z", scene)


class Pictures(unittest.TestCase):
    def test_each_scene_but_those_in_doubt_has_one(self):
        files = sorted(SCENES.glob("pictures/*"))
        self.assertEqual([file.stem for file in files], [scene for scene in NAMES if scene not in NOT_SHOWN])
        for file in files:
            data = file.read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n", file)
            self.assertEqual(struct.unpack_from(">II", data, 16), (320, 180), file)

    def test_they_stay_below_a_megabyte(self):
        self.assertLess(sum(file.stat().st_size for file in SCENES.glob("pictures/*")), 1_000_000)


if __name__ == "__main__":
    unittest.main()
