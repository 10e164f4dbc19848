// Error against time, and stacked bars of stage times.

const chartSize = {
    width: 460,
    height: 320,
    left: 66,
    right: 446,
    top: 14,
    bottom: 272
};

function showScatter() {
    const rows = chosenRows().filter(r => r.value !== null);
    const [metric] = choice.metric.split("|");
    const isLog = better(metric) === "lower";
    const timed = rows.filter(totalTime);
    at("error-time-note").textContent = timed.length === 0 ?
        "No times were measured for these variants." :
        `${metric} of ${choice.target} on ${choice.mask} pixels against the total time of the variant's stages${
            isLog ? ", both logarithmic" : ""}. Lines are 95 % intervals; the dashed line is none. ` +
            (isLog ? "An arrow marks a value whose noise-corrected error is not above zero; the grey steps join the " +
                     "points that none other beats in both, whatever the intervals say. " :
                     "") +
            (timed.some(isOneSeed) ? "Hollow: one seed alone, which has no interval and is left out of the steps. " :
                                     "") +
            "Point at a mark, or tab to it, for its numbers.";
    at("legend").replaceChildren(timed.length ? scatterLegend() : "");
    at("scatter").replaceChildren(
        ...unique(timed.map(r => r.shot))
            .map(shot => scatterChart(shot, rows.filter(r => r.shot === shot), metric, isLog)));
}

// Colours stand for points while there are few enough of them, else for variants.
const isByPoint = comparedPoints.length <= mostSeries;
const variants = unique(report.errors.map(r => r.variant));
const scatterSeries = row => isByPoint && !isSingleChange(row) ? chartedIndex(row) : variants.indexOf(row.variant);

function scatterLegend() {
    if (isByPoint) return pointLegend();
    return h("div", {class: "legend"}, variants.map((v, i) => legendEntry(i, v)));
}

/// Those that none other beats in both: a hint, by medians and means alone. Single seeds may stand anywhere by chance.
function paretoFront(all) {
    const timed = all.filter(p => !isOneSeed(p.row));
    const isBeaten = p => timed.some(
        q => q !== p && q.time.value <= p.time.value && q.row.value <= p.row.value &&
            (q.time.value < p.time.value || q.row.value < p.row.value));
    return timed.filter(p => !isBeaten(p)).sort((a, b) => a.time.value - b.time.value);
}

function frontLine(front, x, y) {
    const steps = front.map(
        (p, i) => i ? `H${x.toPixel(p.time.value)}V${y.toPixel(p.row.value)}` :
                      `M${x.toPixel(p.time.value)} ${y.toPixel(p.row.value)}`);
    return svg("path", {class: "front", d: steps.join(""), fill: "none"});
}

