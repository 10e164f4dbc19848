"""slowest.py BUILD_FOLDER RESULTS: prints what took longest: 20 tests of the run whose JUnit file (ctest --output-junit)
is RESULTS, and 20 compilations of BUILD_FOLDER. Wall-clock times: other jobs of the same build or run are in them."""
import re
import sys
import xml.etree.ElementTree
from pathlib import Path

COUNT = 20


def tests(results):
    """(seconds, name) of each test that ran; none where ctest only listed them."""
    if not Path(results).exists():
        return []
    root = xml.etree.ElementTree.parse(results).getroot()
    return [(float(case.get("time")), case.get("name")) for case in root.iter("testcase") if case.get("status") == "run"]


def sources_of(build, target_object):
    """What an object is compiled from: a source, or the sources of a unit."""
    target, _, inside = target_object.partition(".dir/")
    target = Path(target).name
    source = inside.removesuffix(".o")
    unit = build / target_object.removesuffix(".o") if source.startswith("Unity/") else build / "tests" / source
    if not unit.exists():
        return f"{target}: {source}"
    names = re.findall(r'#include "[^"]*?([^/"]+)\.cpp"', unit.read_text())
    return f"{target}: {', '.join(names)}"


def compilations(build):
    """(seconds, sources) of each object of the present build, from ninja's log: milliseconds from and to, and the output;
    later lines replace earlier ones."""
    built = set(re.findall(r"^build ([^:| ]+)", (build / "build.ninja").read_text(), re.MULTILINE))
    seconds = {}
    for line in (build / ".ninja_log").read_text().splitlines()[1:]:
        start, end, _, output, _ = line.split("\t")
        if output.endswith((".o", ".gch")) and output in built:
            seconds[output] = (int(end) - int(start)) / 1000
    return [(time, sources_of(build, output)) for output, time in seconds.items()]


def show(title, timed):
    print(f"\n{title}")
    for seconds, name in sorted(timed, reverse=True)[:COUNT]:
        print(f"{seconds:7.1f} s  {name}")


if __name__ == "__main__":
    build_folder = Path(sys.argv[1])
    show("Slowest tests of this run", tests(sys.argv[2]))
    show("Slowest compilations, each when it was last done", compilations(build_folder))
