// Charts of error against time or a counted cost, one per shot and metric.

import Plot from "../vendor/plot.js";
import {clampTo, errorAxis, linearAxis, logAxis} from "../charts/axes.js";
import {markChart} from "../charts/plots.js";
import {pointMark, styleOf} from "../charts/styles.js";
import {choiceBox} from "../elements/elements.js";
import {budgetLine} from "./budget.js";
import {chipKinds, costKinds, costOptions, timedOn, totalCost, totalTime} from "../study/costs.js";
import {pointKey, pointLabel, report, shortShot} from "../study/data.js";
import {better, framesText, metricKey, rowText, unitText} from "../study/errors.js";
import {ladderOf} from "../study/ladder.js";
import {mistakesOfError, mistakesOfTime} from "../study/mistakes.js";
import {chartedRows, parameterLines, sweeps} from "../study/points.js";
import {countText, interval, microseconds, number} from "../values.js";
import {openPoint} from "../viewer/viewer.js";

/// What charts have along their x axis: "time", or a name of costKinds or chipKinds. Without times the first chip, if there
/// is one.
export const costAxis = {
    kind: report.times.length ? "time" : Object.keys(chipKinds)[0] ?? "time"
};
/// Called when the reader chooses another x axis.
export const costListeners = [];

/// A box for the x axis of all charts; several boxes show the same choice. Null where there is no choice.
export function costBox() {
    if (costOptions.length < 2) return null;
    const box = choiceBox("Charts against", costAxis, "kind", costOptions, () => costListeners.forEach(draw => draw()));
    costListeners.push(() => box.querySelector("select").value = costAxis.kind);
    return box;
}

export const costOf = row => costAxis.kind === "time" ? totalTime(row) : totalCost(row, costAxis.kind);

/// The points that summary.csv has on the front of error against what the x axis shows, in the order of their costs.
const frontOf = timed =>
    timed.filter(p => p.row.fronts.split(" ").includes(costAxis.kind)).sort((a, b) => a.time.value - b.time.value);

/// `all`: rows of one shot and metric; `open`: what a click on a mark does with its row. Without times the points stand
/// beside each other. None is a line alone: its time and error would push all others together. Null where no row is
/// shown.
export function errorTimeChart(shot, all, {width = 440, height = 320, open = openPoint} = {}) {
    const shown = chartedRows(all).filter(r => r.value !== null), none = shown.find(r => r.technique === "none");
    const rows = shown.length > 1 ? shown.filter(r => r !== none) : shown;
    if (!rows.length) return null;
    const {metric, target, mask} = rows[0], isLog = better(metric) === "lower";
    const timed = rows.map(row => ({row, time: costOf(row)})).filter(p => p.time?.value > 0),
          hasTimes = timed.length > 0, chip = chipKinds[costAxis.kind],
          cost = costKinds[costAxis.kind] ?? chip;
    const points = hasTimes ? timed : rows.map((row, i) => ({row, time: {value: i + 1, low: null, high: null}}));
    const y = errorAxis(isLog, points.map(p => p.row), metric + unitText(metric));
    const xLabel = cost ? cost.axis + (chip ? "" : ", in the last frame") : "total time (ms), " + timedOn(shot);
    const order = linearAxis([1, rows.length], "points, in the order of the study (no times)");
    const x = hasTimes ? logAxis(timed.flatMap(({time}) => [time.low ?? time.value, time.high ?? time.value]), xLabel) :
                         {...order, ticks: order.ticks.filter(Number.isInteger)};
    const mistakes = row => [...mistakesOfError(row), ...(hasTimes && !cost ? mistakesOfTime(row) : [])]
                                .map(m => `\n! ${m.text}`)
                                .join("");
    const timeText = time => !hasTimes ? "" :
        chip                           ? `\nestimated ${microseconds(time.value)} ${interval(time, 3)}` :
        cost                           ? `\n${countText(time.value * 1e6)} ${cost.name}` :
                                         `\n${number(time.value)} ms ${interval(time)}, ${time.frames} frames`;
    const marks = points.map(
        ({row, time}) => pointMark(row, {
            x: time.value,
            y: row.value,
            open: () => open(row),
            spanX: time.low === null ? null : [time.low, time.high],
            spanY: row.low === null ? null : [row.low, row.high],
            size: rows.length > 40 ? 3.6 : 4.5,
            tip: [pointLabel(row), rowText(row) + timeText(time) + mistakes(row), ...parameterLines(row)].join("\n")
        }));
    const limit =
        ladderOf(shot, {target, metricKey: metricKey(rows[0]), mask}).find(r => r.rung === "on_screen" && r.value > 0);
    const levels = [
        none && rows.length < shown.length ? level("none", none, y, {stroke: "var(--faint)", strokeDasharray: "5 4"}) :
                                             null,
        limit ? level("limit of one frame", limit, y, {stroke: "var(--accent)", strokeDasharray: "1 3"}) : null
    ].filter(Boolean);
    const under = [
        ...(hasTimes && !cost ? budgetLine(x) : []),
        ...(hasTimes ? [...sweepLines(timed, y), frontLine(frontOf(timed))] : []),
        ...levels.flatMap(l => levelLayers(l, x, y))
    ];
    const frames = framesText(rows[0]);
    const caption = [`${shortShot(shot)}: ${metric}`, target, mask, frames].filter(Boolean).join(", ");
    const chart = markChart({
        title: `${metric} against ${cost?.name ?? "time"}, ${shot}`,
        caption,
        width,
        height,
        x,
        y,
        marks,
        under,
        levels
    });
    chart.dataset.shot = shot;
    return chart;
}

const frontLine = front => Plot.line(front, {
    x: p => p.time.value,
    y: p => p.row.value,
    curve: "step-after",
    stroke: "var(--faint)",
    strokeWidth: 1.4,
    strokeDasharray: "3 2"
});

/// What joins the points of a sweep, in the order of its parameter.
function sweepLines(timed, y) {
    const byKey = new Map(timed.map(p => [pointKey(p.row), p]));
    return sweeps.map(sweep => sweep.map(point => byKey.get(pointKey(point))).filter(Boolean))
        .filter(joined => joined.length > 1)
        .map(joined => Plot.line(joined, {
                 x: p => p.time.value,
                 y: p => clampTo(p.row.value, y),
                 stroke: styleOf(joined[0].row).color,
                 strokeWidth: 1.2,
                 strokeOpacity: 0.5,
                 className: "sweep"
             }));
}

/// A line across the chart at the value of a row, with its interval and its name; at the chart's edge, with an arrow,
/// where the value lies beyond.
function level(name, {value, low, high}, axis, style) {
    const y = clampTo(value, axis), arrow = y < value ? "▲ " : y > value ? "▼ " : "";
    return {y, text: `${arrow}${name} ${number(value, 3)}`, span: low > 0 && !arrow ? [low, high] : null, style};
}

const levelLayers = ({y: place, span, style}, x, y) =>
    [...(span ? [Plot.rect(
                    [{low: clampTo(span[0], y), high: clampTo(span[1], y)}],
                    {x1: x.domain[0], x2: x.domain[1], y1: "low", y2: "high", fill: style.stroke, fillOpacity: 0.15})] :
                []),
     Plot.ruleY([place], {strokeWidth: 1.5, ...style})];
