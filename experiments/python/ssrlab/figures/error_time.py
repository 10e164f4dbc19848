"""Error against run time, both logarithmic, with intervals: one panel for each shot, with the front of the points that no other beats."""

from ssrlab.figures import style
from ssrlab.figures.placed_labels import place_labels

TIME_AXIS = "time of a frame (ms)"
MOST_NUMBERS = 20  # with a key below: more of them, and the key is larger than the plot


def _judged(results, shot, chosen, places):
    """(keys of the front by time, dominated keys), as summary.csv states for this error."""
    rows = results.error_rows(shot, chosen.target, chosen.metric, chosen.mask)
    line = sorted((k for k in places if "time" in rows[k]["fronts"].split()), key=lambda k: places[k][0].value)
    return line, {k for k in places if rows[k]["dominated"] == "yes"}


def _places(results, errors, shot):
    """{(technique, point): (time, error)} of all points that were timed and measured, without `none`."""
    times = results.times_of(shot)
    totals = {key: stages["total"] for key, stages in times.items() if "total" in stages and stages["total"].value > 0}
    return {(v, p): (totals[v, p], e) for (s, v, p), e in errors.items() if s == shot and (v, p) in totals and v != "none"}


def _draw_none(axes, results, errors, shot):
    """Returns its errors: no label may lie on the line."""
    for (s, technique, point), error in errors.items():
        if s == shot and technique == "none" and error.value > 0:
            axes.axhline(error.value, color="#666666", linestyle="--", linewidth=0.8, label=results.point_label(technique, point))
            if error.low is not None and error.low > 0:
                axes.axhspan(error.low, error.high, color="#666666", alpha=0.15, linewidth=0)
            return [error.value]
    return []


def draw_mark(axes, cost, error, mark, color, is_hollow=False, alpha=1.0):
    """Draws a mark with both whiskers. Returns the whiskers' places, which no label may cover."""
    style.draw_mark(axes, cost, error, mark, color, is_hollow, elinewidth=0.7, markeredgewidth=0.8 if is_hollow else 0, alpha=alpha)
    x, y = cost.whiskers(), error.whiskers()
    return [
        (cost.value - x[0][0], error.value, cost.value + x[1][0], error.value),
        (cost.value, error.value - y[0][0], cost.value, error.value + y[1][0]),
    ]


def _draw_points(axes, results, places, groups, beaten):
    """Marks with whiskers; returns where the whiskers are."""
    whiskers = []
    for (technique, point), (time, error) in places.items():
        group = results.point_group(technique, point)
        color, mark = style.series(groups.index(group), results.colors.get((technique, point)))
        whiskers += draw_mark(axes, time, error, mark, color, is_hollow=error.is_one_seed, alpha=0.4 if (technique, point) in beaten else 1.0)
        axes.plot([], [], mark, color=color, label=group)
    return whiskers


def _draw_front(axes, places, line):
    """A staircase; returns its steps."""
    corners = [(places[k][0].value, places[k][1].value) for k in line]
    if len(corners) < 2:
        return []
    axes.plot(
        *zip(*corners),
        drawstyle="steps-post",
        color="#999999",
        linewidth=0.8,
        zorder=1.5,
        label="front",
    )
    pairs = list(zip(corners, corners[1:]))
    return [(a[0], a[1], b[0], a[1]) for a, b in pairs] + [(b[0], a[1], b[0], b[1]) for a, b in pairs]


def _own_text(results, key, groups):
    """The text beside a mark: its display name, else its point, unless the colour already names it."""
    label = results.own_label(*key)
    if label:
        return label if label not in groups else ""
    return "" if key[1] in ("", "default") else results.point_name(*key)


def draw(results, chosen):
    errors = results.errors_of(chosen.target, chosen.metric, chosen.mask)
    every = {shot: _places(results, errors, shot) for shot in results.shots()}
    every = {shot: places for shot, places in every.items() if places}
    if not every:
        return None
    keys = list(dict.fromkeys(key for places in every.values() for key in places))
    groups = list(dict.fromkeys(results.point_group(*k) for k in keys))
    figure, panels = style.panels(len(every), chosen, height=6.4 if len(every) == 1 else 5.6)
    has_nonpositive, has_beaten, whiskers, unbeaten = False, False, {}, set()
    for axes, (shot, places) in zip(panels, every.items()):
        shown = {k: p for k, p in places.items() if p[1].value > 0}
        has_nonpositive |= len(shown) < len(places)
        of_none = _draw_none(axes, results, errors, shot)
        line, beaten = _judged(results, shot, chosen, shown) if chosen.option("front", True) else ([], set())
        has_beaten |= bool(beaten)
        unbeaten |= shown.keys() - beaten
        whiskers[shot] = _draw_points(axes, results, shown, groups, beaten) + _draw_front(axes, shown, line)
        style.log_log(axes, results.shot_label(shot), TIME_AXIS, 0.16)
        whiskers[shot] += [(axes.get_xlim()[0], value, axes.get_xlim()[1], value) for value in of_none]
        every[shot] = shown
    panels[0].set_ylabel(f"{chosen.metric} of {chosen.target}, {chosen.mask} pixels")
    notes = ["median times, mean errors; 95 % intervals"]
    if has_beaten:
        notes.append("pale: another point has significantly less error or time, and no more of the other")
    notes += results.warnings_of_times(list(every))
    notes += [style.NOT_POSITIVE_NOTE.replace("\n", " ")] if has_nonpositive else []
    notes += [style.ONE_SEED_NOTE] if any(e.is_one_seed for places in every.values() for _, e in places.values()) else []
    style.draw_legend(figure, panels, groups)
    style.note(figure, "; ".join(notes))
    _name(figure, results, panels, every, whiskers, keys, groups, notes, unbeaten)
    return figure


def numbered(keys, unbeaten):
    """The keys that get a number."""
    return [k for k in keys if k in unbeaten] if len(keys) > MOST_NUMBERS else keys


def _name(figure, results, panels, every, whiskers, keys, groups, notes, unbeaten):
    """Writes names beside all marks. If they do not all fit, numbers stand there and a legend below explains them; of very many marks only
    those that are unbeaten in some panel have a number."""
    texts = {key: _own_text(results, key, groups) for key in keys}
    colors = {k: style.series(groups.index(results.point_group(*k)), results.colors.get(k))[0] for k in keys}
    before = [len(axes.texts) for axes in panels]

    def placed(text_of):
        return all(
            place_labels(
                axes, [(t.value, e.value, text_of[k], style.darker(colors[k])) for k, (t, e) in places.items() if text_of[k]], whiskers[shot]
            )
            for axes, (shot, places) in zip(panels, every.items())
        )

    if placed(texts):
        return
    for axes, count in zip(panels, before):
        for text in list(axes.texts)[count:]:
            text.remove()
    nameable = [k for k in keys if texts[k]]
    numbers = {key: str(1 + i) for i, key in enumerate(numbered(nameable, unbeaten))}
    if len(numbers) < len(nameable):
        notes = [*notes, "without a number: pale in every panel"]
    entries = (f"{n}: {results.point_label(*key)}" for key, n in numbers.items())
    legend = style.listed(entries, figure.get_figwidth() / style.CENTIMETRE)
    style.note(figure, legend + "\n" + "; ".join(notes))
    placed({key: numbers.get(key, "") for key in keys})
