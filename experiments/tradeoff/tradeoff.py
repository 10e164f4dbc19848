"""Error against run time, answered: fronts that heed intervals, the error that a time buys, what no time can buy, what holds over scenes, and
what each stage is worth. Writes CSV files and answers.md; README.md beside this file says what is in them and by which rules.

usage: tradeoff.py RESULTS [--baseline VARIANT:POINT] [--times MS ...] [--factors F ...] [--metric M --mask M --target T] [--cost QUANTITY] [--out DIR]

Needs Debian's python3-numpy and python3-scipy.
"""

import argparse
import os
import sys

try:
    import numpy  # noqa: F401  (named here so that a missing one is explained below)
    import scipy  # noqa: F401
except ImportError as missing:
    sys.exit(f"error: {missing}: install python3-numpy and python3-scipy")

from analysis import rows
from analysis.answers import Answers
from analysis.points import ResultsError, Study

SHOT = ("shot", "scene", "machine", "variant", "label")
FILES = {
    "front.csv": (*SHOT[:3], "variant", "point", "label", "error", "error_low", "error_high", "cost", "cost_low", "cost_high", "unit", "is_nominal_front", "verdict", "dominated_by", "undecided_with"),
    "error_at_cost.csv": (*SHOT, "cost", "unit", "status", "error", "low", "high", "fits", "start", "end", "point", "point_error", "point_low", "point_high", "chosen_on"),
    "cost_to_error.csv": (*SHOT, "factor", "error", "unit", "status", "cost", "low", "high", "share_that_reach", "start", "end"),
    "fits.csv": (*SHOT, "parameter", "fixed", "points", "point_names", "cost_from", "cost_to", "unit", "floor", "floor_low", "floor_high", "a", "b", "b_low", "b_high", "misfit", "status", "rung", "rung_error", "rung_low", "rung_high", "floor_over_rung", "floor_over_rung_low", "floor_over_rung_high"),
    "limits.csv": (*SHOT[:3], "rung", "rung_error", "rung_low", "rung_high", "variant", "point", "label", "error", "error_low", "error_high", "over_rung", "over_rung_low", "over_rung_high", "cost", "unit"),
    "across.csv": ("machine", "cost", "unit", "variant", "point", "label", "baseline", "scenes", "shots", "ratio", "low", "high", "bootstrap_low", "bootstrap_high", "scenes_that_fit", "wins", "shared", "rank", "rank_low", "rank_high", "against_best", "against_best_low", "against_best_high", "p_holm"),
    "stages.csv": ("shot", "scenes", "machine", "variant", "point", "label", "against_variant", "against_point", "change", "error_ratio", "error_low", "error_high", "cost", "cost_low", "cost_high", "unit", "cost_per_percent", "cost_per_percent_low", "cost_per_percent_high", "verdict"),
}  # fmt: skip


def positive(text):
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not above 0")
    return value


def parse_arguments():
    parser = argparse.ArgumentParser(description="Error against run time, answered from a results folder.")
    parser.add_argument("results", help="a folder that `ssrlab run` filled")
    parser.add_argument("--out", help="default: tradeoff in the results folder")
    parser.add_argument("--baseline", metavar="VARIANT:POINT", help="errors are told as multiples of its; default: `none`, else the study's first baseline")
    parser.add_argument("--times", nargs="+", type=positive, default=[5, 10, 20, 40], metavar="MS", help="or counted costs, with --cost; default: 5 10 20 40")
    parser.add_argument("--factors", nargs="+", type=positive, default=[0.5, 0.25, 0.1], help="of the baseline's error, for the time to reach them; default: 0.5 0.25 0.1")
    for name in ("metric", "mask", "target"):
        parser.add_argument("--" + name, help="default: that of the study's primary error")
    parser.add_argument("--leave-out", nargs="+", default=[], metavar="SCENE", help="scenes or shots that nothing is said of")
    parser.add_argument("--cost", metavar="QUANTITY", help="of costs.csv, in place of time: fetches, for one")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    try:
        study = Study(arguments.results, arguments.target, arguments.metric, arguments.mask, arguments.cost, arguments.leave_out)
        baseline = study.baseline(arguments.baseline)
        analysis = rows.Analysis(study, baseline, sorted(arguments.times), sorted(arguments.factors, reverse=True))
        out = arguments.out or os.path.join(arguments.results, "tradeoff")
        os.makedirs(out, exist_ok=True)
        of_file = {
            "front.csv": analysis.front,
            "error_at_cost.csv": analysis.error_at_cost,
            "cost_to_error.csv": analysis.cost_to_error,
            "fits.csv": analysis.fits,
            "limits.csv": analysis.limits,
            "across.csv": analysis.across,
            "stages.csv": analysis.stages,
        }
        for name, columns in FILES.items():
            rows.write(out, name, columns, of_file[name])
        with open(os.path.join(out, "answers.md"), "w", encoding="utf-8") as stream:
            stream.write(Answers(analysis).text())
        print(os.path.join(out, "answers.md"))
    except ResultsError as mistake:
        print(f"error: {mistake}", file=sys.stderr)
        return 2
    except OSError as fault:
        print(f"error: cannot write the answers: {fault}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
