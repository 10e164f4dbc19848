"""Error against run time, answered: fronts that heed intervals, the error that a time buys, what no time can buy, what holds over scenes, and
what each stage is worth. Writes CSV files and answers.md; README.md beside this file says what is in them and by which rules.

usage: tradeoff.py ASKED.json, which `ssrlab tradeoff` writes beside the pairs of points that it judged (pairs.csv)

Needs Debian's python3-numpy and python3-scipy.
"""

import json
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


def main():
    with open(sys.argv[1], encoding="utf-8") as stream:
        asked = json.load(stream)
    out = asked["out"]
    try:
        study = Study(asked["results"], asked["target"], asked["metric"], asked["mask"], asked["cost"], asked["left_out"], os.path.join(out, "pairs.csv"))
        baseline = study.baseline(asked["baseline"])
        analysis = rows.Analysis(study, baseline, sorted(asked["times"]), sorted(asked["factors"], reverse=True))
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
