// Charts, by Observable Plot (vendor/): scales, marks with intervals, legends.

/// Decades, and 2 and 5 between them where there are few; even steps where the axis spans less than a factor of 1.6.
function logTicks(low, high) {
    const decades = Math.log10(high / low);
    if (decades < 0.2) return evenTicks(low, high);
    const steps = decades < 1.2 ? [1, 1.5, 2, 3, 4, 5, 7] : decades < 2.5 ? [1, 2, 5] : [1];
    const ticks = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
        for (const s of steps)
            if (s * 10 ** e >= low && s * 10 ** e <= high) ticks.push(s * 10 ** e);
    return ticks;
}

/// About five, at 1, 2 or 5 times a power of ten.
function evenTicks(low, high) {
    const rough = (high - low) / 5, unit = 10 ** Math.floor(Math.log10(rough));
    const step = unit * [1, 2, 5, 10].find(s => s * unit >= rough * 0.999);
    const ticks = [];
    for (let i = Math.ceil(low / step); i * step <= high; ++i) ticks.push(Number((i * step).toPrecision(12)));
    return ticks;
}

const axisText = v => number(v, 4);

/// Options of a logarithmic scale over all positive values, with some air (in decades, at least).
function logAxis(values, label, leastAir = 0.12) {
    const positive = values.filter(v => v > 0);
    const [low, high] = positive.length ? [Math.min(...positive), Math.max(...positive)] : [1, 10];
    const factor = 10 ** Math.max(0.07 * Math.log10(high / low), leastAir), domain = [low / factor, high * factor];
    return {type: "log", domain, ticks: logTicks(...domain), tickFormat: axisText, label};
}

function linearAxis(values, label, hasZero = false) {
    const all = values.filter(Number.isFinite);
    let low = Math.min(...all, ...(hasZero ? [0] : [])), high = Math.max(...all, ...(hasZero ? [0] : []));
    if (!(high > low)) [low, high] = [low - 0.5, low + 0.5];
    const air = 0.06 * (high - low), domain = [low === 0 && hasZero ? 0 : low - air, high + air];
    return {type: "linear", domain, ticks: evenTicks(...domain), tickFormat: axisText, label};
}

const errorAxis = (isLog, rows, label, also = []) => (isLog ? logAxis : linearAxis)(
    [...rows.flatMap(r => [r.value, r.low ?? r.value, r.high ?? r.value]), ...also], label);

/// One tab stop for all of `elements`, the last that had the focus: arrow keys, Home and End go from one to the next.
function rove(container, elements) {
    elements.forEach((e, i) => e.setAttribute("tabindex", i ? -1 : 0));
    container.addEventListener("focusin", event => {
        if (!elements.includes(event.target)) return;
        elements.forEach(e => e.setAttribute("tabindex", e === event.target ? 0 : -1));
    });
    container.addEventListener("keydown", event => {
        const from = elements.indexOf(event.target), last = elements.length - 1;
        const to = {
            ArrowRight: from + 1,
            ArrowDown: from + 1,
            ArrowLeft: from - 1,
            ArrowUp: from - 1,
            Home: 0,
            End: last
        }[event.key];
        if (from < 0 || !elements[to]) return;
        elements[to].focus();
        event.preventDefault();
    });
}

/// Gives the element that Plot drew of a mark its name and, with `open`, what a click does.
function nameMark(element, mark) {
    element.classList.add(mark.className ?? "point");
    for (const [name, value] of Object.entries(mark.data ?? {})) element.dataset[name] = value;
    withTip(element, mark.tip);
    if (mark.open) clickable(element, mark.open);
}

/// Plot's hook by which each drawn element gets what its mark says.
const named = marks => ({
    render: (index, scales, values, dimensions, context, next) => {
        const group = next(index, scales, values, dimensions, context);
        [...group.children].forEach((element, k) => nameMark(element, marks[index[k]]));
        return group;
    }
});

