"""The generated scenes: the same bytes each time, and what is in them, read back from the .glb files by other code than
that which wrote them. Counts, sizes, and cameras are those of the scenes' specification."""
import json
import math
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

SCENES = Path(__file__).parent.parent / "scenes"

# scene: triangles, materials, nodes
COUNTS = {
    "mirror_pillars": (2 + 25 * 12 + 40 * 8 * 2, 28, 27),
    "roughness_gradient": (24 * 2 + 25 * 12 + 16 * 4 * 2, 24 + 6 + 2, 24 + 25 + 1),
    "grazing": (2 + 8 * 12 + 80 * 8 * 2, 11, 10),
    "fence": (2 + (41 + 41) * (2 * 16 + 14) + 24 * 6 * 2, 5, 84),
    "floating_holes": (2 + 2 * 96 * 47 + 12 + 16 * 5 * 2, 5, 4),
    "offscreen_mirror": (2 + 2 + (7 + 4 + 2) * 12, 15, 15),
    "curved_mirror": (2 * 192 * 95 + 16 * 16 * 2 + 10 * 12, 13, 12),
    "facing_mirrors": (3 * 2 + 2 + 3 * 12 + 2 * 96 * 47, 6, 8),
    "axis_parallel": (4 * 2 + 6 * 6 * 2 + 24 * 8 * 2, 5, 6),
    "depth_range": (6 * (2 + 12), 7, 12),
    "firefly": (3 * 2 + 3 * 2 + 16 * 4 * 2, 6, 7),
    "firefly_moving": (3 * 2 + 3 * 2 + 16 * 4 * 2, 6, 7),
    "contact_hardening": (3 * 2 + 12 * 12, 5, 15),
    "glossy_stretch": (4 * 2 + 8 * 2 * 48 * 23 + 24 * 4 * 2, 7, 13),
    "metal_corner": (8 * 2 + 7 * 12 + 24 * 4 * 2, 4 + 4 + 7 + 2, 8 + 7 + 1),
    "normal_mapped": (3 * 2 + 7 * 12 + 20 * 6 * 2, 12, 11),
    "hidden_faces": (2 + 6 * 12 + 2 * 48 * 23 + 8 * 5 * 2 + 2 * 2 + 4 * 32 * 1 + 2 * 32 + 5 * 2 + 2, 13, 21),
    "corridor": (2 + 2 * 32 * 3 * 2 + 6 * 6 * 2 + 8 * (2 * 16 + 14), 13, 12),
    "dark_room": (3 * 2 + 8 * 2 + 4 * 12, 8, 15),
    "curved_metal": (24 * 20 * 2 + 3 * (2 * 48 + 46) + 3 * 2 * 48 + 2 * 12 * 7 + 7 * 12 + 12 * 4 * 2, 15, 16),
    "roughness_steps": (5 * 2 + 6 * 24 * 2 + 60 * 64 * 2 + 2 + 24 * 2 + 21 * 12 + 16 * 4 * 2, 39, 54),
    "rails": (2 + 10 * 12 + 2 + 34 * (2 * 8 + 6) + 6 * 12 + 24 * 8 * 2, 6, 53),
    "all_rough": (2 + 12 * 12, 13, 13),
    "all_rough_mirror_tile": (2 + 12 * 12 + 2, 14, 14),
    "sky_only": (0, 0, 0),
    "furnace": (12 * 2 * 64 * 31 + 2, 13, 13),
    "furnace_sphere": (2 * 64 * 31, 1, 1),
    "disocclusion": (2 + 12 + 40 * 10 * 2, 14, 3),
    "disocclusion_moving_column": (2 + 12 + 40 * 10 * 2, 14, 3),
    "moving_objects": (2 + 12 + 2 * 96 * 47 + 12 + 32 * 8 * 2, 5, 5),
    "border_crossing": (2 + 9 * 12 + 2, 11, 11),
    "passing_pillars": (3 * 2 + (7 + 13 + 21) * 12 + 50 * 6 * 2, 8, 3 + 41 + 1),
    "moving_emitter": (3 * 2 + 3 * 12 + 32 * 7 * 2, 6, 7),
    "stepping_emitter": (3 * 2 + 3 * 12 + 32 * 7 * 2, 6, 7),
    "thin_pole": (3 * 2 + 3 * 12 + 16 * 4 * 2, 6, 3 + 3 + 1),
    "rotating_mirror": (2 + 3 * 64 + 9 * 12 + 32 * 8 * 2, 15, 14),
}

