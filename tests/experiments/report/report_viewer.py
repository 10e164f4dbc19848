"""What a reader does with the images of the made-up report: choose, zoom, flip, split, expose, read values, look at errors
and their causes, cut crops out. Over 400 lines, as each step goes on from the page that the step before left."""

import json
import os

from report_browser import (
    By,
    Select,
    canvas,
    check,
    choose,
    choose_in,
    equal,
    pane_count,
    pixels,
    srgb_code,
    until_ready,
    wait_until,
    webdriver,
)
from report_crops import FIGURES_JSON, SHOT
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

OTHER_SHOT = "fence.low.160x90"
NAMES = ["truth", "none", "mcguire_dda · stride=1", "mcguire_dda · stride=4"]
FILES = ["reference", "none_default_0", "mcguire_dda_stride=1_0", "mcguire_dda_stride=4_0"]


def captions(page):
    return [c.text.lstrip("123456789\n ") for c in page.find_elements(By.CSS_SELECTOR, "#panes figcaption")]


def press(page, *keys):
    for key in keys:
        ActionChains(page).send_keys(key).perform()


def test_linked_zoom(page):
    equal(captions(page), NAMES, "panes")
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


def test_flip_and_split(page):
    side = [pixels(page, i) for i in range(4)]
    check(len(set(side)) == 4, "four images must look different")
    page.find_element(By.ID, "layout-flip").click()
    equal(pane_count(page), 1, "panes when flipping")
    seen = []
    for key, name in (("1", 0), ("3", 2), ("2", 1), (" ", 2), (" ", 1), ("n", 2), ("p", 1)):
        press(page, key)
        equal(captions(page), [NAMES[name]], f"what key {key!r} shows")
        seen.append(pixels(page, 0))
    equal((seen[3], seen[4]), (seen[1], seen[2]), "space must flip between the same two pictures")
    check(seen[1] != seen[2], "flipping changed nothing")
    press(page, "4", "1", "x")
    equal(captions(page), [f"{NAMES[0]} | {NAMES[3]}"], "the pair of the split")
    # Left of the split is one picture, right of it the other.
    where = [(0.1, 0.8), (0.9, 0.8)]
    at = lambda: [pixels(page, 0, *page.execute_script(
        "const c = document.querySelector('#panes canvas'); return [Math.floor(arguments[0] * c.width), Math.floor(arguments[1] * c.height)]", *w)) for w in where]
    halves = at()
    press(page, *["]"] * 11)  # to the right end
    equal(at()[0], halves[0], "the left of the split")
    left = at()
    press(page, *["["] * 21)
    right = at()
    equal([left[0], right[1]], halves, "both sides of the split")
    check(left[1] != right[1], "the split shows one picture")
    box = canvas(page, 0).rect
    ActionChains(page).move_to_element_with_offset(canvas(page, 0), -int(box["width"] / 2) + 2, 40).click_and_hold().move_by_offset(
        int(0.3 * box["width"]), 0
    ).release().perform()
    place = page.execute_script("return [viewer.splitAt, +at('split-at').value]")
    check(abs(place[0] - 0.3) < 0.02 and abs(place[1] - 30) < 2, f"dragging the split by 0.3 of the width puts it at {place}")
    press(page, "s")
    equal([pixels(page, i) for i in range(4)], side, "side by side again")


def test_exposure_and_tone_curves(page):
    before = pixels(page, 0, 100, 30)
    value = page.execute_script("return pixelRgb(viewer.shown[0].image, 30 * viewer.shown[0].image.width + 100)")

    def shown(exposure, curve):
        page.execute_script(
            "setExposure(arguments[0]); viewer.curve = arguments[1]; paint();"
            "Object.assign(view, {x: 100.5 / 160, y: 30.5 / 90, zoom: 32}); drawAll()", exposure, curve
        )
        middle = page.execute_script("const c = document.querySelector('#panes canvas'); return [c.width >> 1, c.height >> 1]")
        return pixels(page, 0, *middle)[:3]

    curves = {
        "none": lambda v: v,
        "reinhard": lambda v: v / (1 + v),
        "aces": lambda v: v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14),  # Narkowicz 2015
    }
    for exposure in (-2, 3):
        for name, curve in curves.items():
            expected = [srgb_code(curve(v * 2**exposure)) for v in value]
            check(  # a code is rounded once here and once there
                all(abs(a - b) <= 1 for a, b in zip(shown(exposure, name), expected)),
                f"{value} at {exposure} EV by {name} is {shown(exposure, name)}, expected {expected}",
            )
    page.execute_script("viewer.curve = 'none'")
    page.find_element(By.ID, "reset").click()
    equal(pixels(page, 0, 100, 30), before, "exposure after reset")


