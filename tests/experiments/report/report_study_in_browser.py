"""Opens the report of a made-up study of changes in headless Chromium, and compares what it shows with the CSV files.
Over 400 lines, as all sections are checked on one page that is opened once.

usage: report_study_in_browser.py REPORT_PAGE_PROGRAM
"""

import json
import os
import re
import subprocess
import sys
import tempfile

from report_browser import By, check, choose_in, equal, open_browser, rows_of, table_of, until_ready, values
from report_effects import test_effects
from report_rays import test_error_shares, test_rays
from report_stability import test_stability
from report_viewer import test_frames_of_a_sequence, test_images_of_a_rung

LADDER = "truth ladder"
STEP, MOVING = "step.main.160x90.f29-44.w8", "moving.main.160x90.f3-6.w4"


def is_single_change(row):
    return "=" in row["point"]


def in_matrix(rows):
    """The rows of each point, over all shots."""
    points = list(dict.fromkeys((r["technique"], r["point"]) for r in rows))
    return [[r for r in rows if (r["technique"], r["point"]) == point] for point in points]


def test_results(page, folder):
    choose_in(page, "results", "Metric", "relmse (relmse_a)")  # the only one with frames and a ladder
    rows = rows_of(folder, "summary.csv", target="specular", metric="relmse", mask="reflective")
    representative = [r for r in rows if r["frame"] in ("0", "")]
    page.execute_script("document.querySelector('#summary details').open = true")  # else its cells have no innerText
    shown = [c for c in table_of(page, "#summary") if c[1][0] != LADDER]
    compared = [r for r in representative if not is_single_change(r)]
    equal([float(c[3][1]) for c in shown], [float(r["value"]) for r in compared], "the table of results")
    absolute = [
        r
        for r in rows_of(folder, "summary.csv", target="specular", metric="mse", mask="reflective")
        if not is_single_change(r)
    ]
    equal([float(c[4][1]) for c in shown], [float(r["value"]) for r in absolute], "the absolute errors beside them")
    intervals = page.execute_script(
        "return [...document.querySelectorAll('#summary tbody tr')]"
        f".filter(r => r.cells[1].textContent !== '{LADDER}').map(r => r.cells[4].textContent.includes('['))"
    )
    equal(intervals, [r["low"] != "" for r in absolute], "which absolute errors have intervals")
    lucky = [c for c in shown if c[2][1] == "lucky"]
    equal(len(lucky), 7, "a point of one seed in each shot")
    for cells in lucky:
        for cell in cells[3:5]:
            check("1 seed: no interval" in cell[0] and "[" not in cell[0], f"why it has no interval: {cell[0]}")
    bold = page.execute_script("return ['#summary td b', '#matrix .best'].map(s => document.querySelectorAll(s).length)")
    equal(bold, [14, 14], "the best of each shot by both errors")
    bold = page.execute_script(
        "return [...document.querySelectorAll('#summary td b')].map(b => b.closest('tr').cells[2].dataset.value)"
    )
    equal(set(bold), {"fixed"}, "a single seed is never the best, however small its error")
    hollow = page.execute_script(
        """return [...document.querySelectorAll('#roughness .point')].map(p =>
        [p.getAttribute('aria-label').includes('1 seed'), p.getAttribute('fill') === 'var(--card)'])"""
    )
    check(any(h[0] for h in hollow) and all(h[0] == h[1] for h in hollow), "marks of single seeds are hollow")
    cells = [float(r["value"]) for own in zip(*(in_matrix(rows) for rows in (compared, absolute))) for r in own[0] + own[1]]
    equal(values(page, "#matrix button:not(.time)"), cells, "the matrix, a row per point")
    times = [float(r["median_ms"]) for r in rows_of(folder, "time_summary.csv", stage="total") if not is_single_change(r)]
    equal(sorted(values(page, "#matrix button.time")), sorted(times), "the matrix's times")
    ones = page.execute_script("return [...document.querySelectorAll('#matrix tbody tr')].map(r => [...r.querySelectorAll('button:not(.time)')].every(b => b.textContent === '1'))")
    equal(ones, [False, False, True, False], "cells are relative to the fixed point, not to the lucky one of a single seed")
    page.find_element(By.ID, "hasSingleChanges").click()
    equal(
        [float(c[3][1]) for c in table_of(page, "#summary") if c[1][0] != LADDER],
        [float(r["value"]) for r in representative],
        "with single changes",
    )
    page.find_element(By.ID, "hasSingleChanges").click()


