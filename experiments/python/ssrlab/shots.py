"""Entries of a config's `shots` in the forms that scripts need: one by one, and as arguments of `ssrlab scene-for`."""

import hashlib
import itertools


def in_a_row(shot):
    """Expands a shot of `room:*` into `count` shots of single scenes, from number `first`."""
    numbers = {k: v for k, v in shot.items() if k in ("first", "count")}
    shot = {k: v for k, v in shot.items() if k not in numbers}
    if not shot.get("scene", "").endswith(":*"):
        return [shot]
    first = numbers.get("first", 0)
    return [shot | {"scene": f"{shot['scene'][:-1]}{i}"} for i in range(first, first + numbers["count"])]


def single_shots(entries):
    """One entry for each combination of the scenes, cameras, settings, sizes and frames that entries of `shots` list."""
    found = []
    for entry in entries:
        names = ("scene", "camera", "lit", "lit_specular", "fallback", "depth_format", "depth_direction", "normal_encoding", "gbuffer_formats")
        lists = {k: entry[k] for k in names if isinstance(entry.get(k), list)}
        if isinstance(entry.get("resolution", [0])[0], list):
            lists["resolution"] = entry["resolution"]
        if isinstance(entry.get("frames"), list) and not isinstance(entry["frames"][0], int):
            lists["frames"] = entry["frames"]
        for values in itertools.product(*lists.values()):
            found += in_a_row(entry | dict(zip(lists, values)))
    return found


def scene_for_words(shot, study):
    """Arguments of `ssrlab scene-for any` for one shot of a study, without --out. The study then finds its light in the cache."""
    frames = shot.get("frames", [0])
    if isinstance(frames, dict):
        frames = range(frames["from"], frames["to"] + 1)
    words = [shot["scene"], *(["--camera", shot["camera"]] if "camera" in shot else [])]
    words += ["--size", *map(str, shot.get("resolution", study.get("resolution", [480, 270]))), "--frames", *map(str, frames)]
    words += ["--fallback", shot.get("fallback", study.get("fallback", "environment"))]
    for name in ("samples", "lit_samples"):
        if name in study.get("reference", {}):
            words += [f"--{name.replace('_', '-')}", str(study["reference"][name])]
    return words + (["--ladder"] if "on_screen" in study.get("targets", []) else [])


def scene_folder_name(words):
    """A folder name for the output of `ssrlab scene-for` with the arguments `words`, unique to them."""
    scene = "".join(c if c.isalnum() or c in "_-" else "_" for c in words[0])
    return f"{scene}_{hashlib.sha256(' '.join(words).encode()).hexdigest()[:8]}"
