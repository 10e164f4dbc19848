"""The studies of a search: each is a config that is written, run by `ssrlab run`, and read."""

import json
import os
import time

from ssrlab import interrupts
from ssrlab.csv_files import needed_number, number, whole
from ssrlab.json_files import read_json
from ssrlab.mistakes import ResultsError
from ssrlab.results import Results
from ssrlab.shots import single_shots
from ssrlab.text_files import exists, path_inside, write_text
from ssrlab.tune.race import NORMAL

NOT_OF_STUDIES = ("tune", "tables", "techniques", "shots", "seeds", "timing", "costs", "$schema")


class StudyFailed(Exception):
    """`ssrlab run` ended with an exit code other than 0."""

    def __init__(self, code, log):
        with open(log, encoding="utf-8", errors="surrogateescape") as stream:
            self.said = stream.read().splitlines()[-3:]
        super().__init__(f"a study failed; {log} ends with")
        self.code = code


def _positive(row, column):
    """A value that ratios can compare."""
    value = needed_number(row, column)
    if value <= 0:
        raise ResultsError(f"{row.file}:{row.line}: '{column}' = \"{row[column]}\" is not above 0")
    return value


class Studies:
    """The studies of one search in its folder, and the numbers of their tables that count."""

    def __init__(self, asked, out, command, baseline):
        """`asked`: what `ssrlab tune` read of the config (experiments/cli/script_commands.cpp). `baseline`: the name
        of the point that all are compared with."""
        self.rules = asked["tune"]
        self.common = {k: v for k, v in asked["study"].items() if k not in NOT_OF_STUDIES}
        self.timing = asked["study"].get("timing", {})
        self.search_timing = self.timing | {"copies": False}  # of many points, whose ratios are compared with a slack of their own
        self.seeds, judge = self.rules["seeds"], self.rules["judge"]
        self.shots = self._placed(single_shots(asked["study"]["shots"]), asked["folder"])
        self.judged_shots = self._placed(single_shots(judge["shots"]), asked["folder"])
        self.judge_seeds = judge["seeds"]
        self.metrics, self.target, self.mask, self.cost = (self.rules[key] for key in ("metrics", "target", "mask", "time"))
        self.has_time = not self.rules.get("program")  # what a program takes is its own clock's
        self.has_clock, self.is_estimated = self.has_time and self.cost == "milliseconds", self.rules["is_estimated"]
        self.out, self.command, self.baseline = out, command, baseline
        self.references = {}  # shot to the hashes of its references: errors are paired against the same pixels alone
        self.minutes_file = path_inside(out, "minutes.json")
        self.minutes = {}  # study to what its run took
        self.costs_of_baseline = {}  # shot to what was counted or estimated

    @staticmethod
    def _placed(shots, folder):
        """Makes shots' paths of captures absolute by `folder`, the config's, since the studies lie elsewhere."""
        for shot in shots:
            if "gbuffer" in shot:
                shot.update({k: os.path.join(folder, shot[k]) for k in ("gbuffer", "reference") if k in shot})
        return shots

    def run(self, name, techniques, shots, seeds, is_timed=True):
        """Runs a study and reads it; `name`: its folder within the search's."""
        folder, config, log_file = (path_inside(self.out, name + end) for end in ("", ".json", ".log"))
        study = self.common | {"techniques": techniques, "shots": shots, "seeds": seeds}
        is_search = name != "judged"
        timing = self.search_timing if is_search else self.timing
        if is_search:
            study["images"] = "none"
        study["timing"] = timing if is_timed and self.has_clock else {"frames": 0}
        study["costs"] = is_timed and self.has_time and not self.has_clock
        if self.is_estimated:
            study["gpu_compilers"] = [self.cost] if is_timed else []
        write_text(config, json.dumps(study, indent=1))  # beside the folder: study.json in it is ssrlab's own
        begin = time.monotonic()
        with open(log_file, "a", encoding="utf-8") as log:
            command = [self.command[0], "run", config, "--out", folder, *(["--no-report"] if is_search else []), *self.command[1:]]
            code = interrupts.run(command, stdout=log, stderr=log)
        self._keep_minutes(name, (time.monotonic() - begin) / 60)
        if code != 0:
            raise StudyFailed(code, log_file)
        results = Results(folder)
        self._check_references(results)
        return results

    def _keep_minutes(self, name, minutes):
        """Keeps the time of a study's first run; later runs only read results."""
        kept = {}
        if exists(self.minutes_file):
            kept = read_json(self.minutes_file, {"*": float})
        self.minutes[name] = kept.setdefault(name, minutes)
        write_text(self.minutes_file, json.dumps(kept, indent=1))

    def minutes_so_far(self):
        return sum(self.minutes.values())

    def _check_references(self, results):
        for shot in results.manifest["shots"]:
            hashes = [r["hash"] for r in shot.get("references", [])]
            if self.references.setdefault(shot["shot"], hashes) != hashes:
                raise ResultsError(f"{results.folder}: the references of {shot['shot']} are not those of the search so far; was its cache emptied?")

    def read_into(self, point, results):
        """Adds a study's results to a point of the search, whose name is the label."""
        entry = next((v for v in results.manifest["techniques"] if v.get("label") == point.name), None)
        if entry is None:
            raise ResultsError(f"{results.folder}: no point has the label '{point.name}'")
        point.parameters = entry["parameters"]
        rows = [r for r in self._rows(results) if r["point"] == entry["point"]]
        if not rows:
            wanted = ", ".join(f"{self.target} {m} {self.mask}" for m in self.metrics)
            raise ResultsError(f"{results.folder}: results.csv has nothing of '{entry['point']}': does the study measure {wanted}?")
        for row in rows:
            point.errors.setdefault((row["shot"], row["metric"]), {})[whole(row, "seed")] = self._error(row)
        for shot, (ratio, _) in self.times_of(results, entry["point"]).items():
            point.times[shot] = ratio
        point.refusal = point.refusal or self._refusal_of(results, entry["point"])

    def _rows(self, results):
        if not hasattr(results, "representative"):
            wanted = {(self.target, m, self.mask) for m in self.metrics}
            every = results.read_csv("results.csv")
            results.representative = [r for r in every if r["represents_shot"] == "1" and (r["target"], r["metric"], r["mask"]) in wanted]
        return results.representative

    @staticmethod
    def _error(row):
        low, high = number(row, "low"), number(row, "high")
        return needed_number(row, "value"), 0.0 if None in (low, high) else (high - low) / 2 / NORMAL

    def times_of(self, results, point):
        """{shot: (time over the baseline's, the baseline's)} of a study's times, counts or estimates; shots with a refused estimate are
        missing. Without times all points count as equally fast."""
        if not self.has_time:
            return {shot["shot"]: (1.0, 1.0) for shot in results.manifest["shots"]}
        base = next((v["point"] for v in results.manifest["techniques"] if v.get("label") == self.baseline), None)
        return self._clock_ratios(results, point, base) if self.has_clock else self._other_ratios(results, point, base)

    @staticmethod
    def _clock_ratios(results, point, base):
        """Ratios of times of the same frames, since machines change their speed."""
        total = [r for r in results.times if r["technique"] and r["point"] == base and r["stage"] == "total"]
        own = {r["shot"]: _positive(r, "median_ms") for r in total}
        if point == base:
            return {shot: (1.0, ms) for shot, ms in own.items()}
        rows = results.read_csv("time_effects.csv", is_optional=True)
        chosen = [r for r in rows if r["point"] == point and r["against"] == "baseline" and r["stage"] == "total"]
        return {r["shot"]: (_positive(r, "ratio"), own[r["shot"]]) for r in chosen if r["shot"] in own}

    def _other_ratios(self, results, point, base):
        """Costs of the baseline hold wherever they were counted or estimated."""
        costs = {}
        for of_point, shot, value in self._estimated(results) if self.is_estimated else self._counted(results):
            costs.setdefault(of_point, {})[shot] = value
        self.costs_of_baseline.update(costs.get(base, {}))
        return {shot: (value / self.costs_of_baseline[shot], self.costs_of_baseline[shot]) for shot, value in costs.get(point, {}).items() if shot in self.costs_of_baseline}

    def _counted(self, results):
        """(point, shot, count); a point that does nothing counts as doing 1."""
        for row in results.read_csv("costs.csv", is_optional=True):
            if row["stage"] == "total" and row["quantity"] == self.cost:
                yield row["point"], row["shot"], max(needed_number(row, "value"), 1.0)

    def _estimated(self, results):
        """(point, shot, microseconds)"""
        for row in self._totals_of_chip(results):
            if not row["refusal"]:
                yield row["point"], row["shot"], _positive(row, "microseconds")

    def _refusal_of(self, results, point):
        """Why a point's time was not estimated; "" if it was, or needs no estimate."""
        rows = self._totals_of_chip(results) if self.is_estimated else []
        return next((r["refusal"] for r in rows if r["point"] == point and r["refusal"]), "")

    def _totals_of_chip(self, results):
        rows = results.read_csv("estimates.csv", is_optional=True)
        return [r for r in rows if r["stage"] == "total" and r["chip"] == self.cost]
