"""The summary of a study that is committed: the cells of its tables as tidy CSV, and what they were made with."""

import csv
import io
import json
import os
from dataclasses import fields

from paper_figures.results import ResultsError
from paper_tables.cells import Cell

MOST_BYTES = 100_000
COLUMNS = [f.name for f in fields(Cell)]
MARK = "# "


def _resolutions(manifest):
    return sorted({f"{s['width']}x{s['height']}" for s in manifest["shots"]})


def origin(manifest):
    """What tells where the numbers come from. Fails where cells were made by programs whose estimators differ."""
    makers = manifest["provenance"]
    programs = [m["ssrlab"] for m in makers]
    estimators = sorted({p["estimators"] for p in programs})
    if len(estimators) > 1:
        raise ResultsError(f"its cells were made with estimators {estimators}, which give other numbers; run the study again")
    commits = (p["commit"] + (" with changes" if p.get("dirty") else "") for p in programs)
    return {
        "study": manifest["study"]["config"],
        "title": manifest.get("title", ""),
        "commit": " and ".join(dict.fromkeys(commits)),
        "code": " ".join(dict.fromkeys(p["code"] for p in programs)),
        "estimators": estimators[0],
        "finished": max(m["finished"] for m in makers),
        "device": " and ".join(dict.fromkeys(m["device"]["name"] for m in makers)),
        "resolutions": _resolutions(manifest),
        "shots": len(manifest["shots"]),
    }


def write(file, origin_of_all, tables, cells):
    """`tables`: entries of the config; `cells`: of all of them. Fails if the file would be too large to be committed."""
    out = io.StringIO()
    for key, value in origin_of_all.items():
        out.write(f"{MARK}{key}: {json.dumps(value)}\n")
    for table in tables:
        out.write(f"{MARK}table: {json.dumps({k: table[k] for k in ('name', 'caption')})}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for cell in cells:
        values = [getattr(cell, c) for c in COLUMNS]
        writer.writerow(
            ["" if v is None else int(v) if isinstance(v, bool) else f"{v:.6g}" if isinstance(v, float) else v for v in values]
        )
    text = out.getvalue()
    if len(text.encode()) > MOST_BYTES:
        raise ResultsError(
            f"{file}: the tables take {len(text.encode())} bytes, but at most {MOST_BYTES} may be kept: narrow them by 'where'"
        )
    os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
    with open(file + ".tmp", "w", encoding="utf-8") as stream:
        stream.write(text)
    os.replace(file + ".tmp", file)


def _cell(row):
    def number(name):
        return float(row[name]) if row[name] else None

    return Cell(
        row["table"],
        row["row"],
        row["column"],
        *(number(n) for n in ("value", "low", "high", "least", "most")),
        is_significant=row["is_significant"] == "1",
        seeds=int(row["seeds"]) if row["seeds"] else None,
    )


def read(file):
    """(origin, {table's name: (its entry, its cells)})."""
    try:
        with open(file, encoding="utf-8", newline="") as stream:
            lines = stream.read().splitlines(keepends=True)
    except OSError as e:
        raise ResultsError(f"cannot read {file}: {e.strerror}") from e
    head = [line[len(MARK) :].rstrip("\n").split(": ", 1) for line in lines if line.startswith(MARK)]
    try:
        tables = {t["name"]: (t, []) for t in (json.loads(value) for key, value in head if key == "table")}
        for row in csv.DictReader(line for line in lines if not line.startswith(MARK)):
            tables[row["table"]][1].append(_cell(row))
        return {key: json.loads(value) for key, value in head if key != "table"}, tables
    except (KeyError, ValueError) as e:
        raise ResultsError(f"{file} is not a summary that `ssrlab tables` wrote: {e}") from e


def made_from(origin_of_all, cells):
    """The line below a table: command, commit, size, seeds, and what brackets mean."""
    seeds = sorted({c.seeds for c in cells if c.seeds})
    counted = "" if not seeds else f", {seeds[0]} seeds" if len(seeds) == 1 else f", {seeds[0]} to {seeds[-1]} seeds"
    ranges = "; in parentheses the range over shots" if any(c.least is not None for c in cells) else ""
    bold = "; bold: told from 1 by Holm's test at 0.05" if any(c.is_significant for c in cells) else ""
    sizes = " and ".join(origin_of_all["resolutions"])
    return (
        f"`ssrlab run {origin_of_all['study']}`: commit {origin_of_all['commit']}, {origin_of_all['shots']} shots at {sizes}{counted}, "
        f"{origin_of_all['device']}. In brackets 95 % intervals{ranges}{bold}."
    )
