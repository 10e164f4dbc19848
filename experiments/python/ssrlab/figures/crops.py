"""Crops of the reference and of techniques, with error maps and numbers: where techniques fail, and how badly."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import Rectangle

from ssrlab.figures import numbers, style
from ssrlab.figures.crop_choice import AUTO, TONE_CURVES as CURVE_NAMES, Crop, check_box, is_box, is_exposure
from ssrlab.csv_files import number
from ssrlab.mistakes import ResultsError
from ssrlab.results import BEST, LIKE_BEST, is_of, label

REFERENCE = ("reference", "")
MOST_POINTS = 6  # of those that nobody chose
LEAST_CELL = 2.4  # cm, of a picture
WHITE = 0.95  # of the display's range: what the brightest percent of the truth is exposed to begin at
NOISY = 0.1  # relative standard error of the truth, and share of an error that is its noise, from where on a figure says so
PARTS = ("image", "crops", "maps")
LINES = ("-", "--", ":", "-.")
BOX_COLORS = ["#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#d55e00", "#0072b2"]

# From exposed radiance, each channel by itself, as the report's viewer has them (experiments/page/images/colors.js).
TONE_CURVES = {
    "none": lambda v: v,
    "reinhard": lambda v: v / (1 + v),  # Reinhard et al. 2002
    "aces": lambda v: v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14),  # Narkowicz 2015
}


def display(image, exposure, tone_curve="none"):
    """The image in sRGB (IEC 61966-2-1) at this exposure (EV); pixels that are not finite are magenta."""
    exposed = np.maximum(np.nan_to_num(image.astype(np.float64) * 2.0**exposure), 0.0)
    linear = np.clip(TONE_CURVES[tone_curve](exposed), 0.0, 1.0)
    coded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    coded[~np.isfinite(image).all(axis=-1)] = (1.0, 0.0, 1.0)
    return coded


def absolute_error(image, reference):
    """Mean over channels of |d|; NaN where a pixel is not finite."""
    with np.errstate(invalid="ignore"):
        error = np.abs(image.astype(np.float64) - reference.astype(np.float64)).mean(axis=-1)
    return np.where(np.isfinite(error), error, np.nan)


def crop_boxes(error, count):
    """The `count` disjoint boxes (x, y, width, height) of largest mean `error`, in descending order."""
    height, width = error.shape
    size_y = max(height // 4, min(height, 4))
    size_x = min(width, max(round(size_y * 4 / 3), 4))
    integral = np.pad(np.nan_to_num(error), ((1, 0), (1, 0))).cumsum(0).cumsum(1)
    sums = (
        integral[size_y:, size_x:]
        - integral[:-size_y, size_x:]
        - integral[size_y:, :-size_x]
        + integral[:-size_y, :-size_x]
    )
    boxes = []
    for _ in range(count):
        y, x = np.unravel_index(np.argmax(sums), sums.shape)
        if not np.isfinite(sums[y, x]):
            break
        boxes.append((int(x), int(y), size_x, size_y))
        sums[max(y - size_y + 1, 0) : y + size_y, max(x - size_x + 1, 0) : x + size_x] = -np.inf
    return boxes


def show(axes, picture, **options):
    axes.imshow(picture, interpolation="nearest", **options)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _frame(axes, place):
    """As the box that `_draw_box` draws."""
    for spine in axes.spines.values():
        spine.set(visible=True, color=BOX_COLORS[place % len(BOX_COLORS)], linestyle=LINES[place % len(LINES)], linewidth=1.4)


def auto_exposure(truth, tone_curve="none"):
    """The exposure (EV, in quarters) that puts the 99th percentile of the truth's largest channels just below white, so that few pixels are
    clipped and dark scenes are visible. With a tone curve, which keeps highlights, that percentile gets a radiance of 1."""
    finite = truth[np.isfinite(truth).all(axis=-1)]
    bright = float(np.quantile(finite.max(axis=-1), 0.99)) if len(finite) else 0.0
    if bright <= 0:
        return 0.0
    return float(np.floor(4 * np.log2((WHITE if tone_curve == "none" else 1.0) / bright)) / 4)


def best_of_each(results, images, errors, shot, metric):
    """`none`, and the point of least error of each technique without scene data, by ascending error."""
    techniques = {}
    for key in images:
        is_exact = results.techniques.get(key, {}).get("uses_scene_data", False)
        error = errors.get((shot, *key))
        if key[0] not in ("reference", "none") and not is_exact:
            techniques.setdefault(key[0], []).append((results.shortfall(metric, error.value) if error else np.inf, key))
    best = sorted(min(points) for points in techniques.values())
    return [key for key in images if key[0] == "none"][:1] + [key for _, key in best][: MOST_POINTS - 1]


def _target(results, shot):
    found = {
        i.get("target")
        for i in results.manifest.get("images", [])
        if i.get("shot") == shot and i.get("kind") == "reference"
    }
    return next((t for t in ("image", "specular", "incident") if t in found), None)


def _images(results, shot, target, frame, keys):
    """The truth's and the points' images, those of `keys` ({key: where it is named}) or all there are."""
    is_rung = target in ("camera_radiance", "on_screen")  # compared with what arrives
    wanted = [*keys, REFERENCE] if keys else None
    images = results.images_of(shot, "incident" if is_rung else target, frame, wanted)
    if is_rung:
        images |= results.images_of(shot, target, frame, [REFERENCE])
    for key, where in keys.items():
        if key not in images:
            what = "the truth" if key == REFERENCE else f"'{label(*key)}'"
            when = "last frame" if frame is None else f"frame {frame}"
            raise ResultsError(f"{where}: the results have no image of {what} for 'target' {target} in {shot}, {when}")
    return images


def _own_crops(chosen, maps, truth):
    """Boxes that the request names or counts, else where the techniques err most."""
    boxes = chosen.option("boxes", 2)
    exposure, curve = chosen.option("exposure", AUTO), chosen.option("tone_curve", "none")
    if not is_exposure(exposure):
        raise ResultsError(f"{chosen.where}: 'exposure' must be a number of EV or \"auto\", not {exposure}")
    if curve not in CURVE_NAMES:
        raise ResultsError(f"{chosen.where}: 'tone_curve' must be one of {', '.join(CURVE_NAMES)}, not {curve}")
    if isinstance(boxes, int) and not isinstance(boxes, bool) and 0 <= boxes <= 6:
        boxes = crop_boxes(np.nanmean(np.nan_to_num(np.stack(maps)), axis=0), boxes)
    elif not isinstance(boxes, list) or not all(map(is_box, boxes)):
        raise ResultsError(f"{chosen.where}: 'boxes' must be how many (0 to 6), or an array of [x, y, width, height] in pixels")
    return [Crop(tuple(box), exposure, curve, chosen.where) for box in boxes]


def _exposed(crops, truth):
    """Exposure and curve of the whole image, and the crops with their exposures chosen."""
    for crop in crops:
        check_box(crop, truth.shape[1], truth.shape[0])
    of_crops = []
    for crop in crops:
        x, y, w, h = crop.box
        exposure = auto_exposure(truth[y : y + h, x : x + w], crop.tone_curve) if crop.exposure == AUTO else crop.exposure
        of_crops.append(Crop(crop.box, exposure, crop.tone_curve, crop.where))
    curve = crops[0].tone_curve if crops else "none"
    whole = auto_exposure(truth, curve) if not crops or crops[0].exposure == AUTO else crops[0].exposure
    return (whole, curve), of_crops


def _parts(chosen):
    parts = chosen.option("rows", list(PARTS))
    if not isinstance(parts, list) or not parts or any(p not in PARTS for p in parts):
        raise ResultsError(f"{chosen.where}: 'rows' must be an array of {', '.join(PARTS)}, not {parts}")
    return parts


def draw(results, shot, chosen):
    """Uses the boxes, points and exposures that figures.json has for this shot, else the largest errors."""
    collected = chosen.crops.get(shot)
    target = collected.target if collected else _target(results, shot)
    if target is None:
        return None
    errors = results.errors_of(chosen.target, chosen.metric, chosen.mask, with_hidden=True)
    keys = dict.fromkeys(chosen.points, chosen.where) if chosen.points else collected.points if collected else {}
    if keys:
        keys = {REFERENCE: chosen.where or collected.crops[0].where, **keys}
    images = _images(results, shot, target, collected.frame if collected else None, keys)
    shown = [k for k in keys if k != REFERENCE] or best_of_each(results, images, errors, shot, chosen.metric)
    if not shown or REFERENCE not in images:
        return None
    truth = images[REFERENCE]
    for key in shown:
        if images[key].shape != truth.shape:
            raise ResultsError(f"the images of shot {shot} differ in size: {label(*key)} is not like the reference")
    maps = {key: absolute_error(images[key], truth) for key in shown}
    techniques = [maps[k] for k in shown if k[0] != "none"] or list(maps.values())
    look, crops = _exposed(collected.crops if collected else _own_crops(chosen, techniques, truth), truth)
    of_shot = {key: errors.get((shot, *key)) for key in shown}
    marks = results.standings_of(shot, chosen.target, chosen.metric, chosen.mask)
    cell = 0.95 * _width(chosen) / min(_most_columns(chosen), len(shown) + 1)
    titles = [_truth_title(results, shot), *(_title(results, k, of_shot[k], chosen, marks, cell) for k in shown)]
    grid = _Grid(chosen, truth, crops, titles)
    grid.begin(_below(results, shot, target, chosen, of_shot, look, crops))
    maximum = max(float(np.nanquantile(m, 0.99)) for m in maps.values()) or 1.0
    for index, (key, title) in enumerate(zip([REFERENCE, *shown], titles)):
        grid.draw(index, title, marks.get(key) == BEST, images[key], truth, maps.get(key), look, maximum)
    grid.finish(maximum)
    return grid.figure


def _title(results, key, error, chosen, marks, cell):
    widening = 1.15 if marks.get(key) == BEST else 1.0  # of bold letters
    text = style.fitted(results.point_label(*key), 0.95 * cell / widening)
    if error is None:
        return text
    value, _, interval = numbers.with_interval(error).partition(" ")
    tie = " (tie)" if marks.get(key) in LIKE_BEST else ""
    interval = "1 seed: no interval" if error.is_one_seed else interval
    if 1.15 * style.text_width(interval) > cell:  # 1.15: bold
        interval = interval.replace(" ", "\n", 1)
    return f"{text}\n{chosen.metric} {value}{tie}\n{interval}".rstrip("\n")


def _reference_noise(results, shot):
    """(median, 95th percentile) of the relative standard error of the truth's pixels; None where it is not known."""
    found = results.shot_entries.get(shot, {}).get("reference", {}).get("relative_error", {})
    return (found["median"], found["p95"]) if found.get("median") is not None and found.get("p95") is not None else None


