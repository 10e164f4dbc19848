"""Forest plots with one panel for each shot: the effect of each change on its baseline's error, and of each point on the error of the point
that differs in one value alone."""

import matplotlib.pyplot as plt

from ssrlab.figures import numbers, style
from ssrlab.figures.sweeps import value_text
from ssrlab.results import is_of, label

FARTHEST = 20.0  # ratios further from 1 would squeeze all others; they are written at the border of their panel
CUT = 2.0  # intervals reach at most this factor beyond the outermost ratio


def _preset(point):
    return [word for word in point.split() if "=" not in word and word != "default"]


def _groups(results, rows):
    """{(technique, point): label}: single changes of the baseline in the order of the study, then all other points, including changes of
    other baselines."""
    found = dict.fromkeys((e["technique"], e["point"]) for e in rows)
    preset = _preset(rows[0]["against_point"])
    changes = {k: c for k, c in results.single_changes.items() if k in found and _preset(k[1]) == preset}
    singles = {k: f"{p} = {value_text(v)}" for k, (p, v) in changes.items()}
    return singles | {k: results.point_label(*k) for k in found if k not in singles}


def _rows(results, chosen):
    return [e for e in results.effects if is_of(e, chosen) and e["technique"] == e["against_technique"]]


def comparisons(results, chosen):
    """The comparisons to draw, by the name of the figure's file: each baseline's changes, and for each `against` value of a config the
    points that have it."""
    found = {}
    for e in _rows(results, chosen):
        is_baseline = e["against"] == "baseline"
        other = label(e["against_technique"], e["against_point"]) if is_baseline else f"{e['technique']} {e['against']}"
        found.setdefault(("effects" if is_baseline else "otherwise_equal", other), []).append(e)
    kinds = [kind for kind, _ in found]
    return {
        kind if kinds.count(kind) == 1 else f"{kind}_{other}": rows
        for (kind, other), rows in found.items()
    }


def draw(results, chosen, rows):
    if rows[0]["against"] != "baseline":
        groups = {key: results.point_label(*key) for key in dict.fromkeys((e["technique"], e["point"]) for e in rows)}
        return _draw(results, chosen, rows, groups, f"{rows[0]['against']} and otherwise the same")
    baseline = results.point_label(rows[0]["against_technique"], rows[0]["against_point"])
    return _draw(results, chosen, rows, _groups(results, rows), baseline)


def _draw(results, chosen, rows, groups, against):
    width = style.width_of(chosen, 2)
    names, row = style.row_names(groups.values(), width)
    groups = dict(zip(groups, names))
    said = f"{chosen.metric} of {chosen.target}, {chosen.mask} pixels, relative to {against}; 95 % intervals; {_family(rows)}"
    below = style.fitted(said, 0.95 * width)
    shots = [s for s in results.shots() if any(e["shot"] == s for e in rows)]
    columns = min(len(shots), max(int(width / 4.4), 1))
    titles = {s: style.fitted(results.shot_label(s), 0.95 * (width - style.widest(names) - 0.5 * style.scale()) / columns) for s in shots}
    grid_rows = -(-len(titles) // columns)
    lines = grid_rows * (1 + max(t.count("\n") for t in titles.values())) + below.count("\n")
    figure, grid = plt.subplots(
        grid_rows,
        columns,
        figsize=(
            width * style.CENTIMETRE,
            (grid_rows * (1.5 + row * len(groups)) + lines * 0.32) * style.scale() * style.CENTIMETRE,
        ),
        layout="constrained",
        sharex=True,
        sharey=True,
        squeeze=False,
    )
    for axes in grid.flat[len(titles) :]:
        axes.axis("off")
    for index, (axes, (shot, title)) in enumerate(zip(grid.flat, titles.items())):
        _draw_shot(results, axes, [e for e in rows if e["shot"] == shot], list(groups))
        style.name_rows(axes, list(groups.values()))
        axes.set_title(title)
        axes.tick_params(labelbottom=index + columns >= len(titles))
    _limit(grid[0, 0], results, rows)
    figure.supxlabel(below)
    return figure


def _family(rows):
    family = "primary" if any(e["family"] == "primary" for e in rows) else "exploratory"
    return f"filled: significant; intervals and verdicts adjusted for all effects on this error (Holm; {family})"


def _draw_shot(results, axes, rows, keys):
    color, mark = style.series(0)
    axes.axvline(1.0, color="#555555", linewidth=0.7)
    style.log_axis(axes.xaxis)
    for e in rows:
        ratio = results.measured(e, ("ratio", "low_holm", "high_holm"))
        if ratio is None:
            continue
        row = keys.index((e["technique"], e["point"]))
        if not _is_near(ratio):
            is_right = ratio.value > 1
            number = numbers.short(ratio.value)
            if ratio.low is not None:
                number += f" [{numbers.short(ratio.low)}, {numbers.short(ratio.high)}]"
            axes.text(
                float(is_right),
                row,
                f"{number} →" if is_right else f"← {number}",
                transform=axes.get_yaxis_transform(),
                ha="right" if is_right else "left",
                va="center",
                color=color,
            )
            continue
        is_significant = e["verdict"] in ("less", "more")
        style.draw_mark(axes, ratio, row, mark, color, not is_significant, markersize=3.4 * style.scale(), markeredgewidth=0.8)


def _is_near(ratio):
    return 1 / FARTHEST <= ratio.value <= FARTHEST


def _limit(axes, results, rows):
    """One scale for all panels. Intervals of few seeds may reach far beyond all ratios: they are cut."""
    measured = [results.measured(e, ("ratio", "low_holm", "high_holm")) for e in rows]
    measured = [m for m in measured if m is not None and _is_near(m)]
    ratios = [1.0] + [m.value for m in measured]
    low, high = min(ratios) / CUT, max(ratios) * CUT
    ends = [max(m.low, low) for m in measured if m.low is not None] + [
        min(m.high, high) for m in measured if m.high is not None
    ]
    low, high = min(ratios + ends) / 1.05, max(ratios + ends) * 1.05
    axes.set_xlim(low, high)
