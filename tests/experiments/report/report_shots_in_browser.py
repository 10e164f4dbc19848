"""Opens reports of many shots in headless Chromium: what is looked at is there, and what is not is not made.

usage: report_shots_in_browser.py REPORT_PAGE_PROGRAM
"""

import os
import subprocess
import sys
import tempfile

from report_browser import CATCH_SAVES, By, Select, check, choose_in, equal, open_browser, rows_of, until_ready, values, wait_until

MOST_NODES = 50_000  # of a page of 400 shots: a browser lays out so many in a fraction of a second
POINTS = 20
NODES = """let count = 0;
for (const walker = document.createTreeWalker(document); walker.nextNode(); ++count);
return count"""


def open_report(page, folder, shots):
    subprocess.run([sys.argv[1], "--shots", str(shots), folder], check=True)
    page.get("file://" + os.path.join(folder, "report.html"))
    until_ready(page)
    return page.execute_script(NODES)


def wait_for(page, script, what, *arguments):
    wait_until(page, lambda p: p.execute_script("return " + script, *arguments), what)


def test_nodes(few, many, shots):
    """What the page of 400 shots would have, from two smaller ones."""
    of_a_shot = (many - few) / (shots[1] - shots[0])
    wanted = few + of_a_shot * (400 - shots[0])
    check(wanted < MOST_NODES, f"a page of 400 shots has {wanted:.0f} nodes, {of_a_shot:.0f} for each shot")


def test_matrix(page, folder, shots):
    """The matrix has pages; that of a shot which is chosen above is shown."""
    heads = "return [...document.querySelectorAll('#matrix thead tr:last-child th')].slice(1).map(th => th.title)"
    rows = rows_of(folder, "summary.csv", target="specular", metric="mse", mask="reflective")
    shown = page.execute_script(heads)
    equal(shown[:32] * 3, shown, "both errors and times of the first shots")
    choose_in(page, "results", "Shots of the matrix", f"97 to {shots}: room_96 to room_{shots - 1}")
    shown = page.execute_script(heads)
    equal(shown, [f"room_{i}.main.32x18" for i in range(96, shots)] * 3, "the last page")
    first = page.execute_script("return [...document.querySelectorAll('#matrix tbody tr')].map(r => [...r.querySelectorAll('button')].slice(0, arguments[0]).map(b => +b.dataset.value))", shots - 96)
    equal([v for of in zip(*first) for v in of], [float(r["value"]) for shot in shown[: shots - 96] for r in rows if r["shot"] == shot], "its values")
    page.find_elements(By.CSS_SELECTOR, "#answer-shots button")[40].click()
    check("room_40.main.32x18" in page.execute_script(heads), "the page of the chosen shot")
    box = page.find_element(By.CSS_SELECTOR, "#page-choice select")
    equal(Select(box).first_selected_option.text, "33 to 64: room_32 to room_63", "the box says so")


def test_charts(page, shots):
    """A chart is there when the reader is."""
    count = page.execute_script("return document.querySelectorAll('#scatter .pair').length")
    check(count < shots / 2, f"{count} pairs of charts before anybody looks")
    equal(page.execute_script("return document.getElementById('scatter').children.length"), shots, "places of charts")
    page.execute_script("document.getElementById('scatter').lastElementChild.scrollIntoView({block: 'center'})")
    last = f"document.querySelectorAll('#scatter [data-shot=\"room_{shots - 1}.main.32x18\"] .point').length"
    wait_for(page, f"{last} === 2 * {POINTS - 1}", "marks of the last shot")
    for section in ("roughness", "splits"):
        page.execute_script("document.getElementById(arguments[0]).scrollIntoView()", section)
        wait_for(page, "document.querySelectorAll(`#${arguments[0]} .point`).length > 0", f"marks of {section}", section)


def test_tables(page, folder, shots):
    """A table goes on where the reader does, and is saved whole."""
    expected = rows_of(folder, "summary.csv", target="specular", metric="mse", mask="reflective")
    equal(len(expected), shots * POINTS, "rows")
    page.execute_script("document.querySelector('#summary > details > summary').click()")
    rows = "document.querySelectorAll('#summary tbody tr:not(.later)').length"
    wait_for(page, f"{rows} >= 100", "the first rows")
    equal(page.execute_script("return document.querySelector('#summary tr.later').textContent").endswith(" more rows"), True, "the others are counted")
    before = page.execute_script(f"return {rows}")
    check(before < len(expected) / 2, f"{before} rows before anybody scrolls")
    page.execute_script("document.querySelector('#summary tr.later').scrollIntoView()")
    wait_for(page, f"{rows} > arguments[0]", "further rows", before)
    page.execute_script("document.querySelector('#summary th:nth-child(4) button').click()")
    least = sorted(float(r["value"]) for r in expected)[:50]
    equal(values(page, "#summary tbody tr:nth-child(-n + 50) td:nth-child(4)"), least, "rows sorted by value, over those that are not there yet")
    page.execute_script(CATCH_SAVES + "window.saved = async blob => { window.lines = (await blob.text()).trim().split('\\n').length; }")
    page.execute_script("[...document.querySelectorAll('#summary button')].find(b => b.textContent === 'Save table').click()")
    wait_for(page, f"window.lines === {1 + len(expected)}", "lines of the saved table")


def test_choices(page):
    """A choice of one section leaves the others as they are."""
    page.execute_script("window.kept = document.querySelector('#matrix table')")
    choose_in(page, "stages", "Bars show", "shares of each point's total")
    check(page.execute_script("return document.querySelector('#matrix table') === window.kept"), "stages' bars draw the matrix anew")
    page.execute_script("document.getElementById('filter').value = 'preset_7'; document.getElementById('filter').dispatchEvent(new Event('input'))")
    wait_for(page, "document.querySelectorAll('#matrix tbody tr').length === 1", "the filter")


def test_printing(page, shots):
    """Paper gets all."""
    page.execute_script("dispatchEvent(new Event('beforeprint'))")
    equal(page.execute_script("return document.querySelectorAll('.later, details:not([open])').length"), 0, "parts that are still to be made")
    equal(page.execute_script("return document.querySelectorAll('#scatter .pair').length"), shots, "pairs of charts")


def main():
    shots = (40, 120)
    folder = lambda: tempfile.TemporaryDirectory(prefix="ssrlab_report_")  # noqa: E731
    with folder() as paper, folder() as few, folder() as many, tempfile.TemporaryDirectory(prefix="ssrlab_chromium_") as profile:
        page = open_browser(profile)
        try:
            open_report(page, paper, 10)  # more than are made at once
            test_printing(page, 10)
            of_few = open_report(page, few, shots[0])
            test_nodes(of_few, open_report(page, many, shots[1]), shots)
            test_matrix(page, many, shots[1])
            test_charts(page, shots[1])
            test_tables(page, many, shots[1])
            test_choices(page)
            equal([e["message"] for e in page.get_log("browser")], [], "console messages")
        finally:
            page.quit()


main()
