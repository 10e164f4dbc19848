"""The crops of figures.json, as the report's viewer collects them (its page/viewer/crops.js writes the file)."""

import json
import math
from dataclasses import dataclass

from ssrlab.figures.request import refuse_unknown
from ssrlab.mistakes import ResultsError, say

TONE_CURVES = ("none", "reinhard", "aces")
AUTO = "auto"
KEYS = ("shot", "frame", "target", "box", "exposure", "tone_curve", "points")


@dataclass
class Crop:
    box: tuple  # x, y, width, height in pixels, y from the top
    exposure: float | str = AUTO  # EV, or chosen from the truth's pixels
    tone_curve: str = "none"
    where: str = ""  # file and place, for mistakes


@dataclass
class ShotCrops:
    """The crops and points in the figure of a shot."""

    crops: list
    target: str
    frame: int | None  # None: the shot's last
    points: dict  # (technique, point) to file and place where it is first named


class _Reader:
    """Reads one crop of the file; messages name file and key."""

    def __init__(self, file, index, crop):
        self.where, self.crop = f"{file}: crops[{index}]", crop
        refuse_unknown(self.where, crop, KEYS)

    def fail(self, key, wanted):
        found = f"not {json.dumps(self.crop[key])}" if key in self.crop else "and is missing"
        raise ResultsError(f"{self.where}: '{key}' must be {wanted}, {found}")

    def value(self, key, fits, wanted, *fallback):
        if key not in self.crop and fallback:
            return fallback[0]
        if key not in self.crop or not fits(self.crop[key]):
            self.fail(key, wanted)
        return self.crop[key]


def _is_whole(value):
    return isinstance(value, int) and not isinstance(value, bool)


def is_box(value):
    return (
        isinstance(value, list)
        and len(value) == 4
        and all(map(_is_whole, value))
        and min(value[:2]) >= 0
        and min(value[2:]) >= 1
    )


def is_exposure(value):
    return value == AUTO or isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _present(point):
    """A point with the key `technique`, which files of older versions call `variant`."""
    return {"technique" if key == "variant" else key: text for key, text in point.items()}


def _are_points(value):
    return (
        isinstance(value, list)
        and value
        and all(isinstance(p, dict) and set(_present(p)) == {"technique", "point"} and all(isinstance(t, str) for t in p.values()) for p in value)
    )


def read_crops(file, content, results):
    """{shot: ShotCrops} of the `crops` of a file, in its order. Drawing checks whether boxes and points fit the images."""
    shots = {}
    for index, crop in enumerate(content.get("crops", [])):
        read = _Reader(file, index, crop)
        shot = read.value("shot", lambda v: v in results.shots(), f"one of {', '.join(results.shots())}")
        target = read.value("target", lambda v: isinstance(v, str), "a text", "image")
        frame = read.value("frame", lambda v: _is_whole(v) and v >= 0, "the number of a frame", None)
        own = shots.setdefault(shot, ShotCrops([], target, frame, {}))
        for key, value, first in (("target", target, own.target), ("frame", frame, own.frame)):
            if value != first:
                read.fail(key, f"{json.dumps(first)} as in the first crop of {shot}: they share a figure")
        points = read.value("points", _are_points, 'an array of {"technique", "point"}')
        if any("variant" in p for p in points) and not shots[shot].crops:
            say(f"note: {read.where}: 'variant' is read as 'technique', its name")
        for p in map(_present, points):
            own.points.setdefault((p["technique"], p["point"]), read.where)
        own.crops.append(
            Crop(
                tuple(read.value("box", is_box, "[x, y, width, height] in pixels")),
                read.value("exposure", is_exposure, "a number of EV or \"auto\"", AUTO),
                read.value("tone_curve", lambda v: v in TONE_CURVES, f"one of {', '.join(TONE_CURVES)}", "none"),
                read.where,
            )
        )
    return shots


def check_box(crop, width, height):
    x, y, w, h = crop.box
    if x + w > width or y + h > height:
        raise ResultsError(f"{crop.where}: 'box' {[x, y, w, h]} does not lie within its image of {width} x {height} pixels")
