#!/usr/bin/env python3
"""How well counted costs, and chips' estimated times, order times: a Markdown table of a results folder that has both.

    cost_agreement.py RESULTS [--costs RESULTS]    costs.csv and estimates.csv of another folder, of the same shots and points
    cost_agreement.py RESULTS --without STAGE ...  without stages (* stands for any text); a point is the sum of its others
    cost_agreement.py RESULTS --by-shot            a row for each shot, too
    cost_agreement.py RESULTS --model-range        the range of experiments/gpu_costs/chips/model_range.h, of these stages and all chips

A point of which no stage of its own is left in a shot is left out there: what remains is what techniques share (a texture of noise, a pyramid), no work that
the point would be compared by. For each cost, over the shots: Kendall's rank correlation with the median times of the points, and of their stages; of the pairs
of points of a shot whose times differ by a factor of 1.5 or more, the share that the cost puts in the order of their times; and how
many times an estimate the time of a stage is (median, and from the 5th to the 95th percentile of all shots' stages).
"""
import argparse
import fnmatch
import itertools
import os
import statistics
import sys

sys.dont_write_bytecode = True
EXPERIMENTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
sys.path.insert(0, os.path.join(EXPERIMENTS, "python"))

from ssrlab.tables.agreement import kendall_tau  # noqa: E402
from ssrlab.csv_files import needed_number, number, read_rows, whole  # noqa: E402
from ssrlab.mistakes import ResultsError, exit_code  # noqa: E402
from ssrlab.text_files import path_inside  # noqa: E402

FACTOR = 1.5  # of times that are clearly apart
COSTS = {
    "invocations": ("invocations",),
    "fetches": ("fetches",),
    "texels": ("texels",),
    "bytes read and written": ("bytes_read", "bytes_written"),
    "unique bytes": ("unique_bytes",),
    "operations": ("operations",),
}


def rows_of(folder, name):
    return read_rows(path_inside(folder, name))[1]


def medians(folder):
    """{shot: {(technique, point, stage): milliseconds}} of the techniques."""
    times = {}
    for row in rows_of(folder, "times.csv"):
        if row["technique"] not in ("", "none"):
            key = (row["technique"], row["point"], row["stage"])
            times.setdefault(row["shot"], {}).setdefault(key, []).append(needed_number(row, "milliseconds"))
    return {shot: {key: statistics.median(all_of) for key, all_of in own.items()} for shot, own in times.items()}


def counts(folder):
    """{name: {shot: {(technique, point, stage): sum of its quantities}}}"""
    costs = {name: {} for name in COSTS}
    for row in rows_of(folder, "costs.csv"):
        key = (row["technique"], row["point"], row["stage"])
        for name, quantities in COSTS.items():
            of_shot = costs[name].setdefault(row["shot"], {})
            of_shot[key] = of_shot.get(key, 0) + (whole(row, "value") or 0) * (row["quantity"] in quantities)
    return costs


def estimates(folder):
    """The same of chips' microseconds, {} without such; what was refused has none."""
    found = {}
    if os.path.exists(path_inside(folder, "estimates.csv")):
        for row in rows_of(folder, "estimates.csv"):
            if (microseconds := number(row, "microseconds")) is not None:
                key = (row["technique"], row["point"], row["stage"])
                found.setdefault(f"{row['chip']} estimate", {}).setdefault(row["shot"], {})[key] = microseconds
    return found


def is_shared(stage):
    """Of a pass that techniques share, or that is no technique's: their own are named by a technique, as `amd_sssr/prefilter`."""
    return stage.startswith("common/") or "/" not in stage


def without(shots, patterns):
    """{shot: values} without the stages that fit a pattern, without totals, and without points of which no own stage is left."""
    is_left = lambda stage: stage != "total" and not any(fnmatch.fnmatchcase(stage, pattern) for pattern in patterns)  # noqa: E731
    left = {shot: {key: value for key, value in values.items() if is_left(key[2])} for shot, values in shots.items()}
    work = {shot: {key[:2] for key in values if not is_shared(key[2])} for shot, values in left.items()}
    return {shot: {key: value for key, value in values.items() if key[:2] in work[shot]} for shot, values in left.items()}


