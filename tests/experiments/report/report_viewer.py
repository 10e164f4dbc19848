"""What a reader does with the images of the made-up report: zoom, flip, expose, read values, look at errors."""

from report_browser import (
    By,
    Select,
    canvas,
    check,
    choose,
    equal,
    pane_count,
    pixels,
    srgb_code,
    webdriver,
)
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.support.ui import WebDriverWait


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
