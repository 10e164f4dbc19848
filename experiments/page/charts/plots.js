// Charts, by Observable Plot (vendor/): scales, marks with intervals, legends.

import Plot from "../vendor/plot.js";
import {axisX, axisY, clampTo, gridX, gridY, inDomain, labelPlace, pixelsOf} from "./axes.js";
import {around, labelLine, labelText, markRadius, placeLabels, placesAround} from "./labels.js";
import {symbolNames} from "./styles.js";
import {clickable, h, svg, withTip} from "../elements/elements.js";

/// One tab stop for all of `elements`, the last that had the focus: arrow keys, Home and End go from one to the next.
export function rove(container, elements) {
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
export const named = marks => ({
    render: (index, scales, values, dimensions, context, next) => {
        const group = next(index, scales, values, dimensions, context);
        [...group.children].forEach((element, k) => nameMark(element, marks[index[k]]));
        return group;
    }
});

/// Layers for `marks`: [{x, y, spanX, spanY, color, symbol, hasOutline, isHollow, tip, data, open, size}];
/// spans are intervals [low, high], or null. What lies beyond an axis is an arrow at its end.
export function markLayers(marks, x, y) {
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
export function plot(options) {
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

/// A chart of marks on two axes; `under`: layers below them; `levels`: [{y, text}], names of lines across it. Widths
/// and heights are in CSS pixels at scale 1. A mark's name stands where it covers nothing: the figure's
/// `unnamed` lists the marks that had no room for theirs.
export function markChart(
    {title, caption, width = 440, height = 300, x, y, marks, under = [], levels = []}) {
    const [marginLeft, marginRight, marginTop, marginBottom] = [62, 16, 14, 44];
    const picture = plot({
        width,
        height,
        marginLeft,
        marginRight,
        marginTop,
        marginBottom,
        ariaLabel: title,
        x: {...x, ...labelPlace},
        y: {...y, ...labelPlace},
        marks: [
            gridX(x), gridY(y), axisX(x, {labelOffset: marginBottom - 8}), axisY(y), ...under, ...markLayers(marks, x, y)
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
