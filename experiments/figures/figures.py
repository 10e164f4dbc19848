"""Paper figures from a results folder, as PDF, SVG and PNG. Of each shot: error against time, stage times, and crops with
error maps. Of the study, where it has such results: error and bias by roughness, bias and variance, effects of changes,
temporal metrics, the error of each frame, and depth fetches per ray against the resolution.

usage: figures.py RESULTS [--out DIR] [--crops figures.json] [--target specular] [--metric mse] [--mask reflective]

It reads manifest.json, summary.csv, time_summary.csv, splits.csv, effects.csv, hits.csv and the EXR images (experiments/RESULTS.md), and writes the same bytes
whenever they are the same. Needs Debian's python3-matplotlib and python3-numpy.
"""

import argparse
import os
import sys

os.environ["SOURCE_DATE_EPOCH"] = "0"  # matplotlib writes no time of day into its files

try:
    import matplotlib
    import numpy  # noqa: F401  (named here so that a missing one is explained below)
except ImportError as missing:
    sys.exit(f"error: {missing}: install python3-matplotlib and python3-numpy")

from paper_figures import (
    bias_variance,
    crops,
    effects,
    error_time,
    fetches,
    frames,
    roughness,
    stage_times,
    style,
    temporal,
)
from paper_figures.crop_choice import read_crops
from paper_figures.results import Results, ResultsError


SHOT_FIGURES = {"error_time": error_time.draw, "stage_times": stage_times.draw, "crops": crops.draw}
STUDY_FIGURES = {
    "roughness_error": roughness.draw_error,
    "roughness_bias": roughness.draw_bias,
    "bias_variance": bias_variance.draw,
    "temporal": temporal.draw,
    "frames": frames.draw,
    "fetches": fetches.draw,
}
UNMEASURED_FIGURES = ("fetches",)  # of studies without a reference


def parse_arguments():
    parser = argparse.ArgumentParser(description="Paper figures (PDF, SVG, PNG) from a results folder.")
    parser.add_argument("results", help="a folder that `ssrlab run` filled")
    parser.add_argument("--out", help="default: figures in the results folder")
    parser.add_argument("--crops", metavar="figures.json", help="crops that the report's viewer collected; of other shots, those of the largest errors")
    parser.add_argument("--target", default="specular", help="default: specular")
    parser.add_argument("--metric", help="default: what the study is made to compare (`primary`), else its first metric")
    parser.add_argument("--mask", default="reflective", help="default: reflective")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    matplotlib.use("Agg")
    style.apply()
    try:
        results = Results(arguments.results)
        arguments.crops = read_crops(arguments.crops, results) if arguments.crops else {}
        is_measured = bool(results.errors) or not results.hits
        if is_measured:
            arguments.metric = arguments.metric or results.headline_metric()
            errors = results.errors_of(arguments.target, arguments.metric, arguments.mask)
        out = arguments.out or os.path.join(arguments.results, "figures")
        os.makedirs(out, exist_ok=True)
        drawings = [
            (f"{name}_{shot}", draw, (results, shot, errors, arguments))
            for shot in results.shots()
            for name, draw in SHOT_FIGURES.items()
        ]
        drawings += [
            (name, draw, (results, arguments)) for name, draw in STUDY_FIGURES.items() if is_measured or name in UNMEASURED_FIGURES
        ]
        drawings += [] if not is_measured else [
            (name, effects.draw, (results, arguments, rows))
            for name, rows in effects.comparisons(results, arguments).items()
        ]
        written = []
        for name, draw, what in drawings:
            figure = draw(*what)
            if figure is not None:
                written += style.save(figure, out, name)
    except ResultsError as mistake:
        print(f"error: {mistake}", file=sys.stderr)
        return 2
    except OSError as fault:
        print(f"error: cannot write the figures: {fault}", file=sys.stderr)
        return 3
    print(f"{len(written)} files in {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
