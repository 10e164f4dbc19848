// How long GPUs that are not there would take (estimates.csv): stacked bars of stages, by the part that bounds each.

import {stackedBars} from "../charts/bars.js";
import {stageFill, textureLegend, textureSwatch} from "../charts/textures.js";
import {folded, h, scroller} from "../elements/elements.js";
import {cell, numberCell, numbers, shareCell, table} from "../elements/tables.js";
import {chipPart, leaveOut, longList, refusalsNote} from "./parts.js";
import {stackedStages, stageName} from "./stages.js";
import {howEstimated} from "../study/costs.js";
import {isSamePoint, ofShot, pointKey, pointLabel, report, shotLabel} from "../study/data.js";
import {filteredRows} from "../study/points.js";
import {interval, microseconds, number, unique} from "../values.js";

const estimateChoice = {};

/// ChipTimePart of experiments/gpu_costs/chips/chip_time.h: `bound` by its name, `column` of what it takes alone.
const estimateParts = [
    ["vector", "vector", "vector instructions", 0], ["scalar", "scalar", "scalar instructions", 5],
    ["shared_memory", "sharedMemory", "shared memory", 3], ["textures", "textures", "textures and buffers", 4],
    ["targets", "targets", "colour targets", 7], ["memory", "memory", "memory", 1], ["latency", "latency", "latency", 6]
].map(([bound, column, name, look]) => ({bound, column, name, fill: stageFill(look)}));
const partOf = e => estimateParts.find(part => part.bound === e.bound);

export function showEstimates() {
    if (!report.estimates.length) return leaveOut("estimates");
    const values = key => unique(report.estimates.map(e => e[key]));
    return chipPart("estimates", estimateChoice, {
        chips: values("chip").map(chip => [chip, chipText(chip)]),
        shots: values("shot").map(shot => [shot, shotLabel(shot)]),
        draw: estimatesPart
    });
}

function chipText(chip) {
    const product = report.estimates.find(e => e.chip === chip && e.product)?.product;
    return product ? `${chip} (${product})` : chip;
}

function estimatesPart() {
    const {chip, shot} = estimateChoice;
    const own = filteredRows(ofShot(report.estimates, shot).filter(e => e.chip === chip));
    const estimated = own.filter(e => !e.refusal), stages = estimated.filter(e => e.stage !== "total" && e.value > 0);
    const isStated = e => own.some(o => o.stage !== "total" && o.refusal && isSamePoint(o, e));  // by its stages
    const refused = own.filter(e => e.refusal && (e.stage !== "total" || !isStated(e)));
    const place = e => e.stage === "total" ? pointLabel(e) : `${e.stage} of ${pointLabel(e)}`;
    return [
        refusalsNote(refused, own.length, place, "All points"),
        estimated.length ? h("p", {class: "note"}, howEstimated(), compiledBy(estimated)) : "",
        stages.length ? h("div", {class: "bars"}, estimateBars(own, stages),
                          h("div", {}, boundLegend(stages), estimateSentences(own, stages))) :
                        "",
        estimated.length ? estimateTable(estimated) : ""
    ];
}

const compiledBy = estimated => {
    const drivers = unique(estimated.map(e => e.driver)).filter(Boolean);
    return drivers.length ? ` The passes were compiled by ${drivers.join(" and ")}.` : "";
};

/// Between what the model leaves the time.
const modelRangeOf = e =>
    `[${number(e.low * report.modelRange.low, 3)}, ${number(e.high * report.modelRange.high, 3)}]`;
const totalEstimate = (own, point) => own.find(e => e.stage === "total" && isSamePoint(e, point) && !e.refusal);

function estimateBars(own, stages) {
    const {chip, shot} = estimateChoice;
    const rows = stackedStages(stages, ([first]) => totalEstimate(own, first), e => ({
        value: e.value,
        fill: partOf(e).fill,
        data: {stage: e.stage, bound: e.bound},
        said: `estimated ${microseconds(e.value)} ${interval(e, 3)}\nbound by ${partOf(e).name}`
    }));
    return stackedBars({
        title: `Estimated times of stages on ${chip}, ${shot}`,
        rows: rows.map(row => row.total ? row : {...row, label: `${row.label} (in part)`}),
        xLabel: `microseconds on ${chip} (estimate); the line is the 95 % interval of the total`
    });
}

function boundLegend(stages) {
    const bounds = estimateParts.filter(part => stages.some(e => e.bound === part.bound));
    return textureLegend(bounds.map(part => [part.fill, part.name]), "Bound by: ");
}

function estimateSentences(own, stages) {
    const points = unique(stages.map(pointKey)).map(key => stages.find(e => pointKey(e) === key));
    const text = total => total ?
        `${microseconds(total.value)} by estimate (95\u00a0% interval of sampling from ${number(total.low, 3)} to ${
            number(total.high, 3)}; model range ${modelRangeOf(total)}). Most of this time is bound by ${
            partOf(total).name}.` :
        "no total, because a stage has no estimate.";
    const items = points.map(p => h("li", {}, h("b", {}, pointLabel(p)), ": ", text(totalEstimate(own, p))));
    const sentences = h("ul", {class: "sentences"}, items);
    return items.length > longList ? folded("Totals in words", sentences) : sentences;
}

function estimateTable(estimated) {
    const isBound = e => e.stage !== "total" && e.value > 0;
    const part = (e, {bound, column}) =>
        cell(e[column], h(isBound(e) && e.bound === bound ? "b" : "span", {}, number(e[column], 3)));
    const stage = e => e.stage === "total" ?
        h("b", {}, "total") :
        h("span", {}, isBound(e) ? textureSwatch(partOf(e).fill) : null, stageName(e.stage));
    const lines = estimated.map(e => [
        pointLabel(e), stage(e), numberCell(e.value, 3), interval(e, 3), modelRangeOf(e),
        ...estimateParts.map(p => part(e, p)), numberCell(e.caches, 3), shareCell(e.activeLanes), shareCell(e.unmatched)
    ]);
    const inCapitals = estimateParts.map(({name}) => name[0].toUpperCase() + name.slice(1));
    const columns = [
        "Point", "Stage",
        ...numbers("Estimate", "95 % interval", "Model range", ...inCapitals, "Caches", "Lanes that run", "Runs at most")
    ];
    const note = h("p", {class: "note"},
        `Estimates for ${
            chipText(estimateChoice.chip)} in microseconds, and the time that each part of the chip would take alone.`,
        ` Intervals hold sampling alone. The model range is wider: ${report.modelRange.text}.`,
        " Bold marks the part that bounds the stage.",
        " Caches is no part of the estimate: it is the time if every byte came through the L2 cache.",
        " Lanes that run is the share of active lanes, weighted by vector instructions.",
        " Runs at most is the share of the estimate in code whose number of runs has a known upper bound only.");
    return folded("All parts of the estimates as numbers", note, scroller(table(columns, lines, {groupBy: 0})));
}
