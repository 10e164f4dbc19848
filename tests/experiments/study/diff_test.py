"""`ssrlab diff`: what counts as a change of a number, and what the scatter of seeds explains.

usage: diff_test.py DIFF.PY"""

import contextlib
import importlib.util
import io
import json
import os
import random
import statistics
import sys
import tempfile

spec = importlib.util.spec_from_file_location("diff", sys.argv[1])
diff = importlib.util.module_from_spec(spec)
spec.loader.exec_module(diff)

HOST = {"host": {"name": "h", "cpu": "c"}, "device": {"name": "d"}}


def write(folder, name, rows, columns):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
        stream.write(",".join(columns) + "\n")
        for row in rows:
            stream.write(",".join(str(row[c]) for c in columns) + "\n")


def study(folder, points, milliseconds=10.0, truth="t", host=HOST):
    """`points`: {(technique, shot): values by seed, or a single value without chance}."""
    os.makedirs(folder)
    summary, results, times = [], [], []
    for (variant, shot), values in points.items():
        row = {"shot": shot, "frame": "0", "variant": variant, "point": "p", "target": "specular", "metric": "mse", "mask": "all", "speaks": 1}
        values = values if isinstance(values, dict) else {0: values}
        mean = sum(values.values()) / len(values)
        half = 3.182 * statistics.stdev(values.values()) / 2 if len(values) == 4 else 0  # Student's of 4 seeds
        summary.append(row | {"value": mean, "low": mean - half, "high": mean + half})
        results += [row | {"seed": s, "value": v} for s, v in values.items()]
        times.append({"shot": shot, "variant": variant, "point": "p", "stage": "total", "median_ms": milliseconds,
                      "low_ms": 0.97 * milliseconds, "high_ms": 1.03 * milliseconds})  # fmt: skip
    key = list(diff.KEY)
    write(folder, "summary.csv", summary, [*key, "speaks", "value", "low", "high"])
    write(folder, "results.csv", results, [*key, "seed", "value"])
    write(folder, "time_summary.csv", times, ["shot", "variant", "point", "stage", "median_ms", "low_ms", "high_ms"])
    shots = sorted({s for _, s in points})
    references = [{"hash": truth, "relative_error": {"mean": 0.1}, "rays": 7}]
    manifest = {"shots": [{"shot": s, "references": references} for s in shots], "provenance": [host], "clock": {"aa_floor": 0.02}}
    with open(os.path.join(folder, "manifest.json"), "w", encoding="utf-8") as stream:
        json.dump(manifest, stream)
    return folder


def run(*arguments):
    """Exit code and what was said."""
    said = io.StringIO()
    sys.argv = ["diff.py", *arguments]
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        code = diff.main()
    return code, said.getvalue()


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def noisy(generator, mean, count=4, spread=0.1):
    # Heavy tails, as errors of seeds have them.
    return {s: mean * (1 + spread * generator.lognormvariate(0, 1)) for s in range(count)}


with tempfile.TemporaryDirectory() as place:
    generator = random.Random(1)
    shots = [f"s{i}" for i in range(12)]
    base = {("kept", s): noisy(generator, 1.0) for s in shots} | {("edited", s): noisy(generator, 1.0) for s in shots}
    base |= {("certain", s): 0.5 for s in shots}
    old = study(os.path.join(place, "old"), base)
    check(run(old, old)[0] == 0, "a folder differs from itself")

    # An edit that adds a little to every seed of one technique, far below the scatter of its seeds.
    edited = {k: {s: v + 0.01 + 0.0005 * generator.gauss(0, 1) for s, v in of.items()} if k[0] == "edited" else of for k, of in base.items()}
    code, said = run(old, study(os.path.join(place, "edited"), edited))
    lines = {line.split()[0]: line.split() for line in said.splitlines() if line.startswith(("kept", "edited", "certain"))}
    check(code == 1 and int(lines["edited"][4]) >= 11, said)
    check(lines["kept"][1:] == ["12", "12", "0", "0", "0"] and lines["certain"][2] == "12", said)

    # Rounding is none; another value of a point without chance is one.
    check(run(old, study(os.path.join(place, "rounded"), base | {("certain", "s3"): 0.5 * (1 + 1e-8)}))[0] == 0, "rounding")
    code, said = run(old, study(os.path.join(place, "certain"), base | {("certain", "s3"): 0.5 * (1 + 1e-4)}))
    check(code == 1 and "s3 frame 0: certain p" in said and "1 of 36" in said, said)

    # Against another truth values are not paired, and what chance explains is no change: of 40 repetitions with
    # other noise at most 6 say one (a family-wise 5 % each: more would come with a probability of 1 %).
    alarms = 0
    for i in range(40):
        again = {k: noisy(generator, 1.0) if isinstance(of, dict) else of for k, of in base.items()}
        alarms += run(old, study(os.path.join(place, f"again{i}"), again, truth="u"))[0]
    check(alarms <= 6, f"{alarms} of 40 repetitions are called changes")
    doubled = {k: {s: 3 * v for s, v in of.items()} if k == ("edited", "s5") else of for k, of in base.items()}
    check(run(old, study(os.path.join(place, "doubled"), doubled, truth="u"))[0] == 1, "three times the error is no change")

    # Times count when they are asked for, and those of another machine never.
    slow = study(os.path.join(place, "slow"), base, milliseconds=12)
    check(run(old, slow)[0] == 0 and run(old, slow, "--times")[0] == 1, "times")
    check(run(old, study(os.path.join(place, "near"), base, milliseconds=10.7), "--times")[0] == 0, "within the floor of two copies")
    other = {"host": {"name": "other", "cpu": "c"}, "device": {"name": "d"}}
    code, said = run(old, study(os.path.join(place, "elsewhere"), base, milliseconds=12, host=other), "--times")
    check(code == 0 and "different machines" in said, said)
    # Folders of the same two machines, which have changed places for one shot.
    node = {"host": {"name": "node", "cpu": "c"}, "device": {"name": "d"}}
    folders = [os.path.join(place, name) for name in ("one_of_two", "other_of_two")]
    for folder, milliseconds, taken_on in zip(folders, (10, 12), (HOST, node)):
        study(folder, base, milliseconds)
        file = os.path.join(folder, "manifest.json")
        with open(file, encoding="utf-8") as stream:
            manifest = json.load(stream)
        manifest["provenance"].append(node)
        manifest["clock"]["load"] = [{"shot": s, "host": (taken_on if s == "s0" else HOST)["host"]} for s in shots]
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(manifest, stream)
    code, said = run(*folders, "--times")
    check(code == 1 and "Times of 1 shots are of different machines" in said and "h (c), d / node (c), d: s0" in said, said)
    check(f"Times of {3 * len(shots) - 3} points changed" in said, said)

    # What only one of them has, and mistakes.
    fewer = {k: of for k, of in base.items() if k[0] != "kept"}
    code, said = run(old, study(os.path.join(place, "fewer"), fewer))
    check(code == 1 and "In " + old + " alone: 12 points" in said, said)
    check(run(old, study(os.path.join(place, "none"), {("x", "y"): 1.0}))[0] == 2, "nothing in common")
    check(run(old, place)[0] == 2, "no results folder")
