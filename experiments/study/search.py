"""Searches a variant's parameters for the least error: a coordinate descent whose every step is a study of its own.

usage: search.py CONFIG --out DIR -- SSRLAB [options of `ssrlab run`]

The config is a study of one variant, the point to start from, with "search" (experiments/README.md). Each round runs every
other value of every axis alone against the point that is held, then the best value of each axis together, and holds the best
of all. The measure is error over held error, the geometric mean over shots and metrics; a point is better only if its 95 %
interval lies below 1 - least_gain, since a search that follows noise ends anywhere, and one that follows thousandths is of
its own scenes. A value that was worse by a quarter at least is not tried in later rounds. It stops where no point is better.

DIR gets start, round_N_alone and round_N_together (the studies, with their reports), search.csv (every point that was tried)
and found.json (the point where it ended). A search that was stopped continues, as its studies do."""

import argparse
import csv
import json
import math
import os
import subprocess
import sys
from dataclasses import dataclass

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../figures"))
from paper_figures.results import Results, ResultsError  # noqa: E402  (found by the path above)


HOPELESS = 1.25  # least ratio of a value that is not tried again
TAKEN = ("variant", "preset", "parameters", "seeds", "timing")  # of the start, into every study


@dataclass
class Trial:
    """A point, against the one that was held when it was tried."""

    study: str
    values: dict  # that differ from the held point's
    ratio: float  # of errors
    low: float
    high: float
    time: float  # over that of the point that the search started from

    def is_better(self, rules):
        """`rules`: the config's "search"."""
        return self.high < 1 - rules.get("least_gain", 0.01) and self.time <= rules.get("most_time", math.inf)


def label_of(values):
    return " ".join(f"{k}={v if isinstance(v, str) else json.dumps(v)}" for k, v in sorted(values.items()))


def start_of(config):
    """The variant that the search starts from. Fails on what its studies would not have: what makes several points, too, where
    only one value is given."""
    if len(config["variants"]) != 1:
        raise ResultsError(f"variants: a search starts from one of them, but here are {len(config['variants'])}")
    (start,) = config["variants"]
    for key in start:
        if key not in TAKEN + ("baseline",):  # every search's start is a baseline
            raise ResultsError(f"variants: '{key}' is not for the start of a search, which takes {', '.join(TAKEN)}")
    for key in ("variant", "preset"):
        if not isinstance(start.get(key, ""), str):
            raise ResultsError(f"variants: '{key}' = {json.dumps(start[key])}, but a search starts from one point: write a single name")
    return start


def geometric_mean(rows, what):
    """Ratio and interval of effects: half-widths of logarithms, independent between shots, added in quadrature. Those of
    several metrics of one shot are not independent; their mean half-width is taken."""
    logs, halves = [], {}
    for row in rows:
        if not row["ratio"] or not row["low"]:
            raise ResultsError(f"{what}: no interval in {row['shot']}, {row['metric']}: the search needs several seeds")
        logs.append(math.log(float(row["ratio"])))
        halves.setdefault(row["shot"], []).append(math.log(float(row["high"]) / float(row["low"])) / 2)
    mean = sum(logs) / len(logs)
    half = math.sqrt(sum((sum(h) / len(h)) ** 2 for h in halves.values())) / len(halves)
    return math.exp(mean), math.exp(mean - half), math.exp(mean + half)


