"""CSV as ssrlab writes and reads it (experiments/results/files/csv.h): RFC 4180, header first. Texts that a spreadsheet would read as a
formula get an apostrophe in front, which reading removes. Numbers stay unchanged."""

import csv
import io
import math
import re

from ssrlab.mistakes import ResultsError, counted
from ssrlab.text_files import read_text

FORMULA = re.compile(r"'*[=+\-@\t\r]")
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
GUARDED = re.compile(r"^'('*[=+\-@\t\r])")  # what guarded() makes of a formula


def guarded(value):
    """A value as a field; an apostrophe guards a text that begins like a formula."""
    is_formula = isinstance(value, str) and FORMULA.match(value) and not NUMBER.fullmatch(value)
    return "'" + value if is_formula else value


def _field(value):
    text = "" if value is None else str(guarded(value))
    return '"' + text.replace('"', '""') + '"' if re.search('[,"\r\n]', text) else text  # Python's own writer leaves a \r bare


def write_lines(stream, lines):
    """`lines`: lists of fields; None is an empty field."""
    for line in lines:
        stream.write(",".join(map(_field, line)) + "\n")


class Row(dict):
    """The fields of one line by column. Names file and line if a column is missing."""

    def __init__(self, values, file, line):
        super().__init__(values)
        self.file, self.line = file, line

    def __missing__(self, column):
        raise ResultsError(f"{self.file} has no column '{column}'; it has: {', '.join(self)}")

    def __or__(self, other):
        return Row({**self, **other}, self.file, self.line)


def read_rows(file):
    """(names of columns, Rows)"""
    return parse_rows(read_text(file), file)


def parse_rows(text, file, first_line=1):
    """read_rows() of a text that begins at a line of the file."""
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    rows, columns, begin = [], None, first_line
    try:
        for fields in reader:
            line, begin = begin, first_line + reader.line_num
            if not fields:
                continue  # an empty line
            fields = [GUARDED.sub(r"\1", f) if f.startswith("'") else f for f in fields]
            if columns is None:
                columns = fields
                twice = next((c for c in columns if columns.count(c) > 1), None)
                if twice is not None:
                    raise ResultsError(f"{file}:{line}: the column '{twice}' is named twice")
            elif len(fields) != len(columns):
                raise ResultsError(f"{file}:{line}: {counted(len(fields), 'field')}, but the first line names {counted(len(columns), 'column')}")
            else:
                rows.append(Row(zip(columns, fields), file, line))
    except csv.Error as e:
        raise ResultsError(f"{file}:{first_line + reader.line_num}: not CSV: {e}") from e
    if columns is None:
        raise ResultsError(f"{file} is empty: its first line must name the columns")
    return columns, rows


def _wrong(row, column, wanted):
    place = f"{row.file}:{row.line}: " if isinstance(row, Row) else ""
    text = row[column]
    raise ResultsError(f"{place}'{column}' = \"{text if len(text) < 100 else text[:100] + ' ...'}\" is not {wanted}")


def number(row, column):
    """A finite number; None where the field is empty."""
    text = row[column]
    if text in ("", None):
        return None
    value = float(text) if NUMBER.fullmatch(str(text)) else math.nan
    return value if math.isfinite(value) else _wrong(row, column, "a finite number")


def needed_number(row, column):
    value = number(row, column)
    return _wrong(row, column, "a number") if value is None else value


def whole(row, column):
    """A whole number from 0; None where the field is empty."""
    text = str(row[column])
    if text == "":
        return None
    return int(text) if text.isascii() and text.isdigit() and len(text) < 20 else _wrong(row, column, "a whole number from 0")
