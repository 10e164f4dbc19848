"""The rows of the CSV files (README.md), from the analyses."""

import csv
import math
import os
import zlib

from analysis import curves, dominance, fits, scenes, stages, uncertainty
from ssrlab import over_scenes

LACKING = 0.1  # of the shots: so many may a point lack an error above 0 in, and be ranked
RUNGS = ("on_screen", "camera_radiance")  # the first that the study has


def write(folder, name, columns, rows):
    with open(os.path.join(folder, name), "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(["" if r.get(c) is None else _text(r[c]) for c in columns] for r in rows)


def _text(value):
    if isinstance(value, bool):
        return int(value)
    return f"{value:.9g}" if isinstance(value, float) else value


class Analysis:
    """All that is told of a study, as lists of rows: dictionaries with the columns of README.md."""

    def __init__(self, study, baseline, costs, factors):
        self.study, self.baseline, self.costs, self.factors = study, baseline, costs, factors
        # The same deviates whenever a shot is asked about; other ones in each shot.
        self.curves = {
            s.name: curves.curves_of(s, lambda points, s=s: uncertainty.ShotDraws(points, seed=zlib.crc32(s.name.encode())))
            for s in study.shots
        }
        self.verdicts = {s.name: dominance.judge(s) for s in study.shots}
        self.front = [row for s in study.shots for row in self._front_rows(s)]
        self.error_at_cost = [row for s in study.shots for row in self._error_at_cost_rows(s)]
        self.cost_to_error = [row for s in study.shots for row in self._cost_to_error_rows(s)]
        self.fits = [row for s in study.shots for row in self._fit_rows(s)]
        self.limits = [row for s in study.shots for row in self._limit_rows(s)]
        self.across = [*self._whole_rows(), *(row for m in self.machines() for c in costs for row in self._across_rows(m, c))]
        self.changes = stages.shot_changes(study)
        self.stages = [self._stage_row(c) for c in [*self.changes, *stages.pooled(self.changes)]]

    def machines(self):
        """Those that timed something; what they timed is never compared with what another did."""
        return list(dict.fromkeys(s.machine for s in self.study.shots if self.curves[s.name]))

    def label(self, variant):
        """A curve's name: its variant's."""
        return variant

    def _shot_columns(self, shot):
        return {"shot": shot.name, "scene": shot.scene, "machine": shot.machine, "unit": self.study.unit}

    def _front_rows(self, shot):
        verdicts, nominal = self.verdicts[shot.name], dominance.nominal_front(shot.judged())
        for p in shot.points:
            row = self._shot_columns(shot) | {"variant": p.variant, "point": p.point, "label": p.label}
            row |= {"error": p.error, "error_low": p.error_low, "error_high": p.error_high, "cost": p.cost}
            row |= {"cost_low": p.cost_low, "cost_high": p.cost_high}
            verdict, by, rivals = verdicts.get(p.key, (p.why_not_judged(), [], []))
            row |= {"is_nominal_front": p.key in nominal, "verdict": verdict}
            row |= {"dominated_by": "; ".join(q.label for q in by), "undecided_with": "; ".join(q.label for q in rivals)}
            yield row

    def _curve_columns(self, shot, variant, curve):
        return self._shot_columns(shot) | {"variant": variant, "label": self.label(variant), "start": curve.start, "end": curve.end}

    def _error_at_cost_rows(self, shot):
        for variant, curve in self.curves[shot.name].items():
            for cost in self.costs:
                row = self._curve_columns(shot, variant, curve) | {"cost": cost}
                error, low, high, _ = curve.error_at(cost)
                chosen, row["chosen_on"] = self._chosen(shot, curve, cost)
                row["status"] = _place(cost, curve) if chosen else "before start"
                row["fits"] = _fits(chosen or min(curve.points, key=lambda p: p.cost), cost)
                if chosen:
                    row |= {"error": error, "low": low, "high": high, "point": chosen.point}
                    row |= {"point_error": chosen.error, "point_low": chosen.error_low, "point_high": chosen.error_high}
                yield row

    def _chosen(self, shot, curve, cost):
        """(the point that somebody would take for the shot who knows what everything costs there and errs elsewhere, where that was
        told): of those whose median fits, the one of least error in the other scenes (geometric mean over scenes of the ratio to the
        baseline, over the shots that all have an error in). Where there is no other scene, the one of least error in the shot itself,
        which is flattered by the choice."""
        fitting = [p for p in curve.points if p.cost <= cost]
        if not fitting:
            return None, None
        judged = {s.name: {p.key: p for p in s.points if p.is_ranked and p.error > 0} for s in self.study.shots}
        others = [s for s in self.study.shots if s.asset != shot.asset and s.divisor(self.baseline)]
        common = [s for s in others if all(p.key in judged[s.name] for p in fitting)]
        if not common:
            return min(fitting, key=lambda p: p.error), "this shot"

        def mean(p):
            logs = [(s.asset, math.log(judged[s.name][p.key].error / s.divisor(self.baseline))) for s in common]
            means = over_scenes.scene_means(logs)
            return sum(means.values()) / len(means)

        return min(fitting, key=mean), "other scenes"

    def _cost_to_error_rows(self, shot):
        base = shot.divisor(self.baseline)
        if base is None:
            return
        for variant, curve in self.curves[shot.name].items():
            for factor in self.factors:
                error = factor * base
                cost, low, high, share = curve.cost_to(error)
                row = self._curve_columns(shot, variant, curve) | {"factor": factor, "error": error}
                row["share_that_reach"] = share
                if cost != cost:
                    row["status"] = "not reached"
                else:
                    row["status"] = "before start" if cost <= curve.start else "at" if cost == curve.end else "between"
                    row |= {"cost": cost, "low": low, "high": high}
                yield row

    def _limit_rows(self, shot):
        """The least error of all points beside each rung of the truth ladder."""
        ranked = [p for p in shot.points if p.is_ranked and p.error_low is not None and not p.asks_scene]
        for rung in (r for r in RUNGS if r in shot.ladder and ranked):
            p = min(ranked, key=lambda p: p.error)
            row = self._shot_columns(shot) | {"variant": p.variant, "point": p.point, "label": p.label, "cost": p.cost}
            row |= {"error": p.error, "error_low": p.error_low, "error_high": p.error_high}
            yield row | _rung_columns(rung, shot.ladder[rung], (p.error, p.error_low, p.error_high), "over_rung")

    def _fit_rows(self, shot):
        rung = next((r for r in RUNGS if r in shot.ladder), None)
        for axis in fits.axes_of(shot.points, {p.key: self.study.parameters_of(p.key) for p in shot.points}):
            points, fit = fits.fit_axis(axis, shot.floor)
            row = self._shot_columns(shot) | {"variant": axis.variant, "label": self.label(axis.variant)}
            row |= {"parameter": axis.parameter, "fixed": axis.fixed, "points": len(points), **vars(fit)}
            row["point_names"] = "; ".join(p.point for p in points)
            if points:
                row |= {"cost_from": min(p.cost for p in points), "cost_to": max(p.cost for p in points)}
            if rung:
                row |= _rung_columns(rung, shot.ladder[rung], (fit.floor, fit.floor_low, fit.floor_high), "floor_over_rung")
            yield row

    def _comparison(self, table, shots, certainly_less, lacking=0.0):
        base = {s.name: s.divisor(self.baseline) for s in shots}
        return scenes.Comparison(table, {s.name: s.asset for s in shots}, base, certainly_less, lacking).rows()

    def _whole_rows(self):
        """Points at whatever they cost, over all shots."""
        table, shots = {}, {s.name: s for s in self.study.shots}
        for s in self.study.shots:
            for p in s.points:
                if p.is_ranked and p.error_low is not None and not p.asks_scene:
                    table.setdefault(p.key, {})[s.name] = (p.error, p.error_low, p.error_high)

        def certainly_less(a, b, shot):
            s = shots[shot]
            return s.errs_less(a, b)

        for row in self._comparison(table, self.study.shots, certainly_less, LACKING):
            variant, point = row.pop("method")
            yield self._named(row) | {"variant": variant, "point": point, "label": self.study.label_of((variant, point))}

    def _across_rows(self, machine, cost):
        """Variants at a cost, over the shots of one machine: each by the point that _chosen() takes in each shot, as it ran there."""
        shots = [s for s in self.study.shots if s.machine == machine and self.curves[s.name]]
        names, table, chosen = {s.name for s in shots}, {}, {}
        for row in self.error_at_cost:
            if row["shot"] in names and row["cost"] == cost and row.get("error") and row["fits"] != "no":
                table.setdefault(row["variant"], {})[row["shot"]] = (row["point_error"], row["point_low"], row["point_high"])
                chosen[row["variant"], row["shot"]] = (row["variant"], row["point"])
        of_name = {s.name: s for s in shots}

        def certainly_less(a, b, shot):
            s = of_name[shot]
            return s.errs_less(chosen[a, shot], chosen[b, shot])

        fitting = {}
        for row in self.error_at_cost:
            if row["shot"] in names and row["cost"] == cost and row["fits"] == "surely":
                fitting.setdefault(row["variant"], set()).add(of_name[row["shot"]].asset)
        for row in self._comparison(table, shots, certainly_less):
            variant = row.pop("method")
            named = self._named(row) | {"variant": variant, "label": self.label(variant), "machine": machine, "cost": cost}
            yield named | {"scenes_that_fit": len(fitting.get(variant, ())), "of_scenes": len({s.asset for s in shots})}

    def _named(self, row):
        return row | {"baseline": self.study.label_of(self.baseline), "unit": self.study.unit}

    def _stage_row(self, c):
        row = {"shot": c.shot, "scenes": c.scenes, "machine": c.machine, "unit": self.study.unit, "change": c.text}
        row |= {"variant": c.b[0], "point": c.b[1], "label": self.study.label_of(c.b)}
        row |= {"against_variant": c.a[0], "against_point": c.a[1], "verdict": c.verdict()}
        for name, values in (("error", c.error), ("cost", c.costs), ("cost_per_percent", c.worth)):
            row |= dict(zip((name + ("_ratio" if name == "error" else ""), name + "_low", name + "_high"), values))
        return row


def _rung_columns(rung, error, measured, name):
    """A rung's own columns, and `measured` over it by the ends of both: no upper end where the rung cannot be told from 0."""
    value, low, high = error
    columns = {"rung": rung, "rung_error": value, "rung_low": low, "rung_high": high}
    if measured[0] is not None and value > 0:
        upper = measured[2] / low if low and low > 0 else None
        columns |= {name: measured[0] / value, name + "_low": measured[1] / (high or value), name + "_high": upper}
    return columns


def _fits(point, cost):
    """As time_summary.csv has it."""
    return "surely" if point.fits_from <= cost else "maybe" if point.may_fit_from <= cost else "no"


def _place(cost, curve):
    if any(p.cost == cost for p in curve.points):
        return "at"
    return "past end" if cost > curve.end else "between"
