"""A table as Markdown, LaTeX and CSV."""

import csv
import io
import math


def _decimals(cell):
    """As many as tell two digits of the interval's half-width, else three of the value; never more than four of it."""
    size = abs(cell.value)
    if size == 0 or not math.isfinite(size):
        return 2
    most = 3 - math.floor(math.log10(size))
    half = (cell.high - cell.low) / 2 if cell.low is not None and cell.high is not None else None
    wanted = most - 1 if not half else 1 - math.floor(math.log10(half))
    return max(min(wanted, most), 0)


def _text(value, decimals):
    if value != 0 and abs(value) < 1e-4:
        return f"{value:.1e}"
    return f"{value:.{decimals}f}"


def cell_text(cell):
    """0.71 [0.70, 0.73] (0.37 to 0.90): the value, its interval, and the range over shots."""
    decimals = _decimals(cell)
    text = _text(cell.value, decimals)
    if cell.low is not None and cell.high is not None:
        text += f" [{_text(cell.low, decimals)}, {_text(cell.high, decimals)}]"
    if cell.least is not None and cell.least != cell.most:
        text += f" ({_text(cell.least, decimals)} to {_text(cell.most, decimals)})"
    return text


def _grid(cells):
    rows = list(dict.fromkeys(c.row for c in cells))
    columns = list(dict.fromkeys(c.column for c in cells))
    return rows, columns, {(c.row, c.column): c for c in cells}


def markdown(table, cells, made_from):
    rows, columns, at = _grid(cells)

    def shown(row, column):
        cell = at.get((row, column))
        if cell is None:
            return ""
        return f"**{cell_text(cell)}**" if cell.is_significant else cell_text(cell)

    escaped = [c.replace("|", "\\|") for c in columns]
    lines = [f"{table['caption']}", "", "| | " + " | ".join(escaped) + " |", "|---" * (len(columns) + 1) + "|"]
    for row in rows:
        name = row.replace("|", "\\|")
        lines.append(f"| {name} | " + " | ".join(shown(row, c) for c in columns) + " |")
    return "\n".join([*lines, "", made_from, ""])


def _latex_escaped(text):
    for plain, escaped in {"\\": r"\textbackslash{}", "_": r"\_", "%": r"\%", "&": r"\&", "#": r"\#", "^": r"\^{}"}.items():
        text = text.replace(plain, escaped)
    return text


def latex(table, cells, made_from):
    """With the packages booktabs; intervals small."""
    rows, columns, at = _grid(cells)

    def shown(row, column):
        cell = at.get((row, column))
        if cell is None:
            return ""
        value, _, rest = cell_text(cell).partition(" ")
        value = f"\\textbf{{{value}}}" if cell.is_significant else value
        return f"{value} {{\\scriptsize {rest}}}" if rest else value

    head = " & ".join(_latex_escaped(c) for c in columns)
    lines = [
        f"% {made_from}",
        "\\begin{table}",
        f"\\caption{{{_latex_escaped(table['caption'])}}}",
        f"\\begin{{tabular}}{{l{'r' * len(columns)}}}",
        "\\toprule",
        f" & {head} \\\\",
        "\\midrule",
    ]
    lines += [f"{_latex_escaped(r)} & " + " & ".join(shown(r, c) for c in columns) + " \\\\" for r in rows]
    return "\n".join([*lines, "\\bottomrule", "\\end{tabular}", "\\end{table}", ""])


def comma_separated(cells):
    """The grid with a column for each value, low and high."""
    rows, columns, at = _grid(cells)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([""] + [name for c in columns for name in (c, f"{c} low", f"{c} high")])
    for row in rows:
        found = [at.get((row, c)) for c in columns]
        numbers = [(cell.value, cell.low, cell.high) if cell else ("", "", "") for cell in found]
        writer.writerow([row] + ["" if n is None else n for three in numbers for n in three])
    return out.getvalue()
