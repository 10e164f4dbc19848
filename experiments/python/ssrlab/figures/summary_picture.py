"""Pictures of a few numbers from summaries: marks with intervals in rows, bars of shares that add up, lines, or fronts of two numbers."""

import hashlib
import json
import math
from dataclasses import dataclass, field

import matplotlib.pyplot as plt
from matplotlib.ticker import NullLocator

from ssrlab.figures import numbers, style
from ssrlab.tables.cell import Cell

GREY = "#666666"


@dataclass
class Mark:
    series: str  # its name in the legend; "": not in it
    color: str
    mark: str
    cell: Cell
    is_hollow: bool = False
    x: Cell = None  # of "fronts"


@dataclass
class Panel:
    title: str
    rows: list  # (label, [Mark]) from above
    line: float = None  # a value that the others are compared with

    def labels(self, are_shown=True):
        return [label if are_shown else "" for label, _ in self.rows]


@dataclass
class Picture:
    panels: list
    xlabel: str
    is_log: bool = True
    has_range: bool = False  # thin lines: the range over shots
    columns: int = 3
    kind: str = "dots"  # "bars": shares that add up; "lines": over the numbers that are its rows' labels; "fronts": over x, rows joined along their fronts
    note: str = ""
    steps: tuple = ()  # values of x that "fronts" mark by vertical lines
    extra: dict = field(default_factory=dict)  # axis limits


def shown_numbers(picture):
    """The hash of all numbers that a picture shows, however it is drawn."""
    told = [[p.title, p.line, [[label, [[m.series, m.color, m.mark, m.cell.value, m.cell.low, m.cell.high, m.cell.least, m.cell.most, *([m.x.value, m.x.low, m.x.high] if m.x else [])] for m in marks]] for label, marks in p.rows]] for p in picture.panels]
    return hashlib.sha256(json.dumps([told, picture.xlabel, picture.note, picture.kind]).encode()).hexdigest()


def places_of(panel):
    """(y, Mark) of all marks; the marks of a row lie below each other."""
    most = max(len(marks) for _, marks in panel.rows)
    step = 0.0 if most <= 2 else 0.62 / (most - 1)
    return [(row + (i - (len(marks) - 1) / 2) * step, mark) for row, (_, marks) in enumerate(panel.rows) for i, mark in enumerate(marks)]


def draw_dots(axes, panel, picture, has_labels):
    places = places_of(panel)
    for look_of in dict.fromkeys((m.series, m.color, m.mark, m.is_hollow) for _, m in places):
        same = [(y, m.cell) for y, m in places if (m.series, m.color, m.mark, m.is_hollow) == look_of]
        _, color, mark, is_hollow = look_of
        if picture.has_range:
            ranges = [(y, c) for y, c in same if c.least is not None]
            axes.hlines([y for y, _ in ranges], [c.least for _, c in ranges], [c.most for _, c in ranges], color=color, linewidth=0.8, alpha=0.5)
        known = [(y, c) for y, c in same if c.low is not None]
        axes.hlines([y for y, _ in known], [c.low for _, c in known], [c.high for _, c in known], color=color, linewidth=1.8)
        axes.plot([c.value for _, c in same], [y for y, _ in same], mark, color=color, markerfacecolor="white" if is_hollow else color)
    if panel.line is not None:
        axes.axvline(panel.line, color=GREY, linestyle="--", linewidth=1)
    ends = [end for _, m in places for end in (m.cell.value, m.cell.low, m.cell.high) if end is not None]
    if picture.is_log and max(ends) > 1.5 * min(ends) > 0:  # on a log axis there is room for few ticks
        style.log_axis(axes.xaxis, lambda x: numbers.short(x, groups_thousands=True))
    else:
        axes.locator_params(axis="x", nbins=6)
    style.name_rows(axes, panel.labels(has_labels), 0.4)  # with room for whole marks
    axes.grid(axis="y", visible=len(places) > 2 * len(panel.rows))


def draw_legend(figure, picture, panels):
    """Draws the legend; entries that several techniques share are grey."""
    colors = {}
    for panel in picture.panels:
        for _, marks in panel.rows:
            for m in marks:
                colors.setdefault((m.series, m.mark, m.is_hollow), set()).add(m.color)
    for (series, mark, is_hollow), found in colors.items():
        if series and picture.kind == "dots":
            color = found.pop() if len(found) == 1 else GREY
            panels[0].plot([], [], mark, color=color, markerfacecolor="white" if is_hollow else color, label=series)
    style.draw_legend(figure, panels)


