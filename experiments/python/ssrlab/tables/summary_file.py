"""The committed summary of a study: the cells of its tables as tidy CSV, and what made them."""

import functools
import io
import json
import re
from dataclasses import fields

from ssrlab.csv_files import number, parse_rows, whole, write_lines
from ssrlab.json_files import parse_json
from ssrlab.mistakes import ResultsError, counted
from ssrlab.text_files import read_text, write_text
from ssrlab.results import commits_of, programs_of
from ssrlab.tables.cell import Cell

MOST_BYTES = 180_000  # what the comparison of 22 points over 49 shots (experiments/studies/configs/comparison.json) takes
MOST_NAMED = 8  # shots below a table that does not show all of the study's; the summary's head names any number
COLUMNS = [f.name for f in fields(Cell) if f.name not in ("is_share", "may_be_zero")]  # which only means ask for, before they are kept
ABOUT = ("name", "caption", "shots", "resolutions", "over", "over_count", "clocks")  # a table; see cells_of()
LATER = ("has_adjusted_intervals", "is_estimated", "sample", "assets", "compilers")  # of a table, too; summaries of before have none
MARK = "# "
# Shapes of its head, as require() of json_files.py has them.
_ANY = (str, bool, float, list, dict, None)
_ORIGIN = {"study": str, "title": str, "commit": str, "device": str, "shots": int, "estimators": int, "is_complete": bool}
_ABOUT = {
    **{"name": str, "caption": str, "shots": [str], "resolutions": [str], "over": (str, None), "over_count": (int, None), "clocks": [str]},
    **{"has_adjusted_intervals?": bool, "is_estimated?": bool, "sample?": (str, None), "assets?": ({"*": str}, None), "compilers?": [str]},
}


def _about(table):
    return {key: table[key] for key in (*ABOUT, *(k for k in LATER if k in table))}


def why_not_kept(manifest):
    """Why results cannot be committed, as a sentence, or None. They must be complete, and a commit must say how to make them again."""
    if manifest.get("is_complete") is not True:
        return "the study is not complete; run it to its end"
    programs = list(programs_of(manifest))
    if any(not p["commit"] for p in programs):
        return "its program was built without git, so that no commit is known; build it from a clone and run it again"
    if any(p.get("dirty") for p in programs):
        return "its program was built from files that no commit holds; commit, build and run it again"
    return None


def origin(manifest):
    """Where the numbers come from. Fails if cells were made by programs with different estimators."""
    makers = manifest["provenance"]
    if not makers:
        raise ResultsError("manifest.json: 'provenance' is empty, and so no program is known that made its cells; run the study again")
    programs = [m["ssrlab"] for m in makers]
    estimators = sorted({p["estimators"] for p in programs})
    if len(estimators) > 1:
        raise ResultsError(f"its cells were made with estimators {estimators}, which give other numbers; run the study again")
    return {
        "study": manifest["study"]["config"],
        "title": manifest.get("title", ""),
        "commit": commits_of(manifest),
        "code": " ".join(dict.fromkeys(p["code"] for p in programs)),
        "estimators": estimators[0],
        "finished": max(m["finished"] for m in makers),
        "device": " and ".join(dict.fromkeys(m["device"]["name"] for m in makers)),
        "shots": len(manifest["shots"]),
        "is_complete": manifest.get("is_complete") is True,
    }


def write(file, origin_of_all, tables, cells):
    """`tables`: texts about each; `cells`: of all of them. Fails if the file would be too large to commit."""
    out = io.StringIO()
    for key, value in origin_of_all.items():
        out.write(f"{MARK}{key}: {json.dumps(value)}\n")
    for table in tables:
        out.write(f"{MARK}table: {json.dumps(_about(table))}\n")
    of_cells = ([getattr(cell, c) for c in COLUMNS] for cell in cells)
    write_lines(out, [COLUMNS, *([int(v) if isinstance(v, bool) else f"{v:.6g}" if isinstance(v, float) else v for v in values] for values in of_cells)])
    text = out.getvalue()
    if len(text.encode()) > MOST_BYTES:
        raise ResultsError(
            f"{file}: the tables take {len(text.encode())} bytes, but at most {MOST_BYTES} may be kept: narrow them by 'where'"
        )
    write_text(file, text)


def _cell(row):
    return Cell(
        row["table"],
        row["row"],
        row["column"],
        *(number(row, n) for n in ("value", "low", "high", "least", "most")),
        is_significant=row["is_significant"] == "1",
        seeds=whole(row, "seeds"),
        interval=row["interval"] or None,
        mean_of=whole(row, "mean_of"),
        clock=row["clock"] or None,
        disturbed_share=number(row, "disturbed_share"),
        standing=row.get("standing") or None,
    )


def read(file):
    """(origin, {name of a table: (text about it, its cells)}), not to be changed: documents read the same file for each number."""
    return _parsed(file, read_text(file))


@functools.cache
def _parsed(file, text):
    head = re.match(f"(?:{MARK}[^\n]*\n)*", text).group().splitlines()
    entries = []
    for number_of_line, line in enumerate(head, 1):
        key, _, value = line[len(MARK) :].partition(": ")
        entries.append((key, parse_json(value, f"{file}:{number_of_line}", _ABOUT if key == "table" else _ORIGIN.get(key, _ANY))))
    tables = {t["name"]: (_about(t), []) for key, t in entries if key == "table"}
    for row in parse_rows(text.split("\n", len(head))[-1], file, first_line=1 + len(head))[1]:
        if row["table"] not in tables:
            raise ResultsError(f"{file}:{row.line}: a cell of the table '{row['table']}', of which its head says nothing")
        tables[row["table"]][1].append(_cell(row))
    return {key: value for key, value in entries if key != "table"}, tables


def made_from(origin_of_all, table, cells):
    """The line below a table: command, commit, the shots of its own cells, their sizes, seeds, device, clock and compiler of GPUs."""
    seeds = sorted({c.seeds for c in cells if c.seeds})
    of_seeds = f", {seeds[0]} to {seeds[-1]} seeds" if len(seeds) > 1 else f", {counted(seeds[0], 'seed')}" if seeds else ""
    count, whole = len(table["shots"]), origin_of_all["shots"]
    shots = counted(count, "shot")
    if count < whole:
        shots = f"{count} of the study's {whole} shots"
        if 0 < count <= MOST_NAMED:
            shots += f" ({', '.join(table['shots'])})"
    sizes = " at " + " and ".join(table["resolutions"]) if table["resolutions"] else ""
    clocks = " and ".join(table["clocks"])
    compilers = " and ".join(table.get("compilers", []))
    return (
        f"`ssrlab run {origin_of_all['study']}`{'' if origin_of_all['is_complete'] else ' (not complete)'}: "
        f"commit {origin_of_all['commit']}, {shots}{sizes}{of_seeds}, {origin_of_all['device']}{clocks and f', clock {clocks}'}{compilers and f', compiled by {compilers}'}."
    )
