#!/usr/bin/env python3
"""Scores and processor time of `cvvdp_0_5_6` and of the authors' program, on the same images of 1920x1080, one thread each. Needs packages
python3-torch and python3-torchvision, and a checkout of github.com/gfxdisp/ColorVideoVDP at 7ca201ac, so it is no part of the suite. Takes 5 minutes.

usage: cvvdp_beside_original.py BUILD_FOLDER CHECKOUT [--runs N]

BUILD_FOLDER holds `ssrlab` and `metrics_benchmark`. Both programs' times are of a still, or of a frame of a video, when memory and tables are there.
PyTorch 1.13 takes no 32-bit numbers as indices, which the authors' program uses: they are made 64-bit here, a tenth of its time at most.
"""

import argparse
import importlib.util
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
import types
from pathlib import Path

SIZE = (1080, 1920)
FRAMES = 24  # of a video: more than the window of the filters, so that most frames are usual ones
FRAMES_PER_SECOND = 30
DISPLAY = "standard_4k"
TOLERANCE = 1e-3  # JOD: float32 in another order of sums; the golden data of the tests hold 1e-4 at smaller sizes
UNUSED = ("ffmpeg", "imageio.v2", "imageio.v3", "pyexr", "pynvml", "tqdm")  # modules that read files, or show progress


def original_metric(checkout):
    """The authors' metric. Their package's own start loads programs of neural networks, which nothing here uses."""
    import torch

    class Unused(types.ModuleType):
        def __getattr__(self, name):
            if name.startswith("__"):
                raise AttributeError(name)
            return (lambda frames, **_: frames) if name == "tqdm" else type(name, (), {})

    for name in UNUSED:
        sys.modules[name] = Unused(name)
    package = types.ModuleType("pycvvdp")
    package.__path__ = [str(checkout / "pycvvdp")]
    sys.modules["pycvvdp"] = package
    plain_index = torch.Tensor.__getitem__

    def index(tensor, key):
        is_short = isinstance(key, torch.Tensor) and key.dtype == torch.int32
        return plain_index(tensor, key.long() if is_short else key)

    torch.Tensor.__getitem__ = index
    torch.set_num_threads(1)
    from pycvvdp.cvvdp_metric import cvvdp

    return cvvdp(display_name=DISPLAY, device=torch.device("cpu"))


def video():
    """Reference and test, uint8 (FRAMES, height, width, 3): waves that move, and the same with noise, blur and lag."""
    import numpy as np

    random = np.random.default_rng(1)
    y, x = np.mgrid[0 : SIZE[0], 0 : SIZE[1]]
    phases = np.arange(FRAMES)[:, None, None, None] * 0.2 + np.arange(3)
    reference = 0.5 + 0.4 * np.sin(0.03 * x[..., None] + phases) * np.cos(0.02 * y[..., None] * (1 + phases / 50))
    test = np.roll(reference, 1, axis=0) + random.normal(0, 0.03, reference.shape)
    return [np.clip(np.rint(image * 255), 0, 255).astype(np.uint8) for image in (reference, test)]


def median_seconds(runs, call):
    """Median processor time (s) of calls after a first one, and the last answer."""
    call()
    times = []
    for _ in range(runs):
        start = time.process_time()
        answer = call()
        times.append(time.process_time() - start)
    return statistics.median(times), answer


def original_results(checkout, images, runs):
    """{what: (seconds, JOD)}; of a video, seconds of one frame."""
    metric = original_metric(checkout)
    reference, test = images
    still, still_jod = median_seconds(runs, lambda: metric.predict(test[0], reference[0], dim_order="HWC")[0].item())
    start = time.process_time()
    jod = metric.predict(test, reference, dim_order="FHWC", frames_per_second=FRAMES_PER_SECOND)[0].item()
    return {"still": (still, still_jod), "frame": ((time.process_time() - start) / FRAMES, jod)}


def our_results(build, images, runs):
    """The same of ssrlab: times by its benchmark, scores by `ssrlab compare` on PNG files of the images."""
    from PIL import Image

    with tempfile.TemporaryDirectory() as folder:
        for name, frames in zip(("reference", "test"), images):
            for number, frame in enumerate(frames):
                Image.fromarray(frame).save(Path(folder) / f"{name}_{number:04}.png")

        def jod(number, *options):
            command = [build / "ssrlab", "compare", *(f"{folder}/{name}_{number}.png" for name in ("reference", "test"))]
            printed = subprocess.run([*command, "--metric", "cvvdp_0_5_6", "--display", DISPLAY, "--json", *options], check=True, capture_output=True)
            return json.loads(printed.stdout)["metrics"][0]["value"]

        scores = jod("0000"), jod("####", "--fps", str(FRAMES_PER_SECOND), "--padding", "replicate")
    cases = {"still": f"cvvdp_0_5_6/still/{DISPLAY}", "frame": f"cvvdp_0_5_6/frame/{FRAMES_PER_SECOND}"}
    printed = subprocess.run(
        [build / "metrics_benchmark", f"--benchmark_filter=^({'|'.join(cases.values())})", f"--benchmark_repetitions={runs}", "--benchmark_format=json"],
        check=True, capture_output=True)  # fmt: skip
    medians = {run["run_name"].split("/process_time")[0]: run["cpu_time"] / 1000 for run in json.loads(printed.stdout)["benchmarks"]
               if run.get("aggregate_name") == "median"}  # fmt: skip
    return {what: (medians[case], score) for (what, case), score in zip(cases.items(), scores)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="build folder of ssrlab")
    parser.add_argument("checkout", type=Path, help="folder of the authors' repository")
    parser.add_argument("--runs", type=int, default=3, help="timed stills, and runs of our benchmark (default: 3)")
    arguments = parser.parse_args()
    missing = [name for name in ("torch", "torchvision", "PIL") if importlib.util.find_spec(name) is None]
    if missing:
        sys.exit(f"{', '.join(missing)}: no such Python module. Install python3-torch and python3-torchvision.")
    os.environ["OMP_NUM_THREADS"] = "1"
    images = video()
    ours = our_results(arguments.build, images, arguments.runs)
    theirs = original_results(arguments.checkout, images, arguments.runs)
    print("| 1920x1080, one thread | authors' program, s | ssrlab, s | ratio | authors' JOD | ssrlab's JOD |\n|---|---|---|---|---|---|")
    for what in ours:
        (our_time, our_jod), (their_time, their_jod) = ours[what], theirs[what]
        print(f"| {what} | {their_time:.2f} | {our_time:.3f} | {their_time / our_time:.0f} | {their_jod:.4f} | {our_jod:.4f} |")
    if any(abs(ours[what][1] - theirs[what][1]) > TOLERANCE for what in ours):
        sys.exit(f"The scores differ by more than {TOLERANCE} JOD.")


if __name__ == "__main__":
    main()
