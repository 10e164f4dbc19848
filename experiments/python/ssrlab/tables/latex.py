"""A table as LaTeX, with the packages booktabs and graphicx."""

import re
import zlib

from ssrlab.mistakes import shown
from ssrlab.results import LIKE_BEST
from ssrlab.figures.texts import wrapped
from ssrlab.tables.shot_names import about, shown_names
from ssrlab.tables.formats import DISTURBED, NO_VALUE, cell_text, grid, is_bold, notes

ESCAPES = str.maketrans(
    {c: "\\" + c for c in "_%&#${}"} | {"\N{SUPERSCRIPT TWO}": r"\textsuperscript{2}"}
    | {"\\": r"\textbackslash{}", "^": r"\^{}", "~": r"\textasciitilde{}", "|": r"\textbar{}", "<": r"\textless{}", ">": r"\textgreater{}"}
    | {"\N{DAGGER}": r"\dag{}", "\N{DOUBLE DAGGER}": r"\ddag{}", "\N{PILCROW SIGN}": r"\P{}", DISTURBED: r"\S{}", NO_VALUE: "--", "\N{NO-BREAK SPACE}": "~"}
    | {"\0": "{}"}
)
# Widths in pt: of letters in 10 pt Computer Modern, about, the gap between columns, and what there is room for.
LETTER, SMALL_LETTER, GAP = 4.9, 3.9, 8
COLUMN, TEXT = 240, 345  # a column of two; the text of the class article, the narrowest that spans a page
HEAD = 14  # letters of a column's name in a line, at least
MOST_LINES = 45  # that a page has room for, with a caption and notes


# What a reader calls what the files' columns and values are named.
HEADS = {"shot_group": "shots", "mse": "MSE", "relmse": "relMSE", "mae": "MAE", "smape": "SMAPE", "psnr": "PSNR (dB)", "flip": "FLIP"}
HEADS |= {"hdr_flip": "HDR-FLIP", "ssim": "SSIM", "bias_squared": "bias\N{SUPERSCRIPT TWO}"}
WORDS = ("metric", "quantity", "mask", "target", "change", "what")  # whose values are words; others are names, which stay as they are


def readable(text):
    return HEADS.get(text, text.replace("_", " "))


def head_of(column, keys):
    """`keys`: what the table's columns are of, as its config says."""
    parts = column.split(", ")
    return ", ".join(readable(p) if k in WORDS else p for p, k in zip(parts, keys)) if len(parts) == len(keys) else column


def escaped(text):
    """Letter by letter, but for quotation marks and code in backticks; hyphens make no dash."""
    letters = re.sub("-(?=-)", "-\0", shown(text)).translate(ESCAPES)
    letters = re.sub("`([^`]*)`", r"\\texttt{\1}", letters).replace("`", r"\textasciigrave{}")
    return re.sub(r'"([^"]*)"', r"``\1''", letters)


def comment(text):
    """A LaTeX comment in one line, including the line's end."""
    return f"% {shown(text)}"


def label_name(name):
    """A name for \\label and \\ref: other letters become '-', and a hash distinguishes names."""
    safe = re.sub(r"[^A-Za-z0-9:._-]", "-", name)
    return safe if safe == name else f"{safe}-{zlib.crc32(name.encode(errors='surrogatepass')):08x}"


def _name(row):
    """At the start of a line, where a bracket or a star would be an argument of the line break before it."""
    return ("{}" if row[:1] in ("[", "*") else "") + escaped(row)


def _parts(table, cell):
    """The number of a cell, and the small text behind it."""
    number, _, rest = cell_text(table, cell).partition(" ") if cell else ("", "", "")
    return number, rest


def _widths(table, rows, columns, at):
    """For all columns (in one line for each row, with all but the numbers in a second line), without their names."""
    found = []
    for column in columns:
        texts = [_parts(table, at.get((row, column))) for row in rows]
        number, rest = LETTER * max(len(n) for n, _ in texts), SMALL_LETTER * max(len(r) for _, r in texts)
        found.append((number + rest, max(number, rest)))
    return found


