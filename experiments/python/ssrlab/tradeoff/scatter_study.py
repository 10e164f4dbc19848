"""How well intervals and probabilities over scenes hold, where the truth is known: the scenes of kept summaries are all scenes there are, and
each trial draws some of them with replacement. Prints the tables of README.md ("Over few scenes").

usage: python3 experiments/python tradeoff.scatter_study [TRIALS]    400 by default, which take a minute
"""

import csv
import sys

import numpy as np
from scipy import special, stats

from ssrlab.repository import SUMMARIES

KEPT = {  # file, table, its axis of scenes
    "`comparison`, MSE": ("comparison.csv", "by_scene", "row"),
    "`rooms_tuned`, FLIP": ("rooms_tuned.csv", "by_room", "row"),
    "`quality`, MSE": ("quality.csv", "errors", "column"),
}
PRIOR = 3  # pooled_degrees, experiments/results/verdicts/effects/scatter_over_scenes.h
NEAR = np.log(1.1)
BINS = ((0, 0.05), (0.05, 0.2), (0.2, 0.5), (0.5, 0.8), (0.8, 1.01))


def logarithms(file, table, axis):
    """Scenes x points; without scenes in which an error is rounding, as ssrlab leaves them out (divisor_of() in over_scenes.h)."""
    with open(SUMMARIES / file, newline="", encoding="utf-8") as stream:
        rows = [r for r in csv.DictReader(line for line in stream if not line.startswith("#")) if r["table"] == table]
    point_axis = "column" if axis == "row" else "row"
    scenes, points = (list(dict.fromkeys(r[a] for r in rows)) for a in (axis, point_axis))
    errors = np.full((len(scenes), len(points)), np.nan)
    for r in rows:
        if r["value"]:
            errors[scenes.index(r[axis]), points.index(r[point_axis])] = float(r["value"])
    errors = errors[:, np.mean(errors > 0, axis=0) > 0.9]
    return np.log(errors[np.all(errors > 1e-6 * errors.max(1, keepdims=True), axis=1)])


def smyth(variances, degrees):
    """(degrees, variance) of the prior that variances of so many degrees suggest (Smyth 2004, section 6.2)."""
    e = np.log(variances) - special.digamma(degrees / 2) + np.log(degrees / 2)
    excess = e.var(ddof=1) - special.polygamma(1, degrees / 2)
    if excess <= 0:
        return 1e3, np.exp(e.mean())
    half = 0.5 + 1 / excess
    for _ in range(50):  # trigamma(half) = excess by Newton's method on its inverse
        trigamma = special.polygamma(1, half)
        half += trigamma * (1 - trigamma / excess) / special.polygamma(2, half)
    return min(2 * half, 1e3), np.exp(e.mean() + special.digamma(half) - np.log(half))


def residual_variances(drawn):
    n, k = drawn.shape
    rest = drawn - drawn.mean(1, keepdims=True)
    return ((rest - rest.mean(0)) ** 2).sum(0) / ((n - 1) * (1 - 1 / k))


def half_widths(drawn, first, second):
    """By name: half of each pair's 95 % interval."""
    n, k = drawn.shape
    own = (drawn[:, first] - drawn[:, second]).var(0, ddof=1)
    pooled = own.mean()
    prior, prior_variance = smyth(np.maximum(residual_variances(drawn), 1e-12), n - 1)
    moderated = lambda degrees, variance: (degrees * variance + (n - 1) * own) / (degrees + n - 1)  # noqa: E731
    rules = {
        "n - 2 degrees": (own, n - 2),
        "n - 1 degrees": (own, n - 1),
        f"{PRIOR} pooled": (moderated(PRIOR, pooled), PRIOR + n - 1),
        "Smyth's prior": (moderated(prior, 2 * prior_variance), min(prior + n - 1, (k - 1) * (n - 1))),
        "pooled alone": (np.full_like(own, pooled), (k - 1) * (n - 1)),
    }
    return {name: stats.t.ppf(0.975, degrees) * np.sqrt(variance / n) for name, (variance, degrees) in rules.items()}


def chances(drawn, generator, draws=2000):
    """(probability to be first, to be near it) of each point."""
    n, k = drawn.shape
    variances = residual_variances(drawn)
    degrees = PRIOR + n - 1
    errors = np.sqrt((PRIOR * variances.mean() + (n - 1) * variances) / degrees / n)
    wider = np.sqrt(degrees / generator.chisquare(degrees, (draws, 1)))
    means = drawn.mean(0) + wider * errors * generator.standard_normal((draws, k))
    least = means.min(1, keepdims=True)
    return (means == least).mean(0), (means - least <= NEAR).mean(0)


def print_table(rows):
    for i, row in enumerate(rows):
        print("| " + " | ".join(row) + " |")
        if i == 0:
            print("|" + "---|" * len(row))
    print()


def main():
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    generator = np.random.default_rng(1)
    coverage, calibration = [], []
    for name, kept in KEPT.items():
        all_scenes = logarithms(*kept)
        truth, k = all_scenes.mean(0), all_scenes.shape[1]
        first, second = np.triu_indices(k, 1)
        for n in (4, 6, 8, 16):
            if n > len(all_scenes) / 2:
                continue
            held, said = {}, []
            for _ in range(trials):
                drawn = all_scenes[generator.integers(0, len(all_scenes), n)]
                off = np.abs((drawn[:, first] - drawn[:, second]).mean(0) - (truth[first] - truth[second]))
                for rule, half in half_widths(drawn, first, second).items():
                    held.setdefault(rule, []).append(((off <= half).mean(), np.median(half)))
                said.append(chances(drawn, generator))
            held = {rule: np.mean(v, axis=0) for rule, v in held.items()}
            coverage = coverage or [["95 % intervals of", "scenes", *held]]
            coverage.append([f"{name}, {k} points", str(n), *(f"{100 * c:.1f} % (±{w:.2f})" for c, w in held.values())])
            if n not in (4, 8):
                continue
            for what, which, is_so in (("first", 0, truth == truth.min()), ("within 10 %", 1, truth - truth.min() <= NEAR)):
                p = np.array([s[which] for s in said])
                so = np.broadcast_to(is_so, p.shape)
                cells = [(p >= low) & (p < high) for low, high in BINS]
                calibration.append([f"{name}, {what}", str(n), *(f"{p[c].mean():.2f}: {so[c].mean():.2f}" if c.sum() > 20 else "" for c in cells)])
    print_table(coverage)
    print_table([["said: true of", "scenes", *(f"{low} to {min(high, 1)}" for low, high in BINS)], *calibration])


if __name__ == "__main__":
    main()
