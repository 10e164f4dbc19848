"""Bias^2 and variance of each point: what all seeds get wrong alike, and what differs from seed to seed."""

from paper_figures import style
from paper_figures.results import label


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
        axes.set_xlabel("part of the MSE (radiance\N{SUPERSCRIPT TWO})")
    seeds = {p: "/".join(sorted({s["seeds"] for s in rows if (s["variant"], s["point"]) == p})) for p in points}
    panels[0].set_yticks(range(len(points)), [f"{label(*p)}\n({seeds[p]} seeds)" for p in points])
    panels[0].set_ylim(len(points) - 0.5, -0.5)
    style.draw_legend(legend, panels)
    return figure


def _draw_shot(results, axes, rows, points):
    variances = [results.measured(s, ("variance", "variance_low", "variance_high"), "splits.csv") for s in rows]
    biases = [results.measured(s, ("bias_squared", "bias_squared", "bias_squared"), "splits.csv").value for s in rows]
    least = min([v for v in biases + [v.value for v in variances] if v > 0], default=1e-6)
    for row, bias, variance in zip(rows, biases, variances):
        y = points.index((row["variant"], row["point"]))
        color, mark = style.series(0)
        if bias > 0:
            axes.plot([bias], [y - 0.16], mark, color=color, markeredgewidth=0, label="bias\N{SUPERSCRIPT TWO}")
        else:
            axes.text(least, y - 0.16, "bias\N{SUPERSCRIPT TWO} about 0", color=color, va="center")
        color, mark = style.series(1)
        if variance.value <= 0:
            axes.text(least, y + 0.16, "no variance", color=color, va="center")
            continue
        axes.errorbar(
            [variance.value],
            [y + 0.16],
            xerr=variance.whiskers(),
            fmt=mark,
            color=color,
            markerfacecolor="white",
            label="variance, 95 % interval",
        )
    axes.set_xscale("log")
    axes.margins(x=0.12)
    axes.grid(axis="y", visible=False)
