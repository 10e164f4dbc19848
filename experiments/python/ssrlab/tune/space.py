"""Which values of a technique's parameters are tried."""

import math

from ssrlab.mistakes import ResultsError

DIGITS = 4  # of a number that was sampled: names of points and presets stay legible
STEP = 0.1  # standard deviation of a small step, as a share of a range


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

    def draw(self, random):
        if self.values is not None:
            return self.values[random.integers(len(self.values))]
        return self.at(random.random())

    def near(self, value, random):
        """A value a small step from this one; another one of a list."""
        return self.draw(random) if self.values is not None else self.at(self.place(value) + random.normal(0, STEP))

    def at(self, place):
        """The value at a place from 0, the low end, to 1, the high one."""
        low, high = (math.log(e) for e in self.ends) if self.is_log else self.ends
        value = low + min(max(place, 0.0), 1.0) * (high - low)
        value = math.exp(value) if self.is_log else value
        value = round(value) if self.is_whole else float(f"{value:.{DIGITS}g}")
        return min(max(value, self.ends[0]), self.ends[1])

    def place(self, value):
        low, high, value = (math.log(v) if self.is_log else v for v in (*self.ends, self.nearest(value)))
        return (value - low) / (high - low) if high > low else 0.0

    def coordinates(self, value):
        """Numbers from 0 to 1: the place, of listed numbers the share that are smaller, and one number for each name."""
        if self.values is None:
            return [self.place(value)]
        if all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in self.values):
            return [sum(v < value for v in self.values) / len(self.values)]
        return [float(value == v) for v in (self.values if len(self.values) > 2 else self.values[:1])]

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

    def point(self, choose):
        """{name: value} of the axes that are active, with the value that `choose` gives an axis."""
        held, chosen = dict(self.start), {}
        for axis in self.axes:
            if axis.is_active(held):
                held[axis.name] = chosen[axis.name] = choose(axis)
        return chosen

    def coordinates(self, values):
        """Numbers from 0 to 1; axes that are not active are at the start, since they change nothing."""
        held = self.start | values
        return [c for axis in self.axes for c in axis.coordinates(held[axis.name])]

    def is_start(self, values):
        return all(self.start[name] == value for name, value in values.items())

    def like(self, parameters):
        """{name: value} of the axes that have a value like these of all parameters."""
        found = {axis.name: axis.nearest(parameters[axis.name]) for axis in self.axes}
        return {name: value for name, value in found.items() if value is not None}
