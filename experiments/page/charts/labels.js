// Names at marks, where they cover nothing.

import {svg} from "../elements/elements.js";

export const markRadius = 5, labelSize = 10.5;  // of the chart's own pixels

const textWidth = (() => {
    const context = document.createElement("canvas").getContext("2d");
    return text => {
        context.font = `${labelSize}px ${getComputedStyle(document.body).fontFamily}`;
        return context.measureText(text).width;
    };
})();

const overlap = (a, b) =>
    Math.min(a.right, b.right) > Math.max(a.left, b.left) && Math.min(a.bottom, b.bottom) > Math.max(a.top, b.top);

export const around = (x, y, rx, ry = rx) => ({left: x - rx, right: x + rx, top: y - ry, bottom: y + ry});

/// The box of a text whose middle line is at `y`, with a pixel of air.
function textBox({x, y, anchor}, text) {
    const width = textWidth(text), left = anchor === "start" ? x : anchor === "end" ? x - width : x - width / 2;
    return {left: left - 1, right: left + width + 1, top: y - 0.6 * labelSize, bottom: y + 0.6 * labelSize};
}

/// Where a mark's name may stand, the best place first; far from it at the end of a line.
export function placesAround(x, y) {
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
export function placeLabels(labels, field, marks, lines) {
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

export const labelLine = ({line}) => line.length ?
    svg("line", {class: "mark-line", x1: line[0][0], y1: line[0][1], x2: line.at(-1)[0], y2: line.at(-1)[1]}) :
    null;

export const labelText = ({place: {x, y, anchor}, text}) =>
    svg("text", {class: "mark-label", x, y, dy: "0.32em", "text-anchor": anchor, "font-size": labelSize}, text);
