"""Error against run time of one shot, both logarithmic, with intervals."""

import matplotlib.pyplot as plt

from paper_figures import style


def _draw_points(axes, errors, times, shot):
    """One series per variant; returns whether any value is at or below zero, which a logarithmic axis cannot show."""
    variants = list(dict.fromkeys(v for s, v, _ in errors if s == shot))
    has_nonpositive = False
    for index, variant in enumerate(variants):
        color, mark = style.COLORS[index % len(style.COLORS)], style.MARKS[index % len(style.MARKS)]
        is_first = True
        for (s, v, point), error in errors.items():
            total = times.get((v, point), {}).get("total")
            if s != shot or v != variant:
                continue
            if v == "none" and error.value > 0:
                axes.axhline(error.value, color=color, linestyle="--", linewidth=0.8, label="none")
                if error.low is not None and error.low > 0:
                    axes.axhspan(error.low, error.high, color=color, alpha=0.15, linewidth=0)
            if total is None or total.value <= 0 or v == "none":
                continue
            if error.value <= 0:
                has_nonpositive = True
                continue
            axes.errorbar(
                [total.value],
                [error.value],
                xerr=total.whiskers(),
                yerr=error.whiskers(),
                fmt=mark,
                color=color,
                markerfacecolor="white" if error.is_one_seed else color,
                markeredgewidth=0.8 if error.is_one_seed else 0,
                label=variant if is_first else None,
            )
            if point != "default":
                axes.annotate(
                    point, (total.value, error.value), (3, 3), textcoords="offset points", fontsize=7, color="#444444"
                )
            is_first = False
    return has_nonpositive


def draw(results, shot, errors, chosen):
    times = results.times_of(shot)
    if not any("total" in stages for stages in times.values()):
        return None
    figure, axes = plt.subplots(figsize=(style.SINGLE_COLUMN, 0.75 * style.SINGLE_COLUMN), layout="constrained")
    has_nonpositive = _draw_points(axes, errors, times, shot)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="total time (ms), median with 95 % interval",
        ylabel=f"{chosen.metric} of {chosen.target}, {chosen.mask} pixels",
        title=shot,
    )
    style.log_axis(axes.xaxis)
    style.log_axis(axes.yaxis)
    axes.margins(0.12)
    notes = [
        text
        for is_needed, text in (
            (has_nonpositive, style.NOT_POSITIVE_NOTE),
            (any(e.is_one_seed for (s, _, _), e in errors.items() if s == shot), style.ONE_SEED_NOTE),
        )
        if is_needed
    ]
    if notes:
        axes.text(0.02, 0.02, "\n".join(notes), transform=axes.transAxes, fontsize=7)
    axes.legend(loc="best")
    return figure
