"""figures.json: which figures are made, of which shots and points, how large, in which look (experiments/docs/figures.md has its
keys). What the report's viewer writes has crops alone: then all figures of the study are made, with these crops."""

import json
import math
import re
from dataclasses import dataclass, field, replace
from difflib import get_close_matches

from ssrlab.figures import style
from ssrlab.json_files import read_json
from ssrlab.mistakes import ResultsError
from ssrlab.results import label

TEXTS = ("target", "metric", "mask")
EVERY = {"kind", "name", "shots", "points", "labels", "width", "height", *TEXTS}
SHARED = {"crops", "figures", "shots", "points", "labels", "colors", "font", "formats", "width", *TEXTS}
OPTIONS = {  # keys of one kind alone
    "error_time": {"front"},
    "stage_times": set(),
    "stage_costs": {"quantity"},
    "stage_estimates": {"chip"},
    "fits": set(),
    "ladder": set(),
    "response": {"parameter", "where", "show"},
    "map": {"x", "y", "where", "show"},
    "convergence": {"over", "where"},
    "crops": {"columns", "rows", "boxes", "exposure", "tone_curve"},
    "motion": set(),
    "roughness_error": set(),
    "roughness_bias": set(),
    "bias_variance": set(),
    "effects": set(),
    "temporal": set(),
    "frames": set(),
    "fetches": set(),
}
NEEDED = {"response": ("parameter",), "map": ("x", "y"), "convergence": ("over",)}


@dataclass
class Request:
    """The request of one figure."""

    kind: str
    name: str  # of its files
    target: str
    metric: str
    mask: str
    shots: list | None = None  # None: all of the study
    points: list | None = None  # (technique, point); None: all but single changes
    labels: dict = field(default_factory=dict)
    width: float | None = None  # cm; None: what its kind takes
    height: float | None = None  # cm, of a row of panels
    crops: dict = field(default_factory=dict)  # by shot
    options: dict = field(default_factory=dict)  # of its kind
    where: str = ""  # file and place, for mistakes

    def option(self, key, fallback=None):
        return self.options.get(key, fallback)


@dataclass
class Look:
    """The look that all figures of a file share."""

    font: str = "sans"
    formats: tuple = style.FORMATS


def read_choice(file):
    content = read_json(file, has_comments=True)
    if not {"crops", "figures"} & set(content):
        raise ResultsError(f"{file} must be an object with an array 'figures' or 'crops'")
    for key in ("crops", "figures"):
        if not isinstance(content.get(key, []), list):
            raise ResultsError(f"{file}: '{key}' must be an array")
    return content


def near(key, known):
    found = get_close_matches(key, known, 1)
    return f"; did you mean {found[0]!r}?" if found else f"; known are {', '.join(sorted(known))}"


def refuse_unknown(where, entry, known):
    if not isinstance(entry, dict):
        raise ResultsError(f"{where} must be an object, not {json.dumps(entry)}")
    for key in entry:
        if key not in known:
            raise ResultsError(f"{where}: '{key}' is not known{near(key, known)}")


def _fits(pattern, text):
    return re.fullmatch(".*".join(map(re.escape, pattern.split("*"))), text) is not None


def _texts(where, key, value):
    if isinstance(value, str):
        return [value]
    if not isinstance(value, list) or not value or not all(isinstance(v, str) for v in value):
        raise ResultsError(f"{where}: '{key}' must be a text or an array of texts, not {json.dumps(value)}")
    return value


def chosen_names(where, key, patterns, names):
    """Of {name: what it names}, the values whose names fit a pattern ("*": any letters), in the order of the patterns. A pattern that fits
    none is a mistake."""
    found = {}
    for pattern in _texts(where, key, patterns):
        fitting = [name for name in names if _fits(pattern, name)]
        if not fitting:
            raise ResultsError(f"{where}: '{key}' has \"{pattern}\", which the results do not hold{near(pattern, list(names))}")
        found |= dict.fromkeys(names[name] for name in fitting)
    return list(found)


def _point_names(results, labels):
    """{name or display name: (technique, point)} of all points, single changes too."""
    keys = list(results.techniques) or results.points()
    shown = {labels.get(label(*k)) or results.own_label(*k): k for k in keys}
    return {name: key for name, key in shown.items() if name} | {label(*k): k for k in keys}