const inDomain = (v, axis) => v >= axis.domain[0] && v <= axis.domain[1];
const clampTo = (v, axis) => Math.min(Math.max(v, axis.domain[0]), axis.domain[1]);

/// Layers for `marks`: [{x, y, spanX, spanY, color, symbol, hasOutline, isHollow, tip, data, open, size}];
/// spans are intervals [low, high], or null. What lies beyond an axis is an arrow at its end.
function markLayers(marks, x, y) {
    const isInside = m => inDomain(m.x, x) && inDomain(m.y, y);
    const inside = marks.filter(isInside), beyond = marks.filter(m => !isInside(m));
    const span = (m, key, axis) => m[key] && m[key][1] >= axis.domain[0] && m[key][0] <= axis.domain[1];
    const arrow = m => m.y < y.domain[0] ? "▼" : m.y > y.domain[1] ? "▲" : m.x < x.domain[0] ? "◀" : "▶";
    const anchor = m => m.x < x.domain[0] ? "start" : m.x > x.domain[1] ? "end" : "middle";
    const arrows =
        ["start", "middle", "end"].map(place => beyond.filter(m => anchor(m) === place)).filter(a => a.length);
    return [
        Plot.ruleX(marks.filter(m => span(m, "spanY", y) && inDomain(m.x, x)), {
            x: "x",
            y1: m => clampTo(m.spanY[0], y),
            y2: m => clampTo(m.spanY[1], y),
            stroke: "color",
            strokeWidth: 1.5
        }),
        Plot.ruleY(marks.filter(m => span(m, "spanX", x) && inDomain(m.y, y)), {
            y: "y",
            x1: m => clampTo(m.spanX[0], x),
            x2: m => clampTo(m.spanX[1], x),
            stroke: "color",
            strokeWidth: 1.5
        }),
        Plot.dot(inside, {
            x: "x",
            y: "y",
            symbol: "symbol",
            r: m => m.size ?? 4.5,
            fill: m => m.isHollow ? "var(--card)" : m.color,
            stroke: m => m.isHollow ? m.color :
                m.hasOutline        ? "var(--ink)" :
                                      "var(--card)",
            strokeWidth: 1.2,
            sort: null,
            ...named(inside)
        }),
        ...arrows.map(own => Plot.text(own, {
            x: m => clampTo(m.x, x),
            y: m => clampTo(m.y, y),
            text: arrow,
            textAnchor: anchor(own[0]),
            fill: "color",
            fontSize: 12,
            ...named(own)
        }))
    ];
}

/// What all charts share: colours and shapes are the marks' own.
function plot(options) {
    const picture = Plot.plot({
        style: {fontSize: "12px", fontFamily: "inherit", overflow: "visible"},
        color: {type: "identity"},
        symbol: {domain: symbolNames, range: symbolNames},
        r: {type: "identity"},
        ...options
    });
    picture.setAttribute("role", "group");
    picture.querySelectorAll("g[aria-label]")
        .forEach(g => g.removeAttribute("aria-label"));  // of Plot, and of no use to readers
    const marks = [...picture.querySelectorAll("[tabindex]")];
    rove(picture, marks);
    return picture;
}

const markRadius = 5, labelSize = 10.5;  // of the chart's own pixels
const textWidth = (() => {
    const context = document.createElement("canvas").getContext("2d");
    return text => {
        context.font = `${labelSize}px ${getComputedStyle(document.body).fontFamily}`;
        return context.measureText(text).width;
    };
})();

const overlap = (a, b) =>
    Math.min(a.right, b.right) > Math.max(a.left, b.left) && Math.min(a.bottom, b.bottom) > Math.max(a.top, b.top);
const around = (x, y, rx, ry = rx) => ({left: x - rx, right: x + rx, top: y - ry, bottom: y + ry});

/// The box of a text whose middle line is at `y`, with a pixel of air.
function textBox({x, y, anchor}, text) {
    const width = textWidth(text), left = anchor === "start" ? x : anchor === "end" ? x - width : x - width / 2;
    return {left: left - 1, right: left + width + 1, top: y - 0.6 * labelSize, bottom: y + 0.6 * labelSize};
}

