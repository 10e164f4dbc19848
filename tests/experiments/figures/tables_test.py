"""Tables of a made-up study, from its results folder to the documents that show them. All checks read that one study,
and so stand in one file of over 400 lines.
"""

import contextlib
import csv
import io
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import ssrlab.tables.__main__ as tables_script
from ssrlab.figures import numbers
from ssrlab.results import commits_of
from ssrlab.tables import shot_names, summary_file
from ssrlab.tables.cell import Cell
from ssrlab.tables.documents import Numbers
from ssrlab.tables.halving import halving_share
from ssrlab.tables.latex import latex
from ssrlab.tables.markdown import markdown
from ssrlab.tables.variance_shares import KINDS, share_of_total, variance_parts
from ssrlab.mistakes import ResultsError, exit_code
from ssrlab.repository import SUMMARIES
from tables_study import ONE_SEED, RATIOS, SHOTS, TABLES, footer, manifest, read, write, write_results, write_rows


A = "\N{MODIFIER LETTER SMALL A}"


def check(is_true, what):
    if not is_true:
        sys.exit(f"tables_test: {what}")


def tables(*arguments):
    """As `ssrlab tables ARGUMENTS`, in this process: to start another for each of a hundred calls takes most of the test's time."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        sys.argv = ["tables", *arguments]
        try:
            code = exit_code(tables_script.main, "the tables")
        except SystemExit as ended:
            code = ended.code
    return subprocess.CompletedProcess(arguments, code, out.getvalue(), err.getvalue())


def test_the_script_itself(folder):
    started = subprocess.run([sys.executable, "-B", "-m", "ssrlab.tables", folder], capture_output=True, text=True)
    called = tables(folder)
    check((started.returncode, started.stdout, started.stderr) == (called.returncode, called.stdout, called.stderr), started.stderr)
    check(subprocess.run([sys.executable, "-B", "-m", "ssrlab.tables", folder + "/absent"], capture_output=True).returncode == 2, "of a folder that is not there")


def test_numbers(folder):
    result = tables(folder)
    check(result.returncode == 0 and result.stdout == f"3 tables in {folder}/tables\n", result.stdout + result.stderr)
    changes = read(os.path.join(folder, "tables", "changes.md")).splitlines()
    # exp(mean of logs) = 1; half-widths of the logarithms are ln(1 / 0.9) each, their root of squares over 2 is
    # 0.0745, so that the interval is [0.928, 1.077].
    half = math.sqrt(2) * math.log(1 / 0.9) / 2
    check(abs(math.exp(half) - 1.0773) < 1e-4, "the expectation itself")
    check(numbers.decimals(23.2, 23.2, math.nextafter(23.2, 0)) == 1, "ends of an interval that round past each other")
    check(changes[2] == f"| | mse | flip{A} |", changes[2])
    check(changes[4] == "| sixteen \\| taps | 0.250 [0.217, 0.289] |  |", changes[4])  # sorted by mse
    check(changes[5] == "| taps = 4 | 1.00 [0.93, 1.08] (0.50 to 2.00) | 0.810 |", changes[5])
    origin, _, explained = changes[7].partition(". ")
    check(origin == "`ssrlab run configs/made_up.json`: commit abc1234, 2 shots at 320x180, 8 seeds, a device", origin)
    check(explained == "In brackets 95 % intervals of the mean over scenes like these (Student's t, scenes of one asset averaged first); the interval is of these shots alone, not of other scenes: fewer than four assets; \N{MODIFIER LETTER SMALL A}: no interval; in parentheses the range over shots.", explained)
    levels = read(os.path.join(folder, "tables", "levels.md")).splitlines()
    check(levels[4].startswith(f"| sssr, taps=4 | 0.00234{A} | 0.00234{A} |"), levels[4])  # as listed; `all` represents the shot
    check(levels[5].startswith("| sssr, default | 0.0123 [0.0111, 0.0135] |"), levels[5])
    parts = read(os.path.join(folder, "tables", "parts.md")).splitlines()
    check(parts[4] == "| default | 3.00 | 2.00 [1.50, 2.50] | 1.00 [0.90, 1.10] |" and parts[2].startswith(f"| | mse{A} |"), parts[2:5])
    latex = read(os.path.join(folder, "tables", "changes.tex"))
    check(r"\toprule" in latex and r"\caption{What each change does\_to \{the\} error}" in latex, latex)
    check(r"taps = 4 & 1.000 {\scriptsize [0.928, 1.077]\P{} (0.500 to 2.000)} & 0.810 \\" in latex, latex)
    grid = list(csv.reader(open(os.path.join(folder, "tables", "changes.csv"))))
    check(grid[0] == ["taps", "mse", "mse low", "mse high", "flip", "flip low", "flip high"], grid[0])
    check([row[0] for row in grid[1:]] == ["sixteen | taps", "4"], "the head says the key of a value")
    check(abs(float(grid[2][1]) - 1) < 1e-12 and abs(float(grid[2][2]) - math.exp(-half)) < 1e-9, grid[2])


def test_reading():
    """Three digits, intervals where they decide something, short names of shots; what is long is folded, with all that is said of it."""
    fence, sponza, moving = "fence.main.320x180.w12", "sponza.nave.320x180.w12", "fence.main.1920x1080.f3-9.w12"
    about = {"caption": "`a` < b", "shots": [fence, sponza, moving], "over": None, "over_count": None, "clocks": []}

    def made(cells, **changed):
        return markdown(about | changed, [Cell("t", *c, interval="reference") for c in cells], f"commit {'0123456789' * 4}, {fence}.")

    numbers = ((18421, 17374, 19602), (67420, 67400, 67440), (0.99961, 0.9995, 0.9997), (0.983, 0.954, 1.012), (0, 0, 0), (0.0001, -0.0004, 0.0006), (12.3456, 12.3, 12.4))
    text = made([("x", str(i), *n) for i, n in enumerate(numbers[:5])])
    check("| x | 18400 [17400, 19600] | 67400 | 1.00 | 0.983 [0.954, 1.01] | 0 |" in text, text)
    check("where they reach further than 5 % or include 1; the others are within \N{PLUS-MINUS SIGN}0.030 %" in text, text)
    check("<details>" not in text and "commit 0123456789," in text, text)
    check("| x | 0.00010 [-0.00040, 0.00060] | 12.3 |" in made([("x", str(i), *n) for i, n in enumerate(numbers[5:])]), "an interval about 0")
    significant = Cell("t", "x", "y", 1.0016, 1.001, 1.0022, interval="reference", is_significant=True)
    check("| x | **1.002** |" in markdown(about, [significant], "."), "on which side of 1 a significant ratio is")
    for rows, columns in ((9, 1), (1, 6)):
        text = made([(f"r{i}", f"c{j}", 1.5, 1.49, 1.51) for i in range(rows) for j in range(columns)])
        head = f"<details>\n<summary><code>a</code> &lt; b; {rows} row{'s' * (rows > 1)}, {columns} column{'s' * (columns > 1)}</summary>\n\n| | c0 |"
        check(text.startswith(head) and text.endswith("within \N{PLUS-MINUS SIGN}0.67 %.\n\n</details>\n"), text)
    text = made([(f"mse, {shot}", "x", 1.5, 1.49, 1.51) for shot in (fence, sponza)])
    check("| mse, fence | 1.50 |" in text and "| mse, sponza | 1.50 |" in text and ", fence. Shots: camera main, after 12 frames; sponza: nave." in text, text)
    text = made([("x", shot, 1.5, 1.49, 1.51) for shot in (fence, moving)])
    check("| | fence 320x180 after 12 frames | fence 1920x1080 frames 3 to 9 after 12 frames |" in text, text)
    names = shot_names.short_names([fence, sponza, "a picture", "fence.side.320x180.w12.d16"])
    check(names == {fence: "fence main", sponza: "sponza", "fence.side.320x180.w12.d16": "fence side d16"}, names)


def test_names_in_prose(temporary):
    """What a sentence claims of a table is made from it: which point is first, its interval, the largest of a mean's shots."""
    folder, root = os.path.join(temporary, "prose"), os.path.join(temporary, "tree of prose")
    write_results(folder)
    document = os.path.join(root, "README.md")
    said = {
        'first("made_up", "levels", column="floor")': "sssr, taps=4",
        'first("made_up", "levels", column="floor", without=["sssr, taps=4"])': "sssr, default",
        'shown("made_up", "levels", "default", "floor")': "0.012 [0.011, 0.014]",
        'number(most("made_up", "changes", "taps = 4", "mse"))': "2.0",
        'len(shots("made_up", "levels"))': "2",
        'number(rank_correlation(("made_up", "levels", "floor"), ("made_up", "levels", "wall")))': "1.0",
    }
    write(document, "".join(f"<!-- table made_up {name} -->\n<!-- end of table -->\n" for name in ("levels", "changes")) + "".join(f"<!--=n{i}-->?<!--/-->\n" for i in range(len(said))))
    expressions = os.path.join(root, "README.numbers.json")
    write(expressions, json.dumps({f"n{i}": asked for i, asked in enumerate(said)}))
    result = tables(folder, "--keep", "--root", root)
    check(result.returncode == 0, result.stderr)
    for i, (asked, answer) in enumerate(said.items()):
        check(f"<!--=n{i}-->{answer}<!--/-->" in read(document), f"{asked}: {read(document)}")
    write(os.path.join(root, "more", "a.md"), "<!--=../README.md#n0-->?<!--/-->")
    check(tables("--fill", "--root", root).returncode == 0 and "-->sssr, taps=4<" in read(os.path.join(root, "more", "a.md")), "another page's number")
    write(os.path.join(root, "index.md"), "| <!--=made README.md-->?<!--/--> |")
    check(tables("--fill", "--root", root).returncode == 0 and "-->2026-01-31 | `abc1234`<" in read(os.path.join(root, "index.md")), read(os.path.join(root, "index.md")))
    write(os.path.join(root, "index.md"), "| <!--=made more/a.md-->?<!--/--> |")
    check("it has no tables" in tables("--fill", "--root", root).stderr, "a day of a page without tables")
    os.remove(os.path.join(root, "index.md"))
    kept = read(expressions)
    write(expressions, kept.replace("n1", "least"))
    check("no number 'n1'" in tables("--fill", "--root", root).stderr, "a number without an expression")
    write(expressions, kept.replace("{", '{"left": "1", ', 1))
    check("the page says 'left' nowhere" in tables("--fill", "--root", root).stderr, "an expression without a number")
    write(expressions, kept.replace('column=\\"floor\\")', 'column=\\"ceiling\\")', 1))
    check("is not one line of made_up levels" in tables("--fill", "--root", root).stderr, "a column that is not there")


