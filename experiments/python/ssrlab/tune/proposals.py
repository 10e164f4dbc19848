"""The optimiser: proposes batches of points of a space, from the errors and times of those before.

Gaussian processes predict the logarithms of error and time, with their uncertainty. The point to try is the one whose optimistic prediction
adds most to the area that the front dominates (SMS-EGO, Ponweiser et al. 2008, "Multiobjective optimization on a limited budget of
evaluations using model-assisted S-metric selection"). The processes then believe their prediction for this point ("kriging believer",
Ginsbourger et al. 2010), so that the next point of the batch is another one, and no nearer than APART."""

import json

import numpy as np
from ssrlab.tune.gaussian_process import GaussianProcess

STARTUP = 10  # points at random, before there is anything to learn from
OPTIMISM = 1.0  # standard deviations by which a prediction may be wrong in a point's favour
CANDIDATES = 600  # points at random, and as many beside the front's, of which one is proposed
APART = 0.05  # least distance of a batch's points in coordinates from 0 to 1: what is nearer differs by less than noise, as a rule
GROWTH = 1.1  # ratio of numbers of points after which length scales are fitted again
MARGIN = 0.2  # of logarithms of times: the most time counts as so much beyond itself, for points at it to have an area


def key_of(values):
    return json.dumps(values, sort_keys=True)


def front_of(points):
    """(error, time) pairs that no other beats, by rising times and falling errors."""
    front = []
    for time, error in sorted((time, error) for error, time in points):
        if not front or error < front[-1][0]:
            front.append((error, time))
    return front


def gains(front, errors, times, worst_error, worst_time):
    """The areas that each of N points adds to what a front dominates, up to the worst error and time. `front`: as front_of() gives it,
    within the worst ones; `errors`, `times`: arrays of N."""
    ends = [time for _, time in front] + [worst_time]
    added = np.maximum(ends[0] - times, 0) * np.maximum(worst_error - errors, 0)
    for (error, begin), end in zip(front, ends[1:]):
        added += np.maximum(end - np.maximum(times, begin), 0) * np.maximum(error - errors, 0)
    return added


class Proposals:
    """The same answers lead to the same proposals, which is how a search continues. Errors and times are logarithms of ratios to the
    baseline."""

    def __init__(self, space, seed, log_most_time):
        self.space, self.most = space, log_most_time
        self.random = np.random.default_rng(seed)
        self.first = []  # what begin_with() named, and asked for next
        self.known = set()  # keys of the points that were asked for
        self.points, self.told = [], []  # values, and (error, time)
        self.processes, self.fitted_at = None, 0

    def begin_with(self, parameters):
        """Proposes the point that is most like a known one."""
        self.first.append(self.drawn(self.space.like(parameters)))

    def ask(self, count):
        """Up to `count` points: fewer if none is left that was not asked for."""
        asked = [self.first.pop(0) for _ in range(min(count, len(self.first)))]
        self.known.update(map(key_of, asked))
        at_random = count if len(self.told) < STARTUP / 2 else max(STARTUP - len(self.known), 0)
        asked += self.unknown(self.drawn({}) for _ in range(CANDIDATES))[: min(at_random, count - len(asked))]
        self.known.update(map(key_of, asked))
        if len(asked) < count and len(self.told) >= STARTUP / 2:
            asked += self.best(count - len(asked), asked)
        self.known.update(map(key_of, asked))
        return asked

    def tell(self, values, log_error, log_time):
        self.points.append(values)
        self.told.append((log_error, log_time))

    def drawn(self, values):
        """A point at random, but for these values."""
        return self.space.point(lambda axis: values[axis.name] if axis.name in values else axis.draw(self.random))

    def beside(self, values):
        """A point that differs from another in a few axes."""
        axes, is_small, about = self.space.axes, self.random.random() < 0.5, self.random.integers(1, 4)
        changed = {axis.name for axis in axes if self.random.random() < about / len(axes)}
        other = {}
        for axis in axes:
            if axis.name in values:
                other[axis.name] = values[axis.name]
                if axis.name in changed:
                    other[axis.name] = axis.near(values[axis.name], self.random) if is_small else axis.draw(self.random)
        return self.drawn(other)

    def unknown(self, candidates):
        """Those that were not asked for, each once."""
        found = {key_of(values): values for values in candidates}
        return [values for key, values in found.items() if key not in self.known]

    def best(self, count, asked):
        """`count` candidates beside the points `asked` for in the same batch."""
        front = front_of((e, t) for e, t in self.told if t <= self.most) or front_of(self.told)
        parents = [values for values, told in zip(self.points, self.told) if told in front]
        around = [self.beside(parents[self.random.integers(len(parents))]) for _ in range(CANDIDATES)]
        candidates = self.unknown([self.drawn({}) for _ in range(CANDIDATES)] + around)
        if not candidates:
            return []
        places = np.array([self.space.coordinates(values) for values in candidates])
        errors, times = self.fit()
        left, chosen = np.arange(len(candidates)), []

        def choose(place):
            nonlocal errors, times, left
            errors, times = errors.believing(place), times.believing(place)
            left = left[np.linalg.norm(places[left] - place, axis=1) >= APART]

        for values in asked:
            choose(np.array(self.space.coordinates(values)))
        worst = max(0.0, float(np.median([error for error, _ in self.told]))), self.most + MARGIN
        while len(left) and len(chosen) < count:
            (error, error_off), (time, time_off) = errors.predict(places[left]), times.predict(places[left])
            front = front_of((e, t) for e, t in zip(errors.values, times.values) if e < worst[0] and t <= self.most)
            low_error, low_time = error - OPTIMISM * error_off, time - OPTIMISM * time_off
            added = np.where(low_time <= self.most, gains(front, low_error, low_time, *worst), 0)
            best = left[int(np.argmax(added if added.max() > 0 else error_off))]
            chosen.append(candidates[best])
            choose(places[best])
        return chosen

    def fit(self):
        """The processes of error and time."""
        places = np.array([self.space.coordinates(values) for values in self.points])
        columns = np.array(self.told).T
        if self.processes is None or len(places) >= GROWTH * self.fitted_at:
            before = self.processes or (None, None)
            self.processes = [GaussianProcess(places, column, begin=b) for column, b in zip(columns, before)]
            self.fitted_at = len(places)
        else:
            self.processes = [GaussianProcess(places, column, like=b) for column, b in zip(columns, self.processes)]
        return self.processes
