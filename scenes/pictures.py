#!/usr/bin/env python3
"""Path-traces a small picture of each scene, <folder>/<name>.png, seen by its first camera in frame 0.

    scenes/pictures.py [--ssrlab PROGRAM] [--out FOLDER] [NAME...]

Without a name, all scenes whose files are on the search path (SSRLAB_SCENE_PATH), but for those whose licence is in
doubt. Needs Debian's python3-numpy and python3-pil.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
    from PIL import Image
except ImportError as missing:
    sys.exit(f"error: {missing}: install python3-numpy and python3-pil, and run this with Debian's python3")

SCENES = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENES.parent / "experiments/python"))
sys.dont_write_bytecode = True
from ssrlab.exr import read_exr_rgb  # noqa: E402  (found by the path above)

SIZE = (320, 180)
SAMPLES = 256
COLOURS = 64  # of the palette: with twice as many the files are a third larger and look the same
NOT_SHOWN = ("sponza", "sponza_gallery", "sponza_wet")  # README.md, "Sponza's licence"


def exposure_of(scene):
    """Of its first camera, in stops."""
    return json.loads((SCENES / scene / "scene.json").read_text())["cameras"][0].get("exposure_ev", 0)


def srgb(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def take(program, scene, out):
    with tempfile.TemporaryDirectory() as folder:
        reference = Path(folder) / "reference.exr"
        size = [str(pixels) for pixels in SIZE]
        command = [program, "reference", scene, "--size", *size, "--samples", str(SAMPLES), "--out", reference]
        subprocess.run([*command, "--cache", folder], check=True, capture_output=True)
        radiance = read_exr_rgb(reference, "image")
    codes = np.round(255 * srgb(radiance * 2.0 ** exposure_of(scene))).astype(np.uint8)
    picture = Image.fromarray(codes).quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    picture.save(out / f"{scene}.png", optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    program = SCENES.parent / "build/release/ssrlab"
    parser.add_argument("--ssrlab", type=Path, default=program, help="default: build/release/ssrlab")
    parser.add_argument("--out", type=Path, default=SCENES / "pictures", help="default: pictures, beside this file")
    parser.add_argument("names", nargs="*", metavar="NAME", help="of scenes; none: all")
    arguments = parser.parse_args()
    scenes = sorted(file.parent.name for file in SCENES.glob("*/scene.json"))
    unknown = [name for name in arguments.names if name not in scenes]
    if unknown:
        parser.error(f"no scene named '{unknown[0]}'")
    if not arguments.ssrlab.exists():
        parser.error(f"no program {arguments.ssrlab}: build ssrlab, or name it with --ssrlab")
    arguments.out.mkdir(parents=True, exist_ok=True)
    for scene in arguments.names or [scene for scene in scenes if scene not in NOT_SHOWN]:
        loaded = subprocess.run([arguments.ssrlab, "needs", scene], capture_output=True, text=True)
        if loaded.returncode != 0:
            print(f"{scene}: left out, {loaded.stderr.strip()}")
            continue
        take(arguments.ssrlab, scene, arguments.out)
        print(f"{scene}: {(arguments.out / f'{scene}.png').stat().st_size} bytes", flush=True)


if __name__ == "__main__":
    main()
