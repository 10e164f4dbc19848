"""What figures and tables are made of, without results: names beside marks, the best, crops, exposures, texts, pages.

usage: figure_parts_test.py
"""

from figures_start import check, outside, request_of

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.text import Text
from ssrlab.figures import crops, style
from ssrlab.figures.lines import draw_lines
from ssrlab.figures.placed_labels import place_labels
from ssrlab.figures.summary_picture import Mark, Panel, Picture, draw, front_of
from ssrlab.results import Measured
from ssrlab.tables.cell import Cell
from ssrlab.tables.latex import latex


def test_crop_boxes():
    error = np.zeros((40, 60))
    error[20:24, 50:55] = 2.0
    error[2:6, 3:6] = 1.0
    first, second = crops.crop_boxes(error, 2)
    check(
        first[0] <= 50 and first[0] + first[2] >= 55 and first[1] <= 20 and first[1] + first[3] >= 24,
        f"the worst place is not in {first}",
    )
    check(
        second[0] <= 3 and second[0] + second[2] >= 6 and second[1] <= 2 and second[1] + second[3] >= 6,
        f"the second worst is not in {second}",
    )


def test_fronts():
    """The points that no cheaper one beats are joined, in the order of their times."""
    marks = [Mark("t", "black", "o", Cell("", "", "", error, 0.9 * error, 1.1 * error), x=Cell("", "", "", time)) for time, error in ((4, 0.2), (1, 0.5), (2, 0.6), (3, 0.3))]
    check([m.x.value for m in front_of(marks)] == [1, 3, 4], "2 ms err more than 1 ms")
    figure = draw(Picture([Panel("rooms", [("t", marks)], 1.0)], "ms", kind="fronts", steps=(0.5, 1)), style.WIDTHS["slide"])
    joined = next(line for line in figure.axes[0].lines if line.get_label() == "t")
    check(list(joined.get_ydata()) == [0.5, 0.3, 0.2], "the front")


def test_file_names():
    """Names of glTF cameras, which shots are called by, hold what no file name may, or are longer than one."""
    check(style.file_name("crops_fence.low.160x90") == "crops_fence.low.160x90", "a name that needs no change")
    check(style.file_name("crops_a/b c") == "crops_a-b-c", "letters that no file name has")
    long = [style.file_name("c" * 300 + end) for end in "12"]
    check(len(long[0]) == 150 and long[0] != long[1], f"long names: {long}")


def test_wrapped():
    """Titles stay within their panel: no line is longer than asked, and no letter is lost but spaces."""
    for text, longest, expected in (
        ("fence.main.160x90", 22, "fence.main.160x90"),
        ("contact_hardening.main.320x184.w24", 22, "contact_hardening.main\n.320x184.w24"),
        ("breakfast_room_glossy_floor.near.320x184", 22, "breakfast_room_glossy_\nfloor.near.320x184"),
        ("amd_sssr repeatable misses=fallback", 22, "amd_sssr repeatable\nmisses=fallback"),
        ("x" * 30 + " y", 22, "x" * 30 + "\ny"),
    ):
        check(style.wrapped(text, longest) == expected, f"{text} becomes {style.wrapped(text, longest)!r}")


def test_fitted():
    """Lines are no wider than asked, even of wide letters and of names without a place to break; no letter is lost but spaces."""
    style.apply()
    for text in ("mcguire_dda dda.stride=1 dda.thickness=0.05", "W" * 40, "none\n(1 seed)", "MMMM_MMMM.WWWW=" * 4):
        lines = style.fitted(text, 3.0).split("\n")
        check(max(map(style.text_width, lines)) <= 3.0, f"{text} becomes {lines}")
        check("".join(lines).replace(" ", "") == text.replace(" ", "").replace("\n", ""), f"{text} becomes {lines}")


def test_titles_stay_inside():
    """Titles and labels neither leave the picture nor meet those of the panel beside them."""
    style.apply()
    figure, grid = style.panels(4, request_of("", width=style.WIDTHS["page"]), most_columns=2)
    for axes in grid:
        axes.set_title("breakfast_room_glossy_floor.Camera.001.1920x1080.f20-35.w12.another_setting_with_a_long_name")
        axes.set_xlabel("roughness of a name that is longer than any panel of two is wide, even on a page of a paper")
        axes.set_ylabel("root mean squared error of what is seen, over the limit")
    height = figure.get_figheight()
    style.lay_out(figure)
    check(outside(figure) == [], f"{outside(figure)} leave the picture")
    for of_panel in (lambda a: a.title, lambda a: a.xaxis.label):
        left, right = (of_panel(axes).get_window_extent() for axes in grid[:2])
        check(left.x1 < right.x0, "texts of two panels meet")
    check(figure.get_figheight() > height, "the panels lose what the lines need")
    plt.close(figure)


