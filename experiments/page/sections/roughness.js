// Error and bias by class of roughness: which surfaces a technique gets wrong, and in which direction.

import {lineChart} from "../charts/lines.js";
import {at, h} from "../elements/elements.js";
import {drawnLater} from "../elements/later.js";
import {drawnPart, leaveOut, pointLegend} from "./parts.js";
import {ofShot, pointKey, report, shortShot} from "../study/data.js";
import {better, framesText, headlineMetric, metricKey, otherMetric, rowText} from "../study/errors.js";
import {chartedRows, pointText} from "../study/points.js";
import {number, preferredRows, unique} from "../values.js";

/// [from, below] of a mask `roughness_<from>_<below>`, or null.
function roughnessClass(mask) {
    const parts = /^roughness_([0-9.e+-]+)_([0-9.e+-]+)$/.exec(mask);
    return parts && [Number(parts[1]), Number(parts[2])];
}

export function showRoughness() {
    const rows = report.errors.filter(r => r.value !== null && roughnessClass(r.mask));
    if (!rows.length) return leaveOut("roughness");
    const body = h("div");
    at("roughness").append(body);
    drawnPart(body, () => body.replaceChildren(pointLegend(rows), ...roughnessParts(chartedRows(rows))));
}

/// Charts of both errors of the headline side by side, then those of the bias.
function roughnessParts(rows) {
    if (!rows.length) return [];
    const specular = preferredRows(rows, "target", "specular");
    const metric = headlineMetric(specular), other = otherMetric(metric, specular);
    const bias = preferredRows(rows, "target", "incident").filter(r => r.metric === "bias");
    const errors = [metric, other].filter(Boolean).map(key => specular.filter(r => metricKey(r) === key));
    const names = unique(errors.map(own => own[0].metric)).join(" and ");
    return [
        h("h3", {}, `Error: ${names} of target ${specular[0].target}`), roughnessCharts(errors),
        ...(bias.length ?
                [
                    h("h3", {}, `Signed bias of target ${bias[0].target}: above 0 too bright, below too dark`),
                    roughnessCharts([bias])
                ] :
                [])
    ];
}

function roughnessCharts(groups) {
    const shots = unique(groups.flat().map(r => r.shot));
    const charts = shots.flatMap(shot => groups.map(rows => ofShot(rows, shot))).filter(rows => rows.length);
    return h("div", {class: "grid"}, drawnLater(charts, roughnessChart, 300));
}

function roughnessChart(rows) {
    const {metric, shot} = rows[0], isLog = better(metric) === "lower";
    const masks = unique(rows.map(r => r.mask)).sort((a, b) => roughnessClass(a)[0] - roughnessClass(b)[0]);
    const text = mask => roughnessClass(mask).map(v => number(v, 3)).join("–");
    const keys = unique(rows.map(pointKey));
    const dodge = row => Math.min(0.1, 0.8 / keys.length) * (keys.indexOf(pointKey(row)) - (keys.length - 1) / 2);
    const place = row => masks.indexOf(row.mask) + dodge(row);
    const tip = row => `${pointText(row)}\nroughness ${text(row.mask)}, ${row.pixels} pixels\n${rowText(row)}`;
    const frames = unique(rows.map(framesText)).filter(Boolean).join("; ");
    const ticks = masks.map((_, i) => i);
    return lineChart({
        title: `${metric} by roughness, ${shot}`,
        caption: [`${shortShot(shot)}: ${metric}`, frames].filter(Boolean).join(": "),
        x: {
            type: "linear",
            domain: [-0.6, masks.length - 0.4],
            ticks,
            tickFormat: i => text(masks[i]),
            label: "perceptual roughness"
        },
        rows,
        place,
        tip,
        isLog
    });
}
