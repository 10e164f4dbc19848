"""Stacked bars of each point's stages: time, work, or estimated time on a GPU. Each technique stands apart, below the names of its stages."""

import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter
from matplotlib.transforms import blended_transform_factory

from ssrlab.figures import numbers, style
from ssrlab.figures.request import near
from ssrlab import statistics
from ssrlab.mistakes import ResultsError

MOST_STAGES = 7  # of a technique, named and coloured; the least others are added up, unless there is but one
REST = "others"
REST_COLOR = "#bbbbbb"
# Okabe and Ito's colours, dark and light in turn; what has about the same lightness differs by its hatch, so that neighbours and
# the names above them differ in grey print, too.
LOOKS = (
    ("#0072b2", ""),
    ("#e69f00", ""),
    ("#009e73", "////"),
    ("#56b4e9", "...."),
    ("#d55e00", ""),
    ("#cc79a7", "\\\\\\\\"),
    ("#666666", "xxxx"),
    ("#f0e442", ""),
)
ROW, LINE = 0.42, 0.34  # cm of a bar and of a line of names, at the size of a page's text


def _short(stage):
    """The stage's name without its folder, which the technique's name states."""
    return stage.rsplit("/", 1)[-1]


def _named_stages(points):
    """The stages of a technique that take most, in the order in which they run; without stages that take nothing."""
    every = dict.fromkeys(s for stages in points.values() for s in stages if s != "total")
    most = {s: max(stages[s].value for stages in points.values() if s in stages) for s in every}
    every = [s for s in every if most[s] > 0]
    if len(every) <= MOST_STAGES + 1:
        return every, []
    kept = sorted(every, key=most.get, reverse=True)[:MOST_STAGES]
    return [s for s in every if s in kept], [s for s in every if s not in kept]


def _legend_lines(names, width):
    """The names in lines that fit into `width` (cm): [[(name, x in cm)]]."""
    lines, x = [[]], 0.0
    for name in names:
        needed = 0.42 + style.text_width(_short(name)) + 0.25
        if lines[-1] and x + needed > width:
            lines.append([])
            x = 0.0
        lines[-1].append((name, x))
        x += needed
    return lines


def _grouped(results, points):
    """{technique: {point: {stage: Measured}}} of the points with a stage that takes something."""
    groups = {}
    for key, stages in points.items():
        if key not in results.hidden and any(m.value > 0 for s, m in stages.items() if s != "total"):
            groups.setdefault(key[0], {})[key] = stages
    return groups


def draw_times(results, shot, chosen):
    said = ["median time of a frame (ms) with its 95 % interval", *results.warnings_of_times([shot])]
    return _draw(results, shot, chosen, results.times_of(shot), "; ".join(said), numbers.with_interval)


def draw_costs(results, shot, chosen):
    quantity = chosen.option("quantity", "operations")
    known = {row["quantity"] for row in results.costs}
    if known and quantity not in known:
        raise ResultsError(f"{chosen.where}: 'quantity' = \"{quantity}\" was not counted{near(quantity, known)}")
    said = f"{quantity.replace('_', ' ')}, counted in the last frame by the shaders themselves"
    figure = _draw(results, shot, chosen, results.costs_of(shot, quantity), said, lambda total: numbers.count(total.value))
    if figure:
        figure.axes[0].xaxis.set_major_formatter(FuncFormatter(lambda x, _: numbers.count(x, keeps_zeros=False)))
    return figure


def draw_estimates(results, shot, chosen):
    """Estimates for the chip that is asked for, else the first. Points that lack an estimate of a stage are named and left out."""
    chips = results.estimated_chips()
    chip = chosen.option("chip", chips[0] if chips else None)
    if chips and chip not in chips:
        raise ResultsError(f"{chosen.where}: 'chip' = \"{chip}\" has no estimates{near(chip, chips)}")
    points = results.estimates_of(shot, chip)
    whole = {key: stages for key, stages in points.items() if "total" in stages}
    lacking = ", ".join(results.point_label(*key) for key in points if key not in whole)
    low, high = statistics.MODEL_RANGE
    said = f"microseconds on {chip} (estimate) with the 95 % interval of the total by sampling; measured times were {low:.3g} to {high:.3g} times such estimates"
    said += f"; left out, since a stage has no estimate: {lacking}" if lacking else ""
    return _draw(results, shot, chosen, whole, said, numbers.with_interval)


