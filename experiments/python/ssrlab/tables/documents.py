"""Tables within Markdown files: between `<!-- table STUDY NAME -->` and `<!-- end of table -->`, made from the committed
summary of the study. `<!-- table STUDY NAME {"rows": [...], "columns": [...], "caption": "..."} -->` shows an excerpt: the
named rows and columns in that order (all, where a key is left out). `<!-- advice CHIP SURFACE -->` shows what advice.csv has of a chip and surface.

Numbers and names in prose are made in the same way: `<!--=NAME-->0.18<!--/-->`, where `PAGE.numbers.json` beside the page gives each NAME its
expression (`<!--=PAGE.md#NAME-->`: that of another page): cell(), cells(), shown(), most(), first(), shots(), rank_correlation(), halving(), share_of_variance(),
over_scenes() and p_holm() of kept tables (Numbers), ratios(), number(value), fixed(value, places),
advised() of advice.csv, span(values, places), min, max, sum, len, zip and abs. `<!--=made PAGE.md-->` stands for the day and the commits of the studies whose tables PAGE has,
as two cells of a table."""

import math
import os
import re

from ssrlab import statistics
from ssrlab.json_files import parse_json, read_json
from ssrlab.mistakes import ResultsError
from ssrlab.text_files import path_inside, read_text
from ssrlab.figures.numbers import in_prose
from ssrlab.tables import advice, formats, summary_file
from ssrlab.tables.agreement import kendall_tau
from ssrlab.tables.halving import halving_share
from ssrlab.tables.variance_shares import share_of_total
from ssrlab.tables.markdown import markdown

BLOCK = re.compile(r"(?P<head><!-- table (?P<study>\S+) (?P<name>\S+)(?: (?P<excerpt>\{[^\n]*\}))? -->\n)(?P<text>.*?)(?P<end><!-- end of table -->)", re.DOTALL)
ADVICE = re.compile(r"(?P<head><!-- advice (?P<chip>\S+) (?P<surface>\S+) -->\n)(?P<text>.*?)(?P<end><!-- end of table -->)", re.DOTALL)


NUMBER = re.compile(r"(?P<head><!--=\s*(?P<name>[^\n]*?)\s*-->)(?P<text>[^\n]*?)(?P<end><!--/-->)")


