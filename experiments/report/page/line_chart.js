// A small chart of lines: one per point, over classes or frames, with 95 % intervals.

const lineSize = {
    width: 420,
    height: 250,
    left: 62,
    right: 410,
    top: 10,
    bottom: 196
};

/// `ticks`: [{at, text}] along x. `lines`: [{series, points: [{at, row}]}], each row with value, low and high (null if
/// there is none). `spread`: the lines' marks stand side by side at each tick. `isLog`: values that are not above 0 are
/// drawn as arrows at the lower edge.
function lineChart({title, xLabel, yLabel, ticks, lines, isLog, spread}) {
    const {width, height, left, right, top, bottom} = lineSize;
    const values =
        lines.flatMap(l => l.points.flatMap(p => [p.row.value, p.row.low ?? p.row.value, p.row.high ?? p.row.value]));
    const y = isLog ? logScale(values, bottom, top) : linearScale([...values, 0], bottom, top);
    const places = lines.flatMap(l => l.points.map(p => p.at)), first = Math.min(...places), last = Math.max(...places);
    const air = spread ? 0.5 : 0.03 * Math.max(last - first, 1);
    const x = v => left + (right - left) * (v - first + air) / (last - first + 2 * air);
    const picture =
        svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": title},
            verticalAxis(y, left, right, yLabel, (top + bottom) / 2), classAxis(ticks, x, left, right, bottom, xLabel));
    if (!isLog) picture.append(svg("line", {class: "zero", x1: left, x2: right, y1: y.toPixel(0), y2: y.toPixel(0)}));
    lines.forEach((line, i) => {
        const step = spread ? Math.min(11, 0.7 * (x(1) - x(0)) / lines.length) : 2.5;
        const dodge = step * (i - (lines.length - 1) / 2);
        picture.append(...lineMarks(line, p => x(p.at) + dodge, y));
    });
    return h("figure", {class: "chart"}, h("figcaption", {}, title), picture);
}

function lineMarks(line, x, y) {
    const color = seriesColor(line.series);
    const path =
        line.points.map((p, i) => `${i ? "L" : "M"}${x(p).toFixed(1)} ${y.toPixel(p.row.value).toFixed(1)}`).join("");
    return [
        svg("path", {d: path, fill: "none", stroke: color, "stroke-width": 1.2, opacity: 0.6}),
        ...line.points.map(p => {
            const px = x(p), py = y.toPixel(p.row.value);
            const bar = p.row.low === null || p.row.low === undefined ? null : svg("line", {
                x1: px,
                x2: px,
                y1: y.toPixel(p.row.low),
                y2: y.toPixel(p.row.high),
                stroke: color,
                "stroke-width": 1.5
            });
            const dot = y.isInside(p.row.value) ?
                mark(line.series, px, py, line.points.length > 12 ? 0.7 : 1) :
                svg("text", {x: px, y: py - 2, "text-anchor": "middle", style: `fill:${color}`}, "▼");
            return withTip(svg("g", {class: "point", "data-value": p.row.value}, bar, dot), p.tip);
        })
    ];
}

/// Labels of classes are turned where they would touch.
function classAxis(ticks, x, left, right, bottom, label) {
    const longest = Math.max(...ticks.map(t => t.text.length)) * 6.2;
    const isTurned = ticks.length > 1 && longest > (right - left) / ticks.length;
    const texts = ticks.map(t => {
        const place = isTurned ?
            {transform: `translate(${x(t.at) + 4} ${bottom + 12}) rotate(-35)`, "text-anchor": "end"} :
            {x: x(t.at), y: bottom + 15, "text-anchor": "middle"};
        return svg("text", place, t.text);
    });
    return [
        svg("line", {class: "axis", x1: left, x2: right, y1: bottom, y2: bottom}), ...texts,
        svg("text", {class: "faint", x: (left + right) / 2, y: bottom + 48, "text-anchor": "middle"}, label)
    ];
}