/// Where a mark's name may stand, the best place first; far from it at the end of a line.
function placesAround(x, y) {
    const near = [[7, -8], [8, 0], [7, 8], [-7, -8], [-8, 0], [-7, 8], [0, -12], [0, 12]];
    const far = [17, 26, 36, 48].flatMap(
        radius => Array.from(
            {length: 16}, (_, i) => [radius * Math.cos(Math.PI * i / 8), radius * Math.sin(Math.PI * i / 8)]));
    const place = (dx, dy, line) =>
        ({x: x + dx,
          y: y + dy,
          anchor: Math.abs(dx) < 2 ? "middle" :
              dx > 0               ? "start" :
                                     "end",
          line});
    return [
        ...near.map(([dx, dy]) => place(dx, dy, [])),
        // Points of the line from the mark's edge to the name.
        ...far.map(([dx, dy]) => place(dx, dy, [0.3, 0.45, 0.6, 0.75, 0.9].map(t => [x + t * dx, y + t * dy])))
    ];
}

/// `labels`: [{text, places}], the more important ones first. Each gets the first place within `field` where its text
/// and line meet no mark, text or line before, and the fewest of the `lines`, or none: its mark says its name.
function placeLabels(labels, field, marks, lines) {
    const taken = [...marks], placed = [];
    for (const {text, places, mark} of labels) {
        const free =
            places.map(place => ({text, place, mark, box: textBox(place, text)}))
                .filter(
                    ({place, box}) => box.left >= field.left && box.right <= field.right && box.top >= field.top &&
                        box.bottom <= field.bottom && !taken.some(other => overlap(box, other)) &&
                        !place.line.slice(1).some(([x, y]) => taken.some(other => overlap(around(x, y, 0.5), other))));
        // A place farther away is worth a line that is not crossed.
        const cost = ({place, box}) => lines.filter(line => overlap(box, line)).length + (place.line.length ? 1.5 : 0);
        const best = free.reduce((a, b) => a && cost(a) <= cost(b) ? a : b, null);
        if (!best) continue;
        placed.push(best);
        taken.push(best.box, ...best.place.line.slice(1).map(([x, y]) => around(x, y, 1)));
    }
    return placed;
}

const labelLine = ({line}) => line.length ?
    svg("line", {class: "mark-line", x1: line[0][0], y1: line[0][1], x2: line.at(-1)[0], y2: line.at(-1)[1]}) :
    null;
const labelText = ({place: {x, y, anchor}, text}) =>
    svg("text", {class: "mark-label", x, y, dy: "0.32em", "text-anchor": anchor, "font-size": labelSize}, text);

/// Pixels along an axis of markChart() from `start` to `end`.
function pixelsOf({type, domain}, start, end) {
    const map = type === "log" ? Math.log : v => v, [low, high] = domain.map(map);
    return v => start + (end - start) * (map(v) - low) / (high - low);
}

