"""A picture for each page of answers (experiments/studies/questions/pictures/NAME.svg), from the kept summaries (experiments/studies/summaries) and from advice.csv.

usage: python3 experiments/python question_pictures [--out DIR] [NAME ...]

Without names all. Each file holds a hash of the numbers that it shows, by which a test knows whether it is up to date. Needs
Debian's python3-matplotlib and -numpy, and the built ssrlab for means over scenes. Over 400 lines: a list of functions, one for each picture, that know nothing of each other.
"""

import io
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from ssrlab.command_lines import CommandLine
from ssrlab.csv_files import number
from ssrlab.figures import style
from ssrlab.figures.summary_picture import GREY, Mark, Panel, Picture, draw, shown_numbers
from ssrlab.tables import shot_names, summary_file
from ssrlab.tables.advice import Advice, kind_of
from ssrlab.tables.cell import Cell
from ssrlab.tables.documents import Numbers
from ssrlab.mistakes import exit_code
from ssrlab.repository import QUESTIONS, SUMMARIES

OUT = QUESTIONS / "pictures"
WIDTH = style.WIDTHS["slide"]  # cm: letters that can be read where a page is narrowed to a column of text
TECHNIQUES = ["mcguire_dda", "amd_sssr", "diligent_ssr", "frostbite_sssr", "simple_ssr", "four_mode_ssr"]  # colours, as in the README's pictures
PUBLISHED = ["mcguire_dda", "amd_sssr, repeatable", "diligent_ssr, current", "frostbite_sssr, frostbite_2015"]
BEST = ["mcguire_dda, best", "amd_sssr, best", "diligent_ssr, best", "frostbite_sssr, best", "simple_ssr, corrected", "four_mode_ssr, corrected"]


def grid(study, table):
    """{(row, column): Cell}, with short names of shots in both."""
    _, tables = summary_file.read(str(SUMMARIES / f"{study}.csv"))
    about, cells = tables[table]
    names = {word for c in cells for name in (c.row, c.column) for word in name.split(", ")} & set(about["shots"])
    short = shot_names.short_names(sorted(names, key=about["shots"].index))
    shown = lambda name: ", ".join(short.get(word, word) for word in name.split(", "))  # noqa: E731
    return {(shown(c.row), shown(c.column)): c for c in cells}


def look(point):
    """Colour and mark of a point's technique."""
    technique = point.split(",")[0]
    return (GREY, "|") if technique == "none" else style.series(TECHNIQUES.index(technique))


def technique_mark(point, cell, series="", is_hollow=False):
    return Mark(series, *look(point), cell, is_hollow)


def techniques():
    numbers = Numbers(str(SUMMARIES), __file__)

    def mark(point, base):
        if point == base:
            return Cell("", point, "", 1.0)
        return Cell("", point, "", *numbers.ratio_over_scenes("comparison", "by_scene", point, base, as_in="gains"))

    points = [*PUBLISHED, *BEST]
    by_error = sorted(points, key=lambda p: mark(p, "none").value)
    return Picture(
        [
            Panel("error over that of no reflections", [(p, [technique_mark(p, mark(p, "none"), is_hollow=p in PUBLISHED)]) for p in by_error], 1.0),
            Panel("error over that of Frostbite's best", [(p, [technique_mark(p, mark(p, "frostbite_sssr, best"), is_hollow=p in PUBLISHED)]) for p in by_error], 1.0),
        ],
        "ratio of MSE, mean over scenes like these, 95 % intervals",
        columns=2,
        note="hollow: as published",
    )


def budgets():
    cells = grid("quality", "at_time")
    times = ["5 ms", "10 ms", "20 ms", "40 ms"]
    marks = {t: [(p, [technique_mark(p, cells[p, t], is_hollow=cells[p, t].mean_of < 16)]) for p in TECHNIQUES] for t in times}
    return Picture(
        [Panel(f"within {t}", rows, 1.0) for t, rows in marks.items()], "error over that of no reflections, 95 % intervals", columns=4, extra={"xlim": (0.13, 1.8)}, note="hollow: fits in some of the 16 scenes only"
    )


