"""A results folder in the form that figures, tables and other evaluations need."""

import copy
import os
import re
from dataclasses import dataclass

from ssrlab.csv_files import needed_number, number, read_rows, whole
from ssrlab.exr import ExrError, read_exr_rgb
from ssrlab.json_files import read_json
from ssrlab.mistakes import ResultsError, known, shown
from ssrlab.text_files import exists, path_inside

# manifest.json as far as scripts read it, as require() of json_files.py has shapes (experiments/docs/results_folder.md explains it).
_NUMBER, _TEXT = (float, None), (str, None)
_RUNG = {"rung": str, "target": str, "metric": str, "mask": str, "value?": _NUMBER, "low?": _NUMBER, "high?": _NUMBER}
_SHOT = {
    **{"shot": str, "scene?": str, "asset?": _TEXT, "label?": _TEXT, "group?": _TEXT, "width?": int, "height?": int, "frame?": int, "frames?": ([int], None)},
    **{"warm_up?": (int, None), "change?": (int, None), "exposure_ev?": _NUMBER, "truth_ladder?": [_RUNG], "references?": [{"hash": (str, int)}]},
    "reference?": ({"samples_median?": _NUMBER, "relative_error?": ({"median?": _NUMBER, "p95?": _NUMBER}, None)}, None),
}
_TECHNIQUE = {
    **{"technique": str, "point": str, "label?": _TEXT, "group?": _TEXT, "parameters?": dict, "uses_scene_data?": bool, "swept?": dict},
    "single_change?": {"parameter": str, "value": (bool, float, str)},
}
_IMAGE = {"shot?": _TEXT, "target?": _TEXT, "kind?": _TEXT, "technique": str, "point?": _TEXT, "frame?": (int, None), "seed?": (int, None), "exr?": _TEXT}
_CLOCK = {
    "proofs?": [{"verdict": str, "shots?": [str]}],
    "load?": [{"shot": str, "host?": {"name?": _TEXT}}],
    "aa_floors?": {"*": float},
}
_MAKER = {
    "ssrlab": {"commit": _TEXT, "dirty?": bool, "code?": str, "estimators?": int},
    **{"device?": {"name": str}, "finished?": str},
}
_LISTED = (str, [str])
_VALUES = (str, bool, float, [(str, bool, float)])
TABLE = {  # an entry of the config's "tables"
    **{"name": str, "caption": str, "of": str, "where?": {"*": _VALUES}, "rows": _LISTED, "columns": _LISTED},
    **{"over?": _TEXT, "sort?": _TEXT, "best?": (str, None), "labels?": {"*": str}},
}
MANIFEST = {
    **{"shots?": [_SHOT], "techniques?": [_TECHNIQUE], "images?": [_IMAGE], "clock?": _CLOCK, "provenance?": [_MAKER], "title?": str, "is_complete?": bool},
    **{"study?": {"name": str, "config": str}, "metrics?": {"*": {"better": str}}, "config?": ({"tables?": [TABLE]}, None)},
    **{"primary?": {"metric": str, "mask": str, "target": str}, "written?": {"ssrlab?": {"commit?": _TEXT}}},
}
_SCHEMA = {"resources": [{"name": str, "schema": {"fields": [{"name": str, "type": str, "unit?": str, "description?": str}]}}]}


def read_manifest(folder):
    file = path_inside(folder, "manifest.json")
    if not exists(file):
        raise ResultsError(f"{folder} is no results folder: it has no manifest.json; `ssrlab run` makes one")
    return read_json(file, MANIFEST)


def read_schema(folder):
    """{table: its fields} of schema.json; {} if there is none."""
    file = path_inside(folder, "schema.json")
    return {r["name"]: r["schema"]["fields"] for r in read_json(file, _SCHEMA)["resources"]} if exists(file) else {}


ONE_SEED = "none: 1 seed"  # experiments/results/verdicts/interval.h
BEST, TIED, EQUIVALENT, BEHIND = "best", "tied", "equivalent", "behind"  # experiments/results/verdicts/standings.h
LIKE_BEST = (TIED, EQUIVALENT)  # neither better than all others nor behind
# Which values of a metric are good, to how far a value is from the best one.
DIRECTIONS = {"lower": lambda v: v, "higher": lambda v: -v, "near_zero": abs, "near_one": lambda v: abs(v - 1)}
EVALUATED = {"summary.csv": ("technique", "represents_shot", "standing", "dominated"), "effects.csv": ("verdict",), "time_summary.csv": ("fits_from_ms",)}  # columns that decide; older versions wrote none


