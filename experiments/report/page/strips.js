// Strips: the cells of a table that show values as marks on one scale, which the last row of the table labels.

const stripSize = {
    width: 330,
    left: 8,
    right: 322,
    row: 12
};

/// One scale for all values of a table, and of the `reference` that a line marks (null if none does).
function stripScale(values, isLog, reference = null, leastAir = 0.15) {
    const all = reference === null ? values : [...values, reference];
    const scale = isLog ? logScale(all, stripSize.left, stripSize.right, leastAir) :
                          linearScale(all, stripSize.left, stripSize.right);
    return {...scale, from: stripSize.left, to: stripSize.right, reference};
}

/// `marks`: [{series, row: {value, low, high}, isHollow, tip, lane}]; lanes lie below each other.
function strip(scale, marks) {
    const lanes = Math.max(0, ...marks.map(m => m.lane ?? 0)) + 1, height = lanes * stripSize.row + 6;
    const picture = svg("svg", {viewBox: `0 0 ${stripSize.width} ${height}`, class: "strip", role: "group"});
    for (const v of scale.ticks)
        picture.append(svg("line", {class: "axis", x1: scale.toPixel(v), x2: scale.toPixel(v), y1: 0, y2: height}));
    if (scale.reference !== null)
        picture.append(svg("line", {
            class: "zero",
            x1: scale.toPixel(scale.reference),
            x2: scale.toPixel(scale.reference),
            y1: 0,
            y2: height
        }));
    for (const m of marks) picture.append(stripMark(scale, m, 3 + stripSize.row * ((m.lane ?? 0) + 0.5)));
    return picture;
}

function stripMark(scale, {series, row, isHollow, tip}, y) {
    const color = seriesColor(series), x = scale.toPixel(row.value);
    const hasBar = row.low !== null && row.low !== undefined &&
        (scale.toPixel(row.low) < scale.toPixel(row.high) || scale.isInside(row.value));
    const bar = !hasBar ? null : svg("path", {
        d: `M${scale.toPixel(row.low)} ${y}H${scale.toPixel(row.high)}M${scale.toPixel(row.low)} ${y - 3}v6M${
            scale.toPixel(row.high)} ${y - 3}v6`,
        stroke: color,
        "stroke-width": 1.4,
        fill: "none"
    });
    const dot = scale.isInside(row.value) ? mark(series, x, y, 1, isHollow) : offScale(x, y, color);
    return withTip(svg("g", {class: "point", "data-value": row.value}, bar, dot), tip);
}

/// An arrow at the end beyond which the value lies.
function offScale(x, y, color) {
    const isLeft = x < (stripSize.left + stripSize.right) / 2;
    return svg(
        "text", {x, y: y + 4, "text-anchor": isLeft ? "start" : "end", style: `fill:${color}`}, isLeft ? "◀" : "▶");
}

/// The labels of the scale, for the last row of a table of strips.
function stripAxis(scale, label) {
    return svg(
        "svg", {viewBox: `0 0 ${stripSize.width} 36`, class: "strip", role: "img", "aria-label": label},
        horizontalAxis(scale, 0, 0, label).filter(e => e.tagName === "text"));
}
