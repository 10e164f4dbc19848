"""How well `ssrlab plan` tells what a study takes.

usage: python3 tests/experiments/study/plan_benchmark.py SSRLAB [--busy] [--only NAME] [--json FILE.json]

Each study below is planned, and then run with no reference in the cache. The table has the share of all processors that other programs
took, while the study was planned and while it ran; then the processor time of all threads and the time on the wall, estimated and taken.
--busy lets as many other processes compute meanwhile as the machine has processors. --only runs the studies whose name has this text.
--json adds the rows to those of the file; the table is then of all of them."""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

QUIET = {"timing": {"frames": 0}}
STOCHASTIC = [{"technique": "none"}, {"technique": "amd_sssr"}, {"technique": "frostbite_sssr"}, {"technique": "diligent_ssr"}]
MARCHES = [{"technique": "none"}, {"technique": "mcguire_dda", "sweep": {"dda.stride": [1, 2, 4, 8]}}, {"technique": "simple_ssr"}]
EVERY = [*STOCHASTIC, {"technique": "mcguire_dda"}, {"technique": "simple_ssr"}, {"technique": "four_mode_ssr"}, {"technique": "composed_ssr"}]


def study(scenes, size, samples, techniques, seeds=2, shot=None, **more):
    return {"shots": [{"scene": scenes, "resolution": [size, size * 9 // 16], **(shot or {})}], "reference": {"samples": samples}, "seeds": seeds,
            "techniques": techniques, **more}


def moving(first, last, warm_up=0):
    return {"frames": {"from": first, "to": last}, "measure_from": first + (last - first) // 2, "warm_up": warm_up}


# The scenes `room:` and `street:` are those of no one: the nearest to the scenes of a user.
STUDIES = {
    "marches": study("mirror_pillars", 320, 64, MARCHES, **QUIET),
    "marches, large": study("corridor", 640, 32, MARCHES, **QUIET),
    "marches, timed": study("fence", 256, 64, MARCHES, timing={"frames": 15, "warm_up": 2}),
    "marches, three scenes": study(["corridor", "metal_corner", "fence"], 256, 64, MARCHES, **QUIET),
    "noisy": study("metal_corner", 256, 128, STOCHASTIC, seeds=4, **QUIET),
    "noisy, large": study("glossy_stretch", 640, 32, STOCHASTIC, **QUIET),
    "noisy, warmed up": study("roughness_steps", 256, 64, STOCHASTIC, seeds=4, shot={"warm_up": 16}, **QUIET),
    "noisy, timed": study("normal_mapped", 192, 64, STOCHASTIC, timing={"frames": 15, "warm_up": 2}),
    "all": study("curved_metal", 256, 64, EVERY, **QUIET),
    "motion": study("normal_mapped", 192, 64, STOCHASTIC, shot={"camera": "dolly", **moving(60, 67)}, **QUIET),
    "motion of marches": study("corridor", 256, 32, MARCHES, shot={"camera": "dolly", **moving(10, 17)}, **QUIET),
    "motion of objects": study("moving_objects", 192, 32, STOCHASTIC, shot=moving(10, 21, 8), **QUIET),
    "room": study("room:7", 192, 64, STOCHASTIC, **QUIET),
    "two rooms": study(["room:3", "room:12"], 160, 32, MARCHES, **QUIET),
    "scene and room": study(["corridor", "room:7"], 160, 64, MARCHES, **QUIET),
    "street and scenes": study(["street:4", "fence", "metal_corner"], 160, 64, MARCHES, **QUIET),
    "street": study("street:4", 192, 64, EVERY, **QUIET),
    "samples": study("contact_hardening", 192, 512, [{"technique": "none"}, {"technique": "amd_sssr"}], **QUIET),
    "flip": study("mirror_pillars", 256, 64, STOCHASTIC, metrics=["mse", "flip"], targets=["specular", "image", "on_screen"], **QUIET),
    "quickstart's kinds": study("metal_corner", 128, 64, EVERY, timing={"frames": 15, "warm_up": 2}, hits={"seeds": 2}, shot={"warm_up": 8}),
}


def busy_seconds():
    """Of all processors and programs (proc(5))."""
    ticks = [int(field) for field in pathlib.Path("/proc/stat").read_text(encoding="ascii").split("\n")[0].split()[1:9]]
    return (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK")


def spent_by(command):
    """Seconds on the wall and of processors, and the share of the machine that others took."""
    start, before, busy = time.monotonic(), os.times(), busy_seconds()
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}:\n{ran.stdout}{ran.stderr}")
    after, wall = os.times(), time.monotonic() - start
    own = after.children_user + after.children_system - before.children_user - before.children_system
    return wall, own, max(busy_seconds() - busy - own, 0) / (wall * os.cpu_count())


def trial(ssrlab, name, config):
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "study.json").write_text(json.dumps(config), encoding="utf-8")
        where = [folder / "study.json", "--out", folder / "out"]
        planning = spent_by([ssrlab, "plan", *where, "--json", folder / "plan.json"])
        cells = json.loads((folder / "plan.json").read_text(encoding="utf-8"))["cells"]
        running = spent_by([ssrlab, "run", *where, "--cache", folder / "cache"])
    return {
        "study": name,
        "wall": [sum(cell["seconds"] for cell in cells), running[0]],
        "processors": [sum(cell["processor_seconds"] for cell in cells), running[1]],
        "load": [planning[2], running[2]],
    }


def table(rows):
    lines = ["| study | others (%) | processor time (s): estimated | taken | ratio | time (s): estimated | taken | ratio |", "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        cells = [row["study"], " ".join(f"{100 * share:.0f}" for share in row["load"])]
        for clock in ("processors", "wall"):
            estimated, taken = row[clock]
            cells += [f"{estimated:.1f}", f"{taken:.1f}", f"{taken / estimated:.2f}"]
        lines.append("| " + " | ".join(cells) + " |")
    for clock in ("processors", "wall"):
        ratios = sorted(row[clock][1] / row[clock][0] for row in rows)
        outside = len(ratios) // 10
        low, high = ratios[outside // 2], ratios[-1 - (outside - outside // 2)]
        lines.append(
            f"\n{clock}: taken / estimated {ratios[0]:.2f} to {ratios[-1]:.2f}, median {ratios[len(ratios) // 2]:.2f}, "
            f"{len(ratios) - outside} of {len(ratios)} trials in {low:.2f} to {high:.2f}"
        )
    return "\n".join(lines)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("ssrlab", type=pathlib.Path)
    words.add_argument("--busy", action="store_true")
    words.add_argument("--only", default="")
    words.add_argument("--json", type=pathlib.Path)
    asked = words.parse_args()
    rows = json.loads(asked.json.read_text(encoding="utf-8")) if asked.json and asked.json.exists() else []
    others = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count() if asked.busy else 0)]
    try:
        for name, config in STUDIES.items():
            if asked.only not in name:
                continue
            rows.append(trial(asked.ssrlab.resolve(), name, config))
            print(json.dumps(rows[-1]), file=sys.stderr, flush=True)
            if asked.json:
                asked.json.write_text(json.dumps(rows, indent=1), encoding="utf-8")
    finally:
        for other in others:
            other.kill()
    print(table(rows))


if __name__ == "__main__":
    main()
