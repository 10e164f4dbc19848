#!/usr/bin/env python3
"""Writes ssrlab's own scenes, <folder>/<name>/scene.glb and scene.json: the same bytes on every machine.

    scenes/generate.py [--out FOLDER] [NAME...]
    scenes/generate.py --refusals COUNT room
    scenes/generate.py --fill scenes/rooms.md

Without a name, all scenes that have one; without --out, beside this file. room:17 and street:3 are scenes by their
number, written as <folder>/room_17. --refusals draws the first scenes of a family and says which rules refused how
many draws; --fill writes the densities that they are drawn from into a document.
"""
import argparse
import sys
from collections import Counter
from pathlib import Path

sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "experiments/python"))

from generator import glossy, mirrors, motion
from generator.description import to_text
from generator.families import FAMILIES, LARGEST_NUMBER, drawn, refusals_of
from generator.families.tables import filled
from ssrlab.mistakes import exit_code

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


def write_scene(folder, model, description, files):
    """`files`: what stands beside scene.json, by name."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scene.glb").write_bytes(model.glb())
    for name, content in files.items():
        (folder / name).write_bytes(content)
    (folder / "scene.json").write_text(to_text(description) + "\n", encoding="utf-8", newline="\n")


def number_of(name):
    """Of a scene of a family; None if the name is of none."""
    family, _, number = name.partition(":")
    if family not in FAMILIES or not number.isascii() or not number.isdigit() or int(number) > LARGEST_NUMBER:
        return None
    return int(number)


def print_refusals(family, count):
    rules = Counter(rule for number in range(count) for rule in refusals_of(family, number))
    print(f"{count} scenes, {sum(rules.values())} refused draws: " +
          (", ".join(f"{rule} {times}" for rule, times in rules.most_common()) or "none"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    parser.add_argument("--refusals", type=int, metavar="COUNT", help="draw so many of each family that is named")
    parser.add_argument("--fill", type=Path, metavar="DOCUMENT", help="write the densities into it, and nothing else")
    parser.add_argument("names", nargs="*", metavar="NAME", help="of scenes; none: all; room:N, street:N")
    arguments = parser.parse_args()
    known = {make.__name__: make for make in SCENES}
    is_family = set(FAMILIES) if arguments.refusals else set()
    unknown = [name for name in arguments.names
               if name not in known and name not in is_family and number_of(name) is None]
    if unknown:
        parser.error(f"no scene named '{unknown[0]}'; known are: {', '.join(known)}, and "
                     f"{' and '.join(f'{family}:0' for family in FAMILIES)} to {LARGEST_NUMBER}")
    if arguments.fill:
        text = arguments.fill.read_text(encoding="utf-8")
        arguments.fill.write_text(filled(text), encoding="utf-8", newline="\n")
        return
    for name in arguments.names or known:
        if name in is_family:
            print_refusals(name, arguments.refusals)
        elif name in known:
            write_scene(arguments.out / name, *known[name](), {})
        else:
            write_scene(arguments.out / name.replace(":", "_"), *drawn(name.partition(":")[0], number_of(name)))


if __name__ == "__main__":
    sys.exit(exit_code(main, "the scenes"))
