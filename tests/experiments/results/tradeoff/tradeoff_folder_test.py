"""Error against run time: a made-up results folder, from its tables to its answers.

usage: tradeoff_folder_test.py SSRLAB
"""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

SSRLAB = sys.argv.pop(1)

from ssrlab.mistakes import ResultsError
from ssrlab.results import Results
from ssrlab.repository import ROOT
from ssrlab.tables.cells import Table, cells_of

FRAMES = 15
MACHINES = (("first", ("floor", "wall")), ("second", ("roof",)))
PRESETS = {"none": (0.2, 8.0), "v:rays=1": (4.0, 2.0), "v:rays=2": (8.0, 1.0), "v:rays=4": (16.0, 0.5), "v:rays=8": (32.0, 0.25), "w": (6.0, 4.0)}


COLUMNS = {  # of the files that ssrlab reads, which refuses those that lack one
    "summary.csv": "shot,frame,technique,point,target,metric,formula,mask,seeds,value,low,high,interval,ranked,seed_deviation,floor,lit_noise,corrected,value_of_power,value_of_bounded,pixels,non_finite,negative,represents_shot,standing,over_best,over_best_low,over_best_high,p_best,p_equivalent,fronts,dominated",
    "results.csv": "shot,scene,camera,frame,width,height,technique,point,seed,target,metric,formula,mask,value,corrected,uncorrected,low,high,floor,lit_noise,lit_half_width,pixels,non_finite,negative,represents_shot",
    "times.csv": "shot,technique,point,seed,stage,frame,milliseconds,clock,foreign_load,disturbed",
    "time_summary.csv": "shot,technique,point,stage,clock,frames,median_ms,low_ms,high_ms,fits_from_ms,may_fit_from_ms,disturbed_share",
    "effects.csv": "shot,frame,technique,point,against,against_technique,against_point,target,metric,formula,mask,seeds,ratio,low,high,interval,p,family,p_holm,low_holm,high_holm,p_equivalent,p_equivalent_holm,verdict",
    "over_scenes.csv": "target,metric,mask,technique,point,baseline_technique,baseline_point,scenes,shots,ratio,low,high,rank,rank_low,rank_high,over_best,over_best_low,over_best_high,p_holm,p_equivalent,chance_first,chance_near,standing",
    "splits.csv": "shot,frame,technique,point,target,mask,seeds,mse,bias_squared,variance,variance_low,variance_high,pixels,bias_squared_low,bias_squared_high",
    "time_effects.csv": "shot,technique,point,against,against_technique,against_point,stage,clock,rounds,ratio,low,high,p,p_holm,low_holm,high_holm,verdict",
    "costs.csv": "shot,technique,point,stage,quantity,value",
    "estimates.csv": "shot,technique,point,stage,chip,driver,product,microseconds,low,high,bound,vector,scalar,shared_memory,textures,targets,memory,latency,caches,waves,active_lanes,unmatched,cut_lanes,refusal",
}
NUMBERS = ("seeds", "corrected", "pixels", "non_finite", "negative", "frames", "rounds", "width", "height", "seed", "disturbed", "represents_shot", "ranked", "frame")  # where a row says nothing of them, 0


def write_csv(folder, name, rows):
    columns = COLUMNS[name].split(",")
    with open(os.path.join(folder, name), "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore")
        writer.writeheader()
        writer.writerows({c: r.get(c, 0 if c in NUMBERS else "") for c in columns} for r in rows)


def own_times(shot, technique, point, ms):
    """A row of time_summary.csv: two copies differ by 2 % at most."""
    ends = {"low_ms": ms / 1.01, "high_ms": 1.01 * ms, "fits_from_ms": 1.02 * ms, "may_fit_from_ms": ms / 1.02}
    return {"shot": shot, "technique": technique, "point": point, "stage": "total", "clock": "host_fence", "median_ms": ms, "disturbed_share": 0} | ends


