"""No engine: gives back what it got, so that everything around a program is tested without any."""
import array
import json
import sys
import time
from pathlib import Path


def floats(path):
    values = array.array("f")
    values.frombytes(path.read_bytes())
    return values


def main():
    request = json.loads(Path(sys.argv[1]).read_text())
    folder, out, settings = Path(request["folder"]), Path(request["out"]), request["settings"]
    if settings["wrong"] == "scene":
        print("starting\nerror: this scene has too many echoes")
        sys.exit(2)
    if settings["wrong"] == "crash":
        print("the last words")
        sys.exit(1)
    if settings["wrong"] == "endless":
        time.sleep(600)
    for view in request["scene"]["views"]:
        for frame in view["frames"]:
            place = out / view["view"]
            (place / f"f{frame['frame']}.depth.f32").write_bytes((folder / frame["depth_raw"]).read_bytes())
            light = floats(folder / frame["light_raw"])
            (place / f"f{frame['frame']}.off.f32").write_bytes(light.tobytes())
            for seed in range(request["seeds"]):
                image = array.array("f", (value + settings["reflection"] * (1 + seed) for value in light))
                (place / f"f{frame['frame']}.s{seed}.f32").write_bytes(image.tobytes())
    (out / "done.json").write_text(json.dumps({"driver": "none", "version": "2" if settings["wrong"] == "version" else "1"}))


main()