@dataclass
class Measured:
    """A value with its 95 % interval; low and high are None where there is none."""

    value: float
    low: float
    high: float
    is_one_seed: bool = False  # of a technique that draws random numbers: another seed might give anything

    def whiskers(self):
        """Lengths below and above the value, as matplotlib's errorbar takes them."""
        if self.low is None:
            return [[0.0], [0.0]]
        return [[max(self.value - self.low, 0.0)], [max(self.high - self.value, 0.0)]]


def label(technique, point):
    return technique if point in ("", "default") else f"{technique} {point}"


def rounded(text):
    """A point's name with three digits of its values: dda.thickness=0.009486833 gives dda.thickness=0.00949."""
    return re.sub(r"(?<==)-?\d+\.\d+(?=\s|$)", lambda number: f"{float(number.group()):.3g}", text)


def is_of(row, chosen):
    """Whether a row has the figure's target, metric and mask."""
    return (row["target"], row["metric"], row["mask"]) == (chosen.target, chosen.metric, chosen.mask)


def is_over_frames(row):
    """Whether a row stands for all frames of its shot: it then has no `frame`."""
    return row["frame"] == ""


def frame_number(row):
    """The number of a single frame's row."""
    return whole(row, "frame")


def representative_rows(rows):
    """The rows that represent each shot, as `ssrlab run` decided: over its frames, or of its last frame."""
    return [r for r in rows if r["represents_shot"] == "1"]


def programs_of(manifest):
    """The programs that made a study's cells. One that was built beside files of no commit counts as the committed program that wrote the tables, if both have the same code: those files are no part of either."""
    written = manifest.get("written", {}).get("ssrlab", {})
    is_committed = written.get("commit") and not written.get("dirty") and written.get("code")
    for maker in manifest.get("provenance", []):
        program = maker["ssrlab"]
        yield written if is_committed and program.get("dirty") and program.get("code") == written["code"] else program


def commits_of(manifest):
    """Commits of the programs that made a study's cells."""
    programs = programs_of(manifest)
    return " and ".join(dict.fromkeys((p["commit"] or "unknown") + (" with changes" if p.get("dirty") else "") for p in programs))