def test_first_sentence(page, folder):
    first = next(r for r in rows_of(folder, "over_scenes.csv", target="specular", metric="relmse", mask="reflective") if r["rank"] == "1")
    said = page.find_element(By.ID, "answers").text
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as stream:
        labels = {(v["technique"], v["point"]): v.get("label") for v in json.load(stream)["techniques"]}
    name = re.escape(labels[first["technique"], first["point"]] or f"{first['technique']} {first['point']}")
    wanted = rf"In these \d+ shots these points have the least relmse: .*\nIn scenes like these {name} (certainly has|measures) the least error on average: .*geometric mean over {first['scenes']} scenes"
    check(re.match(wanted, said), f"what is said first is of these scenes and of others: {said[:400]}, in place of {wanted}")


def test_truth_ladder(page, folder):
    """What bounds the techniques stands below them, is never the best, and says which frames it is of."""
    rungs = [c for c in table_of(page, "#summary") if c[1][0] == LADDER]
    equal([c[0][0].split(".")[0] for c in rungs], ["still_a", "moving"], "shots with a ladder")
    equal([c[2][1] for c in rungs], ["on_screen", "on_screen, last frame"], "rungs")
    for cells in rungs:
        equal(float(cells[3][1]), 0.0123, "the limit")
        none = next(
            r
            for r in rows_of(folder, "summary.csv", technique="none", metric="relmse", mask="reflective")
            if r["shot"] == cells[0][0] and r["frame"] == ("6" if cells[0][0] == MOVING else "0")
        )
        ratio = 0.0123 / float(none["value"])
        check(abs(float(cells[6][1]) - ratio) < 1e-12 * ratio, f"over none of the same frame: {cells[6]}, not {ratio}")
        check("[0.0113, 0.0133]" in cells[3][0], f"its interval: {cells[3][0]}")
        equal(cells[8][0], "–", "seeds of the truth")
    shots = [c[0][0] for c in table_of(page, "#summary")]
    equal(len([i for i, s in enumerate(shots) if i == 0 or s != shots[i - 1]]), len(set(shots)), "shots stay together")
    bold = page.execute_script(
        "return [...document.querySelectorAll('#summary b')].map(b => b.closest('tr').cells[1].textContent)"
    )
    check(bold and LADDER not in bold, f"best values are those of techniques: {bold}")
    limits = [e.text for e in page.find_elements(By.CSS_SELECTOR, "#scatter text") if "limit of one frame" in e.text]
    equal([float(text.split()[-1]) for text in limits], [0.0123] * 2, "lines of the limit")
    choose_in(page, "results", "Target", "incident")
    check(all(c[1][0] != LADDER for c in table_of(page, "#summary")), "no limit where none was measured")
    choose_in(page, "results", "Target", "specular")


def test_roughness(page, folder):
    expected = []
    for target, metric in (("specular", "relmse"), ("incident", "bias")):
        rows = [
            r for r in rows_of(folder, "summary.csv", target=target, metric=metric) if r["mask"].startswith("roughness")
        ]
        last = {STEP: "44", MOVING: "6"}
        representative = "" if metric == "relmse" else None
        expected += [
            float(r["value"])
            for r in rows
            if not is_single_change(r)
            and r["frame"] == (last.get(r["shot"], "0") if representative is None or r["shot"] not in last else representative)
        ]
    equal(sorted(values(page, "#roughness .point")), sorted(expected), "errors and biases by roughness")
    titles = page.execute_script("return [...document.querySelectorAll('#roughness h3')].map(t => t.innerText)")
    equal(len(titles), 2, f"charts of error and of bias: {titles}")
    captions = page.execute_script(
        "return [...document.querySelectorAll('#roughness figcaption')].map(c => c.innerText)"
    )
    for shot, last in ((MOVING, "6"), (STEP, "44")):
        scene = shot.split(".")[0]
        equal(
            [c for c in captions if c.startswith(scene)],
            [f"{scene}: relmse: mean over frames", f"{scene}: bias: frame {last} alone"],
            "which frames the charts of errors and of biases show",
        )
    check(all("frame" not in c for c in captions if "still" in c), f"frames of shots of one frame: {captions}")


