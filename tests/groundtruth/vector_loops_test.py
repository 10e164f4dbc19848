"""The loops over lanes (FOR_EACH_LANE, groundtruth/sampling/lanes.h) become vector code: compiled again as the build compiles them, with
the compiler's own report. An innocent change can undo it: a choice that the compiler takes for a branch took a third to a half of the
path tracer's rays per second, with the same image, and no test that looks at images sees that."""

import json
import os
import re
import shlex
import subprocess
import sys

LOOP = "FOR_EACH_LANE {"
WITHOUT = {"-MD", "-c"}  # flags of a compiler's command
WITH_VALUE = {"-MT", "-MF", "-o"}


def loops(source):
    with open(source, encoding="utf-8") as stream:
        return [number for number, line in enumerate(stream, 1) if line.strip() == LOOP]


def sources_of(command_file):
    """The sources that the build compiles as one file."""
    with open(command_file, encoding="utf-8") as stream:
        included = re.findall(r'^#include "(.*\.cpp)"$', stream.read(), re.MULTILINE)
    return included or [command_file]


def report(command, compiler):
    """What the compiler says that it vectorised: pairs of a file and a line."""
    words = shlex.split(command["command"])
    words = iter(words[words.index(compiler) + 1 :])  # a compiler cache may stand before it
    flags = []
    for word in words:
        if word in WITH_VALUE:
            next(words)
        elif word not in WITHOUT and word != command["file"]:
            flags.append(word)
    said = subprocess.run(
        [compiler, *flags, "-fopt-info-loop-vec-optimized", "-c", command["file"], "-o", os.devnull],
        cwd=command["directory"], capture_output=True, text=True, check=True).stderr  # fmt: skip
    return {(file, int(line)) for file, line in re.findall(r"^(.*?):(\d+):\d+: optimized: loop vectorized", said, re.MULTILINE)}


def main():
    commands_file, folder, compiler = sys.argv[1:]
    with open(commands_file, encoding="utf-8") as stream:
        commands = [c for c in json.load(stream) if "groundtruth.dir" in c["command"]]
    found, missed = 0, []
    for command in commands:
        wanted = {(s, line) for s in sources_of(command["file"]) if s.startswith(folder) for line in loops(s)}
        if not wanted:
            continue
        found += len(wanted)
        missed += sorted(wanted - report(command, compiler))
    if found < 6:
        sys.exit(f"{found} loops over lanes were found, which are more: does {commands_file} have the commands of groundtruth?")
    if missed:
        places = "\n".join(f"{file}:{line}" for file, line in missed)
        sys.exit(f"these loops over lanes are not vector code; -fopt-info-vec-missed says why:\n{places}")


main()
