"""room:N and street:N: the same bytes each time, rules that hold, and tables that say what is drawn."""
import hashlib
import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
SCENES = Path(__file__).parent.parent / "scenes"
sys.path.insert(0, str(SCENES))
from generator.families import densities, dice, rays, refusals, tables  # noqa: E402
from generator.families.dice import Dice  # noqa: E402
from generator.families.layout import overlaps  # noqa: E402
from generator.families.rooms import Room  # noqa: E402
from generator.families.streets import Street  # noqa: E402

ROOMS, STREETS = range(100, 104), range(100, 101)


def generate(*arguments, **environment):
    return subprocess.run([sys.executable, "-B", SCENES / "generate.py", *arguments], capture_output=True, text=True,
                          env=os.environ | environment)


class Files(unittest.TestCase):
    def test_a_number_gives_the_same_bytes_each_time(self):
        digests = []
        for seed in ("1", "2"):  # the order of sets and hashes differs
            with tempfile.TemporaryDirectory() as folder:
                run = generate("--out", folder, "room:1", PYTHONHASHSEED=seed)
                self.assertEqual(run.returncode, 0, run.stderr)
                files = sorted(Path(folder).glob("room_1/*"))
                self.assertIn("scene.json", [file.name for file in files])
                digests.append([hashlib.sha256(file.read_bytes()).hexdigest() for file in files])
                if seed == "1":
                    self.check(Path(folder) / "room_1")
        self.assertEqual(digests[0], digests[1])

    def check(self, folder):
        data = (folder / "scene.glb").read_bytes()
        length, = struct.unpack_from("<I", data, 12)
        gltf, scene = json.loads(data[20:20 + length]), json.loads((folder / "scene.json").read_text())
        self.assertEqual([camera["name"] for camera in scene["cameras"]], ["main", "path"])
        self.assertEqual([camera["frames"] for camera in scene["cameras"]], [40, 40])
        self.assertTrue(any("normalTexture" in material for material in gltf["materials"]))
        self.assertTrue(any("metallicRoughnessTexture" in material["pbrMetallicRoughness"]
                            for material in gltf["materials"]))

    def test_names_that_are_no_scene_are_refused(self):
        for name in ("room:-1", "room:1000000", "room:x", "room:", "hall:1", "room:1.5"):
            with tempfile.TemporaryDirectory() as folder:
                run = generate("--out", folder, "--", name)
                self.assertEqual((run.returncode, list(Path(folder).iterdir())), (2, []), name)
                self.assertIn(f"no scene named '{name}'", run.stderr)

    def test_a_folder_that_cannot_be_written_is_named(self):
        with tempfile.NamedTemporaryFile() as file:
            run = generate("--out", file.name, "fence")
        self.assertEqual(run.returncode, 3)
        self.assertRegex(run.stderr, f"cannot write .*{file.name}")
        self.assertNotIn("Traceback", run.stderr)


