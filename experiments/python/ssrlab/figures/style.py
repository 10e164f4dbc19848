"""The look that all figures share, and how they are saved."""

import functools
import hashlib
import io
import re
import textwrap

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.colors import to_rgb
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
import numpy as np

from ssrlab.figures import numbers
from ssrlab.figures.texts import wrapped
from ssrlab.text_files import path_inside, whole_file

CENTIMETRE = 1 / 2.54
WIDTHS = {"column": 8.5, "page": 17.6, "slide": 25.0}  # cm
DOUBLE_COLUMN = WIDTHS["page"] * CENTIMETRE
TEXT = 7  # pt, but for slides and for serifs, whose small letters are smaller
SLIDE_TEXT, SERIF_SCALE = 12, 8 / 7
# Both come with Debian's matplotlib, as TrueType; STIX goes with Times.
FONTS = {"sans": ["DejaVu Sans"], "serif": ["STIXGeneral", "DejaVu Serif"]}
MATHS = {"sans": "dejavusans", "serif": "stix"}
FORMATS = ("pdf", "svg", "png")

# Okabe & Ito 2008, "Color Universal Design": distinct with all kinds of colour vision; every series has a mark of its own too.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#666666"]
MARKS = ["o", "s", "^", "D", "v", "P", "X"]
NOT_POSITIVE_NOTE = "errors not above 0 after noise\ncorrection are not shown"
ONE_SEED_NOTE = "hollow: one seed, no interval"


def apply(font="sans", width=None):
    """Sets the look of all later figures. `width` (cm): of the figure, since a slide has larger letters and thicker lines."""
    is_slide = width is not None and width >= WIDTHS["slide"]
    size = (SLIDE_TEXT if is_slide else TEXT) * (SERIF_SCALE if font == "serif" else 1)
    scale = size / TEXT
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(
        {
            "font.family": FONTS[font],
            "mathtext.fontset": MATHS[font],
            "text.parse_math": False,  # names from files are no formulas
            "font.size": size,
            "axes.titlesize": size,
            "axes.labelsize": size,
            "xtick.labelsize": size,
            "ytick.labelsize": size,
            "legend.fontsize": size,
            "figure.titlesize": size,
            "figure.labelsize": size,
            "axes.linewidth": 0.6 * scale,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "grid.color": "#dddddd",
            "grid.linewidth": 0.5 * scale,
            "axes.axisbelow": True,
            "hatch.linewidth": 0.6 * scale,
            "lines.linewidth": 0.9 * scale,
            "lines.markersize": 4 * scale,
            "errorbar.capsize": 1.8 * scale,
            "legend.frameon": False,
            "figure.dpi": 300,  # as saved: parts are placed as large as they are drawn
            "savefig.dpi": 300,
            "pdf.fonttype": 42,  # TrueType, embedded: publishers refuse matplotlib's own Type 3
            "svg.fonttype": "path",  # looks the same where the font is not installed
            "svg.hashsalt": "ssrlab",
        }
    )


def text_size():
    return matplotlib.rcParams["font.size"]


def scale():
    """Factor of the size of lines, marks and letters relative to a page."""
    return text_size() / TEXT


def letters(centimetres):
    """Approximate number of letters of the text that fit into a width."""
    width = 0.018 if matplotlib.rcParams["font.family"][0] == FONTS["serif"][0] else 0.0215  # cm for each pt of their size
    return max(int(centimetres / (width * text_size())), 8)


