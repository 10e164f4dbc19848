"""How often the intervals of `ssrlab tradeoff` hold the truth, on real noise.

usage: python3 experiments/python tradeoff.coverage_study SEEDS_AND_ROUNDS... [--scenes SCENES] [--leave-out SCENE ...] [--trials N]

SEEDS_AND_ROUNDS: results of experiments/studies/configs/tradeoff_coverage.json, or of other seeds without times, which take those of the first shot that
has some. All seeds and rounds are the truth; a trial draws 4 or 8 seeds with replacement and 15 successive rounds. SCENES: results of a study of many scenes (experiments/studies/configs/comparison.json), which are the truth of
what holds over scenes; a trial draws some with replacement. Prints the tables of README.md.
"""

import argparse
import math
import subprocess
import sys
import tempfile

import numpy as np

from ssrlab.tradeoff import curves, fits, points, uncertainty
from ssrlab import statistics
from ssrlab.mistakes import exit_code

ROUNDS = 15
PLACES = (0.25, 0.5, 0.75)  # along the true front, logarithmic


class Tally:
    """How many of all that could be judged, and how many of them held."""

    def __init__(self):
        self.held, self.judged, self.all = {}, {}, {}

    def add(self, name, low, high, truth):
        """`low`, `high`: None where the number has no interval; infinite where it is a bound on one side."""
        self.all[name] = self.all.get(name, 0) + 1
        if low is not None and high is not None:
            self.judged[name] = self.judged.get(name, 0) + 1
            self.held[name] = self.held.get(name, 0) + (low <= truth <= high)

    def text(self, name):
        if not self.judged.get(name):
            return "none"
        return f"{100 * self.held[name] / self.judged[name]:.1f} % of {100 * self.judged[name] / self.all[name]:.0f} %"


def students(values):
    return statistics.mean(values) if len(values) > 1 else (float(values[0]),) * 3


def decided(folder, left_out=()):
    """What ssrlab decides of a results folder."""
    with tempfile.TemporaryDirectory() as out:
        command = [statistics.program(), "tradeoff", folder, "--out", out]
        subprocess.run(command + (["--leave-out", *left_out] if left_out else []), check=True, stdout=subprocess.DEVNULL)
        return points.Study(out)


class World:
    """One shot's points with all their seeds and rounds."""

    def __init__(self, shot, rounds_of):
        """`rounds_of`: key to rounds, of points that were not timed here."""
        self.shot = shot
        for p in shot.points:
            p.rounds = p.rounds or rounds_of.get(p.key, {})
            p.cost = float(np.median(list(p.rounds.values()))) if p.rounds else None
            p.verdict = "front" if p.verdict == "no cost" and p.cost else p.verdict
        self.points = [p for p in shot.judged() if p.variant != "none"]
        self.seeds = [np.array([p.seeds[s] for s in sorted(p.seeds, key=int)]) for p in self.points]
        self.rounds = [np.array([p.rounds[r] for r in sorted(p.rounds)]) for p in self.points]

    def truth(self):
        return [self._point(p, s, r) for p, s, r in zip(self.points, self.seeds, self.rounds)]

    def trial(self, generator, count):
        chosen = generator.integers(0, max(map(len, self.seeds)), count)
        start = generator.integers(0, min(map(len, self.rounds)) - ROUNDS + 1)
        return [
            self._point(p, s[chosen] if len(s) > 1 else s, r[start : start + ROUNDS])
            for p, s, r in zip(self.points, self.seeds, self.rounds)
        ]

    def _point(self, p, seeds, rounds):
        error, low, high = students(seeds)
        made = points.Point(p.variant, p.point, p.label, error, max(low, 0.0), high, dict(enumerate(seeds)))
        made.rounds = {(0, i): float(ms) for i, ms in enumerate(rounds)}
        made.cost, made.cost_low, made.cost_high = statistics.median(rounds)
        return made


class Resampled:
    """What uncertainty.ShotDraws replaces: seeds and rounds resampled, all alike."""

    def __init__(self, of_points, generator, count=400):
        k, n = max(len(p.seeds) for p in of_points), max(len(p.rounds) for p in of_points)
        chosen, rounds = generator.integers(0, k, (count, k)), generator.integers(0, n, (count, n))
        seeds = [np.array(list(p.seeds.values())) for p in of_points]
        self.errors = np.array([s[chosen].mean(1) if len(s) > 1 else np.full(count, s[0]) for s in seeds])
        self.costs = np.array([np.median(np.array(list(p.rounds.values()))[rounds], 1) for p in of_points])


