"""One number of a table, with its uncertainty and status."""

from dataclasses import dataclass

NO_INTERVAL = "none: "  # experiments/results/verdicts/interval.h: before the reason
NOT_POSITIVE = NO_INTERVAL + "an error is not above 0"
SOME_ZERO = NO_INTERVAL + "a count is 0"
COUNTED = "counted"  # of counts, in place of what an interval holds: they are of one seed
EXACT = "exact"  # of what a compiler states of its code
BOTH = " / "  # between what differs among the parts of a mean


@dataclass
class Cell:
    """One number of a table with its 95 % interval, and the range of the parts of a mean; None where there is none."""

    table: str
    row: str
    column: str
    value: float = None  # none: what its rows have is no value, or has no geometric mean
    low: float = None
    high: float = None
    least: float = None  # of the shots that a geometric mean is over
    most: float = None
    is_significant: bool = False  # as effects.csv says (`verdict`)
    seeds: int = None
    interval: str = None  # what it holds, or why there is none: experiments/results/verdicts/interval.h; COUNTED; EXACT
    mean_of: int = None  # how many have a value and are in the mean; of how many, its table knows
    clock: str = None  # of times
    disturbed_share: float = None  # of the frames that a time is the median of, by other programs
    standing: str = None  # in its shot: best, tied or equivalent (summary.csv)
    is_share: bool = False  # in [0, 1], and so is its interval; not kept in summaries, whose cells are as they are
    may_be_zero: bool = False  # so that its mean is the arithmetic one; not kept either

    def is_count(self):
        return self.interval in (COUNTED, EXACT)

    def reasons(self):
        """Why there is no interval, if known."""
        kinds = (self.interval or "").split(BOTH)
        return [kind[len(NO_INTERVAL) :] for kind in kinds if kind.startswith(NO_INTERVAL)]