def numbers_of(page):
    return page.execute_script(
        "return [...document.querySelectorAll('#readout tbody tr')].map(tr => [...tr.cells].map(c => c.dataset.value ?? c.innerText))"
    )


def text_of(page, selector):
    """At once: the inspector is made anew while images come in."""
    return page.execute_script("return document.querySelector(arguments[0])?.innerText ?? ''", selector)


def test_inspector(page, expected):
    """All images' values at a pixel, against the half-rounded values that the fixture's EXRs hold."""
    x, y = 37, 71
    page.execute_script(f"Object.assign(view, {{x: {(x + 0.5) / 160}, y: {(y + 0.5) / 90}, zoom: 32}}); drawAll()")
    page.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas(page, 0))
    middle = page.execute_script(
        "const c = document.querySelectorAll('#panes canvas')[0]; return [Math.floor(c.width / 2), Math.floor(c.height / 2)]"
    )
    colors = [pixels(page, i, *middle)[:3] for i in range(4)]
    ActionChains(page).move_to_element(canvas(page, 0)).perform()
    wait_until(page, lambda p: [row[10] for row in numbers_of(p)] == ["–", "–", "right", "right"], "rays at a pixel that is pointed at")
    ActionChains(page).click().perform()
    caption = text_of(page, "#readout caption")
    check(f"Pixel {x}, {y} (pinned" in caption, f"the pointer is over pixel {x}, {y}, but it says {caption}")
    # What is not shown is loaded when a pixel is pinned.
    wait_until(page, lambda p: numbers_of(p)[3][9] not in ("–", "loading") and "Rung on_screen" in text_of(p, "#pixel-facts"), "a rung at a pixel that is pointed at")
    shown = numbers_of(page)
    equal([row[0] for row in shown], NAMES, "methods in the inspector")
    values = [[float(v) for v in row[1:4]] for row in shown]
    for value, name in zip(values, FILES):
        equal(value, expected(f"{SHOT}/{name}_image.exr", x, y), f"values of {name}")
    codes = [[srgb_code(v * 2**0.5) for v in value] for value in values]  # the fixture's exposure is 0.5 EV
    check(
        all(abs(a - b) <= 1 for c, d in zip(codes, colors) for a, b in zip(c, d)),
        f"colours {colors} of pixels whose codes are {codes}",
    )
    luminance = lambda v: 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]
    truth, test = values[0], values[3]
    signed, mean = luminance(test) - luminance(truth), sum(abs(a - b) for a, b in zip(test, truth)) / 3
    relative = sum(abs(a - b) / (b * b + 0.01) ** 0.5 for a, b in zip(test, truth)) / 3
    # The page computes in double precision as this does.
    for found, wanted, what in ((shown[3][5], signed, "signed"), (shown[3][6], mean, "absolute"), (shown[3][7], relative, "relative")):
        check(abs(float(found) - wanted) <= 1e-9, f"{what} error {found}, expected {wanted}")
    # The rung knows 0.75 of the light that arrives, 1, of which the surface reflects truth.specular.
    specular = expected(f"{SHOT}/reference_specular.exr", x, y)
    share = min(0.25 * sum(specular) / 3 / mean, 1)
    check(abs(float(shown[3][8].split()[0]) - 100 * share) < 0.01 * 100 * share + 0.05, f"unknowable share {shown[3][8]}, expected {share}")
    check(abs(float(shown[2][9]) - 0.6) <= 0.5 / 254, f"confidence {shown[2][9]}")  # stored in 8 bits
    equal([row[10] for row in shown], ["–", "–", "right", "right"], "verdicts on the left")
    cut = page.execute_script("return [...document.querySelectorAll('#readout td')].filter(c => c.scrollWidth > c.clientWidth + 1).map(c => c.textContent)")
    equal(cut, [], "cells whose text is cut off")
    facts = text_of(page, "#pixel-facts")
    check(f"Roughness\n{x / 160:.2f}" in facts, "roughness: " + facts)
    check("Rung on_screen (incident)\n0.75, 0.75, 0.75" in facts, "the rung of the truth ladder: " + facts)
    page.execute_script("arguments[0].focus()", canvas(page, 0))
    press(page, *[Keys.ARROW_RIGHT] * 3)
    check("Pixel 40, 71" in text_of(page, "#readout caption"), "arrows move the pinned pixel")
    page.execute_script("viewer.pinned = {x: 130, y: 71}; drawAll()")
    equal([row[10] for row in numbers_of(page)][2:], ["false hit", "false hit"], "verdicts on the right")


