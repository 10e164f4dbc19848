"""The points of a study, each with its error and its cost in every shot."""

import csv
import os
from dataclasses import dataclass, field

from ssrlab.results import Results, ResultsError, commits_of, rows_that_speak

TOTAL = "total"  # of a technique's own stages (experiments/RESULTS.md): no G-buffer, no lit colour


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
    is_ranked: bool  # the interval holds all that is random
    asks_scene: bool = False
    rounds: dict = field(default_factory=dict)  # frame to ms: all points took turns in it; none of a counted cost
    cost: float = None  # median over the rounds (time_summary.csv), or counted; None: not timed
    cost_low: float = None  # its interval ...
    cost_high: float = None
    fits_from: float = None  # ... and the least budgets that it certainly fits into, and that it may fit into
    may_fit_from: float = None
    disturbed_share: float = 0.0
    noise: float = 0.0  # what the reference's own noise scores as an error

    @property
    def key(self):
        return self.variant, self.point

    def set_cost(self, cost, low, high, fits_from, may_fit_from, disturbed_share):
        self.cost, self.cost_low, self.cost_high = cost, low, high
        self.fits_from, self.may_fit_from, self.disturbed_share = fits_from, may_fit_from, disturbed_share

    def why_not_judged(self):
        """What keeps the point from being compared by error and cost; empty where nothing does."""
        if self.asks_scene:
            return "asks the scene"
        if not self.is_ranked or self.error_low is None or self.error_high is None:
            return "not ranked"
        if self.cost is None or not self.cost > 0:
            return "no cost"
        return "" if self.error > 0 else "error not above 0"


@dataclass
class Pair:
    """What ssrlab decided of two points of a shot (pairs.csv, experiments/evaluation/pairs.h)."""

    errs_less: bool  # significantly
    dominates: str  # "yes", "maybe", "no", or empty without costs
    is_dominated: str


@dataclass
class Shot:
    name: str
    label: str
    scene: str
    asset: str  # what the scene shows: those of one are averaged, as they are no independent samples
    machine: str  # what costs must have in common to be compared
    floor: float  # relative difference of costs below which nothing is said
    is_clock_proven: bool
    points: list
    ladder: dict  # rung to (error, low, high)
    error_effects: dict = field(default_factory=dict)  # (key, key of the baseline), as the study asked for them, to (ratio, low, high)
    cost_effects: dict = field(default_factory=dict)  # the same of costs: (ratio, low, high, is significant)
    pairs: dict = field(default_factory=dict)  # (key, key of the other) to a Pair, both ways round

    def judged(self):
        return [p for p in self.points if not p.why_not_judged()]

    def errs_less(self, a, b):
        """Whether the point with key a errs significantly less than that with key b."""
        return (a, b) in self.pairs and self.pairs[a, b].errs_less

    def divisor(self, key):
        """The error of a baseline; None where any error would be a huge multiple of it: it cannot be told from 0, is not twice
        what the reference's noise scores, or is below a millionth of the shot's largest, as rounding leaves it."""
        point = self.point_of(key)
        if point is None or not point.error_low or point.error_low <= 0:
            return None
        least = max(2 * point.noise, 1e-6 * max(p.error for p in self.points))
        return point.error if point.error > least else None

    def point_of(self, key):
        return next((p for p in self.points if p.key == key), None)


def _number(text):
    return float(text) if text else None


def _machines(manifest):
    """Shot to the processor and the device that its times were taken on."""
    found = {}
    for entry in manifest.get("provenance", []):
        host, device = entry.get("host", {}), entry.get("device", {})
        name = f"{host.get('name', '?')} ({host.get('cpu', '?')}, {host.get('cores', '?')} cores), {device.get('name', '?')}"
        for cell in entry.get("cells", []):
            shot, _, what = cell.get("what", "").rpartition(": ")
            if what in ("times", "timing"):  # the latter in folders of earlier versions
                found[shot] = name
    return found


