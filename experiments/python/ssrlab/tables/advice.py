"""advice.csv, which `ssrlab advise --keep` writes: its rows, as a table of documents and as numbers in prose."""

import os

from ssrlab.csv_files import number, read_rows
from ssrlab.figures.numbers import in_prose
from ssrlab.json_files import read_json
from ssrlab.markdown_text import markdown_text
from ssrlab.mistakes import ResultsError, counted
from ssrlab.tables.formats import NO_VALUE
from ssrlab.tables.markdown import COMMIT

NAME = "advice.csv"  # beside the folder of summaries
CERTAIN, WORSE = "best", "behind"  # standings, experiments/results/verdicts/standings.h
_STUDY = {"title": str, "config": str, "commit": str, "finished": str, "sizes": [str]}
_SOURCES = {"errors": [_STUDY], "costs": [{**_STUDY, "compilers": {"*": str}}], "points": {"*": {"*": dict}}, "rows": int}


class Advice:
    """The table and what it rests on."""

    def __init__(self, summaries):
        self.file = os.path.join(os.path.dirname(summaries), NAME)
        _, self.rows = read_rows(self.file)
        self.sources = read_json(os.path.splitext(self.file)[0] + ".json", _SOURCES)
        if self.sources["rows"] != len(self.rows):
            raise ResultsError(f"{self.file} has {counted(len(self.rows), 'row')}, not {self.sources['rows']}; make it again with `ssrlab advise --keep`")

    def of(self, chip, surface="all"):
        found = [r for r in self.rows if r["chip"] == chip and r["surface"] == surface]
        if not found:
            raise ResultsError(f"{self.file} has no rows of chip '{chip}' and surface '{surface}'")
        return found

    def ranked(self, chip, ms, kind, surface="all"):
        """Rows of a budget and kind ("rooms, in motion"), by rank; those without a rank are left out."""
        found = [r for r in self.of(chip, surface) if number(r, "ms") == ms and kind_of(r) == kind and r["rank"]]
        return sorted(found, key=lambda r: number(r, "rank"))

    def text(self, what, chip, ms, kind, surface="all", rank=1):
        """A number in prose of the technique of this rank: "label", "ratio", "chance" or "ms"."""
        found = self.ranked(chip, ms, kind, surface)
        if len(found) < rank:
            raise ResultsError(f"{self.file} has no rank {rank} for {chip}, {ms} ms, {kind}, {surface}")
        row = found[rank - 1]
        return {"label": markdown_text(row["label"]), "ratio": ratio(row), "chance": chance(row), "ms": milliseconds(row)}[what]

    def made(self):
        """The day on which the last study ended, and the commits of all: as when_made() of documents.py has them."""
        studies = [*self.sources["errors"], *self.sources["costs"]]
        return max(s["finished"] for s in studies), [commit for s in studies for commit in s["commit"].split(" and ")]


def kind_of(row):
    return f"{row['place']}, {row['movement']}"


def ratio(row):
    return in_prose(number(row, "ratio"), number(row, "low"), number(row, "high"))


def chance(row):
    """As probability_text() of core/number_text.h."""
    if not row["chance_first"]:
        return NO_VALUE
    p = number(row, "chance_first")
    return "below 0.01" if p < 0.005 else "above 0.99" if p > 0.995 else f"{p:.2f}"


def milliseconds(row):
    return in_prose(*(v and v / 1000 for v in (number(row, c) for c in ("us", "us_low", "us_high")))) if row["us"] else NO_VALUE


def _line(chip, ms, kind, ranked):
    head = [chip, f"{ms:g} ms", kind]
    first = next(iter(ranked), None)
    if not first or number(first, "ratio") >= 1:
        return [*head, "nothing that fits helps", *[NO_VALUE] * 4]
    second = NO_VALUE
    if len(ranked) > 1:
        second = f"{markdown_text(ranked[1]['label'])}: {ratio(ranked[1])}" + (", certainly worse" if ranked[1]["standing"] == WORSE else "")
    name = markdown_text(first["label"])
    return [*head, f"**{name}**" if first["standing"] == CERTAIN else name, ratio(first), chance(first), milliseconds(first), second]


def _study(study):
    return f"`{study['config']}` ({' and '.join(study['sizes'])}, commit {COMMIT.sub(lambda m: m[1], study['commit'])})"


def table(advice, chip, surface):
    """The technique of least error for each budget and kind, as Markdown."""
    rows = advice.of(chip, surface)
    budgets = sorted({number(r, "ms") for r in rows if r["ms"]})
    kinds = sorted({kind_of(r) for r in rows})
    lines = [["chip", "within", "kind of picture", "least error", "FLIP / `none`", "probability to be best", "ms, estimated", "second"]]
    lines += [_line(chip, ms, kind, advice.ranked(chip, ms, kind, surface)) for ms in budgets for kind in kinds]
    costs = next(study for study in advice.sources["costs"] if chip in study["compilers"])
    footer = (
        f"`ssrlab advise --chip {chip}`: errors of {', '.join(map(_study, advice.sources['errors']))}; times of {_study(costs)}, "
        f"estimated with {markdown_text(costs['compilers'][chip])}. In brackets 95 % intervals over scenes and places like these; bold: certainly best; {NO_VALUE}: no value."
    )
    head, *body = ("| " + " | ".join(line) + " |" for line in lines)
    return "\n".join([head, "|" + "---|" * 8, *body]) + f"\n\n{footer}\n"
