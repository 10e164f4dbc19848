"""`ssrlab watch` as its user has it: a folder that is saved, and a page in headless Chromium.

usage: watch_in_browser.py SSRLAB_PROGRAM

From saving to a verdict; an error of an included shader at its line, beside the last good picture; a slider; a version that is kept;
files that are half written or gone. And who is answered: nobody without the token, of another host or page, or from another machine.
"""

import csv
import http.client
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "report"))
from report_browser import PATIENCE, WebDriverWait, open_browser

PROGRAM = sys.argv[1]

INCLUDED = "// What the shader below includes.\nvec3 weighed(vec3 light) {\n    return light * WEIGHT;\n}\n"
BROKEN = "// What the shader below includes.\nvec3 weighed(vec3 light) {\n    return light * undeclared_weight;\n}\n"

PAINTED = """
const c = document.getElementById(arguments[0]), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
return [c.width, [...d].filter((v, i) => i % 4 !== 3).reduce((a, b) => (a * 31 + b) % 1000000007, 7)];
"""
MOVE_A_SLIDER = """
const input = document.querySelector(`[data-name="${arguments[0]}"] input`);
input.value = arguments[1];
input.dispatchEvent(new Event('input', {bubbles: true}));
"""


def check(is_true, what):
    if not is_true:
        sys.exit(f"watch_in_browser: {what}")


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Watched:
    """A technique's folder, whose last pass weighs its light by what another file says."""

    def __init__(self, root):
        self.folder = os.path.join(root, "my_ssr")
        made = subprocess.run([PROGRAM, "new", self.folder, "--from", "mcguire_dda"], capture_output=True, text=True)
        check(made.returncode == 0, f"ssrlab new failed:\n{made.stderr}")
        self.shader = os.path.join(self.folder, "shade.comp")
        text = read(self.shader)
        weighed = text.replace("lit_at(found.xy)", "weighed(lit_at(found.xy))")
        check(weighed != text, "shade.comp reads the light in another way")
        self.weigh("1.0")
        write(self.shader, '#include "my_part.glsl"\n' + weighed)

    def file(self, name):
        return os.path.join(self.folder, name)

    def weigh(self, weight):
        write(self.file("my_part.glsl"), INCLUDED.replace("WEIGHT", weight))


class Page:
    def __init__(self, browser, address):
        self.browser = browser
        browser.get(address)
        browser.execute_script("Object.assign(window, ssrlab)")  # what its modules export, by name

    def text(self, place):
        return self.browser.execute_script("return document.getElementById(arguments[0]).innerText", place)

    def until(self, what, script, *arguments):
        """What a script returns, once that is true."""
        try:
            return WebDriverWait(self.browser, PATIENCE, poll_frequency=0.15).until(
                lambda b: b.execute_script("return " + script, *arguments)
            )
        except Exception:
            sys.exit(f"watch_in_browser: {what} did not come; the page says:\n{self.text('problem')}\n{self.text('doing')}")

    def until_measured(self, state):
        """The news of a state of the technique whose errors are there."""
        return self.until(
            f"the error of state {state}",
            "page.news?.result?.state === arguments[0] && !page.news.result.is_coarse ? page.news : null",
            state,
        )

    def until_problem(self, part):
        return self.until(f"a problem with {part!r}", "page.news?.problem?.text.includes(arguments[0]) ? page.news : null", part)

    def painted(self, canvas):
        return self.browser.execute_script(PAINTED, canvas)


def error_of(news):
    return news["result"]["shots"][0]["error"]


def verdict_of(news, label):
    return next(v for v in news["result"]["verdicts"] if v["label"] == label)


