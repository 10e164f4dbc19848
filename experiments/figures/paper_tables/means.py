"""Means of a table's cells, over shots or what else its `over` names."""

import math

from paper_tables import agreement
from paper_tables.cell import BOTH, NOT_POSITIVE, SOME_ZERO, Cell

SHARES = ("hits",)  # tables of what may be 0: their mean over shots is the arithmetic one


def largest(numbers):
    return max((n for n in numbers if n is not None), default=None)


def _joined(texts):
    return BOTH.join(dict.fromkeys(t for t in texts if t)) or None


def _geometric_mean(parts):
    """Over shots, which are what they are and no sample: its interval holds what those of the single ones hold, taken as
    independent (half-widths of logarithms, added in quadrature). Parts without a value are not in it."""
    cells = [c for c in parts if c.value is not None]
    result = Cell(parts[0].table, parts[0].row, parts[0].column, mean_of=len(cells))
    result.interval = _joined(c.interval for c in cells or parts)
    result.clock = _joined(c.clock for c in cells)
    result.disturbed_share = largest(c.disturbed_share for c in cells)
    result.seeds = min((c.seeds for c in cells if c.seeds is not None), default=None)
    if not cells:
        return result
    least, most = min(c.value for c in cells), max(c.value for c in cells)
    if result.is_count() and least == most:  # 0 too, and not a rounding away from it
        result.value = result.least = result.most = least
        return result
    if least <= 0:
        result.interval = SOME_ZERO if result.is_count() else NOT_POSITIVE
        return result
    result.value = math.exp(sum(math.log(c.value) for c in cells) / len(cells))
    result.least, result.most = least, most
    if all(c.low and c.low > 0 and c.high for c in cells):
        half = math.sqrt(sum((math.log(c.high / c.low) / 2) ** 2 for c in cells)) / len(cells)
        result.low, result.high = result.value * math.exp(-half), result.value * math.exp(half)
    return result


def _arithmetic_mean(parts):
    """Of shares over shots, which are what they are and no sample; intervals as those of _geometric_mean()."""
    cells = [c for c in parts if c.value is not None]
    result = Cell(parts[0].table, parts[0].row, parts[0].column, mean_of=len(cells))
    if not cells:
        return result
    result.value = sum(c.value for c in cells) / len(cells)
    result.least, result.most = min(c.value for c in cells), max(c.value for c in cells)
    result.seeds = min((c.seeds for c in cells if c.seeds is not None), default=None)
    if all(c.low is not None and c.high is not None for c in cells):
        half = math.sqrt(sum(((c.high - c.low) / 2) ** 2 for c in cells)) / len(cells)
        result.low, result.high = result.value - half, result.value + half
    return result


def _mean_of_sample(table, parts):
    """Of what has no interval by itself, over shots or pairs that are taken as a sample."""
    estimate = agreement.mean_over_shots if table.of == "agreement" else agreement.share_of_pairs
    result = Cell(parts[0].table, parts[0].row, parts[0].column, *estimate([c.value for c in parts]), mean_of=len(parts))
    if table.of == "agreement":
        result.least, result.most = min(c.value for c in parts), max(c.value for c in parts)
    return result


def mean(table, parts):
    if table.of in ("agreement", "eye"):
        return _mean_of_sample(table, parts)
    return _arithmetic_mean(parts) if table.of in SHARES else _geometric_mean(parts)
