"""What the report shows of `ssrlab stability`, against its CSV files."""

import csv
import os

from report_browser import By, check, choose_in, equal, rows_of, table_of

VERDICTS = ["ok", "worse", "out of range", "non-finite inside", "spreads", "refused"]


def shown_cell(page):
    """The heading of the chosen cell, and its numbers by name."""
    heading = page.find_element(By.CSS_SELECTOR, "#stability-cell b").text
    numbers = {c[0][0]: c[1][1] for c in table_of(page, "#stability-cell table")}
    return heading, numbers


def part_of(page, title):
    """The rows of the table below a heading, as texts."""
    return page.execute_script(
        """const part = [...document.querySelectorAll('#stability-tables h3')].find(h => h.textContent === arguments[0]);
        return [...part.parentElement.querySelector('tbody').rows].map(tr => [...tr.cells].map(td => td.textContent))""",
        title,
    )


def test_stability(page, folder):
    rows = rows_of(folder, "stability.csv")
    counts = [sum(r["verdict"] == v for r in rows) for v in VERDICTS]
    check(all(counts), "the made-up run has each verdict")
    legend = page.find_element(By.ID, "stability-legend").text
    check(all(f"{v} ({n})" in legend for v, n in zip(VERDICTS, counts)), f"legend: {legend}")
    shapes = page.execute_script("return [...document.querySelectorAll('.matrix .verdict')].map(v => v.getAttribute('d'))")
    equal(sorted(shapes.count(s) for s in set(shapes)), sorted(counts), "marks of each shape")
    titles = page.execute_script("return [...document.querySelectorAll('.matrix text > title')].map(t => t.textContent)")
    with open(os.path.join(folder, "stability_cases.csv"), newline="") as file:
        equal(titles, [f"{c['case']}: {c['why']}" for c in csv.DictReader(file)], "reasons of cases")
    lead = page.find_element(By.ID, "stability-lead").text
    for part in ("20 runs of 4 techniques in 5 cases", "In 2 of them", "2 of the techniques hold none", "300 times"):
        check(part in lead, f"{part!r} is not in {lead!r}")
    check(lead.count("amd_sssr slides") == 2, f"what spreads, and what amplifies most: {lead}")

    spreads = next(r for r in rows if r["verdict"] == "spreads")
    heading, numbers = shown_cell(page)
    equal(heading, "amd_sssr · slides, bad hit lit nan: spreads", "what is shown at first")
    equal(float(numbers["Spread"]), float(spreads["spread_pixels"]), "pixels")
    worse = next(i for i, r in enumerate(rows) if r["verdict"] == "worse")
    page.execute_script("document.querySelector('.matrix').scrollIntoView({block: 'center'})")
    page.find_elements(By.CSS_SELECTOR, ".matrix .verdict")[worse].click()
    heading, numbers = shown_cell(page)
    equal(heading, "amd_sssr · slides, far away: worse", "the cell that was clicked")
    equal(float(numbers["Error / benign error"]), float(rows[worse]["error_ratio"]), "its ratio")
    choose_in(page, "stability", "Technique", "of_another_build")
    equal(shown_cell(page)[0], "of_another_build, far away: non-finite inside", "the cell that was chosen")

    failures = part_of(page, "Stages that are not finite")
    equal([f[1] for f in failures], ["amd_sssr/intersect: radiance", "of_another_build/trace: result"], "where they arise")
    check(len(failures[0][5]) > 10 and len(failures[0][6]) > 10, f"no operation or fix: {failures[0]}")
    equal(failures[1][5:], ["unexplained in 1", ""], "what nothing explains")
    equal(part_of(page, "Spread of bad inputs"), [["amd_sssr · slides", "12 +2"]], "spread")
    equal(
        part_of(page, "Amplification"),
        [[name, depth, "90000", "1", "20", "0", "3"] for name, depth in
         (("amd_sssr · slides", "300"), ("amd_sssr · corrected", "150"), ("of_another_build", "100"))],
        "amplification",
    )
