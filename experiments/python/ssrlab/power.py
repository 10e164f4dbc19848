"""Which differences studies detect: the power of each metric, from results of studies and from kept summaries.

usage: python3 experiments/python power [RESULTS ...]

For results folders: 5 % more error than a shot's best, with 8 seeds, alone and in a family of 12 comparisons. For the kept summary of
`rooms`: 10 % over 28 and 196 scenes. Prints the tables of metrics/coverage.md.

A pair's standard error is that of the logarithm of its errors' ratio, from its 95 % interval. The part of the seeds falls with their
number; the reference's part does not. Power is that of Student's two-sided test (a noncentral t) at 0.05, in a family at 0.05 / its size
(Bonferroni, the first step of Holm's method). Needs Debian's python3-numpy and python3-scipy."""

import csv
import math
import os
from collections import defaultdict

import numpy as np
from scipy import stats

from ssrlab.command_lines import CommandLine
from ssrlab.repository import SUMMARIES

SIGNIFICANCE, WANTED = 0.05, 0.8


def power(effects, degrees, level):
    """Probability that a true difference of `effects` standard errors is detected."""
    if effects > 50:
        return 1.0
    limit = stats.t.ppf(1 - level / 2, degrees)
    return stats.nct.sf(limit, degrees, effects) + stats.nct.cdf(-limit, degrees, effects)


def smallest_seen(error, degrees, level):
    """The difference, as a share of the error, that is detected with 80 % probability."""
    low, high = 0.0, 50.0
    while high - low > 1e-4:
        middle = (low + high) / 2
        low, high = (middle, high) if power(middle, degrees, level) < WANTED else (low, middle)
    return math.expm1(high * error)


def rows_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(line for line in text if not line.startswith("# ")))


def log_error(low, high, degrees):
    """Standard error of a ratio's logarithm, from its 95 % interval."""
    return math.log(float(high) / float(low)) / 2 / stats.t.ppf(0.975, degrees)


def error_of_seeds(a, b):
    """Jackknife standard error of ln(mean a / mean b) over common seeds; a point without seeds has one value."""
    n = max(len(a), len(b))
    a, b = (np.array(v * n if len(v) == 1 else v, float) for v in (a, b))
    if len(a) != len(b) or n < 2 or min(a.sum(), b.sum()) <= 0:
        return 0.0
    without = np.log((a.sum() - a) / (b.sum() - b))
    return math.sqrt((n - 1) / n * ((without - without.mean()) ** 2).sum())


def shot_pairs(folder):
    """For each metric: the seeds' standard error, the other standard error and the number of seeds, of each pair with a shot's best."""
    seeds = defaultdict(list)
    key = ("shot", "frame", "technique", "point", "target", "metric", "mask")
    for row in rows_of(os.path.join(folder, "results.csv")):
        if row["value"]:
            seeds[tuple(row[k] for k in key)].append(float(row["value"]))
    contests = defaultdict(list)
    for row in rows_of(os.path.join(folder, "summary.csv")):
        if row["represents_shot"] == "1" and row["standing"] and row["target"] == "specular":
            contests[row["shot"], row["metric"], row["mask"]].append(row)
    pairs = defaultdict(list)
    for (_, metric, _), rows in contests.items():
        best = min(rows, key=lambda r: float(r["value"]))
        for row in rows:
            count = max(int(row["seeds"]), int(best["seeds"]))
            if row is best or not row["over_best_low"] or count < 2 or float(row["over_best_low"]) <= 0:
                continue
            own, other = (seeds[tuple(r[k] for k in key)] for r in (row, best))
            of_seeds = error_of_seeds(own, other)
            total = log_error(row["over_best_low"], row["over_best_high"], count - 1)
            pairs[metric].append((of_seeds, math.sqrt(max(total**2 - of_seeds**2, 0)), count))
    return pairs


def print_shots(folders, count=8, family=12, share=0.05):
    print(f"| study | metric | pairs | smallest difference seen in 80 % | {share:.0%} is seen in | in a family of {family} |".replace("5%", "5 %"))
    print("|---|---|---|---|---|---|")
    for folder in folders:
        print_shot_rows(folder, count, family, share)


def print_shot_rows(folder, count, family, share):
    study = os.path.basename(os.path.normpath(folder))
    for metric, found in sorted(shot_pairs(folder).items()):
        errors = [math.hypot(s * math.sqrt(n / count), rest) for s, rest, n in found]
        seen = [[power(math.log1p(share) / e, count - 1, level) if e else 1.0 for e in errors]
                for level in (SIGNIFICANCE, SIGNIFICANCE / family)]
        typical = smallest_seen(float(np.median(errors)), count - 1, SIGNIFICANCE)
        print(f"| `{study}` | `{metric}` | {len(found)} | {100 * typical:.2g} % | {100 * np.mean(seen[0]):.0f} % | {100 * np.mean(seen[1]):.0f} % |")


def print_scenes(summary="rooms", share=0.1, counts=(28, 196)):
    """Prints each point's deviation over scenes of ln(error / error of `none`, or of the point that it changes)."""
    deviations = defaultdict(list)
    for row in rows_of(SUMMARIES / f"{summary}.csv"):
        if row["table"] in ("points", "changes") and row["low"] and row["low"] != row["high"]:
            scenes = int(row["mean_of"])
            deviations[row["column"]].append(log_error(row["low"], row["high"], scenes - 2) * math.sqrt(scenes))
    print(f"| metric | pairs | deviation | {100 * share:.0f} % is seen over " + " | over ".join(f"{n} scenes in" for n in counts) + " | scenes for 80 % |")
    print("|---|---|---|" + "---|" * len(counts) + "---|")
    for metric, found in sorted(deviations.items()):
        seen = [np.mean([power(math.log1p(share) * math.sqrt(n) / d, n - 2, SIGNIFICANCE) for d in found]) for n in counts]
        needed = 4
        while power(math.log1p(share) * math.sqrt(needed) / np.median(found), needed - 2, SIGNIFICANCE) < WANTED:
            needed += 1
        print(f"| `{metric}` | {len(found)} | {np.median(found):.2f} | " + " | ".join(f"{100 * s:.0f} %" for s in seen) + f" | {needed} |")


def command_line():
    parser = CommandLine(prog="python3 experiments/python power", description="Tables of the differences that metrics see: within shots, and over scenes.")
    parser.add_argument("results", nargs="*", help="folders of studies whose shots are judged")
    return parser


if __name__ == "__main__":
    if folders := command_line().parse_args().results:
        print_shots(folders)
        print()
    print_scenes()