def test_values_not_above_zero():
    """Lines of which a logarithmic axis leaves out values say so."""
    lines = [(0, Measured(1.0, 0.9, 1.1)), (1, Measured(-0.1, -0.2, 0.0))]
    for points, is_log, expected in ((2, True, [style.NOT_POSITIVE_NOTE]), (2, False, []), (1, True, [])):
        figure, axes = plt.subplots()
        draw_lines(axes, {"sssr": lines[:points]}, ["sssr"], is_log)
        check([t.get_text() for t in axes.texts] == expected, f"{points} values, logarithmic: {is_log}")
        plt.close(figure)


def test_labels_do_not_overlap():
    """Names of crowded points lie within their panel, on none of the others and on no mark; where there is no room there are none."""
    style.apply()
    random = np.random.default_rng(1)
    for count, has_room in ((10, True), (60, False)):
        figure, axes = plt.subplots(figsize=(3.3, 2.6), layout="constrained")
        places = random.uniform(0.7, 1.0, (count, 2))  # in a corner, which no label may leave
        axes.plot(*places.T, "o")
        axes.set(xlim=(0, 1), ylim=(0, 1))
        placed = place_labels(axes, [(x, y, f"point {i}", "black") for i, (x, y) in enumerate(places)])
        check(placed == has_room and len(axes.texts) == count * has_room, f"{count} labels: {placed}, {len(axes.texts)} drawn")
        figure.draw_without_rendering()
        renderer = figure.canvas.get_renderer()
        boxes = [Text.get_window_extent(t, renderer) for t in axes.texts]
        marks = axes.transData.transform(places)
        frame = axes.get_window_extent()
        for i, box in enumerate(boxes):
            check(not any(box.overlaps(other) for other in boxes[:i]), f"label {i} lies on another")
            check(not any(box.contains(*mark) for mark in marks), f"label {i} lies on a mark")
            check(box.x0 >= frame.x0 and box.x1 <= frame.x1 and box.y0 >= frame.y0 and box.y1 <= frame.y1, f"label {i} leaves the panel")
        plt.close(figure)


def test_exposure():
    """The brightest percent begins just below white, whatever the few brightest pixels are."""
    truth = np.full((10, 100, 3), 0.2, np.float32)
    truth[:, 50:] = 3.0
    truth[0, :3] = 1000.0
    exposure = crops.auto_exposure(truth)
    check(0.75 < 3.0 * 2**exposure <= 0.95, f"{exposure} EV")  # steps of a quarter EV below 0.95
    check(crops.auto_exposure(np.zeros((4, 4, 3))) == 0.0, "a black image")


def test_long_tables():
    """What a page has no room for becomes several tables that together have every row once."""
    entry = {"name": "long", "caption": "Many points", "of": "results", "over": "shot", "labels": {}}
    for columns, most in (("a", 45), ("abcdefgh", 22)):  # those with many columns have two lines in each row
        cells = [Cell("long", f"point {i}", c, 1.0, 0.5, 2.0) for i in range(100) for c in columns]
        pages = latex(entry, cells, "made up").split(r"\begin{table")[1:]
        rows = [[line.split(" & ")[0] for line in page.split("\n") if line.startswith("point")] for page in pages]
        check(max(map(len, rows)) <= most and min(map(len, rows)) >= most // 2, f"{[len(r) for r in rows]} rows in pages")
        check(sum(rows, []) == [f"point {i}" for i in range(100)], "rows are missing")
        check(all(rf"\caption{{Many points ({i} of {len(pages)})}}" in page for i, page in enumerate(pages, 1)), pages)
        check([r"\label{tab:long}" in page for page in pages] == [True] + [False] * (len(pages) - 1), pages)


test_crop_boxes()
test_fronts()
test_file_names()
test_wrapped()
test_fitted()
test_titles_stay_inside()
test_values_not_above_zero()
test_labels_do_not_overlap()
test_exposure()
test_long_tables()
