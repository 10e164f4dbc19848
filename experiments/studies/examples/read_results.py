#!/usr/bin/python3
"""Reads a results folder: of each shot, the point of least error whose frame takes no longer than a budget.

usage: read_results.py DIR [MILLISECONDS]"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../python"))

import ssrlab  # noqa: E402  (before what it finds)
from ssrlab.mistakes import ResultsError, exit_code  # noqa: E402


def best_within(folder, milliseconds):
    results = ssrlab.read(folder)
    times = results["time_summary"].query("stage == 'total' and median_ms <= @milliseconds")
    how = "inner" if milliseconds < float("inf") else "left"  # without a budget, points that were not timed count, too
    table = results.primary_errors().merge(times[["shot", "technique", "point", "median_ms"]], on=["shot", "technique", "point"], how=how)
    best = table.loc[table.groupby("shot")["value"].idxmin()]
    best = best[["shot", "technique", "point", "value", "low", "high", "standing", "median_ms"]]
    parameters = results["parameters"].set_index(["technique", "point"])
    return best.join(parameters.dropna(axis="columns", how="all"), on=["technique", "point"])


def main():
    if len(sys.argv) < 2:
        raise ResultsError("name a results folder: read_results.py DIR [MILLISECONDS]")
    found = best_within(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else float("inf"))
    print(found.to_string(index=False, columns=["shot", "technique", "point", "value", "low", "high", "standing", "median_ms"]))


if __name__ == "__main__":
    sys.exit(exit_code(main, "the table"))
