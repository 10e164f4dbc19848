"""What the report's section on effects shows against effects.csv and time_effects.csv."""

import math

from report_browser import By, check, choose_in, equal, rows_of, table_of, values

RACING = "first race=true"


def mean_ratio(rows, point):
    ratios = [float(r["ratio"]) for r in rows if r["point"] == point]
    return math.exp(sum(math.log(r) for r in ratios) / len(ratios)), min(ratios), max(ratios)


def test_effects(page, folder, stepping_shot):
    relative, absolute, bias_squared, variance = (
        rows_of(
            folder,
            "effects.csv",
            target="specular",
            metric=metric,
            mask="reflective",
            against_point="first",
            technique="sssr",
        )
        for metric in ("relmse", "mse", "bias_squared", "variance")
    )
    rows = relative
    points = ["first float_histories=true", "first round_up_tiles=true", RACING, "fixed", "lucky"]
    shown = table_of(page, "#effect-table")[:-1]
    equal(
        [c[0][0].split("\n")[0] for c in shown],
        ["float_histories = true", "round_up_tiles = true", "race = true", "sssr · fixed", "One lucky seed"],
        "changes",
    )
    equal(shown[0][0][0].split("\n")[1], "keeps <b>32</b> bits & drifts less", "what the parameter means, as text")
    for cells, point in zip(shown, points):
        for cell, ratios in zip(cells[2:6], (relative, absolute, bias_squared, variance)):
            if (point, ratios) == ("fixed", bias_squared):
                equal(cell, ["–", "null"], "the bias² of a point that has none")
                continue
            if point == "lucky" and ratios in (bias_squared, variance):
                equal(cell, ["–", "null"], "parts of the error of one seed")
                continue
            mean, least, largest = mean_ratio(ratios, point)
            check(abs(float(cell[1]) - mean) < 1e-12 * mean, f"mean ratio of {point}: {cell}, expected {mean}")
            shown_range = [float(x) for x in cell[0].split("(")[1].rstrip(")").split(" to ")]
            check(  # three digits are shown
                all(abs(a - b) <= 5.1e-3 * b for a, b in zip(shown_range, (least, largest))),
                f"range over shots of {point}: {cell[0]}, expected {least} to {largest}",
            )
        helped = [
            r
            for r in rows
            if r["point"] == point and r["p_holm"] and float(r["p_holm"]) < 0.05 and float(r["ratio"]) < 1
        ]
        equal([int(cells[i][1]) for i in (7, 8, 9)], [len(helped), 0, 7], f"shots that {point} helps, harms, and all")
        times = rows_of(folder, "time_effects.csv", point=point, against_point="first", stage="total")
        equal(len(times), 7 if point == "fixed" else 0, f"times of {point}")
        if times:
            mean, _, _ = mean_ratio(times, point)
            check(abs(float(cells[6][1]) - mean) < 1e-12 * mean, f"mean ratio of times: {cells[6]}, expected {mean}")
    choose_in(page, "effects", "Shot", stepping_shot)
    for cells, point in zip(table_of(page, "#effect-table"), points):
        row = next(r for r in rows if r["point"] == point and r["shot"] == stepping_shot)
        equal(float(cells[2][1]), float(row["ratio"]), f"ratio of {point}")
        for cell, ratios in zip(cells[3:6], (absolute, bias_squared, variance)):
            other = next((r for r in ratios if r["point"] == point and r["shot"] == stepping_shot), None)
            if other is None:
                equal((point, cell[0]), ("lucky", "–"), "a ratio that there is none of")
                continue
            equal(cell[1], other["ratio"] or "null", f"ratio of {other['metric']} of {point}")
            equal("[" in cell[0], other["low"] != "", f"whether that ratio has an interval: {cell[0]}")
        equal("[" in cells[2][0], row["low"] != "", f"whether the ratio of {point} has an interval")
        times = rows_of(folder, "time_effects.csv", point=point, against_point="first", stage="total", shot=stepping_shot)
        if times:
            low, high = (float(x) for x in cells[6][0].split("[")[1].rstrip("]").split(","))
            expected = [float(times[0][k]) for k in ("low_holm", "high_holm")]
            check(
                all(abs(a - b) <= 5.1e-4 * b for a, b in zip((low, high), expected)),
                f"interval of the ratio of times: {cells[6][0]}, expected {expected}",
            )
        equal(cells[7][1] == "null", row["p_holm"] == "", f"whether {point} has a p")
        is_significant = row["p_holm"] and float(row["p_holm"]) < 0.05
        result = (
            "not repeatable"
            if point == RACING
            else "undecided" if point == "lucky" else "less error" if is_significant else "changes nothing"
        )
        check(result in cells[9][0], f"result of {point}: {cells[9][0]!r}, expected {result!r}")
    marks = values(page, "#effect-table .point")
    equal(
        marks,
        [float(r["ratio"]) for p in points for r in rows if r["point"] == p and r["shot"] == stepping_shot],
        "marks of a shot",
    )
    racing = page.execute_script(
        """const row = document.querySelectorAll('#effect-table tbody tr')[arguments[0]];
        const mark = row.querySelector('.point');
        return [row.querySelectorAll('g[stroke-width="1.5"] line').length, mark.getAttribute('fill'),
            row.querySelector('.not-repeatable').textContent, mark.getAttribute('aria-label').includes('it races')]""",
        points.index(RACING),
    )
    equal(racing, [0, "var(--card)", "no interval: it races", True], "a hollow mark without interval, and why")
    whiskers = page.execute_script("return document.querySelectorAll('#effect-table g[stroke-width=\"1.5\"] line').length")
    check(whiskers > 0, "the other marks have intervals")
    choose_in(page, "effects", "Scale", "0.91 to 1.1")
    arrows = page.execute_script(
        "return [...document.querySelectorAll('#effect-table text.point')].map(t => t.textContent)"
    )
    equal(arrows, ["◀"] * 4, "ratios beyond the scale")
    for metric, point, reason in (
        ("settling_length", "sssr · fixed", "no value for fixed: not within the first half of 15 frames"),
        ("ghost_length", "round_up_tiles = true", "an error is not above 0"),
        ("bias_squared", "sssr · fixed", "bias² is not above 0"),
    ):
        options = page.find_elements(By.XPATH, "//section[@id='effects']//label[starts-with(., 'Metric')]//option")
        choose_in(page, "effects", "Metric", next(o.text for o in options if o.text.startswith(metric)))
        row = next(c for c in table_of(page, "#effect-table") if c[0][0].split("\n")[0] == point)
        equal(row[-1][0], reason, f"why {point} has no ratio of {metric}")
    choose_in(page, "effects", "Metric", next(o.text for o in options if o.text.startswith("mse")))
    note = page.find_element(By.ID, "effect-family").text
    check(note.startswith("Exploratory") and "relmse of specular, reflective" in note, f"what mse stands for: {note}")
    choose_in(page, "effects", "Scale", "all ratios")
    filled = page.execute_script(
        """return [...document.querySelectorAll('#effect-table .point')].filter(
        p => p.getAttribute('fill') !== 'var(--card)' && p.tagName !== 'text').length"""
    )
    chosen = dict(target="specular", metric="mse", mask="reflective", shot=stepping_shot)
    rows = rows_of(folder, "effects.csv", technique="sssr", against="baseline", **chosen)
    verdicts = [r["verdict"] for r in rows]
    equal(filled, sum(v in ("less", "more") for v in verdicts), "filled marks: the significant ones of the table")
    choose_in(page, "effects", "Against", "sssr with float_histories=false and otherwise the same")
    choose_in(page, "effects", "Metric", next(o.text for o in options if o.text.startswith("relmse")))
    quantity = dict(target="specular", metric="relmse", mask="reflective", shot=stepping_shot)
    expected = rows_of(folder, "effects.csv", against="float_histories=false", **quantity)
    equal([r["against_point"] for r in expected], ["first round_up_tiles=true"], "what is otherwise the same")
    shown = table_of(page, "#effect-table")[:-1]
    equal([(c[0][0], float(c[2][1])) for c in shown], [("sssr · fixed", float(expected[0]["ratio"]))], "its ratio")
