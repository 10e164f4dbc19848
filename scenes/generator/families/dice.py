"""Densities, and draws from them that are the same on every machine and in every version of Python.

Each question has a stream of its own, named by a text, so that one more chair does not change the lamps. Streams are
random.Random of that text; only its random() is the same in all versions of Python.
"""
import random
from dataclasses import dataclass

TABLE = []  # of all densities, in the order in which they are stated


@dataclass
class Density:
    family: str  # rooms, streets, or both
    what: str
    unit: str
    kind: str  # quartiles, shares, rate
    values: object
    source: str

    def __post_init__(self):
        TABLE.append(self)

    def text(self):
        if self.kind == "quartiles":
            return " / ".join(f"{value:g}" for value in self.values)
        if self.kind == "rate":
            return f"{100 * self.values:g} %"
        return ", ".join(f"{name.replace('_', ' ')} {100 * share:g} %" for name, share in self.values.items())


def quartiles(family, what, unit, values, source):
    """Least, lower quartile, median, upper quartile, largest; linear in between."""
    assert len(values) == 5 and list(values) == sorted(values), what
    return Density(family, what, unit, "quartiles", values, source)


def shares(family, what, values, source):
    """Names and their shares, which add up to 1."""
    assert abs(sum(values.values()) - 1) < 1e-9, what
    return Density(family, what, "", "shares", values, source)


def rate(family, what, value, source):
    return Density(family, what, "", "rate", value, source)


class Dice:
    def __init__(self, name):
        self.name = name
        self.stream = random.Random(name)

    def about(self, question):
        """The stream of a question."""
        return Dice(f"{self.name}/{question}")

    def uniform(self, low=0.0, high=1.0):
        return low + (high - low) * self.stream.random()

    def whole(self, low, high):
        """Both included."""
        return low + int((high - low + 1) * self.stream.random())

    def one_of(self, things):
        return things[int(len(things) * self.stream.random())]

    def shuffled(self, things):
        keyed = [(self.stream.random(), i, thing) for i, thing in enumerate(things)]
        return [thing for _, _, thing in sorted(keyed, key=lambda key: key[:2])]

    def chance(self, probability):
        """`probability`: a number, or a rate of the table."""
        return self.stream.random() < getattr(probability, "values", probability)

    def draw(self, density):
        """A number of quartiles, a name of shares."""
        position = self.stream.random()
        if density.kind == "quartiles":
            i = min(int(4 * position), 3)
            low, high = density.values[i], density.values[i + 1]
            return low + (high - low) * (4 * position - i)
        for name, share in density.values.items():
            position -= share
            if position < 0:
                return name
        return name
