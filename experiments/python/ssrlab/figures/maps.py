"""Maps over two parameters of a sweep, one for each shot: error or time, as a multiple of the least. Cells that are indistinguishable from
the least are framed."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.patches import Rectangle

from ssrlab.figures import numbers, style, sweeps
from ssrlab.mistakes import ResultsError

MOST_NUMBERS = 9  # columns of a panel whose cells have room for their number
PALETTE = "cividis"  # falls evenly in lightness: the same with all kinds of colour vision, and in grey print


def like_the_least(measured):
    """The keys of {key: Measured} whose interval meets that of the least value; if it has no interval, its key alone."""
    least = min(measured, key=lambda k: measured[k].value)
    high = measured[least].high
    return {k for k, m in measured.items() if k == least or (None not in (high, m.low) and m.low <= high)}


def _panel(axes, measured, values, norm):
    """`measured`: {(x, y): Measured}; `values`: of both parameters."""
    least = min(m.value for m in measured.values())
    ratios = np.full((len(values[1]), len(values[0])), np.nan)
    place = {key: (values[1].index(key[1]), values[0].index(key[0])) for key in measured}
    for key, m in measured.items():
        ratios[place[key]] = m.value / least
    axes.imshow(ratios, cmap=PALETTE, norm=norm, aspect="auto", origin="lower", interpolation="nearest")
    palette = plt.get_cmap(PALETTE)
    room = style.panel_width(axes) / len(values[0])
    for key, m in measured.items():
        row, column = place[key]
        red, green, blue, _ = palette(norm(ratios[row, column]))
        if len(values[0]) <= MOST_NUMBERS:
            is_dark = 0.2126 * red + 0.7152 * green + 0.0722 * blue < 0.45
            axes.text(column, row, f"{ratios[row, column]:.3g}", ha="center", va="center", color="white" if is_dark else "black")
    for key in like_the_least(measured):
        row, column = place[key]
        for color, width in (("white", 2.6), ("#d55e00", 1.4)):
            axes.add_patch(Rectangle((column - 0.43, row - 0.43), 0.86, 0.86, fill=False, edgecolor=color, linewidth=width))
    axes.grid(False)
    for index, axis in ((0, axes.xaxis), (1, axes.yaxis)):
        texts = [sweeps.value_text(v) for v in values[index]]
        is_slanted = index == 0 and max(map(style.text_width, texts)) > 0.9 * room
        axis.set_ticks(range(len(texts)), texts, **({"rotation": 30, "ha": "right", "rotation_mode": "anchor"} if is_slanted else {}))
        axis.set_tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def draw(results, chosen):
    names = [chosen.option("x"), chosen.option("y")]
    families = sweeps.families(results, chosen, names)
    if len(families) > 1:
        raise ResultsError(f"{chosen.where}: a map has one cell for each {names[0]} and {names[1]}, but there are {'; '.join(families)}: narrow it by 'where'")
    (family, points), show = next(iter(families.items())), chosen.option("show", "error")
    if show not in ("error", "time"):
        raise ResultsError(f"{chosen.where}: 'show' must be error or time, not {show}")
    values = [sweeps.axis_values(families, index)[0] for index in (0, 1)]
    maps = {}
    errors = results.errors_of(chosen.target, chosen.metric, chosen.mask, with_hidden=True) if show == "error" else {}
    for shot in results.shots():
        times = {k: s["total"] for k, s in results.times_of(shot).items() if "total" in s}
        of_point = {place: times.get(key) if show == "time" else errors.get((shot, *key)) for place, key in points.items()}
        found = {place: m for place, m in of_point.items() if m is not None and m.value > 0}
        if found:
            maps[shot] = found
    if not maps:
        return None
    number = 1.3 * style.text_width("1.00")
    beside = max(int(0.75 * style.width_of(chosen, len(maps)) / (number * len(values[0]))), 1) if len(values[0]) <= MOST_NUMBERS else 3
    figure, panels = style.panels(len(maps), chosen, most_columns=min(beside, 3), height=1.9 + 0.62 * len(values[1]))
    most = max(m.value / min(o.value for o in of_shot.values()) for of_shot in maps.values() for m in of_shot.values())
    norm = LogNorm(1.0, max(most, 1.01))
    for axes, (shot, measured) in zip(panels, maps.items()):
        _panel(axes, measured, values, norm)
        least = min(measured.values(), key=lambda m: m.value)
        axes.set_title(style.panel_title(results.shot_label(shot), axes) + f"\nleast: {numbers.short(least.value)}" + (" ms" if show == "time" else ""))
        axes.set_xlabel(sweeps.axis_text(results, names[0]))
    panels[0].set_ylabel(sweeps.axis_text(results, names[1]))
    bar = figure.colorbar(ScalarMappable(norm, PALETTE), ax=panels, aspect=30, pad=0.02)
    what = "time of a frame" if show == "time" else f"{chosen.metric} of {chosen.target}, {chosen.mask} pixels"
    bar.set_label("over the least")
    style.log_axis(bar.ax.yaxis)
    style.note(figure, f"{family}: {what}, as a multiple of the panel's least; framed: its 95 % interval meets that of the least")
    return figure
