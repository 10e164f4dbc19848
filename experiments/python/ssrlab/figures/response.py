"""Error and time over one parameter: a line for each combination of the others, a column of panels for each shot."""

import matplotlib.pyplot as plt

from ssrlab.figures import style, sweeps
from ssrlab.figures.lines import draw_lines
from ssrlab.mistakes import ResultsError, say

SHOWN = ("error", "time")
MOST_LINES = 14  # that marks and colours distinguish


def _wanted(chosen):
    shown = chosen.option("show", list(SHOWN))
    shown = shown if isinstance(shown, list) else [shown]
    if not shown or any(s not in SHOWN for s in shown):
        raise ResultsError(f"{chosen.where}: 'show' must be of {', '.join(SHOWN)}, not {shown}")
    return shown


def _grid(count, rows, chosen):
    """(figure, axes[row][shot]): as many shots side by side as fit."""
    width = style.width_of(chosen, count)
    columns = min(count, max(int(width / 4.0), 1))
    blocks = -(-count // columns)
    height = (chosen.height or 4.0 * style.scale()) * rows * blocks
    figure, grid = plt.subplots(
        rows * blocks, columns, figsize=(width * style.CENTIMETRE, height * style.CENTIMETRE), layout="constrained", squeeze=False
    )
    for axes in grid[(blocks - 1) * rows :, count - (blocks - 1) * columns :].flat:
        axes.axis("off")
    return figure, [[grid[i // columns * rows + row, i % columns] for i in range(count)] for row in range(rows)]


def set_parameter_axis(axes, values, is_numeric):
    """Logarithmic where the values cover a decade and are above 0; names stand side by side."""
    if not is_numeric:
        axes.set_xticks(range(len(values)), [sweeps.value_text(v) for v in values], rotation=30, ha="right", rotation_mode="anchor")
        axes.set_xlim(-0.4, len(values) - 0.6)
        return
    if min(values) > 0 and max(values) >= 10 * min(values):
        style.log_axis(axes.xaxis)
    if len(values) <= 8:
        shares = [float(axes.xaxis.get_transform().transform(v)) for v in values]
        span = shares[-1] - shares[0] or 1.0
        places = [s / span * style.panel_width(axes) / 1.16 for s in shares]  # 0.08 of it at both ends are margins
        axes.set_xticks(values, style.with_room([sweeps.value_text(v) for v in values], places))
        axes.minorticks_off()
    axes.margins(x=0.08)


def draw(results, chosen):
    parameter, shown = chosen.option("parameter"), _wanted(chosen)
    families = sweeps.families(results, chosen, [parameter])
    if len(families) > MOST_LINES:
        many = f"{len(families)} lines over '{parameter}', of which {MOST_LINES} can be distinguished"
        if chosen.where:
            raise ResultsError(f"{chosen.where}: {many}: narrow it by 'where'")
        say(f"note: {many}: no figure {chosen.name}; ask for a part of it with --choice")
        return None
    values, is_numeric = sweeps.axis_values(families, 0)
    errors = results.errors_of(chosen.target, chosen.metric, chosen.mask, with_hidden=True)
    shots = [s for s in results.shots() if any((s, *key) in errors for points in families.values() for key in points.values())]
    times = {shot: results.times_of(shot) for shot in shots}
    shown = [s for s in shown if s != "time" or any(times.values())]
    figure, grid = _grid(len(shots), len(shown), chosen)
    for column, shot in enumerate(shots):
        totals = {key: stages["total"] for key, stages in times[shot].items() if "total" in stages}
        measured = {"error": lambda key: errors.get((shot, *key)), "time": totals.get}
        for row, what in enumerate(shown):
            axes = grid[row][column]
            lines = {
                name: [(v[0] if is_numeric else values.index(v[0]), measured[what](key)) for v, key in points.items() if measured[what](key)]
                for name, points in families.items()
            }
            lines = {name: sorted(points, key=lambda p: p[0]) for name, points in lines.items() if points}
            draw_lines(axes, lines, list(families), is_log=True)
            set_parameter_axis(axes, values, is_numeric)
            if row == 0:
                axes.set_title(style.panel_title(results.shot_label(shot), axes))
            if row == len(shown) - 1:
                axes.set_xlabel(sweeps.axis_text(results, parameter))
            if column == 0:
                axes.set_ylabel("time of a frame (ms)" if what == "time" else f"{chosen.metric} of {chosen.target}")
    if len(families) > 1:
        style.draw_legend(figure, [a for row in grid for a in row], list(families))
    notes = [f"{chosen.mask} pixels", "95 % intervals", *([] if len(families) > 1 else families)]
    style.note(figure, "; ".join(notes + (results.warnings_of_times(shots) if "time" in shown else [])))
    return figure
