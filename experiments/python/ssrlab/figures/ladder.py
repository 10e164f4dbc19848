"""Errors against the rungs of the truth ladder: how much error a technique could avoid, and what one frame cannot show."""

from ssrlab.figures import style
from ssrlab.results import Measured, is_of

RUNGS = {"on_screen": "limit of one frame", "camera_radiance": "camera's radiance"}  # groundtruth/reference/truth_ladder.h
LOOKS = {"on_screen": ("#000000", "--"), "camera_radiance": ("#666666", ":")}


def rungs_of(results, shot, chosen):
    """{rung: Measured} of the shot, for errors above 0."""
    return {
        r["rung"]: Measured(r["value"], r.get("low"), r.get("high"))
        for r in results.shot_entries.get(shot, {}).get("truth_ladder", [])
        if is_of(r, chosen) and r["rung"] in RUNGS and (r.get("value") or 0) > 0
    }


def draw(results, chosen):
    errors = results.errors_of(chosen.target, chosen.metric, chosen.mask)
    rungs = {shot: rungs_of(results, shot, chosen) for shot in results.shots()}
    shots = [shot for shot in results.shots() if rungs[shot]]
    if not shots:
        return None
    keys = results.points()
    names, row = style.row_names([results.point_label(*k) for k in keys], style.width_of(chosen, len(shots)))
    figure, panels = style.panels(len(shots), chosen, height=1.8 + row * len(keys), sharey=True)
    for axes, shot in zip(panels, shots):
        style.log_axis(axes.xaxis)
        limit = rungs[shot].get("on_screen", min(rungs[shot].values(), key=lambda m: m.value)).value
        for rung, m in rungs[shot].items():
            color, line = LOOKS[rung]
            axes.axvline(m.value, color=color, linestyle=line, linewidth=0.9, label=RUNGS[rung])
            if m.low is not None and m.low > 0:
                axes.axvspan(m.low, m.high, color=color, alpha=0.12, linewidth=0)
        for row, key in enumerate(keys):
            error = errors.get((shot, *key))
            if error is None or error.value <= 0:
                axes.text(0.01, row, "no value above 0", transform=axes.get_yaxis_transform(), va="center")
                continue
            color = results.colors.get(key, style.COLORS[0])
            axes.hlines(row, min(limit, error.value), max(limit, error.value), color=color, linewidth=2.2 * style.scale(), alpha=0.45)
            style.draw_mark(axes, error, row, "o", color, error.is_one_seed, markersize=3.4 * style.scale(), markeredgewidth=0.8)
        axes.margins(x=0.08)
        style.name_rows(axes, names, 0.4)
        axes.set_title(style.panel_title(results.shot_label(shot), axes, names))
    style.draw_legend(figure, panels)
    style.note(figure, f"{chosen.metric} of {chosen.target}, {chosen.mask} pixels, 95 % intervals; bars begin at that limit")
    return figure
