"""Sheets of pictures for people to judge which of two results is nearer to the truth, without knowing their names.

    python3 experiments/python judge sheets RESULTS OUT [--pairs N] [--seed S]    draws pairs; OUT has pair_<n>.png and key.csv
    python3 experiments/python judge enter OUT ANSWERS.csv --judge NAME           ANSWERS: pair,nearer (left, right or neither); adds
                                                                                  them to experiments/studies/questions/judgements.csv

Half of the pairs are drawn from all, half from those that two of the metrics order differently. `ssrlab tables` counts how
often each metric agrees (a table "of": "eye").
"""
import argparse
import itertools
import os
import random
import sys

from ssrlab.command_lines import CommandLine
from ssrlab.csv_files import number, read_rows, write_lines
from ssrlab.mistakes import ResultsError, exit_code, stop

try:
    import numpy as np
    from PIL import Image
except ImportError as missing:
    stop(f"{missing}: install python3-numpy and python3-pil, and run this with Debian's python3")

from ssrlab.figures.crops import REFERENCE, display
from ssrlab.results import Results
from ssrlab.tables.agreement import JUDGEMENTS
from ssrlab.text_files import path_inside

METRICS = ("mse", "relmse", "flip")
COLUMNS = ("shot", "first", "first_point", "second", "second_point", "nearer", "judge")
PAIR = COLUMNS[:5]
SCALE = 2  # pixels are shown so large: as many on a side
GAP = 12


def values_of(results):
    """{shot: {(technique, point): {metric: shortfall}}} of specular light under the mask `reflective`."""
    found = {}
    for row in results.errors:
        if row["target"] == "specular" and row["mask"] == "reflective" and row["metric"] in METRICS and row["value"]:
            points = found.setdefault(row["shot"], {})
            points.setdefault((row["technique"], row["point"]), {})[row["metric"]] = results.shortfall(row["metric"], number(row, "value"))
    return found


def disagree(a, b):
    orders = {a[m] < b[m] for m in METRICS if m in a and m in b}
    return len(orders) > 1


def draw_pairs(results, count, rng):
    """[(shot, point, point)] without repetition, evenly over the shots."""
    every, disputed = [], []
    for shot, points in values_of(results).items():
        for a, b in itertools.combinations(points, 2):
            every.append((shot, a, b))
            if disagree(points[a], points[b]):
                disputed.append((shot, a, b))
    chosen = rng.sample(disputed, min(count // 2, len(disputed)))
    rest = [pair for pair in every if pair not in set(chosen)]
    chosen += rng.sample(rest, min(count - len(chosen), len(rest)))
    rng.shuffle(chosen)
    return [(shot, *rng.sample((a, b), 2)) for shot, a, b in chosen]


def sheet(results, shot, left, right):
    """The truth above both points: specular light, at the shot's exposure."""
    images = results.images_of(shot, "specular", keys=[REFERENCE, left, right])
    for key in (REFERENCE, left, right):
        if key not in images:
            raise ResultsError(f"{results.folder} has no picture of {shot}, {key}")
        shown = np.round(255 * display(images[key], results.exposure(shot))).astype(np.uint8)
        images[key] = np.kron(shown, np.ones((SCALE, SCALE, 1), dtype=np.uint8))
    height, width, _ = images[REFERENCE].shape
    page = np.full((2 * height + GAP, 2 * width + GAP, 3), 128, dtype=np.uint8)
    page[:height, (width + GAP) // 2 : (width + GAP) // 2 + width] = images[REFERENCE]
    page[height + GAP :, :width] = images[left]
    page[height + GAP :, width + GAP :] = images[right]
    return page


def make_sheets(arguments):
    results = Results(arguments.results)
    os.makedirs(arguments.out, exist_ok=True)
    with open(path_inside(arguments.out, "key.csv"), "w", newline="", encoding="utf-8") as stream:
        write_lines(stream, [("pair",) + PAIR])
        for number, (shot, left, right) in enumerate(draw_pairs(results, arguments.pairs, random.Random(arguments.seed)), 1):
            Image.fromarray(sheet(results, shot, left, right)).save(path_inside(arguments.out, f"pair_{number}.png"))
            write_lines(stream, [(number, shot, *left, *right)])


def enter(arguments):
    file = os.path.join(arguments.out, "key.csv")
    key = {row["pair"]: row for row in read_rows(file)[1]}
    named = {"left": "first", "right": "second", "neither": "neither"}
    lines = [] if os.path.exists(JUDGEMENTS) else [COLUMNS]
    for answer in read_rows(arguments.answers)[1]:
        for column, known, where in (("pair", key, f"the pairs of {file}"), ("nearer", named, ", ".join(named))):
            if answer[column] not in known:
                raise ResultsError(f"{answer.file}:{answer.line}: '{column}' = \"{answer[column]}\" is none of {where}")
        lines.append([key[answer["pair"]][c] for c in PAIR] + [named[answer["nearer"]], arguments.judge])
    with open(JUDGEMENTS, "a", newline="", encoding="utf-8") as out:
        write_lines(out, lines)


def command_line():
    parser = CommandLine(prog="python3 experiments/python judge", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    sheets = commands.add_parser("sheets")
    sheets.add_argument("results"), sheets.add_argument("out")
    sheets.add_argument("--pairs", type=int, default=40), sheets.add_argument("--seed", type=int, default=1)
    sheets.set_defaults(run=make_sheets)
    entering = commands.add_parser("enter")
    entering.add_argument("out"), entering.add_argument("answers"), entering.add_argument("--judge", required=True)
    entering.set_defaults(run=enter)
    return parser


def main():
    arguments = command_line().parse_args()
    arguments.run(arguments)


if __name__ == "__main__":
    sys.exit(exit_code(main, "the sheets or judgements"))