def test_effects_in_prose(temporary):
    """Holm's p from kept intervals: Student's t of 2 degrees of freedom has the two-sided p 1 - t / sqrt(2 + t^2). Ratios over scenes
    without some assets, whose rows are shots."""
    file = os.path.join(temporary, "effects.csv")
    about = {"caption": "", "resolutions": [], "over": None, "over_count": None, "clocks": [], "shots": ["a", "b", "c", "d"]}
    effects = about | {"name": "changes"}
    errors = about | {"name": "errors", "assets": {s: s.upper() for s in about["shots"]}}
    halves = {"sure": 0.5, "doubtful": 1.0, "no": 2.0}  # of ln 1 to e: t of 4.30265 times 2, 1 and 1/2
    cells = [Cell("changes", name, "error", math.e, math.exp(1 - half), math.exp(1 + half)) for name, half in halves.items()]
    cells += [Cell("errors", s, name, value) for s, values in zip("abcd", ((1, 2), (1, 2), (1, 8), (1, 2))) for name, value in zip("xy", values)]
    cells.append(Cell("changes", "alone", "error", math.e))
    summary_file.write(file, {"estimators": 1}, [effects, errors], cells)
    made = Numbers(temporary, "a document")
    t = {name: 4.302652729911275 / half for name, half in halves.items()}
    p = {name: 1 - v / math.sqrt(2 + v * v) for name, v in t.items()}
    adjusted = {"sure": 3 * p["sure"], "doubtful": 2 * p["doubtful"], "no": p["no"]}
    for name, right in adjusted.items():
        found = made.p_holm("effects", "changes", name, "error")
        check(abs(found / right - 1) < 1e-4, f"{name}: {found}, not {right}")  # six digits are kept
    for row, column in (("alone", "error"), ("sure", "ms")):
        try:
            check(False, made.p_holm("effects", "changes", row, column))
        except ResultsError as e:
            check("has no interval of" in str(e), e)
    check(abs(made.ratio_over_scenes("effects", "errors", "y", "x")[0] - 2 * math.sqrt(2)) < 1e-6, "of all four scenes")
    check(abs(made.ratio_over_scenes("effects", "errors", "y", "x", without=["C"])[0] - 2) < 1e-6, "without the third")
    try:
        check(False, made.ratio_over_scenes("effects", "errors", "y", "x", without=["c"]))
    except ResultsError as e:
        check("no shot of effects errors is of 'c'" in str(e), e)


