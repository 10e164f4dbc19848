"""The look that all figures share, and how they are saved."""

import hashlib
import os
import re

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

CENTIMETRE = 1 / 2.54
SINGLE_COLUMN = 8.5 * CENTIMETRE
DOUBLE_COLUMN = 17.8 * CENTIMETRE
LEGEND_HEIGHT = 0.9  # cm

# Okabe & Ito 2008, "Color Universal Design": told apart with all kinds of colour vision; every series has a mark of its own too.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#666666"]
MARKS = ["o", "s", "^", "D", "v", "P", "X"]
NOT_POSITIVE_NOTE = "errors not above 0 after noise\ncorrection are not shown"
ONE_SEED_NOTE = "hollow: one seed, no interval"


def apply():
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(
        {
            "font.family": "DejaVu Sans",
            "font.size": 7,
            "axes.titlesize": 7,
            "legend.fontsize": 7,
            "axes.linewidth": 0.6,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.grid": True,
            "grid.color": "#dddddd",
            "grid.linewidth": 0.5,
            "axes.axisbelow": True,
            "lines.linewidth": 0.9,
            "lines.markersize": 4,
            "errorbar.capsize": 1.8,
            "legend.frameon": False,
            "figure.dpi": 100,
            "savefig.dpi": 300,
            "pdf.fonttype": 42,
            "svg.hashsalt": "ssrlab",
        }
    )


def series(index):
    """Colour and mark of the index-th series; beyond the colours, other marks."""
    return COLORS[index % len(COLORS)], MARKS[(index + index // len(COLORS)) % len(MARKS)]


def panels(count, most_columns=3, height=4.6, **shared):
    """A figure with `count` axes in rows (height of a row in cm) below room for a legend: of single-column width if one
    axes stands alone, of double-column width otherwise. `shared`: sharex, sharey, as in pyplot.subplots."""
    columns = min(count, most_columns)
    rows = -(-count // columns)
    width = SINGLE_COLUMN if count == 1 else DOUBLE_COLUMN
    figure = plt.figure(figsize=(width, (height * rows + LEGEND_HEIGHT) * CENTIMETRE), layout="constrained")
    legend_part, part = figure.subfigures(2, height_ratios=[LEGEND_HEIGHT, height * rows])
    axes = part.subplots(rows, columns, squeeze=False, **shared)
    for unused in axes.flat[count:]:
        unused.axis("off")
    return figure, list(axes.flat[:count]), legend_part


def draw_legend(part, panels, names=()):
    """One legend for all panels, without repetitions, in the order of `names` (others last)."""
    by_label = {text: handle for a in panels for handle, text in zip(*a.get_legend_handles_labels())}
    order = list(names) + [text for text in by_label if text not in names]
    texts = [text for text in order if text in by_label]
    is_wide = part.figure.get_figwidth() > SINGLE_COLUMN
    part.legend([by_label[t] for t in texts], texts, loc="center", ncols=min(len(texts), 5 if is_wide else 2))


PANEL_LETTERS = 22  # that fit over a panel, of which there may be four in a row
LINE_HEIGHT = 0.32  # cm, of such a title
PAGE_LETTERS = 118  # that fit below a figure of two columns, at 7 pt


def wrapped(text, longest):
    """In lines of `longest` letters at most, broken before a dot and behind a space, '=' or '_'; what has none of these stays."""
    lines = [""]
    for part in re.split(r"(?<=[ =_])|(?=\.)", text):
        if lines[-1] and len(lines[-1] + part.rstrip()) > longest:
            lines.append("")
        lines[-1] += part
    return "\n".join(line.rstrip() for line in lines)


def shot_title(shot):
    return wrapped(shot, PANEL_LETTERS)


def log_axis(axis, subs=(1, 2, 5)):
    axis.set_major_locator(LogLocator(subs=subs))
    axis.set_major_formatter(FuncFormatter(lambda x, _: number(x)))
    axis.set_minor_formatter(NullFormatter())


def number(x):
    if 0 < abs(x) < 1e-3:
        mantissa, exponent = f"{x:.2e}".split("e")
        return f"{float(mantissa):g}e{int(exponent)}"
    return f"{x:.3g}".replace("e+0", "e")


def file_name(text, longest=150):
    """Letters, digits, '.', '_' and '-' stay, the rest becomes '-'; a long name is cut and ends in a hash of all of it."""
    name = re.sub(r"[^A-Za-z0-9._-]", "-", text)
    if len(name) <= longest:
        return name
    digest = hashlib.sha256(text.encode()).hexdigest()[:12]
    return f"{name[: longest - 13]}-{digest}"


def save(figure, folder, name):
    """Writes name.pdf, .svg and .png, each to a temporary name and renamed."""
    name = file_name(name)
    metadata = {
        "pdf": {"CreationDate": None, "ModDate": None, "Producer": None, "Creator": "ssrlab"},
        "svg": {"Date": None, "Creator": "ssrlab"},
        "png": {"Software": None},
    }
    files = []
    for kind, tags in metadata.items():
        file = os.path.join(folder, f"{name}.{kind}")
        temporary = f"{file}.partial-{os.getpid()}"
        try:
            figure.savefig(temporary, format=kind, metadata=tags)
            os.replace(temporary, file)
        finally:
            if os.path.exists(temporary):
                os.remove(temporary)
        files.append(file)
    plt.close(figure)
    return files