def _percent(share):
    return (f"{100 * share:.2g} %" if share >= 0.0005 else "< 0.1 %").replace(" ", "\N{NO-BREAK SPACE}")


def _truth_title(results, shot):
    lines = ["truth"]
    samples = results.shot_entries.get(shot, {}).get("reference", {}).get("samples_median")
    if samples:
        lines.append(f"{samples:g} spp")
    noise = _reference_noise(results, shot)
    if noise:
        lines += [f"noise {_percent(noise[0])},", f"p95 {_percent(noise[1])}"]
    return "\n".join(lines)


def _below(results, shot, target, chosen, errors, look, crops):
    """What the figure shows, how it is exposed, and how much of it is the truth's own noise."""
    looks = list(dict.fromkeys([look] + [(c.exposure, c.tone_curve) for c in crops]))
    exposures = ", ".join(f"{ev:+g} EV" + ("" if curve == "none" else f" {curve}") for ev, curve in looks)
    text = f"{results.shot_label(shot)}, {target}; error maps in one scale. Exposure {exposures}"
    text += " (whole, then each crop)" if len(looks) > 1 else ""
    text += f". Top: {chosen.metric} of {chosen.target}, {chosen.mask} pixels, 95 % interval; bold: significantly the best of the shot"
    text += "; below crops: their MSE, with the truth's noise."
    noise = _reference_noise(results, shot)
    if noise and noise[1] > NOISY:
        text += f" The truth is noisy: standard error of a pixel {_percent(noise[0])} (median), {_percent(noise[1])} (95th percentile)."
    floors = [number(r, "floor") for r in results.errors if r.get("floor") and r["shot"] == shot and is_of(r, chosen)]
    least = min((e.value for e in errors.values() if e is not None and e.value > 0), default=None)
    if floors and least and max(floors) > NOISY * least:
        text += f" Two halves of the truth differ by {chosen.metric} {numbers.short(max(floors))}, {_percent(max(floors) / least)} of the least error shown."
    return text