def test_halving():
    """Errors that fall as 4^-k are half way, at the geometric mean, at a share of a half."""
    shares = (0, 0.1, 0.4, 0.7, 1)

    def curves(exponents, scenes=8):
        return [(f"scene {i}", {k: 10**i * 4 ** -exponents[i % len(exponents)](k) for k in shares}) for i in range(scenes)]

    share, low, high = halving_share(curves([lambda k: k]))
    check(abs(share - 0.5) < 1e-12 and abs(low - share) < 1e-12 and abs(high - share) < 1e-12, f"{share} [{low}, {high}]")
    share, low, high = halving_share(curves([lambda k: k, lambda k: k * k, lambda k: k * (2 - k)]))
    check(0.3 < low < share < high < 0.8 and low < 0.5 < high, f"{share} [{low}, {high}]")
    share, low, high = halving_share(curves([lambda k: k, lambda k: -0.9 * k]))
    check(low == 0 and high == 1, f"exact rays that do as much harm as good: {share} [{low}, {high}]")
    check(halving_share(curves([lambda k: k], scenes=3))[1:] == (None, None), "too few scenes for an interval over scenes")


def test_halving_covers():
    """Scenes are drawn again from the 13 of the kept study, 200 times for each of its twelve curves: how often the interval holds the share
    of all 13. Of 95 %, few scenes with a heavy tail leave 84 to 100 % for single curves, whose deviation by the count of draws is 2.5 %; the
    mean over the curves must be within two such deviations of 95 %, and no curve six of them below it."""
    kept = Numbers(str(SUMMARIES), "tables_test")
    values = {}
    for cell in kept._table("exact_rays", "errors")[1]:
        values.setdefault(cell.column, {})[cell.row] = cell.value
    draw, covered = random.Random(1), []
    for march in ("mcguire_dda, any_scale", "amd_sssr, best_1x", "frostbite_sssr, best_1x"):
        for selector in ("oracle", "variance", "random", "confidence"):
            of_share = f"{march} exact_rays={selector} exact_share="
            points = {0.0: march, 1.0: f"{march} tracer=exact_scene"} | {float(p.removeprefix(of_share)): p for p in values if p.startswith(of_share)}
            scenes = [{k: values[p][scene] for k, p in points.items()} for scene in values[march]]
            share = halving_share(list(enumerate_assets(scenes)))[0]
            intervals = [halving_share(list(enumerate_assets(draw.choices(scenes, k=len(scenes))))) for _ in range(200)]
            covered.append(sum(low <= share <= high for _, low, high in intervals) / len(intervals))
    check(len(covered) == 12 and min(covered) >= 0.8 and sum(covered) / 12 >= 0.9, covered)


def made_up_scene(draw, scale, noise):
    """Two seeds of 6 x 6 pairs whose first part has a variance of 1, the second of 4, both together of 0.25, times `scale` squared."""
    firsts, seconds, both = ([draw.gauss(0, deviation) for _ in range(n)] for n, deviation in ((6, 1), (6, 2), (36, 0.5)))
    return {(i, j): {seed: scale * (firsts[i] + seconds[j] + both[6 * i + j]) + draw.gauss(0, noise) for seed in "01"} for i in range(6) for j in range(6)}


def variance_shares(scenes):
    parts = [variance_parts(pairs) for pairs in scenes]
    totals = [(f"scene {i}", sum(of_scene.values())) for i, of_scene in enumerate(parts)]
    return {kind: share_of_total([(f"scene {i}", of_scene[kind]) for i, of_scene in enumerate(parts)], totals) for kind in KINDS}


def test_variance_shares():
    """Of parts with known effects the shares are those effects'; of heavy-tailed scenes, with noise as large as the smallest part, intervals
    hold the share of all scenes that are drawn from."""
    effects = {(i, j): 1.0 * (i - 1) + 2.0 * (j - 1) + (0.5 if (i, j) in ((0, 0), (2, 2)) else -0.5 if (i, j) in ((0, 2), (2, 0)) else 0) for i in range(3) for j in range(3)}
    seeds = {pair: {"0": effect, "1": effect} for pair, effect in effects.items()} | {(0, 1): {"1": effects[0, 1]}}  # one without noise
    shares = variance_shares([seeds] * 5)
    total = 2 / 3 + 8 / 3 + 1 / 9
    for kind, variance in zip(("first", "second", "both together"), (2 / 3, 8 / 3, 1 / 9)):
        share, low, high = shares[kind]
        check(abs(share - variance / total) < 1e-12 and abs(low - share) < 1e-12 and abs(high - share) < 1e-12, f"{kind}: {share} [{low}, {high}]")
    check(variance_shares([seeds] * 3)["first"][1:] == (None, None), "too few scenes for an interval")

    draw, covered, means = random.Random(2), {"first": 0, "second": 0, "both together": 0}, {"first": 0, "second": 0, "both together": 0}
    expected = {"first": 1 * 5 / 6, "second": 4 * 5 / 6, "both together": 0.25 * 25 / 36}  # of variances over six, and 6 x 6
    expected["first"] += 0.25 * 5 / 36
    expected["second"] += 0.25 * 5 / 36
    whole, draws = sum(expected.values()), 300
    for _ in range(draws):
        scenes = [made_up_scene(draw, math.exp(draw.gauss(0, 0.5)), 0.5) for _ in range(30)]
        for kind, (share, low, high) in variance_shares(scenes).items():
            covered[kind] += low <= expected[kind] / whole <= high
            means[kind] += share / draws
    for kind in covered:
        # 300 draws of 95 % scatter by 1.3 %: three of those below, one false alarm in 700. Where few scenes have most, it is more.
        check(covered[kind] / draws > 0.91, f"{kind}: intervals hold {covered[kind] / draws}")
        check(abs(means[kind] - expected[kind] / whole) < 0.02, f"{kind}: {means[kind]}, not {expected[kind] / whole}")


def enumerate_assets(curves):
    return ((f"scene {i}", curve) for i, curve in enumerate(curves))


def test_bold(folder):
    """A ratio with a verdict of effects.csv is bold, in a table of single shots; "!wall" leaves that one out."""
    table = TABLES[0] | {"columns": ["metric", "shot"], "where": {"metric": "mse"}}
    table = {k: v for k, v in table.items() if k not in ("over", "sort")}
    write_results(folder, [table])
    check(tables(folder).returncode == 0, "single shots")
    line = read(os.path.join(folder, "tables", "changes.md")).splitlines()[4]
    check(line == "| taps = 4 | **0.500 [0.450, 0.556]** | **2.00 [1.80, 2.22]** |", line)
    write_results(folder, [table | {"where": {"metric": "mse", "shot": "!wall"}}])
    check(tables(folder).returncode == 0, "a shot left out")
    text = read(os.path.join(folder, "tables", "changes.md"))
    check("**0.500 [0.450, 0.556]** |" in text and "wall" not in text and "2.00" not in text, text)


