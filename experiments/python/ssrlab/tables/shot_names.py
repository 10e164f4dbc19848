"""Short names of the shots in a table: the scene, and what differs among shots of one scene."""

import re
from collections import Counter

from ssrlab.mistakes import counted

SIZE = re.compile(r"\d+x\d+")
KINDS = ("camera", "size", "frames", "settings")


def parts(name):
    """The parts by kind of a name scene.camera.WxH[.fA[-B]][.nN][.wW][.rR][.settings], as experiments/study/config/shots/shot.cpp makes it;
    None for other names."""
    words = name.split(".")
    at = next((i for i, word in enumerate(words) if i > 1 and SIZE.fullmatch(word)), None)
    if at is None:
        return None
    frames = [word for word in words[at + 1 :] if re.fullmatch(r"f\d+(-\d+)?|[nwr]\d+", word)]
    settings = [word for word in words[at + 1 :] if word not in frames]
    return {"scene": words[0], "camera": ".".join(words[1:at]), "size": words[at], "frames": _frames(frames), "settings": " ".join(settings)}


def _frames(words):
    """f20-35 w12 as "frames 20 to 35 after 12 frames"."""
    said = []
    for word in words:
        kind, number = word[0], word[1:]
        if kind == "f":
            said.append(f"frames {number.replace('-', ' to ')}" if "-" in number else f"frame {number}")
        elif kind == "n":
            said.append(f"{number} of them")
        else:
            said.append(f"after {counted(int(number), 'frame')}" if kind == "w" else f"repeated {counted(int(number), 'time')}")
    return " ".join(said)


def short_names(shots):
    """{name: short name} of these shots; no two have the same."""
    known = {shot: found for shot in shots if (found := parts(shot))}
    names = {}
    for shot, own in known.items():
        same = [other for other in known.values() if other["scene"] == own["scene"]]
        differing = [own[kind] for kind in KINDS if len({other[kind] for other in same}) > 1]
        names[shot] = " ".join([own["scene"], *(word for word in differing if word)])
    return names


def about(shots):
    """What the short names leave out: once for most shots, and by name for those that differ; "" if nothing."""
    names = short_names(shots)
    known = {shot: parts(shot) for shot in names}
    if not known:
        return ""
    common, exceptions = [], {}
    for kind in KINDS:
        (most, count), *_ = Counter(own[kind] for own in known.values()).most_common(1)
        if 2 * count < len(known):
            continue  # each has its own, which the study's config says
        if most and kind != "size":  # the sizes stand beside the command
            common.append(f"camera {most}" if kind == "camera" else most)
        for shot, own in known.items():
            if own[kind] != most and own[kind] not in names[shot].split(" "):
                exceptions.setdefault(names[shot], []).append(own[kind] or f"without {most}")
    said = [", ".join(common)] if common else []
    said += [f"{name}: {', '.join(words)}" for name, words in exceptions.items()]
    return f"Shots: {'; '.join(said)}." if said else ""


def shown_names(table, names):
    """{name of a row or column: with short names of shots}, and the shots among them."""
    words = dict.fromkeys(word for name in names for word in name.split(", "))
    shots = [word for word in words if word in set(table.get("shots", ()))]
    short = short_names(shots)
    return {name: ", ".join(short.get(word, word) for word in name.split(", ")) for name in names}, shots