def test_false_color(page):
    page.find_element(By.ID, "reset").click()
    truth = pixels(page, 0)
    for title, mode, ramp in (("absolute difference", "absolute", "magma"), ("signed difference", "signed", "diverging")):
        choose(page, "Show", title)
        equal(pixels(page, 0), truth, "the truth, which has no difference, stays in colour")
        # Three panes, one scale: recompute the colour of a pixel of each from the values and the printed maximum.
        result = page.execute_script(
            """
            const [mode, ramp] = arguments, images = viewer.shown.map(s => s.image), colors = eval(ramp);
            const maximum = parseFloat(at('scale-text').textContent);
            return [1, 2, 3].map(i => { const im = images[i], p = 80 * im.width + 21, v = scalarModes[mode].of(pixelRgb(im, p), pixelRgb(images[0], p));
                const c = document.querySelectorAll('#panes canvas')[i], s = c.width / im.width, t = mode === 'signed' ? (v / maximum + 1) / 2 : v / maximum;
                return {expected: colors[Math.round(255 * Math.min(Math.max(t, 0), 1))], shown: [...c.getContext('2d').getImageData(Math.floor(21.5 * s), Math.floor(80.5 * s), 1, 1).data].slice(0, 3)}; })""",
            mode,
            ramp,
        )
        for r in result:  # the printed maximum has three digits: up to half a percent of the scale, three colours
            check(max(abs(a - b) for a, b in zip(r["shown"], r["expected"])) <= 12, f"{title}: {r}")
    page.execute_script("viewer.baseKey = viewer.methods[2].key; return showImages()")
    check("against " + NAMES[2] in page.find_element(By.ID, "scale-text").text, "what is compared with another method")
    page.execute_script("viewer.baseKey = truthKey; return showImages()")
    scale = page.find_element(By.ID, "scale-text").text
    before = pixels(page, 1)
    page.execute_script("const e = document.getElementById('scale'); e.value = -2; e.dispatchEvent(new Event('input'))")
    check(pixels(page, 1) != before, "the scale does nothing")
    check(
        float(page.find_element(By.ID, "scale-text").text.split()[0]) < float(scale.split()[0]),
        "the printed scale must follow",
    )
    page.find_element(By.ID, "reset").click()
    choose(page, "Show", "colour")
    page.find_element(By.ID, "error-row").click()
    equal(pane_count(page), 7, "panes with errors below")
    page.find_element(By.ID, "error-row").click()


