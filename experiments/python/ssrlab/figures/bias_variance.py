"""Bias^2 and variance of each point: what all seeds get wrong alike, and what differs from seed to seed."""

from dataclasses import replace

from ssrlab.figures import style

NAMES = {"bias_squared": "bias\N{SUPERSCRIPT TWO}, 95 % interval", "variance": "variance, 95 % interval"}


def draw(results, chosen):
    rows = [
        s
        for s in results.splits
        if (s["target"], s["mask"]) == (chosen.target, chosen.mask)
        and (s["technique"], s["point"]) not in results.hidden
    ]
    shots = list(dict.fromkeys(s["shot"] for s in rows))
    if not shots:
        return None
    points = list(dict.fromkeys((s["technique"], s["point"]) for s in rows))
    parts = {
        name: [results.measured(s, (name, f"{name}_low", f"{name}_high")) for s in rows] for name in NAMES
    }
    limits = _limits([m for part in parts.values() for m in part])
    seeds = {p: "/".join(sorted({s["seeds"] for s in rows if (s["technique"], s["point"]) == p})) for p in points}
    names = [f"{results.point_label(*p)}\n({seeds[p]} seed{'s' * (seeds[p] != '1')})" for p in points]
    names, row = style.row_names(names, style.width_of(chosen, len(shots)))
    height = 2.2 + max(row, 0.8) * len(points)  # two marks, or words in place of them, need 0.8
    figure, panels = style.panels(len(shots), chosen, height=height, sharex=True, sharey=True)
    for axes, shot in zip(panels, shots):
        style.log_axis(axes.xaxis)
        axes.set_xlim(limits)
        for index, (name, part) in enumerate(parts.items()):
            for row, measured in zip(rows, part):
                if row["shot"] == shot:
                    _draw_part(axes, points.index((row["technique"], row["point"])), index, name, measured, limits)
        axes.set_title(style.panel_title(results.shot_label(shot), axes, names))
        axes.tick_params(labelbottom=True)
        style.name_rows(axes, names)
        axes.set_xlabel(style.panel_title("part of the MSE (radiance\N{SUPERSCRIPT TWO})", axes, names))
    style.draw_legend(figure, panels)
    return figure


def _limits(measured):
    """All values and the upper ends of all intervals; lower ends may be 0 and are cut."""
    positive = [v for m in measured for v in (m.value, m.high) if v is not None and v > 0] or [1.0]
    return min(positive) / 4, max(positive) * 2


def _draw_part(axes, row, index, name, measured, limits):
    color, mark = style.series(index)
    y = row + 0.16 * (2 * index - 1)
    if measured.value <= 0:
        axes.text(limits[0] * 1.1, y, "about 0", color=color, va="center")
        return
    if measured.low is not None:
        measured = replace(measured, low=max(measured.low, limits[0]))
    style.draw_mark(axes, measured, y, mark, color, is_hollow=index > 0, label=NAMES[name])
