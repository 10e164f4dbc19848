"""What users make of a study that they ran: tables, which may change afterwards, figures and a notebook.

usage: small_study_test.py SSRLAB_PROGRAM
"""

import json
import os
import subprocess
import sys
import tempfile

from figures_start import check
from ssrlab import read as read_results

SSRLAB = os.path.abspath(sys.argv[1])
EXPERIMENTS = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../experiments"))
STUDY = {
    "shots": [{"scene": "fence", "resolution": [48, 27]}],
    "techniques": [
        {"technique": "none"},
        {"technique": "mcguire_dda", "sweep": {"dda.thickness": {"log": [0.003, 3, 5]}, "dda.stride": [1, 4]}},
    ],
    "seeds": 1,
    "reference": {"samples": 16},
    "timing": {"frames": 15, "warm_up": 1, "copies": False},
    "gpu_compilers": ["navi21"],
}
TABLE = {"name": "errors", "caption": "Errors", "of": "results", "where": {"metric": ["mse", "flip"], "target": "specular", "mask": "reflective"}, "rows": "point", "columns": "metric", "over": "shot"}
FIGURES = [
    {"kind": "response", "parameter": "dda.thickness"},
    {"kind": "map", "x": "dda.thickness", "y": "dda.stride"},
    *({"kind": kind} for kind in ("error_time", "stage_times", "crops", "bias_variance")),
]


def ssrlab(*arguments):
    done = subprocess.run([SSRLAB, *arguments], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def write(name, content):
    with open(name, "w", encoding="utf-8") as stream:
        json.dump(content, stream)


def test_mistakes_in_tables_are_found_first():
    write("wrong.json", STUDY | {"tables": [TABLE | {"rows": "piont"}]})
    for command in ("plan", "run"):
        code, text = ssrlab(command, "wrong.json", "--out", "wrong")
        check(code == 2 and "did you mean 'point'?" in text, f"{command}: {text}")
    check(not os.path.exists("wrong"), "work was begun")


def cells():
    return {entry.name: entry.stat().st_mtime_ns for entry in os.scandir("out/cells")}


def test_changed_tables_redo_no_cell():
    for tables in ([], [TABLE], [TABLE, TABLE | {"name": "by_shot", "rows": "shot", "over": "point"}]):
        write("study.json", STUDY | {"tables": tables})
        before = cells() if tables else {}
        code, text = ssrlab("run", "study.json", "--out", "out")
        check(code == 0, text)
        check(not before or cells() == before, "a change of tables redid cells")
    code, text = ssrlab("tables", "out")
    check(code == 0 and sorted(os.listdir("out/tables")) == [f"{n}.{k}" for n in ("by_shot", "errors") for k in ("csv", "md", "tex")], text)
    with open("out/tables/errors.tex", encoding="utf-8") as stream:
        check(r"point & MSE & FLIP \\" in stream.read(), "a head of LaTeX is a column's raw name")


def test_figures_warn_of_nothing():
    write("figures.json", {"formats": ["svg"], "figures": FIGURES})
    program = [sys.executable, "-B", "-W", "error", "-m", "ssrlab.figures"]
    done = subprocess.run([*program, "out", "--choice", "figures.json"], capture_output=True, text=True, check=False)
    check(done.returncode == 0 and not done.stderr, done.stderr)


def test_pandas_reads_what_compilers_say():
    results = read_results("out")
    table = results["compiled"]
    check(len(table) == 20, f"two passes of ten points: {len(table)}")
    numbers = table[table["refusal"].isna()]  # none on a machine without radv
    check((numbers["vgprs"] > 0).all() and (numbers["waves"] <= numbers["most_waves"]).all(), numbers.to_string())
    check(results.units("compiled")["inverse_throughput"] == "cycle", results.units("compiled"))


def test_the_notebook_runs():
    with open(os.path.join(EXPERIMENTS, "studies/examples", "read_results.ipynb"), encoding="utf-8") as stream:
        notebook = json.load(stream)
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    check(not any(cell["outputs"] or cell["execution_count"] for cell in code), "outputs are kept in the notebook")
    os.environ["SSRLAB_RESULTS"] = "out"
    names = {}
    for cell in code:
        exec(compile("".join(cell["source"]), cell["id"], "exec"), names)  # as Jupyter does, but for what it shows
    check(len(names["errors"]) == 11 and len(names["both"]) == 11, "points are missing")  # 10 and `none`
    check(len(names["axes"].get_lines()) == 2, "a technique is missing")


with tempfile.TemporaryDirectory(prefix="ssrlab_small_study_") as temporary:
    os.chdir(temporary)
    os.environ.setdefault("SSRLAB_CACHE", os.path.join(temporary, "cache"))
    test_mistakes_in_tables_are_found_first()
    test_changed_tables_redo_no_cell()
    test_figures_warn_of_nothing()
    test_pandas_reads_what_compilers_say()
    test_the_notebook_runs()
