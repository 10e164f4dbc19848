#!/usr/bin/env python3
"""Renders the images of engines that a study names, those that are not there yet.

usage: render_study.py SSRLAB STUDY.json OUT [ENGINE ...]

Each `external` of the study is a folder ENGINE.POINT: adapter and point of engine.json. OUT/scenes gets what `ssrlab scene-for` writes of each
shot. Of points that draw random numbers, those that "seeds" of engine.json names, so many images of each frame are rendered. Images that render.sh
refuses (exit code 2) are left out; where it failed (3), the others are rendered all the same, and this script ends with 3."""

import argparse
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, os.pardir, "python"))
from ssrlab import interrupts  # noqa: E402
from ssrlab.json_files import read_json  # noqa: E402
from ssrlab.mistakes import Fault, ResultsError, counted, exit_code, say  # noqa: E402
from ssrlab.shots import scene_folder_name, scene_for_words, single_shots  # noqa: E402
from ssrlab.text_files import exists, path_inside  # noqa: E402


def scene_folder(shot, study, ssrlab, out):
    """What `scene-for` wrote of a shot, written where it is not there."""
    words = scene_for_words(shot, study)
    folder = path_inside(out, f"scenes/{scene_folder_name(words)}")
    if exists(path_inside(folder, "scene.json")):
        return folder
    code = interrupts.run([ssrlab, "scene-for", "any", *words, "--out", folder])
    if code != 0:
        sys.exit(code)  # it has said why
    return folder


def external_folders(study, file, engines):
    """Those of the study that `engines` (empty: all) render."""
    folders = [os.path.normpath(os.path.join(os.path.dirname(file), v["external"])) for v in study["techniques"] if "external" in v]
    for folder in folders:
        if "." not in os.path.basename(folder):
            raise ResultsError(f"{file}: '{folder}' must be called ENGINE.POINT")
    known = sorted({os.path.basename(folder).split(".")[0] for folder in folders})
    for name in engines:
        if name not in known:
            raise ResultsError(f"{file} has no engine '{name}'; there are {', '.join(known)}")
    return [folder for folder in folders if not engines or os.path.basename(folder).split(".")[0] in engines]


def has_images(folder, view, seeds):
    """Whether all frames of a view of scene.json are there; a render that was killed may have left some."""
    kinds = ["off", *(f"s{seed}" for seed in range(seeds))]
    halves = ["half_a", "half_b"] if all("light_halves" in frame for frame in view["frames"]) else []
    names = [f"{view['view']}/f{frame['frame']}.{kind}.exr" for frame in view["frames"] for kind in kinds + halves]
    return all(exists(path_inside(folder, name)) for name in names)


def main():
    parser = argparse.ArgumentParser(description="Renders the images of engines that a study names, those that are not there yet.")
    parser.add_argument("ssrlab", help="the program")
    parser.add_argument("study", help="its `external` folders are rendered")
    parser.add_argument("out", help="folder of the scenes")
    parser.add_argument("engines", nargs="*", metavar="ENGINE", help="default: all")
    arguments = parser.parse_args()
    study = read_json(arguments.study, has_comments=True)
    frames = external_folders(study, arguments.study, arguments.engines)
    scenes = [scene_folder(shot, study, arguments.ssrlab, arguments.out) for shot in single_shots(study["shots"])]
    jobs = [(folder, scene) for folder in frames for scene in scenes]
    begin, rendered, left_out, failed = time.monotonic(), 0, 0, 0
    for number, (folder, scene) in enumerate(jobs):
        engine, point = os.path.basename(folder).split(".", 1)
        settings = read_json(path_inside(HERE, f"{engine}/engine.json"))
        seeds = settings.get("seeds", {}).get(point, 1)
        if all(has_images(folder, view, seeds) for view in read_json(path_inside(scene, "scene.json"))["views"]):
            continue
        if point not in settings["points"]:
            raise ResultsError(f"{arguments.study}: {engine} has no point '{point}'")
        left = (time.monotonic() - begin) / rendered * (len(jobs) - number) / 60 if rendered else None
        say(f"{engine}, {point}, {os.path.basename(scene)}: {number + 1} of {len(jobs)}" + (f", about {left:.0f} min left" if left else ""))
        words = [path_inside(HERE, "render.sh"), engine, scene, folder, "--point", point, "--seeds", str(seeds)]
        rendered += 1
        code = interrupts.run(words)
        if code == 2:
            left_out += 1
            say("it cannot be compared there, for the reason above, and is left out")
        elif code != 0:
            failed += 1
            say(f"it failed there (exit code {code}), for the reason above")
    say(f"{rendered} rendered, {left_out} of them left out")
    if failed:
        raise Fault(f"{failed} of {counted(rendered, 'render')} failed, for the reasons above; put that right and start again: what is there stays")
    return 0


if __name__ == "__main__":
    sys.exit(exit_code(main, "rendering"))
