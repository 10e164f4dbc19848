"""Tables as a study asks for them: the rows of a results folder, grouped and ordered.

A table is an entry of the config's "tables" (experiments/docs/reference/study_keys.md explains the keys); its numbers are cells."""

import json
import math

from ssrlab.figures import tradeoff
from ssrlab.csv_files import number, whole
from ssrlab.mistakes import ResultsError
from ssrlab.results import BEST, LIKE_BEST, representative_rows
from ssrlab.tables import agreement, limits, variance_shares
from ssrlab.tables.cell import COUNTED, EXACT, Cell
from ssrlab.tables.means import ASSETS, SAMPLED, largest, mean

SOURCES = {  # name to (file, columns of value, low and high)
    "effects": ("effects.csv", ("ratio", "low_holm", "high_holm")),  # intervals that agree with the verdict
    "results": ("summary.csv", ("value", "low", "high")),
    "variance": ("results.csv", ("value", "low", "high")),  # of the logarithm of errors, by two parameters: variance_shares.py
    "splits": ("splits.csv", None),  # its quantities are columns: see _split_rows()
    "times": ("time_summary.csv", ("median_ms", "low_ms", "high_ms")),
    "time_effects": ("time_effects.csv", ("ratio", "low", "high")),
    "hits": ("hits.csv", ("value", "low", "high")),
    "costs": ("costs.csv", ("value", "low", "high")),  # counts of one seed: without an interval
    "compiled": ("compiled.csv", ("value", "low", "high")),  # exact for its compiler; quantities are columns: see _compiled_rows()
    "estimates": ("estimates.csv", ("value", "low", "high")),  # likewise: see _estimate_rows()
    "limits": ("summary.csv", ("value", "low", "high")),  # errors over the information limit of one frame: limits.py
    "agreement": ("summary.csv", ("value", "low", "high")),  # of metrics with each other, and ...
    "eye": ("summary.csv", ("value", "low", "high")),  # ... with people: agreement.py
    "at_cost": (tradeoff.ACROSS, ("ratio", "low", "high")),  # answers of `ssrlab tradeoff`, over scenes, and ...
    "changes": (tradeoff.CHANGES, ("value", "low", "high")),  # ... what a change buys: see _change_rows()
    "over_scenes": ("over_scenes.csv", ("ratio", "low", "high")),
}
OVER_SCENES = ("at_cost", "over_scenes")  # whose cells are means over scenes already
NOT_SHARES = ("fetches", "fetches: median", "fetches: 90 %", "fetches: most", "distance_error")  # of hits.csv; all its other quantities are
NAMING = ("shot", "frame", "technique", "point", "against", "against_technique", "against_point", "target", "metric", "mask", "stage", "quantity", "clock", "chip", "shader", "pipeline")
GROUPS = {  # what rows, columns and means are by, beside the columns of a file
    "group": lambda results, row: results.point_group(row.get("technique"), row.get("point")),
    "shot_group": lambda results, row: results.shot_group(row.get("shot")),
}


def _change_rows(rows):
    """For each change over scenes, one row for each quantity: how much the error grows, and what that costs."""
    for row in rows:
        if row["shot"]:
            continue
        for quantity, column in (("error", "error_ratio"), ("cost", "cost"), ("cost per % of error", "cost_per_percent")):
            ends = column.replace("_ratio", "")
            yield row | {"quantity": quantity, "value": row[column], "low": row[ends + "_low"], "high": row[ends + "_high"]}


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


COMPILED_TEXTS = ("driver", "limit", "hash", "refusal")  # of compiled.csv, beside what names its rows


def _compiled_rows(rows):
    """A row for each number that compiled.csv has, named by `quantity`."""
    for row in rows:
        for quantity, value in row.items():
            if value and not row["refusal"] and quantity not in NAMING + COMPILED_TEXTS:
                yield row | {"quantity": quantity, "value": value}


ESTIMATE_TEXTS = ("driver", "product", "bound", "refusal")  # of estimates.csv, beside what names its rows
LANE_SHARES = ("active_lanes", "unmatched", "cut_lanes")
TIME = "microseconds"  # which alone has an interval there, and is above 0


def _estimate_rows(rows):
    """A row for each number that estimates.csv has, named by `quantity`."""
    for row in rows:
        for quantity, value in row.items():
            if value and quantity not in (*NAMING, *ESTIMATE_TEXTS, "low", "high", "model_low", "model_high"):
                yield row | {"quantity": quantity, "value": value} | ({} if quantity == TIME else {"low": "", "high": ""})


