"""The error at a cost along a parameter that buys quality, as `ssrlab tradeoff` found it: points with both intervals, the fitted law floor
+ a cost^-b, its floor, and the rung of the truth ladder that limits techniques of one frame."""

from dataclasses import dataclass

import numpy

from ssrlab.figures import numbers, style, sweeps, tradeoff
from ssrlab.figures.error_time import TIME_AXIS, draw_mark
from ssrlab.figures.ladder import LOOKS, RUNGS, rungs_of
from ssrlab.figures.placed_labels import place_labels
from ssrlab.csv_files import needed_number
from ssrlab.mistakes import ResultsError
from ssrlab.results import Measured

FARTHEST = 10  # a rung below the least of the points by more than this factor is named, not drawn: it would flatten them
FITTED = "fitted"  # `status` of a law; others say why there is none, or no exponent


@dataclass
class Axis:
    """One row of fits.csv."""

    shot: str
    technique: str
    parameter: str
    fixed: str
    status: str
    unit: str
    floor: Measured | None
    law: tuple | None  # (a, b)
    points: dict  # {(technique, point): (cost, error)}, both Measured

    def error_at(self, costs):
        a, b = self.law
        return self.floor.value + a * costs**-b


def _axes(results, chosen, errors):
    """All rows of fits.csv with shots and points of these results; a law is left out if one of its points is not shown."""
    found = []
    shots, run = results.shots(), f"run `ssrlab tradeoff {results.folder}`"
    rows = results.read_csv(tradeoff.FITS, is_optional=True)
    if not rows:
        raise ResultsError(f"{chosen.where}: {tradeoff.FITS} is missing, or has no axis of four points that differ in one number alone: {run}")
    if "point_names" not in rows[0]:
        raise ResultsError(f"{chosen.where}: {tradeoff.FITS} is of an earlier version: {run} again")
    for row in rows:
        keys = [(row["technique"], name) for name in row["point_names"].split("; ") if name]
        if row["shot"] not in shots or not keys or chosen.points is not None and not set(keys) <= set(chosen.points):
            continue
        own = {key: errors.get((row["shot"], *key)) for key in keys}
        judged = tradeoff.judged(results, row["shot"], own) if None not in own.values() else {}
        if not judged:
            raise ResultsError(
                f"{chosen.where}: {tradeoff.FITS} is not of {chosen.metric} of {chosen.target}, {chosen.mask} pixels, as these results have it: "
                f"{run} again, with --metric, --target and --mask where they are not the study's `primary`"
            )
        points = {
            key: tuple(results.measured(judged[key], (q, f"{q}_low", f"{q}_high")) for q in ("cost", "error"))
            for key in keys
        }
        law = (needed_number(row, "a"), needed_number(row, "b")) if row["status"] == FITTED else None
        floor = results.measured(row, ("floor", "floor_low", "floor_high"))
        found.append(Axis(row["shot"], row["technique"], row["parameter"], row["fixed"], row["status"], row["unit"], floor, law, points))
    return found


def _names(results, axes):
    """Names for the legend: technique and parameter, and the points' other values where several lines share these."""
    kinds = {(a.technique, a.parameter, a.fixed) for a in axes}

    def name(axis):
        is_shared = sum(kind[:2] == (axis.technique, axis.parameter) for kind in kinds) > 1
        return f"{results.labels.get(axis.technique, axis.technique)} over {axis.parameter}" + (f" ({axis.fixed})" if is_shared and axis.fixed else "")

    return [name(a) for a in axes]


def _draw_axis(panel, axis, color, mark):
    """Marks and curve; returns what no label may cover."""
    taken = [box for cost, error in axis.points.values() for box in draw_mark(panel, cost, error, mark, color)]
    if axis.law:
        costs = [cost.value for cost, _ in axis.points.values()]
        x = numpy.geomspace(min(costs), max(costs), 60)
        y = axis.error_at(x)
        panel.plot(x, y, color=color, linewidth=0.8 * style.scale())
        taken += zip(x, y[1:], x[1:], y)
    return taken


def _draw_floor(panel, floor, color):
    """The line with its interval, within the panel's limits; an interval from 0 reaches down to the panel's end."""
    bottom, _ = panel.get_ylim()
    if floor.value > bottom:
        panel.axhline(floor.value, color=color, linestyle="--", linewidth=0.7 * style.scale())
    panel.axhspan(max(floor.low, bottom), max(floor.high, bottom), color=color, alpha=0.1, linewidth=0)


