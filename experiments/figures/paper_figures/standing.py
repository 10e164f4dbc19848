"""Which of several numbers is the best, said only where intervals tell it."""

from dataclasses import dataclass

HIGHER_IS_BETTER = ("ssim", "psnr")
BEST, TIED = "best", "tied"


@dataclass
class Ends:
    """A number with the ends of its 95 % interval; None where there is none."""

    value: float
    low: float | None
    high: float | None


def ratios_of(rows):
    """{((variant, point), (variant, point)): Ends} of rows of effects.csv, all of one shot, target, metric and mask: paired
    comparisons, which tell more apart than the intervals of both."""
    return {
        ((r["variant"], r["point"]), (r["against_variant"], r["against_point"])): Ends(
            float(r["ratio"]), float(r["low"]), float(r["high"])
        )
        for r in rows
        if r["ratio"] and r["low"] and r["high"]
    }


def are_told_apart(first, second, ratio=None):
    """By the interval of their `ratio` where it is known, else by their own, which then must not meet."""
    if ratio is not None:
        return ratio.low > 1 or ratio.high < 1
    if None in (first.low, first.high, second.low, second.high):
        return False
    return first.high < second.low or second.high < first.low


def standings(numbers, is_higher_better=False, ratios=None):
    """{key: BEST} of `numbers` ({key: something with value, low, high}) where the best is told from all others, else
    {key: TIED} of it and all that cannot be told from it. Nothing of fewer than two numbers."""
    known = {key: n for key, n in numbers.items() if n is not None and n.value is not None}
    if len(known) < 2:
        return {}
    best = (max if is_higher_better else min)(known, key=lambda k: known[k].value)

    def is_told(key):
        of_both = next((ratios[pair] for pair in ((best, key), (key, best)) if pair in (ratios or {})), None)
        return are_told_apart(known[best], known[key], of_both)

    tied = [key for key in known if key != best and not is_told(key)]
    return dict.fromkeys([best, *tied], TIED) if tied else {best: BEST}