class Table:
    """One entry of "tables", checked by ssrlab when it read the config."""

    def __init__(self, entry):
        if entry["of"] not in SOURCES:
            raise ResultsError(f"table '{entry['name']}': 'of' must be one of {', '.join(SOURCES)}, not {entry['of']}")
        self.name, self.caption, self.of = entry["name"], entry["caption"], entry["of"]
        self.where = {k: v if isinstance(v, list) else [v] for k, v in entry.get("where", {}).items()}
        self.rows, self.columns = (v if isinstance(v, list) else [v] for v in (entry["rows"], entry["columns"]))
        self.over, self.sort, self.best, self.labels = entry.get("over"), entry.get("sort"), entry.get("best"), entry.get("labels", {})


class Selection:
    """The rows of a results folder that make a table, and their names in it."""

    def __init__(self, results, table):
        self.table, self.results = table, results
        self.shots = results.manifest["shots"]
        proofs = results.manifest.get("clock", {}).get("proofs", [])
        self.proven = {shot for proof in proofs if proof["verdict"] == "passed" for shot in proof["shots"]}
        hosts = {load["shot"]: load.get("host", {}).get("name") for load in results.manifest.get("clock", {}).get("load", [])}
        self.hosts = hosts if len(set(hosts.values())) > 1 else {}  # by shot, where times are of several machines
        self.parameters = {(v["technique"], v["point"]): v.get("parameters", {}) for v in results.manifest["techniques"]}
        if table.of in ("at_cost", "changes"):
            tradeoff.require_primary(results, SOURCES[table.of][0])
        rows = results.read_csv(SOURCES[table.of][0])
        if table.of == "at_cost" and "group" not in (*table.where, *table.rows, *table.columns):
            rows = [r for r in rows if not r["group"]]
        if table.of == "changes":
            rows = list(_change_rows(rows))
        if table.of == "compiled":
            rows = list(_compiled_rows(rows))
        if table.of == "estimates":
            rows = list(_estimate_rows(rows))
        if table.of == "splits":
            rows = list(_split_rows(rows))
        if table.of in ("results", "variance", "limits", "agreement", "eye"):
            rows = representative_rows(rows)
        if table.of == "hits":
            last = {s["shot"]: str(s["frame"]) for s in self.shots if "frame" in s}
            rows = [r for r in rows if r["frame"] == last.get(r["shot"], r["frame"])]
        self.rows = [r for r in rows if all(self._is_inside(r, k) for k in table.where)]
        if table.of == "limits":
            self.rows = list(limits.limit_rows(self.rows, self.shots))
        if table.of == "variance":
            self.rows = list(self._variance_rows())
        if table.of == "agreement":
            self.rows = list(agreement.agreement_rows(results, self.rows))
        if table.of == "eye":
            self.rows = list(agreement.eye_rows(results, self.rows, agreement.read_judgements()))
        if not self.rows:
            raise ResultsError(f"table '{table.name}': {SOURCES[table.of][0]} has no row where {json.dumps(table.where)}")
        self.disturbed = {_timed(r): number(r, "disturbed_share") for r in results.times} if "time" in table.of else {}

    def entry(self, row, key):
        """The row's value for a key: a column of the file, the group of its point or shot, else a parameter of its point."""
        if key in row:
            return row[key]
        if key in GROUPS:
            return GROUPS[key](self.results, row)
        value = self.parameters.get((row.get("technique"), row.get("point")), {}).get(key)
        return value if value is None or isinstance(value, str) else json.dumps(value)

    def _variance_rows(self):
        """A row for each shot and `part`: the two parameters that `where` names, and "both together"."""
        names = [k for k in self.table.where if k not in self.rows[0]]
        if len(names) != 2:
            raise ResultsError(f"table '{self.table.name}': 'where' must name two parameters, whose values are all combined, not {', '.join(names) or 'none'}")
        errors = {}
        for row in self.rows:
            pair = tuple(self.entry(row, name) for name in names)
            errors.setdefault(row["shot"], {}).setdefault(pair, {})[row["seed"]] = number(row, "value")
        for shot, values in errors.items():
            if any(not v for by_seed in values.values() for v in by_seed.values()):
                continue  # nothing reflects, or somebody is exact
            pairs = {pair: {seed: math.log(v) for seed, v in by_seed.items()} for pair, by_seed in values.items()}
            for part, value in variance_shares.variance_parts(pairs).items():
                yield {"shot": shot, "part": dict(zip(variance_shares.KINDS, (*names, "both together")))[part], "value": repr(value), "low": "", "high": ""}

    def _is_inside(self, row, key):
        listed = [v if isinstance(v, str) else json.dumps(v) for v in self.table.where[key]]
        left_out = [v[1:] for v in listed if v.startswith("!")]
        value = self.entry(row, key)
        return value not in left_out and (value in listed or len(left_out) == len(listed))

    def label(self, row, keys):
        """The name of a row along an axis: "parameter = value" for parameters, the value alone for columns of the file, display names of
        points and shots."""
        own = self.results.own_label(row.get("technique"), row.get("point")) if "point" in keys else None
        words = []
        for key in keys:
            value = self.entry(row, key)
            if value is None or own and key == "technique":
                continue
            text = value if key in row or key in GROUPS else f"{key} = {value}"
            if key == "point" and own:
                text = own
            elif key == "shot":
                text = self.results.shot_label(value)
            words.append(self.table.labels.get(text, text))
        return ", ".join(word for word in words if word)

    def texts(self, row, keys):
        """The names of a row along an axis, one for each key; without "parameter = ", as the key already says it."""
        every = ((key, self.label(row, [key])) for key in keys)
        return [text.removeprefix(f"{key} = ") for key, text in every]

    def place(self, row, keys):
        """The row's place in the order of the values that the table's `where` lists; equal for all others."""
        listed = self.table.where
        return [listed[k].index(self.entry(row, k)) if k in listed and self.entry(row, k) in listed[k] else 0 for k in keys]