def _head(column, width):
    """A column's name, in as many lines as it needs to be no wider than the column."""
    lines = [escaped(line) for line in wrapped(column, max(int(width / LETTER), HEAD)).split("\n")]
    return lines[0] if len(lines) == 1 else r"\begin{tabular}[b]{@{}r@{}}" + r"\\".join(lines) + r"\end{tabular}"


def _rows_of_pages(rows, is_stacked):
    """The rows in parts of nearly equal length that fit on a page."""
    most = MOST_LINES // 2 if is_stacked else MOST_LINES
    count = -(-len(rows) // most)
    ends = [round(i * len(rows) / count) for i in range(count + 1)]
    return [rows[begin:end] for begin, end in zip(ends, ends[1:])]


def latex(table, cells, made_from):
    """What is too wide for a page's text is set in two lines for each row, and shrunk where that is not enough; what is wider than a column
    spans both of a page that has two, and what is longer than a page becomes several tables."""
    rows, columns, at = grid(cells)
    name_of, shots = shown_names(table, [*rows, *columns])
    names = LETTER * max(len(name_of[row]) for row in rows)
    one, two = (list(widths) for widths in zip(*_widths(table, rows, columns, at)))
    is_stacked = names + sum(GAP + w for w in one) > TEXT
    widths = [max(w, HEAD * LETTER) for w in (two if is_stacked else one)]
    environment = "table*" if names + sum(GAP + w for w in widths) > COLUMN else "table"

    def shown(row, column):
        """The texts in the row's first line, and in its second."""
        cell = at.get((row, column))
        number, rest = (escaped(part) for part in _parts(table, cell))
        style = None if cell is None else "textbf" if is_bold(cell) else "textit" if cell.standing in LIKE_BEST else None
        number = f"\\{style}{{{number}}}" if style else number
        small = f"{{\\scriptsize {rest}}}" if rest else ""
        return (number, small) if is_stacked else (" ".join(part for part in (number, small) if part), "")

    def body(rows):
        lines = []
        for row in rows:
            first, second = zip(*(shown(row, c) for c in columns))
            lines.append(" & ".join([_name(name_of[row]), *first]) + (r" \\[-2.5pt]" if any(second) else r" \\"))
            lines += [" & ".join(["", *second]).lstrip() + r" \\"] if any(second) else []
            lines += [r"\addlinespace[2pt]"] if is_stacked and row != rows[-1] else []
        return lines

    explained = " ".join(part for part in (about(shots), notes(table, cells)) if part)
    heads = [_head(head_of(name_of[c], table.get("columns", [])), w) for c, w in zip(columns, widths)]
    corner = escaped(", ".join(readable(key) for key in table.get("rows", [])))

    def page(rows, number, count):
        is_last = number == count
        caption = escaped(table["caption"]) + (f" ({number} of {count})" if count > 1 else "")
        label = [f"\\label{{tab:{label_name(table['name'])}}}"] if number == 1 else []
        return [
            f"\\begin{{{environment}}}",
            f"\\centering\\setlength{{\\tabcolsep}}{{{GAP / 2:g}pt}}",
            f"\\caption{{{caption}}}",
            "".join([*label, r"\par\smallskip"]),
            r"\resizebox{\ifdim\width>\linewidth\linewidth\else\width\fi}{!}{%",
            f"\\begin{{tabular}}{{l{'r' * len(columns)}}}",
            "\\toprule",
            " & ".join([corner, *heads]).lstrip() + r" \\",
            "\\midrule",
            *body(rows),
            "\\bottomrule",
            "\\end{tabular}}",
            *([f"\\par\\smallskip\\parbox{{\\linewidth}}{{\\scriptsize {escaped(explained)}}}"] if explained and is_last else []),
            f"\\end{{{environment}}}",
        ]

    pages = _rows_of_pages(rows, is_stacked)
    head = [comment(made_from), "% Needs the packages booktabs and graphicx."]
    return "\n".join([*head, *(line for i, part in enumerate(pages, 1) for line in page(part, i, len(pages))), ""])