def test_flip_map(page, expected):
    """The page's own FLIP against that of metrics/, of the half-rounded values that both have, and where it is read."""
    choose(page, "Show", "FLIP")
    wait_until(page, lambda p: p.find_element(By.ID, "panes").get_attribute("aria-busy") == "false", "pictures that are no longer busy")
    maps = page.execute_script("return viewer.shown.slice(1).map(s => [...scalarsOf(s.image, viewer.shown[0].image, 'flip')])")
    for name, found in zip(FILES[1:], maps):
        wanted = expected(f"{SHOT}/{FILES[0]}_image.exr", f"{SHOT}/{name}_image.exr", 0.5)  # the fixture's exposure
        check(max(wanted) > 0.2, f"the images of {name} differ little: {max(wanted)}")
        worst = max(abs(a - b) for a, b in zip(found, wanted))
        # What the authors' programs in single precision differ by (flip_map_pixel of tests/data/vectors/metrics).
        check(worst <= 2e-4, f"FLIP of {name} is {worst} from that of metrics/flip.h")
    page.execute_script("pin({x: 30, y: 80})")
    wait_until(page, lambda p: "FLIP" in text_of(p, "#readout"), "FLIP in the readout")
    shown = float(numbers_of(page)[3][8])
    equal(shown, maps[2][80 * 160 + 30], "FLIP in the inspector")
    check(text_of(page, "#scale-text").startswith("1 (LDR-FLIP"), "its scale: " + text_of(page, "#scale-text"))
    page.execute_script("pin({x: 30, y: 80})")
    choose(page, "Show", "colour")


def test_jod_map(page):
    """Maps of visible differences, which the report has: against the truth, of the target `image` alone."""
    choose(page, "Show", "visible difference (JOD)")
    wait_until(page, lambda p: p.find_element(By.ID, "panes").get_attribute("aria-busy") == "false", "pictures that are no longer busy")
    equal(captions(page)[1:], [f"{name} visible difference" for name in NAMES[1:]], "captions")
    of_all = page.execute_script("return viewer.shown.map(s => jodMap(s.method)).map(map => map ? [...scalarsOf(map, null, 'jod')] : null)")
    check(of_all[0] is None, "the truth has no difference to itself")
    for name, values in zip(NAMES[1:], of_all[1:]):
        check(len(values) == 160 * 90 and max(values) > 0.1 and min(values) >= 0, f"{name}: {min(values)} to {max(values)} JOD")
    check("JOD lost" in text_of(page, "#scale-text"), "its scale: " + text_of(page, "#scale-text"))
    choose_in(page, "viewer", "Target", "specular")
    wait_until(page, lambda p: "no JOD map" in captions(p)[1], "a caption without a JOD map")
    choose_in(page, "viewer", "Target", "image")
    choose(page, "Show", "colour")


def test_shot_beside(page):
    """The same points of two shots together; each compared with its own truth, or with the same point."""
    choose(page, "Beside it", OTHER_SHOT)
    wait_until(page, lambda p: len(captions(p)) == 8, "both shots")
    equal(captions(page), [f"{n}, {shot}" for n in NAMES for shot in ("mirror_pillars front", "fence low")], "each point beside its other")
    page.execute_script("return setMode('absolute')")
    of = lambda base: page.execute_script(
        f"const [a, b] = viewer.shown.slice(6); return [a, b].map(s => baseOf(s.method) === {base})"
    )
    equal(of("viewer.shown[s.method.shot === viewer.shot ? 0 : 1].image"), [True, True], "each has its own truth")
    choose(page, "Against", "the same point, mirror_pillars front")
    equal(of("viewer.shown[6].image"), [True, True], "the same point")
    before = [pixels(page, 6), pixels(page, 7)]
    check(before[0] != before[1], "a point and the other shot's difference from it look alike")
    check(OTHER_SHOT in page.execute_script("return decodeURIComponent(viewerAddress())"), "the other shot in the address")
    choose(page, "Beside it", "no other shot")
    wait_until(page, lambda p: captions(p)[1:] == [f"{n} absolute difference" for n in NAMES[1:]], "without it")
    choose(page, "Show", "colour")