def draw_bars(axes, panel, picture, has_labels):
    for place, (_, marks) in enumerate(panel.rows):
        left = 0.0
        for mark in marks:
            axes.barh(place, mark.cell.value, left=left, color=mark.color, height=0.7, label=mark.series)
            left += mark.cell.value
    style.name_rows(axes, panel.labels(has_labels))


def draw_lines(axes, panel, picture, has_labels):
    for series in dict.fromkeys(mark.series for _, marks in panel.rows for mark in marks):
        points = [(float(label), mark) for label, marks in panel.rows for mark in marks if mark.series == series]
        first = points[0][1]
        if not first.mark:  # the same at all places
            axes.axhline(first.cell.value, color=first.color, linestyle="--", label=series)
            continue
        known = [(x, m.cell) for x, m in points if m.cell.low is not None]
        axes.vlines([x for x, _ in known], [c.low for _, c in known], [c.high for _, c in known], color=first.color)
        axes.plot([x for x, _ in points], [m.cell.value for _, m in points], first.mark, linestyle="-", color=first.color, label=series)
    style.log_axis(axes.xaxis)
    style.log_axis(axes.yaxis)


def front_of(marks):
    """Those that no other mark beats in both numbers, by ascending x."""
    front = []
    for mark in sorted(marks, key=lambda m: (m.x.value, m.cell.value)):
        if not front or mark.cell.value < front[-1].cell.value:
            front.append(mark)
    return front


def with_gaps(segments):
    """The xs and ys of segments as one line, which makes a smaller file than one line for each."""
    places = [place for start, end in segments for place in (start, end, (math.nan, math.nan))]
    return [x for x, _ in places], [y for _, y in places]


def whiskers(marks):
    """The intervals of both numbers of all marks."""
    upright = [((m.x.value, m.cell.low), (m.x.value, m.cell.high)) for m in marks if m.cell.low is not None]
    return with_gaps(upright + [((m.x.low, m.cell.value), (m.x.high, m.cell.value)) for m in marks if m.x.low is not None])


def draw_fronts(axes, panel, picture, has_labels):
    for x in picture.steps:
        axes.axvline(x, color=GREY, linestyle=":", linewidth=1.2)
    if panel.line is not None:
        axes.axhline(panel.line, color=GREY, linestyle="--", linewidth=1)
    for label, marks in panel.rows:
        color, front = marks[0].color, front_of(marks)
        others = [m for m in marks if m not in front]
        axes.plot(*whiskers(front), color=color, linewidth=0.8, alpha=0.5)
        axes.plot(*with_gaps([((0.99 * m.x.value, m.cell.value), (1.01 * m.x.value, m.cell.value)) for m in others]), color=color, linewidth=3, alpha=0.5)
        axes.plot([m.x.value for m in front], [m.cell.value for m in front], marks[0].mark, linestyle="-", color=color, label=label)
    style.log_axis(axes.xaxis)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.grid(visible=False)


DRAW = {"fronts": draw_fronts, "dots": draw_dots, "bars": draw_bars, "lines": draw_lines}


def draw(picture, width):
    """The figure of a picture, this many centimetres wide."""
    rows = max(len(p.rows) for p in picture.panels)
    most = max(len(marks) for p in picture.panels for _, marks in p.rows)
    height = 4.6 if picture.kind == "fronts" else 3.6 if picture.kind == "lines" else 1.1 + rows * (0.42 if picture.kind == "bars" or most <= 2 else 0.3 + 0.06 * most)
    columns = min(picture.columns, len(picture.panels))
    lines = -(-len(picture.panels) // columns)
    size = (width * style.CENTIMETRE, height * lines * style.scale() * style.CENTIMETRE)
    figure, axes = plt.subplots(lines, columns, figsize=size, layout="constrained", squeeze=False)
    panels = list(axes.flat[: len(picture.panels)])
    for index, (one, panel) in enumerate(zip(panels, picture.panels)):
        DRAW[picture.kind](one, panel, picture, index % columns == 0 or panel.labels() != picture.panels[index - 1].labels())
        one.set_title(panel.title)
        one.set(**picture.extra)
    draw_legend(figure, picture, panels)
    style.note(figure, picture.xlabel + (f"; {picture.note}" if picture.note else ""))
    return figure
