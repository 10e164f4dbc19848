"""When a point is stopped: statistics of a search's points, compared over the same shots and seeds.

Errors are compared by logarithms of ratios, the mean over shots and metrics. Three things make such a mean uncertain:

- Chance, estimated by the scatter over the common seeds. Few seeds estimate a scatter badly. The scatter of a shot is therefore shrunk
  towards the median scatter of the points so far, as if that had PRIOR degrees of freedom, and never below the point's own.
- The reference's noise: the intervals of both errors, added in quadrature.
- The remaining scenes, while a point has run on a part of them: how much the mean over this part missed the mean over all, in points
  that ran on all. Until LEAST_COMPLETE points have, no point is stopped on a part of the scenes.

A point is stopped if its error is significantly above that of a front point that takes no more time. The level for each point is RISK,
shared by the looks at it and by the front points that it is compared with (Bonferroni)."""

import functools
import math
import statistics
from dataclasses import dataclass, field

from scipy import stats

RISK = 0.05  # that a point which belongs to the front is stopped
LEAST_COMPLETE = 6
PRIOR = 4
NORMAL = 1.96  # half-width of a 95 % interval in standard deviations


@dataclass
class Point:
    """Measurements of a point."""

    name: str
    values: dict  # of the axes
    errors: dict = field(default_factory=dict)  # (shot, metric) to {seed: (error, standard deviation by the reference's noise)}
    times: dict = field(default_factory=dict)  # shot to the time over the baseline's
    refusal: str = ""  # why a time was not estimated
    batch: int = 0
    stopped: str = ""  # why
    estimate: tuple = None  # logarithms of error and time over the baseline's, of a point that was stopped
    parameters: dict = None  # all of them

    def shots(self):
        return list(dict.fromkeys(shot for shot, _ in self.errors))

    def runs(self):
        """Number of renders: one for each shot and seed."""
        return len({(shot, seed) for (shot, _), seeds in self.errors.items() for seed in seeds})

    def log_time(self, shots):
        return statistics.fmean(math.log(self.times[shot]) for shot in shots)


@functools.lru_cache(maxsize=4096)
def quantile(level, degrees):
    return float(stats.t.isf(level, degrees))


@functools.lru_cache(maxsize=64)
def median_over_mean(degrees):
    """Median / mean of a variance that is estimated with these degrees of freedom."""
    return float(stats.chi2.median(degrees)) / degrees


def variance(values):
    """Of at least two; plain sums, which are a hundred times as fast as statistics.variance()."""
    mean = sum(values) / len(values)
    return sum((v - mean) ** 2 for v in values) / (len(values) - 1)


def paired(a, b, key):
    """Errors of two points in a shot by one metric, at common seeds. A point without random numbers has a single seed, which stands for
    all."""
    first, second = a.errors[key], b.errors[key]
    seeds = sorted(first.keys() & second.keys()) if len(first) > 1 and len(second) > 1 else sorted(max(first, second, key=len))
    pick = lambda values: [values[s] if len(values) > 1 or s in values else next(iter(values.values())) for s in seeds]  # noqa: E731
    return pick(first), pick(second)


def level_of(values):
    """The mean error; if it is indistinguishable from 0 given the reference's noise, that noise."""
    mean = sum(v for v, _ in values) / len(values)
    return max(mean, NORMAL * max(d for _, d in values), 1e-12)


def compare_in_shot(a, b, shot):
    """(mean log ratio, variance by the seeds of a single one, seeds, variance by the reference's noise)."""
    keys = [key for key in a.errors if key[0] == shot]
    logs, deviations, noise = [], None, 0.0
    for key in keys:
        first, second = paired(a, b, key)
        mean_a, mean_b = level_of(first), level_of(second)
        logs.append(math.log(mean_a / mean_b))
        # To first order a ratio of means scatters as the difference of its parts does, each over its mean.
        own = [(x / mean_a - y / mean_b) / len(keys) for (x, _), (y, _) in zip(first, second)]
        deviations = own if deviations is None else [d + o for d, o in zip(deviations, own)]
        noise += math.hypot(max(d for _, d in first) / mean_a, max(d for _, d in second) / mean_b) / len(keys)
    scatter = variance(deviations) if len(deviations) > 1 else 0.0
    return sum(logs) / len(logs), scatter, len(deviations), noise**2


