"""The command lines of the documents: each is one that its program takes. `documents_run_test.py` runs them.

usage: documents_commands_test.py SSRLAB
"""

import functools
import os
import re
import shlex
import subprocess
import sys
import unittest
from pathlib import Path

from document_lines import ROOT, all_command_lines

SSRLAB = Path(sys.argv[1]).resolve()
PYTHON = "/usr/bin/python3"


@functools.cache
def help_text(program, *command):
    """None if there is no such command."""
    start = [PYTHON, str(ROOT / "experiments/python")] if program == "python" else [str(SSRLAB)]
    ran = subprocess.run([*start, *command, "--help"], capture_output=True, text=True)
    return ran.stdout if ran.returncode == 0 else None


def help_of(*command):
    """What `--help` says: ({option: whether it takes none, one or "many" values}, required and most arguments)."""
    if (said := help_text(*command)) is None:
        return None
    options, arguments = {}, []
    for line in said.splitlines():
        if option := re.match(r"  (?:-\w, ?|-\w \S+, )?(--[\w-]+)(?:[ =](\S.*?))?(?:  |$)", line):
            options[option[1]] = "many" if "..." in (option[2] or "") else "one" if option[2] else "none"
    positionals = re.search(r"(?ms)^(?:Positionals|positional arguments):\n(.*?)(?:^$|\Z)", said)
    usage = said.split("\n\n")[0]
    for line in re.findall(r"(?m)^  (\w.*)$", positionals[1]) if positionals else []:
        name = line.split()[0]
        is_optional = "REQUIRED" not in line if "Positionals" in positionals[0] else re.search(rf"\[{re.escape(name)}[ \]]", usage)
        arguments.append((not is_optional, "..." in line.split("  ")[0] or f"{name} ..." in usage))
    return options, sum(required for required, _ in arguments), sys.maxsize if any(many for _, many in arguments) else len(arguments)


@functools.cache
def has_commands(program, name):
    return program == "python" and bool(re.search(r"(?m)^  \{\w+(,\w+)*\}$", help_text(program, name) or ""))


def mistake_in(line):
    """What its program would not take; "" if nothing."""
    words = shlex.split(line)
    if words[0].endswith(".sh"):
        return "" if os.access(ROOT / words[0], os.X_OK) else f"{words[0]} cannot be run"
    program, name, rest = ("python", words[2], words[3:]) if words[0] == "python3" else ("ssrlab", words[1], words[2:])
    if name.startswith("--"):
        return ""
    commands = [name, rest.pop(0)] if rest and has_commands(program, name) else [name]
    known = help_of(program, *commands)
    if known is None:
        return f"no command '{' '.join(commands)}'"
    options, least, most = known
    given, i = 0, 0
    while i < len(rest):
        word, _, value = rest[i].partition("=")
        i += 1
        if not word.startswith("--"):
            given += 1
            continue
        if word not in options and word != "--help":
            return f"no option {word}"
        takes = options.get(word, "none")
        if takes == "one" and not value:
            i += 1
        while takes == "many" and i < len(rest) and not rest[i].startswith("--"):
            i += 1
    if "--help" in rest or least <= given <= most:
        return ""
    return f"{given} arguments, but {least} to {most} are taken"


class Commands(unittest.TestCase):
    def test_are_what_the_programs_take(self):
        count, mistakes = 0, []
        for document, line in all_command_lines():
            count += 1
            if mistake := mistake_in(line):
                mistakes.append(f"{document.relative_to(ROOT)}: `{line}`: {mistake}")
        self.assertEqual(mistakes, [])
        self.assertGreater(count, 60)

    def test_mistakes_are_found(self):
        self.assertEqual(mistake_in("ssrlab figures results figures.json"), "2 arguments, but 1 to 1 are taken")
        self.assertEqual(mistake_in("ssrlab run study.json --output a"), "no option --output")
        self.assertEqual(mistake_in("ssrlab runn study.json"), "no command 'runn'")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
