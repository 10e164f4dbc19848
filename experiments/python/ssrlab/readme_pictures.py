"""The pictures of the repository's README, in experiments/studies/readme, and of experiments/studies/questions.

usage: python3 experiments/python readme_pictures [RESULTS] [--techniques TECHNIQUE_PICTURES] [--report QUICKSTART] [--comparison COMPARISON] [--composed COMPOSED_MOTION] [--engines ENGINES] [--rooms ROOMS_GPU_PICTURES] [--visibility VISIBILITY]

RESULTS is a folder that `ssrlab run experiments/studies/configs/readme.json` filled; comparison.png is drawn from it.
TECHNIQUE_PICTURES is the folder of the study technique_pictures; the pictures on pages of techniques and tracers are drawn from it. QUICKSTART is the
quickstart's folder; chromium shows the first screen of its report for report.png. COMPARISON, COMPOSED_MOTION, ENGINES, ROOMS_GPU_PICTURES and VISIBILITY are folders
of the studies with these names; the crops that questions/pictures/*.crops.json name are drawn from them.
Needs Debian's python3-matplotlib, -numpy and -pil.
"""

import hashlib
import io
import subprocess
import sys
import tempfile
from pathlib import Path

from ssrlab.command_lines import CommandLine
from ssrlab.mistakes import exit_code, stop

try:
    import matplotlib
    import numpy as np
    from PIL import Image, PngImagePlugin
except ImportError as missing:
    stop(f"{missing}: install python3-matplotlib, python3-numpy and python3-pil")

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from ssrlab.figures import crops, numbers, style
from ssrlab.figures.crop_choice import read_crops
from ssrlab.figures.request import Request, read_choice
from ssrlab.repository import CONFIGS, QUESTIONS, STUDIES
from ssrlab.results import Results

OUT = STUDIES / "readme"
DOTS_PER_INCH = 150  # 1050 pixels across: what hosts show of a README is narrower
DISCS = ("rotating_mirror", np.s_[34:172], np.s_[104:172])  # scene, rows of the images, rows of the error maps
# {(technique, point): title} of five points.
NONE = {("none", "default"): "none"}
BEST = NONE | {("mcguire_dda", "default"): "mcguire_dda"} | {(name, "best"): f"{name} best" for name in ("amd_sssr", "diligent_ssr", "frostbite_sssr")}
SIMPLE = NONE | {("simple_ssr", preset): preset for preset in ("slides_blurred", "blog", "best_2x", "corrected")}
FOUR_MODES = NONE | {("four_mode_ssr", preset): preset for preset in ("high", "best_1x")}
FOUR_MODES |= {("four_mode_ssr", f"corrected mode={mode}"): mode for mode in ("simple_linear", "temporal")}
MARCHES = {("mcguire_dda", f"tracer={tracer}"): tracer for tracer in ("dda", "hierarchy", "cells", "frostbite_linear", "exact_layer")}
COLOURS = 256  # of the palette: the files are a third as large as with all colours, and look the same


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def save(figure, file, made_from, is_reduced=True):
    """`made_from` is kept in the file's text "Source", by which a test knows whether the picture is up to date."""
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=DOTS_PER_INCH, format="png")
    plt.close(figure)
    keep(Image.open(drawn), file, made_from, is_reduced)


def keep(picture, file, made_from, is_reduced=True):
    """`is_reduced`: to a palette, which suffices where one scale of colours is shown."""
    picture = picture.convert("RGB")
    if is_reduced:
        picture = picture.quantize(COLOURS, dither=Image.Dither.NONE)
    notes = PngImagePlugin.PngInfo()
    notes.add_text("Source", made_from)
    file.parent.mkdir(exist_ok=True)
    picture.save(file, optimize=True, pnginfo=notes)
    print(f"{file}: {file.stat().st_size} bytes")


