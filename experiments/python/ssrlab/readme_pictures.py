"""The pictures of the repository's README, in experiments/studies/readme, and of experiments/studies/findings.

usage: python3 experiments/python readme_pictures [RESULTS] [--report QUICKSTART] [--findings COMPARISON] [--composed COMPOSED_MOTION] [--engines ENGINES]

error_time.png is drawn from experiments/studies/summaries/quickstart.csv. With RESULTS, a folder that `ssrlab run
experiments/studies/configs/readme.json` filled, comparison.png too; with QUICKSTART, that of the quickstart, the first screen of
its report (report.png), for which it needs chromium; with COMPARISON, COMPOSED_MOTION and ENGINES, those of the
studies of these names, the crops that findings/figures.json, composed.json and engines.json name. Needs Debian's python3-matplotlib, -numpy and -pil.
"""

import argparse
import hashlib
import io
import subprocess
import sys
import tempfile
from pathlib import Path

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
from ssrlab.repository import CONFIGS, FINDINGS, STUDIES, SUMMARIES
from ssrlab.results import Results, label
from ssrlab.tables import summary_file

SUMMARY = SUMMARIES / "quickstart.csv"
OUT = STUDIES / "readme"
SHOTS = ("metal_corner", "fence", "normal_mapped")  # many roughnesses, thin bars, in motion
DOTS_PER_INCH = 150  # 1050 pixels across: what hosts show of a README is narrower
SCENE, DISCS = np.s_[34:172], np.s_[104:172]  # rows of the comparison's images, and of its error maps, which are 0 above
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


def whiskers(cell):
    return [[cell.value - cell.low], [cell.high - cell.value]]


def draw_error_time():
    """A panel per shot; a technique as published and at its best, its last preset, are joined."""
    _, tables = summary_file.read(str(SUMMARY))
    cells = {name: {(c.row, c.column): c for c in tables[name][1]} for name in ("errors", "times")}
    rows = list(dict.fromkeys(row for row, _ in cells["errors"]))
    techniques = list(dict.fromkeys(row.split(",")[0] for row in rows if not row.startswith("none")))
    figure, panels = style.panels(len(SHOTS), height=5.0)
    for axes, scene in zip(panels, SHOTS):
        shot = next(column for _, column in cells["errors"] if column.startswith(scene + "."))
        none = cells["errors"][next(row for row in rows if row.startswith("none")), shot]
        axes.axhline(none.value, color="#666666", linestyle="--", label="no reflections but the environment")
        for index, technique in enumerate(techniques):
            color, mark = style.series(index)
            presets = [row for row in rows if row.split(",")[0] == technique]
            places = [(cells["times"][row, shot], cells["errors"][row, shot]) for row in presets]
            axes.plot([t.value for t, _ in places], [e.value for _, e in places], color=color, linewidth=0.7)
            for row, (time, error) in zip(presets, places):
                is_best = row == presets[-1]
                axes.errorbar([time.value], [error.value], xerr=whiskers(time), yerr=whiskers(error), fmt=mark, color=color,
                              markerfacecolor=color if is_best else "white", label=technique if is_best else None)
        size = shot.split(".")[2]
        axes.set(xlabel="time of a frame (ms)", title=f"{scene}, {size}" + ", in motion" * (".f" in shot))
        style.log_axis(axes.xaxis)
        style.log_axis(axes.yaxis)
        axes.margins(0.12)
    panels[0].set_ylabel("MSE of the reflection")
    style.draw_legend(figure, panels)
    save(figure, OUT / "error_time.png", digest(SUMMARY))


def draw_comparison(folder):
    """Two rows of three images, each above its error map; below the truth's stands the maps' scale."""
    results = Results(folder)
    shot = results.shots()[0]
    images = results.images_of(shot, "image")
    errors = results.errors_of("specular", "mse", "reflective")
    truth = images.pop(("reference", ""))
    maps = {key: crops.absolute_error(image, truth) for key, image in images.items()}
    most = float(np.nanquantile(np.stack(list(maps.values())), 0.99))
    columns, heights = 3, [rows.stop - rows.start for rows in (SCENE, DISCS)]
    size = (style.DOUBLE_COLUMN, 0.49 * style.DOUBLE_COLUMN)
    figure, grid = plt.subplots(4, columns, figsize=size, layout="constrained", height_ratios=2 * heights)
    figure.set_constrained_layout_pads(w_pad=0.02, h_pad=0.02, wspace=0.01, hspace=0.01)
    for index, (key, image) in enumerate([(("truth", ""), truth), *images.items()]):
        top, below = grid[index // columns * 2 : index // columns * 2 + 2, index % columns]
        crops.show(top, crops.display(image[SCENE], results.exposure(shot)))
        if key not in maps:
            top.set_title("path-traced truth (the others: MSE)")
            below.axis("off")
            scale = below.inset_axes([0.1, 0.8, 0.8, 0.16])
            bar = figure.colorbar(ScalarMappable(Normalize(0, most), "magma"), cax=scale, orientation="horizontal", extend="max")
            bar.set_label("absolute error, mean over channels")
            continue
        error = errors[(shot, *key)]
        value, low, high = (numbers.short(x) for x in (error.value, error.low, error.high))
        top.set_title(f"{label(*key)}: {value} [{low}, {high}]")
        crops.show(below, maps[key][DISCS], cmap="magma", vmin=0, vmax=most)
    save(figure, OUT / "comparison.png", digest(CONFIGS / "readme.json"))


def draw_report(folder):
    """The first screen of a report, 1280x800."""
    page = (Path(folder) / "report.html").resolve()
    with tempfile.TemporaryDirectory() as scratch:
        shot = Path(scratch) / "report.png"
        command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1280,800"]
        command += ["--virtual-time-budget=10000", f"--screenshot={shot}", page.as_uri()]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        keep(Image.open(shot), OUT / "report.png", digest(CONFIGS / "quickstart.json"))


def draw_findings(folder, name):
    """A picture per shot of that file of the findings, named after its scene."""
    results, chosen = Results(folder), FINDINGS / name
    collected = read_crops(str(chosen), read_choice(str(chosen)), results)
    options = Request("crops", "crops", "specular", "mse", "reflective", crops=collected)
    for shot in collected:
        save(crops.draw(results, shot, options), FINDINGS / f"{shot.split('.')[0]}.png", digest(chosen), is_reduced=name != "figures.json")


def main():
    parser = argparse.ArgumentParser(description="The pictures of the README (PNG).")
    parser.add_argument("results", nargs="?", help="a folder that `ssrlab run experiments/studies/configs/readme.json` filled")
    parser.add_argument("--report", metavar="QUICKSTART", help="the results folder of the quickstart, for a picture of its report")
    parser.add_argument("--findings", metavar="COMPARISON", help="the results folder of the comparison, for the findings' pictures")
    parser.add_argument("--composed", metavar="COMPOSED_MOTION", help="that of composed_ssr in motion, for more of them")
    parser.add_argument("--engines", metavar="ENGINES", help="that of experiments/bridges/engines/engines.json, for those of engines")
    arguments = parser.parse_args()
    style.apply()
    draw_error_time()
    if arguments.results:
        draw_comparison(arguments.results)
    if arguments.report:
        draw_report(arguments.report)
    if arguments.findings:
        draw_findings(arguments.findings, "figures.json")
    if arguments.composed:
        draw_findings(arguments.composed, "composed.json")
    if arguments.engines:
        draw_findings(arguments.engines, "engines.json")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the pictures"))
