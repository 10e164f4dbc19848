"""Depth fetches of a ray against the resolution, for studies that judge rays at three resolutions or more, with a fitted power of the
number of rows. A march that reads each pixel has the power 1; a march of logarithmic cost has a power that falls to 0."""

import math

import numpy

from ssrlab.figures import style
from ssrlab.csv_files import needed_number

LEAST_RESOLUTIONS = 3


def series(results):
    """{scene: {(technique, point): [(rows of pixels, fetches)]}} of all rays of the passes that trace them."""
    heights = {s["shot"]: (s.get("scene", s["shot"]), s["height"]) for s in results.manifest["shots"] if "height" in s}
    found = {}
    for row in results.hits:
        if row["quantity"] != "fetches" or row["mask"] != "all" or row["shot"] not in heights:
            continue
        scene, height = heights[row["shot"]]
        points = found.setdefault(scene, {}).setdefault((row["technique"], row["point"]), {})
        points.setdefault(height, []).append((needed_number(row, "rays"), needed_number(row, "value")))
    return {
        scene: {
            key: sorted((h, sum(n * v for n, v in passes) / sum(n for n, _ in passes)) for h, passes in heights_of.items())
            for key, heights_of in points.items()
            if len(heights_of) >= LEAST_RESOLUTIONS and all(v > 0 for passes in heights_of.values() for _, v in passes)
        }
        for scene, points in found.items()
    }


def power_of(points):
    """(exponent, half-width of its 95 % interval) of fetches = a rows^exponent, by least squares of logarithms."""
    x, y = (numpy.log(numpy.array(v, dtype=float)) for v in zip(*points))
    slope, offset = numpy.polyfit(x, y, 1)
    degrees = len(x) - 2
    scatter = math.sqrt(float(numpy.sum((y - slope * x - offset) ** 2)) / degrees) if degrees > 0 else 0.0
    student = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571}.get(degrees, 2.447)
    return slope, student * scatter / math.sqrt(float(numpy.sum((x - x.mean()) ** 2)))


def draw(results, chosen):
    scenes = {scene: lines for scene, lines in series(results).items() if lines}
    if not scenes:
        return None
    keys = list(dict.fromkeys(key for lines in scenes.values() for key in lines))
    is_one_technique = len({technique for technique, _ in keys}) == 1

    def name_of(key):
        return results.own_label(*key) or (results.point_name(*key) if is_one_technique else results.point_label(*key))

    names = [name_of(key) for key in keys]
    figure, panels = style.panels(len(scenes), chosen, most_columns=3, height=5.2)
    for axes, (scene, lines) in zip(panels, scenes.items()):
        for key, points in lines.items():
            color, mark = style.series(names.index(name_of(key)))
            x, y = zip(*points)
            exponent, half = power_of(points)
            axes.plot(x, y, marker=mark, color=color, linewidth=0.8, markersize=3.2, label=name_of(key))
            is_below = any(y[-1] < other[-1][1] < 1.5 * y[-1] for other in lines.values())
            axes.annotate(
                f"{exponent:.2f} ± {half:.2f}",
                (x[-1], y[-1]),
                color=color,
                xytext=(-2, -9 if is_below else 4),
                textcoords="offset points",
                ha="right",
            )
        axes.set_xscale("log", base=2)
        style.log_axis(axes.yaxis)
        rows = sorted({x for points in lines.values() for x, _ in points})
        axes.set_xticks(rows, [str(r) for r in rows])
        axes.minorticks_off()
        axes.margins(y=0.12)
        axes.set_title(style.panel_title(f"{scene}: fetches ~ rows^p, p ± 95 %", axes))
        axes.set_xlabel("rows of pixels")
        axes.set_ylabel("depth fetches per ray")
    style.draw_legend(figure, panels, names)
    return figure