def _timed(row, against=""):
    """Names a row of time_summary.csv; with the prefix "against_" the other point of time_effects.csv."""
    return tuple(row.get(key) for key in ("shot", against + "technique", against + "point", "stage"))


def _cell(selection, row, name):
    table = selection.table
    if table.of in ("costs", "compiled"):
        return Cell(table.name, *name, whole(row, "value"), interval=COUNTED if table.of == "costs" else EXACT)
    columns = SOURCES[table.of][1] or ("value", "low", "high")
    if table.of == "time_effects" and row["verdict"]:
        columns = SOURCES["effects"][1]  # of totals, which have verdicts: the interval that agrees with it
    value, low, high = (number(row, c) for c in columns)
    is_share = table.of == "hits" and row["quantity"] not in NOT_SHARES or table.of == "estimates" and row["quantity"] in LANE_SHARES
    if is_share:
        low, high = (None if end is None else min(max(end, 0.0), 1.0) for end in (low, high))
    seeds = whole(row, "seeds") if "seeds" in row else None
    shares = [selection.disturbed.get(key) for key in (_timed(row), _timed(row, "against_"))]
    return Cell(
        table.name,
        *name,
        value,
        low,
        high,
        is_significant=row.get("verdict") in ("less", "more"),
        seeds=seeds,
        interval=row.get("interval") or None,
        mean_of=whole(row, "scenes") if table.of in OVER_SCENES else None,
        clock=_clock(selection, row) if row.get("clock") else None,
        disturbed_share=largest(shares),
        is_share=is_share,
        may_be_zero=table.of == "hits" or table.of == "estimates" and row["quantity"] != TIME,
    )


def _refuse_shared(selection, name, rows):
    """Fails if rows of one cell differ in anything but what the mean is over: a mean of two masks of one shot is not a mean over shots."""
    table = selection.table
    file, place = SOURCES[table.of][0], f"({name[0]}; {name[1]})"
    if table.over is None:
        if len(rows) > 1:
            raise ResultsError(
                f"table '{table.name}': {len(rows)} rows of {file} fall on one cell {place}; "
                "narrow it with 'where', distinguish them by 'rows' or 'columns', or name what the mean is 'over'"
            )
        return
    seen = {}
    for row in rows:
        part = selection.entry(row, table.over)
        if part is None:
            raise ResultsError(f"table '{table.name}': 'over' = \"{table.over}\" is neither a column of {file} nor a parameter of all points")
        if part in seen:
            first = seen[part]
            differing = [f"{k} ({first[k]}, {row[k]})" for k in NAMING if k in row and first[k] != row[k]]
            raise ResultsError(
                f"table '{table.name}': the cell {place} has two rows of {file} with {table.over} = {part}, which differ in "
                f"{', '.join(differing) or 'nothing that names them'}; narrow it with 'where', or distinguish them by 'rows' or 'columns'"
            )
        seen[part] = row


