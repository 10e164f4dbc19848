"""A search among made-up techniques whose best point is known, through a stand-in for `ssrlab run`.

usage: search_test.py SEARCH_SCRIPT
"""

import csv
import json
import math
import os
import stat
import subprocess
import sys
import tempfile

START = {"taps": 4, "radius": 1.0, "clamp": True, "noise": 0.0}
AXES = {"taps": [1, 4, 16], "radius": [1.0, 2.0, 3.0], "clamp": [True, False], "noise": [0.0, 0.5]}


def error(values):
    """Least at 16 taps, a radius of 2 and no clamp, where each alone is better than the start. From radius 3 on, a
    first round's best alone, the way leads back; `noise` gains half a percent, less than is worth a change."""
    of_radius = {1.0: 0.9, 2.0: 0.6, 3.0: 0.7} if values["taps"] == 16 else {1.0: 1.0, 2.0: 0.9, 3.0: 0.85}
    of_taps = {1: 2.0, 4: 1.0, 16: 0.8}[values["taps"]]
    of_clamp = 0.9 if not values["clamp"] else 1.0
    return of_radius[values["radius"]] * of_taps * of_clamp * (1 - 0.01 * values["noise"])


def run(config_file, out):
    """The stand-in: what a search reads of a finished study."""
    with open(config_file, encoding="utf-8") as stream:
        config = json.load(stream)
    assert "search" not in config, "a step is a study of its own"
    assert os.path.dirname(config_file) != out, "study.json of the folder is ssrlab's"
    compared = {"against": "baseline", "against_variant": "sssr", "against_point": "default"}
    compared |= {"target": "specular", "metric": "mse", "mask": "all"}
    points, effects = [], []
    for variant in config["variants"]:
        swept = {name: values[0] for name, values in variant.get("sweep", {}).items()}
        name = " ".join(f"{k}={json.dumps(v)}" for k, v in sorted(swept.items())) or "default"
        points.append({"variant": "sssr", "point": name, "parameters": START | variant["parameters"] | swept})
    for point in points[1:]:
        for shot in ("floor", "wall"):
            ratio = error(point["parameters"]) / error(points[0]["parameters"])
            interval = {"low": ratio * math.exp(-0.001), "high": ratio * math.exp(0.001)}
            point_of_shot = {"shot": shot, "variant": "sssr", "point": point["point"]}
            effects.append(point_of_shot | compared | {"ratio": ratio} | interval)
    os.makedirs(out, exist_ok=True)
    with open(os.path.join(out, "manifest.json"), "w", encoding="utf-8") as stream:
        json.dump({"variants": points, "shots": []}, stream)
    for name, rows in (("effects", effects), ("summary", []), ("time_summary", [])):
        with open(os.path.join(out, name + ".csv"), "w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, rows[0].keys() if rows else ["shot", "frame"])
            writer.writeheader()
            writer.writerows(rows)


def check(is_true, what):
    if not is_true:
        sys.exit(f"search_test: {what}")


def run_search(script, folder, rules, start):
    config = {"title": "made up", "shots": [], "variants": [start]}
    config["search"] = {"metrics": ["mse"], "mask": "all", "axes": AXES} | rules
    file = os.path.join(folder, "config.json")
    with open(file, "w", encoding="utf-8") as stream:
        json.dump(config, stream)
    program = os.path.join(folder, "ssrlab")
    with open(program, "w", encoding="utf-8") as stream:
        stream.write(f'#!/bin/sh\nexec "{sys.executable}" -B "{os.path.abspath(__file__)}" "$@"\n')
    os.chmod(program, os.stat(program).st_mode | stat.S_IXUSR)
    command = [sys.executable, "-B", script, file, "--out", os.path.join(folder, "out"), program]
    return subprocess.run(command, capture_output=True, text=True)


def search(script, folder, rules):
    result = run_search(script, folder, rules, {"variant": "sssr", "parameters": {"clamp": True}})
    check(result.returncode == 0, result.stderr)
    with open(os.path.join(folder, "out", "found.json"), encoding="utf-8") as stream:
        found = json.load(stream)["parameters"]
    with open(os.path.join(folder, "out", "search.csv"), newline="", encoding="utf-8") as stream:
        return found, list(csv.DictReader(stream))


def test_refusals(script, folder):
    """What makes points of the start is not dropped: it is refused before anything runs."""
    for more, why in (
        ({"sweep": {"taps": [4]}}, "'sweep' is not for the start of a search"),
        ({"each": {"taps": [4]}}, "'each' is not for the start of a search"),
        ({"against": {"taps": 4}}, "'against' is not for the start of a search"),
        ({"preset": ["corrected"]}, "'preset' = [\"corrected\"], but a search starts from one point"),
    ):
        result = run_search(script, folder, {}, {"variant": "sssr"} | more)
        check(result.returncode == 2 and why in result.stderr, f"{more}: {result.returncode} {result.stderr}")
        check(not os.path.exists(os.path.join(folder, "out")), f"{more}: a study ran")


def main():
    script = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        found, trials = search(script, folder, {})
        check(found == {"clamp": False, "taps": 16, "radius": 2.0}, f"found {found}")
        is_repetition = any(t["point"] == "taps=4" and t["study"] == "round_1_alone" for t in trials)
        check(not is_repetition, "the start was tried against itself")
        of_one_tap = [t["study"] for t in trials if t["point"] == "taps=1"]
        check(of_one_tap == ["round_1_alone"], f"one tap has twice the error, and was tried in {of_one_tap}")
    with tempfile.TemporaryDirectory() as folder:
        found, _ = search(script, folder, {"least_gain": 0.0})
        check(found == {"clamp": False, "taps": 16, "radius": 2.0, "noise": 0.5}, f"every gain counts: found {found}")
    with tempfile.TemporaryDirectory() as folder:
        found, trials = search(script, folder, {"rounds": 1})
        check(found == {"clamp": False, "taps": 16, "radius": 3.0}, f"after one round: found {found}")
    with tempfile.TemporaryDirectory() as folder:
        test_refusals(script, folder)


if __name__ == "__main__":
    if sys.argv[1] == "run":
        run(sys.argv[2], sys.argv[sys.argv.index("--out") + 1])
    else:
        main()
