"""What a reader does with a report: the answers, the matrix, the filter, legends, paper, and a screen reader."""

import datetime
import json
import os
import re

from report_browser import By, check, choose_in, equal, rows_of, table_of, until_ready, wait_until

AXE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "vendor", "axe.min.js")
BEST, BASELINE = ("mcguire_dda", "stride=1"), ("mcguire_dda", "stride=4")


def changed_report(folder, change):
    """The address of the report with `change` made to its data, as a file beside it."""
    with open(os.path.join(folder, "report.html")) as file:
        text = file.read()
    before, data, after = re.match(r'(.*<script type="application/json" id="data">)(.*?)(</script>.*)', text, re.S).groups()
    data = json.loads(data)
    change(data)
    path = os.path.join(folder, change.__name__ + ".html")
    with open(path, "w") as file:
        file.write(before + json.dumps(data).replace("<", "\\u003c") + after)
    return "file://" + path


def answered(data):
    """Answers of its first two shots, made up."""
    def point(name):
        return {"technique": name[0], "point": name[1], "value": 0.125, "low": 0.12, "high": 0.13}

    data["in_these_scenes"] = "In these 2 shots one errs least."
    data["in_scenes_like_these"] = "In scenes like these nobody knows."
    data["answers"] = [
        {
            "shot": shot["shot"],
            "sentence": f"In <{i}> one errs least, surely.",
            "perceptual_sentence": f"To eyes, too, in {i}.",
            "best": point(BEST),
            "tied": [],
            "baseline": point(BASELINE),
        }
        for i, shot in enumerate(data["manifest"]["shots"][:2])
    ]


def test_without_truth(page, folder):
    """A capture has no errors: its pictures and times come first."""
    def capture(data):
        data["errors"]["count"] = data["frames"]["count"] = 0

    page.get(changed_report(folder, capture))
    until_ready(page)
    check("without truth" in texts(page, "#over-scenes")[0], "what is said first")
    check("3 technique points" in texts(page, "#subtitle")[0], "the points that it ran")
    shots = rows_of(folder, "time_summary.csv", stage="total")
    of_first = [r for r in shots if r["shot"] == shots[0]["shot"] and r["technique"] != "none"]
    check(texts(page, "#answer-shots button")[0].startswith("mirror_pillars 3 points, "), "the shots")
    shown = [float(row[1][1]) for row in table_of(page, "#answer-charts")]
    equal(shown, sorted(float(r["median_ms"]) for r in of_first), "times")
    equal(len(page.find_elements(By.CSS_SELECTOR, "#answer-pictures canvas")), 3, "a picture of each point")
    check(not page.find_elements(By.ID, "results"), "a section of errors")
    equal([e["message"] for e in page.get_log("browser")], [], "console messages")


def test_sampled_rays(page, folder):
    """Where a study judged some rays alone it says why nothing is said of causes."""
    def sampled(data):
        data["manifest"].setdefault("config", {})["hits"] = {"every": 2}

    page.get(changed_report(folder, sampled))
    until_ready(page)
    for selector in ("#why-answer", "#error-shares .note:last-child"):
        said = texts(page, selector)[0]
        check("one pixel in 2 along each axis" in said and '"every": 1' in said, f"{selector} says {said!r}")


def test_unfinished_study(page, folder):
    """The page of a study that is not done says so, and loads anew in its place."""
    def unfinished(data):
        written = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
        data["manifest"] |= {"is_complete": False, "cells": {"done": 3, "planned": 60}, "written": {"at": written}}

    # Long waits are listed in place of begun.
    listed = {"source": "const begin = setTimeout.bind(window); window.waits = []; window.setTimeout = (act, ms) => ms >= 10000 ? waits.push([act, ms]) : begin(act, ms)"}
    script = page.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", listed)["identifier"]
    page.get(changed_report(folder, unfinished))
    until_ready(page)
    page.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", {"identifier": script})
    said = texts(page, "#progress")
    check(len(said) == 1 and "3 of 60 cells" in said[0] and "reloads by itself" in said[0], f"what is said of the study: {said}")
    equal(page.execute_script("return waits.map(w => w[1])"), [15000], "milliseconds until the page of a moment ago reloads")
    page.execute_script("dispatchEvent(new Event('pointerdown')); waits[0][0]()")
    equal(page.execute_script("return waits.length"), 2, "a page that is used waits")
    page.execute_script("window.isOld = true; scrollTo(0, 900); setTimeout(reloadInPlace)")
    wait_until(page, lambda p: p.execute_script("return !window.isOld && document.documentElement.hasAttribute('data-ready')"), "the page after a reload")
    equal(page.execute_script("return scrollY"), 900, "the place after a reload")


