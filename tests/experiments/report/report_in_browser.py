"""Opens a report in headless Chromium from a file URL, as a reader would, and uses it.

usage: report_in_browser.py REPORT_PAGE_PROGRAM
"""

import csv
import json
import os
import subprocess
import sys
import tempfile

from report_browser import By, Select, check, choose, equal, open_browser, until_ready
from report_diff import test_diff
from report_keep import test_address, test_keeping, test_save_tools
from report_use import test_use
from report_viewer import (
    test_chooser,
    test_crops,
    test_exposure_and_tone_curves,
    test_false_color,
    test_flip_and_split,
    test_flip_map,
    test_inspector,
    test_jod_map,
    test_linked_images,
    test_linked_zoom,
    test_loss_maps,
    test_other_sections_open_it,
    test_shot_beside,
)


def rows_of(page):
    """The summary table as the reader sees it; numbers with all digits from data-value."""
    return page.execute_script(
        """return [...document.querySelectorAll('#summary tbody tr')].map(tr =>
        [...tr.cells].map(td => [td.innerText, td.dataset.value ?? null]))"""
    )


def summary_rows(folder, target, metric, mask):
    with open(os.path.join(folder, "summary.csv"), newline="") as file:
        return [r for r in csv.DictReader(file) if (r["target"], r["metric"], r["mask"]) == (target, metric, mask)]


def check_table(page, folder, target, metric, mask):
    shown, expected = rows_of(page), summary_rows(folder, target, metric, mask)
    equal(len(shown), len(expected), f"rows of {target} {metric} {mask}")
    with open(os.path.join(folder, "time_summary.csv"), newline="") as file:
        totals = {
            (t["shot"], t["technique"], t["point"]): t["median_ms"] for t in csv.DictReader(file) if t["stage"] == "total"
        }
    for cells, row in zip(shown, expected):
        del cells[4]  # the metric beside it, see report_study_in_browser.py
        equal([cells[0][0], cells[1][0], cells[2][1]], [row["shot"], row["technique"], row["point"]], "first columns")
        equal(float(cells[3][1]), float(row["value"]), f"{metric} of {row['shot']} {row['technique']} {row['point']}")
        text = cells[3][0].split("[")[0].split()[0]
        check(
            abs(float(text) - float(row["value"])) <= 5.1e-4 * abs(float(row["value"])),
            f"the shown {text} is not {row['value']}",
        )
        if row["low"]:
            low, high = (float(x) for x in cells[3][0].split("[")[1].split("]")[0].split(","))
            check(
                abs(low - float(row["low"])) <= 5.1e-4 * abs(low)
                and abs(high - float(row["high"])) <= 5.1e-4 * abs(high),
                f"interval {low}, {high}",
            )
        else:
            check("[" not in cells[3][0], "an interval is shown where there is none")
        equal(float(cells[4][1]), float(row["floor"]), "floor")
        total = totals.get((row["shot"], row["technique"], row["point"]))
        equal(cells[6][1], "null" if total is None else cells[6][1], "total time where none was measured")
        if total is not None:
            equal(float(cells[6][1]), float(total), "total time")


def test_sections(page):
    """A study without classes of roughness, seeds to split over, baselines, frames and compilers has no sections of them."""
    ids = page.execute_script("return [...document.querySelectorAll('main > section')].map(s => s.id)")
    wanted = "answers results viewer stages references needs parameters how provenance".split()
    equal(ids, wanted, "sections")
    links = page.execute_script("return [...document.querySelectorAll('nav a')].map(a => a.hash.slice(1))")
    equal(links, wanted[1:], "links to sections")
    savings = page.execute_script("return document.querySelector('#stages details table').textContent")
    check("25 % [20 %, 30 %]8" in savings, "what leaving out saves: " + savings)
    notes = [p.text for p in page.find_elements(By.CSS_SELECTOR, "#parameters p.note")]
    limited = [note.split(". ")[-1] for note in notes if "Held to the limits" in note]
    equal(limited, ["Held to the limits of WebGL 2: stride=1"], "limits of techniques")


