// Mistakes of a study, said at the row that they concern. Those of the whole study are the page's warnings.

import {badge} from "../elements/elements.js";
import {aaFloor} from "./costs.js";
import {isSamePoint, ofShot, report} from "./data.js";
import {list, number, percent} from "../values.js";

const mostLitNoise = 0.1;  // share of an error, as in report_warnings.cpp
const mostFloors = 2;      // two copies of one point are far apart where they differ by more than that many floors

const mostSeeds = new Map();  // by shot and metric
function seedsOf({shot, metric}) {
    const key = `${shot}|${metric}`, own = () => ofShot(report.errors, shot).filter(r => r.metric === metric);
    if (!mostSeeds.has(key)) mostSeeds.set(key, Math.max(0, ...own().map(r => r.seeds ?? 0)));
    return mostSeeds.get(key);
}

/// [{text, why}] of a row of errors.
export function mistakesOfError(row) {
    const found = [];
    if (row.nonFinite)
        found.push({
            text: `${row.nonFinite} not finite`,
            why: `${row.nonFinite} pixels are NaN or infinite and are left out of every mean`
        });
    if (isOneSeed(row))
        found.push({text: "1 seed", why: "another seed may give any other value, so this point has no interval and no rank"});
    else if (row.interval?.includes("seeds") && row.seeds < seedsOf(row))
        found.push({text: `${row.seeds} of ${seedsOf(row)} seeds`, why: "results of the other seeds are missing"});
    if (row.litNoise > mostLitNoise * Math.abs(row.value))
        found.push({
            text: `lit noise ${percent(row.litNoise / Math.abs(row.value))}`,
            why:
                "this share of the error may be noise of the path-traced light that techniques read; more samples of the reference reduce it"
        });
    return found;
}

/// The same of the times of `row`'s point.
export function mistakesOfTime(row) {
    const {aa_pairs: pairs, load} = report.manifest.clock ?? {}, floor = aaFloor(row.shot), found = [];
    const pair = ofShot(list(pairs), row.shot).find(p => isSamePoint(p, row));
    if (pair && pair.floor > mostFloors * floor)
        found.push({
            text: `copies differ ${percent(pair.floor)}`,
            why: `two interleaved copies of this point took ${number(pair.first_ms, 3)} and ${
                number(pair.second_ms, 3)} ms, far beyond the shot's floor of ${percent(floor)}`
        });
    const disturbed = list(load).find(l => l.shot === row.shot)?.disturbed_frames;
    if (disturbed)
        found.push({
            text: "disturbed",
            why: `other programs disturbed ${disturbed} of this shot's timed frames: times of this shot may be too long`
        });
    return found;
}

export const badges = mistakes => mistakes.map(m => badge(m.text, m.why));

/// A single seed of a point that depends on it: another one might give anything.
export const isOneSeed = row => row.interval === "none: 1 seed";
