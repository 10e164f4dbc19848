"""Stacked bars: which stage of each variant point takes how long."""

import matplotlib.pyplot as plt

from paper_figures import style
from paper_figures.results import label


def draw(results, shot, errors, chosen):
    times = {key: stages for key, stages in results.times_of(shot).items() if any(s != "total" for s in stages)}
    if not times:
        return None
    names = list(dict.fromkeys(s for stages in times.values() for s in stages if s != "total"))
    height = (2.0 + 0.35 * len(names) + 0.6 * len(times)) * style.CENTIMETRE
    figure, (legend_axes, axes) = plt.subplots(
        2,
        figsize=(style.SINGLE_COLUMN, height),
        layout="constrained",
        gridspec_kw={"height_ratios": [0.35 * len(names), 0.6 * len(times)]},
    )
    for row, stages in enumerate(times.values()):
        start = 0.0
        for name, time in ((n, stages[n]) for n in names if n in stages):
            axes.barh(
                row,
                time.value,
                left=start,
                height=0.62,
                color=style.series(names.index(name))[0],
                hatch="" if names.index(name) < len(style.COLORS) else "/////",
                edgecolor="white",
                linewidth=0.4,
                label=name,
            )
            start += time.value
            axes.errorbar(
                [start], [row + 0.12], xerr=time.whiskers(), fmt="none", ecolor="#ffffff", elinewidth=1.6, capsize=0
            )
            axes.errorbar(
                [start],
                [row + 0.12],
                xerr=time.whiskers(),
                fmt="none",
                ecolor="#000000",
                elinewidth=0.5,
                capsize=1.2,
                capthick=0.5,
            )
        if "total" in stages:
            total = stages["total"]
            axes.text(
                max(start, total.high),
                row,
                f"  {style.number(total.value)} [{style.number(total.low)}, {style.number(total.high)}]",
                va="center",
                fontsize=7,
            )
    axes.set_yticks(range(len(times)), [label(*key) for key in times])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set(xlabel="median time (ms), 95 % intervals")
    ends = [
        max(sum(t.value for n, t in s.items() if n != "total"), s["total"].high if "total" in s else 0.0)
        for s in times.values()
    ]
    axes.set_xlim(0, 2.0 * max(ends))  # room for the totals as text
    handles, labels = axes.get_legend_handles_labels()
    by_label = dict(zip(labels, handles))
    legend_axes.axis("off")
    legend_axes.set_title(shot)
    legend_axes.legend(by_label.values(), by_label.keys(), loc="center")
    return figure