class Results:
    def __init__(self, folder):
        self.folder = folder
        self.manifest = read_manifest(folder)
        self.all_errors = self.read_csv("summary.csv")
        self.errors = representative_rows(self.all_errors)
        self.times = self.read_csv("time_summary.csv")
        self.splits = self.read_csv("splits.csv", is_optional=True)
        self.effects = self.read_csv("effects.csv", is_optional=True)
        self.hits = self.read_csv("hits.csv", is_optional=True)
        self.costs = self.read_csv("costs.csv", is_optional=True)
        self.estimates = self.read_csv("estimates.csv", is_optional=True)
        self.single_changes = self._single_changes()
        self.hidden = set(self.single_changes)  # of figures of whole points: these have figures of their own
        self.colors = {}  # (technique, point) to "#rrggbb", before those of the palette
        self.rounds_names = False  # those of points, in figures; tables and answers have all digits
        self.labels = {}  # names of points and shots to what stands in their place, before the study's own labels
        self.techniques = {(v["technique"], v["point"]): v for v in self.manifest.get("techniques", [])}
        self.shot_entries = {s.get("shot"): s for s in self.manifest.get("shots", [])}

    def own_label(self, technique, point):
        """The display name that a study gave a point; None if it gave none."""
        own = self.labels.get(label(technique, point)) or self.techniques.get((technique, point), {}).get("label")
        return own and shown(own)

    def point_label(self, technique, point):
        """The name of a point in tables and figures."""
        return self.own_label(technique, point) or shown(label(technique, self.point_name(technique, point)))

    def point_name(self, technique, point):
        """Rounded in figures, unless another point of the technique would then have the same name."""
        if not self.rounds_names or any(v == technique and p != point and rounded(p) == rounded(point) for v, p in self.techniques):
            return point
        return rounded(point)

    def unit_of(self, parameter):
        """The unit of a parameter, from schema.json; "" if it has none."""
        return next((field.get("unit", "") for field in read_schema(self.folder).get("parameters", []) if field["name"] == parameter), "")

    def point_group(self, technique, point):
        """The group of a point: its display name, else the technique's."""
        return shown(self.techniques.get((technique, point), {}).get("group") or self.labels.get(technique, technique))

    def shot_label(self, shot):
        return shown(self.labels.get(shot) or self.shot_entries.get(shot, {}).get("label") or shot)

    def asset(self, shot):
        """What a shot's scene shows. Scenes of one asset are not independent samples."""
        entry = self.shot_entries.get(shot, {})
        return entry.get("asset") or entry.get("scene") or shot

    def shot_group(self, shot):
        """The group of a shot: its display name, else its scene's."""
        entry = self.shot_entries.get(shot, {})
        return shown(entry.get("group") or entry.get("scene") or shot)

    def parameters_of(self, technique, point):
        """Values of all parameters of a point, by name."""
        return self.techniques.get((technique, point), {}).get("parameters", {})

    def narrowed(self, shots=None, points=None):
        """The results of these shots and (technique, point) alone, in this order; None: all, in the study's order. Named points are shown
        even if they are single changes."""
        view = copy.copy(self)

        def kept(rows):
            if points is not None:
                place = {key: i for i, key in enumerate(points)}
                rows = [r for r in rows if (r["technique"], r["point"]) in place]
                rows.sort(key=lambda r: place[r["technique"], r["point"]])
            if shots is not None:
                place_of_shot = {shot: i for i, shot in enumerate(shots)}
                rows = [r for r in rows if r["shot"] in place_of_shot]
                rows.sort(key=lambda r: place_of_shot[r["shot"]])
            return rows

        for name in ("all_errors", "errors", "times", "splits", "effects", "hits", "costs", "estimates"):
            setattr(view, name, kept(getattr(self, name)))
        if shots is not None:
            view.shot_entries = {shot: self.shot_entries.get(shot, {}) for shot in shots}
        if points is not None:
            view.hidden = set()
            view.single_changes = {}
        return view

    def read_csv(self, name, is_optional=False):
        file = path_inside(self.folder, name)
        if is_optional and not exists(file):
            return []
        columns, rows = read_rows(file)
        lacking = [c for c in EVALUATED.get(name, ()) if c not in columns]
        if lacking:
            writer = self.manifest.get("written", {}).get("ssrlab", {}).get("commit") or "another version"
            raise ResultsError(
                f"{file} has no column '{lacking[0]}': ssrlab of {writer} wrote it; run `ssrlab run` or `ssrlab merge` again, "
                "which keeps finished cells and makes the tables"
            )
        return rows

    def _single_changes(self):
        """{(technique, point): (parameter, value)} of swept points that differ from a baseline in one parameter."""
        return {
            (v["technique"], v["point"]): (v["single_change"]["parameter"], v["single_change"]["value"])
            for v in self.manifest.get("techniques", [])
            if "single_change" in v
        }

    def points(self):
        """The compared (technique, point), in the order of the study, without single changes, which have a figure of their own."""
        every = dict.fromkeys((r["technique"], r["point"]) for r in self.errors)
        return [key for key in every if key not in self.hidden]

    def measured(self, row, columns=("value", "low", "high")):
        """The row's value as Measured; None if it has none. Without an interval if it has one end alone."""
        value, low, high = (number(row, c) for c in columns)
        ends = (low, high) if None not in (low, high) else (None, None)
        return None if value is None else Measured(value, *ends, row.get("interval") == ONE_SEED)

    def direction_of(self, metric):
        """ "lower", "higher", "near_zero" or "near_one": which values of a metric are good."""
        metrics = self.manifest.get("metrics", {})
        if metric not in metrics or metrics[metric]["better"] not in DIRECTIONS:
            raise ResultsError(f"{os.path.join(self.folder, 'manifest.json')} does not say which values of {metric} are good: another version of ssrlab wrote it; run the study again")
        return metrics[metric]["better"]

    def shortfall(self, metric, value):
        """Distance of a value from the best possible: less is better, whatever the metric's direction."""
        return DIRECTIONS[self.direction_of(metric)](value)

    def error_rows(self, shot, target, metric, mask):
        """{(technique, point): row of summary.csv}."""
        where = (shot, target, metric, mask)
        return {(r["technique"], r["point"]): r for r in self.errors if (r["shot"], r["target"], r["metric"], r["mask"]) == where}

    def standings_of(self, shot, target, metric, mask):
        """{(technique, point): best, tied, equivalent or behind}, as ssrlab decided among the points of a shot."""
        return {key: row["standing"] for key, row in self.error_rows(shot, target, metric, mask).items()}

    def shots(self):
        """The measured shots; all shots if the study measures no errors."""
        return list(dict.fromkeys(row["shot"] for row in self.errors)) or list(self.shot_entries)

    def frames_text(self, rows):
        """The frames of one shot's rows, one text each; empty for a shot of one frame."""
        if len(self.shot_entries.get(rows[0]["shot"], {}).get("frames") or []) < 2:
            return []
        return list(
            dict.fromkeys("mean over frames" if is_over_frames(r) else f"frame {r['frame']} alone" for r in rows)
        )

    def headline_metric(self):
        """The metric that the study is made to compare, else the first."""
        found = list(dict.fromkeys(r["metric"] for r in self.errors))
        primary = self.manifest.get("primary", {}).get("metric", "mse")
        return primary if primary in found or not found else found[0]

    def errors_of(self, target, metric, mask, with_hidden=False):
        """{(shot, technique, point): Measured} in the order of the file, without values that are not finite, and without single changes
        unless `with_hidden`."""
        rows = [
            r
            for r in self.errors
            if (r["target"], r["metric"], r["mask"]) == (target, metric, mask)
            and (with_hidden or (r["technique"], r["point"]) not in self.hidden)
        ]
        if not rows:
            found = sorted({f"{r['target']} {r['metric']} {r['mask']}" for r in self.errors})
            raise ResultsError(
                f"{os.path.join(self.folder, 'summary.csv')} has no rows of target {target}, metric {metric}, mask {mask}; {known(f'{target} {metric} {mask}', found)}"
            )
        read = {(r["shot"], r["technique"], r["point"]): self.measured(r) for r in rows}
        return {key: value for key, value in read.items() if value is not None}

    def times_of(self, shot):
        """{(technique, point): {stage: Measured}} in ms, without G-buffer and lit colour, which belong to no technique."""
        stages = {}
        for r in self.times:
            if r["shot"] == shot and r["technique"]:
                stages.setdefault((r["technique"], r["point"]), {})[r["stage"]] = Measured(*(needed_number(r, c) for c in ("median_ms", "low_ms", "high_ms")))
        return stages

    def costs_of(self, shot, quantity):
        """{(technique, point): {stage: Measured}} of counts, which are exact and have no interval."""
        stages = {}
        for r in self.costs:
            if r["shot"] == shot and r["quantity"] == quantity:
                stages.setdefault((r["technique"], r["point"]), {})[r["stage"]] = Measured(needed_number(r, "value"), None, None)
        return stages

    def estimated_chips(self):
        """The chips with an estimate for some stage, in the order of the study."""
        return list(dict.fromkeys(r["chip"] for r in self.estimates if r["microseconds"]))

    def estimates_of(self, shot, chip):
        """{(technique, point): {stage: Measured}} in microseconds; points and stages without an estimate are left out."""
        stages = {}
        for r in self.estimates:
            if r["shot"] == shot and r["chip"] == chip and not r["refusal"]:
                stages.setdefault((r["technique"], r["point"]), {})[r["stage"]] = Measured(*(needed_number(r, c) for c in ("microseconds", "low", "high")))
        return stages

    def warnings_of_times(self, shots):
        """Reasons to doubt the times of these shots: sentences without a full stop."""
        shares = [number(r, "disturbed_share") or 0.0 for r in self.times if r["shot"] in shots and r["technique"]]
        proofs = self.manifest.get("clock", {}).get("proofs", [])
        proven = {shot for proof in proofs if proof["verdict"] == "passed" for shot in proof.get("shots", [])}
        found = [f"other programs disturbed up to {100 * max(shares):.0f} % of the timed frames"] if max(shares, default=0.0) > 0 else []
        return found + (["timer not validated"] if proofs and not set(shots) <= proven else [])

    def exposure(self, shot):
        """The shot's exposure in EV."""
        return self.shot_entries.get(shot, {}).get("exposure_ev") or 0.0

    def _last_frame(self, shot):
        frames = [i.get("frame") or 0 for i in self.manifest.get("images", []) if i.get("shot") == shot]
        return max(frames, default=0)

    def frames_with_images(self, shot, target):
        """Numbers of the frames whose images were kept, ascending."""
        images = self.manifest.get("images", [])
        own = [i for i in images if i.get("shot") == shot and i.get("target") == target and i.get("kind") in ("result", "played")]
        return sorted({i.get("frame") or 0 for i in own})

    def images_of(self, shot, target, frame=None, keys=None):
        """{(technique, point): RGB image} of the first seed; the reference has the key ("reference", ""). By default of the last frame, and
        of all points but single changes."""
        frame = self._last_frame(shot) if frame is None else frame
        entries = [
            i
            for i in self.manifest.get("images", [])
            if i.get("shot") == shot
            and i.get("target") == target
            and (i.get("frame") or 0) == frame
            and i.get("kind") in ("result", "reference", "played")
            and ((i["technique"], i.get("point") or "") in keys if keys else (i["technique"], i.get("point") or "") not in self.hidden)
        ]
        first = {}
        for entry in sorted(entries, key=lambda i: i.get("seed") or 0):
            first.setdefault((entry["technique"], entry.get("point") or ""), entry["exr"])
        order = {(i["technique"], i.get("point") or ""): n for n, i in reversed(list(enumerate(entries)))}
        try:
            manifest = os.path.join(self.folder, "manifest.json")
            files = {key: path_inside(self.folder, first[key], f"{manifest}: images: 'exr'") for key in sorted(first, key=order.get)}
            return {key: read_exr_rgb(file) for key, file in files.items()}
        except ExrError as e:
            raise ResultsError(str(e)) from e