class Numbers:
    """The names that expressions in prose may use. A table has the name of its study's summary and its own."""

    def __init__(self, summaries, file):
        self.file = file
        self._summaries = summaries

    def _table(self, study, table):
        """(text about it, its cells with a value)"""
        _, tables = summary_file.read(path_inside(self._summaries, study + ".csv"))
        if table not in tables:
            raise ResultsError(f"{self.file}: {study} has no table '{table}'; it has: {', '.join(tables)}")
        about, cells = tables[table]
        return about, [c for c in cells if c.value is not None]

    def _found(self, study, table, rows, columns):
        """The cells of the named rows and columns (None: all); a name that is no row's matches the names with all of its whole words."""
        _, found = self._table(study, table)
        for of, words in (("row", rows), ("column", columns)):
            words = [words] if isinstance(words, str) else words or []
            named = [c for c in found if [getattr(c, of)] == words]
            holds = lambda name: all(re.search(rf"(?<!\w){re.escape(w)}(?!\w)", name) for w in words)  # noqa: B023, E731
            found = named or [c for c in found if holds(getattr(c, of))]
        return found

    def _one(self, study, table, row, column):
        found = self._found(study, table, row, column)
        if len(found) != 1:
            raise ResultsError(f"{self.file}: {len(found)} cells of {study} {table} are of '{row}' and '{column}'; one was meant")
        return found[0]

    def cells(self, study, table, rows=None, columns=None, with_interval=False):
        """The values of a kept table's cells that have one (and, if asked, an interval)."""
        return [c.value for c in self._found(study, table, rows, columns) if c.low is not None or not with_interval]

    def cell(self, study, table, row, column):
        """The only value of a row and a column."""
        return self._one(study, table, row, column).value

    def shown(self, study, table, row, column):
        """cell() with its interval, as text."""
        cell = self._one(study, table, row, column)
        return in_prose(cell.value, cell.low, cell.high) if formats.has_interval(cell) else in_prose(cell.value)

    def ratios(self, study, table, row, base):
        """One row / another, in each column where both have a value."""
        of = {c.column: c.value for c in self._found(study, table, base, None)}
        return [c.value / of[c.column] for c in self._found(study, table, row, None) if c.column in of]

    def most(self, study, table, row, column):
        """The largest value among the shots of a mean."""
        return self._one(study, table, row, column).most

    def first(self, study, table, row=None, column=None, without=()):
        """The name with the least value: among the columns of a row, or the rows of a column. `without`: names that do not compete."""
        of = "column" if row else "row"
        found = [c for c in self._found(study, table, row, column) if getattr(c, of) not in without]
        if not found or len({getattr(c, of) for c in found}) < len(found):
            raise ResultsError(f"{self.file}: '{row or column}' is not one line of {study} {table}")
        return getattr(min(found, key=lambda c: c.value), of)

    def rank_correlation(self, first, second):
        """Kendall's rank correlation of two columns, each (study, table, column), over the rows that both have."""
        columns = [{c.row: c.value for c in self._found(study, table, None, column)} for study, table, column in (first, second)]
        rows = [row for row in columns[0] if row in columns[1]]
        return kendall_tau(*([column[row] for row in rows] for column in columns))

    def shots(self, study, table):
        return self._table(study, table)[0]["shots"]

    def ratio_over_scenes(self, study, table, column, base, as_in=None, without=()):
        """(mean, low, high) of one column / another, for a table with shots as rows, over scenes like these: a geometric mean, scenes of
        one asset averaged first. `as_in`: uses only the shots of this table of the study; `without`: assets that are left out."""
        about, cells = self._table(study, table)
        values = {(c.row, c.column): c.value for c in cells if c.value}
        rows = self.shots(study, as_in) if as_in else dict.fromkeys(c.row for c in cells)  # shots, by their display names
        unknown = sorted(set(without) - set(about["assets"].values()))
        if unknown:
            raise ResultsError(f"{self.file}: no shot of {study} {table} is of '{unknown[0]}'")
        shots = [s for s in rows if (s, column) in values and (s, base) in values and about["assets"][s] not in without]
        if not shots:
            raise ResultsError(f"{self.file}: no shot of {study} {table} has both '{column}' and '{base}'")
        return statistics.geometric_mean_over_scenes([(about["assets"][s], math.log(values[s, column] / values[s, base])) for s in shots])[:3]

    def over_scenes(self, *chosen, **options):
        """ratio_over_scenes() as text: "mean [low, high]"."""
        return in_prose(*self.ratio_over_scenes(*chosen, **options))

    def p_holm(self, study, table, row, column):
        """The p of "no effect" of a row, adjusted (Holm) for all rows with an interval. The table's rows are effects. Its columns hold
        Student's intervals of ratios over shots of one scene each (n - 2 degrees of freedom)."""
        about, cells = self._table(study, table)
        family = [c for c in cells if c.column == column and c.low]
        rows = [c.row for c in family]
        if rows.count(row) != 1:
            raise ResultsError(f"{self.file}: {study} {table} has no interval of '{row}' and '{column}'")
        effects = [(math.log(c.value), (math.log(c.high) - math.log(c.low)) / 2) for c in family]
        return statistics.p_holm(effects, len(about["shots"]) - 2)[rows.index(row)]

    def halving_share(self, study, table, march, exact, answered):
        """(share, low, high) in percent: the share of exact rays that goes half of the way to the error of exact rays alone. The table has
        errors, with shots as rows. Columns: no exact rays, exact rays alone, and shares, whose names are `answered` followed by the
        share."""
        about, cells = self._table(study, table)
        values = {(c.row, c.column): c.value for c in cells}
        points = {0.0: march, 1.0: exact} | {float(c.column.removeprefix(answered)): c.column for c in cells if c.column.startswith(answered)}
        if len(points) < 4:
            raise ResultsError(f"{self.file}: {study} {table} has {len(points) - 2} columns that begin with '{answered}'")
        curves = [(about["assets"][s], {k: values[s, point] for k, point in points.items()}) for s in dict.fromkeys(c.row for c in cells)]
        return tuple(v if v is None else 100 * v for v in halving_share(curves))

    def halving(self, *chosen):
        """halving_share() as text: "share [low, high]"."""
        share, *ends = (v if v is None else "0" if v == 0 else f"{v:.1f}" if v < 10 else f"{v:.0f}" for v in self.halving_share(*chosen))
        return share if None in ends else f"{share} [{', '.join(ends)}]"

    def share_of_variance(self, study, table, part):
        """"share [low, high]" in percent: the part's share of the variance of ln error, over scenes. For a table of `variance` with shots
        as rows and parts as columns."""
        about, cells = self._table(study, table)
        shots = list(dict.fromkeys(c.row for c in cells))
        values = {(c.row, c.column): c.value for c in cells}
        columns = list(dict.fromkeys(c.column for c in cells))
        totals = [(about["assets"][shot], sum(values[shot, column] for column in columns)) for shot in shots]
        share, *ends = (v if v is None else f"{100 * v:.0f}" for v in share_of_total([(about["assets"][shot], values[shot, part]) for shot in shots], totals))
        return share if None in ends else f"{share} [{', '.join(ends)}]"

    def advised(self, what, *question, **options):
        """The "label", "ratio", "chance" or "ms" of a rank of advice.csv, as advice.Advice.text() has them."""
        return advice.Advice(self._summaries).text(what, *question, **options)

    def text(self, expression):
        names = {"cell": self.cell, "cells": self.cells, "shown": self.shown, "most": self.most, "first": self.first, "shots": self.shots, "rank_correlation": self.rank_correlation, "halving": self.halving, "over_scenes": self.over_scenes, "p_holm": self.p_holm, "share_of_variance": self.share_of_variance}
        names |= {"advised": self.advised, "ratios": self.ratios, "number": in_prose, "fixed": lambda value, places: f"{value:.{places}f}"}
        names["span"] = lambda values, places=2: f"{min(values):.{places}f} to {max(values):.{places}f}"
        names |= {"min": min, "max": max, "sum": sum, "len": len, "zip": zip, "abs": abs}
        try:
            return str(eval(expression, {"__builtins__": {}} | names))  # of our own documents
        except (SyntaxError, NameError, KeyError, TypeError, ValueError, ZeroDivisionError) as e:
            raise ResultsError(f"{self.file}: `{expression}` makes no number: {e}") from e