def test_loss_maps(page):
    """The shares of the legends, recomputed from the pixels' values."""
    choose(page, "Show", "which method is nearest to the truth")
    expected = page.execute_script(
        """const [ref, ...images] = viewer.shown.map(s => s.image), counts = [0, 0, 0];
        for (let i = 0; i < ref.pixels; ++i) {
            const errors = images.map(im => Math.fround(scalarModes.absolute.of(pixelRgb(im, i), pixelRgb(ref, i)))), sorted = [...errors].sort((a, b) => a - b);
            if (sorted[1] > 1.01 * sorted[0]) ++counts[errors.indexOf(sorted[0])];
        }
        return counts.map(c => 100 * c / ref.pixels)"""
    )
    legend = dict(item.rsplit(": ", 1) for item in page.find_element(By.ID, "nearest-legend").text.split("\n"))
    for name, share in zip(NAMES[1:], expected):  # printed with three digits
        check(abs(float(legend[name].split()[0]) - share) <= 5e-3 * share, f"{name} is nearest in {legend[name]}, expected {share}")
    check(sum(expected) > 10, "the fixture has pixels with a winner")
    choose(page, "Show", "cause of the error")
    expected = page.execute_script(
        """const ref = viewer.shown[0].image, specular = loadedImages.get(viewer.methods[0].results.specular);
        return viewer.shown.slice(1).map(({image}, m) => {
            const sums = {unknown: 0, right: 0, false_hit: 0, none: 0};
            for (let i = 0; i < ref.pixels; ++i) {
                const e = Math.fround(scalarModes.absolute.of(pixelRgb(image, i), pixelRgb(ref, i))), s = pixelRgb(specular, i);
                sums[0.25 * (s[0] + s[1] + s[2]) / 3 >= e / 2 ? 'unknown' : m === 0 ? 'none' : i % 160 < 80 ? 'right' : 'false_hit'] += e;
            }
            const total = Object.values(sums).reduce((a, b) => a + b);
            return [sums.unknown, 0, 0, sums.false_hit, sums.right, 0, sums.none].map(s => s / total);
        })"""
    )
    shown = page.execute_script(
        "return [...document.querySelectorAll('#cause-table tbody tr')].map(tr => [...tr.cells].slice(1).map(c => +c.dataset.value))"
    )
    for name, found, wanted in zip(NAMES[1:], shown, expected):  # pixels on the edge of a class may fall to either side
        check(all(abs(a - b) < 1e-3 for a, b in zip(found, wanted)), f"causes of {name}: {found}, expected {wanted}")
        check(sum(v > 0.01 for v in found) >= 2, f"{name} has several causes")
    choose(page, "Show", "where rays ended")
    scale = page.execute_script("return document.querySelector('#panes canvas').width / 160")
    shown = [pixels(page, 2, int((x + 0.5) * scale), 20)[:3] for x in (20, 23, 130)]
    equal(shown, [[0, 158, 115], [0, 0, 0], [204, 121, 167]], "colours of verdicts: right, no ray, false hit")
    choose(page, "Show", "colour")


def test_chooser(page):
    page.find_element(By.CSS_SELECTOR, "#chooser summary").click()
    page.find_element(By.ID, "chooser-none").click()
    equal(pane_count(page), 0, "panes of nothing")
    page.find_element(By.ID, "chooser-filter").send_keys("MCGUIRE 4")
    visible = [b.text for b in page.find_elements(By.CSS_SELECTOR, "#chooser label[data-key]") if b.is_displayed()]
    equal(visible, ["stride=4"], "what a filter leaves")
    page.find_element(By.ID, "chooser-all").click()
    wait_until(page, lambda p: pane_count(p) == 1, "one picture")
    equal(captions(page), [NAMES[3]], "the listed one")
    page.find_element(By.ID, "chooser-filter").clear()
    page.execute_script("filterChooser('')")
    page.find_element(By.ID, "chooser-all").click()
    wait_until(page, lambda p: captions(p) == NAMES, "all captions")
    page.find_element(By.CSS_SELECTOR, f"[aria-label='Remove {NAMES[1]}']").click()
    equal(captions(page), [NAMES[0], *NAMES[2:]], "one is removed")
    page.execute_script("return choose(listedKeys(viewer.methods), true)")
    page.find_element(By.CSS_SELECTOR, "#chooser summary").click()


