"""What a reader takes along from a report: the address that shows the same again, pictures and tables."""

import xml.etree.ElementTree

from report_browser import CATCH_SAVES, By, check, choose, equal, pixels, until_ready, wait_until
from report_crops import SHOT
from report_viewer import NAMES, OTHER_SHOT, captions
from selenium.webdriver.common.action_chains import ActionChains


def test_address(page, url):
    """What is seen is in the address, which shows it again."""
    state = """const {shot, target, mode, layout, curve, chosen, exposure, scale, active, pinned} = viewer;
        return {shot, target, mode, layout, curve, chosen, exposure, scale, active, pinned, ...view}"""
    page.execute_script("window.scrollTo(0, 0); at('viewer').scrollIntoView()")
    choose(page, "Shot", OTHER_SHOT)
    wait_until(page, lambda p: captions(p) == NAMES, "all captions")
    choose(page, "Show", "absolute difference")
    page.execute_script(
        """setExposure(1.5); setScale(-1); viewer.curve = 'reinhard'; Object.assign(view, {zoom: 4, x: 0.25, y: 0.5});
        pin({x: 30, y: 40}); setCropBox([20, 30, 40, 25]);
        const box = at('budget');
        box.value = 5, box.dispatchEvent(new Event('input'));
        return choose([viewer.methods[1].key], false)"""
    )
    wait_until(page, lambda p: "30+40" in p.execute_script("return location.hash"), "the address")
    before, seen, address = page.execute_script(state), pixels(page, 1), page.execute_script("return location.hash")
    page.get("about:blank")
    page.get(url + address)
    until_ready(page)
    equal(page.execute_script(state), before, "what the address shows")
    equal(captions(page)[0], NAMES[0], "captions")
    equal(pixels(page, 1), seen, "the picture")
    equal(page.execute_script("return answerChoice.shot"), OTHER_SHOT, "the shot of the first screen")
    equal(page.execute_script("return [crops.box, at('budget').value]"), [[20, 30, 40, 25], "5"], "the crop, and the budget")
    page.get("about:blank")
    page.get(url + "#viewer?shot=of+no+study&image=x")
    until_ready(page)
    equal(captions(page), NAMES, "an address of another study")
    page.get("about:blank")
    page.get(url)
    until_ready(page)
    equal(page.execute_script("return location.hash"), "", "nothing is kept before the reader changes something")


def test_keeping(page):
    """Pictures and tables as files, and for the clipboard."""
    saved = page.execute_async_script(
        CATCH_SAVES + """const done = arguments[0];
        window.saved = async (blob, name) => {
            const image = await createImageBitmap(blob), c = h('canvas', {width: image.width, height: image.height});
            c.getContext('2d').drawImage(image, 0, 0);
            const pane = viewer.panes[3].canvas, of = (canvas, x, y) => [...canvas.getContext('2d').getImageData(x, y, 1, 1).data];
            done([name, image.width / pane.width, of(pane, 40, 50), of(c, pane.width + 12 + 40, pane.height + 24 + 12 + 24 + 50)]);
        };
        at('save-picture').click()"""
    )
    equal(saved[0], f"{SHOT}_image_color.png", "the picture's name")
    check(2 < saved[1] < 2.1, f"four panes in two columns: {saved[1]} panes wide")
    equal(saved[3], saved[2], "a pixel of the last pane")
    cropped = page.execute_script("crops.box = [20, 30, 40, 30]; const c = shownPicture(); crops.box = null; return c.height / c.width")
    check(0.75 < cropped < 0.95, f"crops of 4:3 below their captions: {cropped}")
    # Below differences stand their colours: the middle of the bar, and its numbers, which are not the background's white.
    bar = page.execute_async_script(
        """const done = arguments[0];
        setMode("absolute").then(() => {
            const colours = at("color-bar").querySelector("canvas"), c = shownPicture(), y = c.height - 36 + 12 + 12;
            const context = c.getContext("2d"), start = context.measureText("0").width + 8;
            const row = context.getImageData(0, y, c.width, 1).data, own = colours.getContext("2d").getImageData(128, 0, 1, 1).data;
            const at90 = [...row.slice(4 * Math.round(start + 90), 4 * Math.round(start + 90) + 3)];
            const ink = context.getImageData(Math.round(start + 188), y - 10, 60, 20).data.some(v => v < 100);
            return setMode("color").then(() => done([at90, [...own.slice(0, 3)], ink, c.height - shownPicture().height]));
        })"""
    )
    check(max(abs(a - b) for a, b in zip(bar[0], bar[1])) < 12, f"the middle of the bar: {bar[0]}, in the legend {bar[1]}")
    equal(bar[2:], [True, 36], "its numbers; no bar below colours")
    table = page.execute_async_script(
        """const done = arguments[0];
        window.saved = async (blob, name) => done([await blob.text(), window.copied]);
        const [copy, save] = document.querySelectorAll('#summary .controls button');
        copy.click(), save.click()"""
    )
    rows = page.execute_script("return document.querySelectorAll('#summary tr').length")
    for text, separator in zip(table, (",", "\t")):
        lines = text.split("\n")
        equal(lines[0].split(separator)[:4], ["Shot", "Technique", "Point", "mse"], "the heading")
        equal(len(lines), rows + 1, "lines of the table")
    check("stride=4" in table[0] and ', ' in table[0].split('"')[1], f"points, and quoted intervals: {table[0]}")


def test_save_tools(page):
    """A table or a plot that is pointed at can be saved; the plot's file is whole, with colours of its own."""
    page.execute_script("window.saved = (blob, name) => { window.kept = [blob, name] }")

    def saved(selector, place):
        page.execute_script("document.querySelector(arguments[0]).scrollIntoView({block: 'center'})", selector)
        ActionChains(page, duration=0).move_to_element(page.find_element(By.CSS_SELECTOR, selector)).perform()
        page.execute_script("window.kept = null")
        ActionChains(page, duration=0).move_to_element(page.find_elements(By.CSS_SELECTOR, "#save-tools button")[place]).click().perform()
        wait_until(page, lambda p: p.execute_script("return window.kept") is not None, selector)
        return page.execute_async_script(
            "const done = arguments[0], [blob, name] = window.kept; blob.text().then(text => done([name, text, blob.size]))"
        )

    name, text, _ = saved("#scatter .chart > svg", 0)
    check(name == f"results_{SHOT}.svg" and "var(" not in text and "<style" in text, f"a plot as {name}: {text[:200]}")
    root = xml.etree.ElementTree.fromstring(text)
    check(root.get("width") and "ms" in "".join(root.itertext()), "a plot's size and axis")
    name, text, size = saved("#scatter .chart > svg", 1)
    check(name == f"results_{SHOT}.png" and size > 5000, f"a plot as {name} of {size} bytes")
    name, text, _ = saved("#references table", 1)
    check(name == "references.csv" and text.startswith("Shot,"), f"a table as {name}: {text[:100]}")
    links = [a.get_attribute("href").rsplit("/", 1)[-1] for a in page.find_elements(By.CSS_SELECTOR, "footer a")]
    check({"results.csv", "summary.csv", "times.csv"} <= set(links) and "costs.csv" not in links, f"files beside the page: {links}")
