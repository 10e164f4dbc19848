"""The command lines of the documents, of help texts and of messages: each is one that its program takes, as the program's own parser says.
`documents_run_test.py` runs those of the documents.

usage: documents_commands_test.py SSRLAB
"""

import contextlib
import functools
import importlib
import io
import json
import os
import re
import shlex
import subprocess
import sys
import unittest
from pathlib import Path

from document_lines import ROOT, all_command_lines, all_mentions

SSRLAB = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT / "experiments/python"))
os.environ.pop("COLUMNS", None)  # which would wrap what is compared
os.environ["MPLBACKEND"] = "Agg"


@functools.cache
def declared_commands():
    said = subprocess.run([SSRLAB, "describe", "--json"], capture_output=True, text=True, check=True).stdout
    return json.loads(said)["commands"]


def script_mistake(module, words):
    """What the parser of experiments/python/ssrlab says to the words; "" if nothing."""
    try:
        parser = importlib.import_module(f"ssrlab.{module}").command_line()
    except ModuleNotFoundError as missing:
        if not missing.name.startswith("ssrlab"):
            raise
        return f"no script '{module}'"
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            parser.parse_args(words)
    except SystemExit as end:
        return said.getvalue().strip() if end.code else ""
    return ""


def ssrlab_mistakes(lines):
    """What `ssrlab` says to each list of words; "" if nothing. One process parses them all."""
    asked = "".join(json.dumps(words) + "\n" for words in lines)
    said = subprocess.run([SSRLAB, "--check-lines"], input=asked, capture_output=True, text=True, check=True).stdout.split("\n")[:-1]
    assert len(said) == len(lines), said
    scripts = {c["name"] for c in declared_commands() if c["has_script"]}
    for i, words in enumerate(lines):
        if words and words[0] in scripts and not said[i]:
            # `ssrlab tables --check` adds the version of its estimators
            said[i] = script_mistake(f"{words[0]}.command_line", [word + "=1" if word == "--check" else word for word in words[1:]])
    return said


def mistakes_in(lines):
    """What the program of each line would not take; "" if nothing."""
    found, of_ssrlab = [""] * len(lines), {}
    for i, line in enumerate(lines):
        words = shlex.split(line)
        if words[0].endswith(".sh"):
            found[i] = "" if os.access(ROOT / words[0], os.X_OK) else f"{words[0]} cannot be run"
        elif words[0] == "python3":
            found[i] = script_mistake(words[2], words[3:])
        else:
            of_ssrlab[i] = words[1:]
    for i, said in zip(of_ssrlab, ssrlab_mistakes(list(of_ssrlab.values()))):
        found[i] = said
    return found


def is_incomplete(mistake):
    """Whether only arguments or the value of an option are missing, as in a sentence about `ssrlab run --cells`."""
    return re.search(r"^`ssrlab [\w-]+` needs |needs a value|required: |expected one argument|name one results folder", mistake)


class Commands(unittest.TestCase):
    def test_lines_are_what_the_programs_take(self):
        lines = list(all_command_lines())
        self.assertEqual([f"{d.relative_to(ROOT)}: `{line}`: {m}" for (d, line), m in zip(lines, mistakes_in([line for _, line in lines])) if m], [])
        self.assertGreater(len(lines), 140)

    def test_mentions_in_sentences_exist(self):
        mentions = list(all_mentions())
        mistakes = mistakes_in([line for _, line in mentions])
        self.assertEqual([f"{d.relative_to(ROOT)}: `{line}`: {m}" for (d, line), m in zip(mentions, mistakes) if m and not is_incomplete(m)], [])
        self.assertGreater(len(mentions), 400)

    def test_named_files_exist(self):
        files = {word for _, line in [*all_command_lines(), *all_mentions()] for word in shlex.split(line) if re.match(r"(experiments|scenes|variants|tests)/[^A-Z]*$", word)}
        self.assertEqual([file for file in sorted(files) if not (ROOT / file).exists()], [])
        self.assertGreater(len(files), 50)

    def test_every_command_has_an_example(self):
        examples = [c["example"] for c in declared_commands()]
        self.assertEqual([c["name"] for c in declared_commands()], [shlex.split(example)[1] for example in examples])
        self.assertEqual([(line, m) for line, m in zip(examples, mistakes_in(examples)) if m], [])

    def test_help_begins_with_the_example(self):
        for command in declared_commands():
            said = subprocess.run([SSRLAB, command["name"], "--help"], capture_output=True, text=True, check=True).stdout
            self.assertEqual(said.splitlines()[0], f"For example: {command['example']}")
            self.assertIn("sage: ssrlab " + command["name"], said)

    def test_mistakes_are_found(self):
        for line, mistake in {
            "ssrlab figures results figures.json": "did you mean '--choice figures.json'?",
            "ssrlab run study.json --output a": "`ssrlab run` has no option '--output'; did you mean '--out'?",
            "ssrlab runn study.json": "unknown command 'runn'; did you mean 'run'?",
            "ssrlab list scene": "did you mean 'scenes'?",
            "ssrlab gbuffer fence --size 0 4": "--size",
            "ssrlab diff a b c": "'c' is one argument too many; `ssrlab diff` takes OLD and NEW",
            "ssrlab diff a": "`ssrlab diff` needs NEW, as in: ssrlab diff",
            "ssrlab run --cells": "option '--cells' needs a value: --cells TERM",
            "ssrlab tables results --kep": "did you mean '--keep'?",
            "python3 experiments/python judge sheets a": "required: out",
            "python3 experiments/python jugde": "no script 'jugde'",
        }.items():
            self.assertIn(mistake, mistakes_in([line])[0], line)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