def test_table(page, folder):
    check_table(page, folder, "specular", "mse", "reflective")
    choose(page, "Metric", "ssim (ssim_gauss11)")
    check_table(page, folder, "specular", "ssim", "reflective")
    equal(
        page.execute_script("return document.querySelectorAll('#summary td:nth-child(4) b').length"), 0, "bold values without intervals"
    )
    page.find_element(By.CSS_SELECTOR, "#results #choice label:nth-child(1) select").send_keys("image")
    Select(page.find_element(By.CSS_SELECTOR, "#choice label:nth-child(3) select")).select_by_visible_text("all")
    choose(page, "Metric", "mse")
    check_table(page, folder, "image", "mse", "all")
    bold = page.execute_script(
        "return [...document.querySelectorAll('#summary td:nth-child(4) b')].map(b => b.closest('tr').cells[2].dataset.value)"
    )
    equal(bold, ["stride=1"] * 3, "the best of each shot")


def test_sorting(page):
    for column, direction in ((3, 1), (3, -1), (7, 1)):
        page.find_element(By.CSS_SELECTOR, f"#summary th:nth-child({column + 1}) button").click()
        values = [r[column][1] for r in rows_of(page)]
        numbers = [direction * float(v) for v in values if v != "null"]
        equal(numbers, sorted(numbers), f"order of column {column}")
        check("null" not in values[: len(numbers)], "missing numbers must come last")
    equal(
        page.find_element(By.CSS_SELECTOR, "#summary th:nth-child(8)").get_attribute("aria-sort"),
        "ascending",
        "aria-sort",
    )


def test_charts(page, folder):
    equal(len(page.find_elements(By.CSS_SELECTOR, "#scatter .chart")), 6, "two charts of error against time per shot")
    equal(len(page.find_elements(By.CSS_SELECTOR, "#scatter .point")), 12, "points with times")
    label = page.find_element(By.CSS_SELECTOR, "#scatter .point").get_attribute("aria-label")
    check("mcguire_dda · stride=1; mse" in label and "ms [" in label, f"label of a point: {label}")
    with open(os.path.join(folder, "time_summary.csv"), newline="") as file:
        expected = [
            float(t["median_ms"])
            for t in csv.DictReader(file)
            if t["shot"].startswith("mirror") and t["technique"] == "mcguire_dda" and t["stage"] != "total"
        ]
    bars = page.execute_script(
        "return [...document.querySelectorAll('#stages .bar')].map(b => [+b.dataset.value, +b.getAttribute('width')])"
    )
    equal([b[0] for b in bars], expected, "times of the bars")
    for value, width in bars:
        # Half a pixel on either side: bars keep a gap.
        check(abs(width - value / bars[0][0] * bars[0][1]) < 1, "a bar's length is not in proportion to its time")


    ticks = page.execute_script(
        """const times = [...totals];
        totals.clear();
        const chart = errorTimeChart(answerChoice.shot, headlineRows(answerChoice.shot, headline.metric));
        times.forEach(([key, time]) => totals.set(key, time));
        const texts = [...chart.querySelectorAll('svg text')].map(t => t.textContent), label = texts.find(t => t.startsWith('points,'));
        return texts.slice(0, texts.indexOf(label))"""
    )
    equal(ticks, ["1", "2"], "ticks at the marks of a chart without times")


def test_labels(page):
    """Names of marks and of lines cover neither each other nor marks: of charts as they are, and of one whose marks crowd."""
    found = page.execute_script(
        """const n = 14, of = i => ({...seriesStyle(i), x: 10 + 0.02 * (i % 4), y: 1 + 0.03 * Math.floor(i / 4), name: 'p' + (i + 1), tip: '', spanX: [9.9, 10.2]});
        const axis = (low, high) => ({type: 'log', domain: [low, high], ticks: [low], tickFormat: String});
        const crowd = markChart({title: 'a crowd', x: axis(8, 12), y: axis(0.5, 2), marks: Array.from({length: n}, (_, i) => of(i)),
            levels: [{y: 1.9, text: 'one line 1.9'}, {y: 1.88, text: 'another line 1.88'}]});
        document.body.append(crowd);
        const box = e => e.getBoundingClientRect(), overlaps = [];
        for (const chart of document.querySelectorAll('#answer-charts .chart, #scatter .chart, body > .chart')) {
            const labels = [...chart.querySelectorAll('.mark-label')], marks = [...chart.querySelectorAll('.point')];
            labels.forEach((a, i) => [...labels.slice(i + 1), ...marks].forEach(b => {
                const [p, q] = [box(a), box(b)], height = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
                // A text's box has air above and below its digits.
                if (Math.min(p.right, q.right) - Math.max(p.left, q.left) > 1 && height > 0.3 * p.height) overlaps.push(a.textContent + ' and ' + (b.textContent || b.tagName));
            }));
        }
        const texts = of => [...of.querySelectorAll('.mark-label')].map(t => t.textContent);
        const crowded = texts(crowd), plain = texts(document.querySelector('#scatter .chart'));
        crowd.remove();
        return [overlaps, crowded, plain]"""
    )
    overlaps, crowded, plain = found
    equal(overlaps, [], "labels that cover something")
    equal(crowded[:2], ["one line 1.9", "another line 1.88"], "names of lines")
    check(len(crowded) >= 2 + 10, f"names of 14 marks that crowd: {crowded[2:]}")
    equal([t for t in plain if t.startswith("stride")], ["stride=1", "stride=4"], "names in a plain chart")


