"""Figures of a made-up study draw what its tables hold.

usage: study_figures_test.py REPORT_PAGE_PROGRAM
"""

import contextlib
import csv
import io
import os
import subprocess
import sys
import tempfile

from figures_start import check, outside, request_of

import matplotlib.pyplot as plt
import numpy as np
from ssrlab.figures.__main__ import SHOT_FIGURES, STUDY_FIGURES, drawn as figures_of_request, for_each_shot, make
from matplotlib.text import Text
from ssrlab.figures import effects, error_time, fetches, motion, style, sweeps
from ssrlab.figures.request import OPTIONS
from ssrlab.figures.numbers import short
from ssrlab.figures.request import Look
from PIL import Image
from ssrlab.mistakes import ResultsError
from ssrlab.results import Measured, Results, is_over_frames


def numbers(rows, column):
    return sorted(float(r[column]) for r in rows)


def drawn(panels, axis):
    """All values of marks and lines with marks along one axis."""
    lines = [
        line for a in panels for line in a.get_lines() if line.get_marker() not in ("None", "", None, "|", "_", "-")
    ]
    return sorted(float(v) for line in lines for v in (line.get_xdata() if axis == "x" else line.get_ydata()))


def check_text_sizes(figures_of):
    for name, figure in figures_of.items():
        if figure is None:
            continue
        sizes = [t.get_fontsize() for t in figure.findobj(Text) if t.get_text()]
        check(sizes and min(sizes) >= 7, f"{name} has text of {min(sizes)} pt")
        plt.close(figure)


def test_study(folder):
    """What the figures of a study draw is what its tables hold; no text is smaller than 7 pt."""
    style.apply()
    results = Results(folder)
    chosen = request_of("", results.headline_metric())
    asked = ("response", "map", "convergence", "error_time", "fits")  # of these the file says more, or they are of a shot each
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
        e for e in results.effects if (e["metric"], e["mask"], e["technique"]) == ("relmse", "reflective", "sssr")
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
        any("not determined" in t.get_text() for a in panels["temporal"] for t in a.texts),
        "a value is missing silently",
    )

    shot = results.shots()[0]
    figures_of |= {name: draw(results, shot, chosen) for name, draw in SHOT_FIGURES.items() if name != "stage_costs"}
    results.times = [t | {"disturbed_share": "0.25"} for t in results.times]
    figures_of["error_time"] = STUDY_FIGURES["error_time"](results.narrowed([shot]), chosen)
    note = figures_of["error_time"]._supxlabel.get_text().replace("\n", " ")
    check("other programs disturbed up to 25 % of the timed frames" in note, note)
    check(
        [name for name, figure in figures_of.items() if figure is None] == ["crops", "motion"],
        "without images there are no crops, and without frames no motion",
    )
    check_text_sizes(figures_of)


