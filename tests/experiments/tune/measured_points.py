"""Measures random points of a search's space, in small: the tables that tune_benchmark.py searches.

usage: PYTHONPATH=experiments/python python3 tests/experiments/tune/measured_points.py SSRLAB NAME FOLDER [POINTS]

NAME: of experiments/studies/configs/tune_NAME.json. FOLDER keeps the study. Writes measured_points/NAME.json beside this program:
`axes`, `declared` and `start` as Space takes them, and `points`: values in the order of axes, null for those that are not active, then the
logarithms of error and counted operations over the baseline's, means over the scenes."""

import json
import math
import os
import subprocess
import sys

import numpy as np
from ssrlab.repository import ROOT
from ssrlab.results import Results
from ssrlab.tune.space import Space

SCENES = {"mcguire_dda": ["roughness_gradient", "mirror_pillars"], "four_mode": ["roughness_gradient"]}  # a technique's compiles take minutes
BASELINE = "the baseline"


def ended_well(*words):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


def measured_in(results, label):
    """(logarithm of error, of operations): means over shots."""
    point = next(t["point"] for t in results.manifest["techniques"] if t["label"] == label)
    wanted = {"point": point, "target": "specular", "metric": "relmse", "mask": "reflective", "represents_shot": "1"}
    errors = [float(r["value"]) for r in results.read_csv("results.csv") if all(r[k] == v for k, v in wanted.items())]
    counts = [r for r in results.read_csv("costs.csv") if r["point"] == point and r["stage"] == "total" and r["quantity"] == "operations"]
    return np.array([np.mean(np.log(errors)), np.mean([math.log(max(float(r["value"]), 1)) for r in counts])])


def main(ssrlab, name, folder, count=200):
    shots = [{"scene": SCENES[name], "resolution": [64, 36], "warm_up": 4}]
    rules = {"time": "operations", "metrics": "relmse", "most_runs": 1, "judge": {"shots": shots}}
    config, search = (os.path.join(folder, f) for f in ("search.json", "search"))
    os.makedirs(folder, exist_ok=True)
    with open(config, "w", encoding="utf-8") as stream:
        path = os.path.join(ROOT, "experiments", "studies", "configs", f"tune_{name}.json")
        json.dump({"extends": path, "shots": shots, "reference": {"samples": 256}, "seeds": 2, "timing": {"frames": 0}, "tune": rules}, stream)
    ended_well(ssrlab, "tune", config, "--out", search)
    with open(os.path.join(search, "tune.json"), encoding="utf-8") as stream:
        asked = json.load(stream)
    base = next(p for p in asked["points"] if p["baseline"])
    start = next(p for p in asked["points"] if p["point"] == asked["tune"]["start"])
    manifest = Results(os.path.join(search, "search", "start")).manifest
    held = next(t["parameters"] for t in manifest["techniques"] if t["label"] == (start["label"] or start["point"]))
    space, random = Space(asked["tune"]["axes"], asked["parameters"], held), np.random.default_rng(1)
    points = [space.point(lambda axis: axis.draw(random)) for _ in range(int(count))]

    def entry(of, label, values, more):
        preset = {"preset": of["preset"]} if of["preset"] else {}
        return preset | more | {"technique": of["technique"], "label": label, "parameters": of["parameters"], "sweep": {k: [v] for k, v in values.items()}}

    common = {key: asked["study"][key] for key in ("resolution", "reference", "primary", "targets", "metrics", "masks", "fallback") if key in asked["study"]}
    tried = [entry(start, str(i), values, {}) for i, values in enumerate(points)]
    study = common | {"shots": shots, "seeds": 2, "timing": {"frames": 0}, "costs": True, "images": "none"}
    with open(os.path.join(folder, "points.json"), "w", encoding="utf-8") as stream:
        json.dump(study | {"techniques": [entry(base, BASELINE, base["swept"], {"baseline": True}), *tried]}, stream)
    ended_well(ssrlab, "run", os.path.join(folder, "points.json"), "--out", os.path.join(folder, "points"), "--no-report")
    results = Results(os.path.join(folder, "points"))
    least = measured_in(results, BASELINE)
    rows = [[*(v.get(a.name) for a in space.axes), *(measured_in(results, str(i)) - least).round(5)] for i, v in enumerate(points)]
    axes = {a.name: asked["tune"]["axes"][a.name] for a in space.axes}
    kept = {"axes": axes, "declared": {a: {"type": asked["parameters"][a].get("type")} for a in axes}, "start": {k: v for k, v in held.items()}}
    with open(os.path.join(os.path.dirname(__file__), "measured_points", f"{name}.json"), "w", encoding="utf-8") as stream:
        stream.write(json.dumps(kept, indent=1)[:-2] + ',\n "points": [\n' + ",\n".join(json.dumps(row) for row in rows) + "\n ]\n}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
