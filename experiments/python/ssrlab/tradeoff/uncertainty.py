"""What chance may have made of errors and costs: draws of all points of a shot at once."""

import math

import numpy as np
from scipy import stats
from ssrlab import statistics

NORMAL = 1.959964  # of 95 %, as metrics/median_interval.cpp
LEVELS = (2.5, 97.5)


class ShotDraws:
    """Errors and costs as they might truly be, of points of one shot: arrays of points x draws.

    A mean error over k seeds is drawn from Student's t with k - 1 degrees of freedom about the measured one, and a median
    cost from the binomial distribution of its rank among the rounds, widened by statistics.sign_factor(). Points share the normal
    deviate of each seed and of each round, so that what seeds and slow frames do to several points at once stays common.
    What the interval of an error holds beyond its seeds, the reference's noise, is one deviate for each variant.
    Errors move by a factor exp(d / error): never to 0 or below, and further up than down."""

    def __init__(self, points, count=2000, seed=1):
        self.generator = np.random.default_rng(seed)
        self.count = count
        self.errors = self._errors(points)
        self.costs = self._costs(points)

    def _errors(self, points):
        normals, uniform = {}, self.generator.random(self.count)

        def normal(name):
            if name not in normals:
                normals[name] = self.generator.standard_normal(self.count)
            return normals[name]

        lit = self.generator.random(self.count)
        drawn = np.empty((len(points), self.count))
        for i, p in enumerate(points):
            relative, of_seeds = np.zeros(self.count), 0.0
            k = len(p.seeds)
            if k > 1:
                values = np.array(list(p.seeds.values()))
                deviations = values - values.mean()
                # A deviate for each seed times its deviation has the variance of the mean; the chi makes it Student's t.
                chi = np.sqrt(stats.chi2.ppf(np.clip(uniform, 1e-6, 1), k - 1) / (k - 1))
                scatter = sum(d * normal(("seed", s)) for s, d in zip(p.seeds, deviations)) / math.sqrt(k * (k - 1))
                relative += scatter / chi / p.error
                _, low, high = statistics.mean(values)
                of_seeds = (high - low) / 2
            up = max(p.error_high - p.error, 0.0)
            rest = math.sqrt(max(up * up - of_seeds * of_seeds, 0.0)) / NORMAL
            relative += rest / p.error * normal(("reference", p.variant))
            down = min(max(p.error - p.error_low, 0.0), up) if p.error_low <= 0 else max(p.error - p.error_low, 0.0)
            # What the noise of the lit colour adds reaches down alone (experiments/study/measuring/lit_noise.h).
            relative -= lit * max(down - up, 0.0) / p.error
            drawn[i] = p.error * np.exp(np.clip(relative, -20, 20))
        return drawn

    def _costs(self, points):
        deviates = {}
        drawn = np.empty((len(points), self.count))
        for i, p in enumerate(points):
            if not p.rounds:
                drawn[i] = p.cost
                continue
            rounds = sorted(p.rounds)
            values = np.array([p.rounds[r] for r in rounds])
            n, signs = len(values), np.sign(values - np.median(values))
            for r in rounds:
                if r not in deviates:
                    deviates[r] = self.generator.standard_normal(self.count)
            offset = math.sqrt(statistics.sign_factor(values)) / 2 * sum(s * deviates[r] for r, s in zip(rounds, signs))
            place = np.clip(n / 2 + offset - 0.5, 0, n - 1)
            drawn[i] = np.interp(place, np.arange(n), np.sort(values))
        return drawn


def interval(values):
    """The 95 % interval of the draws; values that are NaN are left out."""
    values = values[~np.isnan(values)]
    if len(values) == 0:
        return None, None
    low, high = np.percentile(values, LEVELS)
    return float(low), float(high)
