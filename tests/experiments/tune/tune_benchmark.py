"""How many points the optimiser of `ssrlab tune` tries until its front is good, without rendering.

usage: PYTHONPATH=experiments/python python3 tests/experiments/tune/tune_benchmark.py [SEEDS [POINTS]]

Three spaces: the made-up one of tune_test.py, and two techniques whose points measured_points.py rendered at random; boosted trees give their
values between (scikit-learn, Debian: python3-sklearn). Batches have 8 points. A front is judged by the area that it dominates, up to the baseline's error and the largest budget,
as a share of the area of all points that any search here found. Beside the optimiser: random points, and Optuna's TPE of the same batches
if Optuna is installed (Debian: python3-optuna)."""

import json
import math
import os
import sys
import warnings

import numpy as np
import tune_test as made_up
from scipy import stats
from sklearn.ensemble import GradientBoostingRegressor
from ssrlab.tune.proposals import Proposals, front_of, gains, key_of
from ssrlab.tune.space import Space

BATCH, BUDGET = 8, math.log(2)
SHARES = (0.8, 0.9, 0.95)


def fitted(rows, values):
    """Friedman 2002, "Stochastic gradient boosting"."""
    return GradientBoostingRegressor(n_estimators=120, max_depth=4, min_samples_leaf=4, subsample=0.7, max_features=0.6, random_state=0).fit(rows, values)


class Measured:
    """A technique's space, between its measured points."""

    def __init__(self, name):
        with open(os.path.join(os.path.dirname(__file__), "measured_points", f"{name}.json"), encoding="utf-8") as stream:
            table = json.load(stream)
        self.space, self.name = Space(table["axes"], table["declared"], table["start"]), name
        points = [{a.name: v for a, v in zip(self.space.axes, row) if v is not None} for row in table["points"]]
        rows, values = np.array([self.space.coordinates(p) for p in points]), np.array([row[-2:] for row in table["points"]])
        self.models = [fitted(rows, column) for column in values.T]
        held = np.arange(len(rows)) % 5 == 0  # a fifth tells how well the rest predicts it
        off = [fitted(rows[~held], column[~held]).predict(rows[held]) - column[held] for column in values.T]
        self.explained = [1 - (o**2).mean() / column[held].var() for o, column in zip(off, values.T)]

    def __call__(self, values):
        row = [self.space.coordinates(values)]
        return tuple(float(model.predict(row)[0]) for model in self.models)


class MadeUp:
    name, explained = "made up", (1.0, 1.0)

    def __init__(self):
        self.space = Space(made_up.AXES, made_up.DECLARED, made_up.DEFAULTS)

    def __call__(self, values):
        ratios = [np.array(made_up.truth(made_up.DEFAULTS | values, s)) / made_up.truth(made_up.DEFAULTS, s) for s in made_up.SHOTS]
        return tuple(float(mean) for mean in np.log(ratios).mean(0))


class AtRandom:
    def __init__(self, space, seed):
        self.space, self.random = space, np.random.default_rng(seed)

    def ask(self, count):
        return [self.space.point(lambda axis: axis.draw(self.random)) for _ in range(count)]

    def tell(self, values, log_error, log_time):
        pass


class Tpe:
    """Optuna's TPE, of several objectives."""

    def __init__(self, space, seed):
        import optuna

        optuna.logging.set_verbosity(optuna.logging.WARNING)
        warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
        fits = {"constraints_func": lambda trial: (trial.user_attrs["excess"],)}
        sampler = optuna.samplers.TPESampler(seed=seed, n_startup_trials=16, multivariate=True, group=True, **fits)
        self.space, self.study, self.trials = space, optuna.create_study(directions=["minimize"] * 2, sampler=sampler), {}
        self.study.enqueue_trial({name: space.start[name] for name in (a.name for a in space.axes)})

    def suggest(self, trial, axis):
        if axis.values is not None:
            return trial.suggest_categorical(axis.name, axis.values)
        if axis.is_whole:
            return trial.suggest_int(axis.name, *(int(e) for e in axis.ends), log=axis.is_log)
        return axis.nearest(float(f"{trial.suggest_float(axis.name, *axis.ends, log=axis.is_log):.4g}"))

    def ask(self, count):
        asked = []
        for _ in range(count):
            trial = self.study.ask()
            asked.append(self.space.point(lambda axis, trial=trial: self.suggest(trial, axis)))
            self.trials.setdefault(key_of(asked[-1]), []).append(trial)
        return asked

    def tell(self, values, log_error, log_time):
        trial = self.trials[key_of(values)].pop(0)
        trial.set_user_attr("excess", log_time - BUDGET)
        self.study.tell(trial, (log_error, log_time))


def own(space, seed):
    found = Proposals(space, seed, BUDGET)
    found.begin_with(space.start)
    return found


def search(problem, optimiser, count):
    """(error, time) of the points tried, each once."""
    known = {}
    for _ in range(10 * count // BATCH):
        if len(known) >= count:
            break
        for values in (asked := optimiser.ask(BATCH)):
            known.setdefault(key_of(values), problem(values))
        for values in asked:
            optimiser.tell(values, *known[key_of(values)])
    return list(known.values())[:count]


def areas(points):
    """The area dominated after each point."""
    found, area, kept = [], 0.0, []
    for error, time in points:
        if error < 0 and time < BUDGET:
            area += float(gains(front_of(kept), np.array([error]), np.array([time]), 0.0, BUDGET)[0])
            kept.append((error, time))
        found.append(area)
    return np.array(found)


def mean(values):
    half = stats.t.isf(0.025, len(values) - 1) * np.std(values, ddof=1) / math.sqrt(len(values))
    return f"{np.mean(values):.0f} +- {half:.0f}"


def main(seeds=10, count=100):
    ways = {"ssrlab tune": own, "TPE": Tpe, "random": AtRandom}
    try:
        import optuna  # noqa: F401
    except ImportError:
        del ways["TPE"]
    print(f"{seeds} seeds; points tried until a share of the best area, at most {count}; in brackets how many searches came to it")
    for problem in (MadeUp(), Measured("mcguire_dda"), Measured("four_mode")):
        tried = {way: [search(problem, make(problem.space, seed), count) for seed in range(seeds)] for way, make in ways.items()}
        best = areas([p for searches in tried.values() for points in searches for p in points])[-1]
        print(f"{problem.name}: {len(problem.space.axes)} axes; of the variance the trees explain {problem.explained[0]:.2f} (error), {problem.explained[1]:.2f} (time)")
        for way, searches in tried.items():
            shares = [areas(points) / best for points in searches]
            cells = []
            for share in SHARES:
                needed = [int(np.argmax(s >= share)) + 1 if s[-1] >= share else count for s in shares]
                cells.append(f"{share:.0%}: {mean(needed)} ({sum(s[-1] >= share for s in shares)})")
            print(f"  {way:12} {'  '.join(cells)}  share at the end {np.mean([s[-1] for s in shares]):.2f}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
