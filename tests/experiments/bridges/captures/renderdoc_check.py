"""Captures ssrlab itself with RenderDoc while it draws a G-buffer, exports that, and compares it with what ssrlab wrote:
bit by bit. Needs RenderDoc and is no part of the suite (Debian: librenderdoc, librenderdoc-dev, python3-renderdoc, libvulkan-dev, gcc).

usage: renderdoc_check.py SSRLAB
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
EXPERIMENTS = HERE.parents[3] / "experiments"
sys.path.insert(0, str(EXPERIMENTS / "python"))
from ssrlab.exr import read_exr_planes  # noqa: E402


def run(command, **more):
    print("$", *command, flush=True)
    subprocess.run([str(c) for c in command], check=True, **more)


def main():
    ssrlab = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as place:
        place = Path(place)
        run([EXPERIMENTS / "bridges/captures" / "renderdoc_whole_run" / "run.sh", place / "frame.rdc", ssrlab,
             "gbuffer", "moving_objects", "--size", 96, 54, "--frame", 4, "--out", place / "own"])  # fmt: skip
        export = EXPERIMENTS / "bridges/captures" / "renderdoc_export.py"
        mapping = HERE / "renderdoc_mapping.json"
        run(["/usr/bin/python3", "-B", export, place / "frame.rdc", mapping, "--out", place / "exported"])
        own, exported = (read_exr_planes(place / f / "gbuffer.exr") for f in ("own", "exported"))
        different = {name: int((own[name] != exported[name]).sum()) for name in exported}
        print("values that differ:", different)
        cameras = [json.loads((place / f / "camera.json").read_text()) for f in ("own", "exported")]
        keys = ("clip_from_view", "view_from_world", "near", "far")
        apart = {k: np.abs(np.subtract(cameras[0][k], cameras[1][k])).max() for k in keys}
        print("cameras differ by:", apart)
        run([ssrlab, "capture", place / "exported"])
        # The matrix that ssrlab inverts in double precision is inverted from float32 here.
        sys.exit(1 if any(different.values()) or max(apart.values()) > 1e-6 else 0)


if __name__ == "__main__":
    main()
