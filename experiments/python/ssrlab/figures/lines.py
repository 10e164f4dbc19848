"""One panel of lines with 95 % intervals, for figures over roughness, frames and parameters."""

from ssrlab.figures import style


def draw_lines(axes, lines, names, is_log, dodge=0.0, colors=None):
    """`lines`: {name: [(x, Measured)]}; `names`: of all panels' lines, whose order gives each its colour and mark; `colors`:
    {name: colour} in place of these; `dodge` sets lines side by side.

    A logarithmic axis cannot show a value at or below zero; the panel says so where there is one.
    """
    has_nonpositive = False
    for name, points in lines.items():
        shown = [(x, m) for x, m in points if m.value > 0 or not is_log]
        has_nonpositive |= len(shown) < len(points)
        if not shown:
            continue
        index = names.index(name)
        color, mark = style.series(index, (colors or {}).get(name))
        is_one_seed = any(m.is_one_seed for _, m in shown)
        shift = dodge * (index - (len(names) - 1) / 2)
        whiskers = [m.whiskers() for _, m in shown]
        axes.errorbar(
            [x + shift for x, _ in shown],
            [m.value for _, m in shown],
            yerr=[[w[0][0] for w in whiskers], [w[1][0] for w in whiskers]],
            fmt=mark,
            linestyle=("-", "--", "-.")[index // len(style.COLORS) % 3],
            linewidth=0.8 * style.scale(),
            markersize=(3.2 if len(shown) <= 12 else 2.2) * style.scale(),
            markeredgewidth=0.8 if is_one_seed else 0,
            markerfacecolor="white" if is_one_seed else color,
            elinewidth=0.8 * style.scale(),
            color=color,
            label=name + (" (1 seed: no interval)" if is_one_seed else ""),
        )
    if is_log:
        style.log_axis(axes.yaxis)
    else:
        axes.axhline(0.0, color="#555555", linewidth=0.6)
    if has_nonpositive:
        axes.text(0.02, 0.02, style.NOT_POSITIVE_NOTE, transform=axes.transAxes)


def draw_points(results, axes, lines, is_log, dodge=0.0):
    """`lines`: {(technique, point): [(x, Measured)]}; empty ones are left out."""
    names = [results.point_label(*key) for key in results.points()]
    colors = {results.point_label(*key): color for key, color in results.colors.items()}
    draw_lines(axes, {results.point_label(*k): p for k, p in lines.items() if p}, names, is_log, dodge, colors)