def markdown_files(root):
    """All Markdown files of the source tree, without build folders and hidden folders."""
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(f for f in folders if not f.startswith(".") and not f.startswith("build") and f != "results")
        yield from (os.path.join(folder, name) for name in sorted(names) if name.endswith(".md"))


def _excerpt(table, cells, text, where):
    wanted = parse_json(text, where, {"rows?": [str], "columns?": [str], "caption?": str})
    unknown = sorted(set(wanted) - {"rows", "columns", "caption"})
    if unknown:
        raise ResultsError(f"{where}: unknown key '{unknown[0]}' of an excerpt; known are rows, columns, caption")
    for key, of in (("rows", "row"), ("columns", "column")):
        names = wanted.get(key)
        if names is None:
            continue
        found = {getattr(c, of) for c in cells}
        missing = [n for n in names if n not in found]
        if missing:
            raise ResultsError(f"{where}: it has no {of} '{missing[0]}'; it has: {', '.join(sorted(found))}")
        cells = sorted((c for c in cells if getattr(c, of) in names), key=lambda c: names.index(getattr(c, of)))
    return table | {"caption": wanted.get("caption", table["caption"])}, cells


def numbers_file(file):
    """The file beside a page with the expressions of its numbers."""
    return os.path.splitext(file)[0] + ".numbers.json"


def expressions_of(file):
    return read_json(numbers_file(file), {"*": str}) if os.path.exists(numbers_file(file)) else {}


