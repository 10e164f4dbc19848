"""The command lines of the documents."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCUMENTS = sorted(f for f in ROOT.rglob("*.md") if not re.match(r"(build|results|\.)", str(f.relative_to(ROOT))))
PROGRAM = r"(?:(?:build/release/|\./)?ssrlab|python3 experiments/python|(?:experiments|tests)/\w+\.sh)"


def command_lines(text):
    """Of blocks of code: indented by four spaces, or between fences; a line that ends in a backslash goes on."""
    fenced = re.findall(r"(?ms)^ *```(?:sh|bash|console|yaml)?\n(.*?)^ *```", text)
    indented = re.findall(r"(?m)^(?: {4}.*\n)+", re.sub(r"(?ms)^ *```.*?^ *```", "", text))
    for block in fenced + indented:
        for line in block.replace("\\\n", " ").splitlines():
            line = line.strip().removeprefix("$ ").removeprefix("- run: ")
            if re.match(PROGRAM + r"(?= |$)", line):
                yield re.sub(r"\s+(#|&&|\||>|2>).*$", "", line)


def python_blocks(document):
    """Blocks of code that begin with an import: whole programs."""
    text = document.read_text(encoding="utf-8")
    indented = re.findall(r"(?m)(?:^ {4}.*\n|^\n(?= {4}))+", re.sub(r"(?s)```.*?```", "", text))
    blocks = re.findall(r"(?s)```python\n(.*?)```", text) + [re.sub(r"(?m)^ {4}", "", block).strip() + "\n" for block in indented]
    return [block for block in blocks if re.match("(?:import|from) ", block)]


def all_command_lines():
    """(document, line) of each document, in the order in which a reader meets them."""
    for document in DOCUMENTS:
        for line in command_lines(document.read_text(encoding="utf-8")):
            yield document, line


def mentions(text):
    """Command lines between backquotes, in sentences. Those with a word that stands for others, such as NAME of a command or {file} of a
    program's own text, are none."""
    joined = re.sub(r'"\s*\n\s*"', "", text)  # a literal of C++ over several lines
    for span in re.findall(r"`((?:build/release/)?ssrlab [^`\n]+|python3 experiments/python [^`\n]+)`", joined):
        if not re.search(r"[{}<>\\]|' ?\+|\+ ?'|\" ?\+|\.\.\.|(?:ssrlab|python) [A-Z]|ssrlab help", span):
            yield span


def all_mentions():
    """(file, line) of documents, help texts and messages."""
    sources = [f for folder in ("core", "experiments", "groundtruth", "metrics", "variants") for kind in ("cpp", "h", "py", "js", "json") for f in (ROOT / folder).rglob(f"*.{kind}")]
    for file in DOCUMENTS + sorted(sources):
        for line in mentions(file.read_text(encoding="utf-8")):
            yield file, line


def studies_of(document):
    """The JSON objects that a page prints as whole blocks, in their order."""
    text = document.read_text(encoding="utf-8")
    blocks = re.findall(r"(?s)```json\n(.*?)```", text) + re.findall(r"(?m)(?:^ {4}.*\n)+", re.sub(r"(?s)```.*?```", "", text))
    return [block for block in blocks if block.lstrip().startswith("{")]