class Rules(unittest.TestCase):
    """Of what was drawn, not of the estimates that refused: other code than that of the rules where there is some."""

    @classmethod
    def setUpClass(cls):
        cls.rooms = [refusals.first_accepted(f"room:{number}", Room)[0] for number in ROOMS]
        cls.streets = [refusals.first_accepted(f"street:{number}", Street)[0] for number in STREETS]

    def test_rooms_hold_10_to_80_objects_none_in_another(self):
        for room in self.rooms:
            self.assertTrue(10 <= len(room.things) <= 80, room.dice.name)
            # Lamps hang from ceilings and things stand on tops: only what stands on the floor is compared.
            standing = [place for place in room.layout.places if place.y == 0 and "chair" not in place.thing.name and
                        place.thing.name not in ("computer",)]
            for i, a in enumerate(standing):
                for b in standing[:i]:
                    self.assertFalse(overlaps((a.low, a.high), (b.low, b.high), -0.01),
                                     f"{room.dice.name}: {a.thing.name} in {b.thing.name}")

    def test_rooms_are_closed_but_for_windows(self):
        for room in self.rooms:
            directions = Dice("directions")
            for _ in range(300):
                direction = tuple(directions.uniform(-1, 1) for _ in range(3))
                hit = rays.hit_shell(room.plan, room.surfaces, room.view.eye, direction)
                self.assertIsNotNone(hit, f"{room.dice.name}: {direction}")

    def test_surfaces_of_the_shell_meet(self):
        """Walls reach beyond floor and ceiling, and their panels cover all but the windows."""
        from generator.families.shell import surfaces
        for room in self.rooms:
            ground, roof, *walls = surfaces(room.plan, *room.surfaces)
            self.assertLess(max(p[1] for p in ground.merged()[0].positions), 1e-9)
            for wall, thing in zip(room.plan.walls, walls):
                positions = thing.merged()[0].positions
                inner = [p for p in positions if abs((p[0] - wall.start[0]) * wall.inward[0] +
                                                     (p[2] - wall.start[1]) * wall.inward[1]) < 1e-9]
                self.assertEqual((min(p[1] for p in inner), max(p[1] for p in inner)), (-0.05, room.plan.height + 0.05))
                # The area of the panels is that of the wall less its windows.
                shape, area = thing.merged()[0], 0.0
                for part in shape.parts:
                    for k in range(0, len(part), 3):
                        a, b, c = (shape.positions[i] for i in part[k:k + 3])
                        normal = shape.normals[part[k]]
                        if abs(normal[0] * wall.inward[0] + normal[2] * wall.inward[1]) < 0.5:
                            continue  # a reveal
                        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
                        cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                        area += sum(x * x for x in cross) ** 0.5 / 2
                length = wall.length + 0.05 * (wall.before_convex + wall.after_convex)
                windows = sum((w.right - w.left) * (w.head - w.sill) for w in wall.windows)
                self.assertAlmostEqual(area, length * (room.plan.height + 0.1) - windows, places=6)

    def test_cameras_stand_free_at_the_height_of_eyes(self):
        for scene in self.rooms + self.streets:
            for eye, _ in [(scene.view.eye, 0), *scene.path]:
                self.assertTrue(0.9 <= eye[1] <= 1.9, scene.dice.name)
                for place in scene.things:
                    self.assertFalse(all(low < c < high for low, c, high in zip(place.low, eye, place.high)),
                                     f"{scene.dice.name}: in {place.thing.name}")
        for room in self.rooms:
            x, _, z = room.view.eye
            self.assertTrue(room.plan.contains(x, x, z, z, 0.3), room.dice.name)

    def test_a_draw_against_a_rule_is_refused_and_the_next_taken(self):
        def draw(name):
            if name != "x/2":
                raise refusals.Refused("rough")
            return name

        self.assertEqual(refusals.first_accepted("x", draw), ("x/2", ["rough", "rough"]))
        with self.assertRaises(refusals.Refused) as refused:
            refusals.judge_objects(9)
        self.assertEqual(refused.exception.rule, "objects")


class Densities(unittest.TestCase):
    def test_draws_follow_them(self):
        stream, count = Dice("densities"), 2000
        heights = sorted(stream.draw(densities.HEIGHT) for _ in range(count))
        self.assertAlmostEqual(heights[count // 2], densities.HEIGHT.values[2], delta=0.02)
        kinds = [stream.draw(densities.KIND) for _ in range(count)]
        for kind, share in densities.KIND.values.items():
            self.assertAlmostEqual(kinds.count(kind) / count, share, delta=0.04)
        self.assertEqual(Dice("a").about("b").uniform(), Dice("a/b").uniform())

    def test_the_page_states_all_of_them(self):
        page = (SCENES / "rooms.md").read_text(encoding="utf-8")
        self.assertEqual(tables.filled(page), page, "run scenes/generate.py --fill scenes/rooms.md")
        for density in dice.TABLE:
            self.assertIn(f"\n| {density.what} | {density.text()} |", page)


if __name__ == "__main__":
    unittest.main()
