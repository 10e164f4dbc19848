"""Runs every command line and Python program of the documents, in small, in one folder that looks like a clone whose reader has done what the pages say.

usage: documents_run_test.py SSRLAB [WORD ...]    only lines with one of the words

Smaller are: images, samples, seeds, the number of shots, techniques and points (small_study), and the values of options that cost time
(QUICK). What a line writes is there for the next. Lines in NOT_RUN are not run, for the reason there.
"""

import importlib.util
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from document_lines import DOCUMENTS, ROOT, all_command_lines, python_blocks, studies_of

SIZE = [32, 18]
SAMPLES = 16
STAND_IN = "roughness_gradient"  # for scenes that are not at hand: it has all roughnesses
MOST_SECONDS = 600  # of a line; the slowest takes 12 s on two cores, and a minute beside much other work
DOCS = ROOT / "experiments/docs"
NOT_RUN = {  # by a part of the line
    "experiments/quickstart.sh": "builds the program",
    "tests/run.sh": "runs this test",
    "mesa_25": "needs a package from the network",
    "gpu_newer.json": "needs this package, too",
    "rooms_gpu_costs_newer": "needs this package, too",
    "three_ssrpass/tune.json": "renders in a browser",
    "tables results/comparison": "shows points that the small study leaves out",
    "tune my_engine.json": "runs a program that the reader has",
    "tune my_search.json": "is a search of any name; that of search.json is run",
    "noise_picture": "renders references for a minute",
    "gate_page": "writes a page of this repository; a test of its own checks the page",
}
# Of a command: options that replace those of the line, or stand beside them.
QUICK = {
    "export-shaders": {"--size": SIZE},
    "gbuffer": {"--size": SIZE},
    "judge": {"--samples": [32]},
    "needs": {"--size": SIZE, "--techniques": ["none"]},
    "rays": {"--size": SIZE, "--count": [1]},
    "record": {"--size": SIZE, "--samples": [SAMPLES], "--frames": ["0-0"]},
    "reference": {"--size": SIZE, "--samples": [SAMPLES]},
    "scene-for": {"--size": SIZE, "--samples": [SAMPLES]},
    "shaders": {"--chip": ["navi21"]},
    "stability": {"--techniques": ["./mirror_rays"], "--cases": ["mirrored"]},
    "stability --precision": {"--techniques": ["./mirror_rays"], "--cases": ["mirror"]},
    "watch": {"--size": SIZE, "--samples": [32], "--seeds": [1]},
}
PLACEHOLDERS = {"CONFIG.json": "my_study.json", "DIR": "results/shared", "CACHE": "cache", "NAME": "reader"}
SEVERAL_POINTS = ("quickstart", "quality", "comparison", "rooms", "rooms_power", "rooms_gpu", "rooms_gpu_in_motion", "rooms_gpu_costs", "paper")  # configs whose results another line reads


def without_comments(text):
    return re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*', lambda m: m[1] or "", text)


def first(value):
    return value[:1] if isinstance(value, list) else value


def is_third_party(scene):
    return (ROOT / "scenes" / scene).is_dir() and not (ROOT / "scenes" / scene / "scene.glb").exists()


def scenes_of(shot):
    return shot.get("scene", []) if isinstance(shot.get("scene"), list) else [shot.get("scene", "")]


def small_shot(shot):
    """Its first scene that is at hand and takes no seconds to light, in a still image."""
    own = [scene for scene in scenes_of(shot) if not is_third_party(scene) and not scene.startswith(("room:", "street:"))] or [STAND_IN]
    shot = shot | ({"scene": own} if "scene" in shot else {})
    left_out = ["frames", "measure", "measure_from", "change", "repeat", "warm_up", "resolution", "fallback", "first", "count"]
    left_out += ["camera"] if own == [STAND_IN] else []
    return {key: first(value) for key, value in shot.items() if key not in left_out}


def small_technique(entry):
    kept = dict(entry)
    for key in ("sweep", "each", "zip"):
        if key in kept:
            kept[key] = {name: values[:2] if isinstance(values, list) else values for name, values in list(kept[key].items())[:1]}
    for key in ("random", "latin_hypercube", "sobol"):
        if key in kept:
            kept[key] |= {"count": 1}
    return kept | ({"preset": first(kept["preset"])} if "preset" in kept else {})


