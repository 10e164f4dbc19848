"""A table as Markdown for readers: three digits, short names of shots, intervals where they matter; long tables are folded. LaTeX and CSV
have all digits, intervals and names."""

import html
import math
import re

from ssrlab.figures import numbers
from ssrlab.tables import formats, shot_names
from ssrlab.tables.formats import NO_VALUE
from ssrlab.markdown_text import markdown_prose, markdown_text
from ssrlab.mistakes import counted, shown
from ssrlab.results import LIKE_BEST

MOST_ROWS, MOST_COLUMNS = 8, 5  # of a table that a reader surveys at a glance; a larger one is folded
WIDE = 0.05  # of its value: an interval that reaches less far moves the last two of three digits only, and is left out
LETTERS = ["\N{MODIFIER LETTER SMALL A}", "\N{MODIFIER LETTER SMALL B}", "\N{MODIFIER LETTER SMALL C}", "\N{MODIFIER LETTER SMALL D}"]
COMMIT = re.compile(r"\b([0-9a-f]{10})[0-9a-f]{30}\b")


def _places(value, low=None, high=None):
    """The place of the last shown digit, at most the third; -2: hundreds."""
    exponent = int(f"{value:.2e}".split("e")[1]) if value else 0
    return min(numbers.decimals(value, low, high), 2 - exponent)


def _number(value, places):
    shown = f"{round(value, places):.{max(places, 0)}f}"
    return shown if shown.strip("-0.") else "0"


def _reach(cell):
    """Distance of the interval's ends from the value, as a share of the value."""
    reach = max(cell.high - cell.value, cell.value - cell.low)
    return reach / abs(cell.value) if cell.value else math.inf if reach else 0.0


def _includes_one(cell):
    """Whether a ratio may be 1; false if all of the interval is 1 to the shown digits."""
    places = _places(cell.value, cell.low, cell.high)
    return cell.low <= 1 <= cell.high and len({_number(n, places) for n in (cell.value, cell.low, cell.high)}) > 1


def _shows_interval(cell):
    return formats.has_interval(cell) and (_reach(cell) > WIDE or _includes_one(cell))


def _writer(value, low=None, high=None):
    """How a value, the ends of its interval and of its range are written: with three digits, or fewer where the interval is wide."""
    if 0 < abs(value) < 1e-4:
        return lambda n: f"{n:.2e}"
    places = _places(value, low, high)
    return lambda n: _number(n, min(places, _places(n)))


def number(value):
    return _writer(value)(value)


def with_interval(cell):
    """0.71 [0.58, 0.85]; without the interval where there is none."""
    text = _writer(cell.value, cell.low, cell.high)
    return text(cell.value) + (f" [{text(cell.low)}, {text(cell.high)}]" if formats.has_interval(cell) else "")


def _value(cell):
    """(0.71 [0.58, 0.85], ["0.37 to 0.90"]): the number, and what stands in parentheses behind it and its marks."""
    if cell.value is None:
        return NO_VALUE, []
    text = numbers.count if cell.is_count() else _writer(cell.value, cell.low, cell.high)
    ends = [text(n) for n in (cell.least, cell.most)] if formats.has_range(cell) else []
    words = [] if cell.is_count() and len(set(ends)) == 1 else [" to ".join(ends)] if ends else []
    if _shows_interval(cell):
        return with_interval(cell), words
    return _apart_from_one(cell.value) if cell.is_significant and text(cell.value) == "1.00" else text(cell.value), words


def _apart_from_one(ratio):
    """The ratio with enough digits to show on which side of 1 it lies."""
    return next((shown for places in range(3, 7) if float(shown := f"{ratio:.{places}f}") != 1), "1.00")


