"""Escapes texts of unknown authors for Markdown (CommonMark, GitHub's tables and mathematics). They appear as they are and make no link,
HTML, line or column."""

import re

from ssrlab.mistakes import shown

# Emphasis between letters is none by '_', and a bracket is a link's only before what leads somewhere: such stay as they are, to be legible.
MARKUP = re.compile(r"[|`*~$]|(?<![^\W_])_|_(?![^\W_])|\](?=[(\[:])|\[(?=\^)|\\(?=[!-/:-@[-`{-~]|$)", re.ASCII)
CODE = re.compile(r"(?<![\\`])`[^`]+`(?!`)")
BLOCK = re.compile(r"(\d+(?=[.)](?:\s|$))|)([.)]|(?<!\d)[#+\->=:])")  # what begins a heading, a list or a quotation


def _plain(text):
    escaped = MARKUP.sub(r"\\\g<0>", text)
    return re.sub(r"&(?=#?\w+;)", "&amp;", escaped).replace("<", "&lt;")


def markdown_text(text):
    """A name in a sentence or in a cell of a table."""
    return _plain(shown(text).strip())


def markdown_code(text):
    """A name as code in a sentence."""
    text = shown(text)
    fence = "`" * (1 + max(map(len, re.findall("`+", text)), default=0))
    space = " " if text.startswith("`") or text.endswith("`") or not text.strip() else ""
    return f"{fence}{space}{text}{space}{fence}"


def markdown_prose(text):
    """A caption or a sentence that begins a line: code in backticks stays code, nothing else is markup."""
    text, parts, end = shown(text).strip(), [], 0
    for code in CODE.finditer(text):
        parts += [_plain(text[end : code.start()]), code.group()]
        end = code.end()
    prose = "".join([*parts, _plain(text[end:])])
    return BLOCK.sub(r"\1\\\2", prose, 1) if BLOCK.match(prose) else prose
