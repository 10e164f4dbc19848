#!/usr/bin/env python3
"""Adapters of engines: what each says of itself, and that images on their way through page, server and EXR files are read by
ssrlab as they were drawn. Downloads nothing: the engine is an echo.

usage: adapters_test.py SSRLAB
"""
import array
import importlib.util
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ENGINES = Path(__file__).resolve().parents[4] / "experiments/bridges/engines"
sys.path.insert(0, str(ENGINES.parents[1] / "python"))
from ssrlab.json_files import read_json  # noqa: E402  (found by the path above)

ECHO = Path(__file__).resolve().parent / "echo"
ECHO_PROGRAM = ECHO.with_name("echo_program")
PATIENCE = 120  # seconds until what must end has ended, on a busy machine
SKIPPED = 77  # as CMakeLists.txt tells ctest


def check(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


def check_descriptions():
    package = json.loads((ENGINES / "package.json").read_text())
    pinned = {f"{name}@{version}" for name, version in package["dependencies"].items()}
    readme = (ENGINES / "README.md").read_text()
    adapters = sorted(file.parent for file in ENGINES.glob("*/engine.json"))
    check(adapters, "there are adapters")
    names = set()
    for folder in adapters:
        engine = json.loads((folder / "engine.json").read_text())
        for key in ("name", "engine", "version", "licence"):
            check(isinstance(engine[key], str) and engine[key], f"{folder.name}: {key}")
        check(re.fullmatch(r"[A-Za-z0-9_.-]+", engine["name"]), f"{folder.name}: ssrlab takes its name")
        names.add(engine["name"])
        check("default" in engine["points"], f"{folder.name} has a point 'default'")
        for point, settings in engine["points"].items():
            check(set(settings) <= set(engine["defaults"]), f"{folder.name}, {point}: all of its settings have a default")
        for key, value in engine["defaults"].items():
            check(isinstance(value, (str, int, float, bool)), f"{folder.name}: ssrlab takes the setting {key}")
        if "package" in engine:
            check(engine["package"] in pinned, f"{folder.name}: {engine['package']} is pinned in package.json")
            check(not any(sign in engine["package"].partition(":")[2] for sign in "^~*"), f"{folder.name}: one version")
        check("package" in engine or "debian" in engine, f"{folder.name} says what installs it")
        check(f"`{folder.name}`" in readme, f"{folder.name} is in README.md")
    check(len(names) == len(adapters), "names are unique")


def check_studies():
    """The comparison names points that there are, and searches name settings."""
    externals = [v["external"] for v in read_json(ENGINES / "engines.json", has_comments=True)["techniques"] if "external" in v]
    check(len(externals) > 5, "engines are compared")
    for external in externals:
        name, point = Path(external).name.split(".", 1)
        check(point in json.loads((ENGINES / name / "engine.json").read_text())["points"], f"{external}: the engine has such a point")
    for file in ENGINES.glob("*/tune.json"):
        search, engine = read_json(file), json.loads((file.parent / "engine.json").read_text())
        check(search["tune"]["program"] == ["../render.sh", file.parent.name], f"{file} searches its own engine")
        check(set(search["tune"]["axes"]) <= set(engine["defaults"]), f"{file}: axes are settings")
        check(str((file.parent / search["extends"]).resolve()) == str(ENGINES / "tune.json"), f"{file} shares scenes and budget")


def run(*command, folder):
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def check_echo(ssrlab, folder):
    cache = ("--cache", folder / "cache")
    code, said = run(ssrlab, "scene-for", "any", "mirror_pillars", "--size", 96, 54, "--samples", 32, "--out", "scene", *cache,
                     folder=folder)
    check(code == 0, said)

    def render(out, *options):
        return run("node", ENGINES / "shared/render.js", ECHO, "scene", out, *options, folder=folder)

    code, said = render("out", "--set", "reflection=0.25", "--point", "a_quarter", "--seeds", 2)
    check(code == 0, said)
    external = json.loads((folder / "out/external.json").read_text())
    check(external["point"] == "a_quarter" and external["settings"] == {"reflection": 0.25, "wrong": ""}, external)
    check(external["milliseconds"] == 1.5 and external["seeds"] == 2 and external["driver"] == "none", external)
    # A background that reflects is the echo's error, whose camera each pixel without reflections and depth have proved.
    code, said = run(ssrlab, "judge", "out", "--samples", 32, *cache, folder=folder)
    check(code == 0 and "mirror_pillars.main.96x54: mse " in said, said)
    (folder / "out/external.json").write_text(json.dumps(external | {"given_light": False}))
    code, said = run(ssrlab, "judge", "out", "--samples", 32, *cache, folder=folder)
    check(code == 2 and "reflections change most of what they must not change" in said, said)
    code, said = render("still")
    check(code == 0, said)
    code, said = run(ssrlab, "judge", "still", "--samples", 32, *cache, folder=folder)
    check(code == 0 and "mirror_pillars.main.96x54: mse " in said, said)
    view = "mirror_pillars.main.96x54"
    code, said = run(ssrlab, "compare", f"scene/{view}/f0.light.exr", f"still/{view}/f0.s0.exr", "--metric", "mse", folder=folder)
    check(re.search(r"^mse +0$", said, re.M), said)

    for options, code_of, words in (
            (["--set", "wrong=depth"], 2, "another camera or geometry"),
            (["--set", "wrong=turned"], 2, "another camera or geometry"),
            (["--set", "wrong=size"], 2, "the page sent 20732 values; 96 x 54 pixels of 4 are needed"),
            (["--set", "wrong=light"], 2, "are not the light of scene.json"),
            (["--set", "wrong=NaN"], 2, "values are NaN or infinite"),
            (["--set", "wrong=setting"], 2, "error: wrong = setting: must be another"),
            (["--set", "reflecton=1"], 2, "no setting 'reflecton'"),
            (["--set", "reflection=true"], 2, "must be a number"),
            (["--set", "constructor=1"], 2, "no setting 'constructor'"),
            (["--point", "constructor"], 2, "no point 'constructor'"),
            (["--point", "best"], 2, "no point 'best'"),
            (["--seeds", "0"], 2, "--seeds must be")):
        code, said = render("wrong", *options)
        check(code == code_of and words in said, (options, code, said))
        check(not (folder / "wrong").exists(), "of what was refused nothing stays, which would be taken for a view's images")
    code, said = render("still", "--set", "reflection=1")
    check(code == 2 and "holds images whose point is another" in said, said)


def write_halves(folder, view):
    """Halves of the light, of which A is all of it and B, what the echo of the whole light shows, brighter by 0.25."""
    shutil.copytree(folder / "scene", folder / "halves")
    scene = json.loads((folder / "scene/scene.json").read_text())
    stem = folder / "halves" / view
    shutil.copy(folder / f"out/{view}/f0.s0.exr", stem / "f0.half_b.exr")
    brighter = array.array("f", [value + 0.25 for value in array.array("f", (stem / "f0.light.f32").read_bytes())])
    (stem / "f0.half_b.f32").write_bytes(brighter.tobytes())
    halves = {f"light_halves{raw}": [f"{view}/f0.light.{end}", f"{view}/f0.half_b.{end}"] for raw, end in (("", "exr"), ("_raw", "f32"))}
    scene["views"][0]["frames"][0].update(halves)
    (folder / "halves/scene.json").write_text(json.dumps(scene))


def check_program(ssrlab, folder):
    """After check_echo, whose scene it uses: an engine that is a program, not a page."""
    def render(out, *options):
        return run("node", ENGINES / "shared/render.js", ECHO_PROGRAM, "scene", out, *options, folder=folder)

    code, said = render("of_program", "--set", "reflection=0.25", "--seeds", 2)
    check(code == 0 and "0 of 5184 pixels differ from the light" in said and "0 of 5184 pixels have another depth" in said, said)
    external = json.loads((folder / "of_program/external.json").read_text())
    check(external["driver"] == "none" and external["seeds"] == 2 and "milliseconds" not in external, external)
    view = "mirror_pillars.main.96x54"
    for seed, bias in ((0, 0.25), (1, 0.5)):
        from_page, from_program = folder / f"out/{view}/f0.s{seed}.exr", folder / f"of_program/{view}/f0.s{seed}.exr"
        check(from_page.read_bytes() == from_program.read_bytes(), f"page and program say the same of seed {seed}, {bias} too bright")
    write_halves(folder, view)
    for adapter, out in ((ECHO, "out_of_halves"), (ECHO_PROGRAM, "program_of_halves")):
        code, said = run("node", ENGINES / "shared/render.js", adapter, "halves", out, "--set", "reflection=0.25", "--seeds", 2, folder=folder)
        check(code == 0, said)
        images = folder / out / view
        kinds = ("half_a", "half_b", "off", "s0", "s1")
        check(sorted(file.name for file in images.iterdir()) == [f"f0.{kind}.exr" for kind in kinds], sorted(images.iterdir()))
        check((images / "f0.half_a.exr").read_bytes() == (images / "f0.s0.exr").read_bytes(), "half A is all of the light")
        code, said = run(ssrlab, "compare", images / "f0.half_b.exr", images / "f0.s1.exr", "--metric", "mse", folder=folder)
        check(re.search(r"^mse +([0-9.]+e-1[3-9]|0)$", said, re.M), f"half B and its reflection are each 0.25 brighter, but for rounding: {said}")
    for wrong, code_of, words in (("scene", 2, "error: this scene has too many echoes"), ("crash", 3, "the last words"),
                                  ("version", 2, "python3 is version 2; the adapter is for 1")):
        code, said = render("wrong_program", "--set", f"wrong={wrong}")
        check(code == code_of and words in said, (wrong, code, said))
        check(not (folder / "wrong_program").exists(), "of what failed nothing stays")


def check_signals(folder):
    """Ctrl-C ends the browser or the program, too, and leaves neither images nor temporary files."""
    temporary = folder / "temporary"
    temporary.mkdir()
    for adapter, started, name in ((ECHO, "differ from the light", signal.SIGINT), (ECHO_PROGRAM, "", signal.SIGTERM)):
        words = ["node", ENGINES / "shared/render.js", adapter, "scene", "stopped", "--set", "wrong=endless"]
        with subprocess.Popen(words, cwd=folder, env=os.environ | {"TMPDIR": str(temporary)}, stdout=subprocess.PIPE, text=True) as process:
            if started:
                for line in process.stdout:
                    if started in line:
                        break
            while process.poll() is None and not running_in(temporary):
                time.sleep(0.05)
            process.send_signal(name)
            check(process.wait(PATIENCE) == 128 + name, f"a shell's exit code, not {process.returncode}")
        end = time.monotonic() + PATIENCE
        while running_in(temporary) and time.monotonic() < end:
            time.sleep(0.05)
        check(not running_in(temporary), f"what it started has ended: {running_in(temporary)}")
        check(not list(temporary.iterdir()), f"nothing stays: {list(temporary.iterdir())}")
        check(not (folder / "stopped").exists(), "half of a view's images are none")


def running_in(folder):
    """Processes whose temporary folder that is, or lies in it, but for render.js itself."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            words, variables = (process / "cmdline").read_bytes(), (process / "environ").read_bytes()
        except OSError:
            continue  # another user's, or gone
        if f"TMPDIR={folder}/".encode() in variables and b"render.js" not in words:
            found.append(words.replace(b"\0", b" ").decode(errors="replace").strip())
    return [words for words in found if words]  # zombies have none


def check_study_script(ssrlab, folder):
    """After check_echo, whose images of two seeds it uses: which images a study's script takes for whole."""
    script = ENGINES / "render_study.py"
    code, said = run(sys.executable, "-B", script, ssrlab, ENGINES / "engines.json", "study", "three_ssrpas", folder=folder)
    check(code == 2 and "has no engine 'three_ssrpas'" in said and not (folder / "study").exists(), (code, said))
    spec = importlib.util.spec_from_file_location("render_study", script)
    render_study = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(render_study)
    view, out = json.loads((folder / "scene/scene.json").read_text())["views"][0], str(folder / "out")
    check(render_study.has_images(out, view, 2), "all images are there")
    check(not render_study.has_images(out, view, 3), "a third seed is not")
    view = json.loads((folder / "halves/scene.json").read_text())["views"][0]
    check(render_study.has_images(str(folder / "out_of_halves"), view, 2) and not render_study.has_images(out, view, 2), "halves are images, too")


def check_strangers(folder):
    """Names in a scene.json of somebody else's lead nowhere but into its folder."""
    own = (folder / "scene/scene.json").read_text()
    (folder / "strange").mkdir()
    for change in (lambda s: s["views"][0].update(view="../../elsewhere"), lambda s: s.update(meshes="/etc/passwd"),
                   lambda s: s["background"].update(image="../secret.exr"), lambda s: s["views"][0]["frames"][0].update(light="../../secret.exr"),
                   lambda s: s["views"][0]["frames"][0].update(light_halves=["../../secret.exr"])):
        scene = json.loads(own)
        change(scene)
        (folder / "strange/scene.json").write_text(json.dumps(scene))
        code, said = run("node", ENGINES / "shared/render.js", ECHO, "strange", "of_stranger", folder=folder)
        check(code == 2 and "is no path below" in said, (code, said))
    for text, words in (("{", "cannot be read as JSON"), ('{"scene": "fence"}', "no views or no background")):
        (folder / "strange/scene.json").write_text(text)
        code, said = run("node", ENGINES / "shared/render.js", ECHO, "strange", "of_stranger", folder=folder)
        check(code == 2 and words in said, (code, said))


def main():
    check_descriptions()
    check_studies()
    missing = [program for program in ("node", "chromium") if not shutil.which(program)]
    if missing:
        print(f"skipped: {' and '.join(missing)} are not installed; what adapters say of themselves was checked")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="ssrlab_engines_") as folder:
        check_echo(Path(sys.argv[1]).resolve(), Path(folder))
        check_program(Path(sys.argv[1]).resolve(), Path(folder))
        check_study_script(Path(sys.argv[1]).resolve(), Path(folder))
        check_strangers(Path(folder))
        check_signals(Path(folder))


main()
