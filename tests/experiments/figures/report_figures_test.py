"""Draws the figures of a made-up results folder twice and looks at the files; what figures.json asks for; crops of images.

usage: report_figures_test.py REPORT_PAGE_PROGRAM
"""

import copy
import csv
import json
import os
import re
import resource
import struct
import subprocess
import sys
import tempfile
import zlib

from figures_start import check, request_of

sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "report"))

import matplotlib.pyplot as plt
import numpy as np
from ssrlab.figures import crops
from ssrlab.figures.crop_choice import read_crops
from ssrlab.exr import ExrError, read_exr_rgb
from ssrlab.figures.request import read_colors, read_requests
from ssrlab.mistakes import ResultsError
from ssrlab.results import Results
from report_crops import FIGURES_JSON, SHOT

program = sys.argv[1]
figures = [sys.executable, "-B", "-m", "ssrlab.figures"]


def run_figures(folder, out, *options):
    return subprocess.run(
        [*figures, folder, "--out", out, *options], capture_output=True, text=True
    )


def keep_one_shot(folder):
    """One shot is enough to compare bytes, in a third of the time."""
    file = os.path.join(folder, "summary.csv")
    with open(file, newline="") as text:
        rows = list(csv.DictReader(text))
    with open(file, "w", newline="") as text:
        writer = csv.DictWriter(text, rows[0].keys())
        writer.writeheader()
        writer.writerows(r for r in rows if r["shot"] == SHOT)


CHOICE = {
    "font": "serif",
    "labels": {"none": "no reflections"},
    "figures": [
        {"kind": "stage_times", "width": "column"},
        {"kind": "error_time", "name": "errors", "width": 9.5, "formats": ["pdf"], "points": ["mcguire*", "no reflections"]},
    ],
}


def test_chosen_figures(folder, temporary):
    """What figures.json names and nothing else is made, as wide as it says, with its letters in the file."""
    file, out = os.path.join(temporary, "chosen.json"), os.path.join(temporary, "chosen")
    choice = copy.deepcopy(CHOICE)
    choice["formats"] = choice["figures"][1].pop("formats")
    with open(file, "w", encoding="utf-8") as text:
        text.write("// a comment\n" + json.dumps(choice))
    result = run_figures(folder, out, "--choice", file)
    check(result.returncode == 0, f"figures.py ends with {result.returncode}: {result.stderr}")
    check(sorted(os.listdir(out)) == ["errors.pdf", "stage_times.pdf"], f"files: {os.listdir(out)}")
    for name, width in (("errors.pdf", 9.5), ("stage_times.pdf", 8.5)):
        with open(os.path.join(out, name), "rb") as pdf:
            data = pdf.read()
        points = float(re.search(rb"/MediaBox \[ 0 0 ([0-9.]+) ", data)[1])
        check(abs(points / 72 * 2.54 - width) < 0.01, f"{name} is {points} pt wide")  # the file has 6 digits
        fonts, files = data.count(b"/Type /FontDescriptor"), data.count(b"/FontFile2 ")
        check(fonts and fonts == files and b"STIXGeneral" in data and b"/Type3" not in data, f"{name}: {fonts} fonts, {files} embedded")

    results = Results(folder)
    colors = read_colors("f.json", {"colors": {"mcguire*": "#102030", "nothing": "#ffffff"}, "labels": {"none": "nothing"}}, results)
    expected = {("mcguire_dda", "stride=1"): "#102030", ("mcguire_dda", "stride=4"): "#102030", ("none", "default"): "#ffffff"}
    check(colors == expected, f"colours {colors}")

    def mistake(change, part):
        content = copy.deepcopy(CHOICE)
        content["figures"][1].pop("formats")
        change(content)
        try:
            read_requests("f.json", content, results, {"target": "specular", "metric": "mse", "mask": "all"})
            check(False, f"a mistake is not found: {part}")
        except ResultsError as e:
            check(str(e).startswith("f.json") and part in str(e) and "\n" not in str(e), f"{part!r} is not in {e}")

    figure = lambda change: lambda content: content["figures"][1].update(change)
    mistake(lambda c: c.update(figure=[]), "'figure' is not known; did you mean 'figures'?")
    mistake(figure({"shot": "a"}), "figures[1]: 'shot' is not known; did you mean 'shots'?")
    mistake(figure({"kind": "error_tim"}), "'kind' must be one of error_time, stage_times")
    mistake(figure({"width": "colum"}), "'width' must be \"column\" (8.5), \"page\" (17.6), \"slide\" (25), or a number of cm")
    mistake(figure({"points": ["mcguire_dda stride=5"]}), "\"mcguire_dda stride=5\", which the results do not hold; did you mean 'mcguire_dda stride=")
    mistake(figure({"name": "stage_times"}), "another figure is named 'stage_times' already")
    mistake(figure({"kind": "map", "x": "stride"}), "a figure of the kind map needs 'y'")


