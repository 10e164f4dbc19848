"""Draws the figures of a made-up results folder twice and looks at the files.

usage: report_figures_test.py REPORT_PAGE_PROGRAM FIGURES_SCRIPT
"""

import copy
import csv
import json
import os
import re
import subprocess
import sys
import tempfile

program, script = sys.argv[1:]
sys.path.insert(0, os.path.dirname(script))
sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "report"))
sys.dont_write_bytecode = True
os.environ["MPLBACKEND"] = "Agg"

try:
    import matplotlib.pyplot as plt
    import numpy as np
    from figures import SHOT_FIGURES, STUDY_FIGURES
    from matplotlib.text import Text
    from paper_figures import crops, effects, error_time, fetches, style
    from paper_figures.crop_choice import read_crops
    from paper_figures.exr import ExrError, read_exr_rgb
    from paper_figures.request import Request, read_colors, read_requests
    from paper_figures.results import Measured, Results, ResultsError, is_over_frames
    from report_crops import FIGURES_JSON, SHOT
except ImportError as missing:
    sys.exit(f"figures need python3-matplotlib and python3-numpy (tests/run.sh installs them): {missing}")


def check(is_true, what):
    if not is_true:
        sys.exit(f"report_figures_test: {what}")


def run_figures(folder, out, *options):
    return subprocess.run(
        [sys.executable, "-B", script, folder, "--out", out, *options], capture_output=True, text=True
    )


def request_of(kind, metric="relmse", **more):
    return Request(kind, kind, "specular", metric, "reflective", **more)


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


def test_sweep_figures(folder):
    """Lines and maps over parameters hold the numbers of the points that differ in these alone."""
    results = Results(folder).narrowed(["still_a.main.160x90.w8.r8"])
    errors = results.errors_of("specular", "relmse", "reflective", with_hidden=True)
    points = [("first", "first float_histories=true"), ("first round_up_tiles=true", "mended")]
    values = [[next(e.value for (_, _, name), e in errors.items() if name == p) for p in row] for row in points]
    chosen = request_of("map", options={"x": "float_histories", "y": "round_up_tiles", "where": {"race": False}})
    axes = STUDY_FIGURES["map"](results, chosen).get_axes()[0]
    check(np.allclose(axes.get_images()[0].get_array(), np.array(values) / np.min(values)), "ratios of the map")
    framed = [tuple(np.add(p.get_xy(), 0.43)) for p in axes.patches]
    check(set(framed) == {(1.0, 1.0)}, f"only the least is told from none: {framed}")
    chosen = request_of("response", options={"parameter": "float_histories", "where": {"round_up_tiles": True}, "show": "error"})
    figure = STUDY_FIGURES["response"](results, chosen)
    check(drawn(figure.get_axes(), "y") == sorted(values[1]), "the line over a parameter, of the others' values that are asked for")
    try:
        STUDY_FIGURES["map"](results, request_of("map", options={"x": "float_historie", "y": "race"}, where="f.json"))
        check(False, "a parameter that is none")
    except ResultsError as e:
        check("f.json: no point has the parameter 'float_historie'; did you mean 'float_histories'?" == str(e), e)
    narrow = Results(folder).narrowed(["still_a.main.160x90.w8.r8"], [("sssr", "mended")])
    split = next(s for s in narrow.splits if (s["target"], s["mask"]) == ("specular", "reflective"))
    figure = STUDY_FIGURES["convergence"](narrow, request_of("convergence", "mse", options={"over": "seeds"}))
    means = [float(split["bias_squared"]) + float(split["variance"]) / n for n in (1, 2, 3, 4)]
    check(np.allclose(drawn(figure.get_axes(), "y"), sorted(means), rtol=1e-9), "what the mean over seeds errs")
    plt.close("all")