def test_motion(folder):
    """Frames of a GIF in order, each of truth and technique as they are displayed, and what they show."""
    results = Results(folder)
    shot = next(s for s in results.shots() if s.startswith("moving"))
    chosen = request_of("motion", points=[("sssr", "first")])
    with tempfile.TemporaryDirectory(prefix="ssrlab_motion_") as out:
        contents = []
        for name in ("one", "two"):
            (file,) = SHOT_FIGURES["motion"](results, shot, chosen).save(out, name)
            with open(file, "rb") as stream:
                contents.append(stream.read())
        check(contents[0] == contents[1], "the same results give other bytes")
        with Image.open(file) as gif:
            check(gif.n_frames == 4 and gif.info["comment"].decode().startswith(f"{shot}, specular, +2.5 EV"), f"{gif.n_frames} frames: {gif.info}")
            for index, frame in enumerate((3, 4, 5, 6)):
                gif.seek(index)
                picture = np.asarray(gif.convert("RGB"), dtype=float)
                for half, value in ((picture[:, : gif.width // 2], 1 / frame), (picture[:, gif.width // 2 :], 0.5 / frame)):
                    wanted = 255 * motion.display(np.full((1, 1, 3), value), 2.5)[0, 0]
                    middle = half[half.shape[0] // 2 - 20 : half.shape[0] // 2 + 20, half.shape[1] // 2 - 20 : half.shape[1] // 2 + 20]
                    # Pillow's median cut keeps six of eight bits where it can be.
                    check(np.abs(middle - wanted).max() <= 3, f"frame {frame}: {middle.mean()}, expected {wanted}")


def test_sweep_figures(folder):
    """Lines and maps over parameters hold the numbers of the points that differ in these alone."""
    results = Results(folder).narrowed(["still_a.main.160x90.w8.r8"])
    errors = results.errors_of("specular", "relmse", "reflective", with_hidden=True)
    points = [("first", "first float_histories=true"), ("first round_up_tiles=true", "fixed")]
    values = [[next(e.value for (_, _, name), e in errors.items() if name == p) for p in row] for row in points]
    chosen = request_of("map", options={"x": "float_histories", "y": "round_up_tiles", "where": {"race": False}})
    axes = STUDY_FIGURES["map"](results, chosen).get_axes()[0]
    check(np.allclose(axes.get_images()[0].get_array(), np.array(values) / np.min(values)), "ratios of the map")
    framed = [tuple(np.add(p.get_xy(), 0.43)) for p in axes.patches]
    check(set(framed) == {(1.0, 1.0)}, f"only the least is distinguishable from none: {framed}")
    chosen = request_of("response", options={"parameter": "float_histories", "where": {"round_up_tiles": True}, "show": "error"})
    figure = STUDY_FIGURES["response"](results, chosen)
    check(drawn(figure.get_axes(), "y") == sorted(values[1]), "the line over a parameter, of the others' values that are asked for")
    try:
        STUDY_FIGURES["map"](results, request_of("map", options={"x": "float_historie", "y": "race"}, where="f.json"))
        check(False, "a parameter that is none")
    except ResultsError as e:
        check("f.json: no point has the parameter 'float_historie'; did you mean 'float_histories'?" == str(e), e)
    narrow = Results(folder).narrowed(["still_a.main.160x90.w8.r8"], [("sssr", "fixed")])
    split = next(s for s in narrow.splits if (s["target"], s["mask"]) == ("specular", "reflective"))
    figure = STUDY_FIGURES["convergence"](narrow, request_of("convergence", "mse", options={"over": "seeds"}))
    means = [float(split["bias_squared"]) + float(split["variance"]) / n for n in (1, 2, 3, 4)]
    check(np.allclose(drawn(figure.get_axes(), "y"), sorted(means), rtol=1e-9), "what the mean over seeds errs")
    plt.close("all")


def test_figures_of_sweeps(folder):
    """Without figures.json, each parameter of a sweep has a `response`, and two together have a `map`; scattered points have none."""
    shot = "still_a.main.160x90.w8.r8"
    results = Results(folder)
    names = ("first", "first float_histories=true", "first round_up_tiles=true", "fixed")
    check(sweeps.unasked(results, request_of("")) == [], "a study without a sweep")
    for name in names:
        entry = results.techniques["sssr", name]
        entry["swept"] = {k: entry["parameters"][k] for k in ("float_histories", "round_up_tiles", "form")}
    results.hidden, results.single_changes = set(), {}
    found = sweeps.unasked(results, request_of("", shots=[shot]))
    expected = ["response_sssr_float_histories", "response_sssr_round_up_tiles", "map_sssr_float_histories_round_up_tiles"]
    check([r.name for r in found] == expected, f"figures: {[r.name for r in found]}")
    with tempfile.TemporaryDirectory(prefix="ssrlab_sweeps_") as out:
        check(make(results, found, Look(formats=("svg",)), out) == 3 and len(os.listdir(out)) == 3, f"files: {os.listdir(out)}")
    for name in names[1:3]:
        del results.techniques["sssr", name]["swept"]
    check(sweeps.unasked(results, request_of("")) == [], "two points that differ in two values are neither a line nor a map")
    plt.close("all")


def test_long_names(folder):
    """Whatever points and shots are called, all kinds of figures keep their texts in the picture, in a column too."""
    results = Results(folder)
    for technique, point in results.techniques:
        results.labels[f"{technique} {point}" if point != "default" else technique] = f"mcguire_dda_with_history {point} dda.stride=8 dda.thickness=0.05 hierarchy.max_traversal_intersections=128"
    for shot in results.shots():
        results.labels[shot] = f"breakfast_room_glossy_floor_{shot}.Camera.001.1920x1080"
    options = {
        "response": {"parameter": "float_histories"},
        "map": {"x": "float_histories", "y": "round_up_tiles", "where": {"race": False}},
        "convergence": {"over": "frame"},
        "stage_costs": {"quantity": "bytes_read"},
    }
    view, width = results.narrowed(["moving.main.160x90.f3-6.w4"]), style.WIDTHS["column"]  # a shot of which most kinds have something
    style.apply("sans", width)
    for kind in OPTIONS:
        for name, figure in figures_of_request(view, request_of(kind, results.headline_metric(), width=width, options=options.get(kind, {}))):
            if figure is None or kind == "motion":
                continue
            style.lay_out(figure)
            check(outside(figure) == [], f"{name}: {outside(figure)} leave the picture")
            narrowest = min(a.get_window_extent().width for a in figure.axes if a.has_data() and a.get_label() != "<colorbar>") / figure.dpi / style.CENTIMETRE
            check(narrowest > 2, f"{name}: a panel is {narrowest:.1f} cm wide")
            plt.close(figure)
    style.apply()


def test_front(folder):
    """The front and what is pale are as summary.csv says, whatever the numbers are."""
    exact = lambda v: Measured(v, 0.95 * v, 1.05 * v)
    places = {("v", name): (exact(t), exact(e)) for name, t, e in (("a", 1, 4), ("b", 2, 2), ("c", 2.05, 2.1), ("d", 0.5, 1))}
    results, chosen = Results(folder), request_of("error_time", "mse")
    said = {"a": ("bytes time", "no"), "b": ("time", "maybe"), "c": ("", "yes"), "d": ("bytes", "yes")}
    error = {"shot": "s", "target": chosen.target, "metric": chosen.metric, "mask": chosen.mask, "technique": "v"}
    results.errors = [error | {"point": p, "fronts": fronts, "dominated": dominated} for p, (fronts, dominated) in said.items()]
    line, beaten = error_time._judged(results, "s", chosen, places)
    check(line == [("v", "a"), ("v", "b")] and beaten == {("v", "c"), ("v", "d")}, f"{line}, {beaten}")

    few, many = list(range(20)), list(range(21))
    check(error_time.numbered(few, {3}) == few and error_time.numbered(many, {20, 3}) == [3, 20], "of many marks those on the front have numbers")


def refused(draw, chosen, part, *arguments):
    try:
        draw(*arguments, chosen)
        check(False, f"a mistake is not found: {part}")
    except ResultsError as e:
        check(part in str(e) and "\n" not in str(e), f"{part!r} is not in {e}")


def test_stage_costs(folder):
    """Bars are as long as the stages' counts, behind them the total; a stage that does nothing has no name."""
    results = Results(folder)
    shot, draw = results.shots()[0], SHOT_FIGURES["stage_costs"]
    results.costs.append(results.costs[0] | {"stage": "sssr/nothing", "quantity": "bytes_read", "value": "0"})
    chosen = request_of("stage_costs", options={"quantity": "bytes_read"}, where="f.json")
    axes = draw(results, shot, chosen).axes[0]
    check(sorted(bar.get_width() for bars in axes.containers for bar in bars) == [4e6, 4e6, 8e6, 8e6], "lengths of bars")
    texts = [t.get_text().replace("\N{NO-BREAK SPACE}", " ") for t in axes.texts]
    check(sorted(texts) == ["12.0 M", "12.0 M", "sssr", "stage_0", "stage_1"], texts)
    check([axes.xaxis.get_major_formatter()(x, 0).replace("\N{NO-BREAK SPACE}", " ") for x in (0, 2.5e6)] == ["0", "2.5 M"], "ticks")
    chosen.options["quantity"] = "bytes_rea"
    refused(draw, chosen, "f.json: 'quantity' = \"bytes_rea\" was not counted; did you mean 'bytes_read'?", results, shot)
    results.costs = []
    check(draw(results, shot, chosen) is None, "a study that counted nothing")
    plt.close("all")


def test_stage_estimates(folder):
    """Bars are as long as the stages' estimates, behind them the total with its interval; each chip with estimates has a figure."""
    results = Results(folder)
    shot, draw = results.shots()[0], SHOT_FIGURES["stage_estimates"]
    check(results.estimated_chips() == ["navi21", "gfx1100"], "chips without an estimate are none")
    chosen = request_of("stage_estimates", where="f.json")
    figure = draw(results, shot, chosen)
    axes = figure.axes[0]
    lengths = lambda figure: sorted(bar.get_width() for bars in figure.axes[0].containers if hasattr(bars, "patches") for bar in bars)
    check(lengths(figure) == [4, 4, 12, 16], "lengths of bars")
    ends = sorted(tuple(segment[:, 0]) for bars in axes.collections for segment in bars.get_segments())
    check(ends == [(12, 20), (15, 25)], f"intervals of totals: {ends}")
    texts = sorted(t.get_text() for t in axes.texts)
    check(texts == ["16.0 [12.0, 20.0]", "20.0 [15.0, 25.0]", "sssr", "stage_0", "stage_1"], texts)
    said = lambda figure: figure._supxlabel.get_text().replace("\n", " ")
    check("microseconds on navi21 (estimate)" in said(figure) and "left out" not in said(figure), said(figure))
    chosen.options["chip"] = "gfx1100"
    figure = draw(results, shot, chosen)
    check(lengths(figure) == [4, 16], "a point without a total has no bar")
    check("left out, since a stage has no estimate: sssr fixed" in said(figure), said(figure))
    chosen.options["chip"] = "gfx110"
    refused(draw, chosen, "f.json: 'chip' = \"gfx110\" has no estimates; did you mean 'gfx1100'?", results, shot)
    look, of_chips = Look(formats=("svg",)), ["stage_estimates_gfx1100.svg", "stage_estimates_navi21.svg"]
    for options, names in (({}, of_chips), ({"chip": "navi21"}, ["stage_estimates.svg"])):
        with tempfile.TemporaryDirectory(prefix="ssrlab_chips_") as out:
            make(results, [request_of("stage_estimates", shots=[shot], options=options)], look, out)
            check(sorted(os.listdir(out)) == names, f"files: {os.listdir(out)}")
    results.estimates = []
    chosen.options = {}
    check(draw(results, shot, chosen) is None, "a study without estimates")
    plt.close("all")


def test_fits(folder):
    """Points, curves, floors and the rung are where the files of `ssrlab tradeoff` have them; those of other errors are refused."""
    results = Results(folder)
    shot = next(s["shot"] for s in results.manifest["shots"] if s.get("truth_ladder"))
    rung = next(r for r in results.shot_entries[shot]["truth_ladder"] if (r["rung"], r["metric"], r["mask"], r["target"]) == ("on_screen", "relmse", "reflective", "specular"))
    errors = results.errors_of("specular", "relmse", "reflective", with_hidden=True)
    points = {key[2]: e.value for key, e in errors.items() if key[:2] == (shot, "sssr") and e.value > 0}
    costs = {name: 2.0**i for i, name in enumerate(points)}
    check(len(points) >= 4, f"too few points: {points}")
    floor, a, b = 0.5 * min(points.values()), max(points.values()), 1.25
    fit = {"shot": shot, "technique": "sssr", "parameter": "float_histories", "fixed": "", "point_names": "; ".join(points), "unit": "ms"}
    law = fit | {"status": "fitted", "floor": floor, "floor_low": 0.9 * floor, "floor_high": 1.1 * floor, "a": a, "b": b}
    none = fit | {"parameter": "race", "status": "the error does not surely fall with the cost"}
    place = {"shot": shot, "technique": "sssr", "unit": "ms"}
    front = [place | {"point": p, "error": e, "error_low": e, "error_high": e, "cost": costs[p], "cost_low": costs[p], "cost_high": costs[p]} for p, e in points.items()]

    def write(name, rows):
        os.makedirs(os.path.join(folder, "tradeoff"), exist_ok=True)
        with open(os.path.join(folder, "tradeoff", name), "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)

    write("front.csv", front)
    write("fits.csv", [law, none])
    draw = STUDY_FIGURES["fits"]
    figure = draw(results, request_of("fits"))
    panel = figure.get_axes()[0]
    check(drawn([panel], "x") == sorted([*costs.values()] * 2) and drawn([panel], "y") == sorted([*points.values()] * 2), "points")
    (curve,) = (line for line in panel.get_lines() if len(line.get_xdata()) > 2)
    check(np.allclose(curve.get_ydata(), floor + a * curve.get_xdata() ** -b) and max(curve.get_xdata()) == max(costs.values()), "the curve")
    across = [line.get_ydata()[0] for line in panel.get_lines() if list(line.get_xdata()) == [0, 1]]
    check(np.allclose(sorted(across), sorted([floor, rung["value"]])), f"lines across the panel: {across}")
    check("no law, as the error does not surely fall with the cost: sssr over race" in figure._supxlabel.get_text().replace("\n", " "), "no law")
    check({"true", "false"} >= {t.get_text() for t in panel.texts} != set(), f"values of the parameter: {[t.get_text() for t in panel.texts]}")
    rung["value"] = 1e-9 * min(points.values())
    panel = draw(results, request_of("fits")).get_axes()[0]
    far = f"limit of one frame: {short(rung['value'])} \N{DOWNWARDS ARROW}"
    check(far in [t.get_text() for t in panel.texts] and panel.get_ylim()[0] > 0.01 * floor, "a rung far below flattens the points")
    check(draw(results, request_of("fits", points=[("sssr", next(iter(points)))])) is None, "a law without all of its points")
    check(draw(results, request_of("fits", metric="mse")) is None, "nobody asked for fits of another error")
    refused(draw, request_of("fits", metric="mse", where="f.json"), "is not of mse of specular, reflective pixels", results)
    write("fits.csv", [fit | {"shot": "another"}])
    check(draw(results, request_of("fits", where="f.json")) is None, "fits of other shots alone")
    write("fits.csv", [{k: v for k, v in law.items() if k != "point_names"}])
    refused(draw, request_of("fits", where="f.json"), "is of an earlier version: run `ssrlab tradeoff", results)
    os.remove(os.path.join(folder, "tradeoff", "fits.csv"))
    refused(draw, request_of("fits", where="f.json"), "f.json: tradeoff/fits.csv is missing", results)
    plt.close("all")


def test_images_of_frames(folder):
    """Of a sequence whose frames all have images, those of the last, or of the one that a crop names."""
    results = Results(folder)
    for frame, number in ((None, 6), (4, 4)):
        images = results.images_of("moving.main.160x90.f3-6.w4", "specular", frame)
        found = {key: float(image[0, 0, 0]) for key, image in images.items()}
        expected = {("reference", ""): 1 / number, ("sssr", "first"): 0.5 / number}
        check(found.keys() == expected.keys(), f"images of frame {frame}: {found}")
        check(all(abs(found[k] - v) < 1e-3 * v for k, v in expected.items()), f"images of frame {frame}: {found}")  # one may be stored as a half


def test_several_baselines(folder):
    """Each baseline has a figure of its own, and none of the comparisons is left out."""
    results = Results(folder)
    chosen = request_of("effects")
    of_one = effects.comparisons(results, chosen)
    second = [dict(e, technique="second", against_technique="second") for e in of_one["effects"]]
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
    rows.append(dict(rows[0], ratio="328", low_holm="17", high_holm="6330"))
    figure = effects.draw(results, chosen, rows)
    check(figure.get_axes()[0].get_xlim() == limits, "a ratio of 328 changes the scale")
    check("328 [17, 6.33e3] →" in [t.get_text() for a in figure.get_axes() for t in a.texts], "a ratio of 328 is not written")
    plt.close("all")


def test_a_shot_without_such_pixels(folder):
    """What was not asked for by name leaves it out and says so; what was is a mistake."""
    results = Results(folder)
    shot, other = results.shots()[:2]
    results.errors = [r for r in results.errors if (r["shot"], r["mask"]) != (shot, "reflective")]
    look, said = Look(formats=("svg",)), io.StringIO()
    with tempfile.TemporaryDirectory(prefix="ssrlab_lacking_") as out, contextlib.redirect_stdout(said):
        make(results, for_each_shot(results, [request_of("error_time", shots=[shot, other])]), look, out)
        check(os.listdir(out) == [f"error_time_{other}.svg"], f"files: {os.listdir(out)}")
        try:
            make(results, [request_of("error_time", shots=[shot], where="figures[0]")], look, out)
            check(False, "a figure that was asked for is not there, and nobody says so")
        except ResultsError as mistake:
            check("mask reflective" in str(mistake), str(mistake))
    expected = f"note: {results.shot_label(shot)} has no error of target specular, metric relmse, mask reflective: figures of that leave it out\n"
    check(said.getvalue() == expected, said.getvalue())


with tempfile.TemporaryDirectory(prefix="ssrlab_figures_") as temporary:
    study = os.path.join(temporary, "study")
    subprocess.run([sys.argv[1], "--study", study], check=True)
    test_study(study)
    test_motion(study)
    test_sweep_figures(study)
    test_figures_of_sweeps(study)
    test_long_names(study)
    test_front(study)
    test_stage_costs(study)
    test_stage_estimates(study)
    test_fits(study)
    test_images_of_frames(study)
    test_several_baselines(study)
    test_ratios_far_from_one(study)
    test_a_shot_without_such_pixels(study)
