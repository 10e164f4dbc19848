"""What a change of one parameter costs and what it buys: of a stage that it switches off, what the stage is worth."""

import math
from dataclasses import dataclass

import numpy as np
from scipy import stats

from analysis import scenes
from ssrlab import over_scenes
from analysis.uncertainty import NORMAL, interval

DRAWS = 4000


@dataclass
class Change:
    """Point b in place of a, which differ in `text` alone, in one shot or, with an empty shot, over scenes."""

    shot: str
    asset: str
    machine: str
    a: tuple
    b: tuple
    text: str
    error: tuple  # (ratio b / a, low, high)
    costs: tuple  # (difference b - a, low, high)
    is_cost_told: bool  # beyond what copies of one point differ by
    scenes: int = 1
    worth: tuple = (None, None, None)  # cost for each percent, of the dearer

    def verdict(self):
        told = self.error[1] is not None and self.error[2] is not None and (self.error[2] < 1 or self.error[1] > 1)
        errs_less = self.error[0] < 1
        is_dearer = self.costs[0] > 0
        if not self.is_cost_told:
            return ("less error, no cost told" if errs_less else "more error, no cost told") if told else "nothing told"
        if not told:
            return "dearer, no error told" if is_dearer else "cheaper, no error told"
        if errs_less == is_dearer:
            return "buys error" if is_dearer else "saves cost"
        return "better in both" if errs_less else "worse in both"


def change_between(first, second):
    """`rays: 1 -> 4` of the parameters in which two points differ; empty where that is not one."""
    names = [n for n in {**first, **second} if first.get(n) != second.get(n)]
    return f"{names[0]}: {_shown(first.get(names[0]))} -> {_shown(second.get(names[0]))}" if len(names) == 1 else ""


def _shown(value):
    return str(value).lower() if isinstance(value, bool) else str(value)


def _worth(error_draws, cost_draws):
    """Cost for each percent by which the cheaper errs more, of draws of ln(error of b / of a) and of the cost of b - of a."""
    with np.errstate(divide="ignore", invalid="ignore"):
        percent = 100 * np.expm1(np.abs(error_draws))
        return np.abs(cost_draws) / percent


def _shot_change(study, shot, a, b, text):
    error = shot.error_effects[b.key, a.key]
    exact = b.cost / a.cost  # of counted costs, which have no effects
    ratio, low, high, is_told = shot.cost_effects.get((b.key, a.key), (exact, exact, exact, exact != 1))
    costs = tuple((v - 1) * a.cost for v in (ratio, low, high))
    change = Change(shot.name, shot.asset, shot.machine, a.key, b.key, text, error, costs, is_told)
    if change.verdict() in ("buys error", "saves cost"):
        generator = np.random.default_rng(1)
        errors = _normal(generator, *(math.log(v) for v in error))
        drawn = _worth(errors, _normal(generator, *costs))
        change.worth = (float(_worth(np.array([math.log(error[0])]), np.array([costs[0]]))[0]), *interval(drawn))
    return change


def _normal(generator, value, low, high):
    """Draws with these ends of 95 %, above and below alike where they differ."""
    z = generator.standard_normal(DRAWS)
    return value + z * np.where(z > 0, high - value, value - low) / NORMAL


def shot_changes(study):
    """All changes of one parameter that the study compared and timed."""
    found = []
    for shot in study.shots:
        for b_key, a_key in shot.error_effects:
            a, b = shot.point_of(a_key), shot.point_of(b_key)
            if a is None or b is None or a_key[0] != b_key[0] or not a.cost or not b.cost:
                continue
            if not shot.error_effects[b_key, a_key][1] > 0:
                continue
            text = change_between(study.parameters_of(a_key), study.parameters_of(b_key))
            if text:
                found.append(_shot_change(study, shot, a, b, text))
    return found


def pooled(changes):
    """Each change over all scenes in which it was measured by one machine: geometric mean of the errors' ratios, mean of the costs."""
    groups = {}
    for c in changes:
        groups.setdefault((c.machine, c.a, c.b, c.text), []).append(c)
    found = []
    for (machine, a, b, text), members in groups.items():
        error = over_scenes.geometric_mean([(c.asset, math.log(c.error[0])) for c in members])
        costs = list(over_scenes.scene_means([(c.asset, c.costs[0]) for c in members]).values())
        cost = over_scenes.mean_interval(costs)
        is_told = cost[1] is not None and (cost[1] > 0 or cost[2] < 0)
        change = Change("", "", machine, a, b, text, error[:3], cost, is_told, error[3])
        if change.verdict() in ("buys error", "saves cost"):
            generator = np.random.default_rng(1)
            degrees = len(costs) - 2  # as over_scenes.mean_interval has them
            drawn = []
            for value, low in ((math.log(error[0]), math.log(error[1])), cost[:2]):
                drawn.append(value + (value - low) / stats.t.ppf(0.975, degrees) * generator.standard_t(degrees, DRAWS))
            point = _worth(np.array([math.log(error[0])]), np.array([cost[0]]))
            change.worth = (float(point[0]), *interval(_worth(*drawn)))
        found.append(change)
    return found