def add_totals(both):
    """To {(technique, point, stage): (ms, cost or None)}: sums over the stages of each point whose stages all have a cost."""
    points = {}
    for (technique, point, _), pair in both.items():
        points.setdefault((technique, point), []).append(pair)
    for (technique, point), pairs in points.items():
        if all(cost is not None for _, cost in pairs):
            both[technique, point, "total"] = tuple(map(sum, zip(*pairs)))


def agreement(times, costs, has_totals):
    """[tau of totals by shot], [tau of stages by shot], pairs that are clearly apart, how many of them are in order, [time
    over cost of each stage]."""
    of_totals, of_stages, pairs, right, ratios = [], [], 0, 0, []
    for shot in sorted(set(times) & set(costs)):
        both = {key: (ms, costs[shot].get(key)) for key, ms in times[shot].items()}
        if not has_totals:
            add_totals(both)
        both = {key: pair for key, pair in both.items() if pair[1] is not None}
        totals = [pair for key, pair in both.items() if key[2] == "total"]
        stages = [pair for key, pair in both.items() if key[2] != "total"]
        ratios += [ms / cost for ms, cost in stages if cost > 0]
        of_totals.append(kendall_tau([ms for ms, _ in totals], [cost for _, cost in totals]))
        of_stages.append(kendall_tau([ms for ms, _ in stages], [cost for _, cost in stages]))
        for (ms, cost), (other_ms, other_cost) in itertools.combinations(totals, 2):
            if max(ms, other_ms) >= FACTOR * min(ms, other_ms):
                pairs += 1
                right += (ms < other_ms) == (cost < other_cost) and cost != other_cost
    return of_totals, of_stages, pairs, right, ratios


def spread(values):
    known = [v for v in values if v is not None]
    return f"{statistics.mean(known):.2f} [{min(known):.2f}, {max(known):.2f}]" if known else "none"


def percentiles(ratios):
    """The 5th, the middle and the 95th."""
    return [sorted(ratios)[round(share * (len(ratios) - 1))] for share in (0.05, 0.5, 0.95)]


def range_of(ratios):
    low, middle, high = percentiles(ratios)
    return f"{middle:.2f} [{low:.2f}, {high:.2f}]"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results")
    parser.add_argument("--costs")
    parser.add_argument("--without", nargs="+", metavar="STAGE", default=[])
    parser.add_argument("--by-shot", action="store_true")
    parser.add_argument("--model-range", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.costs or arguments.results
    estimated = estimates(folder)
    times, costs = medians(arguments.results), counts(folder) | estimated
    if arguments.without:
        times = without(times, arguments.without)
        costs = {name: without(shots, arguments.without) for name, shots in costs.items()}
    if not any(set(times) & set(shots) for shots in costs.values()):
        raise ResultsError("no shot has both times and costs")
    print("| cost | totals | stages | clearly apart, in order | time over estimate |\n|---|---|---|---|---|")
    ends = []
    for name, of_shots in costs.items():
        both = sorted(set(times) & set(of_shots))
        for shots in ([both] if not arguments.by_shot else [[shot] for shot in both] + [both]):
            of_totals, of_stages, pairs, right, ratios = agreement({s: times[s] for s in shots}, of_shots, not arguments.without)
            in_microseconds = [1e3 * ratio for ratio in ratios]
            over = range_of(in_microseconds) if name in estimated and ratios else "-"
            label = name if shots is both else f"{name}, {shots[0]} ({len({key[:2] for key in times[shots[0]]})} points)"
            print(f"| {label} | {spread(of_totals)} | {spread(of_stages)} | {right} of {pairs} | {over} |")
        if name in estimated and ratios:
            low, _, high = percentiles(in_microseconds)
            ends += [low, high]
    if arguments.model_range and ends:
        print(f"\nmodel_range{{{min(ends):.3g}, {max(ends):.3g}}}")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the table"))