# scene/camera: position, target, vertical field of view in degrees
CAMERAS = {
    "mirror_pillars/main": ((0, 1.6, 6), (0, 1, -8), 50),
    "roughness_gradient/main": ((0, 1.5, 5), (0, 0.6, -4), 55),
    "grazing/y5cm": ((0, 0.05, 0), (0, 0.04, -10), 40),
    "grazing/y5mm": ((0, 0.005, 0), (0, 0.0045, -10), 40),
    "fence/main": ((0, 1.2, 2), (0, 0.5, -4), 40),
    "floating_holes/main": ((0, 2.2, 2.5), (0, 0.9, -3), 45),
    "offscreen_mirror/main": ((0, 1.5, 2), (0, 1.4, -4), 45),
    "facing_mirrors/yaw15": ((0, 1.5, 1), (-1.6, 1.3, -5), 60),
    "facing_mirrors/frontal": ((0, 1.5, 1), (0, 1.5, -7), 60),
    "curved_mirror/main": ((0, 1.6, 1.5), (0, 0.9, -4), 40),
    "firefly/main": ((0, 1.5, 4), (0, 0.4, -3), 50),
    "depth_range/main": ((0, 0, 0), (0, -0.2, -1), 40),
    "normal_mapped/main": ((0, 1.4, 5), (0, 0.6, -5), 45),
    "contact_hardening/main": ((0, 1.3, 3), (0, 0.3, -2.2), 45),
    "metal_corner/main": ((0, 1.5, 3), (1.2, 0.5, -3), 50),
    "axis_parallel/tele": ((0, 1, 60), (0, 1, -5), 3.8),
    "axis_parallel/persp": ((0, 1, 2), (0, 1, -5), 45),
    "glossy_stretch/pitch3": ((0, 0.9, 3), (0, 0.45, -6), 40),
    "glossy_stretch/pitch10": ((0, 2, 3), (0, 0.4, -6), 40),
    "glossy_stretch/pitch30": ((0, 6, 2), (0, 0, -8), 40),
    "disocclusion/main": ((-1, 1.5, 2), (0, 0.8, -4), 45),
    "moving_objects/main": ((0, 1.6, 2.5), (0, 0.6, -3.5), 45),
    "border_crossing/main": ((0, 1.2, 2), (0, -0.3, -3), 40),
    "passing_pillars/main": ((0, 0.5, 0), (0, -0.4, -10), 55),
    "moving_emitter/main": ((0, 1.4, 2.5), (0, 0.2, -4), 45),
    "stepping_emitter/main": ((0, 1.4, 2.5), (0, 0.2, -4), 45),
    "thin_pole/main": ((0, 1.4, 2.5), (0, 0.2, -3), 45),
    "rotating_mirror/main": ((0, 2.2, 3.6), (0, 1, -1.6), 45),
    "hidden_faces/main": ((0, 2.6, 3), (0, 0.5, -3), 48),
    "corridor/main": ((0, 1.4, 2), (0, 0.8, -6), 45),
    "corridor/wide": ((0, 0.2, 0), (0, -0.9, -1.2), 100),
    "dark_room/main": ((0, 1.6, 2.5), (0, 0.5, -4), 50),
    "curved_metal/main": ((0, 1.7, 3.4), (-0.3, 0.7, -2.5), 48),
    "roughness_steps/main": ((0, 1.5, 4), (0, 0.3, -3), 50),
    "rails/main": ((0, 1.3, 2.5), (0, 0.3, -2.5), 45),
    "all_rough/main": ((0, 1.6, 4), (0, 0.8, -5), 50),
    "furnace/main": ((0, 1.7, 3), (0, 1.3, -5), 50),
}


