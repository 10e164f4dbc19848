#!/usr/bin/env python3
"""Breaks the product on purpose, one mutant at a time, and says which the tests kill.

    tests/mutation/run.py [--build build/release] [NAME...]     all mutants of mutants.json, or those named
    tests/mutation/run.py --check                               says what of mutants.json fits no file or test; builds nothing

A mutant is one exact text of one file, found there once, and what stands there instead; the test that should fail with
it; and what breaks. Shaders and Python are read when a test runs. For C++ only the test's program is built, before and
after; for scripts of pages, the pages. The program "ctest" stands for a test of ctest, which the filter names. Each test
must pass without mutants. Files are restored whatever happens: edit none of them meanwhile. Exit status: 0 if all mutants
died, 1 if one survived, 2 if the table or a test is wrong."""
import argparse
import fnmatch
import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 600  # of one test; a mutant that runs on counts as killed


def stop(message):
    print(message, file=sys.stderr)
    sys.exit(2)


class Mutant:
    def __init__(self, entry):
        self.name, self.why = entry["name"], entry["breaks"]
        self.file = ROOT / entry["file"]
        self.text, self.replacement = entry["text"], entry["replacement"]
        self.program, self.filter = entry["program"], entry["filter"]
        self.original = self.file.read_text() if self.file.is_file() else ""

    def mistakes(self, tests):
        found = self.original.count(self.text)
        if found != 1 or self.text == self.replacement:
            yield f"mutants.json: '{self.name}': its text is in {self.file.relative_to(ROOT)} {found} times, and must be there once"
        if not any(fnmatch.filter(tests[self.program == "ctest"], pattern) for pattern in self.filter.split(":")):
            yield f"mutants.json: '{self.name}': no test is called {self.filter}"

    def is_built(self):
        return self.file.suffix in (".cpp", ".h", ".js")

    def break_file(self):
        self.file.write_text(self.original.replace(self.text, self.replacement))

    def restore_file(self):
        self.file.write_text(self.original)


def tests_of_sources():
    """Names that a filter may match: of gtest, with parameters as "Instance/Suite.Test/", and of ctest."""
    text = "\n".join(file.read_text() for file in (ROOT / "tests").rglob("*.cpp"))
    names = [".".join(name) for name in re.findall(r"\bTEST(?:_F|_P)?\((\w+), *(\w+)\)", text)]
    for instance, suite in re.findall(r"\bINSTANTIATE_TEST_SUITE_P\((\w+), *(\w+)", text):
        names += [f"{instance}/{name}/" for name in names if name.startswith(suite + ".")]
    return names, re.findall(r"add_test\(NAME (\w+)", (ROOT / "tests/CMakeLists.txt").read_text())


def build(folder, program):
    target = "pages" if program == "ctest" else program
    return subprocess.run(["cmake", "--build", folder, "--target", target, "--", "--quiet"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def passes(folder, program, test_filter):
    """True if the tests of that filter exist, end in time, and none fails."""
    environment = dict(os.environ, SSRLAB_VALIDATE="1")
    command = [Path(folder) / program, f"--gtest_filter={test_filter}", "--gtest_brief=1", "--gtest_fail_fast"]
    if program == "ctest":
        command = ["ctest", "--test-dir", folder, "-R", f"^{test_filter}$"]
    try:
        run = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                             timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return False
    if "0 tests from 0 test suites ran" in run.stdout or "No tests were found" in run.stdout:
        stop(f"{program} has no test {test_filter}")
    return run.returncode == 0


def survives(mutant, folder):
    try:
        mutant.break_file()
        if mutant.is_built():
            built = build(folder, mutant.program)
            if built.returncode:
                stop(f"mutants.json: '{mutant.name}' does not compile:\n{built.stdout}")
        return passes(folder, mutant.program, mutant.filter)
    finally:
        mutant.restore_file()


def chosen(names):
    mutants = [Mutant(entry) for entry in json.loads((Path(__file__).parent / "mutants.json").read_text())]
    tests = tests_of_sources()
    if mistakes := [mistake for mutant in mutants for mistake in mutant.mistakes(tests)]:
        stop("\n".join(mistakes))
    unknown = set(names) - {m.name for m in mutants}
    if unknown:
        stop(f"mutants.json has no {', '.join(sorted(unknown))}")
    return [m for m in mutants if not names or m.name in names]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=str(ROOT / "build/release"), help="folder of the build (default: %(default)s)")
    parser.add_argument("--check", action="store_true", help="only whether each mutant fits its file and its test")
    parser.add_argument("names", nargs="*", help="mutants (default: all)")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(2))  # so that `finally` restores the file
    mutants = chosen(options.names)
    if options.check:
        return 0
    for program in sorted({m.program for m in mutants}):
        built = build(options.build, program)
        if built.returncode:
            stop(f"{program} does not build:\n{built.stdout}")
    for program, test_filter in sorted({(m.program, m.filter) for m in mutants}):
        if not passes(options.build, program, test_filter):
            stop(f"{program} --gtest_filter={test_filter} fails without any mutant")

    survivors = []
    for mutant in mutants:
        if survives(mutant, options.build):
            survivors.append(mutant)
        print(f"{'SURVIVED' if mutant in survivors else 'killed':9} {mutant.name:44} {mutant.why}", flush=True)
    for program in sorted({m.program for m in mutants if m.is_built()}):
        build(options.build, program)
    print(f"\n{len(mutants) - len(survivors)} of {len(mutants)} mutants killed")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