def _shot_names(results, labels):
    return {labels.get(s) or results.shot_label(s): s for s in results.shots()} | {s: s for s in results.shots()}


def _centimetres(where, key, value, names):
    if isinstance(value, str) and value in names:
        return names[value]
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value) or not 2 <= value <= 100:
        known = "".join(f'"{name}" ({cm:g}), ' for name, cm in names.items())
        raise ResultsError(f"{where}: '{key}' must be {known}or a number of cm from 2 to 100, not {json.dumps(value)}")
    return float(value)


def _one_of(where, key, value, known):
    if value not in known:
        raise ResultsError(f"{where}: '{key}' must be one of {', '.join(known)}, not {json.dumps(value)}")
    return value


def read_look(where, content):
    font = _one_of(where, "font", content.get("font", "sans"), tuple(style.FONTS))
    formats = _texts(where, "formats", content.get("formats", list(style.FORMATS)))
    return Look(font, tuple(_one_of(where, "formats", f, style.FORMATS) for f in formats))


def _text_map(where, key, value):
    if not isinstance(value, dict) or not all(isinstance(v, str) for v in value.values()):
        raise ResultsError(f"{where}: '{key}' must be an object of texts, not {json.dumps(value)}")
    return value


def read_colors(where, content, results):
    """{(technique, point): colour} of the points that the names fit."""
    colors = {}
    for name, color in _text_map(where, "colors", content.get("colors", {})).items():
        if not re.fullmatch(r"#[0-9a-fA-F]{6}", color):
            raise ResultsError(f"{where}: 'colors' has \"{color}\" for {name}, but must be \"#rrggbb\"")
        colors |= dict.fromkeys(chosen_names(where, "colors", [name], _point_names(results, content.get("labels", {}))), color)
    return colors


def _request(where, entry, defaults, results):
    """`entry`, completed by what the file says for all figures."""
    refuse_unknown(where, {k: v for k, v in entry.items() if k == "kind"}, EVERY)
    kind = _one_of(where, "kind", entry.get("kind"), tuple(OPTIONS))
    refuse_unknown(where, entry, EVERY | OPTIONS[kind])
    for key in NEEDED.get(kind, ()):
        if key not in entry:
            raise ResultsError(f"{where}: a figure of the kind {kind} needs '{key}'")
    merged = defaults | entry
    texts = {}
    for key in TEXTS:
        texts[key] = merged[key]
        if not isinstance(texts[key], str):
            raise ResultsError(f"{where}: '{key}' must be a text, not {json.dumps(texts[key])}")
    name = merged.get("name", kind)
    if not isinstance(name, str) or not name:
        raise ResultsError(f"{where}: 'name' must be a text, not {json.dumps(name)}")
    shots, points = merged.get("shots"), merged.get("points")
    labels = defaults.get("labels", {}) | _text_map(where, "labels", entry.get("labels", {}))
    return Request(
        kind,
        name,
        **texts,
        shots=None if shots is None else chosen_names(where, "shots", shots, _shot_names(results, labels)),
        points=None if points is None else chosen_names(where, "points", points, _point_names(results, labels)),
        labels=labels,
        width=_centimetres(where, "width", merged["width"], style.WIDTHS) if "width" in merged else None,
        height=_centimetres(where, "height", merged["height"], {}) if "height" in merged else None,
        options={key: entry[key] for key in OPTIONS[kind] if key in entry},
        where=where,
    )


def read_requests(file, content, results, defaults, unasked=()):
    """The figures of a file, checked. If it names none: one Request of each kind of `unasked`, with what the file says for all figures.
    `defaults`: target, metric and mask of figures without their own."""
    refuse_unknown(file, content, SHARED)
    shared = {k: v for k, v in content.items() if k in EVERY} | defaults
    _text_map(file, "labels", content.get("labels", {}))
    if "figures" not in content:
        return [replace(_request(file, {"kind": kind}, shared, results), where="") for kind in unasked]
    requests = []
    for index, entry in enumerate(content["figures"]):
        where = f"{file}: figures[{index}]"
        if not isinstance(entry, dict):
            raise ResultsError(f"{where} must be an object, not {json.dumps(entry)}")
        requests.append(_request(where, entry, shared, results))
        if requests[-1].name in {r.name for r in requests[:-1]}:
            raise ResultsError(f"{where}: another figure is named '{requests[-1].name}' already: give it a 'name'")
    return requests
