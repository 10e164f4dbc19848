// What is seen in motion: flicker at rest, changes that are not the truth's, ghosts, and the error of each frame.

import {lineChart} from "../charts/lines.js";
import {at, h, scroller} from "../elements/elements.js";
import {drawnLater} from "../elements/later.js";
import {cell, numbers, table, valueCell} from "../elements/tables.js";
import {choiceBoxes, drawnPart, leaveOut, pointLegend} from "./parts.js";
import {byShot, manifestShot, ofShot, pointKey, pointLabel, report, shortShot, shotLabel, shotName} from "../study/data.js";
import {better, metricKey, otherMetric, rowText, unitText, videoMetric} from "../study/errors.js";
import {chartedRows, comparedPoints, isSingleChange, pointText} from "../study/points.js";
import {list, unique} from "../values.js";
import {playShot} from "../viewer/chooser.js";
import {framesOf} from "../viewer/state.js";

const temporalTables = [
    {title: "At rest: flicker", metrics: ["flicker", "flicker_relative", "flicker_correlation"]}, {
        title: "In motion: changes that are not the truth's, and what remains of earlier images",
        metrics: ["frame_difference", "frame_difference_relative", "ghost_share"],
        hasDisoccluded: true
    },
    {title: "As seen: distance from the truth as a video", metrics: [videoMetric]},
    {title: "After a change: ghosts", metrics: ["ghost_length", "settling_length"]}
];
const temporalChoice = {}, frameChoice = {};

export function showTemporal() {
    const rows =
        report.errors.filter(r => temporalTables.some(t => t.metrics.includes(r.metric)) && !isSingleChange(r));
    const frames = report.frames.filter(r => r.value !== null);
    if (!rows.length && !frames.length) return leaveOut("temporal");
    const played = [...byShot(report.images).keys()].filter(shot => framesOf(shot).length > 1);
    if (played.length)
        at("temporal")
            .append(h("div", {class: "controls"},
                played.map(shot => h("button", {click: () => playShot(shot)}, `Play ${shotLabel(shot)}`))));
    if (rows.length) showTemporalTables(rows);
    if (frames.length) showFrames(frames);
}

function showTemporalTables(rows) {
    const tables = h("div", {id: "temporal-tables"});
    const ofMasks = rows.filter(r => !isOfWholeImage(r));
    const draw = () => tables.replaceChildren(...temporalTables.flatMap(
        t => temporalTable(t, rows.filter(r => r.mask === temporalChoice.mask || isOfWholeImage(r)))));
    at("temporal").append(h("div", {class: "controls"}, choiceBoxes(temporalChoice, ["mask"], ofMasks, draw)), tables);
    drawnPart(tables, draw);
}

const isDisoccluded = r =>
    r.mask === "disoccluded" && r.target === "specular" && r.metric === "relmse" && !isSingleChange(r);

/// Bands of frequencies reach over the whole image, whatever mask is chosen.
const isOfWholeImage = r => r.metric === videoMetric;

/// One row per shot and point that has such values.
function temporalTable({title, metrics, hasDisoccluded}, all) {
    const rows = all.filter(r => metrics.includes(r.metric)),
          shown = metrics.filter(m => rows.some(r => r.metric === m));
    if (!rows.length) return [];
    const shots = unique(rows.map(r => r.shot));
    const disoccluded = hasDisoccluded ? shots.flatMap(shot => ofShot(report.errors, shot)).filter(isDisoccluded) : [];
    const columns = [
        "Shot", "Point", ...numbers(...shown.map(m => m + unitText(m))),
        ...(disoccluded.length ? numbers("relmse, disoccluded") : [])
    ];
    const line = (shot, point) => {
        const isOwn = r => pointKey(r) === pointKey(point), own = ofShot(rows, shot).filter(isOwn);
        return own.length ? [() => [
            shotName(shot), pointLabel(point), ...shown.map(m => temporalCell(own.find(r => r.metric === m))),
            ...(disoccluded.length ? [disoccludedCell(ofShot(disoccluded, shot).find(isOwn))] : [])
        ]] : [];
    };
    const lines = shots.flatMap(shot => comparedPoints.flatMap(point => line(shot, point)));
    const meanings = shown.flatMap(m => [h("b", {}, m), `: ${report.metrics[m]?.doc ?? "not known"}. `]);
    return [
        h("h3", {}, title), h("p", {class: "note"}, meanings),
        scroller(table(columns, lines, {sortable: true, groupBy: 0}))
    ];
}

function temporalCell(row) {
    if (!row) return cell(null, "");
    if (row.value === null) return cell(null, h("small", {}, whyMissing(row)));
    return valueCell(row);
}

/// A shot may have no pixel under a mask.
const disoccludedCell = row => row?.pixels ? temporalCell(row) : cell(null, h("small", {}, "no such pixel"));

/// The reason, from the manifest's notes: "<shot>: <technique> <point>: no <metric>: <reason> (<masks>)".
export function whyMissing(row) {
    const start = `${row.shot}: ${row.technique} ${row.point}: no ${row.metric}: `;
    const note =
        list(report.manifest.notes)
            .find(n => n.startsWith(start) && n.slice(n.lastIndexOf("(") + 1, -1).split(", ").includes(row.mask));
    return note ? note.slice(start.length, note.lastIndexOf(" (")) : "reason unknown";
}

function showFrames(rows) {
    const draw = () => drawFrames(rows), charts = h("div", {class: "grid", id: "frame-charts"});
    at("temporal").append(
            h("h3", {}, "Frame by frame"),
            h("div", {class: "controls"}, choiceBoxes(frameChoice, ["metric", "mask"], rows, draw)),
            h("div", {id: "frame-legend"}), charts);
    drawnPart(charts, draw);
}

/// Charts of the chosen metric and of the one beside it, shot by shot.
function drawFrames(all) {
    const own = metric => all.filter(r => metricKey(r) === metric && r.mask === frameChoice.mask);
    const groups = [frameChoice.metric, otherMetric(frameChoice.metric, all)].filter(Boolean).map(own);
    at("frame-legend").replaceChildren(pointLegend(groups[0]));
    const shown = groups.map(chartedRows);
    const charts = unique(groups[0].map(r => r.shot)).flatMap(shot => shown.map(rows => ofShot(rows, shot)));
    at("frame-charts").replaceChildren(...drawnLater(charts.filter(rows => rows.length), frameChart, 300));
}

function frameChart(rows) {
    const frames = unique(rows.map(r => Number(r.frame))).sort((a, b) => a - b), {metric, shot} = rows[0];
    const step = Math.ceil(frames.length / 8), last = frames.at(-1), air = Math.max(0.4, 0.03 * (last - frames[0]));
    const change = manifestShot(shot)?.change;
    return lineChart({
        title: `${metric} by frame, ${shot}`,
        caption:
            `${shortShot(shot)}: ${metric}` + (change === undefined ? "" : `, the scene changes at frame ${change}`),
        x: {
            type: "linear",
            domain: [frames[0] - air, last + air],
            ticks: frames.filter((_, i) => i % step === 0),
            tickFormat: String,
            label: "frame"
        },
        rows,
        place: row => Number(row.frame),
        tip: row => `${pointText(row)}\nframe ${row.frame}\n${rowText(row)}`,
        isLog: better(metric) === "lower",
        size: frames.length > 12 ? 3.2 : 4.5
    });
}
