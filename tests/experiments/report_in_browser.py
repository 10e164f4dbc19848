"""Opens a report in headless Chromium from a file URL, as a reader would, and uses it.

usage: report_in_browser.py REPORT_PAGE_PROGRAM
"""

import csv
import json
import os
import subprocess
import sys
import tempfile

from report_browser import (
    By,
    Select,
    canvas,
    check,
    choose,
    equal,
    open_browser,
    pane_count,
    pixels,
    srgb_code,
    webdriver,
)
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.support.ui import WebDriverWait


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
            (t["shot"], t["variant"], t["point"]): t["median_ms"] for t in csv.DictReader(file) if t["stage"] == "total"
        }
    for cells, row in zip(shown, expected):
        equal([c[0] for c in cells[:3]], [row["shot"], row["variant"], row["point"]], "first columns")
        equal(float(cells[3][1]), float(row["value"]), f"{metric} of {row['shot']} {row['variant']} {row['point']}")
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
        total = totals.get((row["shot"], row["variant"], row["point"]))
        equal(cells[6][1], "null" if total is None else cells[6][1], "total time where none was measured")
        if total is not None:
            equal(float(cells[6][1]), float(total), "total time")


def test_sections(page):
    """A study without classes of roughness, seeds to split over, baselines and frames has no sections of them."""
    ids = page.execute_script("return [...document.querySelectorAll('main > section')].map(s => s.id)")
    wanted = "warnings facts results error-time stages viewer references needs parameters how".split()
    equal(ids, wanted, "sections")
    links = page.execute_script("return [...document.querySelectorAll('nav a')].map(a => a.hash.slice(1))")
    equal(links, wanted[2:], "links to sections")
    check(not page.find_element(By.ID, "overview").is_displayed(), "a short table needs no overview")


def test_table(page, folder):
    check_table(page, folder, "specular", "relmse", "reflective")
    choose(page, "Metric", "ssim (ssim_gauss11)")
    check_table(page, folder, "specular", "ssim", "reflective")
    equal(
        page.execute_script("return document.querySelectorAll('#summary b').length"), 0, "bold values without intervals"
    )
    page.find_element(By.CSS_SELECTOR, "#results #choice label:nth-child(1) select").send_keys("image")
    Select(page.find_element(By.CSS_SELECTOR, "#choice label:nth-child(3) select")).select_by_visible_text("all")
    choose(page, "Metric", "mse")
    check_table(page, folder, "image", "mse", "all")
    bold = page.execute_script(
        "return [...document.querySelectorAll('#summary b')].map(b => b.closest('tr').cells[2].innerText)"
    )
    equal(bold, ["stride=1"] * 3, "the best of each shot")


def test_sorting(page):
    for column, direction in ((3, 1), (3, -1), (6, 1)):
        page.find_element(By.CSS_SELECTOR, f"#summary th:nth-child({column + 1}) button").click()
        values = [r[column][1] for r in rows_of(page)]
        numbers = [direction * float(v) for v in values if v != "null"]
        equal(numbers, sorted(numbers), f"order of column {column}")
        check("null" not in values[: len(numbers)], "missing numbers must come last")
    equal(
        page.find_element(By.CSS_SELECTOR, "#summary th:nth-child(7)").get_attribute("aria-sort"),
        "ascending",
        "aria-sort",
    )


def test_charts(page, folder):
    equal(len(page.find_elements(By.CSS_SELECTOR, "#scatter .chart")), 3, "charts of error against time")
    equal(len(page.find_elements(By.CSS_SELECTOR, "#scatter .point")), 6, "points with times")
    label = page.find_element(By.CSS_SELECTOR, "#scatter .point").get_attribute("aria-label")
    check("mcguire_dda · stride=1; mse" in label and "ms [" in label, f"label of a point: {label}")
    with open(os.path.join(folder, "time_summary.csv"), newline="") as file:
        expected = [
            float(t["median_ms"])
            for t in csv.DictReader(file)
            if t["shot"].startswith("mirror") and t["variant"] == "mcguire_dda" and t["stage"] != "total"
        ]
    bars = page.execute_script(
        "return [...document.querySelectorAll('#bars .bar')].map(b => [+b.dataset.value, +b.getAttribute('width')])"
    )
    equal([b[0] for b in bars], expected, "times of the bars")
    for value, width in bars:
        check(abs(width / bars[0][1] - value / bars[0][0]) < 1e-3, "a bar's length is not in proportion to its time")