def rooms():
    panels = []
    for table, titles in (("at_time", {f"{t} ms": f"within {t} ms" for t in (5, 10, 20, 40)}), ("by_place", {})):
        cells = grid("rooms", table)
        for column in titles or dict.fromkeys(c for _, c in cells):
            marks = [(p, [technique_mark(p, cells[p, column])] if (p, column) in cells else []) for p in TECHNIQUES]
            panels.append(Panel(titles.get(column, f"40 ms: {column}"), marks, 1.0))
    return Picture(panels, "FLIP over that of no reflections but the probe's, 95 % intervals", columns=4, is_log=False, extra={"xlim": (0.5, 1.15)})


def metrics():
    cells = grid("comparison", "eye")
    rows = [(row, [Mark("", style.COLORS[0], "o", c)]) for (row, _), c in sorted(cells.items(), key=lambda item: -item[1].value)]
    return Picture([Panel("", rows, 0.5)], "share of 43 pairs that the metric orders as the readers did, 95 % intervals; line: chance", is_log=False, columns=1, extra={"xlim": (0.2, 1.02)})


def visibility():
    cells = grid("visibility", "agreement")
    rows = [(row, [Mark("", style.COLORS[0], "o", c)]) for (row, column), c in sorted(cells.items(), key=lambda item: -item[1].value) if column == "cvvdp_0_5_6_video" and row != column]
    return Picture([Panel("", rows, 0.0)], "rank correlation with visibility in JOD, 95 % intervals over scenes; line: chance", is_log=False, columns=1, extra={"xlim": (-0.2, 1.02)})


CAUSES = {
    "right": "the ray was right",
    "unavoidable_miss": "not on the screen",
    "empty": "nothing to meet",
    "avoidable_miss": "missed what the screen shows",
    "wrong_place": "hit elsewhere",
    "false_hit": "false hit",
    "untraced": "not traced",
}


def causes():
    cells = grid("comparison", "causes")
    rows = []
    for point in ["mcguire_dda, best", "amd_sssr, repeatable", "amd_sssr, best", "diligent_ssr, best", "frostbite_sssr, best", "simple_ssr, corrected", "four_mode_ssr, corrected"]:
        rows.append((point, [Mark(text, style.COLORS[i], "", cells[point, f"error: {name}"]) for i, (name, text) in enumerate(CAUSES.items())]))
    return Picture([Panel("", rows)], "share of the squared error, mean over 43 shots", is_log=False, columns=1, kind="bars", extra={"xlim": (0, 1)})


LIMITS = ["mirror_pillars", "roughness_gradient", "contact_hardening", "fence", "metal_corner", "floating_holes", "curved_mirror", "offscreen_mirror", "border_crossing"]
LIMITS += ["passing_pillars", "moving_objects", "stepping_emitter", "modern_hall_mirror_floor", "metal_rough_spheres", "cesium_milk_truck"]


def limit():
    cells = grid("comparison", "limits")
    points = ["none, default", *BEST[:4]]
    rows = [(shot, [technique_mark(p, cells[shot, p], p) for p in points]) for shot in sorted(LIMITS, key=lambda s: cells[s, "frostbite_sssr, best"].value)]
    return Picture([Panel("", rows, 1.0)], "MSE over the information limit of one frame (line), 95 % intervals", columns=1)


def third_party():
    cells = grid("comparison", "third_party")
    shots = sorted({row for row, _ in cells}, key=lambda s: cells[s, "frostbite_sssr, best"].value)
    points = ["none", "mcguire_dda", *BEST]
    rows = [(shot, [technique_mark(p, cells[shot, p], p, is_hollow=p == "mcguire_dda") for p in points]) for shot in shots]
    return Picture([Panel("", rows)], "FLIP of the reflection (intervals by seeds are smaller than the marks); hollow: as published", is_log=False, columns=1)