def test_best(folder):
    """Points are bold or italic as summary.csv says of their shot, whatever the order of their numbers."""
    levels = TABLES[1] | {"best": "column"}
    write_results(folder, [levels])
    check(tables(folder).returncode == 0, "a best")
    lines = read(os.path.join(folder, "tables", "levels.md")).splitlines()
    check(lines[4].startswith(f"| sssr, taps=4 | **0.00234{A}** | **0.00234{A}** |") and lines[5].startswith("| sssr, default | 0.0123 ["), lines[4:6])
    check("bold: significantly the best" in lines[7] and "italic" not in lines[7], lines[7])
    file = os.path.join(folder, "summary.csv")
    rows = list(csv.DictReader(open(file)))
    write_rows(file, [row | {"standing": "tied"} for row in rows])
    check(tables(folder).returncode == 0, "no best")
    grid = list(csv.reader(open(os.path.join(folder, "tables", "levels.csv"))))
    check(grid[0][:2] == ["technique", "point"] and [row[:2] for row in grid[1:]] == [["sssr", "taps=4"], ["sssr", "default"]], "a column for each key")
    check(grid[0][5] == "floor standing" and [row[5] for row in grid[1:]] == ["tied", "tied"], grid)
    check(r"\textit{0.00234}" in read(os.path.join(folder, "tables", "levels.tex")), "LaTeX")
    higher = [row | {"metric": "ssim", "standing": "best" if row["point"] == "default" else "behind"} for row in rows]
    write_rows(file, higher)
    write(os.path.join(folder, "manifest.json"), json.dumps(manifest([levels | {"where": {"metric": "ssim"}}])))
    check(tables(folder).returncode == 0, "more is better")
    lines = read(os.path.join(folder, "tables", "levels.md")).splitlines()
    check("**0.0123" in lines[5 if "default" in lines[5] else 4], lines[4:6])
    write_rows(file, [{k: v for k, v in row.items() if k != "standing"} for row in rows])
    failed = tables(folder)
    check(failed.returncode != 0 and "no column 'standing'" in failed.stderr and "ssrlab run" in failed.stderr, failed.stderr)


def test_latex_names_shots_as_markdown_does():
    """By their scene, without a break within a name; below both stands what that leaves out."""
    shot = "mine.Cam.192x108.w8"
    about = {"name": "t", "caption": "t", "rows": ["point"], "columns": ["shot"], "shots": [shot], "over": None, "over_count": None, "clocks": []}
    cells = [Cell("t", "default", shot, 0.5, 0.4, 0.6, interval="reference")]
    made = {"Markdown": markdown(about, cells, "made"), "LaTeX": latex(about, cells, "made")}
    check("| | mine |" in made["Markdown"] and r"point & mine \\" in made["LaTeX"], made)
    for language, text in made.items():
        check("Shots: camera Cam, after 8 frames." in text, f"{language}: {text}")
    once = "mine.Cam.192x108.w1"
    check("after 1 frame." in latex(about | {"shots": [once]}, [Cell("t", "default", once, 0.5)], "made"), "one is no plural")


def test_display_names(folder):
    """Points and shots that have a display name are called by it, and can be distinguished by the groups that they are in."""
    write_results(folder)
    by_group = {"name": "groups", "rows": ["group", "point"], "columns": "shot_group", "over": "shot"}
    named = manifest([TABLES[1], TABLES[1] | by_group])
    for shot in named["shots"]:
        shot["group"] = "rooms"
    named["techniques"][0]["group"] = "faithful"
    named["techniques"][1]["label"], named["shots"][0]["label"] = "four | taps", "The floor"
    write(os.path.join(folder, "manifest.json"), json.dumps(named))
    check(tables(folder).returncode == 0, "display names")
    lines = read(os.path.join(folder, "tables", "levels.md")).splitlines()
    check(lines[2] == "| | The floor | wall |" and lines[4].startswith(rf"| four \| taps | 0.00234{A} |"), lines[2:5])
    check(lines[5].startswith("| sssr, default |"), lines[5])
    lines = read(os.path.join(folder, "tables", "groups.md")).splitlines()
    check(lines[2] == "| | rooms |" and [line.split(" | ")[0] for line in lines[4:6]] == [r"| sssr, four \| taps", "| faithful, default"], lines)
    named["shots"][0]["group"] = "halls"
    write(os.path.join(folder, "manifest.json"), json.dumps(named))
    check(tables(folder).returncode == 0, "two groups")
    text = read(os.path.join(folder, "tables", "groups.md"))
    check(text.splitlines()[2] == "| | halls | rooms |" and " of 2" not in text, text)


def test_footers(folder):
    """A footer counts the shots of its table's own cells, and a mean says how many of them have a value."""
    missing = {("taps=4", "mse", "wall"): ("", "", "", "", "none: no value")}
    missing |= {("taps=16", "mse", shot): ("", "", "", "", "none: no value") for shot in SHOTS}
    write_results(folder, TABLES, RATIOS | missing)
    check(tables(folder).returncode == 0, "missing values")
    lines = read(os.path.join(folder, "tables", "changes.md")).splitlines()
    check(lines[4].startswith("| taps = 4 | 0.500 [0.450, 0.556] (1 of 2) | 0.810"), lines[4])
    check(lines[5] == "| sixteen \\| taps | \N{EN DASH} |  |", lines[5])
    check("2 shots at" in lines[7] and "\"n of 2\": so many of the shots have a value" in lines[7], lines[7])
    check(lines[7].endswith("\N{EN DASH}: no value."), lines[7])
    latex = read(os.path.join(folder, "tables", "changes.tex"))
    check(r"sixteen \textbar{} taps & -- & " in latex, latex)
    parts = footer(folder, "parts")
    check("abc1234, 1 of the study's 2 shots (floor) at 320x180, 8 seeds," in parts, parts)

    write_results(folder, [TABLES[0]], RATIOS | {("taps=4", "mse", "wall"): (-1.0, "", "", "", "none: an error is not above 0")})
    check(tables(folder).returncode == 0, "no geometric mean")
    lines = read(os.path.join(folder, "tables", "changes.md")).splitlines()
    check(lines[5].startswith(f"| taps = 4 | \N{EN DASH}{A} | 0.810") and f"{A}: no number: an error is not above 0" in lines[7], lines[5])

    incomplete = manifest(TABLES) | {"is_complete": False}
    incomplete["provenance"][0]["ssrlab"]["commit"] = ""
    write(os.path.join(folder, "manifest.json"), json.dumps(incomplete))
    check(tables(folder).returncode == 0, "an incomplete study")
    check(footer(folder, "parts").startswith("`ssrlab run configs/made_up.json` (not complete): commit unknown, 1 of"), footer(folder, "parts"))


