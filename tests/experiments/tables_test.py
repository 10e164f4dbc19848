"""Tables of a made-up study, from its results folder to the documents that show them.

usage: tables_test.py TABLES_SCRIPT
"""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile

script = sys.argv[1]
sys.path.insert(0, os.path.dirname(script))
sys.dont_write_bytecode = True

from paper_tables import summary_file  # noqa: E402

SHOTS = ("floor", "wall")
TABLES = [
    {
        "name": "changes",
        "caption": "What each change does_to the error",
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
        "rows": ["variant", "point"],
        "columns": "shot",
    },
    {"name": "parts", "caption": "Parts", "of": "splits", "where": {"shot": "floor"}, "rows": "point", "columns": "metric"},
]
RATIOS = {  # point, metric, shot: ratio, low, high, p_holm
    ("taps=4", "mse", "floor"): (0.5, 0.45, 0.555555555555, 0.001),
    ("taps=4", "mse", "wall"): (2.0, 1.8, 2.222222222222, 0.001),
    ("taps=4", "flip", "floor"): (0.81, 0.80, 0.82, 0.2),
    ("taps=4", "flip", "wall"): (0.81, "", "", ""),
    ("taps=16", "mse", "floor"): (0.25, 0.2, 0.3, 0.2),
    ("taps=16", "mse", "wall"): (0.25, 0.2, 0.3, 0.2),
}


def check(is_true, what):
    if not is_true:
        sys.exit(f"tables_test: {what}")


def write(file, text):
    os.makedirs(os.path.dirname(file), exist_ok=True)
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(text)


def read(file):
    with open(file, encoding="utf-8") as stream:
        return stream.read()


def write_rows(file, rows):
    with open(file, "w", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


def manifest(tables):
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
        "config": {"tables": tables},
        "shots": [{"shot": s, "width": 320, "height": 180} for s in SHOTS],
        "variants": [{"variant": "sssr", "point": p, "parameters": {"taps": taps}} for p, taps in points],
    }


def write_results(folder, tables=TABLES):
    write(os.path.join(folder, "manifest.json"), json.dumps(manifest(tables)))
    effects = [
        {"shot": shot, "frame": "0", "variant": "sssr", "point": point, "against": "baseline", "against_variant": "sssr"}
        | {"against_point": "default", "target": "specular", "metric": metric, "mask": "all", "seeds": 8}
        | dict(zip(("ratio", "low", "high", "p_holm"), numbers))
        for (point, metric, shot), numbers in RATIOS.items()
    ]
    write_rows(os.path.join(folder, "effects.csv"), effects)
    errors = [
        {"shot": shot, "frame": frame, "variant": "sssr", "point": point, "target": "specular", "metric": "mse", "mask": "all"}
        | {"seeds": 8, "value": value, "low": value * 0.9, "high": value * 1.1}
        for shot in SHOTS
        for frame, point, value in (("3", "default", 5.0), ("all", "default", 0.0123), ("3", "taps=4", 0.002))
    ]
    errors += [row | {"frame": "all", "value": 0.00234, "low": "", "high": ""} for row in errors if row["point"] == "taps=4"]
    write_rows(os.path.join(folder, "summary.csv"), errors)
    split = {"shot": "floor", "frame": "3", "variant": "sssr", "target": "specular", "mask": "all", "seeds": 8, "mse": 3}
    split |= {"bias_squared": 2, "bias_squared_low": 1.5, "bias_squared_high": 2.5, "variance": 1}
    split |= {"variance_low": 0.9, "variance_high": 1.1}
    write_rows(os.path.join(folder, "splits.csv"), [split | {"point": "default"}, split | {"point": "taps=4"}])
    write_rows(os.path.join(folder, "time_summary.csv"), [{"shot": "floor", "variant": "", "point": ""}])


def tables(*arguments):
    return subprocess.run([sys.executable, "-B", script, *arguments], capture_output=True, text=True)


def test_numbers(folder):
    result = tables(folder)
    check(result.returncode == 0, result.stderr)
    changes = read(os.path.join(folder, "tables", "changes.md")).splitlines()
    # exp(mean of logs) = 1; half-widths of the logarithms are ln(1 / 0.9) each, their root of squares over 2 is
    # 0.0745, so that the interval is [0.928, 1.077].
    half = math.sqrt(2) * math.log(1 / 0.9) / 2
    check(abs(math.exp(half) - 1.0773) < 1e-4, "the expectation itself")
    check(changes[2] == "| | mse | flip |", changes[2])
    check(changes[4] == r"| sixteen \| taps | 0.250 [0.217, 0.289] |  |", changes[4])  # sorted by mse
    check(changes[5] == "| taps = 4 | 1.000 [0.928, 1.077] (0.500 to 2.000) | 0.810 |", changes[5])
    check("configs/made_up.json" in changes[7] and "abc1234" in changes[7] and "8 seeds" in changes[7], changes[7])
    levels = read(os.path.join(folder, "tables", "levels.md")).splitlines()
    check(levels[4].startswith("| sssr, taps=4 | 0.00234 | 0.00234 |"), levels[4])  # as listed; `all` speaks for the shot
    check(levels[5].startswith("| sssr, default | 0.0123 [0.0111, 0.0135] |"), levels[5])
    parts = read(os.path.join(folder, "tables", "parts.md")).splitlines()
    check(parts[4] == "| default | 3.00 | 2.00 [1.50, 2.50] | 1.00 [0.90, 1.10] |", parts[4])
    latex = read(os.path.join(folder, "tables", "changes.tex"))
    check(r"\toprule" in latex and r"does\_to" in latex and r"1.000 {\scriptsize [0.928" in latex, latex)
    grid = list(csv.reader(open(os.path.join(folder, "tables", "changes.csv"))))
    check(grid[0] == ["", "mse", "mse low", "mse high", "flip", "flip low", "flip high"], grid[0])
    check(abs(float(grid[2][1]) - 1) < 1e-12 and abs(float(grid[2][2]) - math.exp(-half)) < 1e-9, grid[2])


