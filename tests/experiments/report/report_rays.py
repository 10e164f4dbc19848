"""What the sections on rays, and on where errors lie, show against hits.csv."""

from report_browser import check, choose_in, equal, rows_of, table_of


def test_rays(page, folder, shot_of_frames):
    verdicts = ("right", "unavoidable_miss", "empty", "avoidable_miss", "wrong_place", "false_hit")

    def part_of(shot):
        return f"#hits details[data-shot='{shot}']"

    def lines_of(shot, mask):
        """What hits.csv has of each point, frame and pass, in its order."""
        lines = {}
        for r in rows_of(folder, "hits.csv", shot=shot, mask=mask):
            if r["stage"] == "error":
                continue
            lines.setdefault((r["variant"], r["point"], r["stage"], r["frame"]), {})[r["quantity"]] = r
        return lines

    def expect(shot, mask):
        page.execute_script("document.querySelectorAll('#hits details').forEach(d => { d.open = true })")
        lines, shown = lines_of(shot, mask), table_of(page, part_of(shot) + " table")
        has_frames = len({key[3] for key in lines}) > 1
        equal(len(shown), len(lines), f"rows of rays: {shot}, {mask}")
        for cells, ((variant, point, stage, frame), by) in zip(shown, lines.items()):
            equal(cells[0][0], f"{variant} · {point}", "the point")
            equal(cells[1][0], stage.split("/")[1] + (f", frame {frame}" if has_frames else ""), "the pass")
            numbers = [None if cells[i][1] in (None, "undefined", "null") else float(cells[i][1]) for i in (2, 3, 4, 5)]
            distance = by.get("distance_error")
            expected = [float(by["correct"]["value"]), float(distance["value"]) if distance else None]
            equal(numbers, expected + [float(by["fetches"]["value"]), float(by["correct"]["rays"])], f"numbers of {point}, {stage}")
            ends = [float(x) for x in cells[2][0].split("[")[1].split("]")[0].split(",")]
            for end, name in zip(ends, ("low", "high")):  # rounded to a tenth
                check(abs(end - 100 * float(by["correct"][name])) < 0.0501, f"interval of {point}: {cells[2][0]}")
            told = [f"{name} {100 * float(by['miss: ' + name.replace(' ', '_')]['value']):.3g} %" for name in ("off screen", "too thick")]
            equal(cells[6][0], ", ".join(told), "avoidable misses, the most frequent first")
        bars = page.execute_script(
            "return [...document.querySelectorAll(arguments[0] + ' .bar')].map(b => [+b.dataset.value, b.getAttribute('aria-label')])",
            part_of(shot),
        )
        shares = [float(by[v]["value"]) for by in lines.values() for v in verdicts]
        equal([b[0] for b in bars], shares, "parts of the bars")
        first = next(iter(lines.values()))["right"]
        check(f"right: {100 * float(first['value']):.3g} % of its rays [" in bars[0][1], f"what a part is read as: {bars[0][1]}")

    shots = list(dict.fromkeys(r["shot"] for r in rows_of(folder, "hits.csv")))
    expect(shots[0], "reflective")
    choose_in(page, "hits", "Mask", "all")
    expect(shots[0], "all")
    expect(shot_of_frames, "all")
    legend = page.execute_script("return [...document.querySelectorAll('#hits .legend .swatch')].map(s => s.style.background)")
    parts = page.execute_script(
        """const swatch = document.createElement('i');
        return [...document.querySelectorAll('#hits .bar')].slice(0, 6).map(b => {
            swatch.style.background = b.getAttribute('fill');
            return swatch.style.background;
        })"""
    )
    equal(legend, parts, "colours of the legend and of the bars")
    equal(len(set(legend)), 6, "a colour for each verdict")


def test_error_shares(page, folder, shot):
    """Bars as long as the error, and their sentences."""
    rows = [r for r in rows_of(folder, "hits.csv", shot=shot, stage="error") if r["point"] in ("first", "mended")]
    equal(len(rows), 8, "shares of two points")
    part = f"#error-shares details[data-shot='{shot}']"
    page.execute_script("document.querySelectorAll('#error-shares details').forEach(d => { d.open = true })")
    bars = page.execute_script(
        "return [...document.querySelectorAll(arguments[0] + ' .bar')].map(b => [b.dataset.verdict, +b.dataset.share, +b.dataset.value])", part
    )
    errors = {r["point"]: float(r["value"]) for r in rows_of(folder, "summary.csv", shot=shot, metric="mse", variant="sssr")}
    order = ["right", "unavoidable_miss", "empty", "wrong_place"]
    rows.sort(key=lambda r: (r["point"] != "first", order.index(r["quantity"].split()[1])))
    equal([b[:2] for b in bars], [[r["quantity"].split()[1], float(r["value"])] for r in rows], "shares by verdict")
    for (_, share, value), row in zip(bars, rows):
        expected = share * errors[row["point"]]
        check(abs(value - expected) < 1e-12 * expected, f"a part's length is {value}, not {expected}")
    sentences = page.execute_script("return [...document.querySelectorAll(arguments[0] + ' li')].map(l => l.textContent)", part)
    wanted = (
        "Of sssr · first's error 37.5 % lies where the truth is not on the screen, 50 % where the march erred, "
        "12.5 % where the ray was right (filter, fallback, view dependence)."
    )
    check(wanted in sentences, f"{wanted!r} is not among {sentences}")
