"""The page of `ssrlab diff`: a run beside another, in which one point has another image and another error."""

import csv
import json
import os
import shutil
import subprocess

from report_browser import By, check, equal, table_of, until_ready, wait_until
from report_crops import SHOT
from report_viewer import captions

POINT, RAISED = "stride=4", 0.5


def raise_error(folder, file):
    """In SHOT, of all seeds alike, so that chance has no part in it."""
    path = os.path.join(folder, file)
    with open(path, newline="") as text:
        rows = list(csv.DictReader(text))
    for row in rows:
        if (row["shot"], row["point"], row["target"], row["metric"]) == (SHOT, POINT, "specular", "mse"):
            row["value"] = repr(float(row["value"]) + RAISED)
    with open(path, "w", newline="") as text:
        writer = csv.DictWriter(text, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def other_run(folder, other):
    shutil.copytree(folder, other)
    for file in ("results.csv", "summary.csv"):
        raise_error(other, file)
    path = os.path.join(other, "manifest.json")
    with open(path) as file:
        manifest = json.load(file)
    own = [i for i in manifest["images"] if i["shot"] == SHOT and i.get("point") == POINT and i["target"] == "specular"]
    for image in own:
        image.update(exr=image["exr"].replace(POINT, "stride=1"), exr_hash="another")
    with open(path, "w") as file:
        json.dump(manifest, file)


def test_diff(page, program, folder, scratch):
    other, file = os.path.join(scratch, "<i>new</i>"), os.path.join(scratch, "diff.html")
    other_run(folder, other)
    out = subprocess.run([program, "--diff", folder, other, file], check=True, capture_output=True, text=True).stdout
    page.get("file://" + file)
    until_ready(page)
    lead = page.find_element(By.ID, "diff-lead").text
    check(lead.split(" errors")[0] in out and lead.endswith("images of 1 points differ."), f"{lead} {out}")
    check("new: " + other in page.find_element(By.ID, "subtitle").text, "the name of a folder is text")
    equal([e.text for e in page.find_elements(By.CSS_SELECTOR, ".diff-point h3")], [f"mcguire_dda · {POINT}, {SHOT}"], "points that differ")
    cells = table_of(page, ".diff-point .scroll")
    equal([c[0][0] for c in cells], ["mse"] * len(cells), "numbers that changed")
    for row in cells:
        check(abs(float(row[5][1]) - float(row[4][1]) - RAISED) < 1e-9 and row[8][0] == "changed", f"a number and its verdict: {row}")
    equal(str(len(cells)), lead.split()[0], "how many there are")
    page.execute_script("document.querySelector('.diff-point').scrollIntoView()")
    wait_until(page, lambda p: len(p.find_elements(By.CSS_SELECTOR, ".diff-pictures canvas")) == 3, "its pictures")
    sums = page.execute_script(
        """return [...document.querySelectorAll('.diff-pictures canvas')].map(c =>
        c.getContext('2d').getImageData(0, 0, c.width, c.height).data.reduce((a, b) => (a * 31 + b) % 1e9))"""
    )
    equal(len(set(sums)), 3, "old, new and their difference look different")
    page.find_element(By.CSS_SELECTOR, ".diff-pictures canvas").click()
    wait_until(page, lambda p: len(captions(p)) == 3, "both in the viewer")
    equal(captions(page), ["truth, old", f"mcguire_dda · {POINT}, old", f"mcguire_dda · {POINT}, new"], "what the viewer shows")
    largest = page.execute_script(
        """const [, a, b] = viewer.shown.map(s => s.image);
        return [baseOf(viewer.shown[2].method) === a, Math.max(...scalarsOf(b, a, 'absolute'))]"""
    )
    check(largest[0] and largest[1] > 0.1, f"the new run is compared with the old one: {largest}")