def test_crops(page):
    """Boxes by pointer and keys, as the JSON has them, which the figures' test draws from."""
    page.execute_script("document.getElementById('reset').click(); at('viewer').scrollIntoView()")
    scale = page.execute_script("return document.querySelectorAll('#panes canvas')[0].clientWidth / 160")
    offset = lambda x, y: (round((x + 0.6 - 80) * scale), round((y + 0.6 - 45) * scale))
    start, end = offset(20, 50), offset(59, 79)
    ActionChains(page).key_down(Keys.SHIFT).move_to_element_with_offset(canvas(page, 0), *start).click_and_hold().move_to_element_with_offset(
        canvas(page, 0), *end
    ).release().key_up(Keys.SHIFT).perform()
    equal(page.execute_script("return crops.box"), [20, 50, 40, 30], "a box by Shift and dragging")
    equal(page.find_element(By.ID, "save-picture").text, "Save crop", "what is saved of a crop")
    sums = page.execute_script(
        """const sum = (x, y, w, h) => {
            let all = 0;
            const ref = viewer.shown[0].image;
            for (const {image} of viewer.shown.slice(1))
                for (let v = y; v < y + h; ++v)
                    for (let u = x; u < x + w; ++u) {
                        const i = v * image.width + u, a = pixelRgb(image, i), b = pixelRgb(ref, i);
                        const error = (Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2])) / 3;
                        if (Number.isFinite(error)) all += error;
                    }
            return all;
        };
        const found = worstBox(), [, , w, h] = found, {width, height} = viewer.shown[0].image, others = [];
        for (let y = 0; y + h <= height; y += 7) for (let x = 0; x + w <= width; x += 7) others.push(sum(x, y, w, h));
        return [sum(...found), Math.max(...others), Math.min(...others)]"""
    )
    check(sums[0] >= sums[1] * (1 - 1e-5) > 1.1 * sums[2], f"the box of the largest error, every seventh, the least: {sums}")
    press(page, "c", Keys.ARROW_RIGHT)
    ActionChains(page).key_down(Keys.SHIFT).send_keys(Keys.ARROW_DOWN).key_up(Keys.SHIFT).perform()
    equal(page.execute_script("return crops.box"), [21, 50, 40, 31], "a box moved and sized by keys")
    page.execute_script("arguments[0].click()", page.find_element(By.ID, "crop-add"))
    page.execute_script("setExposure(1.25); viewer.curve = 'reinhard'; return choose([viewer.methods[1].key], false)")
    page.execute_script("const i = at('crop-x'); i.value = 1000; i.dispatchEvent(new Event('change')); at('crop-add').click()")
    text = page.find_element(By.ID, "crops-json").get_attribute("value")
    equal(json.loads(text), FIGURES_JSON, "figures.json")
    page.execute_script("viewer.target = 'specular'; return showImages()")
    check(not page.find_element(By.ID, "crop-add").is_enabled(), "a crop of another target for the same figure")
    check("of target image and frame 0" in text_of(page, "#crop-note"), "why: " + text_of(page, "#crop-note"))
    page.execute_script("viewer.target = 'image'; return showImages()")
    url = page.find_element(By.ID, "crops-download").get_attribute("href")
    equal(page.execute_script("return decodeURIComponent(arguments[0].split(',').slice(1).join(','))", url), text, "the download")
    press(page, "c")


def test_other_sections_open_it(page):
    """openViewer() as overview and charts call it; the shot has a pixel that is not finite."""
    page.execute_script("scrollTo(0, 0); return openViewer(arguments[0])", {"shot": OTHER_SHOT, "points": [NAMES[3], "of no study"]})
    equal(captions(page), [NAMES[0], NAMES[3]], "truth and the point")
    top = page.execute_script("return at('viewer').getBoundingClientRect().top")
    check(abs(top) < 5, f"the viewer is {top} pixels from the top")  # of the window, less rounding
    color = page.execute_script(
        """const c = viewer.panes[1].canvas, s = c.width / 160;
        return [...c.getContext('2d').getImageData(Math.floor(20.5 * s), Math.floor(60.5 * s), 1, 1).data].slice(0, 3)"""
    )
    equal(color, [255, 0, 255], "a NaN pixel")
    equal(page.execute_script("return openViewer({shot: 'of no study'})"), False, "a shot without images")