def write_study(folder):
    """Three shots, two on one machine; errors of `v` are 8 / ms."""
    shots = [s for _, of_machine in MACHINES for s in of_machine]
    names_of_cells = dict(zip((n for n, _ in MACHINES), ("times", "timing")))  # now, and in earlier versions
    keys = {name: tuple(name.partition(":")[::2]) for name in PRESETS}
    keys = {name: (v, p or "default") for name, (v, p) in keys.items()}
    errors, times, counts, estimates, effects = [], [], [], [], []
    errors += [{"shot": "moon", "technique": "none", "point": "default", "frame": 0, "target": "specular", "metric": "mse", "mask": "reflective", "value": 1, "represents_shot": 1}]
    oracle = {"technique": "oracle", "point": "default", "frame": 0, "target": "specular", "metric": "mse", "mask": "reflective", "represents_shot": 1, "seed": 0}
    errors += [oracle | {"shot": s, "value": 0.01, "low": 0.01, "high": 0.01, "ranked": 1} for s in shots]
    # Over the frames of `sky` there is next to no error, and no time.
    nearly_none = {"shot": "sky", "technique": "none", "frame": "", "value": 0.0015, "low": 0.0014, "high": 0.0016, "ranked": 1, "floor": 0.001}
    errors.append(oracle | nearly_none)
    for number, a_shot in enumerate(shots):
        for name, (ms, error) in PRESETS.items():
            own = {"shot": a_shot, "technique": keys[name][0], "point": keys[name][1]}
            row = own | {"frame": 0, "target": "specular", "metric": "mse", "mask": "reflective", "value": error * (number + 1), "represents_shot": 1}
            standing = {"standing": "best"} if name == "v:rays=8" else {"standing": "behind", "p_best": 0.001, "p_equivalent": 1}
            errors.append(row | {"low": row["value"] * 0.99, "high": row["value"] * 1.01, "ranked": 1, "floor": 0.001, "seed": 0} | standing)
            for frame in range(FRAMES):
                times.append(own | {"seed": 0, "stage": "total", "frame": frame, "milliseconds": ms * (1 + 0.01 * (frame % 3)), "clock": "host_fence", "disturbed": 0})
                times.append(own | {"stage": "v/march", "frame": frame, "milliseconds": 500, "clock": "host_fence"})
                times.append(own | {"technique": "", "point": "", "stage": "gbuffer/draw", "frame": frame, "milliseconds": 1000, "clock": "host_fence"})
            counts += [own | {"stage": stage, "quantity": "fetches", "value": round(50 * ms)} for stage in ("march", "shade")]
            on_chip = own | {"chip": "navi21", "product": "Radeon RX 6800 XT"}
            estimates += [on_chip | {"stage": "march", "microseconds": 500, "low": 500, "high": 500}]
            if name == "w":
                estimates += [on_chip | {"stage": "total", "refusal": "march: the compiler ended"}]
            else:
                estimates += [on_chip | {"stage": "total", "microseconds": 10 * ms, "low": 9 * ms, "high": 10.5 * ms}]
        compared = {"shot": a_shot, "technique": "v", "point": "rays=2", "against_technique": "v", "against_point": "rays=1", "target": "specular"}
        effects.append(compared | {"metric": "mse", "mask": "reflective", "ratio": 0.5, "low": 0.49, "high": 0.51, "p_holm": 0.001, "low_holm": 0.48, "high_holm": 0.52, "verdict": "less"})
    write_csv(folder, "summary.csv", errors)
    over_scenes = {"target": "specular", "metric": "mse", "mask": "all", "technique": "v", "point": "rays=1", "scenes": 3, "shots": 3, "ratio": 0.25, "low": 0.2, "high": 0.3}
    write_csv(folder, "over_scenes.csv", [over_scenes])  # tradeoff compares anew, by its own baseline and shots
    write_csv(folder, "results.csv", errors)
    write_csv(folder, "times.csv", times)
    medians = [own_times(s, *keys[name], 1.01 * ms) for s in shots for name, (ms, _) in PRESETS.items()]
    write_csv(folder, "time_summary.csv", medians)
    write_csv(folder, "costs.csv", counts)
    write_csv(folder, "estimates.csv", estimates)
    write_csv(folder, "effects.csv", effects)
    write_csv(folder, "splits.csv", [])
    of_times = {"technique": "v", "point": "rays=2", "against_technique": "v", "against_point": "rays=1", "stage": "total", "ratio": 2, "low": 2, "high": 2}
    write_csv(folder, "time_effects.csv", [of_times | {"shot": s, "p": 0.001, "p_holm": 0.002, "low_holm": 1.9, "high_holm": 2.1, "verdict": "more"} for s in shots])
    manifest = {
        "title": "Made up",
        "is_complete": True,
        "primary": {"metric": "mse", "mask": "reflective", "target": "specular"},
        "clock": {"aa_floors": {s: 0.02 for s in shots}, "aa_pairs": [{"shot": s} for s in shots for _ in range(12)], "proofs": [{"verdict": "passed", "shots": ["floor", "wall"]}]},
        "study": {"name": "made_up", "config": "made_up.json"},
        "provenance": [{"ssrlab": {"commit": "abc1234"}, "host": {"name": n, "cpu": "c", "cores": 2}, "device": {"name": "d"}, "cells": [{"what": f"{s}: {names_of_cells[n]}"} for s in of]} for n, of in MACHINES],
        "shots": [{"shot": s, "scene": s, "width": 64, "height": 36, "truth_ladder": [{"rung": "on_screen", "target": "specular", "metric": "mse", "mask": "reflective", "value": 0.1}]} for s in (*shots, "sky")],
        "techniques": [{"technique": v, "point": p, "parameters": {"rays": int(p[-1])} if "=" in p else {}, "entry": {"technique": v}} for v, p in keys.values()],
    }
    manifest["techniques"].append({"technique": "oracle", "point": "default", "uses_scene_data": True, "parameters": {}})
    with open(os.path.join(folder, "manifest.json"), "w", encoding="utf-8") as stream:
        json.dump(manifest, stream)


