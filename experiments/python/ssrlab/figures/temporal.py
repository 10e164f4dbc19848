"""Temporal metrics, one panel each: flicker at rest, changes that the truth does not have, frames until ghosts are gone."""

from matplotlib.ticker import MaxNLocator

from ssrlab.figures import style

METRICS = {
    "flicker_relative": "relative flicker",
    "frame_difference_relative": "relative frame-difference error",
    "ghost_length": "ghost length (frames)",
    "settling_length": "settling length (frames)",
}


def draw(results, chosen):
    rows = [
        r
        for r in results.errors
        if r["metric"] in METRICS and r["mask"] == chosen.mask and (r["technique"], r["point"]) in results.points()
    ]
    metrics = [m for m in METRICS if any(r["metric"] == m for r in rows)]
    if not metrics:
        return None
    most = max(len({r["shot"] for r in rows if r["metric"] == m}) for m in metrics)
    names = [results.point_label(*k) for k in results.points()]
    width = style.width_of(chosen, len(metrics), names)
    shot_names, row = style.row_names([results.shot_label(s) for s in results.shots()], width / min(len(metrics), style.columns_in(width, 2)))
    row = max(0.5 + 0.22 * len(names), row)
    figure, panels = style.panels(len(metrics), chosen, most_columns=2, height=2.2 + most * row, names=names)
    for axes, metric in zip(panels, metrics):
        own = _draw_metric(results, axes, [r for r in rows if r["metric"] == metric], metric, dict(zip(results.shots(), shot_names)))
        axes.set_xlabel(style.panel_title(f"{METRICS[metric]}, {chosen.mask}", axes, own))
    style.draw_legend(figure, panels, names)
    return figure


def _draw_metric(results, axes, rows, metric, shot_names):
    """Returns the names of its rows."""
    shots, points = list(dict.fromkeys(r["shot"] for r in rows)), results.points()
    is_log = "length" not in metric
    for r in rows:
        index = points.index((r["technique"], r["point"]))
        y = shots.index(r["shot"]) + 0.7 * ((index + 0.5) / len(points) - 0.5)
        value = results.measured(r)
        color, mark = style.series(index, results.colors.get((r["technique"], r["point"])))
        if value is None or (is_log and value.value <= 0):
            text = "not determined" if value is None else "0"
            axes.text(0.01, y, text, color=color, va="center", transform=axes.get_yaxis_transform())
            continue
        edge = 0.8 if value.is_one_seed else 0
        style.draw_mark(axes, value, y, mark, color, value.is_one_seed, markeredgewidth=edge, label=results.point_label(r["technique"], r["point"]))
    if is_log:
        style.log_axis(axes.xaxis)
    axes.margins(x=0.1)
    if not is_log:
        axes.set_xlim(left=-0.5, right=max(axes.get_xlim()[1], 1.0))
        axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))
    style.name_rows(axes, [shot_names[s] for s in shots])
    return [shot_names[s] for s in shots]