def test_old_browser(page, folder):
    """One that cannot inflate images: the page says so where they would be, and shows all else."""
    old = {"source": "delete window.DecompressionStream"}
    script = page.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", old)["identifier"]
    page.get("file://" + os.path.join(folder, "report.html"))
    until_ready(page)
    page.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", {"identifier": script})
    for selector in ("#answer-pictures", "#viewer"):
        check("need a browser of 2023" in texts(page, selector)[0], f"{selector} without images")
    equal(len(page.find_elements(By.CSS_SELECTOR, "#answer-charts .chart")), 2, "charts without images")
    equal([e["message"] for e in page.get_log("browser")], [], "console messages of an old browser")


def texts(page, selector):
    return page.execute_script("return [...document.querySelectorAll(arguments[0])].map(e => e.innerText)", selector)


def test_answers(page, shots):
    """All of the first screen, at the size that it is made for."""
    equal(texts(page, "#over-scenes p"), ["In these 2 shots one errs least.", "In scenes like these nobody knows."], "what is said first")
    first = page.execute_script("return [...document.querySelectorAll('#answers p, #answers button')].find(e => e.innerText).closest('[id]').id")
    equal(first, "over-scenes", "the first text of the first screen")
    equal(len(page.find_elements(By.CSS_SELECTOR, "#answer-charts .chart")), 2, "charts of both errors")
    for shot in (1, 0):
        page.find_elements(By.CSS_SELECTOR, "#answer-shots button")[shot].click()
        names, sentences = [s.split(".")[0] for s in shots], texts(page, "#answer-shots button")
        said = f"{names[shot]} In <{shot}> one errs least, surely."
        check(sentences[shot].startswith(said), f"the chosen shot's sentence: {sentences[shot]}")
        equal(sentences[1 - shot], f"{names[1 - shot]} mcguire_dda · stride=1, mse 0.125 [0.12, 0.13]", "another shot's best")
        check("No technique is named" in sentences[2], f"a shot without answer: {sentences[2]}")
        check(texts(page, "#answer-note")[0].startswith(f"To eyes, too, in {shot}."), "the chosen shot's note")
        captions = page.execute_script("return [...document.querySelectorAll('#answer-charts figcaption')].map(c => c.innerText)")
        check(all(c.startswith(shots[shot].split(".")[0]) for c in captions), f"charts of the chosen shot: {captions}")
        below = "return [viewer.shot, ...new Set([...document.querySelectorAll('details.shot[open]')].map(d => d.dataset.shot))]"
        equal(set(page.execute_script(below)), {shots[shot]}, "the shot that the sections below show")
        labels = "return [...document.querySelectorAll('#answer-pictures canvas')].map(c => c.getAttribute('aria-label'))"
        wait_until(page, lambda p: all(shots[shot] in label for label in p.execute_script(labels)), "labels of the shot")
    titles = texts(page, "#answer-pictures b")
    equal(titles, ["truth", "least mse: mcguire_dda · stride=1", "baseline: mcguire_dda · stride=4"], "pictures")
    colours = page.execute_script(
        """return [...document.querySelectorAll('#answer-pictures canvas')].map(c =>
        c.getContext('2d').getImageData(0, 0, c.width, c.height).data.reduce((a, b) => (a * 31 + b) % 1e9))"""
    )
    equal(len(set(colours)), 3, "three pictures that differ")
    cut = "return [...document.querySelectorAll('#answers *')].filter(e => ['ellipsis'].includes(getComputedStyle(e).textOverflow) || getComputedStyle(e).webkitLineClamp !== 'none').length"
    equal(page.execute_script(cut), 0, "texts of the first screen that may be cut off")
    names = page.execute_script("return [...document.querySelectorAll('#answer-charts .chart:first-child .mark-label')].map(t => t.textContent)")
    equal([n for n in names if n in ("stride=1", "stride=4")], ["stride=1", "stride=4"], "names at the marks")
    bottom = page.execute_script("return document.querySelector('#answers').getBoundingClientRect().bottom")
    check(bottom <= 800, f"the first screen ends at {bottom}")
    check(page.execute_script("return document.body.scrollWidth <= innerWidth"), "the page is wider than the window")
    equal(len(page.find_elements(By.CSS_SELECTOR, "#warnings details:not([open]) .warning")), 5, "folded warnings")