class _Grid:
    """A column per picture, as many as fit; more go into further blocks of rows below. Placed by hand, in cm: pictures have a
    shape of their own, which no layout of matplotlib keeps close together."""

    GAP, EDGE = 0.12, 0.08  # cm between pictures, and beside the outermost

    def __init__(self, chosen, truth, crops, titles):
        self.parts, self.crops = _parts(chosen), crops
        self.width, count = _width(chosen), len(titles)
        self.blocks = -(-count // _most_columns(chosen))
        self.columns = -(-count // self.blocks)
        self.cell = (self.width - 2 * self.EDGE - (self.columns - 1) * self.GAP) / self.columns
        self.line = 0.0353 * 1.2 * style.text_size()
        height, whole_width = truth.shape[:2]
        self.shapes = [("image", None, height / whole_width)] if "image" in self.parts else []
        for place, crop in enumerate(crops):
            self.shapes += [(part, place, crop.box[3] / crop.box[2]) for part in ("crops", "maps") if part in self.parts]
        if not self.shapes:
            raise ResultsError(f"{chosen.where}: without boxes a figure of crops needs the row \"image\"")
        self.title = (1 + max(t.count("\n") for t in titles)) * self.line + 0.08
        self.block = self.title + sum(self.cell * ratio + self.GAP + self._below(part) for part, _, ratio in self.shapes) + 0.1
        self.has_bar = "maps" in self.parts and bool(crops)

    def _below(self, part):
        """Room for the number below the last picture of a crop."""
        return 1.15 * self.line if part == ("maps" if "maps" in self.parts else "crops") else 0.0

    def begin(self, below):
        text = style.fitted(below, 0.95 * self.width)
        foot = (text.count("\n") + 1.4) * self.line
        self.height = self.blocks * self.block + foot + (3.1 * self.line + 0.25 if self.has_bar else 0)
        self.figure = plt.figure(figsize=(self.width * style.CENTIMETRE, self.height * style.CENTIMETRE))
        self.figure.text(0.5, 0.3 * self.line / self.height, text, ha="center", va="bottom", linespacing=1.15)
        self.foot = foot / self.height

    def _axes(self, column, top, ratio):
        """`top`: cm from the figure's upper edge."""
        height = self.cell * ratio
        return self.figure.add_axes(
            [(self.EDGE + column * (self.cell + self.GAP)) / self.width, 1 - (top + height) / self.height, self.cell / self.width, height / self.height]
        )

    def draw(self, index, title, is_best, image, truth, error, look, maximum):
        block, column = divmod(index, self.columns)
        top = block * self.block + self.title
        place_of_title = (self.EDGE + column * (self.cell + self.GAP) + self.cell / 2) / self.width, 1 - (top - 0.06) / self.height
        self.figure.text(*place_of_title, title, ha="center", va="bottom", fontweight="bold" if is_best else "normal", linespacing=1.1)
        for part, place, ratio in self.shapes:
            if part != "maps" or error is not None:
                axes = self._axes(column, top, ratio)
                if part == "image":
                    show(axes, display(image, *look))
                    for number, crop in enumerate(self.crops):
                        _draw_box(axes, crop.box, number)
                else:
                    _draw_crop(axes, part, image, error, self.crops[place], place, maximum)
                if self._below(part) and error is not None:
                    axes.set_xlabel(f"MSE {_mse(image, truth, self.crops[place])}", labelpad=1.5)
            top += self.cell * ratio + self.GAP + self._below(part)

    def finish(self, maximum):
        if not self.has_bar:
            return
        axes = self.figure.add_axes([0.3, self.foot + 2.5 * self.line / self.height, 0.4, 0.2 / self.height])
        bar = self.figure.colorbar(ScalarMappable(Normalize(0, maximum), "magma"), cax=axes, orientation="horizontal", extend="max")
        bar.set_label("absolute error, mean over channels", labelpad=1)


def _width(chosen):
    return chosen.width or style.WIDTHS["page"]


def _most_columns(chosen):
    most = chosen.option("columns", max(int(_width(chosen) / LEAST_CELL), 2))
    if not isinstance(most, int) or isinstance(most, bool) or not 1 <= most <= 20:
        raise ResultsError(f"{chosen.where}: 'columns' must be a number from 1 to 20, not {most}")
    return most


def _draw_box(axes, box, place):
    color, line = BOX_COLORS[place % len(BOX_COLORS)], LINES[place % len(LINES)]
    corner = (box[0] - 0.5, box[1] - 0.5)
    axes.add_patch(Rectangle(corner, box[2], box[3], fill=False, edgecolor=color, linestyle=line, linewidth=1.0))


def _draw_crop(axes, part, image, error, crop, place, maximum):
    x, y, w, h = crop.box
    inside = np.s_[y : y + h, x : x + w]
    if part == "crops":
        show(axes, display(image[inside], crop.exposure, crop.tone_curve))
    else:
        colors = plt.get_cmap("magma").copy()
        colors.set_bad("#ff00ff")
        show(axes, error[inside], cmap=colors, vmin=0, vmax=maximum)
    _frame(axes, place)


def _mse(image, truth, crop):
    x, y, w, h = crop.box
    squared = (image[y : y + h, x : x + w].astype(np.float64) - truth[y : y + h, x : x + w]) ** 2
    return numbers.short(float(np.nanmean(squared[np.isfinite(squared).all(axis=-1)])))
