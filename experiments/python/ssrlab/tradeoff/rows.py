"""The rows of the CSV files (README.md) that are made from curves between points and from fits."""

import zlib

from ssrlab.tradeoff import curves, fits, uncertainty
from ssrlab.csv_files import write_lines
from ssrlab.text_files import path_inside, whole_file

RUNGS = ("on_screen", "camera_radiance")  # the first that the study has


def write(folder, name, columns, rows):
    with whole_file(path_inside(folder, name)) as temporary, open(temporary, "w", newline="", encoding="utf-8") as stream:
        write_lines(stream, [columns, *([_text(r.get(c)) for c in columns] for r in rows)])


def _text(value):
    return f"{value:.9g}" if isinstance(value, float) else value


class Analysis:
    """All that is said of a study, as lists of rows: dictionaries with the columns of README.md."""

    def __init__(self, study, factors):
        self.study, self.costs, self.factors = study, study.asked["times"], factors
        # The same deviates whenever a shot is asked about; other ones in each shot.
        self.curves = {
            s.name: curves.curves_of(s, lambda points, s=s: uncertainty.ShotDraws(points, seed=zlib.crc32(s.name.encode())))
            for s in study.shots
        }
        self.error_at_cost = [row for s in study.shots for row in self._error_at_cost_rows(s)]
        self.cost_to_error = [row for s in study.shots for row in self._cost_to_error_rows(s)]
        self.fits = [row for s in study.shots for row in self._fit_rows(s)]
        self.limits = [row for s in study.shots for row in self._limit_rows(s)]

    def machines(self):
        """Those with points at a cost: that timed something, or whose points are frozen. What one timed is never compared with what
        another did."""
        return list(dict.fromkeys(r["machine"] for r in self.study.across if r["cost"] is not None))

    def _shot_columns(self, shot):
        return {"shot": shot.name, "scene": shot.scene, "machine": shot.machine, "unit": self.study.unit}

    def _curve_columns(self, shot, variant, curve):
        return self._shot_columns(shot) | {"variant": variant, "label": variant, "start": curve.start, "end": curve.end}

    def _error_at_cost_rows(self, shot):
        """On the variant's curve, and beside it the point that ran which ssrlab chose (ChosenPoint, experiments/results/tradeoff/tradeoff.h)."""
        for variant, curve in self.curves[shot.name].items():
            for cost in self.costs:
                chosen = self.study.chosen[shot.name, variant, cost]
                row = self._curve_columns(shot, variant, curve) | {"cost": float(cost), "fits": chosen["fits"], "status": "before start"}
                if chosen["point"]:
                    error, low, high, _ = curve.error_at(cost)
                    p = next(p for p in shot.points if (p.variant, p.point) == (variant, chosen["point"]))
                    row |= {"status": _place(cost, curve), "error": error, "low": low, "high": high, "chosen_on": chosen["chosen_on"]}
                    row |= {"point": p.point, "point_error": p.error, "point_low": p.error_low, "point_high": p.error_high}
                yield row

    def _cost_to_error_rows(self, shot):
        if shot.divisor is None:
            return
        for variant, curve in self.curves[shot.name].items():
            for factor in self.factors:
                error = factor * shot.divisor
                cost, low, high, share = curve.cost_to(error)
                row = self._curve_columns(shot, variant, curve) | {"factor": factor, "error": error}
                row["share_that_reach"] = share
                if cost != cost:
                    row["status"] = "not reached"
                else:
                    row["status"] = "before start" if error >= curve.start_error else "at" if cost == curve.end else "between"
                    row |= {"cost": cost, "low": low, "high": high}
                yield row

    def _limit_rows(self, shot):
        """The least error of all points beside each rung of the truth ladder."""
        ranked = [p for p in shot.points if p.is_ranked()]
        for rung in (r for r in RUNGS if r in shot.ladder and ranked):
            p = min(ranked, key=lambda p: p.error)
            row = self._shot_columns(shot) | {"variant": p.variant, "point": p.point, "label": p.label, "cost": p.cost}
            row |= {"error": p.error, "error_low": p.error_low, "error_high": p.error_high}
            yield row | _rung_columns(rung, shot.ladder[rung], (p.error, p.error_low, p.error_high), "over_rung")

    def _fit_rows(self, shot):
        rung = next((r for r in RUNGS if r in shot.ladder), None)
        for axis in fits.axes_of(shot.points, {p.key: self.study.parameters_of(p.key) for p in shot.points}):
            points, fit = fits.fit_axis(axis, shot.floor)
            row = self._shot_columns(shot) | {"variant": axis.variant, "label": axis.variant}
            row |= {"parameter": axis.parameter, "fixed": axis.fixed, "points": len(points), **vars(fit)}
            row["point_names"] = "; ".join(p.point for p in points)
            if points:
                row |= {"cost_from": min(p.cost for p in points), "cost_to": max(p.cost for p in points)}
            if rung:
                row |= _rung_columns(rung, shot.ladder[rung], (fit.floor, fit.floor_low, fit.floor_high), "floor_over_rung")
            yield row


def _rung_columns(rung, error, measured, name):
    """A rung's own columns, and `measured` over it by the ends of both: no upper end where the rung is not distinguishable from 0."""
    value, low, high = error
    columns = {"rung": rung, "rung_error": value, "rung_low": low, "rung_high": high}
    if measured[0] is not None and value > 0:
        upper = measured[2] / low if low and low > 0 else None
        columns |= {name: measured[0] / value, name + "_low": measured[1] / (high or value), name + "_high": upper}
    return columns


def _place(cost, curve):
    if any(p.cost == cost for p in curve.points):
        return "at"
    return "past end" if cost > curve.end else "between"
