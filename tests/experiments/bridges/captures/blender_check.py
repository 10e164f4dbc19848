"""Exports a scene that Blender and ssrlab both draw, and compares the layers. Needs Blender; takes a minute, so it
is no part of the suite.

usage: blender_check.py SSRLAB [FOLDER]      FOLDER keeps both captures

Scenes are our glTFs, by Blender's importer: one in which two objects move, one in which the camera does. A row of materials
(blender_materials.py) has values in closed form: with Blender 4 and 5 it has shaders of theirs, too.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "experiments" / "python"))
from ssrlab.exr import read_exr_planes  # noqa: E402

SCENES = (("moving_objects", "main"), ("disocclusion", "lateral"))  # and the camera
SIZE = (192, 108)
FRAMES = (3, 4)
# Greatest difference of 98 % of the pixels: at edges both may draw other surfaces, and Blender blends the four
# numbers of a rotation between keys.
# Depths, positions and motion go through float32 in both; normals of balls are interpolated by other formulas.
BOUNDS = {"depth": 2e-6, "normal": 2e-3, "geometric_normal": 1e-4, "base_color": 1e-6, "roughness": 1e-6,
          "metalness": 1e-6, "emission": 1e-6, "motion": 1e-6}  # fmt: skip
MOTION_BOUND = 1e-2  # pixels, of 95 % of those that move and that both see


def run(command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0 or "Traceback" in done.stdout + done.stderr:
        raise SystemExit(f"{command[0]} failed:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def layer(planes, name):
    channels = [planes[p] for p in sorted(planes) if p.rpartition(".")[0] == name]
    return np.stack(channels, axis=-1)


def environment_error(capture):
    """Greatest difference to the world that blender_scene.py makes: by ssrlab's mapping (core/shared/environment.h)."""
    planes = read_exr_planes(capture / "environment.exr")
    height, width = planes["R"].shape
    polar, azimuth = np.meshgrid((np.arange(height) + 0.5) / height * np.pi,
                                 ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi, indexing="ij")  # fmt: skip
    x, y, z = np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)
    return max(np.abs(planes[c] - (v + 1) / 2).max() for c, v in (("R", x), ("G", -z), ("B", y)))


def check(ssrlab, name, camera, place):
    """What is wrong, as sentences; prints how far both are apart."""
    ours, theirs = place / "ours", place / "theirs"
    run([ssrlab, "gbuffer", name, "--camera", camera, "--size", *SIZE, "--frames", *FRAMES, "--out", ours])
    scene = ROOT / "scenes" / name
    run(["blender", "-b", "--factory-startup", "-P", Path(__file__).parent / "blender_scene.py", "--",
         scene / "scene.glb", ours, place / "scene.blend"])  # fmt: skip
    run(["blender", "-b", place / "scene.blend", "-P", ROOT / "experiments" / "bridges" / "captures" / "blender_export.py", "--",
         "--out", theirs, "--frames", *FRAMES, "--size", *SIZE, "--samples", 32])  # fmt: skip
    said = run([ssrlab, "capture", theirs])
    print(said)
    failures = [f"{name}: ssrlab finds fault with the capture"] if "note:" in said else []
    off = environment_error(theirs)
    print(f"environment: off by {off:.1e} at most")
    if not off < 1e-5:
        failures.append(f"{name}: the environment is turned or mirrored")
    for frame in FRAMES:
        a, b = (read_exr_planes(f / f"frame_{frame:04}" / "gbuffer.exr") for f in (ours, theirs))
        for of_layer, bound in BOUNDS.items():
            difference = np.abs(layer(a, of_layer) - layer(b, of_layer)).max(axis=-1)
            reached = np.quantile(difference, 0.98)
            print(f"frame {frame} {of_layer:18} median {np.median(difference):.1e}, 98 % within {reached:.1e}")
            if not reached <= bound:
                failures.append(f"{name}, frame {frame}: {of_layer} differs by {reached:.1e}, more than {bound:.0e}")
        pixels = np.linalg.norm(layer(a, "motion") * SIZE, axis=-1)
        off = np.linalg.norm((layer(a, "motion") - layer(b, "motion")) * SIZE, axis=-1)
        moves = (pixels > 0.05) & (np.abs(layer(a, "depth") - layer(b, "depth"))[..., 0] < BOUNDS["depth"])
        reached = np.quantile(off[moves], 0.95)
        print(f"frame {frame} motion of {moves.sum()} pixels that move by {np.median(pixels[moves]):.2f} pixels: "
              f"median {np.median(off[moves]):.1e}, 95 % within {reached:.1e} pixels")  # fmt: skip
        if moves.sum() < 100 or reached > MOTION_BOUND:
            failures.append(f"{name}, frame {frame}: motion differs by {reached:.1e} pixels")
    return failures


def check_materials(place):
    """What is wrong with the row of materials, as sentences."""
    place.mkdir(parents=True, exist_ok=True)
    pixels = 8  # a side of each square
    run(["blender", "-b", "--factory-startup", "-P", Path(__file__).parent / "blender_materials.py", "--",
         place / "scene.blend", place / "expected.json"])  # fmt: skip
    expected = json.loads((place / "expected.json").read_text())
    run(["blender", "-b", place / "scene.blend", "-P", ROOT / "experiments" / "bridges" / "captures" / "blender_export.py", "--",
         "--out", place / "theirs", "--size", pixels * len(expected), pixels, "--no-lit"])  # fmt: skip
    planes = read_exr_planes(next((place / "theirs").glob("frame_*/gbuffer.exr")))
    failures = []
    for i, row in enumerate(expected):
        for name, value in row.items():
            channels = [f"{name}.{c}" for c in ("RGB" if name == "base_color" else "Y")]
            found = [float(planes[c][pixels // 2, pixels * i + pixels // 2]) for c in channels]
            if not np.allclose(found, value, rtol=1e-5, atol=1e-6):  # through float32, and divisions of it
                failures.append(f"material {i}: {name} is {found}, not {value}")
    print(f"{len(expected)} materials: {len(failures)} values are wrong")
    return failures


def main():
    ssrlab, folder = Path(sys.argv[1]).resolve(), sys.argv[2] if len(sys.argv) > 2 else None
    failures = []
    with tempfile.TemporaryDirectory() as place:
        for name, camera in SCENES:
            of_scene = Path(folder or place) / name
            of_scene.mkdir(parents=True, exist_ok=True)
            failures += check(ssrlab, name, camera, of_scene)
        failures += check_materials(Path(folder or place) / "materials")
    for failure in failures:
        print("failed:", failure)
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
