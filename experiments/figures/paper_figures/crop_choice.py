"""figures.json: the crops that the report's viewer collects (its page/viewer/crops.js writes the file)."""

import json
import math
from dataclasses import dataclass
from difflib import get_close_matches

from paper_figures.results import ResultsError

TONE_CURVES = ("none", "reinhard", "aces")
MOST_POINTS = 7  # besides the truth: what fits into the width of a page
KEYS = ("shot", "frame", "target", "box", "exposure", "tone_curve", "points")


@dataclass
class Crop:
    box: tuple  # x, y, width, height in pixels, y from the top
    exposure: float  # EV
    tone_curve: str = "none"
    where: str = ""  # file and place, for mistakes


@dataclass
class ShotCrops:
    """What the figure of a shot shows."""

    crops: list
    target: str
    frame: int | None  # None: the shot's last
    points: dict  # (variant, point) to file and place where it is first named


class _Reader:
    """One crop of the file; mistakes are said with file and key."""

    def __init__(self, file, index, crop):
        self.where, self.crop = f"{file}: crops[{index}]", crop
        if not isinstance(crop, dict):
            raise ResultsError(f"{self.where} must be an object, not {json.dumps(crop)}")
        for key in crop:
            if key not in KEYS:
                near = get_close_matches(key, KEYS, 1)
                raise ResultsError(f"{self.where}: '{key}' is not known{f'; did you mean {near[0]!r}?' if near else ''}")

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


def _is_box(value):
    return (
        isinstance(value, list)
        and len(value) == 4
        and all(map(_is_whole, value))
        and min(value[:2]) >= 0
        and min(value[2:]) >= 1
    )


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _are_points(value):
    return (
        isinstance(value, list)
        and value
        and all(isinstance(p, dict) and set(p) == {"variant", "point"} and all(isinstance(t, str) for t in p.values()) for p in value)
    )


def read_crops(file, results):
    """{shot: ShotCrops}, in the file's order; whether boxes and points are the images' own is found when they are drawn."""
    try:
        with open(file, encoding="utf-8") as text:
            content = json.load(text)
    except OSError as e:
        raise ResultsError(f"cannot read {file}: {e.strerror}") from e
    except ValueError as e:
        raise ResultsError(f"{file} is not valid JSON: {e}") from e
    if not isinstance(content, dict) or not isinstance(content.get("crops"), list):
        raise ResultsError(f"{file} must be an object with an array 'crops'")
    shots = {}
    for index, crop in enumerate(content["crops"]):
        read = _Reader(file, index, crop)
        shot = read.value("shot", lambda v: v in results.shots(), f"one of {', '.join(results.shots())}")
        target = read.value("target", lambda v: isinstance(v, str), "a text", "image")
        frame = read.value("frame", lambda v: _is_whole(v) and v >= 0, "the number of a frame", None)
        own = shots.setdefault(shot, ShotCrops([], target, frame, {}))
        for key, value, first in (("target", target, own.target), ("frame", frame, own.frame)):
            if value != first:
                read.fail(key, f"{json.dumps(first)} as in the first crop of {shot}: they share a figure")
        for p in read.value("points", _are_points, 'an array of {"variant", "point"}'):
            own.points.setdefault((p["variant"], p["point"]), read.where)
        if len(own.points) > MOST_POINTS:
            read.fail("points", f"no more than {MOST_POINTS} together with those of the other crops of {shot}")
        own.crops.append(
            Crop(
                tuple(read.value("box", _is_box, "[x, y, width, height] in pixels")),
                read.value("exposure", _is_number, "a number of EV", results.exposure(shot)),
                read.value("tone_curve", lambda v: v in TONE_CURVES, f"one of {', '.join(TONE_CURVES)}", "none"),
                read.where,
            )
        )
    return shots


def check_box(crop, width, height):
    x, y, w, h = crop.box
    if x + w > width or y + h > height:
        raise ResultsError(f"{crop.where}: 'box' {[x, y, w, h]} does not lie within its image of {width} x {height} pixels")