def test_front(folder):
    """Fast and good points; those of an oracle take no part; where `ssrlab tradeoff` judged the same errors, its word counts."""
    exact = lambda v: Measured(v, 0.95 * v, 1.05 * v)
    places = {("v", name): (exact(t), exact(e)) for name, t, e in (("a", 1, 4), ("b", 2, 2), ("c", 2.05, 2.1), ("d", 4, 3), ("oracle", 1, 1))}
    results = Results(folder)
    results.variants = {("v", "oracle"): {"asks_scene": True}}
    line, beaten = error_time._judged(results, "s", places)
    check(line == [("v", "a"), ("v", "b")] and beaten == {("v", "d")}, f"{line}, {beaten}")
    os.makedirs(os.path.join(folder, "tradeoff"))
    for factor, is_same in ((1.0, True), (1.1, False)):
        with open(os.path.join(folder, "tradeoff", "front.csv"), "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["shot", "variant", "point", "error", "unit", "is_nominal_front", "verdict"])
            for (variant, name), (_, error) in places.items():
                verdict = "dominated" if name == "c" else "asks the scene" if name == "oracle" else "undecided"
                writer.writerow(["s", variant, name, factor * error.value, "ms", int(name in "abd"), verdict])
        line, beaten = error_time._judged(results, "s", places)
        check(([k[1] for k in line], {k[1] for k in beaten}) == ((["a", "b", "d"], {"c"}) if is_same else (["a", "b"], {"d"})), f"{line}, {beaten}")


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
    broken = os.path.join(folder, "broken.exr")
    with open(file, "rb") as whole, open(broken, "wb") as part:
        data = whole.read()
        part.write(data[: len(data) // 2])
    try:
        read_exr_rgb(broken)
        check(False, "a truncated EXR was read")
    except ExrError as e:
        check("broken.exr" in str(e), f"the message names no file: {e}")


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
    mistake(lambda c: c.pop("points"), "crops[1]: 'points' must be an array of {\"variant\", \"point\"}, and is missing")
    mistake(lambda c: c["points"].append({"variant": "gone", "point": ""}), "crops[1]: the results have no image of 'gone' for 'target' image in " + SHOT + ", frame 0")
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


def numbers(rows, column):
    return sorted(float(r[column]) for r in rows)


def drawn(panels, axis):
    """All values of marks and lines with marks along one axis."""
    lines = [
        line for a in panels for line in a.get_lines() if line.get_marker() not in ("None", "", None, "|", "_", "-")
    ]
    return sorted(float(v) for line in lines for v in (line.get_xdata() if axis == "x" else line.get_ydata()))


def test_study(folder):
    """What the figures of a study draw is what its tables hold; no text is smaller than 7 pt."""
    style.apply()
    results = Results(folder)
    chosen = request_of("", results.headline_metric())
    asked = ("response", "map", "convergence", "error_time")  # of these the file says more, or they are of a shot each
    figures_of = {name: draw(results, chosen) for name, draw in STUDY_FIGURES.items() if name not in asked}
    compared = effects.comparisons(results, chosen)
    figures_of |= {name: effects.draw(results, chosen, rows) for name, rows in compared.items()}
    check(figures_of.pop("fetches") is None, "one resolution has no fit")
    power, half = fetches.power_of([(rows, 3 * rows**0.5) for rows in (480, 720, 1080)])
    check(abs(power - 0.5) < 1e-9 and half < 1e-6, f"power {power}")  # rounding of logarithms
    panels = {name: [a for a in figure.get_axes() if a.has_data()] for name, figure in figures_of.items()}
    is_single = lambda r: "=" in r["point"]

    roughness = [r for r in results.errors if r["mask"].startswith("roughness") and not is_single(r)]
    check(
        drawn(panels["roughness_error"], "y") == numbers([r for r in roughness if r["metric"] == "relmse"], "value"),
        "errors by roughness",
    )
    check(
        drawn(panels["roughness_bias"], "y") == numbers([r for r in roughness if r["metric"] == "bias"], "value"),
        "biases by roughness",
    )
    with_ladder = {s["shot"] for s in results.manifest["shots"] if s.get("truth_ladder")}
    whole = [r for r in results.errors if r["shot"] in with_ladder and not is_single(r)]
    whole = numbers([r for r in whole if (r["metric"], r["mask"], r["target"]) == ("relmse", "reflective", "specular")], "value")
    check(with_ladder and drawn(panels["ladder"], "x") == whole, "errors over the limit")
    splits = [r for r in results.splits if not is_single(r)]
    expected = [v for s in splits for v in (float(s["bias_squared"]), float(s["variance"])) if v > 0]
    check(drawn(panels["bias_variance"], "x") == sorted(expected), "bias and variance")
    texts = [t.get_text() for a in panels["bias_variance"] for t in a.texts]
    check(len(texts) == 7 and all("about 0" in t for t in texts), f"biases that are not above 0: {texts}")
    all_effects = [
        e for e in results.effects if (e["metric"], e["mask"], e["variant"]) == ("relmse", "reflective", "sssr")
    ]
    is_baseline = lambda e: e["against"] == "baseline"
    against_baseline, otherwise_equal = filter(is_baseline, all_effects), [e for e in all_effects if not is_baseline(e)]
    check(drawn(panels["effects"], "x") == numbers(against_baseline, "ratio"), "effects")
    check(len(otherwise_equal) == 7, "the fixture compares two points that differ in one value, in each shot")
    check(drawn(panels["otherwise_equal"], "x") == numbers(otherwise_equal, "ratio"), "points otherwise equal")
    frames = [
        r
        for r in results.all_errors
        if (r["target"], r["metric"], r["mask"]) == ("specular", "relmse", "reflective") and not is_single(r)
    ]
    frames = [r for r in frames if not is_over_frames(r) and not r["shot"].startswith("still")]
    check(drawn(panels["frames"], "y") == numbers(frames, "value"), "errors of frames")
    check(
        any("cannot be told" in t.get_text() for a in panels["temporal"] for t in a.texts),
        "a value is missing silently",
    )

    shot = results.shots()[0]
    figures_of |= {name: draw(results, shot, chosen) for name, draw in SHOT_FIGURES.items()}
    figures_of["error_time"] = STUDY_FIGURES["error_time"](results.narrowed([shot]), chosen)
    check(
        [name for name, figure in figures_of.items() if figure is None] == ["crops"],
        "without images there are no crops",
    )
    check_text_sizes(figures_of)


def test_images_of_frames(folder):
    """Of a sequence whose frames all have images, those of the last, or of the one that a crop names."""
    results = Results(folder)
    for frame, number in ((None, 6), (4, 4)):
        images = results.images_of("moving.main.160x90.f3-6.w4", "image", frame)
        found = {key: float(image[0, 0, 0]) for key, image in images.items()}
        expected = {("reference", ""): 1 / number, ("sssr", "first"): 0.5 / number}
        check(found.keys() == expected.keys(), f"images of frame {frame}: {found}")
        check(all(abs(found[k] - v) < 1e-3 * v for k, v in expected.items()), f"images of frame {frame}: {found}")  # one may be stored as a half


def test_several_baselines(folder):
    """Each baseline has a figure of its own, and none of the comparisons is left out."""
    results = Results(folder)
    chosen = request_of("effects")
    of_one = effects.comparisons(results, chosen)
    second = [dict(e, variant="second", against_variant="second") for e in of_one["effects"]]
    results.effects += second
    of_two = effects.comparisons(results, chosen)
    check(
        sorted(of_two) == ["effects_second first", "effects_sssr first", "otherwise_equal"], f"figures: {sorted(of_two)}"
    )
    check(of_two["effects_second first"] == second, "comparisons with the second baseline")
    check(of_two["effects_sssr first"] == of_one["effects"], "comparisons with the first")


def test_ratios_far_from_one(folder):
    """They are written where they lie, and the others keep their scale."""
    results = Results(folder)
    chosen = request_of("effects")
    rows = effects.comparisons(results, chosen)["effects"]
    limits = effects.draw(results, chosen, rows).get_axes()[0].get_xlim()
    rows.append(dict(rows[0], ratio="328", low="17", high="6330"))
    figure = effects.draw(results, chosen, rows)
    check(figure.get_axes()[0].get_xlim() == limits, "a ratio of 328 changes the scale")
    check("328 [17, 6.33e3] →" in [t.get_text() for a in figure.get_axes() for t in a.texts], "a ratio of 328 is not written")
    plt.close("all")


def check_text_sizes(figures_of):
    for name, figure in figures_of.items():
        if figure is None:
            continue
        sizes = [t.get_fontsize() for t in figure.findobj(Text) if t.get_text()]
        check(sizes and min(sizes) >= 7, f"{name} has text of {min(sizes)} pt")
        plt.close(figure)


with tempfile.TemporaryDirectory(prefix="ssrlab_figures_") as temporary:
    folder = os.path.join(temporary, "results")
    subprocess.run([program, folder], check=True)
    test_exr(folder)
    keep_one_shot(folder)
    test_same_bytes(folder, temporary)
    test_chosen_figures(folder, temporary)
    test_chosen_crops(folder, temporary)
    test_mistakes(folder, temporary)
    study = os.path.join(temporary, "study")
    subprocess.run([program, "--study", study], check=True)
    test_study(study)
    test_sweep_figures(study)
    test_front(study)
    test_images_of_frames(study)
    test_several_baselines(study)
    test_ratios_far_from_one(study)
