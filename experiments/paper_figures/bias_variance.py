"""Bias^2 and variance of each point: what all seeds get wrong alike, and what differs from seed to seed."""

from paper_figures import style
from paper_figures.results import label


NAMES = {"bias_squared": "bias\N{SUPERSCRIPT TWO}", "variance": "variance"}


def draw(results, chosen):
    rows = [
        s
        for s in results.splits
        if (s["target"], s["mask"]) == (chosen.target, chosen.mask)
        and (s["variant"], s["point"]) not in results.single_changes
    ]
    shots = list(dict.fromkeys(s["shot"] for s in rows))
    if not shots:
        return None
    points = list(dict.fromkeys((s["variant"], s["point"]) for s in rows))
    figure, panels, legend = style.panels(len(shots), height=2.2 + 0.8 * len(points), sharex=True, sharey=True)
    for axes, shot in zip(panels, shots):
        _draw_shot(results, axes, [s for s in rows if s["shot"] == shot], points)
        axes.set_title(style.shot_title(shot))
        axes.tick_params(labelbottom=True)
        axes.set_xlabel("part of the MSE (radiance\N{SUPERSCRIPT TWO}), 95 % intervals")
    seeds = {p: "/".join(sorted({s["seeds"] for s in rows if (s["variant"], s["point"]) == p})) for p in points}
    panels[0].set_yticks(range(len(points)), [f"{label(*p)}\n({seeds[p]} seeds)" for p in points])
    panels[0].set_ylim(len(points) - 0.5, -0.5)
    style.draw_legend(legend, panels)
    return figure


def _draw_shot(results, axes, rows, points):
    parts = {
        name: [results.measured(s, (name, f"{name}_low", f"{name}_high"), "splits.csv") for s in rows]
        for name in ("bias_squared", "variance")
    }
    least = min((m.value for part in parts.values() for m in part if m.value > 0), default=1e-6)
    for index, (name, part) in enumerate(parts.items()):
        color, mark = style.series(index)
        for row, measured in zip(rows, part):
            y = points.index((row["variant"], row["point"])) + 0.16 * (2 * index - 1)
            if measured.value <= 0:
                axes.text(least, y, f"{NAMES[name]} about 0", color=color, va="center")
                continue
            axes.errorbar(
                [measured.value],
                [y],
                xerr=measured.whiskers(),
                fmt=mark,
                color=color,
                markerfacecolor=color if index == 0 else "white",
                label=NAMES[name],
            )
    axes.set_xscale("log")
    axes.margins(x=0.12)
    axes.grid(axis="y", visible=False)
