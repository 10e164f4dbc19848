"""A made-up study, as a results folder that tables are made of."""

import csv
import json
import os

SHOTS = ("floor", "wall")
TABLES = [
    {
        "name": "changes",
        "caption": "What each change does_to {the} error",
        "of": "effects",
        "where": {"target": "specular", "metric": ["mse", "flip"]},
        "rows": "taps",
        "columns": "metric",
        "over": "shot",
        "sort": "mse",
        "labels": {"taps = 16": "sixteen | taps"},
    },
    {
        "name": "levels",
        "caption": "Errors",
        "of": "results",
        "where": {"metric": "mse", "point": ["taps=4", "default"]},
        "rows": ["technique", "point"],
        "columns": "shot",
    },
    {"name": "parts", "caption": "Parts", "of": "splits", "where": {"shot": "floor"}, "rows": "point", "columns": "metric"},
]
SEEDS, REFERENCE, ONE_SEED = "seeds", "reference and seeds", "none: 1 seed"  # experiments/results/verdicts/interval.h
RATIOS = {  # point, metric, shot: ratio, low, high, p_holm
    ("taps=4", "mse", "floor"): (0.5, 0.45, 0.555555555555, 0.001),
    ("taps=4", "mse", "wall"): (2.0, 1.8, 2.222222222222, 0.001),
    ("taps=4", "flip", "floor"): (0.81, 0.80, 0.82, 0.2),
    ("taps=4", "flip", "wall"): (0.81, "", "", ""),
    ("taps=16", "mse", "floor"): (0.25, 0.2, 0.3, 0.2),
    ("taps=16", "mse", "wall"): (0.25, 0.2, 0.3, 0.2),
}


def write(file, text):
    os.makedirs(os.path.dirname(file), exist_ok=True)
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(text)


def read(file):
    with open(file, encoding="utf-8") as stream:
        return stream.read()


def footer(folder, name):
    """The line below a table that was made."""
    return read(os.path.join(folder, "tables", name + ".md")).splitlines()[-1]


def write_rows(file, rows):
    with open(file, "w", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


def manifest(tables, verdict="passed"):
    points = [("default", 1), ("taps=4", 4), ("taps=16", 16)]
    return {
        "provenance": [
            {
                "ssrlab": {"commit": "abc1234", "dirty": False, "code": "00ff", "estimators": 7},
                "device": {"name": "a device"},
                "finished": "2026-01-31T12:05:00Z",
            }
        ],
        "study": {"name": "made_up", "config": "configs/made_up.json"},
        "title": "Made up",
        "is_complete": True,
        "config": {"tables": tables},
        "metrics": {m: {"better": b} for m, b in (("mse", "lower"), ("flip", "lower"), ("ssim", "higher"))},
        "clock": {"proofs": [{"verdict": verdict, "shots": SHOTS}]},
        "shots": [{"shot": s, "width": 320, "height": 180} for s in SHOTS],
        "techniques": [{"technique": "sssr", "point": p, "parameters": {"taps": taps}} for p, taps in points],
    }


def write_results(folder, tables=TABLES, ratios=RATIOS):
    write(os.path.join(folder, "manifest.json"), json.dumps(manifest(tables)))
    effects = [
        {"shot": shot, "frame": "0", "technique": "sssr", "point": point, "against": "baseline", "against_technique": "sssr"}
        | {"against_point": "default", "target": "specular", "metric": metric, "mask": "all", "seeds": 8}
        | {"interval": SEEDS if metric == "flip" else REFERENCE}
        | dict(zip(("ratio", "low_holm", "high_holm", "p_holm", "interval"), numbers))
        | {"verdict": "" if numbers[3] == "" else "undecided" if numbers[3] > 0.05 else "less" if numbers[0] < 1 else "more"}
        for (point, metric, shot), numbers in ratios.items()
    ]
    write_rows(os.path.join(folder, "effects.csv"), effects)
    errors = [
        {"shot": shot, "frame": frame, "technique": "sssr", "point": point, "target": "specular", "metric": "mse", "mask": "all"}
        | {"seeds": 8, "value": value, "low": value * 0.9, "high": value * 1.1, "represents_shot": int(frame == ""), "standing": "best" if point == "taps=4" else "behind", "dominated": ""}
        for shot in SHOTS
        for frame, point, value in (("3", "default", 5.0), ("", "default", 0.0123), ("3", "taps=4", 0.002))
    ]
    errors += [row | {"frame": "", "value": 0.00234, "low": "", "high": "", "represents_shot": 1} for row in errors if row["point"] == "taps=4"]
    write_rows(os.path.join(folder, "summary.csv"), errors)
    split = {"shot": "floor", "frame": "3", "technique": "sssr", "target": "specular", "mask": "all", "seeds": 8, "mse": 3}
    split |= {"bias_squared": 2, "bias_squared_low": 1.5, "bias_squared_high": 2.5, "variance": 1}
    split |= {"variance_low": 0.9, "variance_high": 1.1}
    write_rows(os.path.join(folder, "splits.csv"), [split | {"point": "default"}, split | {"point": "taps=4"}])
    times = [
        {"shot": shot, "technique": "sssr", "point": point, "stage": "total", "clock": "gpu_timestamp", "frames": 15}
        | {"median_ms": 2, "low_ms": 1.9, "high_ms": 2.1, "disturbed_share": 0.4 if (shot, point) == ("wall", "default") else 0}
        for shot in SHOTS
        for point in ("default", "taps=4")
    ]
    for row in times:  # as ssrlab decides them: made up, and printed by no table
        row |= {"fits_from_ms": row["high_ms"], "may_fit_from_ms": row["low_ms"]}
    write_rows(os.path.join(folder, "time_summary.csv"), times)
    ratio = {"technique": "sssr", "point": "taps=4", "against": "baseline", "against_technique": "sssr", "against_point": "default"}
    ratio |= {"stage": "total", "clock": "gpu_timestamp", "rounds": 15, "ratio": 1, "low": 0.9, "high": 1.1, "low_holm": 0.9, "high_holm": 1.1, "verdict": "undecided"}
    write_rows(os.path.join(folder, "time_effects.csv"), [{"shot": shot} | ratio for shot in SHOTS])