def test_what_intervals_hold(folder):
    """Marks distinguish what intervals hold and why there is none, in Markdown, LaTeX and the document that shows them."""
    single = {k: v for k, v in TABLES[0].items() if k not in ("over", "sort")} | {"columns": ["metric", "shot"], "name": "single"}
    single["labels"] = {"flip": "FLIP of all frames"}
    one_seed = {("taps=4", "mse", "wall"): (2.0, "", "", "", ONE_SEED), ("taps=4", "flip", "wall"): (0.81, 0.80, 0.82, 0.2)}
    write_results(folder, [TABLES[0], single], RATIOS | one_seed)
    root = os.path.join(folder, "tree")
    block = "<!-- table made_up {} -->\n<!-- end of table -->\n"
    write(os.path.join(root, "README.md"), block.format("single") + block.format("changes") + "At most <!--=most-->?<!--/-->.\n")
    write(os.path.join(root, "README.numbers.json"), '{"most": "fixed(max(cells(\'made_up\', \'single\')), 2)"}')
    result = tables(folder, "--keep", "--root", root)
    check(result.returncode == 0, result.stderr)
    text = read(os.path.join(folder, "tables", "single.md"))
    marked = f"| taps = 4 | **0.500 [0.450, 0.556]** | 2.00{A} | 0.810 | 0.810 |"
    heads = f"| | mse, floor | mse, wall | FLIP of all frames, floor\N{DAGGER} | FLIP of all frames, wall\N{DAGGER} |"
    check(marked in text and heads in text, text)
    check("\N{DAGGER}: the interval holds the seeds alone" in text and f"{A}: no interval: 1 seed" in text, text)
    check("In brackets 95 % intervals where they reach further than 5 %; the others are within \N{PLUS-MINUS SIGN}1.3 %;" in text, text)
    mean = read(os.path.join(folder, "tables", "changes.md"))
    check(f"| 1.00{A} (0.50 to 2.00) | 0.810 |" in mean and "flip\N{DAGGER}" in mean, mean)
    check(text in read(os.path.join(root, "README.md")) and mean in read(os.path.join(root, "README.md")), "marks are lost where they are kept")
    document = os.path.join(root, "README.md")
    number = "-->2.00<!--/-->"
    check(number in read(document), "a number in prose is made with the tables")
    write(document, read(document).replace(number, "-->2.01<!--/-->"))
    check("tables or numbers differ" in tables("--check", "3", "--root", root).stderr, "a number that was edited is found")
    write(os.path.join(root, "README.numbers.json"), '{"most": "max(cells(\'made_up\', \'absent\'))"}')
    check("made_up has no table 'absent'" in tables("--fill", "--root", root).stderr, "a number of no table")
    latex = read(os.path.join(folder, "tables", "single.tex"))
    # Too wide for a page's text: values in one line, all else in the next.
    check(r"taps = 4 & \textbf{0.500} & 2.00 & 0.8100 & 0.8100 \\[-2.5pt]" in latex, latex)
    check(r"\begin{tabular}[b]{@{}r@{}}FLIP of all\\frames, floor\end{tabular}" in latex, latex)
    check(r"& {\scriptsize [0.450, 0.556]} & {\scriptsize (1 seed)} & {\scriptsize [0.8000, 0.8200]\dag{}} &" in latex, latex)
    check(r"{\scriptsize In brackets 95 \% intervals; \dag{}: the interval holds" in latex and "``1 seed''" in latex, latex)


def test_times(folder):
    """Times that other programs disturbed are marked, and so are ratios of them; the footer names the clock."""
    times = {"name": "times", "caption": "Times", "of": "times", "where": {"stage": "total"}, "rows": "point", "columns": "shot"}
    ratios = times | {"name": "ratios", "of": "time_effects"}
    write_results(folder, [times, ratios, ratios | {"name": "mean", "columns": "stage", "over": "shot"}])
    check(tables(folder).returncode == 0, "times")
    lines = read(os.path.join(folder, "tables", "times.md")).splitlines()
    check(lines[4] == "| default | 2.00 [1.90, 2.10] | 2.00 [1.90, 2.10]\N{SECTION SIGN} |", lines[4])
    check(lines[5] == "| taps=4 | 2.00 [1.90, 2.10] | 2.00 [1.90, 2.10] |", lines[5])
    check("a device, clock gpu_timestamp." in lines[7] and "disturbed some of its frames, 40 % at most" in lines[7], lines[7])
    lines = read(os.path.join(folder, "tables", "ratios.md")).splitlines()
    check(lines[4] == "| taps=4 | 1.00 [0.90, 1.10] | 1.00 [0.90, 1.10]\N{SECTION SIGN} |", lines[4])
    lines = read(os.path.join(folder, "tables", "mean.md")).splitlines()
    check(lines[4].endswith("]\N{SECTION SIGN} |") and "; the interval is of these shots alone" in lines[-1], lines)
    file = os.path.join(folder, "time_summary.csv")
    write(file, read(file).replace("gpu_timestamp", "host_fence", 1))
    check(tables(folder).returncode == 0, "two clocks")
    lines = read(os.path.join(folder, "tables", "times.md")).splitlines()
    check(lines[4].startswith("| default | 2.00 [1.90, 2.10] (host_fence) | 2.00 [1.90, 2.10]\N{SECTION SIGN} (gpu_timestamp) |"), lines[4])
    check("clock gpu_timestamp and host_fence." in lines[7], lines[7])
    write(file, read(file).replace("host_fence", "gpu_timestamp", 1))
    of_two = manifest([times])
    of_two["clock"]["load"] = [{"shot": shot, "host": {"name": f"node_{shot}"}} for shot in SHOTS]
    write(os.path.join(folder, "manifest.json"), json.dumps(of_two))
    check(tables(folder).returncode == 0, "times of two machines")
    lines = read(os.path.join(folder, "tables", "times.md")).splitlines()
    check(f"(gpu_timestamp of node_{SHOTS[0]}) | 2.00" in lines[4] and f"of node_{SHOTS[1]})" in lines[4], lines[4])
    check(all(f"gpu_timestamp of node_{shot}" in lines[7] for shot in SHOTS), lines[7])
    write(os.path.join(folder, "manifest.json"), json.dumps(manifest([times], verdict="failed")))
    check(tables(folder).returncode == 0, "a timer whose validation failed")
    lines = read(os.path.join(folder, "tables", "times.md")).splitlines()
    check("a device, clock gpu_timestamp (timer not validated)." in lines[7], lines[7])