def test_images_of_a_rung(page):
    choose_in(page, "viewer", "Target", "on_screen")
    wait_until(page, lambda p: len(p.find_elements(By.CSS_SELECTOR, "#panes figcaption")) == 2, "two pictures")
    equal(captions(page), ["truth", "sssr · first"], "rung and technique")


def test_frames_of_a_sequence(page, shot):
    """Slider and keys go through the frames that have images; all panes and the inspector follow."""
    check(not page.find_element(By.ID, "viewer-time").is_displayed(), "a shot of one frame has no time")
    choose_in(page, "viewer", "Shot", shot)

    def expect(frame, action):
        wait_until(page, lambda p: p.execute_script("return viewer.shown[0]?.image.frame") == frame, action)
        values = page.execute_script("return viewer.shown.map(s => pixelRgb(s.image, 5)[0])")
        # Of frames that are only played five bits are kept, so that they are wrong by 2^-6; of the last one ten.
        check(all(abs(a / b - 1) <= (2**-6 if frame < 6 else 2**-11) for a, b in zip(values, (1 / frame, 0.5 / frame))), f"values after {action}: {values}")
        equal("kept for playing" in page.find_element(By.ID, "viewer-legend").text, frame < 6, f"what the legend says after {action}")
        equal(page.find_element(By.ID, "time-text").text, str(frame), f"the shown frame after {action}")

    expect(6, "choosing the shot")
    page.execute_script("pin({x: 5, y: 0}); viewer.panes[1].canvas.focus()")
    for key, frame in ((",", 5), (".", 6), (".", 3)):  # around the end
        ActionChains(page).send_keys(key).perform()
        expect(frame, f"key {key}")
    shown = text_of(page, "#readout tbody tr:nth-child(2) td:nth-child(2)")
    check(abs(float(shown) * 6 - 1) <= 2**-6, f"the inspector in frame 3 has {shown}")
    page.execute_script("const t = at('time'); t.value = 1; t.dispatchEvent(new Event('input'))")
    expect(4, "the slider")
    ActionChains(page).send_keys("k").perform()
    wait_until(page, lambda p: p.execute_script("return viewer.frame") != 4, "playing")
    ActionChains(page).send_keys("k").perform()
    wait_until(page, lambda p: p.find_element(By.ID, "play").get_attribute("aria-pressed") == "false", "stopping")
    page.execute_script("arguments[0].click()", page.find_element(By.XPATH, f"//section[@id='temporal']//button[.='Play {shot}']"))
    wait_until(page, lambda p: p.find_element(By.ID, "play").get_attribute("aria-pressed") == "true", "playing from its section")
    ActionChains(page).send_keys("k").perform()
    wait_until(page, lambda p: p.find_element(By.ID, "play").get_attribute("aria-pressed") == "false", "stopping again")


def test_linked_images(page, folder):
    """The same page with its images beside it, as a file: they come when they are looked at."""
    page.get("file://" + os.path.join(folder, "report.html"))
    until_ready(page)
    loaded = "return loadedImages.size"
    check(page.execute_script(loaded) <= 4, "only the pictures of the first screen are loaded before anybody looks at others")
    page.execute_script("at('viewer').scrollIntoView()")
    wait_until(page, lambda p: captions(p) == NAMES, "all captions")
    check(4 <= page.execute_script(loaded) <= 7, "images that are shown, and those of the first screen")
    colors = [pixels(page, i) for i in range(4)]
    check(len(set(colors)) == 4, "linked images look different")
    os.remove(os.path.join(folder, "report_images", "images", OTHER_SHOT, FILES[3] + "_image.js"))
    page.execute_script(f"return openViewer({{shot: '{OTHER_SHOT}', points: ['{NAMES[3]}']}})")
    problem = page.find_element(By.ID, "viewer-problem").text
    check(FILES[3] in problem and "keep both together" in problem, "a missing file: " + problem)
    equal(captions(page), [NAMES[0]], "what is left without it")
    return colors
