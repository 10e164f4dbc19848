"""Names in lines."""

import re


def wrapped(text, longest):
    """In lines of `longest` letters at most, broken before a dot within a name and behind a space, '=' or '_'; what has none
    of these stays."""
    lines = [""]
    for part in re.split(r"(?<=[ =_])|(?=\.\S)(?!(?<=\d)\.\d)", text):
        if lines[-1] and len(lines[-1] + part.rstrip()) > longest:
            lines.append("")
        lines[-1] += part
    return "\n".join(line.rstrip() for line in lines)