def test_shares(folder):
    """Shares of rays may be 0; their mean over shots is the arithmetic one."""
    shares = {  # quantity: by shot (value, low, high)
        "correct": {"floor": (0.9, 0.88, 0.92), "wall": (0.6, 0.58, 0.62)},
        "false_hit": {"floor": (0, 0, 0), "wall": (0.5, 0.4, 0.6)},
        "empty": {"floor": (0, "", ""), "wall": (0, "", "")},
    }
    table = {"name": "rays", "caption": "Rays", "of": "hits", "where": {"quantity": list(shares), "mask": "all"}}
    table |= {"rows": ["point", "stage"], "columns": "quantity", "over": "shot"}
    write_results(folder, [table])
    rows = [
        {"shot": shot, "frame": "0", "technique": "sssr", "point": "default", "stage": "trace", "mask": mask, "quantity": quantity}
        | {"seeds": 4, "rays": 100, "value": value, "low": low, "high": high}
        for quantity, by_shot in shares.items()
        for shot, (value, low, high) in by_shot.items()
        for mask in ("all", "edge")
    ]
    write_rows(os.path.join(folder, "hits.csv"), rows)
    result = tables(folder)
    check(result.returncode == 0, result.stderr)
    lines = read(os.path.join(folder, "tables", "rays.md")).splitlines()
    check(lines[2] == f"| | correct | false_hit | empty{A} |", lines[2])
    grid = list(csv.reader(open(os.path.join(folder, "tables", "rays.csv"))))
    check(grid[1][:2] == ["default", "trace"], grid[1])
    numbers = [float(text) if text else None for text in grid[1][2:]]
    # Half-widths of 0.02 and 0.02, and of 0 and 0.1: the root of their squares' sum over 2.
    half = math.sqrt(2 * 0.02**2) / 2
    expected = [0.75, 0.75 - half, 0.75 + half, 0.25, 0.2, 0.3, 0, None, None]
    for number, value in zip(numbers, expected, strict=True):
        check((number is None) == (value is None) and (number is None or abs(number - value) < 1e-12), f"{numbers}, expected {expected}")
    check("(0.600 to 0.900)" in lines[4], lines[4])


def test_counts(temporary):
    """Counts are short where they are read and whole in CSV files, the kept one too; equal ones have no range."""
    for value, text in ((0, "0"), (999, "999"), (12.34, "12.3"), (79.99999, "80"), (999.7, "1.00 k"), (12345678, "12.3 M"), (999600, "1.00 M"), (5.5e12, "5500 G")):
        check(numbers.count(value).replace("\N{NO-BREAK SPACE}", " ") == text, f"{value} becomes {numbers.count(value)}")
    folder, root = os.path.join(temporary, "counts"), os.path.join(temporary, "tree of counts")
    single = {"name": "counts", "caption": "Counts", "of": "costs", "rows": "stage", "columns": ["quantity", "shot"]}
    mean = single | {"name": "mean", "columns": "quantity", "over": "shot"}
    write_results(folder, [single, mean])
    counts = {  # stage: by quantity the values in both shots
        "trace": {"operations": (12345678, 3000000), "atomics": (10007, 10007), "idle": (0, 40)},
        "total": {"operations": (123456789, 987), "atomics": (663001, 663004), "idle": (0, 0)},
    }
    place = {"technique": "sssr", "point": "default"}
    rows = [
        {"shot": shot} | place | {"stage": stage, "quantity": quantity, "value": values[i]}
        for i, shot in enumerate(SHOTS)
        for stage, quantities in counts.items()
        for quantity, values in quantities.items()
    ]
    write_rows(os.path.join(folder, "costs.csv"), rows)
    block = "<!-- table made_up {} -->\n<!-- end of table -->\n"
    write(os.path.join(root, "README.md"), block.format("counts") + block.format("mean"))
    result = tables(folder, "--keep", "--root", root)
    check(result.returncode == 0, result.stderr)
    text = read(os.path.join(root, "README.md")).replace("\N{NO-BREAK SPACE}", " ")
    check("| trace | 12.3 M | 10.0 k | 0 | 3.00 M | 10.0 k | 40 |" in text, text)
    check(f"| trace | 6.09 M (3.00 M to 12.3 M) | 10.0 k | \N{EN DASH}{A} |" in text, text)
    check("| total | 349 k (987 to 123 M) | 663 k | 0 |" in text, text)
    check(f"{A}: no number: a count is 0;" in text, text)
    check("counts of the last frame with one seed; those of other seeds differ by up to 2.5 %; k, M, G" in text and "no interval" not in text.split("mean -->")[0], text)
    made = [read(os.path.join(folder, "tables", name + ".md")) for name in ("counts", "mean")]
    check(all(table in read(os.path.join(root, "README.md")) for table in made), f"{made} became {text}")
    check(r"349~k {\scriptsize (987 to 123~M)}" in read(os.path.join(folder, "tables", "mean.tex")), "LaTeX")
    grid = list(csv.reader(open(os.path.join(folder, "tables", "counts.csv"))))
    check(grid[1][:4] == ["trace", "12345678", "", ""], grid[1])
    check("total,\"operations, floor\",123456789," in read(os.path.join(root, "experiments", "studies", "summaries", "made_up.csv")), "a kept count")
    write_rows(os.path.join(folder, "costs.csv"), [rows[0] | {"value": "1.5"}])
    check("is not a whole number" in tables(folder).stderr, "half an operation")


HEADS = ("navi21, vgprs", "navi21, waves", "vega10, vgprs")


def test_compiled(temporary):
    """Numbers of compiled.csv are rows by quantity; what a compiler did not state has no cell."""
    folder = os.path.join(temporary, "compiled")
    table = {"name": "chips", "caption": "Registers", "of": "compiled", "where": {"shot": SHOTS[0]},
             "rows": "stage", "columns": ["chip", "quantity"]}  # fmt: skip
    write_results(folder, [table])
    columns = ("shot", "technique", "point", "stage", "chip", "driver", "vgprs", "waves", "hash", "refusal")
    empty = dict.fromkeys(columns, "") | {"shot": SHOTS[0], "technique": "sssr", "point": "default", "driver": "radv Mesa 25.0.7"}
    rows = [
        empty | {"stage": "trace", "chip": "navi21", "vgprs": "48", "waves": "10", "hash": "12345678"},
        empty | {"stage": "trace", "chip": "vega10", "vgprs": "52", "waves": ""},
        empty | {"stage": "blur", "chip": "navi21", "vgprs": "16", "waves": "16"},
        empty | {"stage": "blur", "chip": "vega10", "vgprs": "0", "refusal": "no radv"},
    ]
    write_rows(os.path.join(folder, "compiled.csv"), rows)
    result = tables(folder)
    check(result.returncode == 0, result.stderr)
    grid = list(csv.reader(open(os.path.join(folder, "tables", "chips.csv"))))
    check({head.removesuffix(" low").removesuffix(" high") for head in grid[0][1:]} == set(HEADS), f"only numbers are quantities: {grid[0]}")
    values = {(row[0], head): value for row in grid[1:] for head, value in zip(grid[0], row, strict=True) if value and head in HEADS}
    said = read(os.path.join(folder, "tables", "chips.md"))
    check("Numbers of the compiler, shown with three digits" in said and "seed;" not in said, said)
    check("compiled by radv Mesa 25.0.7." in said, said)
    check(values == {("trace", HEADS[0]): "48", ("trace", HEADS[1]): "10", ("trace", HEADS[2]): "52", ("blur", HEADS[0]): "16", ("blur", HEADS[1]): "16"}, grid)