def small_study(study, most_techniques):
    """The first shot and techniques of a study, in a size that takes a second."""
    kept = {key: value for key, value in study.items() if key not in ("hits", "bias_variance", "convergence", "frozen")}
    if "shots" in kept:
        kept["shots"] = [small_shot(shot) for shot in kept["shots"][:1]]
    if "techniques" in kept:
        kept["techniques"] = [small_technique(entry) for entry in kept["techniques"][:most_techniques]]
    if "tune" in kept:
        kept["tune"] |= {"most_runs": 12}
        if "judge" in kept["tune"]:
            kept["tune"]["judge"] = {"shots": [small_shot(shot) for shot in kept["tune"]["judge"]["shots"][:1]]}
    if "gpu_compilers" in kept:
        kept["gpu_compilers"] = kept["gpu_compilers"][:1]
    if isinstance(kept.get("reference", {}), dict):
        kept["reference"] = {"samples": SAMPLES}
    return kept | {"resolution": SIZE, "seeds": 2, "timing": {"frames": 15 if most_techniques > 1 else 0, "warm_up": 1}}


def small_figures(choice):
    return {"figures": [{key: choice["figures"][0][key] for key in ("kind", "name")}]}


class Reader:
    """A folder with the files that the pages tell a reader to have."""

    def __init__(self, folder, ssrlab):
        self.folder = folder
        self.environment = os.environ | {"SSRLAB_CACHE": str(folder / "cache"), "PATH": f"{folder}/build/release:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}
        (folder / "build/release").mkdir(parents=True)
        (folder / "build/release/ssrlab").symlink_to(ssrlab)
        for name in ("scenes", "variants"):
            (folder / name).symlink_to(ROOT / name)
        shutil.copytree(ROOT / "experiments", folder / "experiments", ignore=shutil.ignore_patterns("__pycache__", "*.png"))
        self.third_party = set()  # configs that name scenes of a scene path
        for file in (folder / "experiments/studies/configs").glob("*.json"):
            text = file.read_text(encoding="utf-8")
            if any(is_third_party(scene) for shot in json.loads(without_comments(text)).get("shots", []) for scene in scenes_of(shot)):
                self.third_party.add(file.name)
            self.write_study(file, text, 3 if file.stem in SEVERAL_POINTS else 1, file.stem == "paper")

    def write_study(self, file, text, most_techniques=2, has_tables=True):
        study = json.loads(without_comments(text))
        if not has_tables:
            study.pop("tables", None)
        small = small_figures(study) if "figures" in study else small_study(study, most_techniques)
        (self.folder / file).write_text(json.dumps(small))

    def run(self, words):
        """(exit code or None if it took too long, what it printed)"""
        words = [sys.executable if words[0] == "python3" else words[0], *words[1:]]
        with tempfile.TemporaryFile("w+") as said:
            process = subprocess.Popen(words, cwd=self.folder, env=self.environment, stdout=said, stderr=subprocess.STDOUT, text=True)
            code, end = None, time.monotonic() + MOST_SECONDS
            while code is None and time.monotonic() < end:
                try:
                    code = process.wait(0.2)
                except subprocess.TimeoutExpired:
                    said.seek(0)
                    if words[1] == "watch" and "http://" in said.read():
                        process.send_signal(signal.SIGINT)
            if code is None:
                process.kill()
                process.wait()
            said.seek(0)
            return code, said.read()

    def must_run(self, line):
        code, said = self.run(shlex.split(line))
        if code != 0:
            sys.exit(f"{line}\n{said}")

    def prepare(self):
        for name in ("my_scene.glb", "model.glb"):
            shutil.copy(ROOT / "scenes/mirror_pillars/scene.glb", self.folder / name)
        for name in ("third_party", "parts"):
            (self.folder / name).mkdir()
        page = DOCS / "figures.md"
        tables = re.search(r'(?ms)^ {4}("tables": \[.*?\]\}?)\n\n', page.read_text(encoding="utf-8"))[1]
        study = studies_of(DOCS / "quickstart.md")[0].rstrip()
        self.write_study("my_study.json", f"{study[:-1]}, {tables}}}")
        self.write_study("my_figures.json", studies_of(page)[0])
        self.write_study("my_rooms.json", studies_of(DOCS / "compare.md")[0])
        self.write_study("my_rooms_gpu.json", next(text for text in studies_of(DOCS / "compare.md") if "my_rooms.json" in text))
        self.write_study("search.json", studies_of(DOCS / "tune.md")[0])
        self.save_technique("mirror_rays")
        self.must_run("ssrlab run experiments/studies/configs/quickstart.json --out results/quickstart --cache cache")
        self.must_run("ssrlab run experiments/studies/configs/rooms_power.json --out results/rooms_power --cache cache")
        self.must_run("ssrlab run my_study.json")
        self.must_run(f"ssrlab gbuffer fence --size {SIZE[0]} {SIZE[1]} --out my_capture")
        self.must_run(f"ssrlab reference fence --size {SIZE[0]} {SIZE[1]} --samples {SAMPLES} --out truth.exr")
        frames = [f"{name}_{number:04}.exr" for name in ("reference", "test") for number in (0, 1)]
        for name in ("reference.exr", "test.exr", *frames):
            shutil.copy(self.folder / "truth.exr", self.folder / name)
        self.save_frames("my_frames", "earlier_frames", "fence_frames")
        (self.folder / "camera.json").write_text(studies_of(ROOT / "experiments/bridges/captures/README.md")[0])
        for document in DOCUMENTS:
            self.run_programs(document)

    def run_programs(self, document):
        for block in python_blocks(document):
            if "import OpenImageIO" in block and not importlib.util.find_spec("OpenImageIO"):
                continue  # a package that ssrlab does not need
            code, said = self.run(["python3", "-c", block])
            if code != 0:
                sys.exit(f"{document}:\n{block}\n{said}")

    def save_technique(self, name):
        """That of the page, with the name of the folder in which the reader saves it."""
        page = (DOCS / "write_a_technique.md").read_text(encoding="utf-8")
        declaration = re.search(r"(?s)```json\n(.*?)```", page)[1]
        (self.folder / name).mkdir()
        (self.folder / name / "technique.json").write_text(declaration)
        (self.folder / name / re.search(r"\w+\.(comp|frag)", declaration)[0]).write_text(re.search(r"(?s)```glsl\n(.*?)```", page)[1])

    def save_frames(self, *folders):
        """Frames of an engine that has no reflections."""
        self.must_run(f"ssrlab scene-for any fence --size {SIZE[0]} {SIZE[1]} --samples 32 --out for_frames")
        view = f"fence.main.{SIZE[0]}x{SIZE[1]}"
        for folder in folders:
            (self.folder / folder / view).mkdir(parents=True)
            for name in ("f0.s0.exr", "f0.off.exr"):
                shutil.copy(self.folder / "for_frames" / view / "f0.light.exr", self.folder / folder / view / name)
            (self.folder / folder / "external.json").write_text('{"name": "my_engine", "engine": "My engine", "version": "1.0", "given_light": true}')

    def before(self, line):
        """What a page asks for in words, right before a line."""
        if any(f"/{config} " in line for config in self.third_party) and "--scene-path" not in line:
            sys.exit(f"{line}: its config names third-party scenes; add --scene-path third_party")
        if line.endswith("my_ssr/my_ssr.json"):
            self.write_study("my_ssr/my_ssr.json", (self.folder / "my_ssr/my_ssr.json").read_text())
        if "judge enter" in line:
            (self.folder / "answers.csv").write_text("pair,nearer\n1,left\n")
        if " diff " in line:
            shutil.copytree(self.folder / "results/my_rooms", self.folder / "results/last_week")
        if "my_frames --capture" in line:
            view = self.folder / f"my_frames/my_capture.gbuffer.{SIZE[0]}x{SIZE[1]}"
            (self.folder / f"my_frames/fence.main.{SIZE[0]}x{SIZE[1]}").rename(view)
        if "parts/1" in line:
            for part in "123":
                shutil.copytree(self.folder / "results/shared", self.folder / "parts" / part)
            shutil.rmtree(self.folder / "results/shared")


def quickened(line):
    """The words of a line with placeholders filled, and options of QUICK in place of the line's."""
    words = [PLACEHOLDERS.get(word, word) for word in shlex.split(line)]
    command = words[1] if words[0].endswith("ssrlab") else ""
    for option, values in QUICK.get(command + " --precision" * ("--precision" in words), QUICK.get(command, {})).items():
        if option in words:
            start = words.index(option)
            end = next((i for i in range(start + 1, len(words)) if words[i].startswith("--")), len(words))
            del words[start:end]
        words += [option, *map(str, values)]
    return words


def main():
    ssrlab, only = Path(sys.argv[1]).resolve(), sys.argv[2:]
    wanted = [line for _, line in all_command_lines() if not any(part in line for part in NOT_RUN) and (not only or any(word in line for word in only))]
    lines = {}
    for line in wanted:
        for machine in "123" if "$I" in line else "1":
            lines.setdefault(line.removeprefix("build/release/").replace("$I", machine), line.replace("$I", machine))
    failed = 0
    with tempfile.TemporaryDirectory() as temporary:
        reader = Reader(Path(temporary), ssrlab)
        reader.prepare()
        for line in lines.values():
            reader.before(line)
            began, words = time.monotonic(), quickened(line)
            code, said = reader.run(words)
            is_stopped = words[1:2] == ["watch"] and code == 130
            print(f"{time.monotonic() - began:6.1f} s  {'late' if code is None else code}  {shlex.join(words)}", flush=True)
            # The capture that the page's program writes follows the page in all that ssrlab can check.
            is_wrong = line == "ssrlab capture my_floor" and re.search("note: (?!There is no layer)", said)
            if (code != 0 and not is_stopped) or is_wrong:
                failed += 1
                print(said[-700:])
    print(f"{len(lines)} lines, {failed} failed")
    return 1 if failed or (not only and len(lines) < 80) else 0


if __name__ == "__main__":
    sys.exit(main())
