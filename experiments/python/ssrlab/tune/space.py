"""Which values of a technique's parameters are tried, and the optimiser that proposes them."""

import warnings

import optuna
from ssrlab.mistakes import ResultsError

DIGITS = 4  # of a number that was sampled: names of points and presets stay legible


def holds(test, value):
    """Whether a value of a parameter meets a condition of a config (experiments/study/config/points/conditions.h)."""
    if isinstance(test, list):
        return value in test
    if not isinstance(test, dict):
        return value == test
    how = {
        "at_least": lambda limit: value >= limit,
        "at_most": lambda limit: value <= limit,
        "above": lambda limit: value > limit,
        "below": lambda limit: value < limit,
        "not": lambda other: not holds(other, value),
    }
    return all(how[name](limit) for name, limit in test.items())


class Axis:
    def __init__(self, name, written, declared):
        """`written`: an array of values, or an object with `values`, `lin` or `log`, and conditions. `declared`: the parameter's
        JSON schema."""
        self.name = name
        written = {"values": written} if isinstance(written, list) else written
        self.values = written.get("values")
        self.is_log = "log" in written
        self.ends = sorted(written.get("log") or written.get("lin") or ())
        self.is_whole = declared.get("type") == "integer"  # those with names have values alone
        self.only_if, self.skip_if = written.get("only_if"), written.get("skip_if")

    def needs(self):
        return {*(self.only_if or {}), *(self.skip_if or {})}

    def is_active(self, held):
        """`held`: the values of all parameters that are chosen so far."""
        meets = lambda tests: all(holds(test, held[name]) for name, test in tests.items())  # noqa: E731
        return (self.only_if is None or meets(self.only_if)) and (self.skip_if is None or not meets(self.skip_if))

    def suggest(self, trial):
        if self.values is not None:
            return trial.suggest_categorical(self.name, self.values)
        if self.is_whole:
            return trial.suggest_int(self.name, *(int(e) for e in self.ends), log=self.is_log)
        value = float(f"{trial.suggest_float(self.name, *self.ends, log=self.is_log):.{DIGITS}g}")
        return min(max(value, self.ends[0]), self.ends[1])

    def nearest(self, value):
        """The axis' value that is nearest to a value from elsewhere; None if there is none."""
        if self.values is not None:
            return next((v for v in self.values if v == value), None)
        return min(max(value, self.ends[0]), self.ends[1])


class Space:
    def __init__(self, axes, declared, start):
        """`axes` as the config has them; `declared`: name to JSON schema; `start`: the values of all parameters where the search
        starts, which those keep whose axis is left out by its conditions."""
        self.start = start
        self.axes, left = [], [Axis(name, written, declared[name]) for name, written in axes.items()]
        while left:
            names = {axis.name for axis in left}
            free = [axis for axis in left if not axis.needs() & names]
            if not free:
                raise ResultsError(f"tune: axes: the conditions of {', '.join(sorted(names))} wait for one another")
            self.axes += free
            left = [axis for axis in left if axis not in free]

    def suggest(self, trial):
        """{name: value} of the axes that are active at the proposed point."""
        held, chosen = dict(self.start), {}
        for axis in self.axes:
            if axis.is_active(held):
                held[axis.name] = chosen[axis.name] = axis.suggest(trial)
        return chosen

    def is_start(self, values):
        return all(self.start[name] == value for name, value in values.items())

    def like(self, parameters):
        """The point of the space that is nearest to these values of all parameters, as far as axes have them."""
        found = {axis.name: axis.nearest(parameters[axis.name]) for axis in self.axes}
        return {name: value for name, value in found.items() if value is not None}


class Proposals:
    """Batches of points to try. The same answers lead to the same proposals, which is how a search continues.

    The optimiser is Optuna's TPE. Optuna's documentation recommends it from 100 trials on, for several objectives, mixed numbers and
    categories, conditions and batches. NSGA-II handles numbers and conditions less well, and spends 50 trials on its first generation
    alone. Parameters are sampled jointly (multivariate, by groups of those that are active together). Points of a batch do not know of
    one another: `constant_liar`, which keeps them apart, does nothing with several objectives (Optuna 3.1.0)."""

    STARTUP = 16  # trials that are drawn at random before there is anything to learn from

    def __init__(self, space, seed):
        optuna.logging.set_verbosity(optuna.logging.WARNING)
        warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
        sampler = optuna.samplers.TPESampler(
            seed=seed,
            n_startup_trials=self.STARTUP,
            multivariate=True,
            group=True,
            constraints_func=lambda trial: (trial.user_attrs["excess"],),
        )
        self.space = space
        self.study = optuna.create_study(directions=["minimize", "minimize"], sampler=sampler)

    def begin_with(self, parameters):
        """Proposes the point that is most like a known one."""
        self.study.enqueue_trial(self.space.like(parameters))

    def ask(self, count):
        """(trial, values) pairs."""
        return [(trial, self.space.suggest(trial)) for trial in (self.study.ask() for _ in range(count))]

    def tell(self, trial, log_error, log_time, log_most_time):
        """Logarithms of ratios to the baseline; exceeding the most time breaks a constraint."""
        trial.set_user_attr("excess", log_time - log_most_time)
        self.study.tell(trial, (log_error, log_time))
