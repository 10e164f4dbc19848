"""Paper figures from a results folder, as PDF, SVG and PNG: those that figures.json asks for (experiments/docs/figures.md), else all
that the study has results for, except `convergence`. Of each shot: error against time, times, counted costs and estimated GPU times of stages, crops with error maps, and
of shots in motion an animated GIF.
Of the study: error and bias by roughness, bias and variance, effects of changes, temporal metrics, the error of each frame,
errors against the truth ladder, what error a cost buys, errors and times over swept parameters, and depth fetches per ray against the
resolution.

usage: python3 experiments/python figures RESULTS [--out DIR] [--choice figures.json] [--target specular] [--metric mse] [--mask reflective]

It reads manifest.json, summary.csv, time_summary.csv, splits.csv, effects.csv, hits.csv, costs.csv, estimates.csv, the EXR images
(experiments/docs/results_folder.md) and what `ssrlab tradeoff` wrote, and writes the same bytes whenever they are the same. Needs Debian's python3-matplotlib and python3-numpy.
"""

import os
import sys
from dataclasses import replace

from ssrlab.figures.command_line import parse_arguments

ARGUMENTS = parse_arguments() if __name__ == "__main__" else None  # before the imports below, which take a second

os.environ["SOURCE_DATE_EPOCH"] = "0"  # matplotlib writes no time of day into its files

from ssrlab.mistakes import ResultsError, counted, exit_code, say, stop

try:
    import matplotlib
    import numpy  # noqa: F401  (named here so that a missing one is explained below)
except ImportError as missing:
    stop(f"{missing}: install python3-matplotlib and python3-numpy")

from ssrlab.figures import (
    bias_variance,
    convergence,
    crops,
    effects,
    error_time,
    fetches,
    fits,
    frames,
    ladder,
    maps,
    motion,
    request,
    response,
    roughness,
    stages,
    style,
    sweeps,
    temporal,
)
from ssrlab.figures.crop_choice import read_crops
from ssrlab.results import Results
from ssrlab.text_files import path_inside

# Kind of figure to what draws it: of one shot at a time, or of all that are asked for.
SHOT_FIGURES = {
    "stage_times": stages.draw_times,
    "stage_costs": stages.draw_costs,
    "stage_estimates": stages.draw_estimates,
    "crops": crops.draw,
    "motion": motion.draw,
}
STUDY_FIGURES = {
    "error_time": error_time.draw,
    "ladder": ladder.draw,
    "response": response.draw,
    "map": maps.draw,
    "convergence": convergence.draw,
    "roughness_error": roughness.draw_error,
    "roughness_bias": roughness.draw_bias,
    "bias_variance": bias_variance.draw,
    "temporal": temporal.draw,
    "frames": frames.draw,
    "fits": fits.draw,
    "fetches": fetches.draw,
}
UNASKED_OF_SHOTS = ("error_time", "stage_times", "stage_costs", "stage_estimates", "crops", "motion")  # without figures.json a file for each shot
UNASKED = ("ladder", "roughness_error", "roughness_bias", "bias_variance", "temporal", "frames", "fits", "fetches", "effects")
OF_ONE_ERROR = ("error_time", "ladder", "response", "map", "convergence", "fits", "crops", "motion")  # that of their target, metric and mask
UNMEASURED = ("stage_times", "stage_costs", "stage_estimates", "fetches")  # of studies without a reference, too


def for_each_shot(results, requests):
    """Of UNASKED_OF_SHOTS one for each shot; the others as they are."""
    single = [r for r in requests if r.kind in UNASKED_OF_SHOTS]
    shots = (single[0].shots if single else None) or results.shots()
    of_shots = [replace(r, name=f"{r.kind}_{shot}", shots=[shot]) for shot in shots for r in single]
    return of_shots + [r for r in requests if r.kind not in UNASKED_OF_SHOTS]


def view_of(results, chosen):
    """The results as a figure shows them."""
    view = results.narrowed(chosen.shots, chosen.points)
    view.labels = chosen.labels
    view.rounds_names = True
    return view


def without_errors(view, chosen):
    """The shots that no pixel of its mask is in, or that lack its metric or target for another reason."""
    measured = {r["shot"] for r in view.errors if all(r[key] == getattr(chosen, key) for key in request.TEXTS)}
    return [shot for shot in view.shots() if shot not in measured]


def drawn(view, chosen):
    """(name, figure) of a request; several of one that makes a figure for each shot, chip or baseline."""
    if chosen.kind == "effects":
        for name, rows in effects.comparisons(view, chosen).items():
            yield name.replace("effects", chosen.name, 1), effects.draw(view, chosen, rows)
    elif chosen.kind in SHOT_FIGURES:
        shots = view.shots()
        for shot in shots:
            name = chosen.name if len(shots) == 1 else f"{chosen.name}_{shot}"
            chips = view.estimated_chips() if chosen.kind == "stage_estimates" and not chosen.option("chip") else []
            if len(chips) > 1:
                for chip in chips:
                    yield f"{name}_{chip}", SHOT_FIGURES[chosen.kind](view, shot, replace(chosen, options={"chip": chip}))
            else:
                yield name, SHOT_FIGURES[chosen.kind](view, shot, chosen)
    else:
        yield chosen.name, STUDY_FIGURES[chosen.kind](view, chosen)


def make(results, requests, look, out):
    """Draws and writes all; how many files."""
    is_measured = bool(results.errors)
    written, notes = [], []
    for chosen in requests:
        if not is_measured and chosen.kind not in UNMEASURED:
            if chosen.where:
                raise ResultsError(f"{chosen.where}: the study measures no errors, and so has no figure of the kind {chosen.kind}")
            continue
        view = view_of(results, chosen)
        if chosen.kind in OF_ONE_ERROR:
            lacking = without_errors(view, chosen)
            notes += [f"note: {view.shot_label(shot)} has no error of target {chosen.target}, metric {chosen.metric}, mask {chosen.mask}: figures of that leave it out" for shot in lacking]
            if lacking == view.shots() and not chosen.where:
                continue
        style.apply(look.font, chosen.width)
        count = len(written)
        for name, figure in drawn(view, chosen):
            if figure is not None:
                written += figure.save(out, name) if isinstance(figure, motion.Animation) else style.save(figure, out, name, look.formats)
        if chosen.where and len(written) == count:
            raise ResultsError(f"{chosen.where}: the results have nothing for a figure of the kind {chosen.kind}")
    for note in dict.fromkeys(notes):
        say(note)
    return len(written)


def main():
    arguments = ARGUMENTS or parse_arguments()
    matplotlib.use("Agg")
    results = Results(arguments.results)
    file = arguments.choice
    content = request.read_choice(file) if file else {}
    texts = {key: getattr(arguments, key) or content.get(key) for key in request.TEXTS}
    texts = {
        "target": texts["target"] or "specular",
        "metric": texts["metric"] or results.headline_metric(),
        "mask": texts["mask"] or "reflective",
    }
    look = request.read_look(file, content)
    requests = request.read_requests(file, content, results, texts, (*UNASKED_OF_SHOTS, *UNASKED))
    collected = read_crops(file, content, results)
    results.colors = request.read_colors(file, content, results)
    if "figures" not in content:
        requests = for_each_shot(results, requests) + sweeps.unasked(results, requests[0])
    for chosen in requests:
        chosen.crops = collected
    if results.errors:
        results.errors_of(**texts)  # a mistake in what is asked for is said before anything is written
    out = arguments.out or path_inside(arguments.results, "figures")
    os.makedirs(out, exist_ok=True)
    print(f"{counted(make(results, requests, look, out), 'file')} in {out}")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the figures"))