def test_splits(page, folder):
    rows = [r for r in rows_of(folder, "splits.csv", target="specular", mask="reflective") if not is_single_change(r)]
    shown = table_of(page, "#split-table")[:-1]  # the last row has the scale
    equal(len(shown), len(rows), "rows of bias and variance")
    for cells, row in zip(shown, rows):
        equal(
            [float(cells[i][1]) for i in (3, 4, 5, 6)],
            [float(row[k]) for k in ("mse", "bias_squared", "variance", "seeds")],
            row["point"],
        )
        check(
            (float(row["bias_squared"]) <= 0) == ("about 0" in cells[4][0]), f"bias² of {row['point']}: {cells[4][0]}"
        )
        for cell, name in ((cells[4], "bias_squared"), (cells[5], "variance")):
            low, high = (float(x) for x in cell[0].split("[")[1].split("]")[0].split(","))
            ends = [float(row[f"{name}_{end}"]) for end in ("low", "high")]
            check(
                all(abs(a - b) <= 5.1e-3 * abs(b) for a, b in zip((low, high), ends)),
                f"interval of {name}: {cell[0]}, expected {ends}",
            )
    equal(
        sorted(values(page, "#split-table .point")),
        sorted(float(r[k]) for r in rows for k in ("bias_squared", "variance")),
        "marks of bias and variance",
    )


def test_held_heads(page):
    """What a table's rows and columns are of stays where the rest scrolls; each table in a box of its own."""
    places = page.execute_script(
        """const results = [];
        for (const box of document.querySelectorAll('#summary .scroll, #splits .scroll, #effects .scroll, #references .scroll')) {
            const place = element => { const a = box.getBoundingClientRect(), b = element.getBoundingClientRect(); return [Math.round(b.left - a.left), Math.round(b.top - a.top)]; };
            Object.assign(box.style, {width: '200px', height: '90px'});
            const head = box.querySelector('thead th'), last = head.parentElement.lastElementChild, first = box.querySelector('tbody :is(td, th)');
            [box.scrollLeft, box.scrollTop] = [70, 30];
            results.push([box.scrollLeft, box.scrollTop, ...place(head), place(last)[1], place(first)[0], getComputedStyle(box).maxHeight !== "none"]);
            Object.assign(box.style, {width: '', height: ''});
            [box.scrollLeft, box.scrollTop] = [0, 0];
        }
        return results"""
    )
    equal(places, [[70, 30, 0, 0, 0, 0, True]] * 4, "heads and first columns of tables that are scrolled")


