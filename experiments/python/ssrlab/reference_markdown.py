"""How the pages of experiments/docs/reference are written: texts of the program, tables, links (reference_pages.py)."""

import json
import os
import re

from ssrlab.markdown_text import markdown_prose
from ssrlab.repository import ROOT

OUT = ROOT / "experiments/docs/reference"
NOTE = "<!-- Written by `python3 experiments/python reference_pages`. Change what the program declares, not this page. -->"


def prose(text):
    """A text of the program as a sentence: code in backticks stays code, and nothing else is markup. Symbols keep their case."""
    text = markdown_prose(text) if text else ""
    first = text.split(" ")[0]
    text = text[:1].upper() + text[1:] if first.isalpha() and first.islower() and (len(first) > 1 or first == "a") else text
    return text + "." if text and not text.endswith((".", "!", "?")) else text


def code(value):
    return f"`{value if isinstance(value, str) else json.dumps(value)}`"


def table(head, rows):
    """`rows`: of Markdown, whose bars may be escaped. Columns without any cell are left out, and tables without any row."""
    rows = list(rows)
    if not rows:
        return []
    used = [i for i in range(len(head)) if i == 0 or any(row[i] for row in rows)]
    lines = [[head[i] for i in used], ["---"] * len(used), *([row[i] for i in used] for row in rows)]
    return ["| " + " | ".join(cell.replace("\\|", "|").replace("|", "\\|") for cell in line) + " |" for line in lines] + [""]


def page(title, *lines):
    return "\n".join([NOTE, "", f"# {title}", "", *lines]).rstrip() + "\n"


def contents(entries):
    """Links to the sections of a page. `entries`: titles and what each section says."""
    return table(["section", "contents"], [[f"[{title}](#{re.sub(r'[^a-z0-9_ -]', '', title.lower()).replace(' ', '-')})", about] for title, about in entries])


def linked(text, name):
    """The text of a page, in which documents that are named by their paths are links with their titles."""
    def link(found):
        file = ROOT / found[1] / "README.md" if (ROOT / found[1]).is_dir() else ROOT / found[1]
        if file.suffix != ".md" or not file.exists():
            return found[0]
        return f"[{re.search('^# (.*)', file.read_text(encoding='utf-8'), re.M)[1]}]({os.path.relpath(file, (OUT / name).parent)})"

    return re.sub(r"`((?:\w+/)+[\w.]+)`", link, text)