class Study:
    """A results folder's shots, of one error (target, metric, mask), by time or by a counted quantity."""

    def __init__(self, folder, target=None, metric=None, mask=None, cost=None, left_out=(), pairs=None):
        """`pairs`: the file of pairs; None: no verdicts are needed."""
        self.results = Results(folder)
        manifest = self.results.manifest
        self.commits = commits_of(manifest)
        primary = manifest.get("primary", {})
        self.target = target or primary.get("target", "specular")
        self.metric = metric or primary.get("metric", "mse")
        self.mask = mask or primary.get("mask", "reflective")
        self.counted = cost
        self.unit = cost or "ms"
        self.variants = {(v["variant"], v["point"]): v for v in manifest.get("variants", [])}
        self.times = self.results.read_csv("times.csv", is_optional=True)
        self.shots = self._shots()
        self._leave_out(left_out)
        if not self.shots:
            found = sorted({f"{r['target']} {r['metric']} {r['mask']}" for r in self.results.errors})
            raise ResultsError(f"{folder} has no errors of {self.error_name()}; it has: {', '.join(found) or 'none'}")
        self._add_costs()
        self._add_effects()
        if pairs:
            self._add_pairs(pairs)

    def error_name(self):
        return f"{self.target} {self.metric} {self.mask}"

    def is_error(self, row):
        return (row["target"], row["metric"], row["mask"]) == (self.target, self.metric, self.mask)

    def label_of(self, key):
        return self.results.point_label(*key)

    def parameters_of(self, key):
        return self.variants.get(key, {}).get("parameters", {})

    def key_of(self, text):
        """(variant, point) of VARIANT:POINT as users write it."""
        variant, _, point = text.partition(":")
        key = (variant, point or "default")
        if key not in self.variants:
            known = ", ".join(f"{v}:{p}" for v, p in self.variants)
            raise ResultsError(f"the study has no point {text}; it has {known}")
        return key

    def baseline(self, text=None):
        """The point that errors are told as multiples of: no screen-space reflections, unless another is asked for."""
        if text:
            return self.key_of(text)
        without = [key for key in self.variants if key[0] == "none"]
        return (without or [key for key, v in self.variants.items() if v.get("baseline")] or list(self.variants))[0]

    def _shots(self):
        entries = {s["shot"]: s for s in self.results.manifest.get("shots", [])}
        seeds = {}
        for row in rows_that_speak(self.results.read_csv("results.csv", is_optional=True)):
            if self.is_error(row) and row["value"]:
                seeds.setdefault((row["shot"], row["variant"], row["point"]), {})[row["seed"]] = float(row["value"])
        shots = {}
        for row in self.results.errors:
            if not self.is_error(row) or not row["value"]:
                continue
            shot = shots.setdefault(row["shot"], self._shot(row["shot"], entries.get(row["shot"], {})))
            if not row["frame"].isdigit():
                shot.ladder = {}  # the ladder is of the last frame alone, and this speaks for all
            key = (row["variant"], row["point"])
            shot.points.append(
                Point(
                    *key,
                    self.label_of(key),
                    float(row["value"]),
                    _number(row["low"]),
                    _number(row["high"]),
                    seeds.get((row["shot"], *key), {}),
                    row["ranked"] == "1",
                    bool(self.variants.get(key, {}).get("asks_scene")),
                    noise=_number(row["floor"]) or 0.0,
                )
            )
        return list(shots.values())

    def _leave_out(self, names):
        for name in names:
            if not any(name in (s.name, s.scene) for s in self.shots):
                raise ResultsError(f"the study has no shot or scene '{name}'; it has {', '.join(s.name for s in self.shots)}")
        self.shots = [s for s in self.shots if s.name not in names and s.scene not in names]

    def _shot(self, name, entry):
        ladder = {
            rung["rung"]: (rung["value"], rung.get("low"), rung.get("high"))
            for rung in entry.get("truth_ladder", [])
            if self.is_error(rung) and isinstance(rung.get("value"), (int, float))
        }
        clock = self.results.manifest.get("clock", {})
        self.has_noise_of_times = bool(self.counted) or "aa_floors" in clock
        proofs = [p.get("verdict") == "passed" for p in clock.get("proofs", []) if name in p.get("shots", [])]
        size = f"{entry.get('width', '?')}x{entry.get('height', '?')}"
        shown = self.results.shot_label(name)
        scene = entry.get("scene") or name.split(".")[0]
        floor = 0.0 if self.counted else clock.get("aa_floors", {}).get(name, 0.0)
        return Shot(name, shown, scene, self.results.asset(name), size, floor, bool(self.counted) or any(proofs), [], ladder)

    def _add_costs(self):
        points = {(s.name, p.variant, p.point): p for s in self.shots for p in s.points}
        if self.counted:
            self._add_counts(points)
            return
        machines, clocks = _machines(self.results.manifest), {}
        for row in self.times:
            point = points.get((row["shot"], row["variant"], row["point"]))
            if point is None or row["stage"] != TOTAL:
                continue
            # Several seeds may have been timed: each of their frames is a round of its own.
            point.rounds[(int(row["seed"] or 0), int(row["frame"]))] = float(row["milliseconds"])
        for row in self.results.times:
            point = points.get((row["shot"], row["variant"], row["point"]))
            if point is None or row["stage"] != TOTAL:
                continue
            columns = ("median_ms", "low_ms", "high_ms", "fits_from_ms", "may_fit_from_ms", "disturbed_share")
            point.set_cost(*(float(row[c]) for c in columns))
            clocks[row["shot"]] = row["clock"]
        for shot in self.shots:
            shot.machine = f"{machines.get(shot.name, 'machine not known')}, {clocks.get(shot.name, 'no clock')}, {shot.machine}"

    def _add_counts(self, points):
        rows = [r for r in self.results.read_csv("costs.csv", is_optional=True) if r["quantity"] == self.counted]
        if not rows:
            raise ResultsError(f"{os.path.join(self.results.folder, 'costs.csv')} has no '{self.counted}'")
        sums, totals = {}, {}
        for row in rows:
            key = (row["shot"], row["variant"], row["point"])
            if row["stage"] == TOTAL:
                totals[key] = float(row["value"])
            else:
                sums[key] = sums.get(key, 0.0) + float(row["value"])
        for key, value in (sums | totals).items():
            if key in points:
                points[key].set_cost(value, value, value, value, value, 0.0)

    def _add_effects(self):
        shots = {s.name: s for s in self.shots}

        def pair_of(row):
            return (row["variant"], row["point"]), (row["against_variant"], row["against_point"])

        for row in self.results.effects:
            if self.is_error(row) and row["shot"] in shots and row["ratio"] and row["low_holm"] and row["high_holm"]:
                shots[row["shot"]].error_effects[pair_of(row)] = tuple(float(row[c]) for c in ("ratio", "low_holm", "high_holm"))
        for row in () if self.counted else self.results.read_csv("time_effects.csv", is_optional=True):
            if row["shot"] in shots and row["stage"] == TOTAL:
                ends = ("low_holm", "high_holm") if row["verdict"] else ("low", "high")
                ratios = tuple(float(row[c]) for c in ("ratio", *ends))
                shots[row["shot"]].cost_effects[pair_of(row)] = (*ratios, row["verdict"] in ("less", "more"))

    def _add_pairs(self, file):
        shots = {s.name: s for s in self.shots}
        with open(file, newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(stream):
                if row["shot"] not in shots:
                    continue
                a, b = (row["variant"], row["point"]), (row["other_variant"], row["other_point"])
                pairs, verdict = shots[row["shot"]].pairs, row["error_verdict"]
                pairs[a, b] = Pair(verdict == "less", row["dominates"], row["is_dominated"])
                pairs[b, a] = Pair(verdict == "more", row["is_dominated"], row["dominates"])