def draw_comparison(folder, config, scene, name, points, scene_rows, map_rows):
    """NAME.png: two rows of three images, each above its error map; the first is the truth, and the maps' scale stands below it. `points`:
    {(technique, point): title} of the five others. `scene_rows`: of the images that are shown; `map_rows`: of the error maps, which are 0 elsewhere."""
    results = Results(folder)
    shot = next(s for s in results.shots() if s.startswith(scene + "."))
    images = results.images_of(shot, "image", keys=[("reference", ""), *points])
    truth = images["reference", ""]
    errors = results.errors_of("specular", "mse", "reflective")
    maps = {key: crops.absolute_error(images[key], truth) for key in points}
    most = float(np.nanquantile(np.stack(list(maps.values())), 0.99))
    columns, heights = 3, [rows.stop - rows.start for rows in (scene_rows, map_rows)]
    size = (style.DOUBLE_COLUMN, 0.49 / 206 * sum(heights) * style.DOUBLE_COLUMN)  # 206 rows of 320 pixels, and titles, are half as high as wide
    figure, grid = plt.subplots(4, columns, figsize=size, layout="constrained", height_ratios=2 * heights)
    figure.set_constrained_layout_pads(w_pad=0.02, h_pad=0.02, wspace=0.01, hspace=0.01)
    for index, (key, image) in enumerate([(("truth", ""), truth), *((key, images[key]) for key in points)]):
        top, below = grid[index // columns * 2 : index // columns * 2 + 2, index % columns]
        crops.show(top, crops.display(image[scene_rows], results.exposure(shot)))
        if key not in maps:
            top.set_title("path-traced truth (the others: MSE)")
            below.axis("off")
            scale = below.inset_axes([0.1, 0.8, 0.8, 0.16])
            bar = figure.colorbar(ScalarMappable(Normalize(0, most), "magma"), cax=scale, orientation="horizontal", extend="max")
            bar.set_label("absolute error, mean over channels")
            continue
        error = errors[(shot, *key)]
        value, low, high = (numbers.short(x) for x in (error.value, error.low, error.high))
        top.set_title(f"{points[key]}: {value} [{low}, {high}]")
        crops.show(below, maps[key][map_rows], cmap="magma", vmin=0, vmax=most)
    save(figure, OUT / f"{name}.png", digest(CONFIGS / config))


def draw_report(folder):
    """The first screen of a report, 1280x800."""
    page = (Path(folder) / "report.html").resolve()
    with tempfile.TemporaryDirectory() as scratch:
        shot = Path(scratch) / "report.png"
        command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1280,800"]
        command += ["--virtual-time-budget=10000", f"--screenshot={shot}", page.as_uri()]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        keep(Image.open(shot), OUT / "report.png", digest(CONFIGS / "quickstart.json"))


def draw_crops(folder, question, is_reduced=True):
    """A picture for each shot of the crops of a question's page, named after the shot's scene."""
    results, chosen = Results(folder), QUESTIONS / "pictures" / f"{question}.crops.json"
    collected = read_crops(str(chosen), read_choice(str(chosen)), results)
    options = Request("crops", "crops", "specular", "mse", "reflective", crops=collected)
    for shot in collected:
        save(crops.draw(results, shot, options), chosen.parent / f"{shot.split('.')[0]}.png", digest(chosen), is_reduced)


def command_line():
    parser = CommandLine(prog="python3 experiments/python readme_pictures", description="The pictures of the README (PNG).")
    parser.add_argument("results", nargs="?", help="a folder that `ssrlab run experiments/studies/configs/readme.json` filled")
    parser.add_argument("--techniques", metavar="TECHNIQUE_PICTURES", help="the results folder of that study, for pictures of techniques and marches")
    parser.add_argument("--report", metavar="QUICKSTART", help="the results folder of the quickstart, for a picture of its report")
    parser.add_argument("--comparison", metavar="COMPARISON", help="the results folder of the comparison, for pictures of third-party scenes")
    parser.add_argument("--composed", metavar="COMPOSED_MOTION", help="that of composed_ssr in motion, for more of them")
    parser.add_argument("--engines", metavar="ENGINES", help="that of experiments/bridges/engines/engines.json, for those of engines")
    parser.add_argument("--rooms", metavar="ROOMS_GPU_PICTURES", help="that of the study rooms_gpu_pictures, for that of a room at 1 ms")
    parser.add_argument("--visibility", metavar="VISIBILITY", help="that of the study visibility, for those where metrics disagree")
    parser.add_argument("--visibility-stills", metavar="VISIBILITY_STILLS", help="that of the study visibility_stills, for those of still images")
    return parser


def main():
    parser = command_line()
    arguments = parser.parse_args()
    style.apply()
    if arguments.results:
        draw_comparison(arguments.results, "readme.json", DISCS[0], "comparison", BEST, *DISCS[1:])
    if arguments.techniques:
        draw_comparison(arguments.techniques, "technique_pictures.json", DISCS[0], "simple_ssr", SIMPLE, *DISCS[1:])
        draw_comparison(arguments.techniques, "technique_pictures.json", DISCS[0], "four_mode_ssr", FOUR_MODES, *DISCS[1:])
        draw_comparison(arguments.techniques, "technique_pictures.json", "fence", "tracers", MARCHES, np.s_[70:180], np.s_[70:180])
    if arguments.report:
        draw_report(arguments.report)
    if arguments.comparison:
        draw_crops(arguments.comparison, "third_party", is_reduced=False)
    if arguments.composed:
        draw_crops(arguments.composed, "composed")
    if arguments.engines:
        draw_crops(arguments.engines, "engines")
    if arguments.rooms:
        draw_crops(arguments.rooms, "rooms_at_gpu_time")
    if arguments.visibility:
        draw_crops(arguments.visibility, "visibility")
    if arguments.visibility_stills:
        draw_crops(arguments.visibility_stills, "visibility_stills")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the pictures"))
