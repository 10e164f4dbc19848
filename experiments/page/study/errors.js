// Rows of errors: their metrics, what is better, and what is compared first.

import {manifestShot, ofShot, report} from "./data.js";
import {interval, list, number, preferred, preferredRows, unique} from "../values.js";

/// What the page shows first: the error that a study compares by, and what an eye sees; manifests of other versions
/// may lack it.
export const headline = Object.fromEntries(
    Object.entries({metric: "mse", mask: "reflective", target: "specular", perceptual_metric: "flip", margin: 0.05})
        .map(([key, usual]) => [key, report.headline?.[key] || usual]));

const keysOf = new WeakMap();  // of lists that were asked for
function metricKeys(rows) {
    if (!keysOf.has(rows)) keysOf.set(rows, unique(rows.map(metricKey)));
    return keysOf.get(rows);
}

export const headlineMetric = rows => {
    const keys = metricKeys(rows);
    return preferred(keys, keys.find(m => m.startsWith(headline.metric + "|")));
};

/// The metric that is read beside it: physical and perceptual errors order techniques differently. Undefined if `rows`
/// have none.
export const otherMetric = (key, rows) => {
    const {metric, perceptual_metric: perceptual} = headline, keys = metricKeys(rows);
    const others = key.startsWith(metric + "|") ? [perceptual, "mse", "relmse"] : [metric];
    return others.map(other => keys.find(k => k !== key && k.startsWith(other + "|"))).find(Boolean);
};

export const metricName = key => {
    const [metric, formula] = key.split("|");
    return metric === formula || !formula ? metric : `${metric} (${formula})`;
};

export const unitText = metric => {
    const unit = report.metrics[metric]?.unit;
    return unit && unit !== "1" ? ` (${unit.replace("^2", "²")})` : "";
};

/// The visibility of all frames as a video, of the whole image: it has no frame and no mask of its own.
export const videoMetric = "cvvdp_0_5_6_video";

/// Which frames a row of errors is of; empty for a shot of one frame, and for a score of all frames as a video.
export function framesText(row) {
    const frames = list(manifestShot(row.shot)?.frames);
    if (frames.length < 2 || row.metric === videoMetric) return "";
    return row.frame === "" ? "mean over frames" : `frame ${row.frame} alone`;
}

export const better = metric => report.metrics[metric]?.better;
export const metricKey = row => `${row.metric}|${row.formula}`;

/// The rows that are significantly the best of their shot, as ssrlab decided (experiments/results/verdicts/standings.h).
export const bestRows = rows => new Set(rows.filter(r => r.standing === "best"));

/// The row of `none` over the same frames.
const noneLike = (row, rows) => [...ofShot(rows, row.shot), ...ofShot(report.frames, row.shot)].find(
    r => r.technique === "none" && r.frame === row.frame && r.target === row.target &&
        r.mask === row.mask && metricKey(r) === metricKey(row));

/// value / none with the worst case of both intervals; only where a quotient of errors makes sense.
export function againstNone(row, rows) {
    const none = noneLike(row, rows);
    if (!none || none === row || better(row.metric) !== "lower" || row.value === null || !(none.value > 0)) return null;
    const isBounded = row.low !== null && none.low > 0;
    const ends = isBounded ?
        [row.low / (row.low < 0 ? none.low : none.high), row.high / (row.high < 0 ? none.high : none.low)] :
        [null, null];
    return {value: row.value / none.value, low: ends[0], high: ends[1]};
}

/// Rows of the shot of the headline's target and mask, by the name of a metric.
export const headlineRows = (shot, metric, target = headline.target) => {
    const {mask} = headline;
    const of = ofShot(report.errors, shot).filter(r => r.metric === metric && r.value !== null);
    return preferredRows(preferredRows(of, "target", target), "mask", mask);
};

/// Names of the metrics that stand side by side: one or two.
export const headlineMetrics = () => {
    if (!report.errors.length) return [];
    const first = headlineMetric(report.errors);
    return [first, otherMetric(first, report.errors)].filter(Boolean).map(key => key.split("|")[0]);
};

/// The metric of visibility in JOD, of sequences if there are any; undefined if the study has none.
export const jodMetric = () => [videoMetric, "cvvdp_0_5_6"].find(
    metric => report.errors.some(r => r.metric === metric && r.value !== null));

export const rowText = row => `${row.metric} ${number(row.value)} ${interval(row)}${unitText(row.metric)}`;