@dataclass
class Difference:
    """Difference of the logarithms of two points' errors, over common shots."""

    mean: float
    deviation: float
    degrees: float

    def half_width(self, level=0.025):
        return quantile(level, self.degrees) * self.deviation


class Race:
    def __init__(self, baseline, same_time, looks):
        """`same_time`: points whose times differ by a lesser ratio count as equally fast. `looks`: how often beaten_by() is asked about a
        point."""
        self.baseline, self.same_time, self.looks = baseline, same_time, looks
        self.complete = []
        self.logs = {}  # name of a complete point to {shot: logarithm of its error over the baseline's}
        self.scatters = {shot: [] for shot in baseline.shots()}  # of the complete points against the baseline
        self.usual = {}  # shot to their median
        self.known_front = None
        self.add(baseline)

    def shots(self):
        return self.baseline.shots()

    def add(self, point):
        """A point that has run on all shots with all seeds."""
        self.complete.append(point)
        self.known_front = None
        self.logs[point.name] = {}
        for shot in self.shots():
            self.logs[point.name][shot], scatter, seeds, _ = compare_in_shot(point, self.baseline, shot)
            if seeds > 1 and point is not self.baseline:
                self.scatters[shot].append(scatter / median_over_mean(seeds - 1))
                self.usual[shot] = statistics.median(self.scatters[shot])

    def difference(self, a, b):
        if a is b:
            return Difference(0.0, 0.0, PRIOR)
        shots = [s for s in a.shots() if s in b.shots()]
        means, squares, degrees = [], 0.0, PRIOR
        for shot in shots:
            mean, own, seeds, noise = compare_in_shot(a, b, shot)
            drawn = ((seeds - 1) * own + PRIOR * self.usual.get(shot, own)) / (seeds - 1 + PRIOR)
            means.append(mean)
            squares += max(own, drawn) / seeds + noise
            degrees += seeds - 1
        return Difference(sum(means) / len(means), math.sqrt(squares) / len(shots), degrees)

    def error(self, point):
        """Logarithms of errors over the baseline's."""
        return self.difference(point, self.baseline)

    def log_time(self, point):
        return point.log_time(point.shots())

    def front(self):
        """The complete points, by time, that no other beats: none errs less and takes less time, by what was measured."""
        if self.known_front is None:
            self.known_front = []
            for point in sorted(self.complete, key=lambda p: (self.log_time(p), self.mean_log(p))):
                if not self.known_front or self.mean_log(point) < self.mean_log(self.known_front[-1]):
                    self.known_front.append(point)
        return self.known_front

    def mean_log(self, point, shots=None):
        """Mean logarithm of a complete point's error over the baseline's."""
        return statistics.fmean(self.logs[point.name][shot] for shot in shots or self.shots())

    def scatter_of_scenes(self, seen):
        """(standard deviation, degrees of freedom) of a difference of two points over all shots minus that over the shots seen so far; None
        if there are too few points."""
        if len(seen) == len(self.shots()):
            return 0.0, 1
        if len(self.complete) < LEAST_COMPLETE:
            return None
        missed = [self.mean_log(point) - self.mean_log(point, seen) for point in self.complete]
        return math.sqrt(2 * variance(missed)), len(missed) - 1

    def beaten_by(self, point):
        """(point of the front that takes no more time and errs significantly less, difference of the logarithms of errors), or None."""
        seen = point.shots()
        scenes = self.scatter_of_scenes(seen)
        if scenes is None:
            return None
        slack = math.log(self.same_time)
        rivals = [p for p in self.front() if p.log_time(seen) <= point.log_time(seen) + slack]
        level = RISK / (self.looks * max(len(rivals), 1))
        for rival in rivals:
            difference = self.difference(point, rival)
            half = math.hypot(difference.half_width(level), quantile(level, scenes[1]) * scenes[0])
            if difference.mean > half:
                return rival, difference.mean
        return None