def test_linked_zoom(page):
    equal(pane_count(page), 4, "panes")
    before = [pixels(page, i) for i in range(4)]
    page.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas(page, 1))
    origin = webdriver.common.actions.wheel_input.ScrollOrigin.from_element(canvas(page, 1), 40, 20)
    ActionChains(page).scroll_from_origin(origin, 0, -1500).perform()
    view = page.execute_script("return {...view}")
    check(view["zoom"] > 8 and view["x"] > 0.5 and view["y"] > 0.5, f"the wheel did not zoom about the pointer: {view}")
    check(all(pixels(page, i) != before[i] for i in range(4)), "zooming one pane must zoom all")
    # Nearest neighbour: across one magnified image pixel the colour stays, and few colours are seen in a row.
    width = page.execute_script("return document.querySelectorAll('#panes canvas')[3].width")
    row = page.execute_script(
        f"return [...document.querySelectorAll('#panes canvas')[3].getContext('2d').getImageData(0, 40, {width}, 1).data]"
    )
    colors = [tuple(row[i : i + 3]) for i in range(0, len(row), 4)]
    changes = sum(a != b for a, b in zip(colors, colors[1:]))
    check(
        0 < changes <= 160 / view["zoom"] + 1,
        f"{changes} colour changes in a row of {160 / view['zoom']:.1f} magnified pixels: it is smoothed",
    )
    ActionChains(page).drag_and_drop_by_offset(canvas(page, 2), -60, 0).perform()
    moved = page.execute_script("return {...view}")
    check(
        moved["x"] > view["x"] and moved["zoom"] == view["zoom"],
        "dragging to the left must show what lies to the right",
    )
    page.find_element(By.ID, "reset").click()
    equal([pixels(page, i) for i in range(4)], before, "reset")


def test_flip(page):
    names = ["reference", "none", "mcguire_dda · stride=1", "mcguire_dda · stride=4"]
    caption = lambda: page.find_element(By.CSS_SELECTOR, "#panes figcaption").text
    side = [pixels(page, i) for i in range(4)]
    check(len(set(side)) == 4, "four images must look different")
    page.find_element(By.ID, "layout-flip").click()
    equal(pane_count(page), 1, "panes when flipping")
    seen = []
    for key, name in ((1, 0), (3, 2), (2, 1), (" ", 2), (" ", 1)):
        ActionChains(page).send_keys(str(key)).perform()
        check(names[name] in caption(), f"key {key!r} shows {caption()!r} and not {names[name]!r}")
        seen.append(pixels(page, 0))
    equal((seen[3], seen[4]), (seen[1], seen[2]), "space must flip between the same two pictures")
    check(seen[1] != seen[2], "flipping changed nothing")
    page.find_element(By.ID, "layout-side").click()


def test_exposure(page):
    before = pixels(page, 0, 100, 30)
    page.execute_script(
        "const e = document.getElementById('exposure'); e.value = -3; e.dispatchEvent(new Event('input'))"
    )
    after = pixels(page, 0, 100, 30)
    check(sum(after[:3]) < sum(before[:3]), f"a lower exposure must darken: {before} to {after}")
    page.find_element(By.ID, "reset").click()
    equal(pixels(page, 0, 100, 30), before, "exposure after reset")


def test_readout(page, folder, expected):
    """All images' values at a pixel, against the half-rounded values that the fixture's EXRs hold."""
    x, y = 37, 71
    page.execute_script(f"Object.assign(view, {{x: {(x + 0.5) / 160}, y: {(y + 0.5) / 90}, zoom: 32}}); drawAll()")
    page.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas(page, 0))
    middle = page.execute_script(
        "const c = document.querySelectorAll('#panes canvas')[0]; return [Math.floor(c.width / 2), Math.floor(c.height / 2)]"
    )
    colors = [pixels(page, i, *middle)[:3] for i in range(4)]
    ActionChains(page).move_to_element(canvas(page, 0)).click().perform()
    caption = page.find_element(By.CSS_SELECTOR, "#readout caption").text
    check(f"Pixel {x}, {y} (pinned" in caption, f"the pointer is over pixel {x}, {y}, but it says {caption}")
    shown = page.execute_script(
        "return [...document.querySelectorAll('#readout tbody tr')].map(tr => [tr.cells[0].innerText, ...[1, 2, 3].map(c => +tr.cells[c].dataset.value)])"
    )
    files = ["reference_image", "none_default_0_image", "mcguire_dda_stride=1_0_image", "mcguire_dda_stride=4_0_image"]
    for row, name in zip(shown, files):
        equal(row[1:], expected(f"mirror_pillars.front.160x90/{name}.exr", x, y), f"values of {row[0]}")
    codes = [[srgb_code(v * 2**0.5) for v in row[1:]] for row in shown]  # the fixture's exposure is 0.5 EV
    check(
        all(abs(a - b) <= 1 for c, d in zip(codes, colors) for a, b in zip(c, d)),
        f"colours {colors} of pixels whose codes are {codes}",
    )
    equal(len(shown), 4, "images in the readout")
    errors = page.execute_script(
        "return [...document.querySelectorAll('#readout tbody tr')].map(tr => tr.cells[5].innerText)"
    )
    reference, test = shown[0][1:], shown[3][1:]
    mean = sum(abs(a - b) for a, b in zip(test, reference)) / 3
    check(
        errors[0] == "–" and abs(float(errors[3]) - mean) <= 1e-4 * mean, f"absolute error {errors[3]}, expected {mean}"
    )


