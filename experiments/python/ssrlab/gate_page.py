"""The tables and the picture of experiments/docs/gate.md, from the counts that `gate_study` writes.

usage: python3 experiments/python gate_page [--check]

With --check nothing is written, and the exit code is 2 if the page's tables are not those of the counts.
Needs Debian's python3-matplotlib and -scipy.
"""

import argparse
import re
import sys

from ssrlab.command_lines import CommandLine
from ssrlab.csv_files import read_rows
from ssrlab.mistakes import ResultsError, exit_code, stop
from ssrlab.repository import ROOT
from ssrlab.statistics import share

COUNTS = ROOT / "tests/experiments/bridges/gate_study/gate.csv"
PAGE = ROOT / "experiments/docs/gate.md"
PICTURE = ROOT / "experiments/docs/pictures/gate.svg"
COLUMNS = {  # of the counts, with their names on the page
    "worse": "worse", "worse_error": "error", "worse_flicker": "flicker", "worse_ghosts": "ghosts", "worse_visibility": "visibility", "better": "better",
    "worse_tolerance": "worse, `--worse-by 1.05`",
}  # fmt: skip
WITH_INTERVAL = ("worse", "worse_tolerance")


def sums(rows):
    """{technique: {(kind, strength): {column: count over the scenes}}}, in the order of the rows."""
    found = {}
    for row in rows:
        if row["kind"] == "NaN":  # refused, so that nothing was judged
            continue
        counts = found.setdefault(row["technique"], {}).setdefault((row["kind"], row["strength"]), dict.fromkeys(("runs", *COLUMNS), 0))
        for column in counts:
            counts[column] += int(row[column])
    return found


def interval_of(count, runs):
    return share([1] * count + [0] * (runs - count))


def cell(column, counts):
    part, low, high = (100 * max(v, 0.0) for v in interval_of(counts[column], counts["runs"]))  # of rounding below 0
    digits = 0 if counts["runs"] < 200 else 1
    return f"{part:.{digits}f} %" + (f" [{low:.{digits}f}, {high:.{digits}f}]" if column in WITH_INTERVAL else "")


def table(defects):
    lines = ["| defect | strength | runs | " + " | ".join(COLUMNS.values()) + " |", "|" + "---|" * (3 + len(COLUMNS))]
    for (kind, strength), counts in defects.items():
        lines.append(f"| {kind} | {strength} | {counts['runs']} | " + " | ".join(cell(c, counts) for c in COLUMNS) + " |")
    return "\n".join(lines)


def filled(text, found):
    """The page with these tables, each between its markers."""
    for technique, defects in found.items():
        begin, end = f"<!-- gate table {technique} -->\n\n", "\n\n<!-- end of table -->"
        text, places = re.subn(re.escape(begin) + ".*?" + re.escape(end), lambda _: begin + table(defects) + end, text, flags=re.DOTALL)
        if places != 1:
            raise ResultsError(f"{PAGE}: {places} places are marked for the gate table of {technique}, and 1 is needed")
    return text


def draw(found):
    """A curve of each kind of defect: the share of comparisons that are called worse, by strength."""
    try:
        import matplotlib
    except ImportError as missing:
        stop(f"{missing}: install python3-matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from ssrlab.figures import style

    style.apply()
    kinds = [kind for kind in dict.fromkeys(kind for kind, _ in next(iter(found.values()))) if kind != "none"]
    figure = plt.figure(figsize=(style.DOUBLE_COLUMN, 0.85 * style.DOUBLE_COLUMN), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(14, 1))
    places = above.subplots(3, 3, sharey=True)
    for place, kind in zip(places.flat, kinds):
        strengths = list(dict.fromkeys(s for defects in found.values() for k, s in defects if k == kind))
        for number, (technique, defects) in enumerate(found.items()):
            at = [i for i, strength in enumerate(strengths) if (kind, strength) in defects]
            counts = [defects[kind, strengths[i]] for i in at]
            for column, line, note in (("worse", "-", ""), ("worse_tolerance", ":", ", --worse-by 1.05")):
                parts = [interval_of(c[column], c["runs"]) for c in counts]
                ends = [[100 * (p - low) for p, low, _ in parts], [100 * (high - p) for p, _, high in parts]]
                shift = 0.06 * (2 * number - 1) + (0.03 if note else 0)
                place.errorbar([i + shift for i in at], [100 * p for p, _, _ in parts], yerr=ends, fmt=style.MARKS[number], linestyle=line,
                               color=style.COLORS[number], label=technique + note)  # fmt: skip
        place.set_title(kind)
        place.set_xticks(range(len(strengths)), [short(s) for s in strengths])
    for place in places[:, 0]:
        place.set_ylabel("called worse (%)")
    below.legend(*places.flat[0].get_legend_handles_labels(), loc="center", ncols=2)
    figure.savefig(PICTURE, metadata={"Date": None})


def short(strength):
    """Its number, and in a word what it is of where kinds have several."""
    number = re.search(r"[+-]*[\d.]+ %", strength)[0]
    return next((f"{word} {number}" for word in ("blurred", "sharpened") if word in strength), number).replace(" %", "%").replace(" ", "\n")


def command_line():
    parser = CommandLine(prog="python3 experiments/python gate_page", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    return parser


def main():
    is_check = command_line().parse_args().check
    _, rows = read_rows(str(COUNTS))
    found = sums(rows)
    text = PAGE.read_text(encoding="utf-8")
    if not is_check:
        PAGE.write_text(filled(text, found), encoding="utf-8")
        draw(found)
        print(f"{PAGE}, {PICTURE}: written")
    elif filled(text, found) != text:
        raise ResultsError(f"{PAGE}: its tables are not those of {COUNTS}; python3 experiments/python gate_page makes them anew")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the page"))
