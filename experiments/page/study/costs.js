// What points take: measured times, and counted costs.

import {manifestShot, ofShot, pointKey, report} from "./data.js";
import {makers} from "./makers.js";
import {list, unique} from "../values.js";

export const totals = new Map(report.times.filter(t => t.stage === "total").map(t => [t.shot + "|" + pointKey(t), t]));
export const totalTime = row => totals.get(row.shot + "|" + pointKey(row));

/// By name: how charts and controls call a cost, and its value of a row of report.costs, in millions.
export const costKinds = {
    fetches: {name: "fetches", axis: "millions of instructions that read images", of: c => c.fetches / 1e6},
    bytes: {name: "bytes", axis: "MB read and written", of: c => (c.bytesRead + c.bytesWritten) / 1e6},
    operations:
        {name: "operations", axis: "millions of scalar operations, as shaders state them", of: c => c.operations / 1e6}
};

const estimateTotals =
    new Map(report.estimates.filter(e => e.stage === "total" && !e.refusal && e.value > 0 && e.technique !== "none")
                .map(e => [e.chip + "|" + e.shot + "|" + pointKey(e), e]));

/// By chip: how charts call its estimated times.
export const chipKinds = Object.fromEntries([...estimateTotals.values()].map(({chip, product}) => [chip, {
    name: `estimated time on ${product || chip}`,
    axis: `estimated time on ${product || chip} (µs)`
}]));

const costTotals = new Map(report.costs.filter(c => c.stage === "total").map(c => [c.shot + "|" + pointKey(c), c]));

/// The total of a point as a value of an axis, like totalTime(); undefined where nothing was counted or estimated. `kind`:
/// a name of costKinds or chipKinds.
export function totalCost(row, kind) {
    if (kind in chipKinds) return estimateTotals.get(kind + "|" + row.shot + "|" + pointKey(row));
    const total = costTotals.get(row.shot + "|" + pointKey(row));
    return total && {value: costKinds[kind].of(total), low: null, high: null};
}

/// What charts can have along their x axis, as options: times, counted work and chips, as far as there are any.
export const costOptions = [
    ...(report.times.length ? [["time", "time"]] : []),
    ...Object.entries({...(report.costs.length ? costKinds : {}), ...chipKinds}).map(([kind, {name}]) => [kind, name])
];

export const howEstimated = () => `Intervals hold sampling alone: ${report.modelRange.text}.`;

export const howCounted =
    "Counted by the shaders as they ran, in the shot's last frame with the first seed. Counts do not depend on the machine." +
    ` For a point that draws random numbers, other seeds count up to ${report.countSpread} % more or less.`;

/// Which machine and size the times of a shot are of: "llvmpipe (a CPU), 256x144"; its name, too, where others took the
/// times of other shots.
export function timedOn(shot) {
    const {width, height} = manifestShot(shot) ?? {};
    const devices = makers.map(m => m.device).filter(Boolean)
                        .map(d => d.name.split(" (")[0] + (d.type === "cpu" ? " (a CPU)" : ""));
    const loads = list(report.manifest.clock?.load), host = loads.find(l => l.shot === shot)?.host;
    const isOneOfSeveral = unique(loads.map(l => l.host?.name)).length > 1;
    return [...unique(devices), isOneOfSeveral ? host?.name : "", width ? `${width}x${height}` : ""]
        .filter(Boolean)
        .join(", ");
}

/// By how much times of a shot must differ to differ at all; undefined where no point was timed twice.
export const aaFloor = shot => report.manifest.clock?.aa_floors?.[shot];

/// Total times of the points in a shot, by ascending time.
export const timesOf = shot =>
    ofShot(report.times, shot).filter(t => t.stage === "total" && t.technique && t.technique !== "none")
        .sort((a, b) => a.value - b.value);
