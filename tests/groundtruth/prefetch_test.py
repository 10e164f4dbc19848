"""What the path tracer prefetches is prefetched by its machine code. A compiler may leave out calls of functions that only prefetch. The
image stays the same, so no other test sees that."""

import re
import subprocess
import sys

# Functions that prefetch, themselves or by what they call.
WANTED = ["EnvironmentTable::choose", "EnvironmentTable::place", "MaterialTable::prefetch_corners", "MaterialTable::prefetch_texels",
          "PathLanes::look_ahead", "PathLanes::trace_rays"]  # fmt: skip
INSTRUCTION = re.compile(r"\tprefetch")
HEAD = re.compile(r"^[0-9a-f]+ <(.*)>:$")
CALL = re.compile(r"\t(?:call|jmp) .*<(.*?)(?:\+0x[0-9a-f]+)?>$")
RELOCATION = re.compile(r"R_X86_64_PLT32\t(.*?)-0x[0-9a-f]+$")


def bodies(library):
    """The lines of each function, by its whole name."""
    listing = subprocess.run(["objdump", "-dr", "-C", "--no-show-raw-insn", library], capture_output=True, text=True, check=True).stdout
    functions, body = {}, []
    for line in listing.splitlines():
        if head := HEAD.match(line):
            body = functions.setdefault(head[1], [])
        body.append(line)
    return functions


def main():
    functions = bodies(sys.argv[1])
    prefetching = {name for name, body in functions.items() if any(INSTRUCTION.search(line) for line in body)}
    calls = {name: {match[1] for line in body for match in (CALL.search(line), RELOCATION.search(line)) if match}
             for name, body in functions.items()}  # fmt: skip
    while added := {name for name, called in calls.items() if called & prefetching} - prefetching:
        prefetching |= added
    for wanted in WANTED:
        found = [name for name in functions if name.startswith(wanted + "(")]
        if not found:
            sys.exit(f"{wanted}() is not in {sys.argv[1]}: it was renamed, or is part of its caller now; name that instead")
        if missed := [name for name in found if name not in prefetching]:
            sys.exit(f"the code of {missed[0]} prefetches nothing: see groundtruth/sampling/prefetch.h")


main()
