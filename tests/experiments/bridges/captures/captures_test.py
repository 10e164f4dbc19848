"""Writing captures, and turning Blender's passes and engines' textures into layers: without Blender and RenderDoc.

usage: captures_test.py SSRLAB
"""

import contextlib
import io
import runpy
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

EXPERIMENTS = Path(__file__).resolve().parents[4] / "experiments"
sys.path[:0] = [str(EXPERIMENTS / "bridges/captures"), str(EXPERIMENTS / "python")]
from blender_passes import PANORAMA_CAMERA, camera_of, layers_of, with_previous  # noqa: E402
from capture_files import frame_folder, write_environment, write_exr, write_frame  # noqa: E402
from ssrlab.exr import read_exr_planes  # noqa: E402
from ssrlab.mistakes import ResultsError  # noqa: E402
from renderdoc_layers import camera_value, decoded, layer_of  # noqa: E402

SSRLAB = sys.argv.pop(1)
SIZE = (48, 27)  # pixels
NEAR, FAR = 0.5, 40.0  # m


def blender_camera(x, frame, height=2.0, yaw=0.0):
    """At (x, -6, height) of Blender's world, looking along +y, 30 degrees down, turned to the left by `yaw` (rad)."""
    angle = np.radians(60)
    rotation = np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])
    matrix = np.eye(4)
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    matrix[:3, :3], matrix[:3, 3] = turn @ rotation, (x, -6, height)
    f = 2.0  # cot of half the horizontal field of view
    projection = np.array([[f, 0, 0, 0], [0, f * SIZE[0] / SIZE[1], 0, 0],
                           [0, 0, -(FAR + NEAR) / (FAR - NEAR), -2 * FAR * NEAR / (FAR - NEAR)], [0, 0, -1, 0]])  # fmt: skip
    return matrix, projection, camera_of(matrix, projection, SIZE, NEAR, FAR, False, frame)


def in_pixels(points, matrix, projection):
    """Pixels, y up, of points of Blender's world: OpenGL's viewport."""
    clip = np.concatenate([points, np.ones(points.shape[:-1] + (1,))], axis=-1) @ (projection @ np.linalg.inv(matrix)).T
    return (clip[..., :2] / clip[..., 3:] * 0.5 + 0.5) * SIZE


def passes_of_ground(x, x_before, height_before=2.0):
    """What Blender renders of the ground, z = 0, up to 6 m away, and of the sky behind it."""
    matrix, projection, camera = blender_camera(x, 1)
    column, row = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    view = np.stack([(2 * column / SIZE[0] - 1) / projection[0, 0], (1 - 2 * row / SIZE[1]) / projection[1, 1],
                     np.full_like(row, -1.0)], axis=-1)  # fmt: skip
    direction = view @ matrix[:3, :3].T
    eye = matrix[:3, 3]
    with np.errstate(divide="ignore"):
        distance = -eye[2] / direction[..., 2:]  # along -z of the view, whose part is 1
    hit = (distance > 0) & (distance < 6)
    position = np.where(hit, eye + distance * direction, 0)
    before = blender_camera(x_before, 0, height_before)
    motion = in_pixels(position, *before[:2]) - in_pixels(position, matrix, projection)
    full = np.ones(hit.shape)
    passes = {
        "Depth": np.where(hit, distance, 1e10),
        "Position": position,
        "Normal": np.where(hit, (0.0, 0, 1), 0),
        "true_normal": np.where(hit, (0.0, 0, -2), 0),  # from behind, and not of unit length
        "Vector": np.concatenate([np.where(hit, motion, 0), np.zeros(hit.shape[:2] + (2,))], axis=-1),
        "IndexMA": 3 * full, "base_color": full * (0.5, 0.25, 1.5), "emission": full * (0.0, 0, 0),
        "roughness": 0.3 * full, "metallic": 0 * full, "specular": 0.25 * full,
    }  # fmt: skip
    return passes, hit[..., 0], distance[..., 0], camera, before[2]


class Things(dict):
    """As Blender has them: by name, and one after the other."""

    def __iter__(self):
        return iter(self.values())


