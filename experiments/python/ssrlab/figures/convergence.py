"""How errors fall, with both axes logarithmic: over a parameter, over time, or over the frames of a sequence, with each line's fitted slope
and its 95 % interval; or, without a fit, over the number of averaged seeds."""

import numpy

from ssrlab.figures import style, sweeps
from ssrlab.figures.error_time import TIME_AXIS
from ssrlab.figures.fetches import power_of
from ssrlab.figures.placed_labels import place_labels
from ssrlab.csv_files import whole
from ssrlab.mistakes import ResultsError
from ssrlab.results import Measured, frame_number, is_of, is_over_frames

LEAST_POINTS = 3  # that a slope with an interval needs


def _over_parameter(results, chosen, errors, shot):
    families = sweeps.families(results, chosen, [chosen.option("over")])
    if not sweeps.axis_values(families, 0)[1]:
        raise ResultsError(f"{chosen.where}: 'over' = \"{chosen.option('over')}\" has values that are no numbers")
    return {name: [(v[0], errors.get((shot, *key))) for v, key in points.items()] for name, points in families.items()}


def front(places):
    """Of {key: (time, error)} the keys on the front, by time: no other key is at most as slow and errs at most as much."""
    ordered = sorted(places, key=lambda k: (places[k][0].value, places[k][1].value))
    found, least = [], float("inf")
    for key in ordered:
        if places[key][1].value < least:
            found.append(key)
            least = places[key][1].value
    return found


def _over_time(results, chosen, errors, shot):
    """Each technique's points on its own front."""
    totals = {key: stages["total"] for key, stages in results.times_of(shot).items() if "total" in stages}
    places = {}
    for (s, *key), error in errors.items():
        technique, point = key
        inside = sweeps.is_inside(technique, results.parameters_of(technique, point), chosen.option("where", {}))
        if s == shot and (technique, point) in totals and inside:
            places.setdefault(results.labels.get(technique, technique), {})[technique, point] = (totals[technique, point], error)
    return {name: [(own[k][0].value, own[k][1]) for k in front(own)] for name, own in places.items()}


def _over_frames(results, chosen, errors, shot):
    """The error by the number of frames since the start of the history, including the warm-up."""
    entry = results.shot_entries.get(shot, {})
    frames = entry.get("frames") or []
    first = 1 + (entry.get("warm_up") or 0)
    lines = {}
    for r in results.all_errors:
        if r["shot"] != shot or is_over_frames(r) or not is_of(r, chosen):
            continue
        key = (r["technique"], r["point"])
        if key not in results.hidden and frame_number(r) in frames:
            lines.setdefault(results.point_label(*key), []).append((first + frames.index(frame_number(r)), results.measured(r)))
    return lines


def _over_seeds(results, chosen, errors, shot):
    """bias^2 + variance / n: the expected error of the mean image of n seeds, up to the seeds that ran."""
    lines = {}
    for s in results.splits:
        key = (s["technique"], s["point"])
        if (s["shot"], s["target"], s["mask"]) != (shot, chosen.target, chosen.mask) or key in results.hidden or (whole(s, "seeds") or 0) < 2:
            continue
        bias, variance = (results.measured(s, (q, f"{q}_low", f"{q}_high")) for q in ("bias_squared", "variance"))

        def end(n, side):
            parts = [getattr(bias, side), getattr(variance, side)]
            return None if None in parts else max(parts[0], 0.0) + parts[1] / n

        lines[results.point_label(*key)] = [
            (n, Measured(bias.value + variance.value / n, end(n, "low"), end(n, "high"))) for n in range(1, whole(s, "seeds") + 1)
        ]
    return lines


OVER = {  # how the lines are made, what the axis is called
    "time": (_over_time, TIME_AXIS),
    "frame": (_over_frames, "frames since the history was empty"),
    "seeds": (_over_seeds, "seeds that are averaged"),
}


def _slope_text(points):
    """The power of x by which the error goes; "" where there are too few points."""
    if len({x for x, _ in points}) < LEAST_POINTS:
        return ""
    slope, half = power_of([(x, m.value) for x, m in points])
    return f"{slope:.2f} ± {half:.2f}".replace("-", "\N{MINUS SIGN}")