/// A chart of marks on two axes; `under`: layers below them; `levels`: [{y, text}], names of lines across it. Widths
/// and heights are in CSS pixels at scale 1. A mark's name stands where it covers nothing: the figure's
/// `unnamed` lists the marks that had no room for theirs.
function markChart(
    {title, caption, width = 440, height = 300, x, y, marks, under = [], levels = [], marginBottom = 44, ticks = {}}) {
    const label = {labelAnchor: "center", labelArrow: "none"}, [marginLeft, marginRight, marginTop] = [62, 16, 14];
    const picture = plot({
        width,
        height,
        marginLeft,
        marginRight,
        marginTop,
        marginBottom,
        ariaLabel: title,
        x: {...x, ...label},
        y: {...y, ...label},
        marks: [
            Plot.gridX({ticks: x.ticks, stroke: "var(--line)", strokeOpacity: 1}),
            Plot.gridY({ticks: y.ticks, stroke: "var(--line)", strokeOpacity: 1}), Plot.axisX({
                ticks: x.ticks,
                tickFormat: x.tickFormat,
                tickSize: 0,
                ...label,
                label: x.label,
                labelOffset: marginBottom - 8,
                ...ticks
            }),
            Plot.axisY({ticks: y.ticks, tickFormat: y.tickFormat, tickSize: 0, ...label, label: y.label}), ...under,
            ...markLayers(marks, x, y)
        ]
    });
    const right = width - marginRight, bottom = height - marginBottom;
    const toX = pixelsOf(x, marginLeft, right), toY = pixelsOf(y, bottom, marginTop);
    const shown = marks.filter(m => inDomain(m.x, x) && inDomain(m.y, y)).map(m => ({...m, x: toX(m.x), y: toY(m.y)}));
    const span = ([low, high], axis, to) => [low, high].map(v => to(clampTo(v, axis)));
    const lines = [
        ...shown.filter(m => m.spanX).map(m => {
            const [left, right] = span(m.spanX, x, toX);
            return {left, right, top: m.y - 1, bottom: m.y + 1};
        }),
        ...shown.filter(m => m.spanY).map(m => {
            const [bottom, top] = span(m.spanY, y, toY);
            return {left: m.x - 1, right: m.x + 1, top, bottom};
        }),
        ...levels.map(l => around((marginLeft + right) / 2, toY(l.y), right, 1))
    ];
    const levelPlaces = at => [[right, "end"], [marginLeft + 2, "start"]].flatMap(
        ([x, anchor]) => [-8, 9].map(dy => ({x, y: toY(at) + dy, anchor, line: []})));
    const placed = placeLabels(
        [
            ...levels.map(l => ({text: l.text, places: levelPlaces(l.y)})),
            ...shown.filter(m => m.name).map(m => ({text: m.name, places: placesAround(m.x, m.y), mark: m}))
        ],
        {left: marginLeft, right: width, top: marginTop - 4, bottom}, shown.map(m => around(m.x, m.y, markRadius)),
        lines);
    picture.append(svg("g", {}, placed.map(p => labelLine(p.place)), placed.map(labelText)));
    const figure = h("figure", {class: "chart"}, h("figcaption", {}, caption ?? title), picture);
    figure.unnamed = shown.filter(m => !placed.some(p => p.mark === m)).map(m => m.data);
    return figure;
}

/// A mark's shape in `size` pixels, for legends and tables.
function icon({color, symbol, hasOutline}, isHollow = false) {
    const stroke = isHollow ? color : hasOutline ? "var(--ink)" : color;
    const picture =
        Plot.dot([[7, 7]], {x: "0", y: "1", symbol, r: 4.5, fill: isHollow ? "none" : color, stroke, strokeWidth: 1.2})
            .plot({width: 14, height: 14, margin: 0, axis: null, x: {type: "identity"}, y: {type: "identity"}});
    picture.setAttribute("aria-hidden", "true");
    picture.classList.add("icon");
    return picture;
}

/// `entries`: [{label, style, isHollow, isShown, toggle}]; `actions`: [[name, function]] after them.
function legend(entries, actions = []) {
    const entry = e => {
        const content = [e.swatch ?? icon(e.style, e.isHollow), e.label];
        if (!e.toggle) return h("span", {}, content);
        const button =
            h("button", {
                "aria-pressed": String(e.isShown),
                title: `${e.label}: ${e.isShown ? "hide" : "show"} in all charts`,
                click: e.toggle
            },
              content);
        return button;
    };
    return h(
        "div", {class: "legend", role: "group", "aria-label": "Legend"}, entries.map(entry),
        actions.map(([name, act]) => h("button", {class: "plain", click: act}, name)));
}

/// The marks of `rows` get their point's colour, shape and name.
function pointMark(row, more) {
    const isNamed = comparedPoints.length <= mostNamed && shownPoints.colourBy === "point";
    return {
        ...styleOf(row),
        isHollow: isOneSeed(row),
        name: isNamed ? markName(row) : null,
        data: {variant: row.variant, point: row.point, value: row.value},
        ...more
    };
}
