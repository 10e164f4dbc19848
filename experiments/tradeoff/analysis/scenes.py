"""What holds over the scenes: they are the sample, and shots of one scene are averaged first."""

import math

import numpy as np
from scipy import stats
from ssrlab.over_scenes import LEAST_SCENES, geometric_mean, scene_means, students


def p_of_zero(values):
    """Two-sided p of "the mean is 0", by the same t; None where there is no interval, or none of the values differ."""
    if len(values) < LEAST_SCENES or np.std(values) == 0:
        return None
    mean, error, degrees = students(values)
    return float(2 * stats.t.sf(abs(mean) / error, degrees))


def bootstrap_interval(values, seed=1):
    """(low, high) of the mean by BCa (Efron 1987); none below LEAST_SCENES values, or where all are the same."""
    values = np.asarray(values, float)
    if len(values) < LEAST_SCENES or values.std() == 0:
        return None, None
    found = stats.bootstrap((values,), np.mean, n_resamples=1999, method="BCa", random_state=np.random.default_rng(seed))
    return float(found.confidence_interval.low), float(found.confidence_interval.high)


def holm(p_values):
    """p-values adjusted together (Holm 1979), in the same order; None stays None."""
    order = sorted((i for i, p in enumerate(p_values) if p is not None), key=lambda i: p_values[i])
    adjusted, largest = [None] * len(p_values), 0.0
    for place, i in enumerate(order):
        largest = max(largest, min(1.0, p_values[i] * (len(order) - place)))
        adjusted[i] = largest
    return adjusted


def ranks(means_of):
    """Method to its place by its mean (1: the least); those that are equal share the lower place."""
    ordered = sorted(means_of.values())
    return {method: ordered.index(value) + 1 for method, value in means_of.items()}


def rank_stability(by_method):
    """`by_method`: method to {scene: ln ratio}, all of the same scenes. Method to (rank, lowest, highest rank when any one scene is
    left out)."""
    scenes = sorted({s for of_scene in by_method.values() for s in of_scene})
    full = ranks({m: np.mean(list(v.values())) for m, v in by_method.items()})
    seen = {m: [r] for m, r in full.items()}
    if len(scenes) > 1:
        for left_out in scenes:
            means = {m: np.mean([v[s] for s in scenes if s != left_out]) for m, v in by_method.items()}
            for m, r in ranks(means).items():
                seen[m].append(r)
    return {m: (full[m], min(r), max(r)) for m, r in seen.items()}


class Comparison:
    """Errors of methods in shots, compared over scenes. `table`: method to {shot: (error, low, high)}; `scene_of`: shot to scene;
    `base`: shot to the baseline's error, None where it is no measure; `certainly_less(a, b, shot)`: whether method a's error is.
    Ranked, over the shots that they have in common, are the methods that lack at most the share `lacking` of the shots."""

    def __init__(self, table, scene_of, base, certainly_less, lacking=0.0):
        self.table, self.scene_of, self.base, self.certainly_less = table, scene_of, base, certainly_less
        self.lacking = lacking
        self.shots = [s for s in scene_of if base[s]]
        self.logs = {
            m: {s: math.log(of_shot[s][0] / base[s]) for s in self.shots if s in of_shot and of_shot[s][0] > 0}
            for m, of_shot in table.items()
        }

    def rows(self):
        """A dictionary for each method, in the order of their ratios."""
        ranked = [m for m, logs in self.logs.items() if logs and len(logs) >= (1 - self.lacking) * len(self.shots)]
        common = [s for s in self.shots if all(s in self.logs[m] for m in ranked)]
        for method in ranked if common else []:
            self.logs[method] = {s: self.logs[method][s] for s in common}
        stability = rank_stability({m: self._scenes_of(m) for m in ranked}) if ranked and common else {}
        first = min(stability, key=lambda m: (stability[m][0], m), default=None)
        wins, shared = self._wins()
        rows = []
        for method, logs in self.logs.items():
            if not logs:
                continue
            ratio, low, high, scenes, shots = geometric_mean([(self.scene_of[s], v) for s, v in logs.items()])
            boot = bootstrap_interval(list(self._scenes_of(method).values()))
            row = {"method": method, "ratio": ratio, "low": low, "high": high, "scenes": scenes, "shots": shots}
            row |= {"bootstrap_low": _exp(boot[0]), "bootstrap_high": _exp(boot[1])}
            row |= {"wins": wins.get(method, 0), "shared": shared.get(method, 0)}
            row |= dict(zip(("rank", "rank_low", "rank_high"), stability.get(method, (None,) * 3)))
            row |= self._against(method, first)
            rows.append(row)
        for row, p in zip(rows, holm([r["p"] for r in rows])):
            row["p_holm"] = p
        return sorted(rows, key=lambda r: (r["rank"] is None, r["rank"] or 0, r["ratio"]))

    def _scenes_of(self, method):
        return scene_means([(self.scene_of[s], v) for s, v in self.logs[method].items()])

    def _against(self, method, first):
        row = dict.fromkeys(("against_best", "against_best_low", "against_best_high", "p"))
        if first is None or method == first:
            return row
        common = [(self.scene_of[s], v - self.logs[first][s]) for s, v in self.logs[method].items() if s in self.logs[first]]
        if common:
            row["against_best"], row["against_best_low"], row["against_best_high"], _, _ = geometric_mean(common)
            row["p"] = p_of_zero(list(scene_means(common).values()))
        return row

    def _wins(self):
        """(method to shots in which its error is certainly the least, method to shots in which it cannot be told from it)"""
        wins, shared = {}, {}
        for shot in self.scene_of:
            here = {m: v[shot][0] for m, v in self.table.items() if shot in v}
            if not here:
                continue
            first = min(here, key=here.get)
            near = [m for m in here if m != first and not self.certainly_less(first, m, shot)]
            if not near:
                wins[first] = wins.get(first, 0) + 1
            for m in [first, *near] if near else []:
                shared[m] = shared.get(m, 0) + 1
        return wins, shared


def _exp(value):
    return None if value is None else math.exp(value)