class Glb:
    def __init__(self, file):
        data = file.read_bytes()
        magic, version, length, json_length = struct.unpack_from("<4sIII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data)), f"{file}: header"
        self.gltf = json.loads(data[20:20 + json_length])
        self.binary = data[28 + json_length:]

    def read(self, index):
        accessor = self.gltf["accessors"][index]
        view = self.gltf["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        code = {5126: "f", 5123: "H"}[accessor["componentType"]]
        values = struct.unpack_from(f"<{accessor['count'] * width}{code}", self.binary, view["byteOffset"])
        return [values[i:i + width] for i in range(0, len(values), width)] if width > 1 else values

    def drawn(self):
        """(node, primitive) for all that is drawn; every node is a root here."""
        for node in self.gltf.get("nodes", []):
            for primitive in self.gltf["meshes"][node["mesh"]]["primitives"]:
                yield node, primitive

    def triangles(self):
        return sum(self.gltf["accessors"][p["indices"]]["count"] // 3 for _, p in self.drawn())

    def nodes_of(self, material):
        """Places of the nodes which draw the material of that name."""
        names = [m["name"] for m in self.gltf["materials"]]
        return [node["translation"] for node, p in self.drawn() if names[p["material"]] == material]


def description(scene):
    return json.loads((SCENES / scene / "scene.json").read_text())


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Deterministic(unittest.TestCase):
    def test_the_committed_files_are_what_the_generator_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            # Python seeds its hashes anew in each process, so this run differs in them from the one that was committed.
            subprocess.run([sys.executable, "-B", SCENES / "generate.py", "--out", folder], check=True)
            written = {file.relative_to(folder): file.read_bytes() for file in Path(folder).rglob("*.*")}
        for name, data in written.items():
            self.assertEqual((SCENES / name).read_bytes(), data, f"{name} is not what scenes/generate.py writes")
        committed = {file.relative_to(SCENES) for file in SCENES.glob("*/scene.glb")}
        self.assertEqual(committed, {name for name in written if name.suffix == ".glb"})

    def test_an_unknown_scene_is_an_error_that_names_it(self):
        run = subprocess.run([sys.executable, SCENES / "generate.py", "fense"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertIn("no scene named 'fense'", run.stderr)

    def test_what_cannot_be_written_is_a_fault_that_is_named(self):
        command = [sys.executable, "-B", SCENES / "generate.py", "--out", "/proc/none", "fence"]
        run = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr.count("\n")), (3, 1), run.stderr)
        self.assertIn("/proc/none", run.stderr)


class Structure(unittest.TestCase):
    def test_counts(self):
        for scene, counts in COUNTS.items():
            glb = Glb(SCENES / scene / "scene.glb")
            found = (glb.triangles(), len(glb.gltf.get("materials", [])), len(glb.gltf.get("nodes", [])))
            self.assertEqual(found, counts, scene)

    def test_all_files_together_stay_small(self):
        self.assertLess(sum(file.stat().st_size for file in SCENES.glob("*/*")), 6_000_000)

    def test_faces_turn_the_way_of_their_unit_normals(self):
        for scene in COUNTS:
            glb = Glb(SCENES / scene / "scene.glb")
            for node, primitive in glb.drawn():
                positions = glb.read(primitive["attributes"]["POSITION"])
                normals = glb.read(primitive["attributes"]["NORMAL"])
                self.assertTrue(all(abs(math.hypot(*n) - 1) < 1e-6 for n in normals), f"{scene}: {node['name']}")
                indices = glb.read(primitive["indices"])
                for i in range(0, len(indices), 3):
                    a, b, c = (positions[k] for k in indices[i:i + 3])
                    face = cross(minus(b, a), minus(c, a))
                    agrees = all(dot(face, normals[k]) > 0 for k in indices[i:i + 3])
                    self.assertTrue(agrees, f"{scene}: {node['name']}")

    def test_what_shines_neither_scatters_nor_reflects(self):
        for scene in COUNTS:
            for material in Glb(SCENES / scene / "scene.glb").gltf.get("materials", []):
                if "emissiveFactor" in material:
                    pbr = material["pbrMetallicRoughness"]
                    self.assertEqual((pbr["baseColorFactor"][:3], pbr["metallicFactor"]), ([0, 0, 0], 0))
                    self.assertEqual(material["extensions"]["KHR_materials_specular"], {"specularFactor": 0})
                    self.assertLessEqual(max(material["emissiveFactor"]), 1)

    def test_places(self):
        pillars = Glb(SCENES / "mirror_pillars/scene.glb")
        places = [pillars.nodes_of(f"pillar{i:02}") for i in range(25)]
        self.assertEqual(sorted(p for (p,) in places),
                         sorted([x, 1.5, z] for x in (-6, -3, 0, 3, 6) for z in (-2, -5, -8, -11, -14)))
        fence = Glb(SCENES / "fence/scene.glb")
        for material, first, z in (("pole", -2, -3), ("wire", -1.95, -2)):
            places = fence.nodes_of(material)
            self.assertEqual(len(places), 41)
            for i, place in enumerate(places):
                self.assertAlmostEqual(place[0], first + 0.1 * i)
                self.assertEqual(place[1:], [0, z])
        passing = Glb(SCENES / "passing_pillars/scene.glb")
        for distance, count in ((2, 7), (10, 13), (50, 21)):
            places = passing.nodes_of(f"pillar_{distance}m")
            self.assertEqual((len(places), {z for _, _, z in places}), (count, {-distance}))
            self.assertIn(0, [x for x, _, _ in places])

    def test_mirrors_of_axis_parallel_turn_view_rays_along_the_axes(self):
        glb = Glb(SCENES / "axis_parallel/scene.glb")
        reflected = {}
        for node, primitive in glb.drawn():
            n = glb.read(primitive["attributes"]["NORMAL"])[0]
            reflected[node["name"]] = [d - 2 * dot((0, 0, -1), n) * k for d, k in zip((0, 0, -1), n)]
        for name, direction in (("mirror_to_x", (1, 0, 0)), ("mirror_back", (0, 0, 1)), ("mirror_down", (0, -1, 0))):
            # A float32 normal at 45 degrees is off by up to 3e-8 per component.
            self.assertLess(math.dist(reflected[name], direction), 2e-7, name)

    def test_animations_run_as_long_as_their_scenes(self):
        for scene in ("firefly_moving", "disocclusion_moving_column", "moving_objects", "moving_emitter",
                      "thin_pole", "rotating_mirror"):
            glb, scene_json = Glb(SCENES / scene / "scene.glb"), description(scene)
            (animation,) = glb.gltf["animations"]
            last = (scene_json["frame_count"] - 1) / scene_json["frame_rate"]
            for sampler in animation["samplers"]:
                self.assertGreaterEqual(glb.gltf["accessors"][sampler["input"]]["max"][0], last - 1e-6)

    def test_lamps_of_stepping_emitter_stand_before_and_after_one_frame(self):
        glb, scene_json = Glb(SCENES / "stepping_emitter/scene.glb"), description("stepping_emitter")
        (animation,) = glb.gltf["animations"]
        self.assertEqual(len(animation["samplers"]), 3)
        for sampler in animation["samplers"]:
            self.assertEqual(sampler["interpolation"], "STEP")
            start, step = glb.read(sampler["input"])
            self.assertEqual((start, step * scene_json["frame_rate"]), (0, 30))
            before, after = glb.read(sampler["output"])
            self.assertAlmostEqual(after[0] - before[0], 1.2, places=6)  # float32
            self.assertEqual(after[1:], before[1:])

    def test_poles_of_thin_pole_are_one_to_two_pixels_wide_and_move_less_than_one(self):
        (camera,) = description("thin_pole")["cameras"]
        glb = Glb(SCENES / "thin_pole/scene.glb")
        pixels_per_radian = 90 / math.tan(math.radians(camera["vfov_deg"] / 2))  # of an image 180 high
        # All stand at z = -3, within 1 pixel in 10 of the depth along the view.
        distance = camera["position"][2] + 3
        widths = [2 * node["scale"][0] for node in glb.gltf["nodes"] if node["name"].startswith("pole")]
        self.assertEqual(len(widths), 3)
        for width in widths:
            self.assertTrue(1 < width * pixels_per_radian / distance < 2)
        (animation,) = glb.gltf["animations"]
        for sampler in animation["samplers"]:
            start, end = glb.read(sampler["output"])
            self.assertAlmostEqual(end[0] - start[0], 1, places=6)  # float32
            self.assertTrue(0.5 < 1 / 59 * pixels_per_radian / distance < 1)

    def test_floor_and_wall_of_metal_corner_touch_and_differ_in_roughness(self):
        glb = Glb(SCENES / "metal_corner/scene.glb")
        roughness = {m["name"]: m["pbrMetallicRoughness"].get("roughnessFactor") for m in glb.gltf["materials"]}
        names = [m["name"] for m in glb.gltf["materials"]]
        parts = {}
        for node, primitive in glb.drawn():
            if node["name"][:-1] in ("floor", "wall"):
                points = glb.read(primitive["attributes"]["POSITION"])
                parts[node["name"]] = (points, roughness[names[primitive["material"]]])
        for i in range(4):
            (on_floor, floor_roughness), (on_wall, wall_roughness) = parts[f"floor{i}"], parts[f"wall{i}"]
            self.assertEqual({p for p in on_floor if p[0] == 2}, {p for p in on_wall if p[1] == 0})
            self.assertGreater(abs(floor_roughness - wall_roughness), 0.2)

    def test_normal_maps_hold_unit_vectors(self):
        for scene, size in (("normal_mapped", (360, 560)), ("rails", (128, 128))):
            glb = Glb(SCENES / scene / "scene.glb")
            view = glb.gltf["bufferViews"][glb.gltf["images"][0]["bufferView"]]
            png = glb.binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
            width, height, texels = decode_png(png)
            self.assertEqual((width, height), size)
            for i in range(0, len(texels), 3):
                # 8 bits: each component is off by at most 1 / 255.
                self.assertLess(abs(math.hypot(*(c / 127.5 - 1 for c in texels[i:i + 3])) - 1), math.sqrt(3) / 255)

    def test_roughness_steps_crosses_the_cut_offs_in_small_steps(self):
        materials = Glb(SCENES / "roughness_steps/scene.glb").gltf["materials"]
        ramp = [m["pbrMetallicRoughness"]["roughnessFactor"] for m in materials if m["name"].startswith("ramp_")]
        self.assertEqual(ramp, sorted(ramp))
        self.assertTrue(ramp[0] < 0.6 and ramp[-1] > 0.7)
        self.assertLess(max(b - a for a, b in zip(ramp, ramp[1:])), 0.021)


def decode_png(png):
    """Width, height, and bytes of an 8-bit RGB PNG whose rows are not filtered."""
    width, height = struct.unpack_from(">II", png, 16)
    data, at = b"", 8
    while at < len(png):
        length, kind = struct.unpack_from(">I4s", png, at)
        body = png[at + 8:at + 8 + length]
        assert struct.unpack_from(">I", png, at + 8 + length)[0] == zlib.crc32(kind + body), "CRC"
        data += body if kind == b"IDAT" else b""
        at += 12 + length
    rows = zlib.decompress(data)
    stride = 3 * width + 1
    assert all(rows[j * stride] == 0 for j in range(height))
    return width, height, b"".join(rows[j * stride + 1:(j + 1) * stride] for j in range(height))


class Cameras(unittest.TestCase):
    def test_still_cameras(self):
        for name, (position, target, vfov) in CAMERAS.items():
            scene, camera_name = name.split("/")
            (camera,) = [c for c in description(scene)["cameras"] if c["name"] == camera_name]
            found = (camera["position"], camera["target"], camera["vfov_deg"])
            self.assertEqual(found, ([*position], [*target], vfov), name)

    def path(self, scene, name):
        (camera,) = [c for c in description(scene)["cameras"] if c["name"] == name]
        self.assertEqual((camera["path"][0]["frame"], camera["path"][-1]["frame"]), (0, camera["frames"] - 1))
        return camera["frames"], camera["path"]

    def test_straight_paths(self):
        for scene, name, frames, offset in (("mirror_pillars", "dolly", 120, (0, 0, -4)),
                                            ("fence", "lateral", 60, (0.2, 0, 0)),
                                            ("disocclusion", "lateral", 60, (2, 0, 0)),
                                            ("passing_pillars", "lateral", 60, (2.4, 0, 0)),
                                            ("corridor", "dolly", 60, (0, 0, -8)),
                                            ("curved_metal", "lateral", 60, (2.4, 0, 0))):
            found, keys = self.path(scene, name)
            self.assertEqual(found, frames)
            self.assertEqual(minus(keys[-1]["position"], keys[0]["position"]), [*offset])

    def test_orbits_keep_their_distance_and_height(self):
        for scene in ("floating_holes", "curved_mirror"):
            frames, keys = self.path(scene, "orbit")
            main = description(scene)["cameras"][0]
            arms = [minus(key["position"], main["target"]) for key in keys]
            for arm in arms:
                # Positions are rounded to 7 digits.
                self.assertAlmostEqual(math.hypot(*arm), math.dist(main["position"], main["target"]), places=5)
            angle = math.degrees(math.atan2(arms[-1][0], arms[-1][2]) - math.atan2(arms[0][0], arms[0][2]))
            self.assertAlmostEqual(angle, 20, places=4)

    def test_pitch_of_border_crossing(self):
        frames, keys = self.path("border_crossing", "pitch")
        directions = [minus(key["target"], key["position"]) for key in keys]
        pitches = [math.degrees(math.atan2(y, -z)) for _, y, z in directions]
        self.assertEqual(frames, 120)
        self.assertAlmostEqual(max(pitches) - pitches[0], 10, places=4)
        self.assertAlmostEqual(min(pitches) - pitches[0], -10, places=4)
        self.assertAlmostEqual(pitches[-1], pitches[0], places=4)

    def test_sub_pixel_turns_of_rails_spread_over_a_pixel(self):
        frames, keys = self.path("rails", "sub_pixel")
        self.assertEqual((frames, [key["frame"] for key in keys]), (8, [*range(8)]))
        main = description("rails")["cameras"][0]
        forward = minus(main["target"], main["position"])
        right, up = (1, 0, 0), (0, -forward[2], forward[1])
        pixels_per_radian = 90 / math.tan(math.radians(main["vfov_deg"] / 2))  # of an image 180 high
        places = []
        for key in keys:
            self.assertEqual(key["position"], main["position"])
            way = minus(key["target"], key["position"])
            depth = dot(way, forward) / math.hypot(*forward)
            places.append([pixels_per_radian * dot(way, axis) / math.hypot(*axis) / depth for axis in (right, up)])
        for axis in range(2):
            values = sorted(place[axis] for place in places)
            self.assertTrue(-0.5 < values[0] < -0.3 and 0.3 < values[-1] < 0.5, values)

    def test_yaw_of_passing_pillars(self):
        frames, keys = self.path("passing_pillars", "yaw")
        self.assertEqual(frames, 60)
        self.assertEqual({(*key["position"],) for key in keys}, {(0, 0.5, 0)})
        directions = [minus(key["target"], key["position"]) for key in keys]
        turns = [math.degrees(math.atan2(x, -z)) for x, _, z in directions]
        for before, after in zip(turns, turns[1:]):
            self.assertAlmostEqual(after - before, 2, places=4)
        self.assertAlmostEqual(turns[0], -15, places=4)
        self.assertAlmostEqual(turns[-1], 15, places=4)


if __name__ == "__main__":
    unittest.main()
