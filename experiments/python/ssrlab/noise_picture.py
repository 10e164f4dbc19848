"""The picture of experiments/docs/numbers.md: a reference, its halves, and intervals by the number of samples.

usage: python3 experiments/python noise_picture [PROGRAM]

Runs PROGRAM (default: build/release/ssrlab) for about a minute. Needs Debian's python3-matplotlib and -numpy.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from ssrlab.command_lines import CommandLine
from ssrlab.mistakes import exit_code, stop

try:
    import matplotlib
except ImportError as missing:
    stop(f"{missing}: install python3-matplotlib and python3-numpy")

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from ssrlab.csv_files import number, read_rows
from ssrlab.exr import read_exr_rgb
from ssrlab.figures import crops, style
from ssrlab.repository import ROOT

OUT = ROOT / "experiments/docs/pictures/noise.svg"
SCENE, SIZE = "glossy_stretch", (96, 54)
ROWS = slice(19, 54)  # that show the road; the others are black
TECHNIQUE = "mcguire_dda"
SAMPLES = (16, 64, 256, 1024)
SEEDS = (1, 2, 3, 4)
IMAGE_SEED = 1


def call(program, *words):
    subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def render(program, scratch, samples):
    """The file of a reference."""
    file = scratch / f"{samples}.exr"
    call(program, "reference", SCENE, "--size", *SIZE, "--samples", samples, "--seed", IMAGE_SEED, "--out", file)
    return file


def measure(program, scratch, samples, seed):
    """The row of summary.csv that holds the technique's MSE."""
    config = {
        "shots": [{"scene": SCENE, "resolution": SIZE}],
        "reference": {"samples": samples, "seed": seed, "guide_samples": 16},
        "lit": "direct",
        "techniques": [{"technique": TECHNIQUE}],
        "metrics": ["mse"],
        "masks": ["reflective"],
        "targets": ["specular"],
        "images": "none",
        "timing": {"frames": 0},
    }
    name = scratch / f"{samples}_{seed}"
    name.with_suffix(".json").write_text(json.dumps(config), encoding="utf-8")
    call(program, "run", name.with_suffix(".json"), "--out", name)
    _, (row,) = read_rows(str(name / "summary.csv"))
    return row


def draw_images(places, images):
    exposure = crops.auto_exposure(images[-1][1])
    for place, (title, image) in zip(places, images):
        crops.show(place, crops.display(image[ROWS], exposure))
        place.set_title(title)


def draw_intervals(axes, rows):
    """A level for each number of samples, and an interval for each seed."""
    height = 0.16
    for level, samples in enumerate(SAMPLES):
        for index, seed in enumerate(SEEDS):
            row = rows[samples, seed]
            value, low, high, floor = (number(row, column) for column in ("value", "low", "high", "floor"))
            is_first = level == index == 0
            y = level + height * (index - (len(SEEDS) - 1) / 2)
            axes.errorbar([value], [y], xerr=[[value - low], [high - value]], fmt=style.MARKS[0], color=style.COLORS[0],
                          label="noise removed, with 95 % interval" if is_first else None)
            # The halves' mean has half of a half's variance, and their squared difference twice a half's: a fourth of it is noise.
            axes.plot([value + floor / 4], [y], style.MARKS[1], markerfacecolor="white", color=style.COLORS[1],
                      label="noise not removed" if is_first else None)
    axes.set_yticks(range(len(SAMPLES)), [f"{samples} samples" for samples in SAMPLES])
    axes.invert_yaxis()
    axes.set_xlabel(f"MSE of {TECHNIQUE} (mask reflective)")
    axes.legend(loc="lower right")


def command_line():
    parser = CommandLine(prog="python3 experiments/python noise_picture", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default="build/release/ssrlab")
    return parser


def main():
    program = str(Path(command_line().parse_args().program).resolve())
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        few, many = (render(program, scratch, samples) for samples in (SAMPLES[0], SAMPLES[-1]))
        images = [
            ("half A", read_exr_rgb(str(few), "specular.a")),
            ("half B", read_exr_rgb(str(few), "specular.b")),
            (f"reference of {SAMPLES[0]} samples", read_exr_rgb(str(few), "specular")),
            (f"reference of {SAMPLES[-1]} samples", read_exr_rgb(str(many), "specular")),
        ]
        rows = {(samples, seed): measure(program, scratch, samples, seed) for samples in SAMPLES for seed in SEEDS}
    style.apply()
    figure = plt.figure(figsize=(style.DOUBLE_COLUMN, 0.5 * style.DOUBLE_COLUMN), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(1, 1.7))
    draw_images(above.subplots(1, len(images)), images)
    draw_intervals(below.subplots(), rows)
    OUT.parent.mkdir(exist_ok=True)
    figure.savefig(OUT, metadata={"Date": None})
    print(f"{OUT}: {OUT.stat().st_size} bytes")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the picture"))
