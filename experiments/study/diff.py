"""Says which numbers of a study changed from one results folder to another, beyond their intervals.

usage: diff.py OLD NEW [--times] [--all] [--csv FILE]

Compares the rows of summary.csv that speak for their shots, by shot, technique, point, target, metric and mask. Where both
folders measured the same seeds against the same pixels of the truth, errors are paired by seed: what no edit touched is equal
to the last digit, and a row counts as changed where the 95 % interval (Student) of its differences leaves out 0; a point that
does not depend on its seed, where it is not equal to 1e-6. Else values are compared by both intervals, and since some of many
would differ by chance, by p-values that are adjusted for all such rows (Holm 1979). Rows without an interval in a folder are
counted and not judged, unless they are equal.

Exits with 1 if a number changed, or if a point is in one folder alone; 0 if none did."""

import argparse
import csv
import json
import math
import os
import sys

from scipy import stats

KEY = ("shot", "frame", "variant", "point", "target", "metric", "mask")
ROUNDING = 1e-6  # relative: other compilers add in another order
CERTAINTY = 0.95


class Mistake(Exception):
    pass


def read_table(folder, name):
    file = os.path.join(folder, name)
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream))
    except FileNotFoundError:
        raise Mistake(f"{folder} has no {name}: `ssrlab run` or `ssrlab merge` makes it") from None


class Study:
    def __init__(self, folder):
        self.folder = folder
        try:
            with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as stream:
                self.manifest = json.load(stream)
        except FileNotFoundError:
            raise Mistake(f"{folder} is no results folder: it has no manifest.json") from None
        self.rows = {tuple(r[k] for k in KEY): r for r in read_table(folder, "summary.csv") if r["speaks"] == "1"}
        self.seeds = {}  # values by seed
        for r in read_table(folder, "results.csv"):
            key = tuple(r[k] for k in KEY)
            if key in self.rows and r["value"]:
                self.seeds.setdefault(key, {})[r["seed"]] = float(r["value"])
        self.truths = {s["shot"]: truth_of(s) for s in self.manifest["shots"]}
        self.times = {
            (r["shot"], r["variant"], r["point"]): r
            for r in read_table(folder, "time_summary.csv")
            if r["stage"] == "total" and r["variant"]
        }


def truth_of(shot):
    """What the pixels of a shot's references are told by: how they were made, and what their noise came out as."""
    return [(r["hash"], r["relative_error"]["mean"], r["rays"]) for r in shot.get("references", [])]


def number(text):
    return float(text) if text else math.nan


def half_width(row):
    low, high = number(row["low"]), number(row["high"])
    return (high - low) / 2


class Change:
    """A row in both folders. `p`: of "nothing changed", where that takes chance into account; `is_certain`: None until all p-values
    are adjusted."""

    def __init__(self, key, old, new):
        self.key = key
        self.old, self.new = number(old.rows[key]["value"]), number(new.rows[key]["value"])
        self.p, self.is_certain, self.how = math.nan, False, "equal"
        if old.rows[key]["value"] == new.rows[key]["value"]:
            return
        a, b = old.seeds.get(key, {}), new.seeds.get(key, {})
        if a and a.keys() == b.keys() and old.truths.get(key[0]) == new.truths.get(key[0]):
            self.pair([b[s] - a[s] for s in a], max(abs(self.old), abs(self.new)))
        else:
            self.by_intervals(half_width(old.rows[key]), half_width(new.rows[key]), min(len(a), len(b)))

    def pair(self, differences, size):
        n = len(differences)
        mean = sum(differences) / n
        if all(abs(d) <= ROUNDING * size for d in differences):
            self.how = "equal up to rounding"
        elif n == 1:
            self.how, self.is_certain = "paired, one seed", True
        else:
            deviation = math.sqrt(sum((d - mean) ** 2 for d in differences) / (n - 1))
            self.how = "paired"
            self.p = 2 * stats.t.sf(abs(mean) / (deviation / math.sqrt(n)), n - 1) if deviation > 0 else 0.0
            self.is_certain = self.p < 1 - CERTAINTY

    def by_intervals(self, old_half, new_half, seeds):
        """Half-widths are Student's of so many seeds at least; of a single value the reference's noise alone."""
        both = math.hypot(old_half, new_half)
        if not both > 0:
            self.how = "no interval"
            return
        self.how = "by intervals"
        distribution = stats.t(seeds - 1) if seeds > 1 else stats.norm
        self.p = 2 * distribution.sf(abs(self.new - self.old) / both * distribution.isf((1 - CERTAINTY) / 2))
        self.is_certain = None


def adjust(changes):
    """Holm's step-down over those that were judged by intervals."""
    open_ = sorted((c for c in changes if c.is_certain is None), key=lambda c: c.p)
    rejects = True
    for i, change in enumerate(open_):
        rejects = rejects and change.p * (len(open_) - i) < 1 - CERTAINTY
        change.is_certain = rejects


