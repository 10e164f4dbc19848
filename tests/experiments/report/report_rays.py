"""What the section on rays of a report shows, against hits.csv."""

from report_browser import check, choose_in, equal, rows_of, table_of


def test_rays(page, folder, shot_of_frames):
    verdicts = ("right", "unavoidable_miss", "empty", "avoidable_miss", "wrong_place", "false_hit")

    def shown_rows():
        return table_of(page, "#hit-table")

    def lines_of(shot, mask):
        """What hits.csv has of each point, frame and pass, in its order."""
        lines = {}
        for r in rows_of(folder, "hits.csv", shot=shot, mask=mask):
            lines.setdefault((r["variant"], r["point"], r["stage"], r["frame"]), {})[r["quantity"]] = r
        return lines

    def expect(shot, mask):
        lines, shown = lines_of(shot, mask), shown_rows()
        has_frames = len({key[3] for key in lines}) > 1
        equal(len(shown), len(lines), f"rows of rays: {shot}, {mask}")
        for cells, ((variant, point, stage, frame), by) in zip(shown, lines.items()):
            equal(cells[0][0], f"{variant} · {point}", "the point")
            equal(cells[1][0], stage.split("/")[1] + (f", frame {frame}" if has_frames else ""), "the pass")
            numbers = [None if cells[i][1] in (None, "undefined", "null") else float(cells[i][1]) for i in (3, 4, 5, 6)]
            distance = by.get("distance_error")
            expected = [float(by["correct"]["value"]), float(distance["value"]) if distance else None]
            equal(numbers, expected + [float(by["fetches"]["value"]), float(by["correct"]["rays"])], f"numbers of {point}, {stage}")
            ends = [float(x) for x in cells[3][0].split("[")[1].split("]")[0].split(",")]
            for end, name in zip(ends, ("low", "high")):  # rounded to a tenth
                check(abs(end - 100 * float(by["correct"][name])) < 0.0501, f"interval of {point}: {cells[3][0]}")
            told = [f"{name} {100 * float(by['miss: ' + name.replace(' ', '_')]['value']):.3g} %" for name in ("off screen", "too thick")]
            equal(cells[7][0], ", ".join(told), "avoidable misses, the most frequent first")
        bars = page.execute_script(
            """return [...document.querySelectorAll('#hit-table .shares')].map(bar =>
            [[...bar.children].map(part => parseFloat(part.style.width)), bar.getAttribute('aria-label')])"""
        )
        for (widths, label), by in zip(bars, lines.values()):
            equal(widths, [100 * float(by[v]["value"]) for v in verdicts], "a bar's parts")
            check(abs(sum(widths) - 100) < 1e-3, f"a bar is whole: {widths}")
            check(label.startswith(f"right {100 * float(by['right']['value']):.3g} %"), f"what a bar is read as: {label}")

    shots = list(dict.fromkeys(r["shot"] for r in rows_of(folder, "hits.csv")))
    expect(shots[0], "reflective")
    choose_in(page, "hits", "Mask", "all")
    expect(shots[0], "all")
    choose_in(page, "hits", "Shot", shot_of_frames)
    expect(shot_of_frames, "all")
    legend = page.execute_script("return [...document.querySelectorAll('#hits .legend .swatch')].map(s => s.style.background)")
    parts = page.execute_script(
        "return [...document.querySelector('#hit-table .shares').children].map(part => part.style.background)"
    )
    equal(legend, parts, "colours of the legend and of the bars")
    equal(len(set(legend)), 6, "a colour for each verdict")
