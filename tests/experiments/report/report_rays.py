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
            lines.setdefault((r["technique"], r["point"], r["stage"], r["frame"]), {})[r["quantity"]] = r
        return lines

    def expect(shot, mask):
        page.execute_script("document.querySelectorAll('#hits details').forEach(d => { d.open = true })")
        lines, shown = lines_of(shot, mask), table_of(page, part_of(shot) + " table")
        has_frames = len({key[3] for key in lines}) > 1
        equal(len(shown), len(lines), f"rows of rays: {shot}, {mask}")
        for cells, ((technique, point, stage, frame), by) in zip(shown, lines.items()):
            equal(cells[0][0], f"{technique} · {point}", "the point")
            equal(cells[1][0], stage.split("/")[1] + (f", frame {frame}" if has_frames else ""), "the pass")
            numbers = [None if cells[i][1] in (None, "undefined", "null") else float(cells[i][1]) for i in (2, 3, 4, 5)]
            distance = by.get("distance_error")
            expected = [float(by["correct"]["value"]), float(distance["value"]) if distance else None]
            equal(numbers, expected + [float(by["fetches"]["value"]), float(by["correct"]["rays"])], f"numbers of {point}, {stage}")
            ends = [float(x) for x in cells[2][0].split("[")[1].split("]")[0].split(",")]
            for end, name in zip(ends, ("low", "high")):  # rounded to a tenth
                check(abs(end - 100 * float(by["correct"][name])) < 0.0501, f"interval of {point}: {cells[2][0]}")
            misses = [f"{name} {100 * float(by['miss: ' + name.replace(' ', '_')]['value']):.3g} %" for name in ("off screen", "too thick")]
            equal(cells[6][0], ", ".join(misses), "avoidable misses, the most frequent first")
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
    rows = [r for r in rows_of(folder, "hits.csv", shot=shot, stage="error") if r["point"] in ("first", "fixed")]
    equal(len(rows), 10, "shares of two points")
    part = f"#error-shares details[data-shot='{shot}']"
    page.execute_script("document.querySelectorAll('#error-shares details').forEach(d => { d.open = true })")
    bars = page.execute_script(
        "return [...document.querySelectorAll(arguments[0] + ' .bar')].map(b => [b.dataset.verdict, +b.dataset.share, +b.dataset.value])", part
    )
    errors = {r["point"]: float(r["value"]) for r in rows_of(folder, "summary.csv", shot=shot, metric="mse", technique="sssr")}
    order = ["right", "unavoidable_miss", "empty", "avoidable_miss", "wrong_place"]
    rows.sort(key=lambda r: (r["point"] != "first", order.index(r["quantity"].split()[1])))
    equal([b[:2] for b in bars], [[r["quantity"].split()[1], float(r["value"])] for r in rows], "shares by verdict")
    for (_, share, value), row in zip(bars, rows):
        expected = share * errors[row["point"]]
        check(abs(value - expected) < 1e-12 * expected, f"a part's length is {value}, not {expected}")
    test_why(page, folder, shot, part, errors)


def test_why(page, folder, shot, part, errors):
    """The sentence of a bar, of a sentence below, of the first screen's question and, in short, of a cell."""
    scene, frame = shot.split(".")[0], rows_of(folder, "hits.csv", shot=shot, stage="error")[0]["frame"]
    rays = rows_of(folder, "hits.csv", shot=shot, point="first", mask="reflective", frame=frame)
    missed = [[float(r["value"]) for r in rays if r["quantity"] == q] for q in ("avoidable_miss", "miss: off_screen", "miss: too_thick")]
    equal([len(m) for m in missed], [2, 2, 2], "two passes of as many rays")
    missed, off_screen, too_thick = (f"{100 * sum(m) / 2:.2g} %" for m in missed)
    ours, least, more, less, ratio = page.execute_script(
        "return arguments[0].map(([value, digits]) => number(value, digits))",
        [(errors["first"], 3), (errors["fixed"], 3), (0.375 * errors["first"], 2), (0.125 * errors["fixed"], 2), (errors["first"] / errors["fixed"], 3)],
    )
    wanted = (
        f"sssr · first in {scene}, frame {frame}: 38 % of its error lies where rays missed what the screen shows, "
        "25 % where rays hit the wrong place, 19 % where the truth is not on the screen, 13 % where rays were right (filter, fallback, "
        f"view dependence), 6.3 % where nothing is there to be hit. {missed} of its rays missed what the screen shows: {off_screen} left the screen, "
        f"{too_thick} went too far behind a surface. Its mse, {ours}, is {ratio} times the least (sssr · fixed, {least}). "
        f"The largest part of the difference lies where rays missed what the screen shows: {more} against {less}. Its\u00a0rays Its\u00a0images"
    )
    text = "return document.querySelector(arguments[0]).textContent"
    page.execute_script("document.querySelector(arguments[0] + ' .bar').dispatchEvent(new Event('click'))", part)
    equal(page.execute_script(text, part + " .why"), wanted, "what a click on a bar says")
    equal(page.execute_script(text, part + " li"), wanted, "the same in the list")
    choose = "[...document.querySelectorAll('#answer-shots button')].find(b => b.title.startsWith(arguments[0])).click()"
    first = page.execute_script("return answerChoice.shot")
    page.execute_script("return choosePoint({technique: 'sssr', point: 'first'})")
    page.execute_script(choose, shot)
    causes = ["63 %rays were wrong", "38 %rays missed what the screen shows", "25 %rays hit the wrong place",
              "25 %the screen does not show it", "19 %the truth is not on the screen", "6.3 %nothing is there to be hit",
              "13 %rays were right (filter, fallback, view)"]
    said = page.execute_script(text, "#why-answer")
    check(said.startswith(f"Its squared error: sssr · first in {scene}, frame {frame}" + "".join(causes)),
          f"the first screen's answer, kept from shot to shot: {said}")
    page.execute_script("document.querySelectorAll('#hits details.shot').forEach(d => { d.open = false })")
    page.execute_script("document.querySelector('#why-answer a').click()")
    parts = page.execute_script("return [...document.querySelectorAll('#hits details.shot[open]')].map(d => [d.dataset.shot, d.getBoundingClientRect().top])")
    equal([p[0] for p in parts], [shot], "the rays that its link opens")
    check(abs(parts[0][1]) < 5, f"they are {parts[0][1]} pixels from the top")
    page.execute_script(choose, first)
    tips = page.execute_script("return [...document.querySelectorAll('#matrix button:not(.time)')].map(b => b.getAttribute('aria-label'))")
    short = "why (mse): 38 % of its error lies where rays missed what the screen shows, 25 % where rays hit the wrong place"
    check(any(shot in t and "sssr · first" in t and short in t for t in tips), f"no cell says why: {tips}")