def test_bold(folder):
    """A ratio that Holm's test tells from 1 is bold, in a table of single shots."""
    table = TABLES[0] | {"columns": ["metric", "shot"], "where": {"metric": "mse"}}
    table = {k: v for k, v in table.items() if k not in ("over", "sort")}
    write_results(folder, [table])
    check(tables(folder).returncode == 0, "single shots")
    line = read(os.path.join(folder, "tables", "changes.md")).splitlines()[4]
    check(line == "| taps = 4 | **0.500 [0.450, 0.556]** | **2.00 [1.80, 2.22]** |", line)


def test_refusals(folder):
    for changed, why in (
        ({"over": None}, "rows of effects.csv fall on one cell"),
        ({"where": {"metric": "psnr"}}, "effects.csv has no row where"),
        ({"of": "nothing"}, "must be one of effects, results"),
        ({"row": "point"}, "unknown key 'row'"),
    ):
        entry = {k: v for k, v in (TABLES[0] | changed).items() if v is not None}
        write_results(folder, [entry])
        result = tables(folder)
        check(result.returncode == 2 and why in result.stderr, f"{changed}: {result.returncode} {result.stderr}")
    write_results(folder, [])
    check(tables(folder).returncode == 2, "a study without tables")


def test_documents(temporary):
    """Kept summaries fill documents; a stale document and a stale summary are told."""
    folder, root = os.path.join(temporary, "results"), os.path.join(temporary, "tree")
    write_results(folder)
    document = os.path.join(root, "variants", "README.md")
    text = "Before\n<!-- table made_up changes -->\nold\n<!-- end of table -->\nafter, and <!-- table made_up parts -->\n<!-- end of table -->"
    write(document, text)
    os.makedirs(os.path.join(root, "experiments", "summaries"))
    result = tables(folder, "--keep", "--root", root)
    check(result.returncode == 0, result.stderr)
    filled = read(document)
    check(filled.startswith("Before\n<!-- table made_up changes -->\nWhat each change") and "old" not in filled, filled)
    check(read(os.path.join(folder, "tables", "changes.md")) in filled, "documents show what the folder has")
    check(filled.endswith("<!-- end of table -->") and "| bias_squared |" in filled, filled)
    check(tables("--check", "7", "--root", root).returncode == 0, "nothing is stale")

    stale = tables("--check", "8", "--root", root)
    check(stale.returncode == 2 and "made with estimators 7, but today's are 8" in stale.stderr, stale.stderr)
    write(document, filled.replace("0.250 [", "0.251 [", 1))
    stale = tables("--check", "7", "--root", root)
    check(stale.returncode == 2 and "README.md: its tables differ" in stale.stderr, stale.stderr)
    check(tables("--fill", "--root", root).returncode == 0 and read(document) == filled, "--fill")
    write(document, "nothing")
    unshown = tables("--check", "7", "--root", root)
    check(unshown.returncode == 2 and "no document shows" in unshown.stderr, unshown.stderr)
    write(document, "<!-- table other changes -->\n<!-- end of table -->")
    check("cannot read" in tables("--check", "7", "--root", root).stderr, "a study without a summary")


def test_kept_numbers(temporary):
    """What is kept reads back as it was, but for six digits; too much of it is refused, and so is what no commit holds."""
    folder, root = os.path.join(temporary, "results"), os.path.join(temporary, "tree")
    write_results(folder)
    origin, kept = summary_file.read(os.path.join(root, "experiments", "summaries", "made_up.csv"))
    check(origin["resolutions"] == ["320x180"] and origin["shots"] == 2 and origin["code"] == "00ff", origin)
    cell = next(c for c in kept["changes"][1] if c.row == "taps = 4" and c.column == "mse")
    check(abs(cell.value - 1) < 1e-6 and cell.least == 0.5 and cell.most == 2 and cell.seeds == 8, cell)
    many = [cell] * 3000
    try:
        summary_file.write(os.path.join(temporary, "large.csv"), origin, TABLES, many)
        check(False, "a large summary was written")
    except Exception as e:  # noqa: BLE001
        check("at most 100000" in str(e), e)
    made_up = manifest(TABLES)
    made_up["provenance"][0]["ssrlab"]["dirty"] = True
    write(os.path.join(folder, "manifest.json"), json.dumps(made_up))
    result = tables(folder, "--keep", "--root", root)
    check(result.returncode == 2 and "no commit holds" in result.stderr, result.stderr)
    made_up["provenance"].append(json.loads(json.dumps(made_up["provenance"][0])))
    made_up["provenance"][1]["ssrlab"]["estimators"] = 8
    write(os.path.join(folder, "manifest.json"), json.dumps(made_up))
    result = tables(folder)
    check(result.returncode == 2 and "made with estimators [7, 8]" in result.stderr, result.stderr)


def main():
    with tempfile.TemporaryDirectory() as temporary:
        folder = os.path.join(temporary, "single")
        write_results(folder)
        test_numbers(folder)
        test_bold(folder)
        test_refusals(folder)
        test_documents(temporary)
        test_kept_numbers(temporary)


main()