def test_stages(page):
    part = "#stages details[data-shot^=still_a]"
    fills = page.execute_script("return [...document.querySelectorAll(arguments[0] + ' .bar')].map(b => b.getAttribute('fill'))", part)
    equal([len(set(fills[:10])), fills[:10] == fills[10:]], [10, True], f"ten stages look ten ways, in all bars the same: {fills}")
    keys = page.execute_script("return [...document.querySelectorAll(arguments[0] + ' .stage rect')].map(r => r.getAttribute('fill'))", part)
    equal(keys, fills[:10], "the legend's colours")
    looks = page.execute_script(  # 50 names, more than there are looks; the third technique has the first and the 33rd
        """const of = (technique, names) => names.map((name, i) => ({technique, stage: technique + '/' + name, value: (technique === 'a' ? 200 : 100) - i}));
        const numbers = (letter, count) => Array.from({length: count}, (_, i) => letter + i);
        const looks = stageLooks([...of('a', numbers('a', 30)), ...of('b', numbers('b', 20)), ...of('c', ['a0', 'b2'])]);
        return [numbers('a', 30), numbers('b', 20), ['a0', 'b2']].map(names => names.map(name => stageFill(looks.get(name))))"""
    )
    for names in looks:
        equal(len(set(names)), len(names), "stages of one technique that look alike")
    check(all(look.startswith("url(#plain") for look in looks[0][:8]), f"the longest stages are plain: {looks[0]}")
    text = page.find_element(By.CSS_SELECTOR, part).text
    for words in ("1.12 % (sssr · first, 6.2 ms)", "A/A floor of this shot: 2 %"):
        check(words in text, f"the A/A floor: {text!r}")
    equal(
        page.find_element(By.CSS_SELECTOR, part + " .forms").text.split("\n")[1:],
        ['sssr · first: form = "fast"', 'sssr · fixed: form = "fast"'],
        "what was timed",
    )
    check(
        not page.execute_script("return document.querySelector(arguments[0] + ' details:last-of-type').open", part), "22 rows are folded"
    )
    choose_in(page, "stages", "Bars show", "shares of each point's total")
    widths = page.execute_script("return [...document.querySelectorAll(arguments[0] + ' .bar')].map(b => +b.getAttribute('width'))", part)
    check(abs(sum(widths[:10]) - sum(widths[10:])) < 1, "bars of shares are equally long, whatever the times")
    said = "return [...document.querySelectorAll(\"nav a[href='#stages'], #stages > h2, #stage-shots > .note\")].map(e => e.textContent.slice(0, 29))"
    equal(page.execute_script(said), ["Stage times and counted costs"] * 2 + ["Median times over the measured"[:29]], "what the section shows")
    choose_in(page, "stages", "Bars show", "bytes")
    equal(page.execute_script(said)[2], "Counted by the shaders as they ran"[:29], "what the switch shows")
    bars = page.execute_script("return [...document.querySelectorAll(arguments[0] + ' .bar')].map(b => [b.getAttribute('fill'), b.getAttribute('width') / 1, +b.dataset.value])", part)
    equal([bar[::2] for bar in bars[:2]], [[fills[0], 5], [fills[1], 10]], "stages by MB read and written, which look as by their times")
    check(abs(bars[1][1] / bars[0][1] - 2) < 0.01, f"bars of costs are as long as they say: {bars}")
    choose_in(page, "results", "Charts against", "bytes")
    labels = [chart.text for chart in page.find_elements(By.CSS_SELECTOR, "#scatter figure, #answer-charts figure")]
    check(labels and all("MB read and written" in label for label in labels), f"charts against bytes: {labels}")
    chosen = "return document.querySelector('#answer-budget select').value"
    equal(page.execute_script(chosen), "bytes", "the first screen's box shows the choice that was made below")
    choose_in(page, "answers", "Charts against", "estimated time on Card <A>")
    labels = [chart.text for chart in page.find_elements(By.CSS_SELECTOR, "#answer-charts figure")]
    check(labels and all("estimated time on" in label for label in labels), f"charts against estimated times: {labels}")
    check("Times are estimates." in page.find_element(By.ID, "answer-legend").text, "estimates are said to be estimates")


def test_compiled(page, folder):
    """Each pass of a chip as compiled.csv has it; what is the same machine code, and what was refused, is said."""

    def shown():
        return [[c[0] for c in row] for row in table_of(page, "#compiled")]

    def wanted(chip, shot):
        rows = rows_of(folder, "compiled.csv", chip=chip, shot=shot, refusal="")
        return [[r["point"], r["stage"], r["vgprs"], r["spilled_vgprs"], f"{r['waves']} of 16", r["limit"], r["inverse_throughput"]] for r in rows]

    def equals_file(chip, shot):
        found = [[r[0].split(" · ")[1], *r[1:6], r[9]] for r in shown()]
        equal(found, wanted(chip, shot), f"the passes of {chip} in {shot}")

    still = "still_a.main.160x90.w8.r8"
    equals_file("navi21", still)
    equal([r[10] for r in shown()], ["navi210", "navi21first", "same machine code as sssr · first", "navi21fixed"], "machine code")
    widths = page.execute_script("return [...document.querySelectorAll('#compiled .share span')].map(s => s.style.width)")
    equal(widths, ["100%", "37.5%", "100%", "25%"], "bars of waves")
    equal(page.find_elements(By.CSS_SELECTOR, "#compiled .refusals"), [], "nothing refused")
    shots = page.execute_script("return [...document.querySelectorAll('#compiled label')].find(l => l.innerText.startsWith('Shot')).innerText.split('\\n').slice(-2)")
    check(any(s.endswith(f"{still} and 5 alike") for s in shots) and any(s.endswith(STEP) for s in shots), f"shots of the same passes are one choice: {shots}")
    choose_in(page, "compiled", "Shot", STEP)
    equals_file("navi21", STEP)
    choose_in(page, "compiled", "Chip", "gfx1100")
    equals_file("gfx1100", STEP)
    said = page.find_element(By.CSS_SELECTOR, "#compiled .refusals").text
    equal(said, "sssr/stage_1 of sssr · fixed: its compiler ended: <b>signal 9</b>.", "what was refused")