def check_quiet(page, url):
    # The only message allowed is about getImageData, which this test calls and the page does not.
    errors = [entry["message"] for entry in page.get_log("browser") if "willReadFrequently" not in entry["message"]]
    equal(errors, [], "console messages")
    requests = [json.loads(e["message"])["message"] for e in page.get_log("performance")]
    # The browser's own start page makes requests too; they name another document.
    urls = [
        m["params"]["request"]["url"]
        for m in requests
        if m["method"] == "Network.requestWillBeSent" and m["params"]["documentURL"] == url
    ]
    check(url in urls, f"the log of requests does not even have the page: {urls}")
    equal([u for u in urls if u != url and not u.startswith("data:")], [], "requests")


def test_without_scripts(page, url):
    page.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    page.get(url)
    text = page.find_element(By.TAG_NAME, "noscript").text
    check(
        "Timer validation failed" in text and "mcguire_dda" in text and "mse (radiance^2)" in text,
        f"the part for readers without scripts: {text!r}",
    )
    data = json.loads(page.find_element(By.ID, "data").get_attribute("textContent"))
    for sentence in (data["in_these_scenes"], data["in_scenes_like_these"]):
        check(sentence in text, f"the part for readers without scripts lacks {sentence!r}: {text!r}")
    check("null" not in text, f"the part for readers without scripts: {text!r}")
    check(not page.find_element(By.TAG_NAME, "main").is_displayed(), "empty sections are shown")
    digits = max(len(word.lstrip("0.")) for word in text.split() if word.replace(".", "").isdigit() and "." in word)
    check(digits <= 4, f"numbers of {digits} digits")


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory(prefix="ssrlab_report_") as folder, tempfile.TemporaryDirectory(
        prefix="ssrlab_chromium_"
    ) as profile, tempfile.TemporaryDirectory(prefix="ssrlab_linked_") as linked:
        subprocess.run([program, folder], check=True)

        def output(option, *arguments):
            """Of the program, whose arguments that end in .exr are images."""
            of = [os.path.join(folder, "images", a) if str(a).endswith(".exr") else str(a) for a in arguments]
            return subprocess.run([program, option, *of], check=True, capture_output=True, text=True).stdout

        def pixel_of(*arguments):
            return [float(v) for v in output("--halves", *arguments).split()]

        page = open_browser(profile)
        try:
            url = "file://" + os.path.join(folder, "report.html")
            page.get(url)
            until_ready(page)
            equal(len(page.find_elements(By.CSS_SELECTOR, "#warnings .warning")), 5, "warnings")
            test_sections(page)
            test_use(page, url, folder)
            test_table(page, folder)
            test_sorting(page)
            test_charts(page, folder)
            test_labels(page)
            test_address(page, url)
            test_keeping(page)
            test_save_tools(page)
            page.get(url)
            until_ready(page)
            test_linked_zoom(page)
            test_flip_and_split(page)
            test_exposure_and_tone_curves(page)
            test_inspector(page, pixel_of)
            test_false_color(page)
            test_flip_map(page, lambda *files: [float(v) for v in output("--flip", *files).split()])
            test_jod_map(page)
            test_shot_beside(page)
            test_loss_maps(page)
            test_chooser(page)
            test_crops(page)
            test_other_sections_open_it(page)
            if os.environ.get("SSRLAB_SCREENSHOT"):
                page.save_screenshot(os.environ["SSRLAB_SCREENSHOT"])
            check_quiet(page, url)
            subprocess.run([program, "--link", linked], check=True)
            test_linked_images(page, linked)
            test_diff(page, program, folder, linked)
            test_without_scripts(page, url)
        finally:
            page.quit()


main()
