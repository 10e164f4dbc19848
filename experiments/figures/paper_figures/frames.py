"""Error of each frame of a moving shot, one panel per shot."""

from matplotlib.ticker import MaxNLocator

from paper_figures import style
from paper_figures.lines import draw_lines
from paper_figures.results import ResultsError, is_over_frames, label


def _frame_number(row):
    try:
        return int(row["frame"])
    except ValueError as e:
        raise ResultsError(f"summary.csv: 'frame' = \"{row['frame']}\" is no number") from e


def draw(results, chosen):
    rows = [
        r
        for r in results.all_errors
        if not is_over_frames(r) and (r["target"], r["metric"], r["mask"]) == (chosen.target, chosen.metric, chosen.mask)
    ]
    shots = [s for s in results.shots() if len({r["frame"] for r in rows if r["shot"] == s}) > 1]
    if not shots:
        return None
    figure, panels, legend = style.panels(len(shots))
    for axes, shot in zip(panels, shots):
        own = sorted((r for r in rows if r["shot"] == shot), key=_frame_number)
        lines = {
            key: [
                (_frame_number(r), results.measured(r))
                for r in own
                if (r["variant"], r["point"]) == key and results.measured(r) is not None
            ]
            for key in results.points()
        }
        draw_lines(axes, {k: p for k, p in lines.items() if p}, is_log=True, dodge=0.0)
        change = next((s.get("change") for s in results.manifest.get("shots", []) if s.get("shot") == shot), None)
        if change is not None:
            axes.axvline(change, color="#555555", linewidth=0.6, linestyle=":", label="the scene changes")
        axes.xaxis.set_major_locator(MaxNLocator(5, integer=True))
        axes.set_title(style.shot_title(shot))
        axes.set(xlabel="frame", ylabel=f"{chosen.metric}, {chosen.target}, {chosen.mask}")
    style.draw_legend(legend, panels, [label(*k) for k in results.points()])
    return figure
