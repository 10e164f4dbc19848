"""A recorded page in headless Chromium: what WebGL 2 renders against what lavapipe rendered, pixel by pixel.

usage: record_in_browser.py SSRLAB_PROGRAM

Both compute in float32 and store halves, but sin, exp, pow, divisions and products of matrices are rounded differently:
SwiftShader and lavapipe have other approximations, and both may fuse operations. Bounds are stated for each pass on
inputs that were recorded, and then for whole frames, in which decisions on rounded numbers add up.
"""

import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "report"))
from report_browser import open_browser, wait_until

# On the CPU, whatever the machine has, so that the bounds below hold everywhere.
SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]

# Each pass by itself: how much its pixels may differ (absolute), and how many of those that hold something may. Passes
# that copy, compare and shift integers must give the same bits. A half of 1 to 2 has steps of 0.001.
EXACT = {"common/blue_noise", "diligent_ssr/depth_hierarchy", "diligent_ssr/mask"}
LARGEST = {
    ("diligent_ssr/reprojected_depth", "reprojected_depth"): 1e-6,  # device depth up to 1: products of matrices
    ("diligent_ssr/intersection", "ray_radiance"): 2e-3,  # confidence and colours up to 1: two steps
    ("diligent_ssr/spatial_reconstruction", "resolved_radiance"): 4e-3,  # means of those, weighted by lobes
    ("diligent_ssr/spatial_reconstruction", "resolved_variance"): 2e-3,
    ("diligent_ssr/spatial_reconstruction", "hit_depth"): 1e-3,  # one step
    ("diligent_ssr/temporal_accumulation", "accumulated_radiance"): 2e-3,
    ("diligent_ssr/temporal_accumulation", "accumulated_variance"): 1e-3,
}
# Directions times length, and densities up to 65504: relative. Where a lobe is narrow, its density falls by some percent
# within the rounding of a half vector.
DIRECTION = ("diligent_ssr/intersection", "ray_direction")
DIRECTION_RELATIVE = 0.03
# The last pass takes derivatives of depth. GLSL lets each implementation take them of every row of a quad (lavapipe) or
# of its first (SwiftShader): at edges the filter reaches elsewhere. With the derivatives of rows written out it agrees.
CLEANUP = ("diligent_ssr/bilateral_cleanup", "reflections")
CLEANUP_WITH_ROWS = 2e-3
CLEANUP_FAR = 0.08  # share of the pixels with reflections that differ by more than 0.01, with the browser's derivatives

# Whole frames: the share of the pixels with reflections that differ by more than 0.01. In the first it is that of the
# last pass. From the second on, history comes from the surface or from its mirror image, whichever looks more alike,
# which rounding decides where both do.
FRAME_FAR = [CLEANUP_FAR, 0.15, 0.15]
ERROR_RELATIVE = 0.02  # of the frame's error to the recorded one

SIZE, FRAMES = ("96", "54"), "0-2"

CHECK_PASSES = "return page.replay.checkPasses(arguments[0]);"
CHECK_WITH_ROWS = """
const recording = JSON.parse(JSON.stringify(page.replay.recording));
const derivatives = 'vec2(dFdx(pixel_depth), dFdy(pixel_depth))';
const ofRow = (a, b) => `camera_depth_at(ivec2(${b})) - camera_depth_at(ivec2(${a}))`;
const cleanup = recording.programs.find(p => p.stage === 'diligent_ssr/bilateral_cleanup');
if (!cleanup.fragment.includes(derivatives)) return null;
cleanup.fragment = cleanup.fragment.replace(derivatives, `vec2(
    ${ofRow('pixel.x & ~1, pixel.y', 'pixel.x | 1, pixel.y')}, ${ofRow('pixel.x, pixel.y & ~1', 'pixel.x, pixel.y | 1')})`);
const rows = new Replay(recording, page.replay.texels).checkPasses(arguments[0]);
return rows.find(r => r.stage === 'diligent_ssr/bilateral_cleanup');
"""
FRAMES_OF_PAGE = """
return frames().map((frame, place) => {
    showFrame(place);
    return {...page.results.difference, error: page.results.error, recorded: frame.error};
});
"""
# The camera of the last frame looks elsewhere by a thousandth.
BREAK_A_UNIFORM = """
const words = frames().at(-1).camera, numbers = new Float32Array(Uint32Array.from(words).buffer);
numbers[0] *= 1.001;
frames().at(-1).camera = [...new Uint32Array(numbers.buffer)];
"""
MOVE_A_SLIDER = """
const row = document.querySelector(`[data-name="${arguments[0]}"]`), input = row.querySelector('input');
input.value = arguments[1];
input.dispatchEvent(new Event('input', {bubbles: true}));
return Number(row.querySelector('output').value);
"""
PICTURE = "const c = at('picture'); return [...c.getContext('2d').getImageData(0, 0, c.width >> 1, c.height).data.filter((_, i) => i % 97 === 0)].join();"
REFLECTIONS = "showFrame(frames().length - 1); return [...page.replay.images.read(frames().at(-1).radiance)].join();"