def test_estimates(temporary):
    """Numbers of estimates.csv are rows by quantity; the time has an interval and a geometric mean, its parts, which may be 0, neither.
    What is refused has no cell, and the table says that it is estimated."""
    folder = os.path.join(temporary, "estimates")
    single = {"name": "stages", "caption": "Stages", "of": "estimates", "where": {"shot": SHOTS[0]},
              "rows": ["stage", "bound"], "columns": ["chip", "quantity"]}  # fmt: skip
    mean = {"name": "mean", "caption": "Mean", "of": "estimates", "where": {"chip": "navi21", "stage": "total"}, "rows": "stage", "columns": "quantity", "over": "shot"}
    write_results(folder, [single, mean])
    columns = ("shot", "technique", "point", "stage", "chip", "product", "microseconds", "low", "high", "bound", "vector", "active_lanes", "refusal")
    empty = dict.fromkeys(columns, "") | {"shot": SHOTS[0], "technique": "sssr", "point": "default"}
    navi21 = {"chip": "navi21", "product": "Radeon RX 6800 XT"}
    total = empty | navi21 | {"stage": "total", "bound": "vector", "active_lanes": "0.5"}
    rows = [
        empty | navi21 | {"stage": "trace", "microseconds": "14.5", "low": "12", "high": "15", "bound": "vector", "vector": "14.5"},
        total | {"microseconds": "16", "low": "14", "high": "18", "vector": "0"},
        total | {"shot": SHOTS[1], "microseconds": "4", "low": "3", "high": "5", "vector": "3"},
        empty | {"stage": "total", "chip": "vega10", "refusal": "no radv"},
    ]
    write_rows(os.path.join(folder, "estimates.csv"), rows)
    result = tables(folder)
    check(result.returncode == 0, result.stderr)
    grid = list(csv.reader(open(os.path.join(folder, "tables", "stages.csv"))))
    by_head = [dict(zip(grid[0], row, strict=True)) for row in grid[1:]]
    check([(r["stage"], r["bound"]) for r in by_head] == [("trace", "vector"), ("total", "vector")], grid)
    check({head.removesuffix(" low").removesuffix(" high") for head in grid[0][2:]} == {f"navi21, {q}" for q in ("microseconds", "vector", "active_lanes")}, f"only numbers are quantities: {grid[0]}")
    time = [by_head[0]["navi21, microseconds" + end] for end in ("", " low", " high")]
    check([float(n) for n in time] == [14.5, 12, 15], grid)
    check((by_head[0]["navi21, vector"], by_head[0]["navi21, vector low"]) == ("14.5", ""), "the interval is the time's")
    check("estimated: no GPU ran anything" in read(os.path.join(folder, "tables", "stages.md")), "it looks like a measured table")
    over = list(csv.reader(open(os.path.join(folder, "tables", "mean.csv"))))
    means = dict(zip(over[0], over[1], strict=True))
    check(abs(float(means["microseconds"]) - 8) < 1e-12, f"geometric mean of 16 and 4: {means}")
    check((float(means["vector"]), float(means["active_lanes"])) == (1.5, 0.5), f"arithmetic means: {means}")


def test_means_over_what_differs(folder):
    """Two metrics of a shot are not two shots."""
    for changed, parts in (
        ({"columns": "target"}, ("over a mean", "taps = 4", "shot = floor", "metric (mse, flip)")),
        ({"over": "nothing"}, ("'over' = \"nothing\" is neither a column of effects.csv nor a parameter",)),
    ):
        write_results(folder, [TABLES[0] | {"name": "over a mean"} | changed])
        result = tables(folder)
        check(result.returncode == 2 and all(p in result.stderr for p in parts), f"{changed}: {result.returncode} {result.stderr}")
    write_results(folder, [TABLES[0] | {"rows": "shot", "over": "taps"}])
    result = tables(folder)
    check(result.returncode == 0, result.stderr)  # over a parameter
    line = read(os.path.join(folder, "tables", "changes.md")).splitlines()[4]
    check(line == "| floor | 0.354 [0.315, 0.396] (0.250 to 0.500) | 0.810 (1 of 2) |", line)


def test_tables_that_nobody_asks_for(temporary):
    """They leave the results' own folder; a folder that was named keeps what lies in it."""
    folder, named = os.path.join(temporary, "changed"), os.path.join(temporary, "named")
    write_results(folder)
    for out in (os.path.join(folder, "tables"), named):
        for file in ("old.md", "old.tex", "old.csv", "notes.txt"):
            write(os.path.join(out, file), "")
    check(tables(folder).returncode == 0 and tables(folder, "--out", named).returncode == 0, "tables are not made")
    left = os.listdir(os.path.join(folder, "tables"))
    check("notes.txt" in left and "changes.md" in left and not any(f.startswith("old") for f in left), f"left: {left}")
    check("old.md" in os.listdir(named), "a folder that was named lost a file")


def test_folders_of_strangers(temporary):
    """Neither names in a manifest nor links lead out of the folder."""
    outside, folder = os.path.join(temporary, "outside"), os.path.join(temporary, "outside", "strange")
    for file in ("victim.md", "victim.tex", "victim.csv"):
        write(os.path.join(outside, file), "mine")

    def refused(says, *arguments):
        result = tables(folder, *arguments)
        check(result.returncode == 2 and says in result.stderr and result.stderr.count("\n") == 1, f"{says}: {result.returncode} {result.stderr}")
        check(all(read(os.path.join(outside, f"victim.{kind}")) == "mine" for kind in ("md", "tex", "csv")), f"{says}: a file outside was overwritten")

    for name in ("../../victim", os.path.join(outside, "victim")):
        write_results(folder, [TABLES[1] | {"name": name}])
        refused("manifest.json: config: tables: 'name': ")
    write_results(folder)
    made_up = manifest(TABLES)
    made_up["study"]["name"] = "../../../victim"
    write(os.path.join(folder, "manifest.json"), json.dumps(made_up))
    refused("manifest.json: study: 'name': ", "--keep", "--root", os.path.join(outside, "tree"))
    write_results(folder)
    os.symlink(outside, os.path.join(folder, "tables"))
    refused("tables is a symbolic link")
    os.remove(os.path.join(folder, "tables"))
    write(os.path.join(folder, "tables", "notes.txt"), "")
    for table in TABLES:
        os.symlink(os.path.join(outside, "victim.md"), os.path.join(folder, "tables", table["name"] + ".md"))
    check(tables(folder).returncode == 0 and read(os.path.join(outside, "victim.md")) == "mine", "written through a link")
    os.rename(os.path.join(folder, "effects.csv"), os.path.join(outside, "effects.csv"))
    os.symlink(os.path.join(outside, "effects.csv"), os.path.join(folder, "effects.csv"))
    refused("effects.csv is a symbolic link")


def test_refusals(folder):
    for changed, why in (
        ({"over": None}, "rows of effects.csv fall on one cell"),
        ({"where": {"metric": "psnr"}}, "effects.csv has no row where"),
    ):
        entry = {k: v for k, v in (TABLES[0] | changed).items() if v is not None}
        write_results(folder, [entry])
        result = tables(folder)
        check(result.returncode == 2 and why in result.stderr, f"{changed}: {result.returncode} {result.stderr}")
    write_results(folder, [])
    check(tables(folder).returncode == 2, "a study without tables")


