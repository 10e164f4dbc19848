// Axes: domains with some air, and their ticks.

import Plot from "../vendor/plot.js";
import {number} from "../values.js";

/// Decades, and 2 and 5 between them where there are few; even steps where the axis spans little, and would have fewer than three of these.
function logTicks(low, high) {
    const decades = Math.log10(high / low);
    const steps = decades < 1.2 ? [1, 1.5, 2, 3, 4, 5, 7] : decades < 2.5 ? [1, 2, 5] : [1];
    const ticks = [];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
        for (const s of steps)
            if (s * 10 ** e >= low && s * 10 ** e <= high) ticks.push(s * 10 ** e);
    return ticks.length < 3 && decades < 1 ? evenTicks(low, high) : ticks;
}

/// About five, at 1, 2 or 5 times a power of ten.
function evenTicks(low, high) {
    const rough = (high - low) / 5, unit = 10 ** Math.floor(Math.log10(rough));
    const step = unit * [1, 2, 5, 10].find(s => s * unit >= rough * 0.999);
    const ticks = [];
    for (let i = Math.ceil(low / step); i * step <= high; ++i) ticks.push(Number((i * step).toPrecision(12)));
    return ticks;
}

const axisText = v => number(v, 4);

/// Options of a logarithmic scale over all positive values, with some air (in decades, at least).
export function logAxis(values, label, leastAir = 0.12) {
    const positive = values.filter(v => v > 0);
    const [low, high] = positive.length ? [Math.min(...positive), Math.max(...positive)] : [1, 10];
    const factor = 10 ** Math.max(0.07 * Math.log10(high / low), leastAir), domain = [low / factor, high * factor];
    return {type: "log", domain, ticks: logTicks(...domain), tickFormat: axisText, label};
}

export function linearAxis(values, label, hasZero = false) {
    const all = values.filter(Number.isFinite);
    let low = Math.min(...all, ...(hasZero ? [0] : [])), high = Math.max(...all, ...(hasZero ? [0] : []));
    if (!(high > low)) [low, high] = [low - 0.5, low + 0.5];
    const air = 0.06 * (high - low), domain = [low === 0 && hasZero ? 0 : low - air, high + air];
    return {type: "linear", domain, ticks: evenTicks(...domain), tickFormat: axisText, label};
}

export const errorAxis = (isLog, rows, label, also = []) => (isLog ? logAxis : linearAxis)(
    [...rows.flatMap(r => [r.value, r.low ?? r.value, r.high ?? r.value]), ...also], label);

export const inDomain = (v, axis) => v >= axis.domain[0] && v <= axis.domain[1];
export const clampTo = (v, axis) => Math.min(Math.max(v, axis.domain[0]), axis.domain[1]);

/// Pixels along an axis of markChart() from `start` to `end`.
export function pixelsOf({type, domain}, start, end) {
    const map = type === "log" ? Math.log : v => v, [low, high] = domain.map(map);
    return v => start + (end - start) * (map(v) - low) / (high - low);
}

const gridLines = ({ticks}) => ({ticks, stroke: "var(--line)", strokeOpacity: 1});
export const gridX = axis => Plot.gridX(gridLines(axis));
export const gridY = axis => Plot.gridY(gridLines(axis));
export const labelPlace = {labelAnchor: "center", labelArrow: "none"};

export const axisX = ({ticks, tickFormat, label}, more) =>
    Plot.axisX({ticks, tickFormat, tickSize: 0, label, ...labelPlace, ...more});
export const axisY = ({ticks, tickFormat, label}) => Plot.axisY({ticks, tickFormat, tickSize: 0, label, ...labelPlace});