def test_false_color(page):
    page.find_element(By.ID, "reset").click()
    choose(page, "Show", "absolute error")
    scale = page.find_element(By.ID, "scale-text").text
    check("one scale for all" in scale, scale)
    # Two panes, one scale: recompute the colour of a pixel of each from the values and the printed maximum.
    result = page.execute_script(
        """
        const maximum = sharedMaximum(viewer.images.slice(1), viewer.images[0], 'absolute');
        return [1, 2, 3].map(i => { const im = viewer.images[i], at = 80 * im.width + 21, v = scalarModes.absolute.of(pixelRgb(im, at), pixelRgb(viewer.images[0], at));
            const c = document.querySelectorAll('#panes canvas')[i], s = c.width / im.width;
            return {expected: magma[Math.round(255 * Math.min(v / maximum, 1))], shown: [...c.getContext('2d').getImageData(Math.floor(21.5 * s), Math.floor(80.5 * s), 1, 1).data].slice(0, 3)}; })"""
    )
    for r in result:
        equal(r["shown"], r["expected"], "false colour at the shared scale")
    before = pixels(page, 1)
    page.execute_script("const e = document.getElementById('scale'); e.value = -2; e.dispatchEvent(new Event('input'))")
    check(pixels(page, 1) != before, "the scale does nothing")
    check(
        float(page.find_element(By.ID, "scale-text").text.split()[0]) < float(scale.split()[0]),
        "the printed scale must follow",
    )
    choose(page, "Show", "colour")
    page.find_element(By.ID, "error-row").click()
    equal(pane_count(page), 7, "panes with errors below")


def test_other_shot(page):
    Select(page.find_element(By.CSS_SELECTOR, "#viewer-choice label:nth-child(1) select")).select_by_visible_text(
        "fence.low.160x90"
    )
    WebDriverWait(page, 10).until(lambda p: p.execute_script("return viewer.images[0]?.shot") == "fence.low.160x90")
    color = page.execute_script(
        """const c = viewer.panes.find(p => p.wanted.image === viewer.images[3]).canvas, s = c.width / 160;
        return [...c.getContext('2d').getImageData(Math.floor(20.5 * s), Math.floor(60.5 * s), 1, 1).data].slice(0, 3)"""
    )
    equal(color, [255, 0, 255], "a NaN pixel")


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
        "the clock did not prove itself" in text and "mcguire_dda" in text and "mse" in text,
        f"the part for readers without scripts: {text!r}",
    )


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory(prefix="ssrlab_report_") as folder, tempfile.TemporaryDirectory(
        prefix="ssrlab_chromium_"
    ) as profile:
        subprocess.run([program, folder], check=True)

        def pixel_of(file, x, y):
            out = subprocess.run(
                [program, "--halves", os.path.join(folder, "images", file), str(x), str(y)],
                check=True,
                capture_output=True,
                text=True,
            ).stdout
            return [float(v) for v in out.split()]

        page = open_browser(profile)
        try:
            url = "file://" + os.path.join(folder, "report.html")
            page.get(url)
            WebDriverWait(page, 20).until(
                lambda p: p.execute_script("return document.documentElement.hasAttribute('data-ready')")
            )
            equal(len(page.find_elements(By.CSS_SELECTOR, "#warnings .warning")), 4, "warnings")
            test_sections(page)
            test_table(page, folder)
            test_sorting(page)
            test_charts(page, folder)
            test_linked_zoom(page)
            test_flip(page)
            test_exposure(page)
            test_readout(page, folder, pixel_of)
            test_false_color(page)
            test_other_shot(page)
            if os.environ.get("SSRLAB_SCREENSHOT"):
                page.save_screenshot(os.environ["SSRLAB_SCREENSHOT"])
            check_quiet(page, url)
            test_without_scripts(page, url)
        finally:
            page.quit()


main()
