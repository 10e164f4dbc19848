"""The figure of `ssrlab stability`: techniques as rows, cases as columns, each cell the verdict as a mark and a colour.

usage: python3 experiments/python figures.stability --out=FIGURE.pdf STABILITY.csv
"""

import argparse
import os
import sys

os.environ["SOURCE_DATE_EPOCH"] = "0"  # matplotlib writes no time of day into its files

from ssrlab.csv_files import read_rows
from ssrlab.mistakes import ResultsError, exit_code, stop

try:
    import matplotlib
except ImportError as missing:
    stop(f"{missing}: install python3-matplotlib")

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from ssrlab.figures import style

# From the best to the worst: mark and colour (Okabe & Ito 2008), so that either alone distinguishes them.
VERDICTS = {
    "ok": (".", "#bbbbbb"),
    "worse": ("v", "#56b4e9"),
    "out of range": ("D", "#e69f00"),
    "non-finite inside": ("s", "#cc79a7"),
    "spreads": ("X", "#d55e00"),
    "refused": ("_", "#000000"),
}
CELL = 0.30  # cm
NAME_SIZE, CASE_SIZE = 5, 4.5  # pt
KEY = 3.0  # cm of a verdict in the legend


def in_order(rows, name):
    return list(dict.fromkeys(name(row) for row in rows))


def draw(rows, out):
    techniques = in_order(rows, lambda r: (r["technique"], r["point"]))
    cases = in_order(rows, lambda r: (r["group"], r["case"]))
    names = [v if p == "default" else f"{v} {p}" for v, p in techniques]
    left = max(4.4, NAME_SIZE / style.text_size() * style.widest(names) + 0.3)
    above = max(5.2, CASE_SIZE / style.text_size() * style.widest([case for _, case in cases]) + 0.3)
    width = len(cases) * CELL + left + 1.6
    columns = min(len(VERDICTS), max(int(width / KEY), 1))
    below = 0.6 + 0.4 * -(-len(VERDICTS) // columns)
    width, height = width * style.CENTIMETRE, (len(techniques) * CELL + above + below) * style.CENTIMETRE
    figure = plt.figure(figsize=(width, height))
    axes = figure.add_axes(
        (
            left * style.CENTIMETRE / width,
            below * style.CENTIMETRE / height,
            len(cases) * CELL * style.CENTIMETRE / width,
            len(techniques) * CELL * style.CENTIMETRE / height,
        )
    )
    for verdict, (mark, color) in VERDICTS.items():
        points = [r for r in rows if r["verdict"] == verdict]
        axes.plot(
            [cases.index((r["group"], r["case"])) for r in points],
            [techniques.index((r["technique"], r["point"])) for r in points],
            linestyle="none",
            marker=mark,
            color=color,
            markersize=3.6 if verdict != "ok" else 1.6,
            label=f"{verdict} ({len(points)})",
        )
    style.name_rows(axes, names, 0.3, fontsize=NAME_SIZE)
    axes.set_xticks(range(len(cases)), [case for _, case in cases], rotation=90, fontsize=CASE_SIZE)
    axes.xaxis.tick_top()
    axes.set_xlim(-0.7, len(cases) - 0.3)
    axes.tick_params(length=0, pad=2)
    axes.grid(False)
    for i, (group, _) in enumerate(cases):
        if i and cases[i - 1][0] != group:
            axes.axvline(i - 0.5, color="#999999", linewidth=0.4)
    for i, (technique, _) in enumerate(techniques):
        if i and techniques[i - 1][0] != technique:
            axes.axhline(i - 0.5, color="#999999", linewidth=0.4)
    figure.legend(loc="lower center", ncol=columns, fontsize=6, handletextpad=0.2)
    figure.savefig(out, metadata={"Date": None} if out.endswith(".svg") else None)


def main():
    parser = argparse.ArgumentParser(description="The figure of a stability.csv.")
    parser.add_argument("csv")
    parser.add_argument("--out", required=True)
    arguments = parser.parse_args()
    if not arguments.out.endswith((".pdf", ".png", ".svg")):
        parser.error(f"--out: '{arguments.out}' must end with .pdf, .png or .svg")
    rows = read_rows(arguments.csv)[1]
    if not rows:
        raise ResultsError(f"{arguments.csv} has no rows")
    style.apply()
    draw(rows, arguments.out)


if __name__ == "__main__":
    sys.exit(exit_code(main, "the figure"))
