"""Which of two parts of a technique decides its error: shares of the variance of ln error over all pairs of parts."""

import math

from ssrlab import statistics

KINDS = ("first", "second", "both together")


def _mean(values):
    values = list(values)
    return sum(values) / len(values)


def _effects(errors):
    """{kind: {pair: effect}}: additions to the mean by the first part, the second, and both together, from {(first, second): ln error} of
    all pairs."""
    firsts, seconds = (list(dict.fromkeys(pair[i] for pair in errors)) for i in (0, 1))
    mean = _mean(errors.values())
    of_first = {a: _mean(errors[a, b] for b in seconds) - mean for a in firsts}
    of_second = {b: _mean(errors[a, b] for a in firsts) - mean for b in seconds}
    return {
        "first": {pair: of_first[pair[0]] for pair in errors},
        "second": {pair: of_second[pair[1]] for pair in errors},
        "both together": {(a, b): e - mean - of_first[a] - of_second[b] for (a, b), e in errors.items()},
    }


def variance_parts(pairs):
    """{kind: variance} of one scene: of the first part's means, of the second's, and the rest, which both have together. `pairs`: {(first,
    second): {seed: ln error}} of all pairs; a pair without random numbers has one seed, which stands for all.

    Each variance is the mean product of two seeds' effects, not a square. The techniques' noise is independent between seeds, so it adds
    nothing on average. The reference's noise, which all seeds and pairs share, mostly cancels.
    """
    seeds = sorted({seed for by_seed in pairs.values() for seed in by_seed})[:2]
    one, other = (_effects({pair: by_seed.get(seed, next(iter(by_seed.values()))) for pair, by_seed in pairs.items()}) for seed in (seeds[0], seeds[-1]))
    return {kind: _mean(one[kind][pair] * other[kind][pair] for pair in pairs) for kind in KINDS}


def share_of_total(parts, totals):
    """(share, low, high): the ratio of the means over scenes of (asset, value) pairs, so that scenes with more at stake count more; scenes
    of one asset are averaged first. The interval holds all ratios in [0, 1] at which the mean of part - ratio * total may be 0 (Fieller
    1954). An interval of the linearised ratio would be too short if a few scenes have most of the total. No interval below four scenes.
    """
    mean, low, high = statistics.mean_over_scenes(parts)[:3]
    mean_total, low_total, high_total = statistics.mean_over_scenes(totals)[:3]
    if low is None:
        return mean / mean_total, None, None
    _, low_rest, high_rest, _ = statistics.mean_over_scenes([(asset, part - total) for (asset, part), (_, total) in zip(parts, totals)])
    of_part, of_total, of_rest = (((high - low) / 2) ** 2 for low, high in ((low, high), (low_total, high_total), (low_rest, high_rest)))
    of_both = (of_part + of_total - of_rest) / 2
    square, half, constant = mean_total**2 - of_total, mean * mean_total - of_both, mean**2 - of_part
    if square <= 0:
        return mean / mean_total, 0.0, 1.0
    root = math.sqrt(max(half**2 - square * constant, 0.0))
    return mean / mean_total, *(min(max(end / square, 0.0), 1.0) for end in (half - root, half + root))