class Search:
    def __init__(self, config, out, command):
        self.config, self.out, self.command = config, out, command
        self.rules = config["search"]
        self.variant = start_of(config)
        self.preset = self.variant.get("preset", "")
        self.start = self.variant.get("parameters", {})
        self.found = {}  # what the held point changes of the start
        self.defaults = {}  # every parameter of the start
        self.time = 1.0  # of the held point, over that of the start
        self.hopeless = []  # changes of one value that are not tried again
        self.trials = []

    def run(self):
        self.study("start", [])
        for number in range(1, self.rules.get("rounds", 8) + 1):
            alone = self.study(f"round_{number}_alone", self.changes())
            self.hopeless += [t.values for t in alone if t.low > HOPELESS]
            best = self.best_of_each_axis(alone)
            tried = alone + (self.study(f"round_{number}_together", [best]) if len(best) > 1 else [])
            better = [t for t in tried if t.is_better(self.rules)]
            if not better:
                break
            self.hold(min(better, key=lambda t: t.ratio))
        self.write()

    def changes(self):
        """Every value of every axis that the held point does not have, but the hopeless ones."""
        held = self.defaults | self.found
        changes = [{name: v} for name, values in self.rules["axes"].items() for v in values if held[name] != v]
        return [change for change in changes if change not in self.hopeless]

    def best_of_each_axis(self, trials):
        best = {}
        for trial in sorted(trials, key=lambda t: t.ratio):
            if trial.is_better(self.rules):
                for name, value in trial.values.items():
                    best.setdefault(name, value)
        return best

    def study(self, name, points):
        """Runs `points` against the held one, and reads how they compare."""
        own = {k: self.variant[k] for k in TAKEN if k in self.variant}
        own["parameters"] = self.start | self.found
        swept = [own | {"sweep": {key: [value] for key, value in values.items()}} for values in points]
        study = {k: v for k, v in self.config.items() if k not in ("search", "tables")}
        study |= {"variants": [own | {"baseline": True}, *swept]}
        folder = os.path.join(self.out, name)
        os.makedirs(self.out, exist_ok=True)
        file = folder + ".json"  # beside the folder: study.json in it is ssrlab's own
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(study, stream, indent=1)
        subprocess.run([self.command[0], "run", file, "--out", folder, *self.command[1:]], check=True)
        results = Results(folder)
        self.defaults = self.defaults or results.manifest["variants"][0]["parameters"]
        trials = self.read(name, results, points)
        self.trials += trials
        return trials

    def read(self, name, results, points):
        wanted = {(self.rules.get("target", "specular"), m, self.rules.get("mask", "reflective")) for m in self.metrics()}
        trials = []
        held, *names = (v["point"] for v in results.manifest["variants"])  # in the order in which study() names them
        for values, point in zip(points, names, strict=True):
            rows = [
                r
                for r in results.effects
                if r["against"] == "baseline" and r["point"] == point and (r["target"], r["metric"], r["mask"]) in wanted
            ]
            if not rows:
                raise ResultsError(f"{results.folder}: effects.csv has nothing of '{point}': does the study measure {wanted}?")
            trials.append(Trial(name, values, *geometric_mean(rows, point), self.time_of(results, point, held)))
        return trials

    def metrics(self):
        return self.rules.get("metrics", ["relmse"])

    def time_of(self, results, point, held):
        logs = []
        for shot in results.shots():
            totals = {k[1]: stages["total"].value for k, stages in results.times_of(shot).items() if "total" in stages}
            if point in totals:
                logs.append(math.log(totals[point] / totals[held]))
        if not logs and "most_time" in self.rules:
            raise ResultsError(f"{results.folder}: '{point}' was not timed, but the search has 'most_time'")
        return self.time * math.exp(sum(logs) / len(logs)) if logs else self.time

    def hold(self, trial):
        self.found |= trial.values
        self.time = trial.time
        print(f"held: {label_of(trial.values)}: error x{trial.ratio:.3f} [{trial.low:.3f}, {trial.high:.3f}], time x{trial.time:.2f}")

    def write(self):
        with open(os.path.join(self.out, "search.csv"), "w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(["study", "point", "ratio", "low", "high", "time"])
            for t in self.trials:
                writer.writerow([t.study, label_of(t.values), t.ratio, t.low, t.high, t.time])
        with open(os.path.join(self.out, "found.json"), "w", encoding="utf-8") as stream:
            json.dump({"variant": self.variant["variant"], "preset": self.preset, "parameters": self.start | self.found}, stream, indent=1)
            stream.write("\n")
        print(f"{len(self.trials)} points tried; found: {json.dumps(self.found)}, in {os.path.join(self.out, 'found.json')}")


def main():
    parser = argparse.ArgumentParser(description="Search a variant's parameters for the least error.")
    parser.add_argument("config", help="what `ssrlab` read from the search's config: a JSON file without comments")
    parser.add_argument("--out", required=True, help="folder of the studies and of what is found")
    parser.add_argument("command", nargs="+", help="ssrlab, and options of `ssrlab run`")
    arguments = parser.parse_args()
    try:
        with open(arguments.config, encoding="utf-8") as stream:
            config = json.load(stream)
        Search(config, arguments.out, arguments.command).run()
    except ResultsError as mistake:
        print(f"error: {mistake}", file=sys.stderr)
        return 2
    except subprocess.CalledProcessError as failed:
        return failed.returncode
    return 0


if __name__ == "__main__":
    sys.exit(main())