def test_estimates(page, folder):
    """Bars, totals and parts are those of estimates.csv; what bounds a stage and what has no estimate is said."""
    still = "still_a.main.160x90.w8.r8"

    def check_bars(chip, shot):
        wanted = [r for r in rows_of(folder, "estimates.csv", chip=chip, shot=shot, refusal="") if r["stage"] != "total"]
        bars = page.execute_script("return [...document.querySelectorAll('#estimates .bar')].map(b => [b.dataset.stage, b.dataset.bound, +b.dataset.value, +b.getAttribute('width')])")
        equal([bar[:3] for bar in bars], [[r["stage"], r["bound"], float(r["microseconds"])] for r in wanted], f"stages on {chip} in {shot}")
        per_microsecond = [width / value for _, _, value, width in bars]
        check(max(per_microsecond) < 1.001 * min(per_microsecond), f"bars are as long as they say: {bars}")

    check_bars("navi21", still)
    section = page.find_element(By.ID, "estimates")
    check("microseconds on navi21 (estimate)" in section.find_element(By.CSS_SELECTOR, ".chart").text, "what the axis shows")
    looks = "return [...document.querySelectorAll(arguments[0])].map(e => e.getAttribute('fill'))"
    fills, keys = page.execute_script(looks, "#estimates .bar"), page.execute_script(looks, "#estimates .stage-names rect")
    equal([fills, len(set(keys))], [keys * 2, 2], "colours of what bounds a stage, as the legend has them")
    equal([e.text for e in section.find_elements(By.CSS_SELECTOR, ".stage-names .stage")], ["memory", "latency"], "the legend")
    sentences = [s.text for s in section.find_elements(By.CSS_SELECTOR, ".sentences li")]
    said = "{}: {} µs by estimate (95 % interval of sampling from {} to {}; model range [{}, {}]). Most of this time is bound by latency."
    equal(sentences, [said.format("sssr · first", 20, 15, 25, "3.3", 320), said.format("sssr · fixed", 16, 12, 20, "2.64", 256)], "totals in words")
    notes = section.text
    check("sampling alone: measured times of stages were 0.22 to 12.8 times such estimates (NVIDIA H200" in notes, notes)
    page.execute_script("document.querySelector('#estimates details').open = true")
    columns = "microseconds vector scalar shared_memory textures targets memory latency caches".split()
    rows = rows_of(folder, "estimates.csv", chip="navi21", shot=still)
    shown = table_of(page, "#estimates")
    equal([[float(row[i][1]) for i in (2, *range(5, 13))] for row in shown], [[float(r[c]) for c in columns] for r in rows], "all parts")
    equal([row[3][0] for row in shown], [f"[{float(r['low']):g}, {float(r['high']):g}]" for r in rows], "intervals")
    ends = lambda r: (f"{float(r[c]):.3g}" for c in ("model_low", "model_high"))  # noqa: E731
    equal([row[4][0] for row in shown], ["[{}, {}]".format(*ends(r)) for r in rows], "what the model leaves open")
    equal([cell[0] for cell in shown[0][13:]], ["75 %", "12.5 %"], "lanes that run, and runs that are known at most")
    bold = page.execute_script("return [...document.querySelectorAll('#estimates td.number b')].map(b => b.closest('td').cellIndex)")
    equal(bold, [10, 11] * 2, "the bold parts, which bound the stages")
    equal(section.find_elements(By.CSS_SELECTOR, ".refusals"), [], "nothing refused")
    choose_in(page, "estimates", "Shot", STEP)
    check_bars("navi21", STEP)

    choose_in(page, "estimates", "Chip", "gfx1100 (Card <B>)")
    check_bars("gfx1100", STEP)
    refusals = lambda: section.find_element(By.CSS_SELECTOR, ".refusals").text
    equal(refusals(), "sssr/stage_1 of sssr · fixed: its compiler ended: <b>signal 9</b>.", "a stage without an estimate, once")
    sentences = [s.text for s in section.find_elements(By.CSS_SELECTOR, ".sentences li")]
    equal(sentences[1], "sssr · fixed: no total, because a stage has no estimate.", "a point without a total")
    check("sssr · fixed (in part)" in section.find_element(By.CSS_SELECTOR, ".chart").text, "its bar says so")
    choose_in(page, "estimates", "Chip", "vega20")
    equal(refusals(), "All points: ssrlab has no published rates of vega20.", "a chip without rates")
    equal(section.find_elements(By.CSS_SELECTOR, ".bar, table"), [], "and nothing else")


