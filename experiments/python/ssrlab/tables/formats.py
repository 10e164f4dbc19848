"""The full texts of a table's cells, for LaTeX, and the table as CSV."""

import io

from ssrlab.figures import numbers
from ssrlab import statistics
from ssrlab.csv_files import write_lines
from ssrlab.results import BEST, LIKE_BEST
from ssrlab.tables.cell import BOTH, COUNTED, EXACT
from ssrlab.tables.means import ASSETS, SAMPLED

# What intervals hold (experiments/results/verdicts/interval.h) that is less than the scatter over the seeds and the reference's noise, where
# there are such: its mark, and what the mark says.
LESSER = {
    "seeds": ("\N{DAGGER}", "the interval holds the seeds alone, not the reference's noise"),
    "pixels and seeds": ("\N{DOUBLE DAGGER}", "the interval holds the choice of pixels, not the reference's noise"),
    "these shots": ("\N{PILCROW SIGN}", "the interval is of these shots alone, not of other scenes: fewer than four assets"),
    "pixels": ("\N{DOUBLE DAGGER}", "the interval holds the choice of pixels, not the reference's noise"),
}
DISTURBED = "\N{SECTION SIGN}"
NO_VALUE = "\N{EN DASH}"


def has_interval(cell):
    return cell.value is not None and cell.low is not None and cell.high is not None


def lesser(cell):
    return [LESSER[kind] for kind in (cell.interval or "").split(BOTH) if kind in LESSER] if has_interval(cell) else []


def has_range(cell):
    return None not in (cell.least, cell.most) and cell.least != cell.most


def is_part(table, cell):
    """Whether a mean has fewer parts than the table's others, since some have no value."""
    return None not in (cell.mean_of, table.get("over_count")) and cell.mean_of < table["over_count"]


def reasons(cell):
    return [] if has_interval(cell) else [r for r in cell.reasons() if r != "no value"]


def cell_text(table, cell):
    """0.71 [0.70, 0.73] (0.37 to 0.90; 6 of 8): the value, its interval, the range over shots, and how many of them have a value; notes()
    explains its marks."""
    marks = "".join(dict.fromkeys(mark for mark, _ in lesser(cell))) + DISTURBED * bool(cell.disturbed_share)
    words = []
    if cell.value is None:
        text = NO_VALUE
    else:
        text = numbers.count(cell.value) if cell.is_count() else numbers.with_interval(cell)
        if has_range(cell):
            places = numbers.decimals(cell.value, cell.low, cell.high)
            least, most = (numbers.count(n) if cell.is_count() else numbers.text(n, places) for n in (cell.least, cell.most))
            words += [f"{least} to {most}"] if least != most or not cell.is_count() else []
        if is_part(table, cell):
            words.append(f"{cell.mean_of} of {table['over_count']}")
    if cell.clock and len(table["clocks"]) > 1:
        words.append(cell.clock)
    words += reasons(cell)
    return text + marks + (f" ({'; '.join(words)})" if words else "")


def of_scenes(table):
    """Text about the sample behind intervals of means over shots; "" for other means."""
    if table["over"] not in SAMPLED:
        return ""
    sample = table.get("sample")
    if sample == ASSETS:
        return " of the mean over scenes like these (Student's t, scenes of one asset averaged first)"
    if sample:  # a summary of before that took shots or scenes by themselves
        return f" of the mean over {sample} like these (Student's t)"
    return ", of these scenes as they are: over others they are wider"  # a summary of before they were the sample


def sentence(found):
    text = "; ".join(found)
    return text and text[0].upper() + text[1:] + "."


def notes(table, cells):
    """Explains the brackets, parentheses and marks of the table; "" if it has none."""
    found = []
    if any(has_interval(c) for c in cells):
        found.append("in brackets 95 % intervals" + of_scenes(table))
    found += dict.fromkeys(f"{mark}: {meaning}" for c in cells for mark, meaning in lesser(c))
    for lacking, of in (("interval", [c for c in cells if c.value is not None]), ("number", [c for c in cells if c.value is None])):
        named = list(dict.fromkeys(f'"{reason}"' for c in of for reason in reasons(c)))
        if named:
            found.append(f"{', '.join(named)}: why there is no {lacking}")
    if any(c.value is not None and not has_interval(c) and not reasons(c) and not c.is_count() for c in cells):
        found.append("a number without brackets has no interval")
    return sentence(found + other_notes(table, cells))


def other_notes(table, cells):
    """Notes about other things than intervals."""
    over = {"shot": "shots", "scene": "scenes"}.get(table["over"], f"all {table['over']}")
    found = []
    if any(has_range(c) for c in cells):
        found.append(f"in parentheses the range over {over}")
    if any(is_part(table, c) and c.value is not None for c in cells):
        found.append(f"\"n of {table['over_count']}\": so many of the {over} have a value and are in the mean")
    if any(c.interval == EXACT for c in cells):
        found.append("numbers of the compiler, shown with three digits; k, M, G: thousands, millions, billions")
    if any(c.interval == COUNTED for c in cells):
        found.append(f"counts of the last frame with one seed; those of other seeds differ by up to {100 * statistics.COUNTS_SPREAD:.2g} %; k, M, G: thousands, millions, billions")
    if table.get("is_estimated"):
        found.append(f"estimated: no GPU ran anything; intervals are of sampling alone, {statistics.MODEL_RANGE_TEXT}")
    if any(c.value is None for c in cells):
        found.append(f"{NO_VALUE}: no value")
    share = max((c.disturbed_share for c in cells if c.disturbed_share), default=None)
    if share:
        found.append(f"{DISTURBED}: other programs disturbed some of its frames, {100 * share:.0f} % at most")
    if any(c.is_significant for c in cells):
        if table.get("has_adjusted_intervals"):
            found.append("bold: significantly different from 1; intervals are adjusted for all effects on the same error (Holm)")
        else:  # a summary of before intervals were
            found.append("bold: significantly different from 1, adjusted for all effects on the same error (Holm), which the intervals are not")
    if any(c.standing == BEST for c in cells):
        found.append("bold: significantly the best of all points of its shot")
    if any(c.standing in LIKE_BEST for c in cells):
        found.append("italic: the best measured of its shot, or undecided beside it, or for certain within the margin of it")
    return found


def is_bold(cell):
    return cell.is_significant or cell.standing == BEST


def grid(cells):
    """(names of rows, names of columns, {(row, column): Cell})"""
    rows = list(dict.fromkeys(c.row for c in cells))
    columns = list(dict.fromkeys(c.column for c in cells))
    return rows, columns, {(c.row, c.column): c for c in cells}


def comma_separated(table, cells):
    """The grid as CSV: a column for each key of the rows, by its name; then columns for each value, low and high, and its standing if the
    table marks the best."""
    rows, columns, at = grid(cells)
    parts = ["value", "low", "high", *(["standing"] if any(c.standing for c in cells) else [])]
    lines = [table["rows"] + [c if part == "value" else f"{c} {part}" for c in columns for part in parts]]
    lines += [table["texts_of_rows"][row] + [getattr(at.get((row, c)), part, None) for c in columns for part in parts] for row in rows]
    out = io.StringIO()
    write_lines(out, lines)
    return out.getvalue()
