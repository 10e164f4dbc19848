"""Means of a table's cells. Means over shots are means over scenes like these, which are the sample: scenes of one asset count once."""

import math

from ssrlab.tables import agreement
from ssrlab.tables.cell import BOTH, NOT_POSITIVE, SOME_ZERO, Cell
from ssrlab import statistics

SAMPLED = ("shot", "scene", "shot_group")  # what `over` takes as a sample of scenes ...
ASSETS = "assets"  # ... whose means these are
OVER_SCENES, THESE_ALONE = "scenes", "these shots"  # Cell.interval of means: as LESSER of formats.py has it


def largest(numbers):
    return max((n for n in numbers if n is not None), default=None)


def _joined(texts):
    return BOTH.join(dict.fromkeys(t for t in texts if t)) or None


def _over_scenes(result, parts, mean_of_assets):
    """Gives the mean an interval over scenes like these if enough assets have a value; it includes what seeds and references add. `parts`:
    (Cell, asset). Otherwise the mean keeps the interval of these shots, and says so."""
    mean, low, high, _ = mean_of_assets([(asset, c.value) for c, asset in parts])
    result.value = mean
    if low is not None:
        result.low, result.high, result.interval = low, high, OVER_SCENES
    elif result.low is not None:
        result.interval = _joined([result.interval, THESE_ALONE])


def _geometric_mean(parts, assets):
    """The geometric mean of the parts with a value. `assets`: of each part, if the mean is over a sample of scenes. If None, the interval
    joins those of the parts as independent: half-widths of logarithms, added in quadrature."""
    filled = [i for i, c in enumerate(parts) if c.value is not None]
    cells = [parts[i] for i in filled]
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
    if all(c.low and c.high and min(c.low, c.high) > 0 for c in cells):
        half = math.sqrt(sum((math.log(c.high / c.low) / 2) ** 2 for c in cells)) / len(cells)
        result.low, result.high = result.value * math.exp(-half), result.value * math.exp(half)
    if assets and not result.is_count():
        _over_scenes(result, [(parts[i], assets[i]) for i in filled], lambda of: statistics.geometric_mean_over_scenes([(a, math.log(v)) for a, v in of]))
    return result


def _arithmetic_mean(parts, assets):
    """The mean of values that may be 0; intervals as in _geometric_mean()."""
    filled = [i for i, c in enumerate(parts) if c.value is not None]
    cells = [parts[i] for i in filled]
    result = Cell(parts[0].table, parts[0].row, parts[0].column, mean_of=len(cells))
    if not cells:
        return result
    result.value = sum(c.value for c in cells) / len(cells)
    result.least, result.most = min(c.value for c in cells), max(c.value for c in cells)
    result.seeds = min((c.seeds for c in cells if c.seeds is not None), default=None)
    if all(c.low is not None and c.high is not None for c in cells):
        half = math.sqrt(sum(((c.high - c.low) / 2) ** 2 for c in cells)) / len(cells)
        result.low, result.high = result.value - half, result.value + half
    if assets:
        _over_scenes(result, [(parts[i], assets[i]) for i in filled], statistics.mean_over_scenes)
        if result.low is not None:
            result.low = max(result.low, 0.0)
            if all(c.is_share for c in cells):
                result.high = min(result.high, 1.0)
    return result


def _mean_of_pairs(parts):
    """The share of pairs, which are the sample."""
    return Cell(parts[0].table, parts[0].row, parts[0].column, *statistics.share([c.value for c in parts]), mean_of=len(parts))


def _mean_of_agreement(parts, assets):
    """The mean of correlations, which have no interval of their own."""
    result = Cell(parts[0].table, parts[0].row, parts[0].column, mean_of=len(parts))
    result.least, result.most = min(c.value for c in parts), max(c.value for c in parts)
    result.value, result.low, result.high, _ = statistics.mean_over_scenes(list(zip(assets, (c.value for c in parts))))
    return result


def mean(table, parts, assets):
    """The mean of the cells of one place of a table; `assets`: what each one's scene shows, see Results.asset()."""
    if table.of == "eye":
        return _mean_of_pairs(parts)
    if table.of == "agreement":
        return _mean_of_agreement(parts, assets)
    sampled = assets if table.over in SAMPLED else None
    return _arithmetic_mean(parts, sampled) if any(c.may_be_zero for c in parts) else _geometric_mean(parts, sampled)
