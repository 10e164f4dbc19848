"""The tables of scenes/rooms.md that say what is drawn: made of densities.py and refusals.py."""
from . import densities  # noqa: F401  (it states them)
from .dice import TABLE
from .refusals import RULES


def densities_of(family):
    rows = ["| what | drawn from | unit | source |", "|---|---|---|---|"]
    return rows + [f"| {d.what} | {d.text()} |{'' if d.unit in ('', '1') else f' {d.unit}'} | {d.source} |"
                   for d in TABLE
                   if d.family == family]


def refusals():
    return ["| rule | refuses |", "|---|---|", *(f"| {rule} | {meaning} |" for rule, meaning in RULES.items())]


def filled(document):
    """The text with each table between its `<!-- densities of rooms -->` (both, streets; refusals) and the next
    `<!-- end -->`."""
    made = {f"densities of {family}": densities_of(family) for family in ("rooms", "both", "streets")}
    made["refusals"] = refusals()
    for name, rows in made.items():
        begin, end = f"<!-- {name} -->\n", "<!-- end -->"
        if begin not in document:
            continue
        before, rest = document.split(begin, 1)
        document = before + begin + "\n".join(["", *rows, "", ""]) + rest[rest.index(end):]
    return document