def curve_truths(true_points):
    """(variant, rows, costs to ask with the errors there, errors to ask with their costs, rows of the true front by rising cost,
    the middle (cost, error) of its first and of its last two points)"""
    for variant in dict.fromkeys(p.variant for p in true_points):
        rows = [i for i, p in enumerate(true_points) if p.variant == variant]
        own = [true_points[i] for i in rows]
        costs, errors = curves.column_of([p.cost for p in own]), curves.column_of([p.error for p in own])
        front = curves.sorted_front(costs, errors)
        on_front = front[0][front[2]], front[1][front[2]]
        if len(on_front[0]) < 2:
            continue
        asked = [on_front[0][0] ** (1 - s) * on_front[0][-1] ** s for s in PLACES] + [2 * on_front[0][-1]]
        wanted = [on_front[1][0] ** (1 - s) * on_front[1][-1] ** s for s in PLACES]
        at = [float(curves.error_at(costs, errors, c)[0]) for c in asked]
        to = [float(curves.cost_to(costs, errors, e)[0]) for e in wanted]
        order = np.lexsort((errors[:, 0], costs[:, 0]))
        points_on_front = [rows[i] for i in order[front[2][:, 0]]]
        ends = {
            "first": tuple(float(np.sqrt(v[0] * v[1])) for v in on_front),
            "last": tuple(float(np.sqrt(v[-2] * v[-1])) for v in on_front),
        }
        yield variant, rows, list(zip(asked, at)), list(zip(wanted, to)), points_on_front, ends


def study_bounds(drawn, draws, truths, count, tally):
    """What is said beyond a front's ends, where the truth is known: a curve without its true front's cheapest or dearest point is asked
    for an error or at a cost that the whole front has beyond its own ends."""
    for _, rows, _, _, front, ends in truths:
        if len(front) < 3:
            continue

        def without(gone):
            own = [i for i in rows if i != gone]
            return curves.Curve([drawn[i] for i in own], draws, own)

        (cost, error), curve = ends["first"], without(front[0])
        if error >= curve.start_error:
            _, low, high, _ = curve.cost_to(error)
            tally.add(("cost to an error that the cheapest point beats", count), -math.inf if low is None else low, high, cost)
        (cost, error), curve = ends["last"], without(front[-1])
        if cost > curve.end:
            _, low, high, _ = curve.error_at(cost)
            tally.add(("error past the end of a shortened front", count), -math.inf if low is None else low, high, error)


def study_curves(worlds, trials, tally):
    generator = np.random.default_rng(3)
    for world in worlds:
        truth = world.truth()
        truths = list(curve_truths(truth))
        for trial in range(trials):
            for count in (4, 8):
                drawn = world.trial(generator, count)
                for p, true in zip(drawn, truth):
                    tally.add(("error", count), p.error_low if len(p.seeds) > 1 else None, p.error_high, true.error)
                    tally.add(("median cost", count), p.cost_low, p.cost_high, true.cost)
                for kind, draws in (
                    ("", uncertainty.ShotDraws(drawn, 400, trial)),
                    ("resampled: ", Resampled(drawn, generator)),
                ):
                    if not kind:
                        study_bounds(drawn, draws, truths, count, tally)
                    for _, rows, asked, wanted, _, _ in truths:
                        curve = curves.Curve([drawn[i] for i in rows], draws, rows)
                        if kind:
                            curve.front, curve.upper = np.arange(len(rows)), 0.975
                        for cost, error in asked:
                            _, low, high, _ = curve.error_at(cost)
                            name, low = ("error past the front's end", -math.inf) if cost > curve.end else ("error at a cost", low)
                            tally.add((kind + name, count), low, high, error)
                        for error, cost in wanted:
                            _, low, high, share = curve.cost_to(error)
                            if error >= curve.start_error:
                                name, low = "cost to an error, before start", -math.inf
                            else:
                                name, low = "cost to an error", -math.inf if low is None and share else low
                            high = math.inf if low is not None and low > -math.inf and high is None else high
                            tally.add((kind + name, count), low, high, cost)