def _draw_line(axes, name, points, color, mark):
    """Returns the line's pieces, which no label may cover."""
    whiskers = [m.whiskers() for _, m in points]
    axes.errorbar(
        [x for x, _ in points],
        [m.value for _, m in points],
        yerr=[[w[0][0] for w in whiskers], [w[1][0] for w in whiskers]],
        fmt=mark,
        color=color,
        linestyle="-",
        linewidth=0.7 * style.scale(),
        markersize=3 * style.scale(),
        elinewidth=0.7 * style.scale(),
    )
    axes.plot([], [], mark, color=color, linestyle="-", label=name)
    xs, ys = (numpy.log([float(v) for v in values]) for values in zip(*((x, m.value) for x, m in points)))
    fine = numpy.linspace(xs[0], xs[-1], 40)
    smooth = numpy.interp(fine, xs, ys)
    return [tuple(numpy.exp([a, b, c, d])) for a, b, c, d in zip(fine, smooth, fine[1:], smooth[1:])]


def _draw_fit(axes, points, color):
    x, y = (numpy.log([float(v) for v in values]) for values in zip(*((x, m.value) for x, m in points)))
    slope, offset = numpy.polyfit(x, y, 1)
    ends = numpy.array([x.min(), x.max()])
    axes.plot(numpy.exp(ends), numpy.exp(offset + slope * ends), color=color, linestyle="--", linewidth=0.6)


def _lines(results, chosen, make, errors):
    """{shot: {name: [(x, Measured)]}}, as far as x and the error are above 0 and a line has two places or more."""
    every = {}
    for shot in results.shots():
        lines = {
            name: sorted(((x, m) for x, m in points if x > 0 and m is not None and m.value > 0), key=lambda p: p[0])
            for name, points in make(results, chosen, errors, shot).items()
        }
        lines = {name: points for name, points in lines.items() if len({x for x, _ in points}) > 1}
        if lines:
            every[shot] = lines
    return every


def draw(results, chosen):
    over = chosen.option("over")
    make, axis = OVER.get(over, (_over_parameter, over))
    if over == "seeds" and chosen.metric != "mse":
        raise ResultsError(f"{chosen.where}: over seeds the metric is mse, which splits into bias and variance, not {chosen.metric}")
    every = _lines(results, chosen, make, errors=results.errors_of(chosen.target, chosen.metric, chosen.mask, with_hidden=True))
    if not every:
        return None
    figure, panels = style.panels(len(every), chosen, height=5.4)
    names = list(dict.fromkeys(name for lines in every.values() for name in lines))
    pieces, is_fitted = {}, over != "seeds"
    for axes, (shot, lines) in zip(panels, every.items()):
        pieces[shot] = []
        for name, points in lines.items():
            color, mark = style.series(names.index(name))
            pieces[shot] += _draw_line(axes, name, points, color, mark)
            if is_fitted and _slope_text(points):
                _draw_fit(axes, points, color)
        style.log_log(axes, results.shot_label(shot), axis, 0.12)
        if not is_fitted:
            counts = [2**i for i in range(12) if 2**i <= max(x for points in lines.values() for x, _ in points)]
            axes.set_xticks(counts, [str(c) for c in counts])
    panels[0].set_ylabel(f"{chosen.metric} of {chosen.target},\n{chosen.mask} pixels")
    style.draw_legend(figure, panels, names)
    fitted = "; dashed: error = a x^slope by least squares of logarithms; slope ± 95 %, of the scatter about it" if is_fitted else "; bias\N{SUPERSCRIPT TWO} + variance / n"
    style.note(figure, f"95 % intervals{fitted}")
    if is_fitted:
        for axes, (shot, lines) in zip(panels, every.items()):
            _draw_slopes(axes, lines, names, pieces[shot])
    return figure


def _draw_slopes(axes, lines, names, pieces):
    """Beside the ends of the lines; in a list where they find no place there."""
    texts = [(name, points[-1], _slope_text(points)) for name, points in lines.items() if _slope_text(points)]
    colors = {name: style.darker(style.series(names.index(name))[0]) for name in names}
    items = [(x, m.value, text, colors[name]) for name, (x, m), text in texts]
    if not place_labels(axes, items, pieces):
        for index, (name, _, text) in enumerate(texts):
            axes.text(1.02, 1 - 0.09 * index, text, color=colors[name], transform=axes.transAxes, va="top")
