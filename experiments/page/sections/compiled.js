// What GPUs' compilers make of the passes (compiled.csv): registers, waves and cycles, without a GPU.

import {h, scroller} from "../elements/elements.js";
import {cell, numberCell, numbers, table} from "../elements/tables.js";
import {chipPart, leaveOut, refusalsNote} from "./parts.js";
import {byShot, ofShot, pointLabel, report, shotLabel} from "../study/data.js";
import {filteredRows} from "../study/points.js";
import {grouped, unique} from "../values.js";

const compiledChoice = {};

// Why a SIMD holds no more waves: Occupancy of experiments/gpu_costs/chips/occupancy.h.
const limitColors = {
    "nothing": "#009e73",
    "registers": "#e69f00",
    "scalar registers": "#f0e442",
    "shared memory": "#cc79a7"
};

export function showCompiled() {
    if (!report.compiled.length) return leaveOut("compiled");
    const shots = shotsByCode().map(
        ([shot, ...alike]) => [shot, shotLabel(shot) + (alike.length ? ` and ${alike.length} alike` : "")]);
    const chips = unique(report.compiled.map(r => r.chip)).map(chip => [chip, chip]);
    return chipPart("compiled", compiledChoice, {chips, shots, draw: compiledPart});
}

/// Lists of shots whose passes are the same: most shots of a study need the same ones.
function shotsByCode() {
    const code = shot =>
        JSON.stringify(ofShot(report.compiled, shot).map(r => ({...r.toJSON(), shot: null})));
    return [...grouped([...byShot(report.compiled).keys()], code).values()];
}

const compiledPass = r => r.stage + (r.pipeline > 0 ? ` #${r.pipeline + 1}` : "");

function compiledPart() {
    const {chip, shot} = compiledChoice;
    const own = filteredRows(ofShot(report.compiled, shot).filter(r => r.chip === chip && r.shader !== "vertex"));
    const compiled = own.filter(r => !r.refusal), refused = own.filter(r => r.refusal);
    const first = new Map();  // by hash
    for (const r of compiled)
        if (r.hash && !first.has(r.hash)) first.set(r.hash, r);
    const columns = [
        "Point", "Pass", ...numbers("Registers", "Spilled", "Waves"), "Limited by",
        ...numbers("Shared memory, bytes", "Instructions", "Latency", "Cycles"), "Machine code"
    ];
    const count = value => numberCell(value, 6);
    const lines = compiled.map(
        r => [pointLabel(r), compiledPass(r), count(r.vgprs), count(r.spilledVgprs), wavesCell(r),
              r.limit || "not known", count(r.ldsBytes), count(r.instructions), count(r.latency),
              count(r.inverseThroughput), codeText(r, first.get(r.hash))]);
    const caption = `${chip}, by ${unique(compiled.map(r => r.driver)).join(", ")}`;
    return [
        refusalsNote(refused, own.length, r => `${compiledPass(r)} of ${pointLabel(r)}`, "All passes"),
        lines.length ? scroller(table(columns, lines, {groupBy: 0, caption})) : ""
    ];
}

/// With a bar of the share that the waves are of those that fit.
function wavesCell(r) {
    if (r.waves === null) return cell(null, "–");
    const color = limitColors[r.limit] ?? "var(--faint)";
    const bar = h("span", {style: `width:${100 * r.waves / r.mostWaves}%;background:${color}`});
    return cell(r.waves, `${r.waves} of ${r.mostWaves}`, h("span", {class: "share"}, bar));
}

/// `first`: the first pass of the table that has this machine code.
function codeText(r, first) {
    if (!r.hash) return "not known";
    if (first === r) return h("code", {}, r.hash);
    const isOtherPass = compiledPass(first) !== compiledPass(r);
    return `same machine code as ${isOtherPass ? `${compiledPass(first)} of ` : ""}${pointLabel(first)}`;
}
