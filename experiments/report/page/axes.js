// Axes of charts: scales from values to pixels, ticks, marks, colours.

/// Eight colours that can be told apart, then paler ones.
const seriesColor = index =>
    index % 16 < 8 ? `var(--s${index % 8})` : `color-mix(in srgb, var(--s${index % 8}) 45%, var(--card))`;

/// A logarithmic scale over all positive values, with some air (in decades, at least); `toPixel` clamps what lies
/// beyond to the ends.
function logScale(values, from, to, leastAir = 0.15) {
    const positive = values.filter(v => v > 0);
    let low = Math.log10(Math.min(...positive)), high = Math.log10(Math.max(...positive));
    if (!positive.length) [low, high] = [0, 1];
    const air = Math.max(0.08 * (high - low), leastAir);
    [low, high] = [low - air, high + air];
    const toPixel = v =>
        from + (to - from) * Math.min(Math.max(((v > 0 ? Math.log10(v) : -Infinity) - low) / (high - low), 0), 1);
    return {toPixel, ticks: logTicks(low, high), isInside: v => v > 0 && Math.log10(v) >= low && Math.log10(v) <= high};
}

/// Decades, and 2 and 5 between them where there are few; even steps where the axis spans less than a factor of 1.6.
function logTicks(low, high) {
    if (high - low < 0.2) return evenTicks(10 ** low, 10 ** high);
    const steps = high - low < 1.2 ? [1, 1.5, 2, 3, 4, 5, 7] : high - low < 2.5 ? [1, 2, 5] : [1];
    const ticks = [];
    for (let e = Math.floor(low); e <= Math.ceil(high); ++e)
        for (const s of steps)
            if (Math.log10(s) + e >= low && Math.log10(s) + e <= high) ticks.push(s * 10 ** e);
    return ticks;
}

function linearScale(values, from, to, mustShowZero = false) {
    let low = Math.min(...values, ...(mustShowZero ? [0] : [])),
        high = Math.max(...values, ...(mustShowZero ? [0] : []));
    if (!(high > low)) [low, high] = [low - 0.5, low + 0.5];
    const air = mustShowZero ? [0, 0.03] : [0.08, 0.08];
    [low, high] = [low - air[0] * (high - low), high + air[1] * (high - low)];
    return {
        toPixel: v => from + (to - from) * (v - low) / (high - low),
        ticks: evenTicks(low, high),
        isInside: () => true
    };
}

/// About six, at 1, 2 or 5 times a power of ten.
function evenTicks(low, high) {
    const rough = (high - low) / 6, unit = 10 ** Math.floor(Math.log10(rough));
    const step = unit * [1, 2, 5, 10].find(s => s * unit >= rough);
    const ticks = [];
    for (let i = Math.ceil(low / step); i * step <= high; ++i) ticks.push(Number((i * step).toPrecision(12)));
    return ticks;
}

/// A mark about 8 wide at (x, y): each series has a shape of its own beside its colour.
function mark(series, x, y, size = 1, isHollow = false) {
    const style = isHollow ? {fill: "var(--card)", stroke: seriesColor(series), "stroke-width": 1.5} :
                             {fill: seriesColor(series), stroke: "var(--card)", "stroke-width": 1};
    const polygon = (n, turn, r) =>
        Array
            .from(
                {length: n},
                (_, i) => {
                    const a = turn + 2 * Math.PI * i / n;
                    return `${(x + size * r * Math.sin(a)).toFixed(2)},${(y - size * r * Math.cos(a)).toFixed(2)}`;
                })
            .join(" ");
    switch (series % 5) {
        case 0:
            return svg("circle", {cx: x, cy: y, r: 4 * size, ...style});
        case 1:
            return svg("polygon", {points: polygon(4, Math.PI / 4, 5), ...style});
        case 2:
            return svg("polygon", {points: polygon(3, 0, 5.6), ...style});
        case 3:
            return svg("polygon", {points: polygon(4, 0, 5.6), ...style});
        default:
            return svg("polygon", {points: polygon(3, Math.PI, 5.6), ...style});
    }
}

const legendEntry = (series, name, isHollow = false) =>
    h("span", {}, svg("svg", {viewBox: "0 0 14 14", "aria-hidden": "true"}, mark(series, 7, 7, 1, isHollow)), name);

function horizontalAxis(scale, top, bottom, label) {
    const lines = scale.ticks.map(
        v =>
            [svg("line", {class: "axis", x1: scale.toPixel(v), x2: scale.toPixel(v), y1: top, y2: bottom}),
             svg("text", {x: scale.toPixel(v), y: bottom + 15, "text-anchor": "middle"}, number(v, 4))]);
    return [
        ...lines.flat(),
        svg("text", {class: "faint", x: (scale.from + scale.to) / 2, y: bottom + 32, "text-anchor": "middle"}, label)
    ];
}

function verticalAxis(scale, left, right, label, middle) {
    const lines = scale.ticks.map(
        v =>
            [svg("line", {class: "axis", x1: left, x2: right, y1: scale.toPixel(v), y2: scale.toPixel(v)}),
             svg("text", {x: left - 6, y: scale.toPixel(v) + 4, "text-anchor": "end"}, number(v, 4))]);
    return [
        ...lines.flat(),
        svg("text", {class: "faint", transform: `translate(13 ${middle}) rotate(-90)`, "text-anchor": "middle"}, label)
    ];
}