def test_same_bytes(folder, temporary):
    outs = [os.path.join(temporary, name) for name in ("first", "second")]
    for out in outs:
        result = run_figures(folder, out)
        check(result.returncode == 0, f"figures.py ends with {result.returncode}: {result.stderr}")
    expected = sorted(
        f"{name}_{SHOT}.{kind}" for name in ("error_time", "stage_times", "crops") for kind in ("pdf", "svg", "png")
    )
    for out in outs:
        check(sorted(os.listdir(out)) == expected, f"files: {sorted(os.listdir(out))}")
    for name in expected:
        first, second = (open(os.path.join(out, name), "rb").read() for out in outs)
        check(len(first) > 2000, f"{name} is nearly empty")
        check(first == second, f"{name} differs when it is made again")


def exr_header(width, height):
    """Of an image R, G, B in floats, ZIP-compressed."""

    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value

    channels = b"".join(name + b"\0" + struct.pack("<4i", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    return (
        struct.pack("<II", 20000630, 2)
        + attribute(b"channels", b"chlist", channels)
        + attribute(b"compression", b"compression", b"\3")
        + attribute(b"dataWindow", b"box2i", struct.pack("<4i", 0, 0, width - 1, height - 1))
        + b"\0"
    )


def test_exr(folder):
    """The Python reader against the C++ one, half and float, over rows that do not fill the last block."""
    for name in (f"{SHOT}/reference_image.exr", "roughness_gradient.side.161x91/none_default_0_specular.exr"):
        file = os.path.join(folder, "images", name)
        image = read_exr_rgb(file)
        for x, y in ((0, 0), (3, 17), (image.shape[1] - 1, image.shape[0] - 1)):
            printed = subprocess.run(
                [program, "--halves", file, str(x), str(y)], check=True, capture_output=True, text=True
            ).stdout
            check(
                [float(np.float16(v)) for v in image[y, x]] == [float(v) for v in printed.split()],
                f"pixel {x}, {y} of {name}: {image[y, x]}, and C++ reads {printed}",
            )
    with open(file, "rb") as whole:
        data = whole.read()
    broken = os.path.join(folder, "broken.exr")

    def refuses(content, what):
        with open(broken, "wb") as part:
            part.write(content)
        try:
            read_exr_rgb(broken)
            check(False, f"an EXR was read although {what}")
        except ExrError as e:
            check("broken.exr" in str(e) and what in str(e), f"the message lacks the file or '{what}': {e}")

    refuses(data[: len(data) // 2], "it is truncated")
    refuses(exr_header(1_000_000, 1_000_000), "allow more with --max-memory")
    bomb = zlib.compress(bytes(10**8))  # 97 kB
    header = exr_header(1, 1)
    small = header + struct.pack("<Qii", len(header) + 8, 0, len(bomb)) + bomb
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    refuses(small, "a block has 13 bytes and not 12")
    check(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50_000, "an EXR of one pixel took 50 MB")
    fifo = os.path.join(folder, "fifo.exr")
    os.mkfifo(fifo)
    try:
        read_exr_rgb(fifo)
        check(False, "a FIFO was read")
    except ExrError as e:
        check("not a regular file" in str(e), f"of a FIFO it says: {e}")
    finally:
        os.remove(fifo)


def test_chosen_crops(folder, temporary):
    """What the report's viewer wrote is drawn: its boxes, points, exposures and tone curves."""
    file = os.path.join(temporary, "figures.json")

    def draw(content):
        return crops.draw(results, SHOT, request_of("crops", crops=read_crops(file, content, results)))

    results = Results(folder)
    panels = [a for a in draw(FIGURES_JSON).get_axes() if a.get_images()]
    check(len(panels) == 4 + 2 * (4 + 3), f"{len(panels)} pictures: the truth has no map of errors")
    boxes = [crop["box"] for crop in FIGURES_JSON["crops"]]
    found = [[p.get_x() + 0.5, p.get_y() + 0.5, p.get_width(), p.get_height()] for p in panels[-5].patches if p.get_fill() is False]
    check(found == boxes, f"boxes {found}")
    exposed = read_exr_rgb(os.path.join(folder, "images", SHOT, "mcguire_dda_stride=4_0_image.exr"))[50 + 17, 120 + 9] * 2**1.25
    linear = exposed / (1 + exposed)  # Reinhard et al. 2002
    expected = [12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055 for v in linear]
    shown = [a.get_images()[0].get_array() for a in panels]
    # The last crop is followed by its map of errors; images are halves, and both compute in doubles.
    check(np.allclose(shown[-2][17, 9], expected, atol=1e-6), f"pixel {shown[-2][17, 9]}, expected {expected}")
    check(shown[-2].shape == (31, 40, 3), f"a crop of {shown[-2].shape}")
    plt.close("all")
    former = json.loads(json.dumps(FIGURES_JSON).replace('"technique"', '"variant"'))
    check(read_crops(file, former, results) == read_crops(file, FIGURES_JSON, results), "the name that `technique` had is not read")

    def mistake(change, part):
        content = copy.deepcopy(FIGURES_JSON)
        change(content["crops"][1])
        try:
            draw(content)
            check(False, f"a mistake is not found: {part}")
        except ResultsError as e:
            check(part in str(e) and "\n" not in str(e), f"{part!r} is not in {e}")

    mistake(lambda c: c.update(box=[121, 50, 40, 31]), "figures.json: crops[1]: 'box' [121, 50, 40, 31] does not lie within its image of 160 x 90")
    mistake(lambda c: c.update(box=[1, 2, 3]), "figures.json: crops[1]: 'box' must be [x, y, width, height] in pixels, not [1, 2, 3]")
    mistake(lambda c: c.update(exposure="bright"), "crops[1]: 'exposure' must be a number of EV or \"auto\", not \"bright\"")
    mistake(lambda c: c.update(tone_curve="filmic"), "crops[1]: 'tone_curve' must be one of none, reinhard, aces")
    mistake(lambda c: c.update(target="specular"), "crops[1]: 'target' must be \"image\" as in the first crop")
    mistake(lambda c: c.update(shot="of no study"), "crops[1]: 'shot' must be one of " + SHOT)
    mistake(lambda c: c.pop("points"), "crops[1]: 'points' must be an array of {\"technique\", \"point\"}, and is missing")
    mistake(lambda c: c["points"].append({"technique": "gone", "point": ""}), "crops[1]: the results have no image of 'gone' for 'target' image in " + SHOT + ", frame 0")
    mistake(lambda c: c.update(tone_curv="aces"), "crops[1]: 'tone_curv' is not known; did you mean 'tone_curve'?")
    result = run_figures(folder, os.path.join(temporary, "none"), "--choice", os.path.join(temporary, "no file"))
    check(result.returncode == 2 and "no file" in result.stderr, f"a missing file: {result.returncode} {result.stderr}")


def test_mistakes(folder, temporary):
    for options, part in ((["--metric", "nonsense"], "metric nonsense"),):
        result = run_figures(folder, os.path.join(temporary, "none"), *options)
        check(
            result.returncode == 2 and part in result.stderr and result.stderr.count("\n") == 1,
            f"{options}: {result.returncode} {result.stderr}",
        )
    result = run_figures(temporary, os.path.join(temporary, "none"))
    check(
        result.returncode == 2 and "manifest.json" in result.stderr,
        f"a folder without results: {result.returncode} {result.stderr}",
    )
    check(not os.path.exists(os.path.join(temporary, "none")), "a failed run left a folder")


def test_folder_of_a_stranger(folder, temporary):
    """Neither a link nor the name of an image leads out of it. The folder is not used again."""
    outside = os.path.join(temporary, "outside")
    os.mkdir(outside)
    os.symlink(outside, os.path.join(folder, "figures"))
    result = subprocess.run([*figures, folder], capture_output=True, text=True)
    check(result.returncode == 2 and "figures is a symbolic link" in result.stderr and not os.listdir(outside), f"a link: {result.stderr}")
    results = Results(folder)
    for entry in results.manifest["images"]:
        entry["exr"] = "../outside/a.exr"
    try:
        results.images_of(SHOT, "image")
        check(False, "an image of another folder was read")
    except ResultsError as e:
        check("manifest.json: images: 'exr': " in str(e), e)


with tempfile.TemporaryDirectory(prefix="ssrlab_figures_") as temporary:
    folder = os.path.join(temporary, "results")
    subprocess.run([program, folder], check=True)
    test_exr(folder)
    keep_one_shot(folder)
    test_same_bytes(folder, temporary)
    test_chosen_figures(folder, temporary)
    test_chosen_crops(folder, temporary)
    test_mistakes(folder, temporary)
    test_folder_of_a_stranger(folder, temporary)
