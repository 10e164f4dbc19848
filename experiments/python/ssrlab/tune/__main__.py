"""Searches a technique's parameters for the front of error against time, and evaluates the result on other scenes.

usage: python3 experiments/python tune ASKED --out DIR -- SSRLAB [options of `ssrlab run`]

ASKED is what `ssrlab tune` read of a study with "tune" (experiments/docs/tune.md). The optimiser proposes batches of points (proposals.py);
each runs with half of the seeds on one shot, on two, four and so on to all, then with all seeds, and is stopped as soon as it is significantly
worse than a point of the front that takes no more time (race.py). Every step is a study in DIR/search, every evaluation a cell of it
(studies.py). A stopped search repeats the optimiser's steps and reads the finished cells, so that it ends as if it
had not been stopped. Its files in DIR: outcome.py."""

import argparse
import math
import os
import sys

from ssrlab.json_files import read_json
from ssrlab.mistakes import ResultsError, counted, exit_code, say, shown, stop

try:
    import scipy  # noqa: F401
except ImportError as missing:
    stop(f"{missing}: install python3-scipy")
from ssrlab.tune.outcome import Outcome
from ssrlab.tune.program import Program, ProgramFailed, declared_by
from ssrlab.tune.proposals import Proposals, key_of
from ssrlab.tune.race import Point, Race
from ssrlab.tune.space import Space
from ssrlab.tune.studies import Studies, StudyFailed

SAME_TIME = {True: 1.05, False: 1.0}  # with a clock, whose noise it is about; with counts, which are exact
BEYOND = 1.25  # a point that takes so much longer than the largest budget in the first shot is not run in others; what has no time counts as such
REFUSED = 2  # exit code of a program whose images cannot be compared
AT_DEFAULTS = "defaults"  # the name of a program's point without settings
FUTILE = 5  # batches without a point that was not tried before, after which the space counts as searched


def doubling(most):
    """1, 2, 4 and so on to `most`."""
    steps = [1]
    while steps[-1] < most:
        steps.append(min(2 * steps[-1], most))
    return steps


