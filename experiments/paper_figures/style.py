"""The look that all figures share, and how they are saved."""

import os

import matplotlib
import matplotlib.pyplot as plt

CENTIMETRE = 1 / 2.54
SINGLE_COLUMN = 8.5 * CENTIMETRE
DOUBLE_COLUMN = 17.8 * CENTIMETRE

# Okabe & Ito 2008, "Color Universal Design": told apart with all kinds of colour vision; every series has a mark of its own too.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#666666"]
MARKS = ["o", "s", "^", "D", "v", "P", "X"]


def apply():
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(
        {
            "font.family": "DejaVu Sans",
            "font.size": 7,
            "axes.titlesize": 7,
            "legend.fontsize": 6.5,
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


def number(x):
    return f"{x:.3g}".replace("e-0", "e-").replace("e+0", "e")


def save(figure, folder, name):
    """Writes name.pdf, .svg and .png, each to a temporary name and renamed."""
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
