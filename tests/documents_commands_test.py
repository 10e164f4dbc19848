"""The command lines of the documents: each is one that its program takes, and those of the quickstart's study do what the page says.

usage: documents_commands_test.py SSRLAB
"""

import functools
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SSRLAB = Path(sys.argv[1]).resolve()
PYTHON = "/usr/bin/python3"
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
        for document in DOCUMENTS:
            for line in command_lines(document.read_text(encoding="utf-8")):
                count += 1
                if mistake := mistake_in(line):
                    mistakes.append(f"{document.relative_to(ROOT)}: `{line}`: {mistake}")
        self.assertEqual(mistakes, [])
        self.assertGreater(count, 60)

    def test_mistakes_are_found(self):
        self.assertEqual(mistake_in("ssrlab figures results figures.json"), "2 arguments, but 1 to 1 are taken")
        self.assertEqual(mistake_in("ssrlab run study.json --output a"), "no option --output")
        self.assertEqual(mistake_in("ssrlab runn study.json"), "no command 'runn'")

    def test_the_quickstart_does_what_it_says(self):
        """Its study in small, of a scene of ours in place of the reader's."""
        page = (ROOT / "experiments/docs/quickstart.md").read_text(encoding="utf-8")
        study = json.loads(re.search(r"(?s)```json\n(.*?)```", page)[1])
        study["shots"][0] |= {"resolution": [32, 18], "warm_up": 1}
        study["techniques"] = study["techniques"][:2]  # the others are compiled for seconds
        study |= {"reference": {"samples": 16}, "seeds": 2, "timing": {"frames": 0}}
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            glb = next((ROOT / "scenes").glob("*/*.glb"), None)
            self.assertIsNotNone(glb)
            shutil.copy(glb, folder / study["shots"][0]["scene"])
            (folder / "my_study.json").write_text(json.dumps(study))
            lines = [line for line in command_lines(page) if "my_" in line and " plan " not in line]
            self.assertGreater(len(lines), 1)
            for line in [*lines, "ssrlab report results/my_study", "ssrlab tradeoff results/my_study"]:
                words = shlex.split(line)
                ran = subprocess.run([SSRLAB, *words[1:]], cwd=folder, capture_output=True, text=True, env=os.environ | {"SSRLAB_CACHE": str(folder / "cache")})
                self.assertEqual(ran.returncode, 0, f"{line}\n{ran.stdout}\n{ran.stderr}")
            self.assertTrue((folder / "results/my_study/report.html").is_file())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