def _clock(selection, row):
    """The row's clock, with what matters for believing its times: whether the timer was validated, and its machine if others were timed
    elsewhere."""
    clock = row["clock"] + (f" of {host}" if (host := selection.hosts.get(row["shot"])) else "")
    return clock if row["shot"] in selection.proven else f"{clock} (timer not validated)"


def _most_parts(selection):
    """The largest number of parts that a cell's mean can have; columns by groups of shots have their own group alone."""
    parts = {}
    for row in selection.rows:
        name = tuple(selection.label(row, keys) for keys in (selection.table.rows, selection.table.columns))
        parts.setdefault(name, set()).add(selection.entry(row, selection.table.over))
    return max(map(len, parts.values()))


def _about(selection, filled):
    """Text about a table beside its cells; `filled`: the rows with a value."""
    table, over = selection.table, selection.table.over
    if table.of in OVER_SCENES:
        over, count = "scene", len({s["scene"] for s in selection.shots})
        if "group" in (*table.rows, *table.columns) and all(r["scenes"] == r["of_scenes"] for r in filled):
            count = None  # each cell has all scenes of its group
    else:
        count = _most_parts(selection) if over else None
    shots = [s for s in selection.shots if any(r.get("shot") in (None, "", s["shot"]) for r in filled)]  # without one: over all
    return {
        "name": table.name,
        "caption": table.caption,
        "rows": table.rows,
        "columns": table.columns,
        "shots": [s["shot"] for s in shots],
        "resolutions": sorted({f"{s['width']}x{s['height']}" for s in shots}),
        "over": over,
        "over_count": count,
        "clocks": sorted({_clock(selection, r) for r in filled if r.get("clock")}),
        "has_adjusted_intervals": table.of == "effects",
        "is_estimated": table.of == "estimates",
        "compilers": sorted({r["driver"] for r in filled if r.get("driver")}),
        "sample": ASSETS if over in SAMPLED else None,
        "texts_of_rows": {selection.label(r, table.rows): selection.texts(r, table.rows) for r in reversed(selection.rows)},
        "assets": {selection.label(s, table.rows): selection.results.asset(s["shot"]) for s in shots} if table.rows == ["shot"] else None,
    }


def _mark_best(selection, cells, rows_of):
    """Gives cells the standing that ssrlab decided among all points of their shot (summary.csv)."""
    axis = "column" if selection.table.best == "column" else "row"
    metrics_of = {}
    for c in cells:
        rows = rows_of[c.row, c.column]
        metrics_of.setdefault(getattr(c, axis), set()).update(row["metric"] for row in rows)
        c.standing = rows[0]["standing"] if rows[0]["standing"] in (BEST, *LIKE_BEST) else None
    for name, metrics in metrics_of.items():
        if len(metrics) > 1:
            raise ResultsError(f"table '{selection.table.name}': {axis} '{name}' has no best: its cells are of {', '.join(sorted(metrics))}")


def cells_of(results, table):
    """(text about the table, all of its cells row by row)."""
    selection = Selection(results, table)
    groups = {}
    axes = [table.rows, table.columns]
    for row in sorted(selection.rows, key=lambda r: [selection.place(r, keys) for keys in axes]):  # stable
        groups.setdefault(tuple(selection.label(row, keys) for keys in axes), []).append(row)
    cells, filled = [], []
    for name, rows in groups.items():
        _refuse_shared(selection, name, rows)
        parts = [_cell(selection, row, name) for row in rows]
        filled += [row for row, part in zip(rows, parts) if part.value is not None]
        cells.append(parts[0] if table.over is None else mean(table, parts, [results.asset(row.get("shot")) for row in rows]))
    if table.best:
        _mark_best(selection, cells, groups)
    return _about(selection, filled), _sorted(cells, table.sort)


def _sorted(cells, column):
    rows = list(dict.fromkeys(c.row for c in cells))
    if column is not None:
        values = {c.row: c.value for c in cells if c.column == column and c.value is not None}
        rows.sort(key=lambda r: values.get(r, math.inf))
    return sorted(cells, key=lambda c: rows.index(c.row))