def test_documents(temporary):
    """Kept summaries fill documents; a stale document and a stale summary are reported."""
    folder, root = os.path.join(temporary, "results"), os.path.join(temporary, "tree")
    write_results(folder)
    document = os.path.join(root, "variants", "README.md")
    text = "Before\n<!-- table made_up changes -->\nold\n<!-- end of table -->\nafter, and <!-- table made_up parts -->\n<!-- end of table -->"
    write(document, text)
    os.makedirs(os.path.join(root, "experiments", "studies", "summaries"))
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
    check(stale.returncode == 2 and "README.md: its tables or numbers differ" in stale.stderr, stale.stderr)
    check(tables("--fill", "--root", root).returncode == 0 and read(document) == filled, "--fill")
    write(document, "nothing")
    unshown = tables("--check", "7", "--root", root)
    check(unshown.returncode == 2 and "no document shows" in unshown.stderr, unshown.stderr)
    write(document, "<!-- table other changes -->\n<!-- end of table -->")
    check("cannot read" in tables("--check", "7", "--root", root).stderr, "a study without a summary")


ADVICE_COLUMNS = "chip,ms,place,movement,surface,technique,point,label,preset,rank,ratio,low,high,chance_first,chance_near,standing,scenes,of_scenes,us,us_low,us_high,places,reason"


def test_advice(temporary):
    """The kept table of `ssrlab advise` in documents: as a table, and as numbers in prose."""
    root = os.path.join(temporary, "advice_tree")
    studies = os.path.join(root, "experiments", "studies")
    kind = "chip,1,rooms,at rest,all"
    rows = [f"{kind},good,a,good a,,1,0.4,0.3,0.5,0.98,1,best,8,8,810,790,830,4,", f"{kind},bad,b,bad b,,2,0.9,0.8,1,0.02,0.1,behind,8,8,500,,,4,", f"{kind},dear,c,dear c,,,,,,,,,0,0,9000,,,4,above the budget"]
    study = {"title": "t", "config": "c.json", "commit": "a" * 40, "finished": "2026-01-02T03:04:05Z", "sizes": ["320x180"]}
    sources = {"errors": [study], "costs": [study | {"commit": "b" * 40, "compilers": {"chip": "Mesa"}}], "points": {}, "rows": 3}
    os.makedirs(os.path.join(studies, "summaries"))
    write(os.path.join(studies, "advice.csv"), "\n".join([ADVICE_COLUMNS, *rows, ""]))
    write(os.path.join(studies, "advice.json"), json.dumps(sources))
    document = os.path.join(root, "page.md")
    write(document, "<!-- advice chip all -->\n<!-- end of table -->\n<!--=made page.md--><!--/--> <!--=r--><!--/-->")
    write(os.path.join(root, "page.numbers.json"), json.dumps({"r": "advised('ratio', 'chip', 1, 'rooms, at rest', rank=2)"}))
    check(tables("--fill", "--root", root).returncode == 0, "--fill")
    filled = read(document)
    check("| chip | 1 ms | rooms, at rest | **good a** | 0.40 [0.30, 0.50] | 0.98 | 0.81 [0.79, 0.83] | bad b: 0.90 [0.80, 1.00], certainly worse |" in filled, filled)
    check(f"<!--=made page.md-->2026-01-02 | `{'a' * 10}`, `{'b' * 10}`<!--/--> <!--=r-->0.90 [0.80, 1.00]<!--/-->" in filled, filled)
    check(tables("--check", "7", "--root", root).returncode == 0, "nothing is stale")
    write(os.path.join(studies, "advice.csv"), "\n".join([ADVICE_COLUMNS, *rows[:2], ""]))
    cut = tables("--check", "7", "--root", root)
    check(cut.returncode == 2 and "has 2 rows, not 3" in cut.stderr, cut.stderr)


def test_kept_numbers(temporary):
    """What is kept reads back as it was, but for six digits; too much of it is refused, and so is what no commit holds."""
    folder, root = os.path.join(temporary, "results"), os.path.join(temporary, "tree")
    write_results(folder)
    origin, kept = summary_file.read(os.path.join(root, "experiments", "studies", "summaries", "made_up.csv"))
    check(origin["shots"] == 2 and origin["code"] == "00ff", origin)
    check(kept["parts"][0]["resolutions"] == ["320x180"] and kept["parts"][0]["shots"] == ["floor"], kept["parts"][0])
    cell = next(c for c in kept["changes"][1] if c.row == "taps = 4" and c.column == "mse")
    check(abs(cell.value - 1) < 1e-6 and cell.least == 0.5 and cell.most == 2 and cell.seeds == 8, cell)
    many = [cell] * 4000
    try:
        summary_file.write(os.path.join(temporary, "large.csv"), origin, [kept["changes"][0]], many)
        check(False, "a large summary was written")
    except Exception as e:  # noqa: BLE001
        check("at most 180000" in str(e), e)
    for whole, program, why in (
        ({"is_complete": False}, {}, "the study is not complete"),
        ({}, {"commit": ""}, "no commit is known"),
        ({}, {"dirty": True}, "no commit holds"),
    ):
        made_up = manifest(TABLES) | whole
        made_up["provenance"][0]["ssrlab"] |= program
        write(os.path.join(folder, "manifest.json"), json.dumps(made_up))
        result = tables(folder, "--keep", "--root", root)
        check(result.returncode == 2 and why in result.stderr, f"{why}: {result.stderr}")
    # The same code, built beside files of no commit, and from a commit, which wrote the tables.
    made_up["written"] = {"ssrlab": {"commit": "def5678", "dirty": False, "code": "00ff", "estimators": 7}}
    check(summary_file.why_not_kept(made_up) is None and commits_of(made_up) == "def5678", made_up)
    made_up["written"]["ssrlab"]["code"] = "0100"
    check("no commit holds" in summary_file.why_not_kept(made_up), made_up)
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
        test_the_script_itself(folder)
        test_reading()
        test_latex_names_shots_as_markdown_does()
        test_names_in_prose(temporary)
        test_effects_in_prose(temporary)
        test_halving()
        test_halving_covers()
        test_variance_shares()
        test_bold(folder)
        test_best(folder)
        test_display_names(folder)
        test_footers(folder)
        test_what_intervals_hold(folder)
        test_times(folder)
        test_shares(folder)
        test_counts(temporary)
        test_compiled(temporary)
        test_estimates(temporary)
        test_means_over_what_differs(folder)
        test_refusals(folder)
        test_tables_that_nobody_asks_for(temporary)
        test_folders_of_strangers(temporary)
        test_documents(temporary)
        test_kept_numbers(temporary)
        test_advice(temporary)


main()