def check(is_true, what):
    if not is_true:
        sys.exit(f"record_in_browser: {what}")


def record(program, folder, name, *options):
    page = os.path.join(folder, name + ".html")
    command = [program, "record", "rotating_mirror", "--technique", "diligent_ssr", "--size", *SIZE, "--frames", FRAMES]
    done = subprocess.run(
        [*command, "--samples", "4", "--out", page, *options],
        env={**os.environ, "SSRLAB_CACHE": os.path.join(folder, "cache")},
        capture_output=True,
        text=True,
    )
    check(done.returncode == 0, f"{' '.join(done.args)} failed:\n{done.stderr}")
    return page


def open_page(browser, page):
    browser.get("file://" + page)
    wait_until(browser, lambda b: b.execute_script("return document.documentElement.dataset.ready ?? null") is not None, "the page")
    problem = browser.execute_script("return document.getElementById('problem').textContent")
    check(not problem, f"the page says: {problem}")
    browser.execute_script("Object.assign(window, ssrlab)")  # what its modules export, by name


def faults_of_passes(browser, place):
    """What lies outside of the bounds, of each pass by itself."""
    rows, faults = browser.execute_script(CHECK_PASSES, place), []
    for row in rows:
        name = (row["stage"], row["image"])
        where = f"frame {place}, {row['stage']}, {row['image']} mip {row['mip']}: {row}"
        if row["stage"] in EXACT:
            if row["differing"]:
                faults.append(f"other bits: {where}")
        elif name == DIRECTION:
            if row["relative"] > DIRECTION_RELATIVE:
                faults.append(where)
        elif name != CLEANUP and row["largest"] > LARGEST[name]:
            faults.append(where)
    with_rows = browser.execute_script(CHECK_WITH_ROWS, place)
    if with_rows is None or with_rows["largest"] > CLEANUP_WITH_ROWS:
        faults.append(f"frame {place}, last pass with the derivatives of rows: {with_rows}")
    check({r["stage"] for r in rows} == EXACT | {n[0] for n in [*LARGEST, DIRECTION, CLEANUP]}, f"passes: {rows}")
    return faults


def faults_of_frames(browser):
    faults = []
    for place, frame in enumerate(browser.execute_script(FRAMES_OF_PAGE)):
        check(frame["kept"] > 400, f"frame {place} hardly reflects: {frame}")
        if frame["far"] > FRAME_FAR[place] * frame["kept"]:
            faults.append(f"frame {place}: {frame}")
        if abs(frame["error"] / frame["recorded"] - 1) > ERROR_RELATIVE:
            faults.append(f"error of frame {place}: {frame}")
    return faults


def check_replay(browser):
    last = len(FRAME_FAR) - 1
    for faults in (faults_of_frames(browser), faults_of_passes(browser, 0), faults_of_passes(browser, last)):
        check(not faults, "outside of the bounds:\n" + "\n".join(faults))
    time = browser.execute_script("return document.getElementById('time').textContent")
    check("GPU time" in time or "no GPU timer" in time, f"the page says of its time: {time!r}")


def check_slider(browser, changed_page):
    """A parameter that is moved renders what a page shows that was recorded with its value."""
    as_recorded, picture = browser.execute_script(REFLECTIONS), browser.execute_script(PICTURE)
    value = browser.execute_script(MOVE_A_SLIDER, "temporal_radiance_stability_factor", 500)
    check(value == 0.5, f"the slider of a range from 0 to 1 gave {value} in its middle")
    moved = browser.execute_script(REFLECTIONS)
    check(moved != as_recorded, "a slider does not change the result")
    check(browser.execute_script(PICTURE) != picture, "a slider does not change the picture")
    open_page(browser, changed_page)
    check(browser.execute_script(REFLECTIONS) == moved, "a slider renders other than a recording with its value")


def main():
    with tempfile.TemporaryDirectory() as folder:
        page = record(sys.argv[1], folder, "page", "--passes")
        changed = record(sys.argv[1], folder, "changed", "--set", "temporal_radiance_stability_factor=0.5")
        browser = open_browser(os.path.join(folder, "profile"), SOFTWARE)
        try:
            open_page(browser, page)
            check_replay(browser)
            check_slider(browser, changed)
            open_page(browser, page)
            browser.execute_script(BREAK_A_UNIFORM)
            broken = faults_of_passes(browser, len(FRAME_FAR) - 1)
            check(broken, "a camera that looks elsewhere by a thousandth lies within the bounds: they show nothing")
        finally:
            browser.quit()


if __name__ == "__main__":
    main()
