"""Means over scenes: they are the sample. Shots of one scene, and scenes of one asset, are averaged first."""

import math

import numpy as np
from scipy import stats

LEAST_SCENES = 4  # of fewer nothing is known but their mean


def scene_means(logs):
    """`logs`: (scene, ln ratio) pairs. Scene to the mean of its shots."""
    grouped = {}
    for scene, value in logs:
        grouped.setdefault(scene, []).append(value)
    return {scene: sum(values) / len(values) for scene, values in grouped.items()}


def students(values):
    """(mean, standard error, degrees of freedom), one fewer than of normal values: logs of ratios are skewed, and with n - 1 intervals
    of four to six scenes hold the truth in 92 % (README.md)."""
    values = np.asarray(values, float)
    n = len(values)
    return float(values.mean()), float(values.std(ddof=1)) / math.sqrt(n), n - 2


def mean_interval(values):
    """(mean, low, high) by Student's t; no ends below LEAST_SCENES values."""
    if len(values) < LEAST_SCENES:
        return float(np.mean(values)), None, None
    mean, error, degrees = students(values)
    half = float(stats.t.ppf(0.975, degrees)) * error
    return mean, mean - half, mean + half


def geometric_mean(logs):
    """(ratio, low, high, scenes, shots) of (scene, ln ratio) pairs."""
    means = scene_means(logs)
    ends = mean_interval(list(means.values()))
    return (*(None if v is None else math.exp(v) for v in ends), len(means), len(logs))


def mean(values):
    """(mean, low, high) of (scene, value) pairs."""
    return mean_interval(list(scene_means(values).values()))
