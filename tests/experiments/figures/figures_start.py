"""What tests of figures begin with, imported before all else that draws: no window, and a word on what is missing."""

import os
import sys

os.environ["MPLBACKEND"] = "Agg"

try:
    import matplotlib  # noqa: F401
    import numpy  # noqa: F401
except ImportError as missing:
    sys.exit(f"figures need python3-matplotlib and python3-numpy (tests/run.sh installs them): {missing}")

from ssrlab.figures.request import Request


def check(is_true, what):
    if not is_true:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {what}")


def request_of(kind, metric="relmse", **more):
    return Request(kind, kind, "specular", metric, "reflective", **more)


def outside(figure):
    """The shown texts of a figure that its picture would cut off."""
    from matplotlib.text import Text

    figure.draw_without_rendering()
    renderer, (width, height) = figure.canvas.get_renderer(), figure.bbox.size
    unseen = set()  # labels of ticks beyond the ends of their axis, which matplotlib keeps and does not draw
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        low, high = sorted(axis.get_view_interval())
        unseen |= {label for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()) if not low <= tick.get_loc() <= high for label in (tick.label1, tick.label2)}
    found = []
    for text in figure.findobj(Text):
        box = Text.get_window_extent(text, renderer)  # of an annotation without its line
        if text.get_visible() and text.get_text().strip() and text not in unseen and not (box.x0 > -1 and box.y0 > -1 and box.x1 < width + 1 and box.y1 < height + 1):
            found.append(text.get_text())
    return found
