"""error = floor + a cost^-b along what buys quality: points of a variant that differ in one number alone."""

import math
from dataclasses import dataclass

import numpy as np
from scipy import stats

from ssrlab.tradeoff.uncertainty import NORMAL

LEAST_POINTS = 4
EXPONENTS = np.geomspace(0.05, 16, 321)


@dataclass
class Axis:
    variant: str
    parameter: str
    fixed: str  # what else the points have in common that a sweep or a preset gave them
    points: list


@dataclass
class Fit:
    status: str
    floor: float = None
    floor_low: float = None
    floor_high: float = None
    a: float = None
    b: float = None
    b_low: float = None
    b_high: float = None
    misfit: float = None


def _as_number(value):
    if isinstance(value, bool):
        return None
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def axes_of(points, parameters):
    """All axes among points of one shot; `parameters`: key to {name: value} of all parameters of a point. Points that
    another axis of the same variant has, too, may be in both."""
    groups = {}
    for p in points:
        own = parameters.get(p.key, {})
        for name, value in own.items():
            if _as_number(value) is not None:
                rest = tuple(sorted((n, repr(v)) for n, v in own.items() if n != name))
                groups.setdefault((p.variant, name, rest), {}).setdefault(_as_number(value), p)
    axes = []
    for (variant, name, _), of_value in groups.items():
        if len(of_value) >= LEAST_POINTS:
            members = [of_value[v] for v in sorted(of_value)]
            axes.append(Axis(variant, name, _fixed(members, name), members))
    return axes


def _fixed(points, name):
    """What the labels of the axis' points share: `best` of `best rays=2` and `best rays=4`."""
    words = [[w for w in p.point.split() if not w.startswith(name + "=")] for p in points if name + "=" in p.point]
    return " ".join(w for w in (words[0] if words else []) if all(w in other for other in words))


def _log_deviation(value, low, high):
    low = low if low > 0 else value * value / high  # as far below as above
    return max(math.log(high / low) / (2 * NORMAL), 1e-6)


def _best_linear(powers, errors, weights):
    """For each row of `powers` (cost^-b) the floor >= 0 and a >= 0 of least weighted squares, and these."""
    w, x, y = weights, powers, errors
    sw, sx, sy = w.sum(), (w * x).sum(1), (w * y).sum()
    sxx, sxy = (w * x * x).sum(1), (w * x * y).sum(1)
    determinant = sw * sxx - sx * sx
    with np.errstate(divide="ignore", invalid="ignore"):
        a = np.where(determinant > 0, (sw * sxy - sx * sy) / determinant, 0.0)
    floor = (sy - a * sx) / sw
    a_alone = sxy / sxx
    a, floor = np.where(floor < 0, a_alone, a), np.maximum(floor, 0.0)
    a, floor = np.where(a < 0, 0.0, a), np.where(a < 0, sy / sw, floor)
    return floor, a, (w * (y - floor[:, None] - a[:, None] * x) ** 2).sum(1)


def _accepted(values, squares, limit):
    """(low, high) of the values whose squares are within the limit."""
    inside = values[squares <= limit]
    return float(inside.min()), float(inside.max())


def fit_law(costs, errors, log_error_deviations, log_cost_deviations):
    """Fits the law to points of one axis, with 95 % intervals by profile: the values whose weighted squares are within
    s^2 q of the least, where s^2 is the larger of 1 and chi^2 per degree of freedom, and q the normal's quantile squared or, where
    s^2 is estimated by the misfit, Student's. A cost's uncertainty counts as the error that it moves along the curve."""
    costs, errors = np.asarray(costs, float), np.asarray(errors, float)
    scale = math.exp(np.log(costs).mean())
    powers = (costs[None, :] / scale) ** -EXPONENTS[:, None]
    deviations = np.asarray(log_error_deviations, float)
    for _ in range(4):
        weights = 1 / (deviations * errors) ** 2
        floor, a, squares = _best_linear(powers, errors, weights)
        best = int(np.argmin(squares))
        law = floor[best] + a[best] * powers[best]
        slope = EXPONENTS[best] * a[best] * powers[best] / law
        deviations = np.hypot(log_error_deviations, slope * np.asarray(log_cost_deviations))
    degrees = len(costs) - 3
    least = float(squares[best])
    spread = max(1.0, least / degrees)
    quantile = NORMAL**2 if spread == 1 else stats.t.ppf(0.975, degrees) ** 2
    limit = least + spread * quantile
    fit = Fit("fitted", float(floor[best]), None, None, float(a[best] * scale ** EXPONENTS[best]), float(EXPONENTS[best]))
    fit.misfit = math.sqrt(least / degrees)
    constant = float((weights * (errors - (weights * errors).sum() / weights.sum()) ** 2).sum())
    if constant <= limit or a[best] <= 0:
        return Fit("the error does not surely fall with the cost", misfit=fit.misfit)
    fit.b_low, fit.b_high = _accepted(EXPONENTS, squares, limit)
    floors = np.linspace(0, min(errors.max(), 3 * errors.min()), 801)
    residuals = errors[None, :] - floors[:, None]
    profile = np.full(len(floors), np.inf)
    for x in powers:
        amount = np.maximum((weights * x * residuals).sum(1) / (weights * x * x).sum(), 0.0)
        profile = np.minimum(profile, (weights * (residuals - amount[:, None] * x) ** 2).sum(1))
    step = floors[1]
    low, high = _accepted(floors, profile, max(limit, float(profile.min())))
    fit.floor_low, fit.floor_high = max(low - float(step), 0.0), high + float(step)
    if fit.b_high >= EXPONENTS[-1]:
        fit.status, fit.b_high, fit.a, fit.b = "exponent has no upper end: the error falls in one step", None, None, None
    elif fit.b_low <= EXPONENTS[0]:
        fit.status, fit.b_low, fit.a, fit.b = "exponent not distinguishable from 0", None, None, None
    return fit


def fit_axis(axis, floor_of_costs):
    """Fits the law to an axis, or says why not. `floor_of_costs`: the relative difference that copies of one point may have."""
    points = [p for p in axis.points if p.is_judged()]
    if len(points) < LEAST_POINTS:
        return points, Fit(f"only {len(points)} of its points are judged")
    costs = [p.cost for p in points]
    if max(costs) <= (1 + floor_of_costs) ** 2 * min(costs):
        return points, Fit("its costs hardly differ, for what copies of one point do")
    errors = [_log_deviation(p.error, p.error_low, p.error_high) for p in points]
    of_costs = [_log_deviation(p.cost, p.cost_low, p.cost_high) for p in points]
    return points, fit_law(costs, [p.error for p in points], errors, of_costs)
