"""Error and signed bias by class of perceptual roughness, one panel per shot."""

import re

from ssrlab.figures import style
from ssrlab.figures.lines import draw_points

CLASS = re.compile(r"roughness_([0-9.e+-]+)_([0-9.e+-]+)$")


def _classes(rows):
    """The masks in the order of their roughness."""
    masks = {r["mask"]: CLASS.match(r["mask"]) for r in rows}
    return sorted((m for m in masks if masks[m]), key=lambda m: float(masks[m][1]))


def _draw(results, chosen, target, metric, is_log):
    rows = [r for r in results.errors if (r["target"], r["metric"]) == (target, metric) and CLASS.match(r["mask"])]
    shots = [s for s in results.shots() if any(r["shot"] == s for r in rows)]
    if not shots:
        return None
    figure, panels = style.panels(len(shots), chosen)
    for axes, shot in zip(panels, shots):
        own = [r for r in rows if r["shot"] == shot]
        masks = _classes(own)
        lines = {
            key: [
                (masks.index(r["mask"]), results.measured(r))
                for r in sorted(own, key=lambda r: masks.index(r["mask"]))
                if (r["technique"], r["point"]) == key and results.measured(r) is not None
            ]
            for key in results.points()
        }
        draw_points(results, axes, lines, is_log, dodge=0.1)
        texts = ["\N{EN DASH}".join(CLASS.match(m).groups()) for m in masks]
        axes.set_xticks(range(len(masks)), texts, rotation=30, ha="right", rotation_mode="anchor")
        axes.set_xlim(-0.6, len(masks) - 0.4)
        axes.grid(axis="x", visible=False)
        axes.set_title("\n".join([style.panel_title(results.shot_label(shot), axes), *results.frames_text(own)]))
        axes.set_ylabel(f"{metric}, {target}" + ("" if is_log else " (radiance)"))
        axes.set_xlabel("perceptual roughness")
    style.draw_legend(figure, panels, [results.point_label(*k) for k in results.points()])
    return figure


def draw_error(results, chosen):
    return _draw(results, chosen, chosen.target, chosen.metric, True)


def draw_bias(results, chosen):
    targets = {r["target"] for r in results.errors}
    return _draw(results, chosen, "incident" if "incident" in targets else chosen.target, "bias", False)