class _Marks:
    """What is said of cells by marks: at a cell, at the head of a column of which it is true throughout, or once of all."""

    def __init__(self, cells):
        self.cells = cells
        lacking = [c for c in cells if not formats.has_interval(c) and not c.is_count()]
        reasons = dict.fromkeys(self._reason(c) for c in lacking)
        self.letters = {r: LETTERS[i % len(LETTERS)] * (1 + i // len(LETTERS)) for i, r in enumerate(r for r in reasons if r)}
        self.meaning = {mark: meaning for c in cells for mark, meaning in formats.lesser(c)}
        self.meaning |= {letter: reason for reason, letter in self.letters.items()}
        self.everywhere = {m for m in self.meaning if self._holds(m, cells)}
        columns = list(dict.fromkeys(c.column for c in cells))
        self.heads = {name: [m for m in self.meaning if m not in self.everywhere and self._holds(m, [c for c in cells if c.column == name])] for name in columns}

    @staticmethod
    def _reason(cell):
        """Why a cell has no interval or number; None if nothing is missing or needs a reason."""
        if formats.has_interval(cell) or cell.is_count():
            return None
        said = ", ".join(formats.reasons(cell))
        return f"no {'number' if cell.value is None else 'interval'}: {said}" if said else None if cell.value is None else "no interval"

    def _own(self, cell):
        return [mark for mark, _ in formats.lesser(cell)] + ([self.letters[reason]] if (reason := self._reason(cell)) else [])

    def _holds(self, mark, cells):
        """Of all of the cells that it could be at: those with an interval, or, of a reason, all."""
        able = cells if mark in self.letters.values() else [c for c in cells if formats.has_interval(c)]
        return bool(able) and all(mark in self._own(c) for c in able)

    def of(self, cell):
        said = [m for m in dict.fromkeys(self._own(cell)) if m not in self.everywhere and m not in self.heads[cell.column]]
        return "".join(said) + formats.DISTURBED * bool(cell.disturbed_share)

    def notes(self):
        return [self.meaning[m] if m in self.everywhere else f"{m}: {self.meaning[m]}" for m in self.meaning]


def _interval_note(table, cells):
    known = [c for c in cells if formats.has_interval(c)]
    shown = [c for c in known if _shows_interval(c)]
    most = max((_reach(c) for c in known if not _shows_interval(c)), default=None)
    of = formats.of_scenes(table)
    of, whose = ("", of) if of.startswith(",") else (of, "")
    if not known:
        return []
    if not shown:
        return [f"95 % intervals{of} are within ±{_percent(most)} %{whose}" if most else f"95 % intervals{of} are of no width{whose}"]
    if not most:  # of those that are left out, if any: what a table compares with itself
        return [f"in brackets 95 % intervals{of}{whose}"]
    which = " or include 1" if any(_reach(c) <= WIDE for c in shown) else ""
    return [f"in brackets 95 % intervals{of} where they reach further than {100 * WIDE:g} %{which}{whose}; the others are within ±{_percent(most)} %"]


def _percent(share):
    """Rounded up, so that all values are within it."""
    percent = 100 * share
    places = max(1 - math.floor(math.log10(percent)), 0)
    return f"{math.ceil(percent * 10**places - 1e-9) / 10**places:.{places}f}"


def _summary(text):
    """A caption within HTML."""
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(shown(text), quote=False))


def markdown(table, cells, made_from):
    rows, columns, at = formats.grid(cells)
    marks = _Marks(cells)
    names, shots = shot_names.shown_names(table, [*rows, *columns])

    def shown(row, column):
        cell = at.get((row, column))
        if cell is None:
            return ""
        text, words = _value(cell)
        words += [f"{cell.mean_of} of {table['over_count']}"] if cell.value is not None and formats.is_part(table, cell) else []
        words += [markdown_text(cell.clock)] if cell.clock and len(table["clocks"]) > 1 else []
        text += marks.of(cell) + (f" ({'; '.join(words)})" if words else "")
        style = "**" if formats.is_bold(cell) else "*" if cell.standing in LIKE_BEST else ""
        return f"{style}{text}{style}"

    heads = [markdown_text(names[c]) + "".join(marks.heads[c]) for c in columns]
    lines = ["| | " + " | ".join(heads) + " |", "|---" * (len(columns) + 1) + "|"]
    for row in rows:
        lines.append(f"| {markdown_text(names[row])} | " + " | ".join(shown(row, c) for c in columns) + " |")
    for shot, short in shot_names.short_names(shots or table["shots"]).items():
        made_from = made_from.replace(shot, short)
    explained = formats.sentence([*_interval_note(table, cells), *marks.notes(), *formats.other_notes(table, cells)])
    below = markdown_prose(" ".join(part for part in (COMMIT.sub(r"\1", made_from), shot_names.about(shots), explained) if part))
    if len(rows) <= MOST_ROWS and len(columns) <= MOST_COLUMNS:
        return "\n".join([markdown_prose(table["caption"]), "", *lines, "", below, ""])
    size = f"{counted(len(rows), 'row')}, {counted(len(columns), 'column')}"
    return "\n".join(["<details>", f"<summary>{_summary(table['caption'])}; {size}</summary>", "", *lines, "", below, "", "</details>", ""])