def _draw_rung(panel, rung, limit, is_near):
    color, line = LOOKS[rung]
    if is_near:
        panel.axhline(limit.value, color=color, linestyle=line, linewidth=0.9 * style.scale(), label=RUNGS[rung])
        if limit.low is not None and limit.low > 0:
            panel.axhspan(limit.low, limit.high, color=color, alpha=0.12, linewidth=0)
        return
    bottom, top = panel.get_ylim()
    panel.set_ylim(bottom * (bottom / top) ** 0.12, top)  # a strip for the text
    panel.text(0.02, 0.02, f"{RUNGS[rung]}: {numbers.short(limit.value)} \N{DOWNWARDS ARROW}", transform=panel.transAxes, va="bottom")


def _draw_panel(panel, results, shot, own, rungs, unit):
    """`own`: [(Axis, colour, mark)] of the shot. Returns what no label may cover."""
    taken = [box for axis, color, mark in own for box in _draw_axis(panel, axis, color, mark)]
    if unit == "ms":
        style.log_log(panel, results.shot_label(shot), TIME_AXIS, 0.14)
    else:
        style.log_log(panel, results.shot_label(shot), f"{unit} of a frame".replace("_", " "), 0.14, lambda x: numbers.count(x, keeps_zeros=False))
    least = min(m.low if m.low and m.low > 0 else m.value for axis, *_ in own for _, m in axis.points.values()) / FARTHEST
    rung = next((r for r in RUNGS if r in rungs), None)
    lines = [axis.floor.value for axis, *_ in own if axis.floor] + ([rungs[rung].value] if rung else [])
    lines = [value for value in lines if value > least]
    panel.update_datalim([(panel.dataLim.x0, value) for value in lines])
    panel.autoscale_view()
    panel.set(xlim=panel.get_xlim(), ylim=panel.get_ylim())  # lines and bands reach to the ends from here on
    if rung:
        _draw_rung(panel, rung, rungs[rung], rungs[rung].value > least)
    for axis, color, _ in own:
        if axis.floor:
            _draw_floor(panel, axis.floor, color)
    start, end = panel.get_xlim()
    return taken + [(start, value, end, value) for value in lines]


def _without_law(results, axes, names):
    """One line for each reason: the lines without a law, or with a floor only, and their shots."""
    found, is_one_shot = {}, len({a.shot for a in axes}) == 1
    for axis, name in zip(axes, names):
        if not axis.law:
            of_reason = found.setdefault(("floor alone" if axis.floor else "no law", axis.status), {})
            of_reason.setdefault(name, []).append(results.shot_label(axis.shot))
    return [
        f"{what}, as {why}: " + "; ".join(name if is_one_shot else f"{name} in {', '.join(shots)}" for name, shots in of_reason.items())
        for (what, why), of_reason in found.items()
    ]


def _label_values(panel, results, own, taken):
    """The parameter's values beside the marks; where they do not all fit, those of the cheapest and the dearest point."""
    ends, others = [], []
    for axis, color, _ in own:
        items = [
            (cost.value, error.value, sweeps.value_text(results.parameters_of(*key).get(axis.parameter, "")), style.darker(color))
            for key, (cost, error) in sorted(axis.points.items(), key=lambda p: p[1][0].value)
        ]
        ends += [items[0], items[-1]]
        others += items[1:-1]
    if not place_labels(panel, ends + others, taken):
        place_labels(panel, ends, taken)


def draw(results, chosen):
    try:
        axes = _axes(results, chosen, results.errors_of(chosen.target, chosen.metric, chosen.mask, with_hidden=True))
    except ResultsError:
        if chosen.where:
            raise
        return None  # nobody asked for it, and nothing was fitted, or another error
    if not axes:
        return None
    every = _names(results, axes)
    names = list(dict.fromkeys(every))
    shots = [shot for shot in results.shots() if any(a.shot == shot for a in axes)]
    unit = axes[0].unit
    figure, panels = style.panels(len(shots), chosen, height=5.4)
    drawn = []
    for panel, shot in zip(panels, shots):
        own = [(axis, *style.series(names.index(name))) for axis, name in zip(axes, every) if axis.shot == shot]
        drawn.append((panel, own, _draw_panel(panel, results, shot, own, rungs_of(results, shot, chosen), unit)))
    panels[0].set_ylabel(f"{chosen.metric} of {chosen.target}, {chosen.mask} pixels")
    for index, name in enumerate(names):
        color, mark = style.series(index)
        has_law = any(axis.law for axis, other in zip(axes, every) if other == name)
        panels[0].plot([], [], mark, color=color, linestyle="-" if has_law else "", label=name)
    style.draw_legend(figure, panels, names)
    cost = "time" if unit == "ms" else "cost"
    said = [f"{'median times' if unit == 'ms' else 'counted costs'}, mean errors; 95 % intervals; curves: error = floor + a {cost}^-b; dashed: floors"]
    said += results.warnings_of_times(shots) if unit == "ms" else []
    style.note(figure, "\n".join(["; ".join(said), *_without_law(results, axes, every)]))
    for panel, own, taken in drawn:
        _label_values(panel, results, own, taken)
    return figure