def corrections():
    of_amd, of_diligent = grid("amd_sssr", "changes"), grid("diligent", "changes")
    amd = ["corrected", "repeatable hierarchy.thickness_at_hit_mip=true", "repeatable running_variance=true", "repeatable redraw_below_horizon=true", "repeatable float_histories=true"]
    amd += ["repeatable fresh_neighborhood=true", "repeatable trace_orphans=true", "repeatable independent_noise_shifts=true", "repeatable inward_rays=black"]
    diligent = ["corrected", "current temporal_radiance_stability_factor=0.9", "current premultiply_confidence=true", "current own_ray=true", "current float_histories=true"]
    diligent += ["current linear_hit_depth=true", "current guard_previous_clip=true"]

    def rows(names, cells, technique, prefix=""):
        label = lambda name: "all (corrected)" if name == "corrected" else name.split(" ")[1].removeprefix("hierarchy.").removesuffix("=true")  # noqa: E731
        return [(label(name), [technique_mark(technique, cells[prefix + name, "mse"])]) for name in names]

    return Picture(
        [Panel("AMD SSSR", rows(amd, of_amd, "amd_sssr"), 1.0), Panel("DiligentFX", rows(diligent, of_diligent, "diligent_ssr", "diligent_ssr, "), 1.0)],
        "MSE over that of the published form, mean over six shots; thin: range over the shots",
        has_range=True,
        columns=2,
    )


