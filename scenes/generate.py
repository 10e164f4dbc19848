#!/usr/bin/env python3
"""Writes ssrlab's own scenes, <folder>/<name>/scene.glb and scene.json: the same bytes on every machine.

    scenes/generate.py [--out FOLDER] [NAME...]

Without a name, all scenes; without --out, beside this file.
"""
import argparse
from pathlib import Path

from generator import glossy, mirrors, motion
from generator.description import to_text

SCENES = [
    mirrors.mirror_pillars, mirrors.grazing, mirrors.fence, mirrors.floating_holes, mirrors.offscreen_mirror,
    mirrors.curved_mirror, mirrors.facing_mirrors, mirrors.axis_parallel, mirrors.depth_range,
    mirrors.hidden_faces, mirrors.corridor, mirrors.dark_room,
    glossy.roughness_gradient, glossy.firefly, glossy.firefly_moving, glossy.contact_hardening, glossy.glossy_stretch,
    glossy.metal_corner, glossy.normal_mapped, glossy.curved_metal, glossy.roughness_steps, glossy.rails,
    glossy.all_rough, glossy.all_rough_mirror_tile, glossy.sky_only, glossy.furnace, glossy.furnace_sphere,
    motion.disocclusion, motion.disocclusion_moving_column, motion.moving_objects, motion.border_crossing,
    motion.passing_pillars, motion.moving_emitter, motion.stepping_emitter, motion.thin_pole,
    motion.rotating_mirror,
]


def write_scene(folder, make):
    model, description = make()
    folder = folder / make.__name__
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.glb").write_bytes(model.glb())
    (folder / "scene.json").write_text(to_text(description) + "\n", encoding="utf-8", newline="\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    parser.add_argument("names", nargs="*", metavar="NAME", help="of scenes; none: all")
    arguments = parser.parse_args()
    known = {make.__name__: make for make in SCENES}
    unknown = [name for name in arguments.names if name not in known]
    if unknown:
        parser.error(f"no scene named '{unknown[0]}'; known are: {', '.join(known)}")
    for name in arguments.names or known:
        write_scene(arguments.out, known[name])


if __name__ == "__main__":
    main()