def check_who_is_answered(address):
    port, token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", address).groups()
    own = f"127.0.0.1:{port}"

    def status(path, method="GET", body=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", int(port), timeout=PATIENCE)
        connection.putrequest(method, path, skip_host=True)
        for name, value in {"Host": own, "Connection": "close", **headers}.items():
            connection.putheader(name.replace("_", "-"), value)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        text = answer.read()
        connection.close()
        return answer.status, text

    def expect(code, path, what, **request):
        found = status(path, **request)[0]
        check(found == code, f"{what}: status {found}, not {code}")

    expect(200, f"/{token}/", "the page")
    expect(404, "/", "no token")
    expect(404, f"/{token[:-1]}/", "a part of the token")
    expect(404, f"/{'0' * 32}/news", "another token")
    expect(403, f"/{token}/", "another host's name", Host=f"evil.example:{port}")
    expect(403, f"/{token}/", "another port", Host="127.0.0.1:1")
    expect(403, f"/{token}/news", "a page of another origin", Origin="http://evil.example")
    expect(403, f"/{token}/news", "a page of another port", Origin="http://127.0.0.1:1")
    expect(403, f"/{token}/", "a frame of another site", Sec_Fetch_Site="cross-site")
    for path in ["../technique.json", "..%2f..%2fetc%2fpasswd", "image/..%2f..%2fversions.json", "%2fetc%2fpasswd", "watch.html"]:
        expect(404, f"/{token}/{path}", f"the path {path}")
    post = {"method": "POST", "body": b"{}"}
    expect(403, f"/{token}/values", "a form without an origin", **post, Content_Type="application/json")
    expect(403, f"/{token}/values", "a form of another origin", **post, Content_Type="application/json", Origin="null")
    expect(403, f"/{token}/values", "a form that is no JSON", **post, Content_Type="text/plain", Origin=f"http://{own}")
    code, text = status(f"/{token}/values", **{**post, "body": b'{"no_such": 1}'}, Content_Type="application/json", Origin=f"http://{own}")
    check(code == 200 and b"no_such" in text, f"an unknown parameter gave {code} {text}")
    listening = [line.split() for table in ("tcp", "tcp6") for line in read(f"/proc/net/{table}").splitlines()[1:]]
    places = {fields[1] for fields in listening if fields[3] == "0A" and fields[1].endswith(f":{int(port):04X}")}
    check(places == {f"0100007F:{int(port):04X}"}, f"it listens at {places}, not at 127.0.0.1 alone")


def check_numbers(page):
    news = page.until_measured(1)
    error, verdict = error_of(news), verdict_of(news, "no reflections")
    check(error["low"] is not None and error["low"] <= error["value"] <= error["high"], f"the error has no interval: {error}")
    check(verdict["verdict"] == "better", f"linear tracing is not better than no reflections: {verdict}")
    check(verdict["verdict"] in page.text("verdicts"), f"the page does not say so: {page.text('verdicts')}")
    page.until("the pictures", "document.getElementById('errors-caption').textContent !== ''")
    pictures = [page.painted(canvas) for canvas in ("now", "other", "errors")]
    check(len({tuple(p) for p in pictures}) == 3 and {p[0] for p in pictures} == {96}, f"pictures: {pictures}")
    return news


def check_a_save(page, watched, before):
    picture = page.painted("now")
    watched.weigh("0.5")
    news = page.until_measured(before["state"] + 1)
    check(error_of(news)["value"] > error_of(before)["value"], "half of the light is no larger error")
    page.until("another picture", "(now => JSON.stringify(now) !== arguments[1])((() => {" + PAINTED + "})(arguments[0]))", "now", str(picture).replace(" ", ""))
    return news


def check_an_error(page, watched, before):
    picture = page.painted("now")
    write(watched.file("my_part.glsl"), BROKEN)
    news = page.until_problem("undeclared_weight")
    place = news["problem"]["places"][0]
    check(place["file"] == watched.file("my_part.glsl") and place["line"] == 3, f"the error is at {place}")
    check("return light * undeclared_weight;" in page.text("problem"), f"the line is missing: {page.text('problem')}")
    check(error_of(news) == error_of(before), "the last numbers are gone")
    check(page.painted("now") == picture, "the last good picture is gone")
    watched.weigh("1.0")
    news = page.until_measured(news["state"] + 1)
    check(news["problem"] is None, "the problem stays")
    return news


def press_keep_while_it_renders(page, watched, weight, state):
    watched.weigh(weight)
    page.until("the new state", "page.news.state === arguments[0]", state)
    page.browser.execute_script("document.getElementById('keep').click()")
    page.until("that it will be kept", "page.news.is_to_be_kept")
    check("as soon as its errors are measured" in page.text("keep-note"), f"the page does not say that it will be kept: {page.text('keep-note')}")


def check_keeping(page, watched, news):
    """A version can be kept before it is measured, but not if it is saved again before that."""
    press_keep_while_it_renders(page, watched, "1.00", news["state"] + 1)
    watched.weigh("1.000")
    page.until("what became of the first version", "page.news.keep_note.includes('was not kept')")
    page.until_measured(news["state"] + 2)
    check(page.browser.execute_script("return page.news.kept.length") == 0, "a version that was saved over is kept")
    press_keep_while_it_renders(page, watched, "1.0000", news["state"] + 3)
    news = page.until("the version", "page.news.kept.length === 1 && page.news.result.verdicts[0].label === 'my_ssr_1' ? page.news : null")
    verdict = verdict_of(news, "my_ssr_1")
    check(verdict["verdict"] == "identical", f"a version that was just kept is {verdict}")
    check("my_ssr_1" in page.text("kept"), f"the list lacks it: {page.text('kept')}")
    others = {other["label"]: other["error"]["value"] for other in news["result"]["shots"][0]["others"]}
    check(set(others) == {"my_ssr_1", "no reflections"}, f"errors are of {set(others)}")
    check(others["my_ssr_1"] == error_of(news)["value"] < others["no reflections"], f"errors: {others}, now {error_of(news)}")
    head, row = page.text("shots").splitlines()[:2]
    check(all(label in head for label in others) and len(row.split("\t")) == len(head.split("\t")), f"the table of errors: {head}: {row}")
    return news


def check_a_slider(page, before):
    page.browser.execute_script(MOVE_A_SLIDER, "dda.thickness", 0)
    news = page.until(
        "the error with another value",
        "page.news.values['dda.thickness'] !== undefined && page.news.result.state === page.news.state ? page.news : null",
    )
    check(news["values"] == {"dda.thickness": 0}, f"the left end of the slider gave {news['values']}")
    check(error_of(news)["value"] != error_of(before)["value"], "the slider changes nothing")
    check(verdict_of(news, "my_ssr_1")["verdict"] in ("better", "worse"), f"{verdict_of(news, 'my_ssr_1')}")
    return news


def check_bad_files(page, watched):
    declaration = read(watched.file("technique.json"))
    write(watched.file("technique.json"), declaration[: len(declaration) // 2])
    news = page.until_problem("technique.json:")
    check(watched.folder in news["problem"]["text"], f"another folder is named: {news['problem']['text']}")
    shutil.move(watched.folder, watched.folder + "_gone")
    page.until_problem("is not a folder at the moment")
    shutil.move(watched.folder + "_gone", watched.folder)
    write(watched.file("technique.json"), declaration)
    page.until("an end of the problems", "page.news.problem === null && page.news.result.state === page.news.state")


def check_kept_folder(page, out):
    page.until("the results of kept versions", "page.news.is_kept_done")
    news = page.until("why pixels are off", "page.news.why?.state === page.news.state ? page.news : null")
    causes = {c["cause"]: c["share"] for c in news["why"]["causes"]}
    check(abs(sum(causes.values()) - 1) < 1e-6 and len(page.text("causes").splitlines()) >= len(causes), f"causes: {causes}")
    with open(os.path.join(out, "kept", "summary.csv"), newline="", encoding="utf-8") as file:
        techniques = {row["technique"] for row in csv.DictReader(file)}
    check(techniques == {"none", "my_ssr_1"}, f"kept versions have {techniques}")
    check(os.path.exists(os.path.join(out, "kept", "report.html")), "kept versions have no report")
    numbers = os.path.join(out, "numbers", "my_ssr_1")
    same = subprocess.run([PROGRAM, "diff", numbers, numbers], capture_output=True, text=True)
    check(same.returncode == 0, f"ssrlab diff does not read what a version measured:\n{same.stderr}")


def main():
    with tempfile.TemporaryDirectory() as root:
        watched, out = Watched(root), os.path.join(root, "out")
        command = [PROGRAM, "watch", watched.folder, "--scene", "fence", "--size", "96", "54", "--samples", "32", "--out", out]
        environment = {**os.environ, "SSRLAB_CACHE": os.path.join(root, "cache")}
        watch = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
        browser = None
        try:
            watch.stdout.readline()
            address = watch.stdout.readline().strip()
            check_who_is_answered(address)
            browser = open_browser(os.path.join(root, "profile"))
            page = Page(browser, address)
            news = check_a_save(page, watched, check_numbers(page))
            news = check_keeping(page, watched, check_an_error(page, watched, news))
            check_a_slider(page, news)
            check_bad_files(page, watched)
            check_kept_folder(page, out)
            watch.send_signal(signal.SIGTERM)
            check(watch.wait(timeout=PATIENCE) == 0, f"it ended with {watch.returncode}")
        finally:
            if browser:
                browser.quit()
            watch.kill()


if __name__ == "__main__":
    main()