def test_budget(page, folder, shot):
    """Of what fits into the time the least error, what may fit, and what just misses; each with its picture."""
    check(float(page.find_element(By.ID, "budget").get_attribute("value")) > 0, "a budget to begin with")
    of_shot = dict(shot=shot, stage="total")
    times = {(r["technique"], r["point"]): [float(r[c]) for c in ("median_ms", "low_ms")] for r in rows_of(folder, "time_summary.csv", **of_shot)}
    errors = {
        (r["technique"], r["point"]): float(r["value"])
        for r in rows_of(folder, "summary.csv", shot=shot, metric="mse", mask="reflective", target="specular")
    }
    high_of = lambda point: max(float(r["fits_from_ms"]) for r in rows_of(folder, "time_summary.csv", **of_shot) if (r["technique"], r["point"]) == point)
    least_of = lambda point: max(float(r["may_fit_from_ms"]) for r in rows_of(folder, "time_summary.csv", **of_shot) if (r["technique"], r["point"]) == point)
    label = lambda point: point[0] if point[1] == "default" else " · ".join(point)
    by_error = sorted(times, key=errors.get)
    best, cheapest = by_error[0], min(times, key=times.get)
    check(best != cheapest, "the fixture has a faster point of more error")
    between = (times[best][1] + times[best][0]) / 2  # within the interval of the best one's time
    for budget, fits in ((times[best][0] + 1, best), (times[best][0] + 1e-6, best), (between, cheapest), (times[cheapest][1] / 2, None)):
        page.execute_script("const b = at('budget'); b.value = arguments[0]; b.dispatchEvent(new Event('input'))", budget)
        rows = page.execute_script(
            """return [...document.querySelectorAll('#budget-answer th[scope=rowgroup]')].map(
            head => [head.innerText.split('\\n')[0], [...head.parentNode.cells].slice(1).map(c => c.innerText)])"""
        )
        check([r[0] for r in rows] in (["fits", "may fit", "just misses"], ["fits", "may fit", "needs more"]), f"rows of the budget: {rows}")
        surely = [p for p in by_error if high_of(p) <= budget]
        better = by_error[: by_error.index(surely[0])] if surely else by_error
        may = [p for p in better if least_of(p) <= budget]
        misses = sorted((p for p in better if least_of(p) > budget), key=least_of)
        for (kind, text), own in zip(rows, (surely, may, misses)):
            check(text[0].strip() == label(own[0]) if own else text[0].startswith("no "), f"{kind} {budget} ms: {text}, expected {own[:1]}")
            if own:
                check(text[1].startswith(page.execute_script("return number(arguments[0], 3)", times[own[0]][0])), f"the time of {own[0]}: {text[1]}")
                check(text[2].startswith(page.execute_script("return number(arguments[0], 3)", errors[own[0]])), f"the error of {own[0]}: {text[2]}")
        for kind, text in rows[2:]:
            over = least_of(misses[0]) / budget if misses else 0
            check((kind == "needs more") == (over > 1.1), f"{over} times the budget are called {kind}")
        note = texts(page, "#budget-note")[0]
        check("timer was not validated" in note and "Times within 2 % are undecided" in note, f"the clock and the A/A floor: {note}")
    axes = page.execute_script("return [...document.querySelectorAll('#answer-charts svg')].map(s => s.textContent)")
    check(axes and all(re.search(r"total time \(ms\), .*\d+x\d+", a) for a in axes), f"machine and size at the axes of times: {axes}")
    page.execute_script("const b = at('budget'); b.value = ''; b.dispatchEvent(new Event('input'))")
    equal(texts(page, "#budget-answer") + texts(page, "#budget-note"), ["", ""], "without a budget")