def run(*arguments):
    """Exit code and what was said of mistakes."""
    done = subprocess.run([SSRLAB, "tradeoff", *arguments], capture_output=True, text=True)
    return done.returncode, done.stderr


def read(folder, name):
    with open(os.path.join(folder, name), newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


class Folder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = cls.temporary.name
        write_study(cls.folder)
        asked = ["--leave-out", "moon", "--times", "3", "4.1", "10", "--factors", "0.0625", "--baseline", "none:default"]
        cls.done = subprocess.run([SSRLAB, "tradeoff", cls.folder, *asked], capture_output=True, text=True)
        cls.out = os.path.join(cls.folder, "tradeoff")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_the_tables(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        front = {(r["shot"], r["label"]): r for r in read(self.out, "front.csv")}
        self.assertEqual(front["floor", "w"]["verdict"], "dominated")
        self.assertEqual((front["floor", "w"]["dominated_by"], front["floor", "v rays=8"]["is_nominal_front"]), ("v rays=1", "1"))
        self.assertAlmostEqual(float(front["floor", "v rays=1"]["cost"]), 4.04)  # of `total` alone, in the middle of 4, 4.04, 4.08
        at = {(r["shot"], r["technique"], float(r["cost"])): r for r in read(self.out, "error_at_cost.csv")}
        self.assertAlmostEqual(float(at["wall", "v", 10]["error"]), 2 * 8.08 / 10, places=5)
        self.assertEqual(at["wall", "v", 3]["status"], "before start")
        self.assertEqual((at["wall", "v", 10]["point"], at["wall", "v", 3]["error"]), ("rays=2", ""))
        self.assertEqual((at["wall", "v", 10]["point_error"], at["wall", "v", 10]["chosen_on"]), ("2", "other scenes"))  # as it ran
        to = {(r["shot"], r["technique"]): r for r in read(self.out, "cost_to_error.csv")}
        self.assertAlmostEqual(float(to["roof", "v"]["cost"]), 16.16, places=3)
        self.assertEqual((to["roof", "w"]["status"], to["roof", "w"]["cost"]), ("not reached", ""))
        self.assertEqual((at["floor", "v", 10]["status"], at["floor", "v", 4.1]["status"]), ("between", "between"))
        (fit, *_) = read(self.out, "fits.csv")
        self.assertEqual((fit["parameter"], fit["points"], fit["floor_low"], fit["rung"]), ("rays", "4", "0", "on_screen"))
        self.assertEqual(fit["point_names"], "rays=1; rays=2; rays=4; rays=8")
        self.assertEqual((at["floor", "v", 4.1]["fits"], at["floor", "v", 10]["fits"]), ("maybe", "surely"))  # 4.04 ms and 2 %
        self.assertEqual({s for s, _ in front}, {"floor", "wall", "roof", "sky"})  # moon was left out
        self.assertEqual(front["floor", "oracle"]["verdict"], "uses scene data")
        self.assertEqual({r["shot"] for r in read(self.out, "limits.csv")}, {"floor", "wall", "roof"})
        (limit, *_) = read(self.out, "limits.csv")
        self.assertEqual((limit["label"], float(limit["over_rung"])), ("v rays=8", 2.5))
        change = next(r for r in read(self.out, "stages.csv") if r["shot"] == "floor")
        self.assertEqual((change["change"], change["verdict"]), ("rays: 1 -> 2", "buys error"))
        self.assertAlmostEqual(float(change["cost_per_percent"]), 4.04 / 100, places=4)  # 100 % more error without

    def test_machines_are_never_mixed(self):
        with open(os.path.join(self.out, "answers.md"), encoding="utf-8") as stream:
            answers = stream.read()
        self.assertIn("Times of different machines or sizes are never compared", answers)
        # 0.8 of 8 in `floor` and as much in `wall`; nothing fits in 3 ms but `none`.
        self.assertIn("| 3 | no technique fits in all scenes |", answers)
        self.assertIn("**v** has the least error, 0.125 times the error of none (geometric mean, 2 scenes)", answers)
        self.assertIn("2 scenes say nothing about other scenes", answers)
        # v rays=2 takes 8 ms, rays=4 takes 16.
        self.assertIn('Chosen on all of these scenes together, its best point within this cost is v rays=2, in a config `{"technique":"v"}`.', answers)
        self.assertIn("| v rays=1: rays: 1 -> 2 | wall | -50 [-52, -48] |", answers)
        self.assertIn("Ratios leave out sky,", answers)
        self.assertIn("The timer was not validated in 1 of 3 shots", answers)
        rows = [r for r in read(self.out, "across.csv") if r["technique"] == "v" and r["cost"] == "10"]
        self.assertEqual([(r["machine"].split()[0], r["scenes"]) for r in rows], [("first", "2"), ("second", "1")])
        self.assertEqual(len([r for r in read(self.out, "stages.csv") if not r["shot"]]), 2)

    def cells(self, **entry):
        """{(row, column): Cell} of a table, and what is said of it."""
        about, cells = cells_of(Results(self.folder), Table({"name": "t", "caption": "", **entry}))
        return {(c.row.split(", ")[-1], c.column): c for c in cells if c.row.startswith("first")}, about

    def test_answers_become_tables_of_documents(self):
        at_cost = {"of": "at_cost", "where": {"cost": ["10", "3"]}, "rows": ["machine", "technique"], "columns": "cost"}
        cells, about = self.cells(**at_cost)
        self.assertAlmostEqual(cells["v", "10"].value, 0.125, places=3)
        self.assertEqual((cells["v", "10"].mean_of, about["over"], about["over_count"]), (2, "scene", 4))
        self.assertNotIn(("v", "3"), cells)
        changes, _ = self.cells(of="changes", rows=["machine", "change"], columns="quantity")
        self.assertAlmostEqual(changes["rays: 1 -> 2", "error"].value, 0.5)
        self.assertAlmostEqual(changes["rays: 1 -> 2", "cost"].value, 4.04)
        self.assertIsNone(changes["rays: 1 -> 2", "cost per % of error"].value, "two scenes are too few to give it")
        _, over_scenes = cells_of(Results(self.folder), Table({"name": "t", "caption": "", "of": "over_scenes", "rows": ["technique", "point"], "columns": "mask"}))
        self.assertEqual([(c.row, c.column, c.value, c.low, c.high, c.mean_of) for c in over_scenes], [("v, rays=1", "all", 0.25, 0.2, 0.3, 3)])
        # What was answered of other errors is none of these.
        summary = os.path.join(self.folder, "summary.csv")
        with open(summary, encoding="utf-8") as stream:
            text = stream.read()
        with open(summary, "w", encoding="utf-8") as stream:
            stream.write(text.replace(",8.0,", ",8.1,"))
        with self.assertRaisesRegex(ResultsError, "not of the study's primary error.*run `ssrlab tradeoff"):
            self.cells(**at_cost)
        with open(summary, "w", encoding="utf-8") as stream:
            stream.write(text)
        os.rename(self.out, self.out + "_away")
        with self.assertRaisesRegex(ResultsError, "is missing: run `ssrlab tradeoff"):
            self.cells(**at_cost)
        os.rename(self.out + "_away", self.out)

    def test_counted_costs_take_the_place_of_times(self):
        out = os.path.join(self.folder, "counted")
        self.assertEqual(run(self.folder, "--cost", "fetches", "--times", "1000", "--out", out), (0, ""))
        at = {(r["shot"], r["technique"]): r for r in read(out, "error_at_cost.csv")}
        self.assertAlmostEqual(float(at["floor", "v"]["error"]), 0.8, places=6)
        self.assertEqual({r["cost_low"] for r in read(out, "front.csv") if r["label"] == "w"}, {"600"})
        self.assertIn("costs.csv has no 'bytes', and estimates.csv no such chip; known are: fetches, navi21", run(self.folder, "--cost", "bytes")[1])

    def test_estimated_times_of_a_chip_take_the_place_of_times(self):
        out = os.path.join(self.folder, "estimated")
        self.assertEqual(run(self.folder, "--cost", "navi21", "--times", "41", "100", "2000", "--leave-out", "roof", "moon", "sky", "--out", out), (0, ""))
        front = {(r["shot"], r["label"]): r for r in read(out, "front.csv")}
        self.assertEqual([float(front["floor", "v rays=1"][c]) for c in ("cost", "cost_low", "cost_high")], [40, 36, 42])
        self.assertEqual((front["floor", "w"]["cost"], front["floor", "w"]["verdict"]), ("", "no cost"))
        unit = "us on navi21, estimated"
        self.assertEqual({r["unit"] for name in ("front", "across", "error_at_cost", "stages") for r in read(out, f"{name}.csv")}, {unit})
        at = {(r["shot"], r["technique"], float(r["cost"])): r for r in read(out, "error_at_cost.csv")}
        self.assertEqual(at["floor", "v", 41]["fits"], "maybe")  # its interval ends at 42
        # 80 us, up to 84 by sampling: measured times were up to 12.8 times such estimates.
        self.assertEqual((at["floor", "v", 100]["point"], at["floor", "v", 100]["fits"]), ("rays=2", "maybe"))
        self.assertEqual((at["floor", "v", 2000]["point"], at["floor", "v", 2000]["fits"]), ("rays=8", "maybe"))  # 320 us
        change = next(r for r in read(out, "stages.csv") if r["shot"] == "floor")
        self.assertEqual([float(change[c]) for c in ("cost", "cost_low", "cost_high")], [40, 72 - 42, 84 - 36])
        self.assertEqual(change["verdict"], "buys error")  # twice the estimate, so clearly apart
        with open(os.path.join(out, "answers.md"), encoding="utf-8") as stream:
            answers = stream.read()
        self.assertIn("No GPU ran anything", answers)
        self.assertIn("measured times of stages were 0.22 to 12.8 times such estimates (NVIDIA H200", answers)
        self.assertIn(f"### 100 {unit}", answers)
        self.assertIn("**w has no estimate** in floor and wall and is left out there: march: the compiler ended.", answers)
        self.assertIn("did you mean 'navi21'?", run(self.folder, "--cost", "navi2")[1])

    def test_a_link_leads_nowhere(self):
        with tempfile.TemporaryDirectory() as strange, tempfile.TemporaryDirectory() as outside:
            write_study(strange)
            os.symlink(outside, os.path.join(strange, "tradeoff"))
            code, said = run(strange)
            self.assertEqual((code, os.listdir(outside)), (2, []), said)
            self.assertIn("tradeoff is a symbolic link", said)

    def test_mistakes(self):
        for options, said in ((["--baseline", "x"], "no point x"), (["--metric", "flip"], "no errors of specular flip"), (["--leave-out", "sun"], "'sun'")):
            code, found = run(self.folder, *options)
            self.assertEqual(code, 2)
            self.assertIn(said, found)

    def test_the_readme_has_every_column(self):
        with open(ROOT / "experiments/results/tradeoff/README.md", encoding="utf-8") as stream:
            sections = re.split(r"^`(\w+\.csv)`", stream.read(), flags=re.M)
        explained = {name: set(re.findall(r"`(\w+)`", text)) for name, text in zip(sections[1::2], sections[2::2])}
        for name in ("error_at_cost.csv", "cost_to_error.csv", "fits.csv", "limits.csv", "front.csv", "pairs.csv", "across.csv", "stages.csv"):
            with open(os.path.join(self.out, name), encoding="utf-8") as stream:
                columns = stream.readline().strip().split(",")
            self.assertEqual(set(columns) - explained[name], set(), name)


if __name__ == "__main__":
    unittest.main()
