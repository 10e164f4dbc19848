"""What the tests in a browser share: the browser, and for those of the report checks, tables and canvas pixels."""

import csv
import os
import sys

try:
    from selenium import webdriver
    from selenium.common.exceptions import StaleElementReferenceException, TimeoutException, WebDriverException
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError:
    sys.exit(
        "these tests run in a browser: install python3-selenium, chromium and chromium-driver (tests/run.sh does)"
    )

PATIENCE = 120  # seconds that a wait may take; on a quiet machine most take less than one, and a busy one is no fault of a page
CHROMIUM, DRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--window-size=1400,1000",
    "--force-device-scale-factor=1",
]
DRAWN_ANEW = (IndexError, StaleElementReferenceException)  # what a part raises that is replaced while the test reads


def open_browser(profile, flags=()):
    for program in (CHROMIUM, DRIVER):
        if not os.path.exists(program):
            sys.exit(f"{program} is missing: install chromium and chromium-driver (tests/run.sh does)")
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in [*FLAGS, *flags, f"--user-data-dir={profile}"]:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    try:
        browser = webdriver.Chrome(service=webdriver.chrome.service.Service(DRIVER), options=options)
        browser.set_script_timeout(PATIENCE)
        return browser
    except WebDriverException as e:
        sys.exit(f"chromium does not start: {e.msg}")


def check(is_true, what):
    if not is_true:
        sys.exit(f"report_in_browser: {what}")


def equal(found, expected, what):
    check(found == expected, f"{what}: found {found!r}, expected {expected!r}")


def wait_until(page, is_so, what):
    """The first value of is_so(page) that is true; without one the test fails, since `what` did not come."""
    try:
        return WebDriverWait(page, PATIENCE, 0.1, DRAWN_ANEW).until(is_so)
    except TimeoutException:
        check(False, f"{what}: not there after {PATIENCE} s")


def until_ready(page):
    wait_until(page, lambda p: p.execute_script("return document.documentElement.hasAttribute('data-ready')"), "the page")
    page.execute_script("Object.assign(window, ssrlab)")  # what its modules export, by name


# Calls `saved(blob, name)` of the page in place of saving a file; copied texts are `window.copied`.
CATCH_SAVES = """
const blobs = new Map();
URL.createObjectURL = blob => { blobs.set(`blob:${blobs.size}`, blob); return `blob:${blobs.size - 1}`; };
HTMLAnchorElement.prototype.click = function() { window.saved(blobs.get(this.getAttribute('href')), this.download); };
const clipboard = {writeText: async text => { window.copied = text; }};
Object.defineProperty(navigator, 'clipboard', {value: clipboard, configurable: true});
"""


def choose(page, label, text):
    element = page.find_element(
        By.XPATH, f"//label[normalize-space(text())='{label}']/select[ancestor::section[@id='results' or @id='viewer']]"
    )
    Select(element).select_by_visible_text(text)


def pixels(page, pane, x=None, y=None):
    """RGBA of one canvas pixel, or a number that differs between pictures."""
    where = f"{x}, {y}, 1, 1" if x is not None else "0, 0, c.width, c.height"
    script = f"const c = document.querySelectorAll('#panes canvas')[{pane}]; const d = c.getContext('2d').getImageData({where}).data;"
    if x is not None:
        return page.execute_script(script + "return [...d]")
    return page.execute_script(
        script + "let s = 0; for (let i = 0; i < d.length; ++i) s = (s * 31 + d[i]) % 1e9; return s"
    )


def pane_count(page):
    return len(page.find_elements(By.CSS_SELECTOR, "#panes canvas"))


def canvas(page, pane):
    return page.find_elements(By.CSS_SELECTOR, "#panes canvas")[pane]


def srgb_code(v):
    v = min(max(v, 0), 1)
    return round(255 * (12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055))


def rows_of(folder, name, **wanted):
    """Of a CSV file of results, those whose columns have these values."""
    with open(os.path.join(folder, name), newline="") as file:
        return [r for r in csv.DictReader(file) if all(r[k] == v for k, v in wanted.items())]


def values(page, selector):
    """The values of the marks there, with all digits."""
    return page.execute_script(
        "return [...document.querySelectorAll(arguments[0])].map(p => Number(p.dataset.value))", selector
    )


def choose_in(page, section, label, text):
    """In any section; choose() is for the pictures' own."""
    element = page.find_element(
        By.XPATH, f"//section[@id='{section}']//label[normalize-space(text())='{label}']/select"
    )
    Select(element).select_by_visible_text(text)


def table_of(page, selector):
    return page.execute_script(
        """return [...document.querySelector(arguments[0]).querySelectorAll('tbody tr')].map(tr =>
        [...tr.cells].map(td => [td.innerText, td.dataset.value ?? null]))""",
        selector,
    )
