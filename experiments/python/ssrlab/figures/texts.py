"""Names in lines."""

import re


def wrapped(text, longest, size=len):
    """Lines of at most `longest` letters, broken before a dot within a name, or after a space, '=' or '_'; names without these stay whole.
    `size`: what measures a line, in place of its number of letters."""
    lines = [""]
    for part in re.split(r"(?<=[ =_])|(?=\.\S)(?!(?<=\d)\.\d)", text):
        if lines[-1] and size(lines[-1] + part.rstrip()) > longest:
            lines.append("")
        lines[-1] += part
    return "\n".join(line.rstrip() for line in lines)
