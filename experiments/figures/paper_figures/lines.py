"""One panel of lines with 95 % intervals: what the figures over roughness and over frames have in common."""

from paper_figures import style
from paper_figures.results import label


def draw_lines(axes, lines, is_log, dodge):
    """`lines`: {(variant, point): [(x, Measured)]} in the order of the study's points; `dodge` sets them side by side.

    A logarithmic axis cannot show a value at or below zero; the panel says so where there is one.
    """
    has_nonpositive = False
    for index, (key, points) in enumerate(lines.items()):
        shown = [(x, m) for x, m in points if m.value > 0 or not is_log]
        has_nonpositive |= len(shown) < len(points)
        if not shown:
            continue
        color, mark = style.series(index)
        is_one_seed = any(m.is_one_seed for _, m in shown)
        shift = dodge * (index - (len(lines) - 1) / 2)
        whiskers = [m.whiskers() for _, m in shown]
        axes.errorbar(
            [x + shift for x, _ in shown],
            [m.value for _, m in shown],
            yerr=[[w[0][0] for w in whiskers], [w[1][0] for w in whiskers]],
            fmt=mark,
            linestyle="-",
            linewidth=0.6,
            markersize=3.2 if len(shown) <= 12 else 2.2,
            markeredgewidth=0.8 if is_one_seed else 0,
            markerfacecolor="white" if is_one_seed else color,
            elinewidth=0.8,
            color=color,
            label=label(*key) + (" (1 seed: no interval)" if is_one_seed else ""),
        )
    if is_log:
        axes.set_yscale("log")
        style.log_axis(axes.yaxis)
    else:
        axes.axhline(0.0, color="#555555", linewidth=0.6)
    if has_nonpositive:
        axes.text(0.02, 0.02, style.NOT_POSITIVE_NOTE, transform=axes.transAxes, fontsize=7)
