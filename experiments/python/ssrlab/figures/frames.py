"""Error of each frame of a moving shot, one panel per shot."""

from matplotlib.ticker import MaxNLocator

from ssrlab.figures import style
from ssrlab.figures.lines import draw_points
from ssrlab.results import frame_number, is_of, is_over_frames


def draw(results, chosen):
    rows = [r for r in results.all_errors if not is_over_frames(r) and is_of(r, chosen)]
    shots = [s for s in results.shots() if len({r["frame"] for r in rows if r["shot"] == s}) > 1]
    if not shots:
        return None
    names = [results.point_label(*k) for k in results.points()]
    figure, panels = style.panels(len(shots), chosen, names=names)
    for axes, shot in zip(panels, shots):
        own = sorted((r for r in rows if r["shot"] == shot), key=frame_number)
        lines = {
            key: [
                (frame_number(r), results.measured(r))
                for r in own
                if (r["technique"], r["point"]) == key and results.measured(r) is not None
            ]
            for key in results.points()
        }
        draw_points(results, axes, lines, is_log=True)
        change = results.shot_entries.get(shot, {}).get("change")
        if change is not None:
            axes.axvline(change, color="#555555", linewidth=0.6, linestyle=":", label="the scene changes")
        axes.xaxis.set_major_locator(MaxNLocator(5, integer=True))
        axes.set_title(style.panel_title(results.shot_label(shot), axes))
        axes.set(xlabel="frame", ylabel=f"{chosen.metric}, {chosen.target}, {chosen.mask}")
    style.draw_legend(figure, panels, names)
    return figure