def _draw(results, shot, chosen, points, said, total_text):
    """`points`: {(technique, point): {stage: Measured}}; `said`: what the bars show; `total_text`: the total behind a bar."""
    groups = _grouped(results, points)
    if not groups:
        return None
    width = style.width_of(chosen, 1 if sum(map(len, groups.values())) <= 8 else 2)
    scale = style.scale()
    blocks = []
    for technique, points in groups.items():
        named, rest = _named_stages(points)
        is_one_pass = len({s for stages in points.values() for s in stages} - {"total"}) == 1
        lines = [] if is_one_pass else _legend_lines([*named, *([REST] if rest else [])], width - 0.4)
        labels = {k: style.fitted(results.own_label(*k) or (results.point_name(*k) or "default"), style.ROW_NAMES * width) for k in points}
        blocks.append((results.labels.get(technique, technique), points, named, rest, lines, labels))
    rows = {id(b): [max(ROW * scale, LINE * scale * (t.count("\n") + 1)) for t in b[5].values()] for b in blocks}
    height = sum(sum(rows[id(b)]) + LINE * scale * (1 + len(b[4])) + 0.15 for b in blocks)
    figure, axes = plt.subplots(figsize=(width * style.CENTIMETRE, (height + 1.6 * scale) * style.CENTIMETRE), layout="constrained")
    axes.set_ylim(height, 0)  # the unit is 1 cm
    ticks, y = {}, 0.0
    beside = blended_transform_factory(figure.transFigure, axes.transData)
    for block in blocks:
        name, points, named, rest, lines, labels = block
        y += 0.15
        _text(axes, beside, 0.2 / width, y + LINE * scale / 2, name, fontweight="bold")
        y += LINE * scale
        for line in lines:
            for stage, x in line:
                _draw_key(axes, beside, (0.3 + x) / width, y + LINE * scale / 2, stage, named, width, scale)
            y += LINE * scale
        for (key, stages), row in zip(points.items(), rows[id(block)]):
            _draw_bar(axes, y + row / 2, 0.68 * ROW * scale, stages, named, rest)
            ticks[y + row / 2] = labels[key]
            y += row
    axes.set_yticks(list(ticks), list(ticks.values()))
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    axes.grid(axis="y", visible=False)
    style.note(figure, said)
    axes.set_title(style.fitted(results.shot_label(shot), 0.55 * width))
    _draw_totals(figure, axes, list(ticks), [s for _, points, *_ in blocks for s in points.values()], total_text)
    return figure


def _text(axes, transform, x, y, text, **options):
    axes.text(x, y, text, transform=transform, va="center", ha="left", **options).set_in_layout(False)


def _look(stage, named):
    if stage not in named:
        return {"facecolor": REST_COLOR, "hatch": ""}
    color, hatch = LOOKS[named.index(stage)]
    return {"facecolor": color, "hatch": hatch}


def _draw_key(axes, transform, x, y, stage, named, width, scale):
    axes.add_patch(
        plt.Rectangle((x, y - 0.1 * scale), 0.26 / width, 0.2 * scale, transform=transform, edgecolor="white", linewidth=0, clip_on=False, **_look(stage, named))
    ).set_in_layout(False)
    _text(axes, transform, x + 0.36 / width, y, _short(stage))


def _draw_bar(axes, y, height, stages, named, rest):
    parts = [(s, stages[s].value) for s in named if s in stages]
    left_over = sum(stages[s].value for s in rest if s in stages)
    start = 0.0
    for stage, value in parts + ([(REST, left_over)] if left_over else []):
        axes.barh(y, value, left=start, height=height, edgecolor="white", linewidth=0.3, **_look(stage, named))
        start += value


def _draw_totals(figure, axes, ys, every, total_text):
    """The total right of each bar, with its interval where it has one; the axis leaves room for the longest."""
    ends, texts = [], []
    for y, stages in zip(ys, every):
        total = stages.get("total")
        end = sum(t.value for s, t in stages.items() if s != "total")
        if total is None:
            ends.append(end)
            texts.append("")
            continue
        if total.low is not None:
            axes.errorbar([total.value], [y], xerr=total.whiskers(), fmt="none", ecolor="#000000", elinewidth=0.6, capsize=1.5, capthick=0.6)
        ends.append(max(end, total.high or total.value))
        texts.append(total_text(total))
    figure.draw_without_rendering()
    room = axes.get_window_extent().width / figure.dpi * 2.54
    axes.set_xlim(0, max(e / (1 - min((style.text_width(t) + 0.3) / room, 0.8)) for e, t in zip(ends, texts)))
    for y, end, text in zip(ys, ends, texts):
        axes.annotate(text, (end, y), (3, 0), textcoords="offset points", va="center").set_in_layout(False)
