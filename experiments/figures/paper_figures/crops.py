"""Crops of the reference and of variants with their error maps and numbers: where a technique fails, and how badly."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.patches import Rectangle

from paper_figures import style
from paper_figures.crop_choice import Crop, check_box
from paper_figures.results import ResultsError, label

MOST_VARIANTS = 4
BOX_COLORS = ["#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#d55e00", "#0072b2"]

# From exposed radiance, each channel by itself, as the report's viewer has them (experiments/report/page/viewer/image_colors.js).
TONE_CURVES = {
    "none": lambda v: v,
    "reinhard": lambda v: v / (1 + v),  # Reinhard et al. 2002
    "aces": lambda v: v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14),  # Narkowicz 2015
}


def display(image, exposure, tone_curve="none"):
    """sRGB (IEC 61966-2-1) at this exposure (EV); pixels that are not finite are magenta."""
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
    """The `count` disjoint boxes (x, y, width, height) of the largest mean `error`, in descending order."""
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


def _frame(axes, color):
    for spine in axes.spines.values():
        spine.set(visible=True, color=color, linewidth=1.4)


def _pick(images):
    """`none` and the first points of the others: what fits beside the reference."""
    variants = [key for key in images if key[0] != "reference"]
    return [k for k in variants if k[0] == "none"][:1] + [k for k in variants if k[0] != "none"][: MOST_VARIANTS - 1]


def _target(results, shot):
    found = {
        i.get("target")
        for i in results.manifest.get("images", [])
        if i.get("shot") == shot and i.get("kind") == "reference"
    }
    return next((t for t in ("image", "specular", "incident") if t in found), None)


def _frame_text(chosen):
    return "last frame" if chosen.frame is None else f"frame {chosen.frame}"


def _images(results, shot, target, chosen):
    """The reference's and the points' images, the points' keys."""
    if chosen is None:
        images = results.images_of(shot, target)
        return images, _pick(images)
    is_rung = target in ("camera_radiance", "on_screen")  # compared with what arrives
    images = results.images_of(shot, "incident" if is_rung else target, chosen.frame, [*chosen.points, ("reference", "")])
    if is_rung:
        images |= results.images_of(shot, target, chosen.frame, [("reference", "")])
    first = chosen.crops[0].where
    for key, where in {("reference", ""): first, **chosen.points}.items():
        if key not in images:
            what = "the truth" if key[0] == "reference" else f"'{label(*key)}'"
            raise ResultsError(f"{where}: the results have no image of {what} for 'target' {target} in {shot}, {_frame_text(chosen)}")
    return images, list(chosen.points)


def draw(results, shot, errors, arguments):
    """With the boxes, points and exposures of figures.json where it has any of this shot, else of the largest errors."""
    chosen = arguments.crops.get(shot)
    target = chosen.target if chosen else _target(results, shot)
    if target is None:
        return None
    images, keys = _images(results, shot, target, chosen)
    if not keys:
        return None
    reference = images[("reference", "")]
    for key in keys:
        if images[key].shape != reference.shape:
            raise ResultsError(f"the images of shot {shot} differ in size: {label(*key)} is not like the reference")
    maps = {key: absolute_error(images[key], reference) for key in keys}
    techniques = [maps[k] for k in keys if k[0] != "none"] or list(maps.values())
    if chosen:
        crops = chosen.crops
        for crop in crops:
            check_box(crop, reference.shape[1], reference.shape[0])
    else:
        boxes = crop_boxes(np.nanmean(np.nan_to_num(np.stack(techniques)), axis=0), 2)
        crops = [Crop(box, results.exposure(shot)) for box in boxes]
    maximum = max(float(np.nanquantile(m, 0.99)) for m in maps.values()) or 1.0
    shown = {("reference", ""): reference, **{k: images[k] for k in keys}}
    return _compose(shot, target, errors, arguments, shown, maps, crops, maximum)


def _shown_as(crops):
    """How the pictures are exposed, where that is not all alike or by a curve."""
    looks = list(dict.fromkeys((c.exposure, c.tone_curve) for c in crops))
    if len(looks) == 1 and looks[0][1] == "none":
        return ""
    names = [f"{exposure:g} EV, {'clipped' if curve == 'none' else curve}" for exposure, curve in looks]
    return "\npictures: " + "; ".join(names)


def _compose(shot, target, errors, chosen, images, maps, crops, maximum):
    reference, boxes = images[("reference", "")], [crop.box for crop in crops]
    height, width = reference.shape[:2]
    cell = style.DOUBLE_COLUMN / len(images)
    ratios = [height / width] + [b[3] / b[2] for b in boxes for _ in range(2)]
    figure = plt.figure(
        figsize=(style.DOUBLE_COLUMN, cell * sum(ratios) + (1.6 + 0.45 * len(boxes)) * style.CENTIMETRE),
        layout="constrained",
    )
    figure.set_constrained_layout_pads(w_pad=0.02, h_pad=0.02, wspace=0.01, hspace=0.01)
    letters = style.PANEL_LETTERS * 4 // max(4, len(images))
    grid = figure.subplots(len(ratios), len(images), squeeze=False, gridspec_kw={"height_ratios": ratios})
    for column, (key, image) in enumerate(images.items()):
        show(grid[0, column], display(image, crops[0].exposure, crops[0].tone_curve))
        error = errors.get((shot, *key))
        number = (
            ""
            if error is None
            else f"\n{chosen.metric} {style.number(error.value)}"
            + (
                "\n1 seed: no interval"
                if error.is_one_seed
                else "" if error.low is None else f"\n[{style.number(error.low)}, {style.number(error.high)}]"
            )
        )
        grid[0, column].set_title(style.wrapped(label(*key), letters) + number)
        for index, (crop, box) in enumerate(zip(crops, boxes)):
            color = BOX_COLORS[index % len(BOX_COLORS)]
            _draw_crop(
                grid[1 + 2 * index, column],
                grid[2 + 2 * index, column],
                image,
                reference,
                maps.get(key),
                crop,
                color,
                maximum,
            )
            grid[0, column].add_patch(
                Rectangle(
                    (box[0] - 0.5, box[1] - 0.5), box[2], box[3], fill=False, edgecolor=color, linewidth=1.0
                )
            )
    bar = figure.colorbar(
        ScalarMappable(Normalize(0, maximum), "magma"),
        ax=grid[-1, :],
        orientation="horizontal",
        shrink=0.5,
        aspect=40,
        extend="max",
    )
    bar.set_label(
        f"{shot}, {target}: absolute error, mean over channels (one scale)\n"
        f"top row: {chosen.metric} of {chosen.target}, {chosen.mask} pixels; "
        f"crops: MSE with the reference's noise in it{_shown_as(crops)}",
        fontsize=7,
    )
    return figure


def _draw_crop(picture_axes, map_axes, image, reference, error, crop, color, maximum):
    x, y, w, h = crop.box
    part = np.s_[y : y + h, x : x + w]
    show(picture_axes, display(image[part], crop.exposure, crop.tone_curve))
    _frame(picture_axes, color)
    if error is None:
        map_axes.axis("off")
        return
    colors = plt.get_cmap("magma").copy()
    colors.set_bad("#ff00ff")
    show(map_axes, error[part], cmap=colors, vmin=0, vmax=maximum)
    _frame(map_axes, color)
    squared = (image[part].astype(np.float64) - reference[part]) ** 2
    map_axes.set_xlabel(
        f"MSE {style.number(float(np.nanmean(squared[np.isfinite(squared).all(axis=-1)])))}", labelpad=1.5
    )
