// The colour and shape that each point keeps on the page.

import Plot from "../vendor/plot.js";
import {h} from "../elements/elements.js";
import {compareCells} from "../elements/tables.js";
import {pointKey, pointLabel} from "../study/data.js";
import {isOneSeed} from "../study/mistakes.js";
import {
    allPoints, comparedPoints, groupOf, markName, mostNamed, parametersOf, places, pointGroups, shownPoints, techniques
} from "../study/points.js";
import {grouped, unique} from "../values.js";

export const symbolNames = ["circle", "square", "triangle", "diamond", "star", "cross", "wye", "hexagon"];

export const mostStyles = 64;

/// Eight colours and eight shapes: shape and colour shift against each other, so that all pairs differ.
export const seriesStyle = index =>
    ({color: `var(--s${index % 8})`, symbol: symbolNames[(index + Math.floor(index / 8)) % 8]});

/// The distinct values of a swept parameter, numbers in ascending order.
const valuesOf = name => unique(allPoints.map(p => parametersOf(p)[name]).filter(v => v !== undefined))
                             .sort((a, b) => typeof a === "number" ? a - b : String(a).localeCompare(String(b)));

/// From the first value to the last one: cividis, which looks alike with and without defects of colour vision.
function parameterStyle(name, value) {
    const values = valuesOf(name), place = values.indexOf(value);
    if (place < 0) return {color: "var(--faint)", symbol: "wye"};
    const share = values.length > 1 ? place / (values.length - 1) : 0;
    const scale = Plot.scale({color: {type: "linear", domain: [0, 1], scheme: "cividis"}});
    return {color: scale.apply(0.05 + 0.9 * share), symbol: symbolNames[place % 8], hasOutline: true};
}

export function styleOf(row) {
    const by = shownPoints.colourBy;
    if (by === "point") return seriesStyle(places.get(pointKey(row)));
    if (by === "technique") return seriesStyle(techniques.indexOf(row.technique));
    if (by === "group") return seriesStyle(pointGroups.indexOf(groupOf(row)));
    return parameterStyle(by, parametersOf(row)[by]);
}

/// [{label, keys, style}]: what colours and shapes stand for, of the points of `rows`.
export function legendGroups(rows) {
    const points = [...new Map(rows.map(r => [pointKey(r), r])).values()], by = shownPoints.colourBy;
    const name = p => by === "point" ? pointLabel(p) :
        by === "technique"             ? p.technique :
        by === "group"               ? groupOf(p) || "no group" :
        by in parametersOf(p)        ? `${by} = ${JSON.stringify(parametersOf(p)[by])}` :
                                       `without ${by}`;
    const ordered = ["point", "technique", "group"].includes(by) ?
        points :
        [...points].sort((a, b) => compareCells(parametersOf(a)[by] ?? null, parametersOf(b)[by] ?? null, true));
    return [...grouped(ordered, name)].map(
        ([label, own]) => ({label, keys: own.map(pointKey), style: styleOf(own[0])}));
}

/// The marks of `rows` get their point's colour, shape and name.
export function pointMark(row, more) {
    const isNamed = comparedPoints.length <= mostNamed && shownPoints.colourBy === "point";
    return {
        ...styleOf(row),
        isHollow: isOneSeed(row),
        name: isNamed ? markName(row) : null,
        data: {technique: row.technique, point: row.point, value: row.value},
        ...more
    };
}

const icons = new Map();

/// A mark's shape, for legends and tables.
export function icon(style, isHollow = false) {
    const key = JSON.stringify([style, isHollow]);
    if (!icons.has(key)) icons.set(key, drawnIcon(style, isHollow));
    return icons.get(key).cloneNode(true);
}

function drawnIcon({color, symbol, hasOutline}, isHollow) {
    const stroke = isHollow ? color : hasOutline ? "var(--ink)" : color;
    const picture =
        Plot.dot([[7, 7]], {x: "0", y: "1", symbol, r: 4.5, fill: isHollow ? "none" : color, stroke, strokeWidth: 1.2})
            .plot({width: 14, height: 14, margin: 0, axis: null, x: {type: "identity"}, y: {type: "identity"}});
    picture.setAttribute("aria-hidden", "true");
    picture.classList.add("icon");
    return picture;
}

/// `entries`: [{label, style, isHollow, isShown, toggle}]; `actions`: [[name, function]] after them.
export function legend(entries, actions = []) {
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