def series(index, color=None):
    """Colour and mark of the index-th series; after the last colour, marks change. `color` replaces the colour."""
    return color or COLORS[index % len(COLORS)], MARKS[(index + index // len(COLORS)) % len(MARKS)]


def draw_mark(axes, x, y, mark, color, is_hollow=False, **options):
    """`x`, `y`: Measured, drawn with their whiskers, or numbers."""
    places = [[getattr(v, "value", v)] for v in (x, y)]
    bars = {name: v.whiskers() for name, v in (("xerr", x), ("yerr", y)) if hasattr(v, "whiskers")}
    axes.errorbar(*places, **bars, fmt=mark, color=color, markerfacecolor="white" if is_hollow else color, **options)


def darker(color):
    """A darker tone of a mark's colour, for letters on white."""
    return tuple(0.55 * part for part in to_rgb(color))


MOST_NAMES = 8  # that a legend in a column has room for
ROW_NAMES = 0.36  # of a figure's width at most, left of its panels; longer names are broken
LINE = 0.3  # cm of a line of text, at the size of a page's text


def width_of(chosen, count, names=()):
    """Width (cm): as asked for, else of a column for one panel and of a page for several, or for a legend of many names."""
    return getattr(chosen, "width", None) or WIDTHS["column" if count == 1 and len(names) <= MOST_NAMES else "page"]


def columns_in(width, most):
    """How many panels have room side by side."""
    return min(most, max(int(width / 5.0), 1))


def panels(count, chosen=None, most_columns=3, height=4.6, names=(), **shared):
    """A figure with `count` axes in rows. `height`: of a row (cm). `chosen`: width of the figure and height of a row, if asked for.
    `names`: of its legend. `shared`: sharex, sharey, as in pyplot.subplots."""
    width = width_of(chosen, count, names)
    most = min(count, columns_in(width, most_columns))
    rows = -(-count // most)
    columns = -(-count // rows)
    height = getattr(chosen, "height", None) or height * scale()
    size = (width * CENTIMETRE, height * rows * CENTIMETRE)
    figure, axes = plt.subplots(rows, columns, figsize=size, layout="constrained", squeeze=False, **shared)
    for unused in axes.flat[count:]:
        unused.axis("off")
    return figure, list(axes.flat[:count])


def draw_legend(figure, panels, names=()):
    """One legend above all panels, without repetitions, in the order of `names` (others last). The figure grows by it."""
    by_label = {text: handle for a in panels for handle, text in zip(*a.get_legend_handles_labels())}
    texts = [text for text in dict.fromkeys(names) if text in by_label] + [text for text in by_label if text not in names]
    if not texts:
        return
    longest = figure.get_figwidth() / CENTIMETRE - 0.9 * scale()  # without the marks, which stand left of the texts
    for columns in range(min(len(texts), 6), 0, -1):
        legend = figure.legend(
            [by_label[t] for t in texts],
            [fitted(t, longest) for t in texts],
            loc="upper center",
            ncols=columns,
            borderaxespad=0.2,
            columnspacing=1.4,
            handletextpad=0.5,
        )
        box = legend.get_window_extent(figure.canvas.get_renderer())
        if box.width <= figure.bbox.width or columns == 1:
            break
        legend.remove()
    figure.set_figheight(max(figure.get_figheight(), 1.5 * box.height / figure.dpi))  # a legend is smaller than its plot
    _grow(figure, above=box.height / figure.dpi)


def _grow(figure, above=0.0, below=0.0):
    """Adds room (inches) above or below the panels, whose own size stays."""
    height = figure.get_figheight()
    top = height * (1 - figure.get_layout_engine().get()["rect"][3]) + above
    figure.set_figheight(height + above + below)
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 1 - top / (height + above + below)))


def note(figure, text):
    """Sentences below all panels, replacing those already there. Lines break between words, within a word only if it exceeds a line. The
    figure grows by the lines."""
    before = figure._supxlabel.get_text() if figure._supxlabel else ""
    longest = letters(figure.get_figwidth() / CENTIMETRE)
    lines = [part for line in text.split("\n") for part in textwrap.wrap(line, longest, break_long_words=False, break_on_hyphens=False)]
    shown = "\n".join(fitted(line, figure.get_figwidth() / CENTIMETRE) for line in lines)
    lines = (shown.count("\n") + 1 if shown else 0) - (before.count("\n") + 1 if before else 0)
    figure.supxlabel(shown, linespacing=1.15)
    _grow(figure, below=lines * 1.2 * text_size() / 72)


def listed(entries, centimetres):
    """Entries in lines that fit into a width, none broken."""
    lines = [""]
    for entry in entries:
        added = f"{lines[-1]}; {entry}" if lines[-1] else entry
        if lines[-1] and len(added) > letters(centimetres):
            lines.append(entry)
        else:
            lines[-1] = added
    return "\n".join(lines)


def text_width(text):
    """cm of a line of text."""
    return _width_of(text, tuple(matplotlib.rcParams["font.family"]), text_size())


@functools.cache
def _width_of(text, family, size):
    points, _, _ = text_to_path.get_text_width_height_descent(text, FontProperties(family, size=size), False) if text.strip() else (0.0, 0.0, 0.0)
    return points / 72 * 2.54


def fitted(text, centimetres):
    """In lines no wider than that: broken as wrapped() does, and within a name that is too wide and has no such place."""
    lines = []
    for line in (part for given in text.split("\n") for part in wrapped(given, centimetres, text_width).split("\n")):
        while len(line) > 1 and text_width(line) > centimetres:
            end = next((n for n in range(len(line) - 1, 1, -1) if text_width(line[:n]) <= centimetres), 1)
            lines.append(line[:end])
            line = line[end:]
        lines.append(line)
    return "\n".join(lines)


def row_names(names, width):
    """Names of rows in their share of a `width` (cm), and the height (cm, at the size of a page's text) of the row with most lines."""
    names = [fitted(name, ROW_NAMES * width) for name in names]
    return names, 0.12 + LINE * (1 + max((name.count("\n") for name in names), default=0))


def widest(names):
    """cm of the widest line."""
    return max((text_width(line) for name in names for line in name.split("\n")), default=0.0)


def panel_title(text, axes, names=()):
    """In lines as long as the panel's share of its figure. `names`: of rows, which the layout puts left of the panel, or of the first of
    panels that share them."""
    columns = axes.get_subplotspec().get_gridspec().ncols
    width = axes.figure.get_figwidth() / CENTIMETRE
    if not names:
        return fitted(text, 0.8 * width / columns)
    beside = widest(names) + 0.5 * scale()  # with ticks
    is_shared = len(axes.get_shared_y_axes().get_siblings(axes)) > 1
    return fitted(text, 0.95 * ((width - beside) / columns if is_shared else width / columns - beside))


def panel_width(axes):
    """cm of a panel between its axis' ends, about."""
    return 0.75 * axes.figure.get_figwidth() / CENTIMETRE / axes.get_subplotspec().get_gridspec().ncols


def with_room(texts, places):
    """Labels of ticks at `places` (cm); "" for those that would overlap others. The ends have precedence."""
    kept, widths = [], [text_width(text) for text in texts]
    for i in dict.fromkeys([0, len(texts) - 1, *range(len(texts))]):
        if all(abs(places[i] - places[j]) >= (widths[i] + widths[j]) / 2 + 0.15 for j in kept):
            kept.append(i)
    return [text if i in kept else "" for i, text in enumerate(texts)]


class _LogTicks(LogLocator):
    """As many ticks as have room: fewer in each decade, the more decades the axis has."""

    def tick_values(self, vmin, vmax):
        decades = abs(np.log10(vmax / vmin)) if vmin > 0 else 9
        room = self.axis.axes.get_window_extent().size[int(self.axis.axis_name == "y")] / self.axis.figure.dpi * 72
        ticks = room / (text_size() * (2.2 if self.axis.axis_name == "y" else 3.6))
        choices = ((1, 1.5, 2, 3, 5, 7), (1, 2, 5), (1, 3))
        self.set_params(subs=next((subs for subs in choices if len(subs) * decades <= ticks), (1,)), numticks=max(int(ticks), 2))
        return super().tick_values(vmin, vmax)


def log_axis(axis, text=numbers.short):
    """Makes it logarithmic. `text`: how a tick's number is written."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_major_locator(_LogTicks())
    axis.set_major_formatter(FuncFormatter(lambda x, _: text(x)))
    axis.set_minor_formatter(NullFormatter())


def log_log(axes, title, xlabel, margin, x_text=numbers.short):
    """A panel with two logarithmic axes."""
    axes.set_xlabel(xlabel)
    log_axis(axes.xaxis, x_text)
    log_axis(axes.yaxis)
    axes.set_title(panel_title(title, axes))
    axes.margins(margin)


def name_rows(axes, names, margin=0.5, **options):
    """Rows at 0, 1, ... from above, with a margin of so much of a row above and below them and no lines between."""
    axes.set_yticks(range(len(names)), names, **options)
    axes.set_ylim(len(names) - margin, margin - 1)
    axes.grid(axis="y", visible=False)


def file_name(text, longest=150):
    """Letters, digits, '.', '_' and '-' stay, the rest becomes '-'; a long name is cut and ends in a hash of all of it."""
    name = re.sub(r"[^A-Za-z0-9._-]", "-", text)
    if len(name) <= longest:
        return name
    digest = hashlib.sha256(text.encode()).hexdigest()[:12]
    return f"{name[: longest - 13]}-{digest}"


def _room(text, axes, panels, side):
    """Pixels that a title or label of a panel may take along a side (0: width, 1: height) without leaving the picture or meeting what stands
    beside: the same text of another panel, or a panel that has none."""
    own = axes.get_window_extent()
    middle = sum(own.get_points()[:, side]) / 2
    before, behind = 0.0, axes.figure.bbox.size[side]
    for other in panels:
        box = other.get_window_extent().get_points()
        is_beside = max(box[0, 1 - side], own.get_points()[0, 1 - side]) < min(box[1, 1 - side], own.get_points()[1, 1 - side])
        if other is axes or not is_beside:
            continue
        centre = sum(box[:, side]) / 2
        has_text = bool(text(other).get_text())
        if centre < middle:
            before = max(before, (centre + middle) / 2 if has_text else box[1, side])
        else:
            behind = min(behind, (centre + middle) / 2 if has_text else box[0, side])
    return 2 * min(middle - before, behind - middle)


def lay_out(figure):
    """Places the parts of a figure, once for all of its formats: matplotlib itself would do so twice for each. Breaks titles and labels of
    panels that would leave the picture or meet others, since matplotlib makes room for their height alone. The figure grows by their lines."""
    if figure.get_layout_engine() is None:
        return
    figure.draw_without_rendering()
    panels = [axes for axes in figure.axes if axes.axison]
    added, has_broken = {}, False
    for of_panel, side in ((lambda a: a.title, 0), (lambda a: a.xaxis.label, 0), (lambda a: a.yaxis.label, 1)):
        for axes in panels:
            text = of_panel(axes)
            room = _room(of_panel, axes, panels, side) - 0.1 * CENTIMETRE * figure.dpi
            if not text.get_text() or text.get_window_extent().size[side] <= room:
                continue
            broken = fitted(text.get_text(), max(room / figure.dpi / CENTIMETRE, 0.5))
            if side == 0:
                row = round(axes.get_window_extent().y0)
                added[row] = max(added.get(row, 0), broken.count("\n") - text.get_text().count("\n"))
            text.set_text(broken)
            has_broken = True
    if any(added.values()):
        _grow(figure, below=sum(added.values()) * 1.2 * text_size() / 72)
    if has_broken:
        figure.draw_without_rendering()
    figure.set_layout_engine(None)


def save(figure, folder, name, formats=FORMATS):
    """Writes name.pdf, .svg and .png."""
    lay_out(figure)
    name = file_name(name)
    metadata = {
        "pdf": {"CreationDate": None, "ModDate": None, "Producer": None, "Creator": "ssrlab"},
        "svg": {"Date": None, "Creator": "ssrlab"},
        "png": {"Software": None},
    }
    files = []
    for kind in formats:
        file = path_inside(folder, f"{name}.{kind}")
        drawn = io.BytesIO()  # matplotlib explains no full disk
        figure.savefig(drawn, format=kind, metadata=metadata[kind])
        with whole_file(file) as temporary, open(temporary, "wb") as stream:
            stream.write(drawn.getvalue())
        files.append(file)
    plt.close(figure)
    return files
