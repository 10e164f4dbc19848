#!/usr/bin/env python3
"""Variance at equal CPU time of ssrlab's path tracer and of Cycles, of the same scenes. Needs Blender 3.4 and takes 15 minutes, so it is no part
of the suite. Prints how far the means are apart, and the rows of the table in groundtruth/measurements.md.

usage: cycles_variance.py SSRLAB [SCENE ...] [--size W H] [--samples N] [--repeats N] [--adaptive ours|both] [--keep FOLDER]

Cycles renders with the power of two samples that comes nearest to half of ssrlab's time, which the comparison allows for. Third-party scenes lie on
SSRLAB_SCENE_PATH.

With --adaptive, noisy pixels of ssrlab get more directions: in the mean as many as without, and the guide has 16 samples. With `both`, pixels of
Cycles end by its noise threshold: the power of a half whose time comes nearest to half of ssrlab's.

CPU time is user and system time of all threads. Both exclude loading and the BVH: of ssrlab the time of `ssrlab rays`, which does little else, is
subtracted, so its guide and all that it learns count; of Cycles that of a render of one sample with the scene in memory.
"""

import argparse
import json
import math
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "experiments" / "python"))
from ssrlab import statistics  # noqa: E402
from ssrlab.exr import ExrError, read_exr_rgb  # noqa: E402
from ssrlab.json_files import read_json  # noqa: E402
from ssrlab.mistakes import Fault, ResultsError, exit_code  # noqa: E402

SCENES = ("dark_room", "modern_hall", "breakfast_room", "sponza", "flight_helmet")
DARK = 0.01  # added to the squared mean that variances are relative to, as ssrlab's weights have it
TRIMMED = 1e-3  # share of pixels, those of the greatest variance, that the trimmed mean leaves out
ROUNDING = 1e-10  # relative variance of images that differ by the rounding of float alone
ADAPTIVE_SHARE = 3  # of ours, with --adaptive: a quarter of the directions are the same for all pixels
CYCLES_SHARE = 0.5  # time of a render of Cycles over that of ours: its variance times time hardly depends on it
CARRIED = {"gltf", "also", "blended", "environment", "lights", "overrides", "back_faces", "cameras", "frame_count", "frame_rate"}


