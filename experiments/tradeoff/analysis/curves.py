"""A technique's own front in one shot: the error that a cost buys, and the cost that an error asks for. Between measured points
both are interpolated, logarithmic on both axes; beyond the first and the last nothing is said of what was not measured."""

import numpy as np


def front_mask(costs, errors):
    """Of points x draws, sorted by cost along axis 0: those with less error than all that cost less."""
    before = np.minimum.accumulate(errors, axis=0)
    mask = np.ones(errors.shape, bool)
    mask[1:] = errors[1:] < before[:-1]
    return mask


def sorted_front(costs, errors):
    """(costs, errors, mask), points x draws in the order of cost, of errors where they cost the same."""
    order = np.lexsort((errors, costs), axis=0)
    costs, errors = np.take_along_axis(costs, order, 0), np.take_along_axis(errors, order, 0)
    return costs, errors, front_mask(costs, errors)


def _neighbours(is_left, is_right):
    """Index of the last True of is_left and of the first of is_right along axis 0, and whether there are any."""
    n = is_left.shape[0]
    return n - 1 - np.argmax(is_left[::-1], axis=0), np.argmax(is_right, axis=0), is_left.any(axis=0), is_right.any(axis=0)


def _log_interpolated(x, x0, x1, y0, y1):
    with np.errstate(all="ignore"):  # draws without two neighbours are not used
        share = np.log(x / x0) / np.log(x1 / x0)
        return np.exp((1 - share) * np.log(y0) + share * np.log(y1))


def error_at(costs, errors, cost):
    """Error at `cost` of each draw (points x draws): NaN where the front begins later; its last error past its end."""
    costs, errors, mask = sorted_front(costs, errors)
    left, right, has_left, has_right = _neighbours(mask & (costs <= cost), mask & (costs > cost))
    column = np.arange(costs.shape[1])
    found = np.where(has_left, errors[left, column], np.nan)
    both = has_left & has_right
    between = _log_interpolated(cost, costs[left, column], costs[right, column], errors[left, column], errors[right, column])
    return np.where(both, between, found)


def cost_to(costs, errors, error):
    """Cost from which on the error is at most `error`, of each draw: NaN where it is not reached; the first cost of the
    front where that errs less already."""
    costs, errors, mask = sorted_front(costs, errors)
    left, right, has_left, has_right = _neighbours(mask & (errors > error), mask & (errors <= error))
    column = np.arange(costs.shape[1])
    found = np.where(has_right, costs[right, column], np.nan)
    both = has_left & has_right
    between = _log_interpolated(error, errors[left, column], errors[right, column], costs[left, column], costs[right, column])
    return np.where(both, between, found)


def column_of(values):
    return np.array(values, float)[:, None]


class Curve:
    """One variant's points in one shot, with draws of them (uncertainty.ShotDraws)."""

    def __init__(self, points, draws, rows):
        self.points = points
        self.costs, self.errors = column_of([p.cost for p in points]), column_of([p.error for p in points])
        self.cost_draws, self.error_draws = draws.costs[rows], draws.errors[rows]
        costs, _, mask = sorted_front(self.costs, self.errors)
        self.start, self.end = float(costs[mask][0]), float(costs[mask][-1])

    def error_at(self, cost):
        """(error or NaN, draws of it)"""
        return float(error_at(self.costs, self.errors, cost)[0]), error_at(self.cost_draws, self.error_draws, cost)

    def cost_to(self, error):
        return float(cost_to(self.costs, self.errors, error)[0]), cost_to(self.cost_draws, self.error_draws, error)

    def best_within(self, cost):
        """The measured point of least error whose median cost is at most `cost`; None without one."""
        return min((p for p in self.points if p.cost <= cost), key=lambda p: p.error, default=None)


def curves_of(shot, draws_of):
    """Variant to Curve, of the shot's judged points; `draws_of`: makes draws of a list of points."""
    points = shot.judged()
    if not points:
        return {}
    draws = draws_of(points)
    rows = {}
    for i, p in enumerate(points):
        rows.setdefault(p.variant, []).append(i)
    return {v: Curve([points[i] for i in indices], draws, indices) for v, indices in rows.items()}
