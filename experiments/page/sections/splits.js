// Bias and variance: what of an error all seeds share, and what differs from seed to seed.

import {strip, stripAxis, stripScale} from "../charts/strips.js";
import {legend, seriesStyle} from "../charts/styles.js";
import {at, h, scroller} from "../elements/elements.js";
import {cell, countCell, numberCell, numbers, table} from "../elements/tables.js";
import {choiceBoxes, drawnPart, leaveOut} from "./parts.js";
import {pointLabel, report, shotName} from "../study/data.js";
import {filteredRows, mayShow} from "../study/points.js";
import {interval, number} from "../values.js";

const splitChoice = {};

export function showSplits() {
    if (!report.splits.some(mayShow)) return leaveOut("splits");
    const place = h("div", {class: "strips", id: "split-table"});
    at("splits").append(
        h("div", {class: "controls"}, choiceBoxes(splitChoice, ["target", "mask"], report.splits, drawSplits)),
        legend([{label: "bias²", style: splitStyles[0]}, {label: "variance", style: splitStyles[1], isHollow: true}]),
        scroller(place));
    drawnPart(place, drawSplits);
}

const splitStyles = [seriesStyle(0), seriesStyle(1)];

function drawSplits() {
    const rows =
        filteredRows(report.splits.filter(s => s.target === splitChoice.target && s.mask === splitChoice.mask));
    const ends = part => [part.value, part.low ?? part.value, part.high ?? part.value];
    const scale = stripScale(rows.flatMap(s => [...ends(s.biasSquared), ...ends(s.variance)]), true);
    const columns = [
        "Shot", "Point", "Bias² and variance", ...numbers("MSE", "Bias²", "Variance", "Seeds")
    ];
    const lines = rows.map(s => () => {
        const tip = (name, part) => `${pointLabel(s)}\n${name} ${number(part.value)} ${interval(part)}`;
        const marks = [
            {style: splitStyles[0], row: s.biasSquared, tip: tip("bias²", s.biasSquared), lane: 0},
            {style: splitStyles[1], row: s.variance, isHollow: true, tip: tip("variance", s.variance), lane: 1}
        ];
        return [
            shotName(s.shot), pointLabel(s), strip(scale, marks), numberCell(s.mse, 3),
            partCell(s.biasSquared, isAboutZero(s.biasSquared)), partCell(s.variance, false),
            countCell(s.seeds)
        ];
    });
    const last = ["", "", stripAxis(scale, "radiance², logarithmic"), "", "", "", ""];
    at("split-table").replaceChildren(table(columns, lines, {groupBy: 0, last}));
}

/// A squared bias that is not distinguishable from 0.
const isAboutZero = part => part.value <= 0 || (part.low !== null && part.low <= 0);

const partCell = (part, hasNote) =>
    cell(part.value, number(part.value, 3), " ", h("small", {}, interval(part, 3), hasNote ? " about 0" : ""));