def test_chosen_point(page, shot):
    """Pictures, marks and the reason follow a row of the budget and a mark."""
    chosen = "return [...new Set([...document.querySelectorAll('#answer-charts .point.chosen')].map(m => m.dataset.point))]"
    equal(page.execute_script(chosen), ["stride=1"], "the best is chosen first")
    page.execute_script("const b = at('budget'); b.value = 1e6; b.dispatchEvent(new Event('input'))")
    wait_until(page, lambda p: p.find_elements(By.CSS_SELECTOR, "#budget-answer .thumbnail canvas"), "a picture of the budget's answer")
    page.execute_script("document.querySelector('#answer-charts .point[data-point=\"stride=4\"]').dispatchEvent(new Event('click'))")
    equal(page.execute_script(chosen), ["stride=4"], "the mark that was clicked")
    page.execute_script("answerOf(answerChoice.shot).baseline = null; return drawAnswerPictures()")
    equal(texts(page, "#answer-pictures b")[2:], ["chosen: mcguire_dda · stride=4"], "its picture")
    page.find_element(By.CSS_SELECTOR, "#budget-answer button").click()
    equal(page.execute_script(chosen), ["stride=1"], "the budget's row that was clicked")
    wait_until(page, lambda p: len(texts(p, "#answer-pictures b")) == 2, "two pictures of the answer")
    page.execute_script("answerChoice.point = null; return drawChosenPoint()")


def opened(page):
    """The shot and the points that the viewer shows, once a click has changed them."""
    read = """if (viewer.shot === null || at('panes').getAttribute('aria-busy') !== 'false') return null;
        return {shot: viewer.shot, points: viewer.shown.slice(1).map(s => s.method.label)}"""
    was = wait_until(page, lambda p: p.execute_script(read), "the state of the viewer")
    page.execute_script("viewer.shot = null")
    return was


def test_matrix(page, shots):
    """What a click on a cell, on a mark and on a picture opens; keys do the same."""
    opened(page)
    wanted = {"shot": shots[0], "points": ["mcguire_dda · stride=1", "mcguire_dda · stride=4"]}
    head = page.execute_script("return [...document.querySelectorAll('#matrix thead th')].map(t => t.textContent)")
    scenes = ["mirror_pillars", "fence", "roughness_gradient"]
    equal(head, ["mse (radiance²)", "flip", "total time (ms)", "Point", *scenes, *scenes, *scenes], "columns of both errors and of the time")
    cells = page.find_elements(By.CSS_SELECTOR, "#matrix tbody button:not(.time)")
    equal(len(cells), 3 * 6, "cells")
    values = [float(c.get_attribute("data-value")) for c in cells]
    for column in range(6):
        own = values[column::6]
        for value, cell in zip(own, cells[column::6]):
            check(abs(float(cell.text.split()[0]) - value / min(own)) < 6e-3 * value / min(own), f"a ratio: {cell.text}")
    cells[6].click()  # of the second point, in the first shot
    equal(opened(page), wanted, "what a cell opens")
    cells[6].send_keys("\ue014")  # arrow to the right
    focused = page.execute_script("return [...document.querySelectorAll('#matrix tbody button:not(.time)')].indexOf(document.activeElement)")
    equal(focused, 7, "the cell that an arrow key goes to")
    equal(page.execute_script("return document.querySelectorAll('#matrix button[tabindex=\"0\"]').length"), 1, "tab stops")
    check("[" in cells[7].get_attribute("aria-label"), "a cell names its interval")
    page.find_element(By.CSS_SELECTOR, "#scatter .point").send_keys("\ue007")  # Enter
    equal(opened(page), wanted, "what a mark opens")
    page.find_element(By.CSS_SELECTOR, "#answer-pictures [role=button]").click()
    equal(opened(page), wanted, "what a picture opens")
    page.execute_script("return openViewer({shot: arguments[0]})", shots[0])
    choose_in(page, "results", "Cells relative to", "none")
    equal(texts(page, "#matrix tbody tr:first-child button:not(.time)"), ["1"] * 6, "none over itself")
    choose_in(page, "results", "Cells relative to", "the least")


