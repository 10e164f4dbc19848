"""Entries of a config's `shots` as scripts need them: one by one, and as `ssrlab scene-for` is asked for them."""

import hashlib
import itertools


def in_a_row(shot):
    """A shot of `room:*` is one of each of `count` scenes from number `first` on."""
    numbers = {k: v for k, v in shot.items() if k in ("first", "count")}
    shot = {k: v for k, v in shot.items() if k not in numbers}
    if not shot.get("scene", "").endswith(":*"):
        return [shot]
    first = numbers.get("first", 0)
    return [shot | {"scene": f"{shot['scene'][:-1]}{i}"} for i in range(first, first + numbers["count"])]


def single_shots(entries):
    """Entries of `shots`, those that list scenes, cameras, settings, sizes or frames taken apart."""
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
    """What `ssrlab scene-for any` is asked for, of one shot of a study: scene and options but --out, so that the study finds its light cached."""
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
    """A name for what scene-for writes when it is asked for `words`, and for nothing else."""
    scene = "".join(c if c.isalnum() or c in "_-" else "_" for c in words[0])
    return f"{scene}_{hashlib.sha256(' '.join(words).encode()).hexdigest()[:8]}"
