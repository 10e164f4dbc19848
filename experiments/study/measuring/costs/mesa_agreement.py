#!/usr/bin/env python3
"""How alike two versions of Mesa order the same shaders: a Markdown table of two results folders of one study.

    mesa_agreement.py OLDER NEWER    folders with compiled.csv and, of a study that counts costs, estimates.csv

For each chip that both have: Kendall's rank correlation of the numbers of all shaders, and of estimated times of stages and of whole points (mean and
range over the shots); and how many times the older version's number the newer version's is (median, and from the 5th to the 95th percentile).
"""
import argparse
import os
import sys

from cost_agreement import kendall_tau, range_of, rows_of, spread
from ssrlab.csv_files import number
from ssrlab.mistakes import ResultsError, exit_code
from ssrlab.text_files import path_inside

COMPILED = {"instructions": "instructions", "cycles": "inverse_throughput", "latency": "latency", "registers": "vgprs", "waves": "waves"}
NAMES = ("shot", "technique", "point", "stage", "pipeline", "shader")


def compiled(folder):
    """{chip: {number: {shot: {shader: value}}}}; vertex shaders are of the triangle over the image."""
    found = {}
    for row in rows_of(folder, "compiled.csv"):
        for name, column in COMPILED.items():
            if row["shader"] != "vertex" and (value := number(row, column)) is not None:
                of_chip = found.setdefault(row["chip"], {}).setdefault(name, {})
                of_chip.setdefault(row["shot"], {})[tuple(row[n] for n in NAMES)] = value
    return found


def estimated(folder):
    """The same of estimated times, by stage and point; {} of a study that estimates none."""
    found = {}
    if not os.path.exists(path_inside(folder, "estimates.csv")):
        return found
    for row in rows_of(folder, "estimates.csv"):
        if (value := number(row, "microseconds")) is not None:
            name = "estimated time of points" if row["stage"] == "total" else "estimated time of stages"
            of_chip = found.setdefault(row["chip"], {}).setdefault(name, {})
            of_chip.setdefault(row["shot"], {})[tuple(row[n] for n in NAMES if n in row)] = value
    return found


def drivers(folder):
    return sorted({row["driver"] for row in rows_of(folder, "compiled.csv") if row["driver"]})


def lines(older, newer):
    """Of one number: (values that both have, tau by shot, newer / older)."""
    count, taus, ratios = 0, [], []
    for shot in sorted(set(older) & set(newer)):
        names = [name for name in older[shot] if name in newer[shot]]
        first, second = ([of[shot][name] for name in names] for of in (older, newer))
        count += len(names)
        taus.append(kendall_tau(first, second))
        ratios += [b / a for a, b in zip(first, second) if a > 0]
    return count, taus, ratios


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("older")
    parser.add_argument("newer")
    arguments = parser.parse_args()
    makers = [drivers(folder) for folder in (arguments.older, arguments.newer)]
    if makers[0] == makers[1]:
        raise ResultsError(f"both folders are of {', '.join(makers[0]) or 'no compiler'}; run one of them with SSRLAB_MESA")
    tables = [
        (compiled(arguments.older), compiled(arguments.newer)),
        (estimated(arguments.older), estimated(arguments.newer)),
    ]
    print(f"| {' against '.join(', '.join(names) for names in reversed(makers))} | values | rank correlation | newer over older |")
    print("|---|---|---|---|")
    for older, newer in tables:
        for chip in older:
            for name in older[chip]:
                if name in newer.get(chip, {}):
                    count, taus, ratios = lines(older[chip][name], newer[chip][name])
                    print(f"| {chip}, {name} | {count} | {spread(taus)} | {range_of(ratios) if ratios else '-'} |")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the table"))
