"""Tables as a study asks for them: which rows of a results folder, by what, in which order.

A table is an entry of the config's "tables" (experiments/README.md explains its keys); its numbers are cells."""

import json
import math
from dataclasses import dataclass

from paper_figures.results import ResultsError, rows_for_shots

SOURCES = {  # name to (file, columns of value, low and high)
    "effects": ("effects.csv", ("ratio", "low", "high")),
    "results": ("summary.csv", ("value", "low", "high")),
    "splits": ("splits.csv", None),  # its quantities are columns: see _split_rows()
    "times": ("time_summary.csv", ("median_ms", "low_ms", "high_ms")),
    "time_effects": ("time_effects.csv", ("ratio", "low", "high")),
}
KEYS = {"name", "caption", "of", "where", "rows", "columns", "over", "sort", "labels"}
SIGNIFICANT = 0.05  # of p_holm, from where on a ratio is told from 1


@dataclass
class Cell:
    """One number of a table with its 95 % interval, and the range over what it is a mean of; None where there is none."""

    table: str
    row: str
    column: str
    value: float
    low: float = None
    high: float = None
    least: float = None  # of the shots that a geometric mean is over
    most: float = None
    is_significant: bool = False  # by the adjusted p-value of the study's primary comparisons
    seeds: int = None


def _number(row, column):
    text = row.get(column) or ""
    try:
        return float(text) if text else None
    except ValueError as e:
        raise ResultsError(f"'{column}' = \"{text}\" is not a number") from e


def _split_rows(rows):
    """A row for each of the three quantities of splits.csv, named by `metric`."""
    for row in rows:
        for metric in ("mse", "bias_squared", "variance"):
            yield row | {
                "metric": metric,
                "value": row[metric],
                "low": row.get(metric + "_low", ""),
                "high": row.get(metric + "_high", ""),
            }


class Table:
    """One entry of "tables", checked."""

    def __init__(self, entry, where_from):
        unknown = sorted(set(entry) - KEYS)
        if unknown:
            raise ResultsError(f"{where_from}: unknown key '{unknown[0]}' of a table; known are {', '.join(sorted(KEYS))}")
        for key in ("name", "caption", "of", "rows", "columns"):
            if key not in entry:
                raise ResultsError(f"{where_from}: a table needs '{key}'")
        if entry["of"] not in SOURCES:
            raise ResultsError(f"{where_from}: 'of' = \"{entry['of']}\", but must be one of {', '.join(SOURCES)}")
        self.name, self.caption, self.of = entry["name"], entry["caption"], entry["of"]
        self.where = {k: v if isinstance(v, list) else [v] for k, v in entry.get("where", {}).items()}
        self.rows, self.columns = (v if isinstance(v, list) else [v] for v in (entry["rows"], entry["columns"]))
        self.over, self.sort, self.labels = entry.get("over"), entry.get("sort"), entry.get("labels", {})


class Selection:
    """The rows of a results folder that a table is made of, and how they are named in it."""

    def __init__(self, results, table):
        self.table = table
        self.parameters = {(v["variant"], v["point"]): v.get("parameters", {}) for v in results.manifest["variants"]}
        rows = results.read_csv(SOURCES[table.of][0])
        if table.of == "splits":
            rows = list(_split_rows(rows))
        if table.of == "results":
            rows = rows_for_shots(rows)
        self.rows = [r for r in rows if all(self._is_inside(r, k) for k in table.where)]
        if not self.rows:
            raise ResultsError(f"table '{table.name}': {SOURCES[table.of][0]} has no row where {json.dumps(table.where)}")

    def entry(self, row, key):
        """What a row has under a key: a column of the file, else a parameter of its point."""
        if key in row:
            return row[key]
        value = self.parameters.get((row.get("variant"), row.get("point")), {}).get(key)
        return value if value is None or isinstance(value, str) else json.dumps(value)

    def _is_inside(self, row, key):
        allowed = [v if isinstance(v, str) else json.dumps(v) for v in self.table.where[key]]
        return self.entry(row, key) in allowed

    def label(self, row, keys):
        """How a row is named along an axis: parameters with their names, columns of the file by their values alone."""
        words = []
        for key in keys:
            value = self.entry(row, key)
            if value is None:
                continue
            text = value if key in row else f"{key} = {value}"
            words.append(self.table.labels.get(text, text))
        return ", ".join(word for word in words if word)

    def place(self, row, keys):
        """Sorts rows as the table's `where` lists their values; equal where it does not."""
        listed = self.table.where
        return [listed[k].index(self.entry(row, k)) if k in listed and self.entry(row, k) in listed[k] else 0 for k in keys]


def _cell(table, row, columns, name):
    value, low, high = (_number(row, c) for c in columns)
    if value is None:
        return None
    p = _number(row, "p_holm")
    seeds = _number(row, "seeds")
    return Cell(
        table.name, *name, value, low, high, is_significant=p is not None and p < SIGNIFICANT, seeds=seeds and int(seeds)
    )


def _geometric_mean(cells):
    """Over shots, which are what they are and no sample: its interval holds what those of the single ones hold, taken as
    independent (half-widths of logarithms, added in quadrature)."""
    first = cells[0]
    if min(c.value for c in cells) <= 0:
        return None
    mean = math.exp(sum(math.log(c.value) for c in cells) / len(cells))
    result = Cell(first.table, first.row, first.column, mean, seeds=first.seeds)
    result.least, result.most = min(c.value for c in cells), max(c.value for c in cells)
    result.seeds = min((c.seeds for c in cells if c.seeds is not None), default=None)
    if all(c.low and c.low > 0 and c.high for c in cells):
        half = math.sqrt(sum((math.log(c.high / c.low) / 2) ** 2 for c in cells)) / len(cells)
        result.low, result.high = mean * math.exp(-half), mean * math.exp(half)
    return result


def cells_of(results, table):
    """All cells of a table, row by row."""
    selection = Selection(results, table)
    columns = SOURCES[table.of][1] or ("value", "low", "high")
    found = {}
    axes = [table.rows, table.columns]
    ordered = sorted(selection.rows, key=lambda r: [selection.place(r, keys) for keys in axes])  # stable
    for row in ordered:
        name = tuple(selection.label(row, keys) for keys in axes)
        cell = _cell(table, row, columns, name)
        if cell is not None:
            found.setdefault(name, []).append((row.get(table.over) if table.over else None, cell))
    cells = []
    for name, group in found.items():
        if table.over is None and len(group) > 1:
            raise ResultsError(
                f"table '{table.name}': {len(group)} rows of {SOURCES[table.of][0]} fall on one cell ({name[0]}; {name[1]}); "
                "narrow it with 'where', tell them apart by 'rows' or 'columns', or name what the geometric mean is 'over'"
            )
        cells.append(group[0][1] if table.over is None else _geometric_mean([c for _, c in group]))
    return _sorted([c for c in cells if c is not None], table.sort)


def _sorted(cells, column):
    rows = list(dict.fromkeys(c.row for c in cells))
    if column is not None:
        values = {c.row: c.value for c in cells if c.column == column}
        rows.sort(key=lambda r: values.get(r, math.inf))
    return sorted(cells, key=lambda c: rows.index(c.row))
