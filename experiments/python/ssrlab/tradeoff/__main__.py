"""Error against run time, answered: draws the curves and fits between the points that ssrlab judged, and writes them and answers.md beside
its tables; experiments/tradeoff/README.md says what is in them and by which rules.

usage: python3 experiments/python tradeoff ASKED.json, which `ssrlab tradeoff` writes beside what it decided (front.csv, pairs.csv, across.csv, stages.csv)

Needs Debian's python3-numpy and python3-scipy.
"""

import os
import sys

from ssrlab.mistakes import exit_code, stop

try:
    import numpy  # noqa: F401  (named here so that a missing one is explained below)
    import scipy  # noqa: F401
except ImportError as missing:
    stop(f"{missing}: install python3-numpy and python3-scipy")

from ssrlab.tradeoff import rows
from ssrlab.tradeoff.answers import Answers
from ssrlab.tradeoff.points import Study
from ssrlab.text_files import path_inside, write_text

SHOT = ("shot", "scene", "machine", "variant", "label")
FILES = {
    "error_at_cost.csv": (*SHOT, "cost", "unit", "status", "error", "low", "high", "fits", "start", "end", "point", "point_error", "point_low", "point_high", "chosen_on"),
    "cost_to_error.csv": (*SHOT, "factor", "error", "unit", "status", "cost", "low", "high", "share_that_reach", "start", "end"),
    "fits.csv": (*SHOT, "parameter", "fixed", "points", "point_names", "cost_from", "cost_to", "unit", "floor", "floor_low", "floor_high", "a", "b", "b_low", "b_high", "misfit", "status", "rung", "rung_error", "rung_low", "rung_high", "floor_over_rung", "floor_over_rung_low", "floor_over_rung_high"),
    "limits.csv": (*SHOT[:3], "rung", "rung_error", "rung_low", "rung_high", "variant", "point", "label", "error", "error_low", "error_high", "over_rung", "over_rung_low", "over_rung_high", "cost", "unit"),
}  # fmt: skip


def main():
    out = os.path.dirname(sys.argv[1])
    study = Study(out)
    found = rows.Analysis(study, sorted(study.asked["factors"], reverse=True))
    for name, columns in FILES.items():
        rows.write(out, name, columns, getattr(found, name.removesuffix(".csv")))
    write_text(path_inside(out, "answers.md"), Answers(found).text())
    print(os.path.join(out, "answers.md"))


if __name__ == "__main__":
    sys.exit(exit_code(main, "the answers"))