function scatterChart(shot, rows, metric, isLog) {
    const {width, height, left, right, top, bottom} = chartSize;
    const timed = rows.map(r => ({row: r, time: totalTime(r)})).filter(p => p.time && p.time.value > 0);
    const none = rows.find(r => r.variant === "none");
    const xs = timed.flatMap(p => [p.time.low, p.time.high]),
          ys = rows.flatMap(r => [r.value, r.low ?? r.value, r.high ?? r.value]);
    const x = {...logScale(xs, left, right), from: left, to: right};
    const y = isLog ? logScale(ys, bottom, top) : linearScale(ys, bottom, top);
    const picture = svg(
        "svg", {viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": `${metric} against time, ${shot}`},
        verticalAxis(y, left, right, metric, (top + bottom) / 2), horizontalAxis(x, top, bottom, "total time (ms)"));
    if (none)
        picture.append(svg("line", {
            x1: left,
            x2: right,
            y1: y.toPixel(none.value),
            y2: y.toPixel(none.value),
            stroke: seriesColor(scatterSeries(none)),
            "stroke-dasharray": "5 4"
        }));
    if (isLog) picture.append(frontLine(paretoFront(timed), x, y));
    for (const {row, time} of timed) picture.append(scatterMark(row, time, x, y));
    return h("figure", {class: "chart"}, h("figcaption", {}, shot), picture);
}

function scatterMark(row, time, x, y) {
    const color = seriesColor(scatterSeries(row)), px = x.toPixel(time.value), py = y.toPixel(row.value);
    const bar = (x1, y1, x2, y2) => svg("line", {x1, y1, x2, y2, stroke: color, "stroke-width": 1.5});
    const group = svg(
        "g", {class: "point", "data-variant": row.variant, "data-point": row.point},
        bar(x.toPixel(time.low), py, x.toPixel(time.high), py),
        row.low === null ? null : bar(px, y.toPixel(row.low), px, y.toPixel(row.high)),
        y.isInside(row.value) ?
            mark(scatterSeries(row), px, py, 1, isOneSeed(row)) :
            svg("text", {x: px, y: py - 4, "text-anchor": "middle", style: `fill:${color}`}, "▼"));
    return withTip(
        group,
        `${pointLabel(row)}\n${row.metric} ${number(row.value)} ${interval(row)}\n${number(time.value)} ms ${
            interval(time)}, ${time.frames} frames`);
}

const stageState = {
    shot: null
};

function showStages() {
    const shots = unique(report.times.map(t => t.shot));
    if (!shots.length) {
        at("bars").replaceChildren(h("p", {class: "note"}, "No times were measured."));
        return;
    }
    stageState.shot = shots[0];
    at("stage-choice").append(select("Shot", shots, stageState.shot, shot => {
        stageState.shot = shot;
        drawStages();
    }));
    drawStages();
}

function drawStages() {
    const times = report.times.filter(t => t.shot === stageState.shot);
    const own = times.filter(t => t.variant !== "" && t.stage !== "total"),
          shared = times.filter(t => t.variant === "");
    const stages = unique(own.map(t => t.stage));
    const points = unique(times.filter(t => t.variant !== "").map(pointLabel));
    const nothing = h("p", {class: "note"}, "No variant of this shot has a stage: all were left out.");
    at("bars").replaceChildren(stages.length ? stageBars(points, stages, times) : nothing);
    const columns = [
        {name: "Variant"}, {name: "Stage"}, {name: "Median ms", number: true}, {name: "95 % interval", number: true},
        {name: "Frames", number: true}, {name: "Clock"}
    ];
    const color = t => t.variant !== "" && stages.includes(t.stage) ? swatch(stages.indexOf(t.stage)) : null;
    const row = t =>
        [t.variant === "" ? "–" : pointLabel(t),
         t.stage === "total" ? h("b", {}, "total") : h("span", {}, color(t), t.stage), cell(t.value, number(t.value)),
         interval(t), String(t.frames), t.clock.replaceAll("_", " ")];
    const variantTimes = times.filter(t => t.variant !== "")
                             .sort((a, b) => points.indexOf(pointLabel(a)) - points.indexOf(pointLabel(b)));
    at("stage-table")
        .replaceChildren(
            floorNote(), formNote(times),
            h("details", {open: variantTimes.length <= longTable}, h("summary", {}, "All stages as numbers"),
              table(columns, variantTimes.map(row), {groupBy: 0})),
            ...(shared.length ?
                    [h("h3", {}, "Shared by all variants: G-buffer and lit colour"), table(columns, shared.map(row))] :
                    []));
}

/// What was timed: a point's name does not tell which form of a stage ran. Single changes equal their baseline in all
/// but what their name says.
function formNote(times) {
    const isTimed = v => times.some(t => pointKey(t) === pointKey(v));
    const lines = list(report.manifest.variants)
                      .filter(v => isTimed(v) && !isSingleChange(v))
                      .map(v => [pointLabel(v), formText(v)])
                      .filter(([, text]) => text);
    if (!lines.length) return "";
    const items = lines.map(([label, text]) => h("li", {}, h("b", {}, label), ": " + text));
    return h("div", {class: "note", id: "forms"}, "What was timed:", h("ul", {}, items));
}

/// The forms a point chose, and what else it changes of its variant's defaults.
function formText({variant, parameters}) {
    const entries = Object.entries(parameters ?? {}), defaults = report.defaults[variant];
    const show = some => some.map(([name, value]) => `${name} = ${JSON.stringify(value)}`).join(", ");
    const isForm = ([, value]) => typeof value === "string", forms = show(entries.filter(isForm));
    if (!defaults || !entries.length) return forms;
    const changed = entries.filter(([name, value]) => name in defaults && defaults[name] !== value);
    const others = show(changed.filter(e => !isForm(e)));
    return [forms, others ? `not at its default: ${others}` : "all else at its default"].filter(Boolean).join("; ");
}

/// How far two interleaved copies of the same point were apart: smaller differences are none.
function floorNote() {
    const pairs = list(report.manifest.clock?.aa_pairs).filter(p => p.shot === stageState.shot);
    if (!pairs.length) return "";
    return h(
        "p", {class: "note"}, "Two interleaved copies of the same point differed by ",
        pairs.map(p => `${percent(p.floor)} (${pointLabel(p)}, ${number(p.first_ms, 3)} ms)`).join(", "),
        `. A/A floor of the study: ${
            percent(report.manifest.clock.aa_floor)}; smaller differences between times say nothing.`);
}

const swatch = index => h("span", {class: "swatch", style: `background:${seriesColor(index)}`});

function stageBars(points, stages, times) {
    const rowHeight = 26, top = 6, left = 200, right = 720, bottom = top + rowHeight * points.length;
    const totals = times.filter(t => t.variant !== "" && t.stage === "total");
    const sums = points.map(
        p => times.filter(t => pointLabel(t) === p && stages.includes(t.stage)).reduce((sum, t) => sum + t.value, 0));
    const x = {...linearScale([...sums, ...totals.map(t => t.high)], left, right, true), from: left, to: right};
    const picture =
        svg("svg", {viewBox: `0 0 740 ${bottom + 42}`, role: "group", "aria-label": "Stage times"},
            horizontalAxis(x, top, bottom, "median time (ms); the line is the interval of the total"));
    points.forEach((point, i) => {
        const y = top + i * rowHeight + 4;
        const short = point.length > 30 ? point.slice(0, 29) + "…" : point;
        picture.append(svg("text", {x: left - 8, y: y + 13, "text-anchor": "end"}, svg("title", {}, point), short));
        let start = 0;
        for (const t of times.filter(t => pointLabel(t) === point && stages.includes(t.stage))) {
            const from = x.toPixel(start), to = x.toPixel(start += t.value);
            picture.append(withTip(
                svg("rect", {
                    class: "bar",
                    "data-stage": t.stage,
                    "data-value": t.value,
                    x: from,
                    y,
                    width: Math.max(to - from, 0.5),
                    height: 18,
                    fill: seriesColor(stages.indexOf(t.stage))
                }),
                `${point}\n${t.stage}: ${number(t.value)} ms ${interval(t)}`));
        }
        const total = totals.find(t => pointLabel(t) === point);
        if (total)
            picture.append(svg("path", {
                d: `M${x.toPixel(total.low)} ${y + 9}H${x.toPixel(total.high)}M${x.toPixel(total.low)} ${y + 5}v8M${
                    x.toPixel(total.high)} ${y + 5}v8`,
                stroke: "var(--ink)",
                "stroke-width": 1.5,
                fill: "none"
            }));
    });
    const names = h("p", {class: "note"}, stages.map((s, i) => h("span", {class: "stage"}, swatch(i), s)));
    return h("figure", {class: "chart"}, names, picture);
}