def changes_of_times(old, new):
    """(key, old ms, new ms) of totals whose intervals, and what two copies of a point differ by, leave a gap between them."""
    floor = max(s.manifest.get("clock", {}).get("aa_floor", 0.0) for s in (old, new))
    found = []
    for key in old.times.keys() & new.times.keys():
        a, b = old.times[key], new.times[key]
        first, second = sorted((a, b), key=lambda r: number(r["median_ms"]))
        if number(first["high_ms"]) * (1 + floor) < number(second["low_ms"]):
            found.append((key, number(a["median_ms"]), number(b["median_ms"])))
    return sorted(found)


def machine_of(study, shot):
    """The machine that took the shot's times, and its device; of older folders all that made any part of them."""
    makers = study.manifest.get("provenance", [])
    hosts = [load["host"] for load in study.manifest["clock"].get("load", []) if load["shot"] == shot and "host" in load]
    names = {f"{host['name']} ({host['cpu']})" for host in hosts or [p["host"] for p in makers]}
    return ", ".join([*sorted(names), *sorted({p["device"]["name"] for p in makers})])


def print_techniques(changes):
    print(f"{'':44} {'rows':>6} {'equal':>6} {'within':>6} {'beyond':>6} {'open':>6}")
    by_technique = {}
    for c in changes:
        by_technique.setdefault(c.key[2], []).append(c)
    for technique, of in by_technique.items():
        equal = sum(c.how.startswith("equal") for c in of)
        beyond, open_ = sum(c.is_certain for c in of), sum(c.how == "no interval" for c in of)
        print(f"{technique:44} {len(of):6} {equal:6} {len(of) - equal - beyond - open_:6} {beyond:6} {open_:6}")


def ratio_of(change):
    return change.new / change.old if change.old else math.inf


def print_changes(changes, limit):
    certain = sorted((c for c in changes if c.is_certain), key=lambda c: -abs(math.log(ratio_of(c))) if ratio_of(c) > 0 else -math.inf)
    for c in certain[:limit]:
        shot, frame, variant, point, target, metric, mask = c.key
        where = f"{shot}{' frame ' + frame if frame else ''}: {variant} {point}: {metric} of {target}, {mask} pixels"
        print(f"  {where}: {c.old:.4g} -> {c.new:.4g} (x{ratio_of(c):.3f}, {c.how})")
    if len(certain) > limit:
        print(f"  and {len(certain) - limit} more; --all names them")


def write_csv(file, changes):
    with open(file, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([*KEY, "old", "new", "p", "changed", "how"])
        for c in changes:
            writer.writerow([*c.key, c.old, c.new, "" if math.isnan(c.p) else c.p, int(bool(c.is_certain)), c.how])


def compare(old, new, arguments):
    common = [key for key in old.rows if key in new.rows]
    if not common:
        raise Mistake(f"{old.folder} and {new.folder} have no number in common: no shot and point that both have")
    changes = [Change(key, old, new) for key in common]
    adjust(changes)
    print_techniques(changes)
    certain = [c for c in changes if c.is_certain]
    print(f"\n{len(certain)} of {len(changes)} numbers changed beyond their intervals" + (":" if certain else "."))
    print_changes(changes, len(certain) if arguments.all else 12)
    alone = 0
    for one, other in ((old, new), (new, old)):
        points = {(k[0], k[2], k[3]) for k in one.rows} - {(k[0], k[2], k[3]) for k in other.rows}
        alone += len(points)
        if points:
            print(f"\nIn {one.folder} alone: {len(points)} points of shots, as {' '.join(sorted(points)[0])}")
    times = changes_of_times(old, new)
    moved = {shot: (machine_of(old, shot), machine_of(new, shot)) for shot in sorted({key[0] for key in old.times.keys() & new.times.keys()})}
    moved = {shot: machines for shot, machines in moved.items() if machines[0] != machines[1]}
    if moved:
        print(f"\nTimes of {len(moved)} shots are of different machines and are not compared:")
        for machines in dict.fromkeys(moved.values()):
            print(f"  {machines[0]} / {machines[1]}: {', '.join(shot for shot in moved if moved[shot] == machines)}")
        times = [change for change in times if change[0][0] not in moved]
    if times:
        print(f"\nTimes of {len(times)} points changed beyond their intervals and what two copies of a point differ by:")
        for one in (old, new):
            if "aa_floor" not in one.manifest.get("clock", {}):
                print(f"  (in {one.folder} no point was timed twice: what copies differ by is not known of it)")
        for (shot, variant, point), a, b in times if arguments.all else times[:12]:
            print(f"  {shot}: {variant} {point}: {a:.3g} ms -> {b:.3g} ms (x{b / a:.3f})")
    if arguments.csv:
        write_csv(arguments.csv, changes)
    return 1 if certain or alone or (arguments.times and times) else 0


def main():
    parser = argparse.ArgumentParser(description="Say which numbers of a study changed beyond their intervals.")
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--times", action="store_true", help="changed times count, too")
    parser.add_argument("--all", action="store_true", help="name all changes")
    parser.add_argument("--csv", help="also write all rows that were compared")
    arguments = parser.parse_args()
    try:
        return compare(Study(arguments.old), Study(arguments.new), arguments)
    except Mistake as mistake:
        print(f"error: {mistake}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