class Tuning:
    def __init__(self, asked, out, command):
        self.rules, self.given = asked["tune"], asked["points"]
        self.names = [p["label"] or p["point"] for p in self.given]
        self.baseline = self.names[next(i for i, p in enumerate(self.given) if p["baseline"])]
        self.program = None
        if self.rules.get("program"):
            self.program, self.start = Program(self.rules["program"], asked["folder"], out, command, asked["study"]), AT_DEFAULTS
            if AT_DEFAULTS in self.names:
                raise ResultsError(f"techniques: the label '{AT_DEFAULTS}' is that of the program without settings; call yours otherwise")
        else:
            start = next(i for i, p in enumerate(self.given) if p["point"] == self.rules["start"])
            self.start_entry, self.start = self.given[start], self.names[start]
            self.searched, self.declared = os.path.basename(self.start_entry["technique"]), asked["parameters"]  # of a technique's folder its name
        self.studies = Studies(asked, out, command, self.baseline)
        self.out = out
        self.most_runs, self.most_minutes, self.budgets = (self.rules[key] for key in ("most_runs", "most_minutes", "budgets"))
        self.tried = []  # Points, in order
        self.known = {}  # values as text to the Point that has them

    def run(self):
        self.begin()
        batch, futile = 0, 0
        while self.runs() + self.runs_of_a_point() <= self.most_runs and self.studies.minutes_so_far() < self.most_minutes and futile < FUTILE:
            batch += 1
            futile = 0 if self.do_batch(batch) else futile + 1
        Outcome(self, self.judge()).write()

    def begin(self):
        """Runs the points that the config names in full, the first to compare with."""
        seeds = self.studies.seeds
        self.few, self.rest = seeds[: max(2, len(seeds) // 2)], seeds[max(2, len(seeds) // 2) :]
        entries = [self.given_entry(i) for i in range(len(self.given))]
        self.names += [AT_DEFAULTS] if self.program else []
        say(f"start: {', '.join(self.names)} in {counted(len(self.studies.shots), 'shot')}, which {'needs' if len(self.studies.shots) == 1 else 'need'} references")
        if self.program:
            self.program.render(AT_DEFAULTS, {}, self.studies.shots)
            entries.append(self.trial_entry(AT_DEFAULTS, {}))
        results = self.studies.run("search/start", entries, self.studies.shots, seeds)
        self.points = {name: Point(name, {}) for name in self.names}
        for name in [self.baseline, *self.names]:
            self.studies.read_into(self.points[name], results)
            if name == AT_DEFAULTS and self.program:
                self.learn_settings(results)
            if self.points[name].refusal:
                raise ResultsError(f"{results.folder}: the time of '{name}' on {self.studies.cost} cannot be estimated: {self.points[name].refusal}")
        self.steps = doubling(len(self.studies.shots))
        self.race = Race(self.points[self.baseline], SAME_TIME[self.studies.has_clock], len(self.steps))
        self.baseline_cost = self.cost_of_baseline(results)
        for name in self.names:
            if name != self.baseline:
                self.race.add(self.points[name])
        self.space = Space(self.rules["axes"], self.declared, self.points[self.start].parameters)
        self.proposals = Proposals(self.space, self.rules["seed"], math.log(max(self.budgets)))
        for name in [AT_DEFAULTS] if self.program else dict.fromkeys([self.start, *self.names]):
            self.proposals.begin_with(self.points[name].parameters)

    def learn_settings(self, results):
        """Learns the names and defaults of the program's settings, which include the axes."""
        settings = self.points[AT_DEFAULTS].parameters
        unknown = [name for name in self.rules["axes"] if name not in settings]
        if unknown:
            states = f"the file states {', '.join(sorted(settings))}" if settings else "the file states no setting"
            raise ResultsError(f"tune: 'axes': the external.json that the program writes states no value of '{unknown[0]}'; {states}")
        self.declared = declared_by(settings, self.rules["axes"])
        self.searched = next(v["technique"] for v in results.manifest["techniques"] if v.get("label") == AT_DEFAULTS)

    def cost_of_baseline(self, results):
        """The baseline's cost: geometric mean over shots."""
        base = next(v["point"] for v in results.manifest["techniques"] if v.get("label") == self.baseline)
        costs = [cost for _, cost in self.studies.times_of(results, base).values()]
        if not costs:
            raise ResultsError(f"{results.folder}: '{self.baseline}' was not {'timed' if self.studies.has_clock else 'counted'}")
        return math.exp(sum(math.log(c) for c in costs) / len(costs))

    def given_entry(self, index):
        """A point of the config, as an entry of `techniques`."""
        point = self.given[index]
        entry = {"technique": point["technique"], "label": self.names[index], "baseline": point["baseline"]}
        return entry | self.made_of(point, point["swept"])

    def trial_entry(self, name, values):
        """A tried point, as an entry of `techniques`."""
        if self.program:
            return {"external": self.program.images(name), "label": name, "point": self.program.point(name)}
        return {"technique": self.start_entry["technique"], "label": name} | self.made_of(self.start_entry, values)

    @staticmethod
    def made_of(point, swept):
        """Preset and parameters; swept parameters name the point."""
        preset = {"preset": point["preset"]} if point["preset"] else {}
        return preset | {"parameters": point["parameters"], "sweep": {k: [v] for k, v in swept.items()}}

    def runs_of_a_point(self):
        """The most runs that a complete point took so far."""
        return max(p.runs() for p in [*self.points.values(), *self.tried])

    def runs(self):
        return sum(p.runs() for p in [*self.points.values(), *self.tried])

    def do_batch(self, number):
        """Runs a batch; returns whether it had a new point."""
        most = int((self.most_runs - self.runs()) // self.runs_of_a_point())
        proposed = self.proposals.ask(min(self.rules["batch"], most))
        fresh = []
        for values in proposed:
            key = key_of(values)
            if key not in self.known and self.space.is_start(values):
                self.known[key] = self.points[self.start]
            elif key not in self.known:
                self.known[key] = Point(f"trial {len(self.tried) + 1}", values, batch=number)
                self.tried.append(self.known[key])
                fresh.append(self.known[key])
        if fresh:
            self.evaluate(number, fresh)
        for values in proposed:
            point = self.known[key_of(values)]
            error, time = point.estimate or (self.race.error(point).mean, self.race.log_time(point))
            self.proposals.tell(values, error, time)
        self.say(number, fresh)
        return bool(fresh)

    def evaluate(self, number, points):
        studies = self.studies
        folder = f"search/batch_{number:03}"
        left, seen = points, 0
        for count in self.steps:
            self.measure(f"{folder}_shots_{count}", left, studies.shots[seen:count], self.few)
            left, seen = self.those_left(left, f"{count} of {counted(self.steps[-1], 'shot')}"), count
        chancy = [p for p in left if any(len(seeds) > 1 for seeds in p.errors.values())]
        if self.rest:
            self.measure(f"{folder}_seeds", chancy, studies.shots, self.rest, is_timed=False)
        for point in left:
            self.race.add(point)

    def measure(self, name, points, shots, seeds, is_timed=True):
        points = [p for p in points if self.is_rendered(p, shots)]
        if not points:
            return
        entries = [self.trial_entry(p.name, p.values) for p in points]
        if self.program or is_timed and self.studies.has_clock:  # which is compared within the same frames
            entries.insert(0, self.given_entry(self.names.index(self.baseline)))
        results = self.studies.run(name, entries, shots, seeds, is_timed)
        for point in points:
            self.studies.read_into(point, results)

    def is_rendered(self, point, shots):
        """Whether the settings rendered. A program that cannot render some settings does not fail the search."""
        try:
            if self.program:
                self.program.render(point.name, point.values, shots)
        except ProgramFailed as failed:
            if failed.code != REFUSED:
                raise
            point.refusal = failed.said[-1] if failed.said else str(failed)
        return not point.refusal

    def those_left(self, points, stage):
        """Stops points that are significantly worse, take too long, or have no time; returns the others."""
        left = []
        for point in points:
            too_long = math.log(max(self.budgets) * BEYOND)
            if point.refusal:
                point.stopped = f"after {stage}: {'refused' if self.program else 'no estimate'}: {point.refusal}"
                point.estimate = (self.race.error(point).mean if point.errors else 0.0, too_long)
                continue
            beaten = self.race.beaten_by(point)
            time = self.race.log_time(point)
            if beaten:
                rival, difference = beaten
                point.stopped = f"after {stage}: worse than {rival.name}"
                point.estimate = (self.race.mean_log(rival) + difference, time)
            elif time > too_long:
                point.stopped = f"after {stage}: takes too long"
                point.estimate = (self.race.error(point).mean, time)
            else:
                left.append(point)
        return left

    def best_within(self, budget):
        """The complete point of least measured error within the budget; None if all take longer."""
        slack = math.log(budget * self.race.same_time)
        fitting = [p for p in self.race.complete if self.race.log_time(p) <= slack]
        return min(fitting, key=self.race.mean_log, default=None)

    def judge(self):
        """(results, {name: budgets that it is best within}) of the found points and the config's, on other scenes; no results if the config
        has none."""
        found = {}
        for budget in self.budgets:
            best = self.best_within(budget)
            if best:
                found.setdefault(best.name, []).append(budget)
        if not self.studies.judged_shots:
            return None, found
        by_name = {p.name: p for p in self.tried}
        entries = [self.given_entry(i) for i in range(len(self.given))]
        tried = {name: by_name[name].values for name in found if name in by_name}
        if self.program:
            tried[AT_DEFAULTS] = {}
        for name, values in tried.items() if self.program else ():
            self.program.render(name, values, self.studies.judged_shots)
        entries += [self.trial_entry(name, values) for name, values in tried.items()]
        return self.studies.run("judged", entries, self.studies.judged_shots, self.studies.judge_seeds), found

    def say(self, number, fresh):
        runs, minutes = self.runs(), self.studies.minutes_so_far()
        begun = self.studies.minutes["search/start"]
        share = max(runs / self.most_runs, minutes / self.most_minutes)
        first_share = sum(p.runs() for p in self.points.values()) / self.most_runs
        left = (minutes - begun) * (1 - share) / max(share - first_share, 1e-9)
        best = self.best_within(max(self.budgets))
        least = f"; least error x{math.exp(self.race.mean_log(best)):.3f} in x{math.exp(self.race.log_time(best)):.2f}" if best else ""
        stopped = sum(bool(p.stopped) for p in fresh)
        say(
            f"batch {number}: {counted(len(fresh), 'new point')}, {stopped} stopped early; {runs} of {counted(self.most_runs, 'run')}, "
            f"{minutes:.1f} min, about {left:.0f} min left{least}"
        )


def main():
    parser = argparse.ArgumentParser(description="Search a technique's parameters for the front of error against time.")
    parser.add_argument("asked", help="what `ssrlab tune` read of the config")
    parser.add_argument("--out", required=True, help="folder of the studies and of the results")
    parser.add_argument("command", nargs="+", help="ssrlab, and options of `ssrlab run`")
    arguments = parser.parse_args()
    try:
        Tuning(read_json(arguments.asked), arguments.out, arguments.command).run()
    except (StudyFailed, ProgramFailed) as failed:
        for line in [f"error: {failed}", *failed.said]:
            print(shown(line), file=sys.stderr)
        return failed.code if failed.code in (2, 3) else 3
    return 0


if __name__ == "__main__":
    sys.exit(exit_code(main, "the search"))