def study_fits(worlds, trials, tally):
    """A known law with the relative scatter of real seeds and rounds."""
    generator = np.random.default_rng(5)
    seeds = [s / s.mean() for w in worlds for s in w.seeds if len(s) > 1]
    rounds = [r / np.median(r) for w in worlds for r in w.rounds]
    for count in (4, 5, 6, 8):
        for _ in range(4 * trials):
            floor, exponent = generator.uniform(0, 0.5), generator.uniform(0.5, 2)
            costs = np.geomspace(4, 40, count)
            errors = floor + (1 - floor) * (costs / 4) ** -exponent
            law, deviations, found_costs, cost_deviations = [], [], [], []
            for e, c in zip(errors, costs):
                of = seeds[generator.integers(len(seeds))]
                value, low, high = students(e * of[generator.integers(0, len(of), 4)])
                law.append(value), deviations.append(fits._log_deviation(value, low, high))
                of = rounds[generator.integers(len(rounds))]
                start = generator.integers(0, len(of) - ROUNDS + 1)
                median, low, high = statistics.median(c * of[start : start + ROUNDS])
                found_costs.append(median), cost_deviations.append(fits._log_deviation(median, low, high))
            fit = fits.fit_law(found_costs, law, deviations, cost_deviations)
            tally.add(("floor of a fit", count), fit.floor_low, fit.floor_high, floor)
            tally.add(("exponent of a fit", count), fit.b_low if fit.status == "fitted" else None, fit.b_high, exponent)


def study_scenes(study, trials, tally, counts):
    """Over pairs of points, real logs of ratios of all scenes are the truth."""
    generator = np.random.default_rng(6)
    table = {}
    for shot in study.shots:
        if shot.divisor is None:
            continue
        for p in shot.points:
            if p.is_ranked() and p.error > 0 and p.key != study.baseline:
                table.setdefault(p.key, {}).setdefault(study.results.asset(shot.name), []).append(math.log(p.error / shot.divisor))
    means = {m: {s: np.mean(v) for s, v in of.items()} for m, of in table.items()}
    most = max(len(v) for v in means.values())
    whole = [m for m, v in means.items() if len(v) == most]
    samples = [np.array(list(means[m].values())) for m in whole]
    samples += [np.array([means[a][s] - means[b][s] for s in means[a]]) for i, a in enumerate(whole) for b in whole[:i:3]]
    samples = [s for s in samples if s.std() > 0]
    for values in samples:
        for trial in range(trials):
            for count in counts:
                drawn = values[generator.integers(0, len(values), count)]
                _, low, high, _ = statistics.mean_over_scenes((str(i), v) for i, v in enumerate(drawn))
                tally.add(("over scenes, Student's t", count), low, high, values.mean())
                if trial < 20:
                    tally.add(("over scenes, BCa", count), *statistics.bootstrap_over_scenes(drawn, trial), values.mean())
    return most, len(samples)


def print_table(tally, names, counts, of):
    print("| | " + " | ".join(f"{c} {of}" for c in counts) + " |\n" + "|" + "---|" * (len(counts) + 1))
    for name in names:
        print(f"| {name} | " + " | ".join(tally.text((name, c)) for c in counts) + " |")
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("seeds_and_rounds", nargs="+")
    parser.add_argument("--scenes")
    parser.add_argument("--leave-out", nargs="+", default=[], help="scenes")
    parser.add_argument("--trials", type=int, default=300)
    arguments = parser.parse_args()
    shots = [s for folder in arguments.seeds_and_rounds for s in decided(folder).shots]
    rounds_of = {p.key: p.rounds for s in reversed(shots) for p in s.points if p.rounds}
    worlds, tally = [w for w in (World(s, rounds_of) for s in shots) if w.points], Tally()
    print(f"{sum(len(w.points) for w in worlds)} points of {len(worlds)} shots\n")
    study_curves(worlds, arguments.trials, tally)
    names = ["error", "median cost", "error at a cost", "error past the front's end", "cost to an error", "cost to an error, before start"]
    names += ["resampled: " + n for n in names[2:]] + ["cost to an error that the cheapest point beats", "error past the end of a shortened front"]
    print_table(tally, names, (4, 8), "seeds")
    study_fits(worlds, arguments.trials, tally)
    print_table(tally, ["floor of a fit", "exponent of a fit"], (4, 5, 6, 8), "points")
    if not arguments.scenes:
        return
    counts = (4, 5, 6, 8, 12, 20)
    most, samples = study_scenes(decided(arguments.scenes, arguments.leave_out), arguments.trials, tally, counts)
    print(f"{most} scenes, {samples} points and pairs of them\n")
    print_table(tally, ["over scenes, Student's t", "over scenes, BCa"], counts, "scenes")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the tables"))
