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
