"""A technique's own front in one shot: the error that a cost buys, and the cost that an error asks for. Between measured points
both are interpolated, logarithmic on both axes. Beyond the first and the last nothing was measured: what is said there is an upper bound."""

import math

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


def error_at(costs, errors, cost, keeps_all=False):
    """Error at `cost` of each draw (points x draws): NaN where the front begins later; its last error past its end.
    `keeps_all`: all points are taken for the front, in the order of their costs, whatever their errors were drawn to be."""
    costs, errors, mask = sorted_front(costs, errors)
    mask |= keeps_all
    left, right, has_left, has_right = _neighbours(mask & (costs <= cost), mask & (costs > cost))
    column = np.arange(costs.shape[1])
    found = np.where(has_left, errors[left, column], np.nan)
    both = has_left & has_right
    between = _log_interpolated(cost, costs[left, column], costs[right, column], errors[left, column], errors[right, column])
    return np.where(both, between, found)


def cost_to(costs, errors, error, keeps_all=False):
    """Cost from which on the error is at most `error`, of each draw: NaN where it is not reached; the first cost of the
    front where that errs less already. `keeps_all`: as of error_at(); it is reached for good at the cost."""
    costs, errors, mask = sorted_front(costs, errors)
    mask |= keeps_all
    more = mask & (errors > error)
    after_more = ~np.logical_or.accumulate(more[::-1], axis=0)[::-1]
    left, right, has_left, has_right = _neighbours(more, mask & after_more)
    column = np.arange(costs.shape[1])
    found = np.where(has_right, costs[right, column], np.nan)
    both = has_left & has_right
    between = _log_interpolated(error, errors[left, column], errors[right, column], costs[left, column], costs[right, column])
    return np.where(both, between, found)


def is_less_from_the_start(costs, errors, error):
    """Of each draw: whether the cheapest point errs at most `error`. What less cost would do was not measured."""
    return sorted_front(costs, errors)[1][0] <= error


def column_of(values):
    return np.array(values, float)[:, None]


class Curve:
    """One variant's points in one shot, with draws of them (uncertainty.ShotDraws).

    The front is chosen for its small errors, which chance made smaller: where few of several points that hardly differ are
    on it, its numbers are too good. Lower ends are of draws that choose their fronts anew, which repeats that; upper ends of whichever is more
    of these and of draws of the measured front's points, at 2.5 % shared among the points whose place on the front is in doubt and the one that they would leave."""

    def __init__(self, points, draws, rows):
        self.points = points
        self.costs, self.errors = column_of([p.cost for p in points]), column_of([p.error for p in points])
        self.cost_draws, self.error_draws = draws.costs[rows], draws.errors[rows]
        order = np.lexsort((self.errors[:, 0], self.costs[:, 0]))
        self.front = order[front_mask(self.costs[order], self.errors[order])[:, 0]]
        self.start, self.end = float(self.costs[self.front[0], 0]), float(self.costs[self.front[-1], 0])
        self.start_error = float(self.errors[self.front[0], 0])
        self.upper = 1 - 0.025 / (self._in_doubt() + 1)

    def _in_doubt(self):
        order = np.lexsort((self.error_draws, self.cost_draws), axis=0)
        mask = front_mask(np.take_along_axis(self.cost_draws, order, 0), np.take_along_axis(self.error_draws, order, 0))
        share = np.bincount(order.ravel(), mask.ravel(), len(order)) / mask.shape[1]
        return int(((share > 0.025) & (share < 0.975)).sum())

    def _read(self, function, asked):
        """(value, low, high, share of the draws that have a value)"""
        value = float(function(self.costs, self.errors, asked)[0])
        anew = function(self.cost_draws, self.error_draws, asked)
        if math.isnan(value) or np.isnan(anew).all():
            return value, None, None, float(np.mean(~np.isnan(anew)))
        fixed = function(self.cost_draws[self.front], self.error_draws[self.front], asked, keeps_all=True)
        low = np.quantile(anew[~np.isnan(anew)], 0.025)
        high = np.quantile(np.fmax(anew, fixed)[~np.isnan(anew)], self.upper)
        return value, float(low), float(high), float(np.mean(~np.isnan(anew)))

    def error_at(self, cost):
        """(error, low, high, share of the draws that have one). Past the end no low end: a dearer point would perhaps err less."""
        value, low, high, share = self._read(error_at, cost)
        return value, low if cost <= self.end else None, high, share

    def cost_to(self, error):
        """(cost, low, high, share of the draws that reach the error). No low end where 2.5 % of the draws err less from the start on: a
        cheaper point would perhaps do. No high end where more than 2.5 % do not reach the error."""
        value, low, high, share = self._read(cost_to, error)
        is_bound = error >= self.start_error or np.mean(is_less_from_the_start(self.cost_draws, self.error_draws, error)) >= 0.025
        return value, None if is_bound else low, high if share >= 0.975 else None, share


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
