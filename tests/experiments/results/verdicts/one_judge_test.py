"""Every tool says the same of two points of a study: standings, effects, pairs, report, tables, tradeoff and diff; and of what holds over
scenes over_scenes.csv, which is computed anew here, the report's first sentence, and tradeoff.

usage: one_judge_test.py REPORT_PAGE_PROGRAM SSRLAB [RESULTS ...]

Of a made-up study with ties, and of each folder that is named, which is copied. A pair of points has as many witnesses as there are
places that compare it: what they say must be one.
"""

import csv
import itertools
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from scipy import stats

REPORT_PAGE, SSRLAB, *FOLDERS = sys.argv[1:]
SAME, NEAR, LESS, MORE = "undecided", "equivalent", "less", "more"
OPPOSITE = {SAME: SAME, NEAR: NEAR, LESS: MORE, MORE: LESS, "equal": "equal"}
OF_STANDING = {"tied": SAME, "equivalent": NEAR, "behind": MORE}


def read(folder, name):
    with open(os.path.join(folder, name), newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def run(*command, code=0):
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == code, (command, done.returncode, done.stdout, done.stderr)
    return done.stdout


class Witnesses:
    """What is said of each pair of a shot, whichever way round it is said."""

    def __init__(self):
        self.said = {}  # (shot, a, b) to {witness: verdict of a beside b}

    def add(self, witness, shot, a, b, verdict):
        if a > b:
            a, b, verdict = b, a, OPPOSITE[verdict]
        self.said.setdefault((shot, a, b), {})[witness] = verdict

    def contradictions(self):
        """Pairs of which two witnesses say other things; numbers that are equal are within any margin."""
        return {pair: said for pair, said in self.said.items() if len({NEAR if v == "equal" else v for v in said.values()}) > 1}


def of_standings(witnesses, name, shot, standing_of):
    """`standing_of`: point to standing, of those that are ranked; none is compared but with the best measured, which comes first."""
    best, *others = standing_of
    for point in others:
        witnesses.add(name, shot, point, best, OF_STANDING[standing_of[point]])


def judge(folder):
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as stream:
        manifest = json.load(stream)
    primary = manifest["primary"]
    names = {"target": primary["target"], "metric": primary["metric"], "mask": primary["mask"]}
    add_tables(folder, manifest, names)

    def rows(file):
        return [r for r in read(folder, file) if all(r[k] == v for k, v in names.items())]

    witnesses = Witnesses()
    errors = {}
    for r in rows("summary.csv"):
        if r["standing"]:
            errors.setdefault(r["shot"], {})[r["technique"], r["point"]] = r
    for shot, points in errors.items():
        ordered = sorted(points, key=lambda p: (points[p]["p_best"] != "", float(points[p]["value"])))
        of_standings(witnesses, "summary.csv", shot, {p: points[p]["standing"] for p in ordered})
    for r in rows("effects.csv"):
        if r["verdict"]:
            witnesses.add("effects.csv", r["shot"], (r["technique"], r["point"]), (r["against_technique"], r["against_point"]), r["verdict"])
    page = report(witnesses, folder, errors)
    tables(witnesses, folder, errors, rows("effects.csv"))
    tradeoff(witnesses, folder)
    over_scenes(folder, manifest, rows("over_scenes.csv"), rows("summary.csv"), page)
    contradictions = witnesses.contradictions()
    assert not contradictions, contradictions
    run(SSRLAB, "diff", folder, folder)  # exit code 0: no number of a study differs from itself
    return witnesses


def report(witnesses, folder, errors):
    """The page's answers: the best, those of which nothing is decided beside it, and those within the margin of it."""
    run(SSRLAB, "report", folder)
    with open(os.path.join(folder, "report.html"), encoding="utf-8") as stream:
        page = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', stream.read(), re.S)[1])
    found = 0
    for answer in page["answers"]:
        if not answer["best"]:
            continue
        best = (answer["best"]["technique"], answer["best"]["point"])
        of = {kind: {(t["technique"], t["point"]) for t in answer[kind]} for kind in ("near", "tied")}
        for point, row in errors.get(answer["shot"], {}).items():
            if point == best:
                continue
            assert (point in of["near"]) == (float(row["p_equivalent"]) < 0.05), (point, row)
            near = NEAR if row["standing"] == "equivalent" else MORE  # both are certain: behind by less than the margin
            witnesses.add("report", answer["shot"], point, best, SAME if point in of["tied"] else near if point in of["near"] else MORE)
            found += 1
    assert found, "the report says nothing of any pair"
    return page


def add_tables(folder, manifest, names):
    """Asks for a table of all errors and one of all effects."""
    levels = {"name": "levels", "caption": "c", "of": "results", "where": names, "rows": ["technique", "point"], "columns": "shot", "best": "column"}
    changes = {"name": "changes", "caption": "c", "of": "effects", "where": names, "rows": ["technique", "point", "against_technique", "against_point", "against"], "columns": "shot"}
    manifest["config"] = (manifest.get("config") or {}) | {"tables": [levels, changes]}
    maker = {"ssrlab": {"commit": "abc1234", "dirty": False, "code": "00ff", "estimators": 7}, "device": {"name": "d"}, "finished": "2026-01-31T12:05:00Z"}
    manifest.setdefault("provenance", [maker | {"cells": []}])
    manifest.setdefault("study", {"name": "made_up", "config": "made_up.json"})
    for proof in manifest.get("clock", {}).get("proofs", []):
        proof.setdefault("shots", [])
    for shot in manifest["shots"]:
        shot.update({"width": shot.get("width", 64), "height": shot.get("height", 36)})
    for entry in manifest["techniques"]:  # rows are named by technique and point, not by labels
        entry.pop("label", None)
    with open(os.path.join(folder, "manifest.json"), "w", encoding="utf-8") as stream:
        json.dump(manifest, stream)


def tables(witnesses, folder, errors, effects):
    """Bold is the best or a tied one in `levels`, and a significant change in `changes`."""
    run(SSRLAB, "tables", folder)
    with open(os.path.join(folder, "tables", "levels.csv"), newline="", encoding="utf-8") as stream:
        levels = {(r.pop("technique"), r.pop("point")): r for r in csv.DictReader(stream)}
    shots = {re.sub(r" standing$", "", c) for r in levels.values() for c in r if c.endswith(" standing")}
    for shot in shots & set(errors):
        marked = {p: levels[p][shot + " standing"] for p in errors[shot]}
        best = next(p for p in errors[shot] if not errors[shot][p]["p_best"])
        assert marked[best] in ("best", "tied"), (shot, best, marked)
        for point, standing in marked.items():
            if point != best:
                witnesses.add("tables", shot, point, best, OF_STANDING[standing or "behind"])
    with open(os.path.join(folder, "tables", "changes.md"), encoding="utf-8") as stream:
        lines = [[c.strip() for c in line.strip("| \n").split("|")] for line in stream if line.startswith("|")]
    with open(os.path.join(folder, "tables", "changes.csv"), newline="", encoding="utf-8") as stream:
        columns = next(csv.reader(stream))[5:]  # behind the keys of a row
    head = [c for c in columns if c in {r["shot"] for r in effects}]  # with whole names: those of Markdown are short
    assert len(head) == len(lines[0]), (head, lines[0])
    rows = {line[0].replace("\\", ""): line[1:] for line in lines[2:]}
    for r in effects:
        name = ", ".join(r[k] for k in ("technique", "point", "against_technique", "against_point", "against"))
        if r["verdict"] and name in rows and r["shot"] in head:
            cell = rows[name][head.index(r["shot"])]
            assert ("**" in cell) == (r["verdict"] in (LESS, MORE)), (cell, r)
            verdict = r["verdict"] if "**" not in cell else LESS if float(r["ratio"]) < 1 else MORE
            witnesses.add("table of effects", r["shot"], (r["technique"], r["point"]), (r["against_technique"], r["against_point"]), verdict)


def tradeoff(witnesses, folder):
    """Pairs, and the front that is made of them."""
    run(SSRLAB, "tradeoff", folder)
    out = os.path.join(folder, "tradeoff")
    dominated, undecided = set(), set()
    for r in read(out, "pairs.csv"):
        a, b = (r["technique"], r["point"]), (r["other_technique"], r["other_point"])
        witnesses.add("pairs.csv", r["shot"], a, b, r["error_verdict"])
        for key, first in (("dominates", b), ("is_dominated", a)):
            {"yes": dominated, "maybe": undecided}.get(r[key], set()).add((r["shot"], *first))
    for r in read(out, "front.csv"):
        point = (r["shot"], r["technique"], r["point"])
        if r["verdict"] in ("front", "undecided", "dominated"):
            verdict = "dominated" if point in dominated else "undecided" if point in undecided else "front"
            assert r["verdict"] == verdict, (point, r["verdict"], verdict)


def close(text, number, tolerance=1e-6):
    return (text == "") == (number is None) and (number is None or math.isclose(float(text), number, rel_tol=tolerance, abs_tol=1e-9))


def adjusted_for_choice(p, degrees):
    """Each p as that of the largest difference of the points that remain when those of smaller p have left, and no less than theirs: by
    Tukey's studentised range where the variance is shared (degrees above 0), and by Bonferroni's inequality."""
    found, most = {}, 0
    for rank, key in enumerate(sorted(p, key=p.get)):
        remaining = len(p) + 1 - rank
        own = p[key] * math.comb(remaining, 2)
        if degrees[key] > 0 and remaining > 2 and p[key] > 0:
            own = min(own, stats.studentized_range.sf(stats.t.isf(p[key] / 2, degrees[key]) * math.sqrt(2), remaining, degrees[key]))
        most = found[key] = min(1.0, max(most, own))
    return found


def over_assets(logs, asset_of):
    return np.array([np.mean([v for s, v in logs.items() if asset_of[s] == asset]) for asset in sorted({asset_of[s] for s in logs})])


def pooled_pairs(logs, ranked, asset_of):
    """By law: the mean variance of all pairs of ranked points over assets, and for how many degrees of freedom it counts."""
    pooled = []
    for law in range(3):
        values = [over_assets({s: v[law] for s, v in logs[k].items()}, asset_of) for k in ranked]
        n = len(values[0]) if values else 0
        variances = [np.var(a - b, ddof=1) for a, b in itertools.combinations(values, 2)] if n > 3 and len(values) > 2 else []
        mean = float(np.mean(variances)) if variances else 0.0
        pooled.append((mean, min(3, (len(values) - 2) * (n - 1)) if mean > 0 else 0))
    return pooled


def of_scenes(logs, asset_of, pooled):
    """(mean, low, high, p) of {shot: value} by scipy; assets count once."""
    values = over_assets(logs, asset_of)
    n, (variance, prior) = len(values), pooled if values.std() > 0 else (0, 0)
    if n < 4:
        return values.mean(), None, None, None
    degrees = n - 1 + prior if prior else n - 2
    error = math.sqrt((prior * variance + (n - 1) * values.var(ddof=1)) / (n - 1 + prior) / n)
    half = stats.t.ppf(0.975, degrees) * error
    p = float(2 * stats.t.sf(abs(values.mean()) / error, degrees)) if error > 0 else None
    return values.mean(), values.mean() - half, values.mean() + half, p


NOT_POOLED = [(0, 0)] * 3


def by_laws(values, asset_of, pooled):
    """of_scenes() of errors as measured, and without the reference's noise by two laws: the hull of the intervals, and the largest p."""
    laws = [of_scenes({s: v[law] for s, v in values.items()}, asset_of, pooled[law]) for law in range(3)]
    mean, lows, highs, p = laws[0][0], *([law[i] for law in laws if law[i] is not None] for i in (1, 2, 3))
    is_disputed = p and any(law[0] * mean < 0 for law in laws)
    return mean, min(lows, default=None), max(highs, default=None), 1.0 if is_disputed else max(p, default=None)


def errors_by_law(r):
    return np.array([float(r[c] or r["value"]) for c in ("value", "value_of_power", "value_of_bounded")])


def over_scenes(folder, manifest, found, summary, page):
    """over_scenes.csv against its rules; what the report and tradeoff say is what stands there."""
    baseline = lambda r: (r["baseline_technique"], r["baseline_point"])  # noqa: E731
    of_pairs = [r for r in found if not r["rank"] and baseline(r) != baseline(found[0])]
    found = [r for r in found if r not in of_pairs]
    entries = {s["shot"]: s for s in manifest["shots"]}
    asset_of = {r["shot"]: entries[r["shot"]].get("asset") or entries[r["shot"]].get("scene") or r["shot"] for r in summary}
    representative = [r for r in summary if r["represents_shot"] == "1" and r["value"]]
    base, largest = {}, {}
    for r in representative:
        largest[r["shot"]] = max(largest.get(r["shot"], 0), float(r["value"]))
    for r in representative:
        if (r["technique"], r["point"]) == baseline(found[0]) and r["low"] and float(r["low"]) > 0 and min(errors_by_law(r)) > 0:
            if float(r["value"]) > max(2 * float(r["floor"] or 0), 1e-6 * largest[r["shot"]]):
                base[r["shot"]] = errors_by_law(r)
    all_logs, using_scene = {}, {(v["technique"], v["point"]) for v in manifest["techniques"] if v.get("uses_scene_data")}
    for r in representative:
        key = (r["technique"], r["point"])
        is_without_bias = r["interval"] == "none: 1 seed" and (r["corrected"] == "1" or r["floor"] == "0" or r["value_of_power"])  # scenes are the sample
        if (r["ranked"] == "1" and r["low"] or is_without_bias) and r["shot"] in base and min(errors_by_law(r)) > 0:
            all_logs.setdefault(key, {})[r["shot"]] = np.log(errors_by_law(r) / base[r["shot"]])
    logs = {k: v for k, v in all_logs.items() if k not in using_scene}
    ranked = [k for k, v in logs.items() if len(v) >= 0.9 * len(base)]
    common = [s for s in base if all(s in logs[k] for k in ranked)]
    logs |= {k: {s: logs[k][s] for s in common} for k in ranked}
    rows = {(r["technique"], r["point"]): r for r in found}
    assert rows.keys() == logs.keys(), (rows.keys(), logs.keys())
    pooled = pooled_pairs(logs, ranked, asset_of)
    means = {k: by_laws(v, asset_of, pooled) for k, v in logs.items()}
    first = next(k for k, r in rows.items() if r["rank"] == "1")
    assert first == min(ranked, key=lambda k: (means[k][0], k)), first
    against = {k: by_laws({s: v - logs[first][s] for s, v in of.items() if s in logs[first]}, asset_of, pooled) for k, of in logs.items() if k != first}
    counts = {k: len({asset_of[s] for s in logs[k] if s in logs[first]}) for k in against}
    degrees = {k: n - 1 + pooled[0][1] if pooled[0][1] and n <= 8 else 0 for k, n in counts.items()}  # of more scenes each ratio has its own
    adjusted = adjusted_for_choice({k: v[3] for k, v in against.items() if v[3] is not None}, degrees)
    exponential = lambda v: None if v is None else math.exp(v)  # noqa: E731
    for r in of_pairs:
        own, other = all_logs[r["technique"], r["point"]], all_logs[baseline(r)]
        mean = by_laws({s: own[s] - other[s] for s in own if s in other}, asset_of, NOT_POOLED)
        assert all(close(r[c], exponential(v)) for c, v in zip(("ratio", "low", "high"), mean)), (r, mean)
    for key, r in rows.items():
        assert all(close(r[c], exponential(v)) for c, v in zip(("ratio", "low", "high"), means[key])), (key, r, means[key])
        assert all(close(r["over_best" + c], exponential(v)) for c, v in zip(("", "_low", "_high"), against.get(key, (None,) * 3))), (key, r)
        assert close(r["p_holm"], adjusted.get(key), 1e-4), (key, r, adjusted.get(key))  # both integrate the range's tail
        if len({asset_of[s] for s in common}) >= 4 and key in ranked and key != first:
            near = "equivalent" if r["p_equivalent"] and float(r["p_equivalent"]) < 0.05 else "tied"
            assert r["standing"] == ("behind" if adjusted.get(key, 1) < 0.05 else near), (key, r)
    chances = {k: float(r["chance_first"]) for k, r in rows.items() if r["chance_first"]}
    assert not chances or math.isclose(sum(chances.values()), 1, abs_tol=1e-6) and set(chances) == set(ranked), chances

    name = lambda key: key[0] if key[1] == "default" else " ".join(key)  # noqa: E731
    tied = [name(k) for k, r in rows.items() if r["standing"] == "tied" and k != first]
    behind = [name(k) for k, r in rows.items() if r["standing"] == "behind"]
    sentence = page["in_scenes_like_these"]
    said = re.fullmatch(r"In scenes like these (.*?) (certainly has the least error|measures the least error) on average.*?(?: Certainly worse: (.*?)\.| No point is certainly worse\.)?(?: A study like this .*)?", sentence)
    assert said and said[1] == name(first) and (said[2] == "measures the least error") == bool(tied), sentence
    listed = lambda text: re.split(r", | and ", re.sub(r" and \d+ more$", "", text)) if text else []  # noqa: E731
    assert not tied or listed(said[3]) == behind[:3], (sentence, behind)
    if chances:
        likely = max(chances, key=chances.get)
        assert not tied or f"Probability of the least mean error: {name(likely)} {chances[likely]:.2f}" in sentence, (sentence, chances)

    across = {(r["technique"], r["point"]): r for r in read(os.path.join(folder, "tradeoff"), "across.csv") if not r["cost"] and not r["group"]}
    assert across.keys() == rows.keys(), across.keys() ^ rows.keys()
    for key, r in rows.items():
        for column in ("scenes", "shots", "ratio", "low", "high", "rank", "rank_low", "rank_high", "p_holm", "p_equivalent", "chance_first", "chance_near", "standing"):
            assert r[column] == across[key][column], (key, column, r, across[key])
        for end in ("", "_low", "_high"):
            assert r["over_best" + end] == across[key]["against_best" + end], (key, r, across[key])
    with open(os.path.join(folder, "tradeoff", "answers.md"), encoding="utf-8") as stream:
        whole = stream.read().split("## Least error at any cost")[1]
    answer = re.search(r"^\*\*(.*?)\*\* has the least error.*$", whole, re.M)
    assert answer[1] == name(first), answer[0]
    assert not tied or ("It is undecided whether" in answer[0], "Certainly worse" in answer[0]) == (bool(tied), bool(behind)), answer[0]
    print(f"{os.path.basename(folder)}: over {rows[first]['scenes']} scenes {len(tied)} tied, {len(behind)} behind: {sentence}")


def main():
    with tempfile.TemporaryDirectory() as temporary:
        made_up = os.path.join(temporary, "made_up")
        run(REPORT_PAGE, "--study", made_up)
        copies = [shutil.copytree(f, os.path.join(temporary, str(i)), ignore=shutil.ignore_patterns("cells")) for i, f in enumerate(FOLDERS)]
        for folder in [made_up, *copies]:
            said = judge(folder).said
            verdicts = {v for of_pair in said.values() for v in of_pair.values()}
            witnesses = sorted({w for of_pair in said.values() for w in of_pair})
            several = sum(len(of_pair) > 2 for of_pair in said.values())
            print(f"{os.path.basename(folder)}: {len(said)} pairs, {several} with three witnesses or more; {', '.join(witnesses)}; {', '.join(sorted(verdicts))}")
            assert folder != made_up or {"effects.csv", "pairs.csv", "report", "summary.csv", "table of effects", "tables"} <= set(witnesses), witnesses
            assert several and MORE in verdicts and verdicts & {SAME, NEAR} or folder != made_up, "the made-up study has ties and differences"


main()
