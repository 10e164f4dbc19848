"""Which of two parts of a technique decides its error: shares of the variance of ln error over all pairs of both."""

import math

from ssrlab import statistics

KINDS = ("first", "second", "both together")


def _mean(values):
    values = list(values)
    return sum(values) / len(values)


def _effects(errors):
    """{kind: {pair: effect}} of {(first, second): ln error} with all pairs: what the first part, the second, and both together add to
    the mean."""
    firsts, seconds = (list(dict.fromkeys(pair[i] for pair in errors)) for i in (0, 1))
    mean = _mean(errors.values())
    of_first = {a: _mean(errors[a, b] for b in seconds) - mean for a in firsts}
    of_second = {b: _mean(errors[a, b] for a in firsts) - mean for b in seconds}
    return {
        "first": {pair: of_first[pair[0]] for pair in errors},
        "second": {pair: of_second[pair[1]] for pair in errors},
        "both together": {(a, b): e - mean - of_first[a] - of_second[b] for (a, b), e in errors.items()},
    }


def _ratio(parts, totals):
    """(ratio, low, high) of the means over scenes of (asset, value) pairs. The interval has all ratios at which the mean of part -
    ratio * total may be 0 (Fieller 1954), within [0, 1]: that of the linearized ratio is too short where a few scenes have most of it.
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


def variance_shares(scenes):
    """{kind: (share, low, high)}, over scenes. `scenes`: (asset, [errors of two seeds]) with errors {(first, second): ln error}.

    In each scene the variance of ln error over all pairs is that of the first part's means, that of the second's, and what is left, which
    both have together. Each is taken as the mean product of two seeds' effects, not as a square: the techniques' noise, which is independent
    between seeds, then adds nothing to any of them on average. That of the reference, which both seeds and all pairs share, mostly cancels. Shares are ratios of means over scenes, so that a scene counts by how much is
    at stake in it, scenes of one asset averaged first. No ends below four scenes.
    """
    parts = {kind: [] for kind in KINDS}
    for asset, seeds in scenes:
        one, other = (_effects(errors) for errors in seeds)
        for kind in KINDS:
            parts[kind].append((asset, _mean(one[kind][pair] * other[kind][pair] for pair in one[kind])))
    totals = [(asset, sum(parts[kind][i][1] for kind in KINDS)) for i, (asset, _) in enumerate(scenes)]
    return {kind: _ratio(parts[kind], totals) for kind in KINDS}