def test_points(page):
    """Filter, order, colours and legend."""
    def rows():
        return texts(page, "#matrix tbody th[scope=row]")

    box = page.find_element(By.ID, "filter")
    box.send_keys("stride 4")
    equal(rows(), ["mcguire_dda · stride=4"], "filtered points")
    equal(len(page.find_elements(By.CSS_SELECTOR, "#scatter .point")), 6, "filtered marks")
    equal(page.find_element(By.ID, "match").text, "1 of 3 points", "how many match")
    box.send_keys("\b" * 8)
    choose_in(page, "results", "Sort by", "mean error")
    equal(rows(), ["mcguire_dda · stride=1", "mcguire_dda · stride=4", "none"], "points by error")
    page.find_element(By.ID, "isGrouped").click()
    equal(texts(page, "#matrix tr.technique"), ["mcguire_dda", "none"], "groups")
    page.find_element(By.ID, "isGrouped").click()
    choose_in(page, "results", "Sort by", "order of the study")
    choose_in(page, "results", "Colours and shapes stand for", "stride")
    equal(texts(page, "#legend button[aria-pressed]"), ["stride = 1", "stride = 4", "without stride"], "values of the parameter")
    shapes = page.execute_script("return [...document.querySelectorAll('#scatter .chart:first-child .point')].map(p => p.getAttribute('d'))")
    equal(len(set(shapes[:2])), 2, "values differ in shape, not in colour alone")
    choose_in(page, "results", "Colours and shapes stand for", "points")
    page.find_elements(By.CSS_SELECTOR, "#legend button")[1].click()
    marks = page.execute_script("return [...document.querySelectorAll('#scatter .point, #answer-charts .point')].map(p => p.dataset.point)")
    equal(set(marks), {"stride=4"}, "marks when a legend entry is switched off")
    page.find_elements(By.CSS_SELECTOR, "#legend button")[1].click()
    equal(len(page.find_elements(By.CSS_SELECTOR, "#scatter .point")), 12, "all marks again")


def test_mistakes(page):
    """Mistakes stand at their rows, as text."""
    found = page.execute_script(
        """return [...document.querySelectorAll('#summary tbody tr')].map(r =>
        [r.cells[0].textContent.split('.')[0], r.cells[2].dataset.value, [...r.querySelectorAll('.badge')].map(b => b.getAttribute('aria-label'))])"""
    )
    for shot, point, badges in found:
        wanted = []
        if (shot, point) == ("fence", "stride=4"):
            wanted.append("1 not finite: ")
        if (shot, point) == ("mirror_pillars", "stride=4"):
            wanted.append("copies differ 34 %: ")
        if shot == "fence" and point != "default":
            wanted.append("disturbed: ")
        equal([b.split(":")[0] + ": " for b in badges], wanted, f"mistakes of {shot} {point}")
    found = page.execute_script(
        """const row = report.errors[0], of = changes => mistakesOfError(changedRow(row, changes)).map(m => m.text);
        return [of({}), of({litNoise: 0.25 * row.value}), of({litNoise: 0.09 * row.value}), of({interval: "none: 1 seed"}),
            of({interval: "reference and seeds", seeds: 1})]"""
    )
    equal(found, [[], ["lit noise 25 %"], [], ["1 seed"], ["1 of 2 seeds"]], "other mistakes")


def test_provenance(page):
    link = page.find_element(By.CSS_SELECTOR, "#summary a")
    check("2026-01-31T12:01:00Z, commit abcdef0123, llvmpipe" in link.get_attribute("title"), link.get_attribute("title"))
    equal(page.execute_script("return document.querySelector(arguments[0].hash).textContent.includes('A processor')", link), True, "where it leads")