class CapturesTest(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = Path(self.place.name) / "capture"

    def test_exr_comes_back_bit_by_bit(self):
        random = np.random.default_rng(1)
        planes = {f"layer_of_a_long_name_{i}.X": random.random((13, 7)).astype(np.float32) for i in range(3)}
        planes["smooth.Y"] = np.zeros((13, 7), np.float32)
        write_exr(self.folder.with_suffix(".exr"), planes)
        read = read_exr_planes(self.folder.with_suffix(".exr"))
        self.assertEqual(sorted(read), sorted(planes))
        for name, plane in planes.items():
            np.testing.assert_array_equal(read[name], plane)

    def test_layers_are_those_of_the_closed_form(self):
        passes, hit, distance, camera, before = passes_of_ground(0.2, 0.0)
        layers = layers_of(passes, camera, before)
        # Vulkan's standard depth of a distance along the view, from 0 at the near plane to 1 at the far one.
        expected = np.where(hit, FAR / (FAR - NEAR) * (1 - NEAR / np.where(hit, distance, 1)), 1)
        np.testing.assert_allclose(layers["depth"][..., 0], expected, atol=1e-9)
        for normal in ("normal", "geometric_normal"):
            np.testing.assert_allclose(layers[normal][hit], np.tile((0.0, 1, 0), (hit.sum(), 1)), atol=1e-12)
        # 0.2 m to the right, the ground moves to the left, by what 0.2 m are at its distance; the sky stays.
        np.testing.assert_allclose(layers["motion"][hit][:, 0], -0.2 / distance[hit], atol=1e-9)
        np.testing.assert_allclose(layers["motion"][hit][:, 1], 0, atol=1e-9)
        np.testing.assert_allclose(layers["motion"][~hit], 0, atol=1e-9)
        # From below, the ground moves down: the image is y down.
        passes, hit, _, camera, before = passes_of_ground(0.0, 0.0, 1.8)
        self.assertGreater(layers_of(passes, camera, before)["motion"][hit][:, 1].min(), 0)
        # Of a sky, what is in the middle now was before where a camera that is turned by `yaw` saw it.
        yaw, view_axis = 0.1, camera["view_from_world"][2, :3]
        matrix, projection, turned = blender_camera(0.0, 0, yaw=yaw)
        far_away = matrix[:3, 3] + 1e9 * np.array([-view_axis[0], view_axis[2], -view_axis[1]])
        pixels = in_pixels(far_away, matrix, projection) * (1, -1) + (0, SIZE[1])
        passes["Depth"][:] = 1e10
        motion = layers_of(passes, camera, turned)["motion"]
        middle = motion[SIZE[1] // 2, SIZE[0] // 2 - 1 : SIZE[0] // 2 + 1].mean(axis=0)
        np.testing.assert_allclose(middle, 0.5 - pixels / SIZE, atol=1e-3)  # half a pixel's difference of perspective
        self.assertGreater(np.abs(middle).max(), 0.05)
        self.assertEqual(set(np.unique(layers["specular"])), {0.0, 0.5})
        self.assertEqual(layers["base_color"].max(), 1.0)
        lit = {"DiffDir": np.full((27, 48, 3), 2.0), "DiffInd": np.full((27, 48, 3), 1.0),
               "DiffCol": np.full((27, 48, 3), 0.5), "Emit": np.zeros((27, 48, 3)), "Env": np.zeros((27, 48, 3))}  # fmt: skip
        self.assertEqual(layers_of(passes, camera, before, lit)["lit"].max(), 1.5)

    def test_a_sequence_is_one_that_ssrlab_finds_nothing_wrong_with(self):
        for frame in (1, 2):
            passes, _, _, camera, before = passes_of_ground(0.2 * frame, 0.2 * (frame - 1))
            lit = dict.fromkeys(("DiffDir", "DiffInd", "DiffCol", "Emit", "Env"), np.ones((27, 48, 3)))
            write_frame(frame_folder(self.folder, frame), layers_of(passes, camera, before, lit),
                        with_previous(camera, before))  # fmt: skip
        write_environment(self.folder, np.full((8, 16, 3), 0.5))
        said = subprocess.run([SSRLAB, "capture", self.folder], capture_output=True, text=True, check=True)
        self.assertIn("2 frames of 48x27, with a lit colour, with an environment", said.stdout)
        self.assertRegex(said.stdout, r"moving_pixels +[5-9]\d\.")
        self.assertNotIn("note:", said.stdout)

        passes["Vector"] = -passes["Vector"]
        layers = layers_of(passes, camera, before)
        layers["lit"] = layers["emission"]
        write_frame(self.folder / "frame_0002", layers, with_previous(camera, before))
        said = subprocess.run([SSRLAB, "capture", self.folder], capture_output=True, text=True, check=True)
        self.assertIn("they would fit, taken as before - now", said.stdout)

    def test_frames_are_written_through_no_link(self):
        outside = self.folder / "outside"
        outside.mkdir(parents=True)
        (self.folder / "frame_0003").symlink_to(outside)
        with self.assertRaisesRegex(ResultsError, "frame_0003 is a symbolic link"):
            frame_folder(self.folder, 3)
        (self.folder / "environment.json").symlink_to(outside / "other.json")
        write_environment(self.folder, np.full(3, 0.5))
        self.assertEqual(list(outside.iterdir()), [])

    def test_what_is_missing_or_unknown_is_said(self):
        passes, _, _, camera, before = passes_of_ground(0.0, 0.0)
        layers = layers_of(passes, camera, before)
        layers["rougness"] = layers.pop("roughness")
        with self.assertRaisesRegex(ResultsError, r"lacks the layers \['roughness'\]; does not know \['rougness'\]"):
            write_frame(self.folder, layers, camera)

    def test_blender_ends_with_the_codes_that_other_commands_have(self):
        def run(cameras, active, *arguments):
            things = {name: SimpleNamespace(name=name, type="CAMERA" if name in cameras else "MESH") for name in ("eye", "cube")}
            modules = {"bpy": SimpleNamespace(data=SimpleNamespace(objects=Things(things)), context=SimpleNamespace(scene=SimpleNamespace(camera=active))),
                       "mathutils": SimpleNamespace(Matrix=None)}  # fmt: skip
            said = io.StringIO()
            with mock.patch.dict(sys.modules, modules), mock.patch.object(sys, "argv", ["blender", "--", "--out", "o", *arguments]), \
                    contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as end:  # fmt: skip
                runpy.run_path(str(EXPERIMENTS / "bridges/captures/blender_export.py"), run_name="__main__")
            return end.exception.code, said.getvalue()

        self.assertEqual(run([], None), (2, "error: the scene has no camera: name one with --camera\n"))
        for name in ("ey", "cube"):
            self.assertEqual(run(["eye"], None, "--camera", name), (2, f"error: no camera is called '{name}'; known are: eye\n"))
        code, said = run(["eye"], "eye")
        self.assertEqual((code, said.count("\n")), (3, 1), "a fault of ours: there is no scene that Blender could render")

    def test_the_panorama_looks_where_environment_images_do(self):
        # Blender's +x in the middle, and a quarter to the right our +Z, which is Blender's -y.
        np.testing.assert_array_equal(-PANORAMA_CAMERA[:3, 2], (1, 0, 0))
        np.testing.assert_array_equal(PANORAMA_CAMERA[:3, 0], (0, -1, 0))
        np.testing.assert_array_equal(PANORAMA_CAMERA[:3, 1], (0, 0, 1))

    def test_texels_are_read_as_their_format_says(self):
        def first(data, *texture_format):
            return list(decoded(data, (1, 1), texture_format)[0, 0])

        self.assertEqual(first(np.array([1, 2], "<f2").tobytes(), "regular", "float", 2, 2), [1, 2])
        self.assertEqual(first(bytes([0, 255, 51, 255]), "bgra", "unorm", 1, 4), [0.2, 1, 0, 1])
        self.assertEqual(first(bytes([0x81, 127]), "regular", "snorm", 1, 2), [-1, 1])
        self.assertEqual(first(b"\xff\xff", "regular", "depth", 2, 1), [1])
        self.assertAlmostEqual(first(bytes([188, 0, 0, 128]), "regular", "srgb", 1, 4)[0], 0.5029, 4)  # IEC 61966-2-1
        self.assertEqual(first(bytes([188, 0, 0, 51]), "regular", "srgb", 1, 4)[3], 0.2)
        self.assertEqual(first(((3 << 30) | (1023 << 10)).to_bytes(4, "little"), "r10g10b10a2", "", 0, 0), [0, 1, 0, 1])
        # 3 is exponent 16 and half of the mantissa; 2^-15 is half of the smallest normal number.
        packed = 32 | (16 << 6 | 32) << 11 | (16 << 5) << 22
        self.assertEqual(first(packed.to_bytes(4, "little"), "r11g11b10", "", 0, 0), [2.0**-15, 3, 2])
        self.assertEqual(first(b"\xff\xff\xff\x07", "d24s8", "", 0, 0), [1])
        self.assertEqual(first(np.array([0.25, 9], "<f4").tobytes(), "d32s8", "", 0, 0), [0.25])
        with self.assertRaisesRegex(ResultsError, "layout 'BC7' are not read"):
            first(b"", "BC7", "", 0, 0)

    def test_rows_begin_at_the_top(self):
        # 2 x 3 texels, as the graphics interface stores them: OpenGL the lowest row first.
        rows = np.arange(6, dtype="<f4").reshape(3, 2)
        kinds = {name: SimpleNamespace(name=name) for name in ("Regular", "Float", "OpenGL", "Vulkan", "D3D11")}
        rd = SimpleNamespace(ResourceFormatType=SimpleNamespace(Regular=kinds["Regular"]), ResourceId=SimpleNamespace(Null=lambda: 0), Subresource=lambda *_: None)

        def texels(api, gl_state):
            with mock.patch.dict(sys.modules, {"renderdoc": rd}):
                export = runpy.run_path(str(EXPERIMENTS / "bridges/captures/renderdoc_export.py"))
            replay = object.__new__(export["Replay"])
            texel = SimpleNamespace(type=kinds["Regular"], compType=kinds["Float"], compByteWidth=4, compCount=1, BGRAOrder=lambda: False)
            replay.names, replay.textures = {7: "normals"}, {7: SimpleNamespace(width=2, height=3, format=texel)}
            replay.actions = [(SimpleNamespace(eventId=1, outputs=[7], depthOut=0), "draw")]
            replay.controller = SimpleNamespace(
                SetFrameEvent=lambda *_: None, GetTextureData=lambda *_: rows.tobytes(), GetGLPipelineState=lambda: gl_state,
                GetAPIProperties=lambda: SimpleNamespace(pipelineType=kinds[api]))  # fmt: skip
            return replay.texels({"texture": "normals"})[..., 0]

        origin = {is_low: SimpleNamespace(vertexProcessing=SimpleNamespace(clipOriginLowerLeft=is_low)) for is_low in (True, False)}
        np.testing.assert_array_equal(texels("OpenGL", origin[True]), rows[::-1])
        np.testing.assert_array_equal(texels("OpenGL", origin[False]), rows)
        np.testing.assert_array_equal(texels("Vulkan", None), rows)
        np.testing.assert_array_equal(texels("D3D11", None), rows)
        turned = layer_of("roughness", rows[..., None], {"decode": ["turn_rows"]}, {})
        np.testing.assert_array_equal(turned[..., 0], rows[::-1])

    def test_a_mapping_decodes_layers_and_matrices(self):
        _, _, camera = blender_camera(0.0, 0)

        def layer(name, texel, **entry):
            return layer_of(name, np.array(texel, float).reshape(1, 1, -1), entry, camera)[0, 0]

        for direction in ((0.6, 0, 0.8), (-0.36, 0.48, -0.8), (0, -1, 0)):
            n = np.array(direction)
            p = n / np.abs(n).sum()  # the octahedron; its lower half is folded outwards
            flat = p[:2] if p[2] >= 0 else (1 - np.abs(p[1::-1])) * np.where(p[:2] >= 0, 1, -1)
            np.testing.assert_allclose(layer("normal", (flat + 1) / 2, decode=["snorm", "octahedral"]), n, atol=1e-12)
        # The view looks 30 degrees down: its axis that points up leans forward.
        up = layer("normal", (0, 1, 0), decode=["view_to_world"])
        np.testing.assert_allclose(up, (0, np.cos(np.radians(30)), -0.5), atol=1e-12)
        roughness = layer("roughness", (0, 0, 0, 0.75), channels="A", decode=["one_minus", "square_root"])
        self.assertAlmostEqual(roughness[0], 0.5)
        np.testing.assert_allclose(layer("motion", (4.8, 2.7), decode=["pixels_to_uv", "y_up", "negate"]), (-0.1, 0.1))
        np.testing.assert_allclose(layer("normal", (1, 2, 3), decode=["z_up"]), (1, 3, -2))
        with self.assertRaisesRegex(ResultsError, "layer 'roughness': the texture has no channel A, only RG"):
            layer("roughness", (1, 1), channels="A")
        with self.assertRaisesRegex(ResultsError, "no decoder 'sgrb'"):
            layer("base_color", (1, 1, 1), decode=["sgrb"])

        matrix, projection, ours = blender_camera(0.3, 0)
        clip = camera_value("clip_from_view", projection.T, {"decode": ["transpose", "opengl_clip"]})
        np.testing.assert_allclose(clip, ours["clip_from_view"])
        view = camera_value("view_from_world", matrix, {"decode": ["inverse", "z_up"]})
        np.testing.assert_allclose(view, ours["view_from_world"], atol=1e-12)
        self.assertEqual(camera_value("far", np.array([[0.1, 50, 1, 0]]), {"component": 1}), 50)


if __name__ == "__main__":
    unittest.main(verbosity=1)
