"""Statistics over scenes for the values that tables and documents choose, by the rules of the C++
(experiments/results/verdicts/effects/over_scenes.h): scenes are the sample, shots of one asset are averaged first, and below four assets
there is no interval."""

import math
import statistics

from scipy import stats

LEAST_SCENES = 4
MODEL_RANGE = (0.22, 12.8)  # experiments/gpu_costs/chips/model_range.h
MODEL_RANGE_TEXT = "measured times of stages were {:.3g} to {:.3g} times such estimates (NVIDIA H200, gpu_measured)".format(*MODEL_RANGE)
COUNTS_SPREAD = 0.025  # relative, of a point's seeds: experiments/results/files/counts_spread.h


def mean(values):
    """(mean, low, high) by Student's t, of two or more values."""
    half = stats.t.ppf(0.975, len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))
    return statistics.fmean(values), statistics.fmean(values) - half, statistics.fmean(values) + half


def mean_over_scenes(values):
    """(mean, low, high, scenes) of (asset, value) pairs, one for each shot: Student's t of n - 2 degrees of freedom."""
    of_asset = {}
    for asset, value in values:
        of_asset.setdefault(asset, []).append(float(value))
    means = [sum(of) / len(of) for _, of in sorted(of_asset.items())]
    n, middle = len(means), sum(means) / len(means)
    if n < LEAST_SCENES:
        return middle, None, None, n
    half = stats.t.ppf(0.975, n - 2) * math.sqrt(sum((v - middle) ** 2 for v in means) / (n - 1) / n)
    return middle, middle - half, middle + half, n


def geometric_mean_over_scenes(logarithms):
    """(ratio, low, high, scenes) of (asset, ln ratio) pairs."""
    *ends, scenes = mean_over_scenes(logarithms)
    return (*(None if v is None else math.exp(v) for v in ends), scenes)


def p_holm(effects, degrees):
    """p-values of "the mean is 0", adjusted together (Holm 1979), for pairs (mean, half-width of its 95 % interval). Intervals are
    Student's with the given degrees of freedom."""
    quantile = stats.t.ppf(0.975, degrees)
    p_values = [2 * stats.t.cdf(-abs(mean) * quantile / half, degrees) for mean, half in effects]
    adjusted, most = [0.0] * len(p_values), 0.0
    for place, i in enumerate(sorted(range(len(p_values)), key=p_values.__getitem__)):
        most = max(most, min((len(p_values) - place) * p_values[i], 1.0))
        adjusted[i] = most
    return adjusted


def share(values):
    """(share, low, high) of ones among zeros and ones: Wilson's 95 % interval (1927)."""
    n, z = len(values), 1.959964
    part = sum(values) / n
    middle = (part + z * z / (2 * n)) / (1 + z * z / n)
    half = z * math.sqrt(part * (1 - part) / n + z * z / (4 * n * n)) / (1 + z * z / n)
    return part, middle - half, middle + half