def test_charts_and_tables(page):
    """Sweeps are joined, axes have ticks enough, parameters stand below their technique's name, and a table's buttons cover nothing."""
    joined = page.execute_script(
        """return [...document.querySelectorAll('#answer-charts .chart')].map(c => [...c.querySelectorAll('.sweep path')].map(p =>
               p.getAttribute('d').match(/[ML]/g).join('')))"""
    )
    equal(joined, [["ML"], ["ML"]], "stride=1 and stride=4, joined by one line")
    counts = page.execute_script("return [[0.8, 1.28], [0.95, 1.05], [0.3, 1.5], [1e-5, 1]].map(ends => logAxis(ends, null, 0.02).ticks.length)")
    check(min(counts) >= 3 and max(counts) <= 9, f"ticks of logarithmic axes: {counts}")
    titles = page.execute_script("return [...document.querySelectorAll('#parameters h3')].map(t => t.textContent)")
    equal(titles, ["none: No reflections", "mcguire_dda: McGuire & Mara 2014"], "the headings of parameters")
    covered = page.execute_script(
        """const box = document.querySelector('#references .scroll'), note = document.querySelector('#references .note');
        box.scrollIntoView({block: 'center'});
        box.querySelector('table').dispatchEvent(new PointerEvent('pointerover', {bubbles: true}));
        const tools = document.getElementById('save-tools');
        return [tools.hidden, tools.getBoundingClientRect().top - note.getBoundingClientRect().bottom,
            box.getBoundingClientRect().top - tools.getBoundingClientRect().bottom]"""
    )
    check(covered[0] is False and covered[1] >= 0 and covered[2] >= -1, f"the table's buttons, below the sentence and above the table: {covered}")


def test_telephone(page):
    """Bars keep the size of their letters, and what scrolls to a side says so."""
    check(page.execute_script("return document.body.scrollWidth <= innerWidth"), "the page is wider than a telephone")
    bars = page.execute_script("return [...document.querySelectorAll('.chart.wide > svg')].map(s => [s.clientWidth, s.viewBox.baseVal.width])")
    check(bars and all(own >= 0.8 * drawn for own, drawn in bars), f"widths of bars, of those drawn: {bars}")
    plain = page.execute_script(
        """return [...document.querySelectorAll('main .scroll, main .chart.wide, main table')].filter(e => e.scrollWidth > e.clientWidth + 1 &&
            !getComputedStyle(e).backgroundImage.includes('gradient')).map(e => e.closest('section').id)"""
    )
    equal(plain, [], "what scrolls without a sign of it")


def test_paper(page):
    page.execute_script("dispatchEvent(new Event('beforeprint'))")
    equal(page.execute_script("return document.querySelectorAll('details:not([open])').length"), 0, "folded parts on paper")


def test_axe(page):
    """The whole page with all that folds open, light and dark: nothing serious or critical."""
    with open(AXE) as file:
        page.execute_script(file.read())
    for scheme in ("light", "dark"):
        page.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
        found = page.execute_async_script(
            "axe.run(document, {resultTypes: ['violations']}).then(r => arguments[0](r.violations.map(v => [v.impact, v.id, v.nodes[0].html])))"
        )
        equal([v for v in found if v[0] in ("serious", "critical")], [], f"violations in {scheme} colours")
    page.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def test_use(page, url, folder):
    """Uses a page of its own, and leaves `url` open as it was."""
    answers = changed_report(folder, answered)
    page.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False})
    page.get(answers)
    until_ready(page)
    shots = page.execute_script("return report.answers.map(a => a.shot)")
    test_answers(page, shots)
    test_budget(page, folder, shots[0])
    test_matrix(page, shots)
    test_chosen_point(page, shots[0])
    test_points(page)
    test_mistakes(page)
    test_provenance(page)
    test_charts_and_tables(page)
    test_paper(page)
    test_axe(page)
    page.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 400, "height": 800, "deviceScaleFactor": 1, "mobile": False})
    test_telephone(page)
    test_without_truth(page, folder)
    test_axe(page)
    test_sampled_rays(page, folder)
    test_unfinished_study(page, folder)
    test_old_browser(page, folder)
    page.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    page.get(url)
    until_ready(page)