def when_made(page, summaries):
    """The day on which the last of the studies ended whose tables a page has, and the commits that made them: "2026-11-23 | `5af6c5ddfb`"."""
    studies = dict.fromkeys(block["study"] for block in BLOCK.finditer(read_text(page)))
    origins = [summary_file.read(path_inside(summaries, study + ".csv", page))[0] for study in studies]
    ends, commits = [origin["finished"] for origin in origins], [commit for origin in origins for commit in origin["commit"].split(" and ")]
    if ADVICE.search(read_text(page)):
        end, of_advice = advice.Advice(summaries).made()
        ends, commits = [*ends, end], [*commits, *of_advice]
    if not ends:
        raise ResultsError(f"{page}: it has no tables, so that no day is known")
    return f"{max(ends)[:10]} | {', '.join(f'`{commit[:10]}`' for commit in dict.fromkeys(commits))}"


def filled(text, summaries, file):
    """The text with each table and each number in prose made anew. Fails on one that no summary holds."""

    def made(block):
        path = path_inside(summaries, block["study"] + ".csv", file)
        origin, tables = summary_file.read(path)
        if block["name"] not in tables:
            raise ResultsError(f"{file}: {path} has no table '{block['name']}'; it has: {', '.join(tables)}")
        table, cells = tables[block["name"]]
        if block["excerpt"]:
            table, cells = _excerpt(table, cells, block["excerpt"], f"{file}: table {block['name']}")
        return block["head"] + markdown(table, cells, summary_file.made_from(origin, table, cells)) + block["end"]

    def advised(block):
        return block["head"] + advice.table(advice.Advice(summaries), block["chip"], block["surface"]) + block["end"]

    def said(number):
        if number["name"].startswith("made "):
            page = path_inside(os.path.dirname(file), number["name"].removeprefix("made "), file)
            return number["head"] + when_made(page, summaries) + number["end"]
        page, _, name = number["name"].rpartition("#")
        of = os.path.normpath(os.path.join(os.path.dirname(file), page)) if page else file
        expressions = expressions_of(of)
        if name not in expressions:
            raise ResultsError(f"{file}: no number '{name}'; {numbers_file(of)} has: {', '.join(expressions) or 'none'}")
        return number["head"] + Numbers(summaries, of).text(expressions[name]) + number["end"]

    new = NUMBER.sub(said, ADVICE.sub(advised, BLOCK.sub(made, text)))
    unused = sorted(set(expressions_of(file)) - {n["name"] for n in NUMBER.finditer(text)})
    if unused:
        raise ResultsError(f"{numbers_file(file)}: the page says '{unused[0]}' nowhere; delete its expression")
    return new


def rewrite(root, summaries):
    """Fills the tables of all documents; returns the files that changed."""
    changed = []
    for file in markdown_files(root):
        text = read_text(file)
        new = filled(text, summaries, file)
        if new != text:
            with open(file, "w", encoding="utf-8") as stream:
                stream.write(new)
            changed.append(file)
    return changed


def mistakes(root, summaries, estimators):
    """Sentences: documents that differ from the summaries, summaries whose numbers today's estimators would not give, and
    summaries that no document shows."""
    found, shown = [], set()
    for file in markdown_files(root):
        text = read_text(file)
        shown.update(block["study"] for block in BLOCK.finditer(text))
        if filled(text, summaries, file) != text:
            found.append(f"{file}: its tables or numbers differ from {summaries}; `ssrlab tables --fill` makes them anew")
    for name in sorted(os.listdir(summaries)) if os.path.isdir(summaries) else []:
        if not name.endswith(".csv"):
            continue
        origin, _ = summary_file.read(os.path.join(summaries, name))
        if origin.get("estimators") != estimators:
            found.append(
                f"{summaries}/{name}: made with estimators {origin.get('estimators')}, but today's are {estimators}; run the study "
                "again, then `ssrlab tables --keep`"
            )
        if name[: -len(".csv")] not in shown:
            found.append(f"{summaries}/{name}: no document shows any of its tables; delete it, or show them")
    return found
