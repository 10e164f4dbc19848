#!/usr/bin/env python3
"""Path-traces a small picture of each scene, <folder>/<name>.png, seen by its first camera in frame 0.

    scenes/pictures.py [--ssrlab PROGRAM] [--out FOLDER] [NAME...]
    scenes/pictures.py --sheet room

Without a name, all scenes whose files are on the search path (SSRLAB_SCENE_PATH), but for those whose licence is in
doubt. --sheet: room:0 to room:63 on one sheet, sheets/rooms.png, of few samples and denoised, or street:0 to 15.
Needs Debian's python3-numpy and python3-pil.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SCENES = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENES.parent / "experiments/python"))
sys.dont_write_bytecode = True
from ssrlab.mistakes import Fault, exit_code, stop  # noqa: E402  (found by the path above)

try:
    import numpy as np
    from PIL import Image
except ImportError as missing:
    stop(f"{missing}: install python3-numpy and python3-pil, and run this with Debian's python3")

from ssrlab.exr import read_exr_planes, read_exr_rgb  # noqa: E402

SIZE = (320, 180)
SAMPLES = 256
COLOURS = 64  # of the palette: with twice as many the files are a third larger and look the same
SHEETS = {"room": (8, 8), "street": (4, 4)}  # columns, rows
TILE, TILE_SAMPLES = (128, 72), 16
NOT_SHOWN = ("sponza", "sponza_gallery", "sponza_wet")  # README.md, "Sponza's licence"


def exposure_of(scene):
    """Of its first camera, in stops."""
    return json.loads((SCENES / scene / "scene.json").read_text())["cameras"][0].get("exposure_ev", 0)


def srgb(linear):
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def ssrlab(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise Fault(f"{program} {' '.join(map(str, arguments))} failed: {done.stderr.strip()}")


def path_traced(program, scene, size, samples, folder):
    """Its radiance, rendered into the folder."""
    reference = Path(folder) / "reference.exr"
    ssrlab(program, "reference", scene, "--size", *size, "--samples", samples, "--out", reference, "--cache", folder)
    return read_exr_rgb(reference, "image")


def save(codes, file, colours=COLOURS):
    picture = Image.fromarray(codes)
    picture = picture.quantize(colours, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    picture.save(file, optimize=True)


def take(program, scene, out):
    with tempfile.TemporaryDirectory() as folder:
        radiance = path_traced(program, scene, SIZE, SAMPLES, folder)
    save(np.round(255 * srgb(radiance * 2.0 ** exposure_of(scene))).astype(np.uint8), out / f"{scene}.png")


def neighbours(image, reach, step=1):
    """(dy, dx, the image moved so that each pixel has its neighbour's value)."""
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            yield dy, dx, np.roll(image, (dy * step, dx * step), (0, 1))


def denoised(radiance, planes):
    """Light over base colour, without outliers, blurred within surfaces of a material and a direction: an a-trous
    filter (Dammertz et al. 2010), narrower on what mirrors. `planes`: of the G-buffer. For looking at only."""
    def vector(name, channels):
        return np.stack([planes[f"{name}.{c}"] for c in channels], axis=-1)

    colour, normal, material = vector("base_color", "RGB") + 0.04, vector("normal", "XYZ"), planes["material_id.Y"]
    is_kept = (planes["depth.Z"] >= 1) | (vector("emission", "RGB").max(axis=-1) > 0)
    light = np.where(is_kept[..., None], radiance, radiance / colour)
    around = np.stack([np.where(ids == material, values, np.nan) for (_, _, ids), (_, _, values) in
                       zip(neighbours(material, 2), neighbours(light.mean(axis=-1), 2))])
    most = 1.5 * np.nanpercentile(around, 80, axis=0) + 1e-6
    light *= np.where(is_kept, 1, np.minimum(1, most / np.maximum(light.mean(axis=-1), 1e-9)))[..., None]
    for step, least_roughness in ((1, -1), (2, 0.08), (4, 0.25)):
        total, weights = np.zeros_like(light), np.zeros(material.shape)
        moved = zip(neighbours(light, 2, step), neighbours(normal, 2, step), neighbours(material, 2, step))
        for (dy, dx, values), (_, _, normals), (_, _, ids) in moved:
            kernel = (6, 4, 1)[abs(dy)] * (6, 4, 1)[abs(dx)]
            weight = kernel * (ids == material) * np.clip((normals * normal).sum(axis=-1), 0, 1) ** 16
            total += weight[..., None] * values
            weights += weight
        is_blurred = ~is_kept & (planes["roughness.Y"] > least_roughness)
        light = np.where(is_blurred[..., None], total / np.maximum(weights, 1e-9)[..., None], light)
    return np.where(is_kept[..., None], light, light * colour)


def tile(program, scene):
    """Its picture as sRGB codes."""
    with tempfile.TemporaryDirectory() as folder:
        radiance = path_traced(program, scene, TILE, TILE_SAMPLES, folder)
        ssrlab(program, "gbuffer", scene, "--size", *TILE, "--out", folder)
        radiance = denoised(radiance, read_exr_planes(Path(folder) / "gbuffer.exr"))
        exposure = json.loads((Path(folder) / "camera.json").read_text())["exposure_ev"]
    print(scene, flush=True)
    return np.round(255 * srgb(radiance * 2.0 ** exposure)).astype(np.uint8)


def take_sheet(program, family, out):
    columns, rows = SHEETS[family]
    scenes = [f"{family}:{number}" for number in range(columns * rows)]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        tiles = list(pool.map(lambda scene: tile(program, scene), scenes))
    lines = [np.concatenate(tiles[k:k + columns], axis=1) for k in range(0, len(tiles), columns)]
    save(np.concatenate(lines), out / f"{family}s.png", colours=256)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    program = SCENES.parent / "build/release/ssrlab"
    parser.add_argument("--ssrlab", type=Path, default=program, help="default: build/release/ssrlab")
    parser.add_argument("--out", type=Path, help="default: pictures, or sheets, beside this file")
    parser.add_argument("--sheet", choices=SHEETS, help="of a family of scenes, in place of pictures")
    parser.add_argument("names", nargs="*", metavar="NAME", help="of scenes; none: all")
    arguments = parser.parse_args()
    scenes = sorted(file.parent.name for file in SCENES.glob("*/scene.json"))
    unknown = [name for name in arguments.names if name not in scenes]
    if unknown:
        parser.error(f"no scene named '{unknown[0]}'")
    if not arguments.ssrlab.exists():
        parser.error(f"no program {arguments.ssrlab}: build ssrlab, or name it with --ssrlab")
    out = arguments.out or SCENES / ("sheets" if arguments.sheet else "pictures")
    out.mkdir(parents=True, exist_ok=True)
    if arguments.sheet:
        return take_sheet(arguments.ssrlab, arguments.sheet, out)
    for scene in arguments.names or [scene for scene in scenes if scene not in NOT_SHOWN]:
        loaded = subprocess.run([arguments.ssrlab, "needs", scene], capture_output=True, text=True)
        if loaded.returncode != 0:
            print(f"{scene}: left out, {loaded.stderr.strip()}")
            continue
        take(arguments.ssrlab, scene, out)
        print(f"{scene}: {(out / f'{scene}.png').stat().st_size} bytes", flush=True)


if __name__ == "__main__":
    sys.exit(exit_code(main, "the pictures"))