def estimators():
    cells = grid("frostbite", "forms")
    panels = []
    for lobe, bias, title in (("visible_normals", "0.7", "visible normals, cut off at 0.7"), ("normals", "0.0", "all normals, the whole lobe")):
        rows = []
        for scene in ("contact_hardening", "firefly", "glossy_stretch", "metal_corner", "roughness_gradient"):
            marks = []
            for i, (form, taps) in enumerate((form, taps) for form in "bc" for taps in (4, 16)):
                cell = cells[f"lobe = {lobe}, importance_bias = {bias}, {scene}", f"estimator = {form}, taps = {taps}, max_rays = 1"]
                marks.append(Mark(f"{form}, {taps} rays", style.COLORS[i // 2], "os"[i % 2], cell, taps == 16))
            rows.append((scene, marks))
        panels.append(Panel(title, rows, 1.0))
    return Picture(panels, "MSE over that of form a with the same rays, 95 % intervals", columns=2)


def march():
    cells = grid("parts", "absolute")
    panels = []
    for scene in ("fence", "floating_holes", "roughness_gradient", "metal_corner"):
        rows = []
        for point, others in (("amd_sssr, corrected", "cells"), ("diligent_ssr, corrected", "cells"), ("frostbite_sssr, best", "hierarchy")):
            color, _ = look(point)
            names = {point: ("own march", "o"), f"{point} tracer={others}": {"cells": ("cell by cell", "s"), "hierarchy": ("AMD's march", "^")}[others], f"{point} tracer=exact_scene": ("exact rays", "D")}
            rows.append((point, [Mark(text, color, mark, cells[name, scene], mark == "D") for name, (text, mark) in names.items()]))
        panels.append(Panel(scene, rows))
    return Picture(panels, "MSE of the reflection, 95 % intervals", columns=2)


def thickness():
    cells = grid("tracers_thickness", "mse")
    panels = []
    for scene in ("fence", "floating_holes", "curved_mirror", "metal_corner", "moving_objects", "sponza"):
        rows = []
        for value in ("0.001", "0.01", "0.05", "0.25", "1", "10"):
            marks = []
            for name, text, color, mark in (
                ("dda.relative_thickness", "linear tracing", style.COLORS[0], "o"),
                ("hierarchy.relative_depth_buffer_thickness", "AMD's hierarchy", style.COLORS[1], "s"),
            ):
                if (f"{name}={value}", scene) in cells:
                    marks.append(Mark(text, color, mark, cells[f"{name}={value}", scene]))
            rows.append((value, marks + [Mark("exact rays", GREY, "", cells["tracer=exact_scene", scene])]))
        panels.append(Panel(scene, rows))
    return Picture(panels, "thickness, as a share of the depth (intervals are smaller than the marks)", kind="lines")


def temporal():
    frostbite, amd = grid("frostbite_whole", "choices"), grid("amd_stages", "stages")
    shots = {"roughness_gradient": "at rest: roughness_gradient", "passing_pillars": "in motion: passing_pillars", "thin_pole": "in motion: thin_pole"}
    names = ["temporal_filter=false", "history_weight=0.8", "history_weight=0.95", "neighborhood_clamp=false", "previous_frame=false"]
    rows = [
        (name, [Mark(text, style.COLORS[i], style.MARKS[i], frostbite[f"frostbite_2015 {name}", f"mse, {shot}"], i == 0) for i, (shot, text) in enumerate(shots.items())])
        for name in names
    ]
    stages = ["prefilter=false", "reprojection=false", "temporal_resolve=false", "denoise=false"]
    of_amd = [(name, [Mark("mean of three, two of which move", GREY, "D", amd[f"repeatable {name}", "mse"])]) for name in stages]
    return Picture([Panel("Frostbite", rows, 1.0), Panel("AMD SSSR", of_amd, 1.0)], "MSE over that of the published form, 95 % intervals", columns=2)


def half_histories():
    cells = grid("half_histories", "energy")
    points = {"amd_sssr, repeatable": "AMD", "diligent_ssr, current": "DiligentFX", "frostbite_sssr,": "Frostbite", "four_mode_ssr,": "four-mode pass"}
    panels = []
    for scene, frames in (("roughness_gradient", (15, 63, 511)), ("metal_corner", (15, 63))):
        rows = []
        for n in frames:
            marks = []
            for point, text in points.items():
                half, whole = (cells[f"{point} float_histories={kind}", f"{scene} after {n} frames"].value for kind in ("false", "true"))
                color, shape = look(point)
                marks.append(Mark(text, color, shape, Cell("", point, "", half / whole)))
            rows.append((str(n + 1), marks))
        panels.append(Panel(scene, rows))
    return Picture(panels, "frames at rest; light with histories in half floats over light with floats", kind="lines", columns=2)


def fragments():
    cells, means = grid("best", "times"), grid("diligent", "stage_times")
    same = ["amd_sssr, repeatable", "amd_sssr, corrected", "diligent_ssr, current", "diligent_ssr, corrected"]
    of_same = [(p, [technique_mark(p, means["total", p], is_hollow="corrected" not in p)]) for p in same]
    points = ["amd_sssr, repeatable", "amd_sssr, best", "diligent_ssr, current", "diligent_ssr, best"]
    shots = {"contact_hardening": "320x184", "fence": "320x184", "moving_emitter": "320x184", "metal_corner": "960x540"}
    rows = [(f"{shot}, {size}", [technique_mark(p, cells[p, shot], p, "best" not in p) for p in points]) for shot, size in shots.items()]
    panels = [Panel("the same surfaces, mean over six shots", of_same), Panel("what their presets trace", rows)]
    return Picture(panels, "time of a frame's reflections (ms), 95 % intervals; hollow: as published", columns=2)


def resolution():
    cells = grid("resolutions", "errors")
    points = {"mcguire_dda, any_scale": "no limit", "mcguire_dda, dda.max_steps=128": "128 steps"}
    points |= {f"{t} hierarchy.max_traversal_intersections={n}": f"{n} steps" for t in ("amd_sssr, repeatable", "diligent_ssr, current") for n in (4096, 128)}
    points["frostbite_sssr, best"] = "best"
    panels = []
    for scene in ("fence", "mirror_pillars", "roughness_gradient"):
        rows = []
        for point, text in points.items():
            color, _ = look(point)
            sizes = [("320x180", True), ("1920x1080", False)]
            rows.append((f"{point.split(',')[0]}, {text}", [Mark(size, color, "o", cells[point, f"{scene} {size}"], is_small) for size, is_small in sizes]))
        panels.append(Panel(scene, rows))
    return Picture(panels, "MSE of the reflection, 95 % intervals (most are smaller than the marks)", columns=3)


def traced_environment():
    cells = grid("lit_specular", "mse")
    points = ["mcguire_dda, best", "amd_sssr, corrected", "diligent_ssr, corrected", "frostbite_sssr, best", "simple_ssr, corrected", "four_mode_ssr, corrected"]

    def marks(scene, point):
        return [technique_mark(point, cells[f"{scene}{lit}", point], series, lit == "") for lit, series in (("", "without"), (" environment", "with"))]

    panels = [Panel(scene, [(p, marks(scene, p)) for p in points], 1.0) for scene in ("furnace", "curved_metal", "metal_corner", "sponza")]
    return Picture(panels, "error over the error without reflections, 95 % intervals", columns=4)


def compilers():
    passes = {  # what takes most registers: (technique, as published, other form, its name, pass)
        "AMD, march": ("amd_sssr", "sdk_1_5", "best", "best", "amd_sssr/intersect"),
        **{f"AMD, {name}": ("amd_sssr", "sdk_1_5", "repeatable denoiser_form=fast", "the form for CPUs", f"amd_sssr/{stage}")
           for name, stage in (("reprojection", "reproject"), ("prefilter", "prefilter"), ("history", "resolve_temporal"))},
        "DiligentFX, march": ("diligent_ssr", "current", "best_2x", "best", "diligent_ssr/intersection"),
        "DiligentFX, filter": ("diligent_ssr", "current", "best_2x", "best", "diligent_ssr/spatial_reconstruction"),
        "DiligentFX, history": ("diligent_ssr", "current", "best_2x", "best", "diligent_ssr/temporal_accumulation"),
        "Frostbite, march": ("frostbite_sssr", "frostbite_2015", "best", "best", "frostbite_sssr/trace_smooth"),
        "Frostbite, filter": ("frostbite_sssr", "frostbite_2015", "best", "best", "frostbite_sssr/resolve"),
        "Frostbite, history": ("frostbite_sssr", "frostbite_2015", "best", "best", "frostbite_sssr/accumulate"),
        "linear tracing": ("mcguire_dda", "published", "best", "best", "mcguire_dda/trace"),
        "plain rays": ("simple_ssr", "blog", "best_2x", "best", "simple_ssr/trace"),
        "four-mode": ("four_mode_ssr", "high", "best_1x", "best", "four_mode_ssr/trace"),
    }  # fmt: skip
    series = {"best": ("D", True), "the form for CPUs": ("s", True)}
    panels = []
    for chip, generation in (("navi21", "RDNA 2"), ("gfx1100", "RDNA 3"), ("vega10", "GCN 5")):
        cells = grid("gpu_compilers", chip)
        rows = []
        for label, (technique, published, other, name, stage) in passes.items():
            color, _ = look(technique)
            marks = [Mark("as published", color, "o", cells[f"{technique}, {published}, {stage}", "VGPRs"])]
            marks += [Mark(name, color, series[name][0], cells[f"{technique}, {other}, {stage}", "VGPRs"], series[name][1])]
            rows.append((label, marks))
        panels.append(Panel(f"{chip} ({generation})", rows))
    return Picture(panels, "vector registers of a lane, of 256", is_log=False, columns=3, extra={"xlim": (0, 265)})


def gpu_times():
    errors, times = grid("gpu_times", "errors"), grid("gpu_times", "navi21")
    panels = []
    for shot in dict.fromkeys(c for _, c in errors):
        points = sorted((p for p, c in times if c == shot and p != "mcguire_dda, best"), key=lambda p: times[p, shot].value)
        for title, cells, line in ((f"{shot}: microseconds", times, None), (f"{shot}: error over none", errors, 1.0)):
            rows = [(p, [technique_mark(p, cells[p, shot], is_hollow=p.endswith(PUBLISHED_PRESETS))]) for p in points]
            panels.append(Panel(title, rows, line))
    return Picture(panels, "Radeon RX 6800 XT (navi21) at 1920x1080, estimated, 95 % intervals of sampling", columns=2, note="hollow: as published")


def exact_rays():
    numbers = Numbers(str(SUMMARIES), __file__)
    shares = {"0.005": "0.5", "0.01": "1", "0.02": "2", "0.05": "5", "0.1": "10", "0.4": "40"}
    selectors = {"oracle": "by an oracle", "variance": "by variance", "random": "at random", "confidence": "by confidence"}
    panels = []
    for title, point in (("linear tracing", "mcguire_dda, any_scale"), ("AMD", "amd_sssr, best_1x"), ("Frostbite", "frostbite_sssr, best_1x")):
        error = lambda change: Cell("", change, "", *numbers.ratio_over_scenes("exact_rays", "errors", f"{point} {change}", point))  # noqa: B023, E731
        rows = []
        for share, percent in shares.items():
            marks = [
                Mark(text, style.COLORS[i], style.MARKS[i], error(f"exact_rays={selector} exact_share={share}"))
                for i, (selector, text) in enumerate(selectors.items())
            ]
            rows.append((percent, marks + [Mark("all rays exact", GREY, "", error("tracer=exact_scene"))]))
        panels.append(Panel(title, rows))
    return Picture(panels, "exact rays (%); error over the error without exact rays, mean over 13 scenes, 95 % intervals", kind="lines", columns=3)


def denoisers():
    cells = {tuple(word.split(" = ")[1] for word in place): cell for place, cell in grid("denoisers", "matrix").items()}
    marches = list(dict.fromkeys(march for march, _ in cells))

    def mark(march, denoiser):
        color, shape = (GREY, "|") if march == "exact_scene" else style.series(marches.index(march))
        return Mark("exact rays" if march == "exact_scene" else march, color, shape, cells[march, denoiser])

    by_error = sorted(dict.fromkeys(denoiser for _, denoiser in cells), key=lambda r: cells["cells", r].value)
    return Picture([Panel("", [(r, [mark(m, r) for m in marches]) for r in by_error])], "MSE over the MSE without reflections, mean over scenes like these, 95 % intervals", columns=1)


def composed():
    def panel(title, table, label, line):
        cells = grid("composed", table)
        points = sorted({row for row, _ in cells}, key=lambda p: cells[p, "mse"].value)
        marks = lambda point: [Mark(metric.upper(), style.COLORS[i], style.MARKS[i], cells[point, metric]) for i, metric in enumerate(("mse", "flip"))]  # noqa: E731
        return Panel(title, [(label(p), marks(p)) for p in points], line)

    part = lambda point: point.split(" ")[-1].removeprefix("ratio_accumulation.")  # noqa: E731
    panels = [panel("over no reflections", "techniques", str, 1.0), panel("one part changed", "parts", part, 1.0)]
    return Picture(panels, "error, mean over third-party scenes, 95 % intervals", columns=2)


ENGINES = {"three_ssrpass": "three.js SSRPass", "three_ssrnode": "three.js SSRNode", "babylon_ssr": "Babylon.js", "blender_eevee": "Blender EEVEE", "godot3": "Godot", "screen_space_reflections": "npm screen-space-reflections"}


def engines():
    cells = grid("engines", "errors")

    def panel(metric):
        points = sorted({row for row, _ in cells} - {"none, default"}, key=lambda p: cells[p, metric].value)
        rows = []
        for point in points:
            name, _, setting = point.partition(", ")
            is_engine = name in ENGINES
            mark = Mark("engine" if is_engine else "ssrlab", style.COLORS[1 if is_engine else 0], "o" if is_engine else "s", cells[point, metric])
            rows.append((f"{ENGINES.get(name, name)}, {setting}".removesuffix(", default"), [mark]))
        return Panel(metric.upper(), rows, 1.0)

    return Picture([panel("mse"), panel("flip")], "error over the error without reflections, mean over scenes like these, 95 % intervals", columns=2)


def misses():
    cells = grid("misses", "effects")
    points = list(dict.fromkeys(row.split(" misses=")[0] for row, _ in cells))
    mark = lambda i, metric, cell: Mark({"mse": "MSE", "relmse": "relMSE"}[metric], style.COLORS[i], style.MARKS[i], cell)  # noqa: E731
    marks = lambda point, scene: [mark(i, m, cells[f"{point} misses=fallback, {m}", scene]) for i, m in enumerate(("mse", "relmse"))]  # noqa: E731
    panels = [Panel(scene, [(p, marks(p, scene)) for p in points], 1.0) for scene in dict.fromkeys(c for _, c in cells)]
    return Picture(panels, "error with fallback over error with weight, 95 % intervals", columns=2)


def normals():
    encodings = {"floats": grid("normals_float", "mse"), "two bytes": grid("normals_octahedral_8", "mse")}
    points = [p for p in dict.fromkeys(row for row, _ in encodings["floats"]) if p != "none, default"]
    marks = lambda point, scene: [technique_mark(point, cells[point, scene], name, name == "floats") for name, cells in encodings.items()]  # noqa: E731
    panels = [Panel(scene, [(p, marks(p, scene)) for p in points]) for scene in dict.fromkeys(c for _, c in encodings["floats"])]
    return Picture(panels, "MSE of the reflection (intervals are smaller than the marks); hollow: normals as floats", columns=3)


OURS = ("black", "*")  # composed_ssr


def rooms_at_gpu_time():
    advice = Advice(str(SUMMARIES))
    points = [r for r in advice.of("navi21") if not r["ms"] and r["us"] and r["technique"] != "none"]
    budgets = sorted({number(r, "ms") for r in advice.of("navi21") if r["ms"]})

    def mark(row):
        color, shape = OURS if row["technique"] == "composed_ssr" else look(row["technique"])
        time = [None if v is None else v / 1000 for v in (number(row, c) for c in ("us", "us_low", "us_high"))]
        return Mark(row["technique"], color, shape, Cell("", row["point"], "", *(number(row, c) for c in ("ratio", "low", "high"))), x=Cell("", row["point"], "", *time))

    panels = []
    for kind in sorted({kind_of(r) for r in points}):
        of_kind = [r for r in points if kind_of(r) == kind]
        rows = [(t, [mark(r) for r in of_kind if r["technique"] == t]) for t in [*TECHNIQUES, "composed_ssr"]]
        panels.append(Panel(kind, [(t, marks) for t, marks in rows if marks], 1.0))
    return Picture(
        panels, "estimated ms at 1920x1080 on a Radeon RX 6800 XT; FLIP over that of no reflections, 95 % intervals", columns=2, kind="fronts", steps=tuple(budgets), note="short dashes: a cheaper point of the technique errs less"
    )


PUBLISHED_PRESETS = ("default", "sdk_1_5", "current", "frostbite_2015", "blog", "high")

PICTURES = {p.__name__: p for p in (techniques, budgets, rooms, metrics, visibility, causes, limit, third_party, traced_environment, corrections, estimators, march, thickness, temporal, half_histories, fragments, resolution, compilers, gpu_times, exact_rays, denoisers, composed, engines, misses, normals, rooms_at_gpu_time)}


def save(name, folder):
    picture = PICTURES[name]()
    figure = draw(picture, WIDTH)
    file = folder / f"{name}.svg"
    made_by = f"ssrlab, matplotlib {matplotlib.__version__}"
    drawn = io.StringIO()
    figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": made_by, "Source": shown_numbers(picture)})
    plt.close(figure)
    text = drawn.getvalue().replace("'DejaVu Sans'", "'DejaVu Sans', Verdana, sans-serif")  # Verdana is as wide
    cut = str.strip if picture.kind == "fronts" else str.rstrip  # without indents where there are many marks
    file.write_text("\n".join(map(cut, text.splitlines())) + "\n", encoding="utf-8")
    print(f"{file}: {file.stat().st_size} bytes")


def command_line():
    parser = CommandLine(prog="python3 experiments/python question_pictures", description="A picture for each page of answers (SVG).")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(PICTURES)}; default: all")
    parser.add_argument("--out", type=Path, default=OUT, help="default: experiments/studies/questions/pictures")
    return parser


def main():
    parser = command_line()
    arguments = parser.parse_args()
    if unknown := [name for name in arguments.names if name not in PICTURES]:
        parser.error(f"there is no picture '{unknown[0]}'; there are {', '.join(PICTURES)}")
    style.apply(width=WIDTH)
    matplotlib.rcParams["svg.fonttype"] = "none"  # letters, not their outlines: a third of the size
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name in arguments.names or PICTURES:
        save(name, arguments.out)


if __name__ == "__main__":
    sys.exit(exit_code(main, "the pictures"))