def children_seconds():
    """User and system time (s) of all processes that were started here and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(*command):
    """CPU seconds of a command that has to succeed."""
    before = children_seconds()
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0 or "Traceback" in done.stdout:
        raise ResultsError(f"{Path(command[0]).name} failed: {done.stdout.strip()[-1500:]}.")
    return children_seconds() - before


def scene_folders():
    return [Path(p) for p in os.environ.get("SSRLAB_SCENE_PATH", "").split(os.pathsep) if p] + [ROOT / "scenes"]


def found_below(folders, name):
    for folder in folders:
        if (folder / name).exists():
            return (folder / name).resolve()
    raise ResultsError(f"{name} is in none of the folders of scenes: set SSRLAB_SCENE_PATH.")


def gltf_document(file):
    """The JSON of a .gltf or .glb."""
    data = Path(file).read_bytes()
    return json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]] if data[:4] == b"glTF" else data)


def scene_for_blender(name):
    """The scene's scene.json with absolute paths, `gltfs` in place of `gltf` and `also`, and the `specular` of materials by their names. Fails where
    the scene holds what cycles_scene.py does not carry over."""
    file = found_below(scene_folders(), f"{name}/scene.json")
    scene = read_json(file, has_comments=True)
    folders = [file.parent, *scene_folders()]
    scene["gltfs"] = [str(found_below(folders, g)) for g in [scene["gltf"], *scene.get("also", ())]]
    materials = [m for gltf in scene["gltfs"] for m in gltf_document(gltf).get("materials", ())]
    extensions = {m["name"]: m.get("extensions", {}) for m in materials if "name" in m}
    scene["specular"] = {name: e["KHR_materials_specular"].get("specularFactor", 1) for name, e in extensions.items() if "KHR_materials_specular" in e}
    environment = scene.get("environment", {})
    if "image" in environment:
        environment["image"] = str(found_below(folders, environment["image"]))
    kinds = {light["type"] for light in scene.get("lights", ())}
    lacks = [*(set(scene) - CARRIED - {"gltfs", "specular"}), *(kinds - {"directional", "point"}), *({"gradient"} & set(environment))]
    lacks += ["hidden backs"] if scene.get("back_faces") != "drawn" else []  # Cycles draws both sides
    has_blended = any(m.get("alphaMode") == "BLEND" for m in materials)  # Cycles gets opaque ones
    lacks += ["blended materials that are cut"] if has_blended and scene.get("blended") != "opaque" else []
    lacks += ["rotation_deg"] if environment.get("rotation_deg") else []
    lacks += ["range"] if any("range" in light for light in scene.get("lights", ())) else []
    camera = scene.get("cameras", [{}])[0]
    lacks += [] if "vfov_deg" in camera else ["a camera without vfov_deg"]
    lacks += ["KHR_lights_punctual"] if any("KHR_lights_punctual" in gltf_document(g).get("extensionsUsed", ()) for g in scene["gltfs"]) else []
    if lacks:
        raise ResultsError(f"{name} has what is not carried to Blender: {', '.join(map(str, lacks))}.")
    return scene


def render_ours(ssrlab, name, arguments, place):
    """Images of shape (repeats, height, width, 3), their CPU time (s) each, and that of further samples alone, without guide and learning."""
    size = ("--size", *arguments.size)
    adaptive = ("--adaptive-share", ADAPTIVE_SHARE, "--adaptive-image", "--guide-samples", 16) if arguments.adaptive else ()
    most = arguments.samples // (1 + ADAPTIVE_SHARE) if arguments.adaptive else arguments.samples

    def reference(samples, seed):
        shutil.rmtree(place / "cache", ignore_errors=True)  # of what other runs learnt
        out = place / f"{samples}_{seed}.exr"
        seconds = run(ssrlab, "reference", name, *size, "--samples", samples, "--seed", seed, *adaptive, "--cache", place / "cache", "--out", out)
        return read_exr_rgb(out, "image"), seconds

    load = min(run(ssrlab, "rays", name, *size) for _ in range(2))
    start = min(reference(16, seed)[1] for seed in (1, 2))
    rendered = [reference(most, seed) for seed in range(1, arguments.repeats + 1)]
    seconds = np.mean([t for _, t in rendered])
    further = (seconds - start) / (most - 16) * most
    return np.stack([image for image, _ in rendered]).astype(float), np.array([t - load for _, t in rendered]), further


def render_cycles(blender, scene, seconds, arguments, place):
    """The same of Cycles, which takes about `seconds` each, and what ended it."""
    job = {"scene": scene, "size": arguments.size, "seconds": seconds, "adaptive": arguments.adaptive == "both", "seeds": list(range(1, arguments.repeats + 1)), "out": str(place)}
    (place / "job.json").write_text(json.dumps(job))
    script = Path(__file__).parent / "cycles_scene.py"
    run(blender, "-b", "--factory-startup", "--python-exit-code", 1, "-P", script, "--", place / "job.json")
    times = read_json(place / "times.json")
    images = [read_exr_rgb(place / f"{i}.exr") for i in range(arguments.repeats)]
    return np.stack(images).astype(float), np.array(times["seconds"]), times["limit"]


def relative_variance(images, mean):
    """Of each pixel, mean over channels: shape (height, width). Images: (repeats, height, width, 3)."""
    return (images.var(axis=0, ddof=1) / (mean**2 + DARK)).mean(axis=-1)


def trimmed_mean(values):
    kept = np.sort(values.ravel())
    return kept[: len(kept) - math.ceil(TRIMMED * len(kept))].mean()


def log_ratio(theirs, ours, times, mean, average):
    """ln of Cycles' variance x CPU time over ours, and its 95 % interval by a jackknife over pairs of repeats: (ln, low, high). `times`: CPU
    seconds of each repeat, of theirs and of ours, with the load already subtracted."""

    def of(kept):
        products = [average(relative_variance(images[kept], mean)) * seconds[kept].mean() for images, seconds in zip((theirs, ours), times)]
        return math.log(products[0] / products[1])

    count = len(ours)
    everything = np.arange(count)
    whole = of(everything)
    _, low, high = statistics.mean([count * whole - (count - 1) * of(np.delete(everything, i)) for i in everything])
    half = (high - low) / 2
    return whole, whole - half, whole + half


def without_learning(ratio, our_seconds, our_further):
    """The ratio as text, for the time of further samples alone; a difference of two times, which a tenth of either may be off."""
    return f"{ratio * our_seconds / our_further:.2f}" if our_further > 0.2 * our_seconds else "not known"


def spread(times):
    return f"{times.mean():.2f} ({times.min():.2f} to {times.max():.2f})"


def compared(name, ours, theirs, our_times, our_further, their_times):
    """Prints the agreement of both means and the ratios of both variances; the row of the table. Images: (repeats, height, width, 3)."""
    our_seconds, their_seconds = our_times.mean(), their_times.mean()
    means = ours.mean(axis=0), theirs.mean(axis=0)
    joint = (means[0] + means[1]) / 2
    gray = [m.mean(axis=-1) for m in means]
    apart = np.median(np.abs(gray[0] - gray[1]) / (joint.mean(axis=-1) + 0.1))
    noise = sum(i.mean(axis=-1).var(axis=0, ddof=1) / len(i) for i in (ours, theirs))
    expected = np.median(0.6745 * np.sqrt(noise) / (joint.mean(axis=-1) + 0.1))  # median of a normal's absolute value
    total = theirs.sum() / ours.sum()
    print(f"means: median difference {apart:.2%} of a pixel, {expected:.2%} expected by noise alone; total radiance, Cycles over ours: {total:.3f}")
    ratios = []
    for title, average in (("mean", np.mean), ("trimmed", trimmed_mean)):
        ratios.append([math.exp(v) for v in log_ratio(theirs, ours, (their_times, our_times), joint, average)])
        value, low, high = ratios[-1]
        values = [average(relative_variance(i, joint)) for i in (ours, theirs)]
        print(f"{title}: variance ours {values[0]:.3g}, Cycles {values[1]:.3g}; times CPU time, Cycles over ours: {value:.2f} [{low:.2f}, {high:.2f}], "
              f"{without_learning(value, our_seconds, our_further)} without our guide and learning")  # fmt: skip
    pairs = [relative_variance(i, joint) for i in (theirs, ours)]
    varies = np.minimum(*pairs) > ROUNDING
    median = np.median(pairs[0][varies] / pairs[1][varies]) * their_seconds / our_seconds
    print(f"median over pixels of the ratio times CPU time: {median:.2f}")
    cells = [f"{v:.2f} [{low:.2f}, {high:.2f}]" for v, low, high in ratios]
    without = without_learning(ratios[0][0], our_seconds, our_further)
    return f"| `{name}` | {cells[0]} | {cells[1]} | {median:.2f} | {without} | {100 * apart:.1f} % ({100 * expected:.1f} %) | {total:.3f} |"


def measure(name, blender, arguments, place):
    """The scene's row."""
    scene = scene_for_blender(name)
    folders = [place / name / kind for kind in ("ours", "cycles")]
    for folder in folders:
        folder.mkdir(parents=True, exist_ok=True)
    ours, our_times, our_further = render_ours(arguments.ssrlab, name, arguments, folders[0])
    theirs, their_times, limit = render_cycles(blender, scene, CYCLES_SHARE * our_times.mean(), arguments, folders[1])
    if ours.shape != theirs.shape or not np.isfinite(theirs).all():
        raise ResultsError(f"the images of {name} by Cycles are of another size, or not finite.")
    print(f"\n{name}: ours {arguments.samples} samples in {spread(our_times)} CPU seconds, {our_further:.1f} of them beside guide and learning; "
          f"Cycles {limit} in {spread(their_times)}")  # fmt: skip
    return compared(name, ours, theirs, our_times, our_further, their_times)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0], formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ssrlab", help="the program")
    parser.add_argument("scenes", nargs="*", default=SCENES, help="default: %(default)s")
    parser.add_argument("--size", nargs=2, type=int, default=(192, 108), metavar=("W", "H"), help="pixels; default: 192 108")
    parser.add_argument("--samples", type=int, default=256, help="of ours, a pixel; default: %(default)s")
    parser.add_argument("--repeats", type=int, default=8, help="renders with a seed of their own each, at least 3; default: %(default)s")
    parser.add_argument("--adaptive", choices=("ours", "both"), help="more samples for noisy pixels, of ssrlab or of both")
    parser.add_argument("--keep", help="folder for the images; default: none")
    arguments = parser.parse_args()
    arguments.ssrlab = str(Path(arguments.ssrlab).resolve())
    if arguments.repeats < 3 or arguments.samples < (128 if arguments.adaptive else 32) or min(arguments.size) < 1:
        raise ResultsError("--repeats is at least 3, --samples at least 32 (128 with --adaptive), and --size positive.")
    if not os.access(arguments.ssrlab, os.X_OK):
        raise ResultsError(f"{arguments.ssrlab} is no program: name the ssrlab that was built.")
    blender = shutil.which("blender")
    if blender is None or not subprocess.run([blender, "--version"], capture_output=True, text=True).stdout.startswith("Blender 3.4"):
        raise Fault("Blender 3.4 is missing: on Debian 12 install the package blender.")
    with tempfile.TemporaryDirectory() as temporary:
        place = Path(arguments.keep or temporary).resolve()
        try:
            rows = [measure(name, blender, arguments, place) for name in arguments.scenes]
        except ExrError as e:
            raise ResultsError(f"{e}.") from e
    print("\n| Scene | mean [95 %] | trimmed [95 %] | median pixel | mean, without guide and learning | means differ by (noise) | total radiance |")
    print("|---|---|---|---|---|---|---|", *rows, sep="\n")


if __name__ == "__main__":
    sys.exit(exit_code(main, "the comparison"))
