"""The points of a study, each with its error and its cost in every shot, as ssrlab judged them (experiments/results/tradeoff/tradeoff.h)."""

from dataclasses import dataclass, field

from ssrlab import csv_files
from ssrlab.csv_files import needed_number, number, whole
from ssrlab.json_files import read_json
from ssrlab.results import Results, commits_of, representative_rows
from ssrlab.text_files import path_inside

TOTAL = "total"  # of a technique's own stages (experiments/RESULTS.md): no G-buffer, no lit colour
JUDGED = ("front", "dominated", "undecided")  # front.csv's verdicts of points that are compared by error and cost
NEVER_RANKED = ("uses scene data", "not ranked")
TEXTS = ("shot", "scene", "machine", "variant", "point", "label", "unit", "verdict", "dominated_by", "undecided_with", "baseline", "standing", "against_variant", "against_point", "change", "group")


ASKED = {  # asked.json
    **{"results": str, "out": str, "baseline": [str], "times": [float], "factors": [float], "target": str, "metric": str, "mask": str, "costs": str, "unit": str},
    "refused": [{"point": [str], "shots": [str], "why": str}],
    **{"divisors": {"*": (float, None)}, "chosen": [{"shot": str, "variant": str, "cost": float, "point": str, "chosen_on": str, "fits": str}]},
}


@dataclass
class Point:
    """A variant's point in one shot."""

    variant: str
    point: str
    label: str
    error: float
    error_low: float  # None: no interval that could be compared
    error_high: float
    seeds: dict  # seed to error; one of a point that does not depend on it
    verdict: str = "front"  # of front.csv
    rounds: dict = field(default_factory=dict)  # frame to ms: all points took turns in it; none of costs that are not timed
    cost: float = None  # median over the rounds (time_summary.csv), counted or estimated; None: there is none
    cost_low: float = None
    cost_high: float = None
    disturbed_share: float = 0.0

    @property
    def key(self):
        return self.variant, self.point

    def is_ranked(self):
        return self.verdict not in NEVER_RANKED

    def is_judged(self):
        return self.verdict in JUDGED


@dataclass
class Shot:
    name: str
    label: str
    scene: str
    machine: str  # what costs must have in common to be compared
    floor: float  # relative difference of costs below which nothing is said
    is_clock_proven: bool
    points: list
    ladder: dict  # rung to (error, low, high)
    divisor: float = None  # the baseline's error; None where it is no measure

    def judged(self):
        return [p for p in self.points if p.is_judged()]


def read_rows(folder, name):
    """A table that ssrlab wrote for these answers: texts as they are, numbers as numbers, None where there is none."""
    return [row | {c: _number(row, c) for c in row if c not in TEXTS} for row in csv_files.read_rows(path_inside(folder, name))[1]]


def _number(row, column):
    return whole(row, column) if row[column].isdigit() else number(row, column)


class Study:
    """A results folder's shots, of one error (target, metric, mask), by time, by a counted quantity or by a chip's estimated time."""

    def __init__(self, folder):
        """`folder`: where `ssrlab tradeoff` wrote what was asked (asked.json) and what it decided."""
        self.asked = read_json(path_inside(folder, "asked.json"), ASKED)
        self.results = Results(self.asked["results"])
        self.commits = commits_of(self.results.manifest)
        self.target, self.metric, self.mask = (self.asked[k] for k in ("target", "metric", "mask"))
        self.baseline = tuple(self.asked["baseline"])
        self.costs, self.unit = self.asked["costs"], self.asked["unit"]
        self.is_timed = self.costs == "timed"
        self.has_noise_of_times = not self.is_timed or "aa_floors" in self.results.manifest.get("clock", {})
        self.front, self.across, self.stages = (read_rows(folder, f"{name}.csv") for name in ("front", "across", "stages"))
        self.chosen = {(c["shot"], c["variant"], c["cost"]): c for c in self.asked["chosen"]}
        self.shots = self._shots()
        self._add_rounds()

    def is_error(self, row):
        return (row["target"], row["metric"], row["mask"]) == (self.target, self.metric, self.mask)

    def label_of(self, key):
        return self.results.point_label(*key)

    def parameters_of(self, key):
        return self.results.parameters_of(*key)

    def _shots(self):
        seeds = {}
        for row in representative_rows(self.results.read_csv("results.csv", is_optional=True)):
            if self.is_error(row) and row["value"]:
                seeds.setdefault((row["shot"], row["variant"], row["point"]), {})[row["seed"]] = needed_number(row, "value")
        shots = {}
        for row in self.front:
            shot = shots.setdefault(row["shot"], self._shot(row["shot"], row["scene"], row["machine"]))
            own = seeds.get((row["shot"], row["variant"], row["point"]), {})
            errors, costs = ((row[c], row[c + "_low"], row[c + "_high"]) for c in ("error", "cost"))
            point = Point(row["variant"], row["point"], row["label"], *errors, own, row["verdict"])
            point.cost, point.cost_low, point.cost_high = costs
            shot.points.append(point)
        for row in self.results.errors:
            if row["shot"] in shots and self.is_error(row) and not row["frame"].isdigit():
                shots[row["shot"]].ladder = {}  # the ladder is of the last frame alone, and this row represents all
        return list(shots.values())

    def _shot(self, name, scene, machine):
        entry, clock = self.results.shot_entries.get(name, {}), self.results.manifest.get("clock", {})
        ladder = {
            rung["rung"]: (rung["value"], rung.get("low"), rung.get("high"))
            for rung in entry.get("truth_ladder", [])
            if self.is_error(rung) and isinstance(rung.get("value"), (int, float))
        }
        proofs = [p.get("verdict") == "passed" for p in clock.get("proofs", []) if name in p.get("shots", [])]
        floor = 0.0 if not self.is_timed else clock.get("aa_floors", {}).get(name, 0.0)
        return Shot(name, self.results.shot_label(name), scene, machine, floor, not self.is_timed or any(proofs), [], ladder, self.asked["divisors"][name])

    def _add_rounds(self):
        if not self.is_timed:
            return
        points = {(s.name, p.variant, p.point): p for s in self.shots for p in s.points}
        for row in self.results.read_csv("times.csv", is_optional=True):
            point = points.get((row["shot"], row["variant"], row["point"]))
            if point and row["stage"] == TOTAL:  # several seeds may have been timed: each of their frames is a round of its own
                point.rounds[(whole(row, "seed") or 0, whole(row, "frame"))] = needed_number(row, "milliseconds")
        for row in self.results.times:
            point = points.get((row["shot"], row["variant"], row["point"]))
            if point and row["stage"] == TOTAL:
                point.disturbed_share = number(row, "disturbed_share") or 0.0