def test_temporal(page, folder):
    text = page.find_element(By.ID, "temporal-tables").text
    check("not within the first half of 15 frames" in text, f"why a value is missing: {text}")
    equal(text.count("no such pixel"), 4, "points of the shot that has no disoccluded pixel")
    for metric in ("flicker_relative", "frame_difference_relative", "ghost_length"):
        rows = [r for r in rows_of(folder, "summary.csv", metric=metric) if not is_single_change(r)]
        shown = page.execute_script(
            """const tables = [...document.querySelectorAll('#temporal-tables table')];
            const t = tables.find(t => t.tHead.innerText.includes(arguments[0]));
            const c = [...t.tHead.rows[0].cells].findIndex(h => h.innerText.startsWith(arguments[0]));
            return [...t.tBodies[0].rows].map(r => Number(r.cells[c].dataset.value))""",
            metric,
        )
        equal(shown, [float(r["value"]) for r in rows], metric)
    frames = [
        r
        for shot in (MOVING, STEP)
        for point in ("default", "first", "fixed", "lucky")
        for r in rows_of(
            folder, "summary.csv", shot=shot, point=point, target="specular", metric="relmse", mask="reflective"
        )
        if r["frame"]
    ]
    frames.sort(key=lambda r: (r["shot"] != MOVING, int(r["frame"]), ["default", "first", "fixed", "lucky"].index(r["point"])))
    equal(values(page, "#frame-charts .point"), [float(r["value"]) for r in frames], "errors of frames")
    check("the scene changes at frame 30" in page.find_element(By.ID, "frame-charts").text, "the change is not named")


def test_quiet(page):
    equal([e["message"] for e in page.get_log("browser")], [], "console messages")
    shown = page.find_element(By.TAG_NAME, "body").text
    for word in ("undefined", "[object"):
        check(word not in shown, f"the page says {word!r}")
    # Stability is given in numbers of NaN.
    others = page.execute_script(
        "return [...document.querySelectorAll('main > section:not(#stability)')].map(s => s.innerText).join()"
    )
    check("NaN" not in others, "the page says 'NaN'")
    equal(
        page.execute_script("return document.body.scrollWidth <= innerWidth"),
        True,
        "the page is not wider than the window",
    )


def test_stability_alone(page):
    """A folder that holds no study."""
    with tempfile.TemporaryDirectory(prefix="ssrlab_report_") as folder:
        subprocess.run([sys.argv[1], "--stability", folder], check=True)
        open_report(page, folder)
        test_stability(page, folder)
        ids = page.execute_script("return [...document.querySelectorAll('main > section')].map(s => s.id)")
        equal(ids, ["stability"], "sections")
        test_quiet(page)
        named = re.findall(r"\w+\.csv", page.find_element(By.TAG_NAME, "footer").text)
        equal(sorted(named), sorted(f for f in os.listdir(folder) if f.endswith(".csv")), "the files that the footer names")
        page.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
        page.refresh()
        text = page.find_element(By.TAG_NAME, "noscript").text
        for part in ("20 runs of 4 techniques", "Cases by verdict", "amd_sssr/intersect: radiance", "an operation that ssrlab does not know, in 1 run"):
            check(part in text, f"{part!r} is not in the part for readers without scripts: {text!r}")


def open_report(page, folder):
    page.get("file://" + os.path.join(folder, "report.html"))
    until_ready(page)


def main():
    with tempfile.TemporaryDirectory(prefix="ssrlab_report_") as folder, tempfile.TemporaryDirectory(
        prefix="ssrlab_chromium_"
    ) as profile:
        subprocess.run([sys.argv[1], "--study", folder], check=True)
        page = open_browser(profile)
        try:
            open_report(page, folder)
            test_first_sentence(page, folder)
            test_results(page, folder)
            test_truth_ladder(page, folder)
            test_images_of_a_rung(page)
            test_frames_of_a_sequence(page, MOVING)
            test_roughness(page, folder)
            test_splits(page, folder)
            test_rays(page, folder, MOVING)
            test_error_shares(page, folder, MOVING)
            test_held_heads(page)
            test_stages(page)
            test_compiled(page, folder)
            test_estimates(page, folder)
            test_effects(page, folder, STEP)
            test_temporal(page, folder)
            test_stability(page, folder)
            test_quiet(page)
            test_stability_alone(page)
        finally:
            page.quit()


main()
