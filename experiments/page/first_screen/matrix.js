// All points in all shots at a glance: one matrix of both errors, coloured by the error relative to another.

import {rove} from "../charts/plots.js";
import {icon, styleOf} from "../charts/styles.js";
import {breakable, h, scroller, withTip} from "../elements/elements.js";
import {compareCells} from "../elements/tables.js";
import {shortWhy} from "../sections/error_shares.js";
import {totalTime} from "../study/costs.js";
import {byShot, changedRow, pointKey, pointLabel, shortShot} from "../study/data.js";
import {better, rowText, unitText} from "../study/errors.js";
import {madeText} from "../study/makers.js";
import {isOneSeed, mistakesOfError} from "../study/mistakes.js";
import {choice, places, pointText, shownPoints} from "../study/points.js";
import {grouped, interval, number, unique} from "../values.js";
import {openPoint} from "../viewer/viewer.js";

const fullColour = 8;  // a ratio of that size, or its inverse, has the full colour
const mostWideColumns = 14;  // more of them have narrow cells below upright names

/// What the cells of one shot and metric are divided by: the least error but for single seeds, which may be so by
/// chance, or that of none; null where there is none.
function columnReference(rows) {
    const positive = rows.filter(r => r.value > 0 && !isOneSeed(r));
    if (!positive.length || (!rows[0].isTime && better(rows[0].metric) !== "lower")) return null;
    if (rows[0].isTime)
        return positive.filter(r => r.technique !== "none")
            .reduce((least, r) => r.value < least?.value ? r : least ?? r, null);
    if (shownPoints.relativeTo === "none") return positive.find(r => r.technique === "none") ?? null;
    return positive.reduce((least, r) => r.value < least.value ? r : least);
}

/// Blue below 1, orange above, the stronger the farther; readable text on either.
function ratioColour(ratio) {
    const size = Math.min(Math.abs(Math.log(Math.max(ratio, 1e-9))) / Math.log(fullColour), 1);
    return `color-mix(in oklab, var(${ratio < 1 ? "--less" : "--more"}) ${(100 * size).toFixed(0)}%, var(--card))`;
}

/// A column per metric and shot. `groups`: rows of one metric each, not filtered.
const matrixColumns = groups => groups.flatMap(rows => [...byShot(rows)].map(([shot, all], i) => {
    const own = all.filter(r => r.value !== null);
    return {
        shot,
        metric: rows[0].metric,
        isFirst: i === 0,
        reference: own.length ? columnReference(own) : null,
        byPoint: new Map(all.map(r => [pointKey(r), r]))
    };
}));

/// `all`: rows of the chosen metric and of the one beside it, not filtered; `order`: the points, as the reader sorted
/// them.
export function matrix(all, order) {
    const groups = all.filter(rows => rows.length), columns = matrixColumns(groups), buttons = [];
    const metricHead = ([{metric, isTime}]) => h(
        "th", {scope: "colgroup", class: "metric", colspan: columns.filter(c => c.metric === metric).length},
        isTime ? "total time (ms)" : metric + unitText(metric));
    const shotHead = ({shot, isFirst}) =>
        h("th", {scope: "col", title: shot, class: isFirst ? "first" : null}, breakable(shortShot(shot)));
    const cellOf = (point, column) => {
        const row = column.byPoint.get(pointKey(point));
        if (!row) return h("td", {}, "–");
        const ratio = column.reference && row.value > 0 ? row.value / column.reference.value : null;
        const button = matrixButton(row, ratio, column), style = ratio ? `background:${ratioColour(ratio)}` : null;
        buttons.push(button);
        return h("td", {style, class: column.isFirst ? "first" : null}, button);
    };
    const groupHead = technique =>
        h("tr", {class: "technique"}, h("th", {scope: "rowgroup", colspan: columns.length + 1}, technique));
    const lines = order.flatMap((point, i) => {
        const isFirst = shownPoints.isGrouped && (i === 0 || order[i - 1].technique !== point.technique);
        const name = h("th", {scope: "row", title: pointText(point)}, icon(styleOf(point)), pointLabel(point));
        const line = h("tr", {}, name, columns.map(column => cellOf(point, column)));
        return isFirst ? [groupHead(point.technique), line] : [line];
    });
    const element = h(
        "table", {class: columns.length > mostWideColumns ? "matrix dense" : "matrix"},
        h("caption", {}, matrixCaption(columns)),
        h("thead", {}, h("tr", {}, h("td"), groups.map(metricHead)),
          h("tr", {}, h("th", {scope: "col"}, "Point"), columns.map(shotHead))),
        h("tbody", {}, lines));
    rove(element, buttons);
    return scroller(element);
}

function matrixCaption(columns) {
    const errors = columns.filter(c => c.metric !== timeColumn), hasTimes = errors.length < columns.length;
    const what = `${unique(errors.map(c => c.metric)).join(" and ")} of ${choice.target}, ${choice.mask} pixels`;
    if (columns.every(c => !c.reference)) return `${what}.`;
    const other = shownPoints.relativeTo === "none" ? "the value of none" : "the least value";
    const colours = shownPoints.relativeTo === "none" ? "Blue is less, orange is more" : "More orange is worse";
    return `${what}, divided by ${other} of the same column. ${colours}: full colour at ${fullColour} times.${
        hasTimes ? " Times are in milliseconds, coloured by their ratio to the least time of a technique." : ""}`;
}

function matrixButton(row, ratio, {reference}) {
    const text = row.value === null  ? "–" :
        ratio === null || row.isTime ? number(row.value, 3) :
                                       number(ratio, ratio < 10 ? 3 : 2);
    const mistakes = row.isTime ? [] : mistakesOfError(row);
    const button =
        h("button",
          {"data-value": row.value,
           class: row.isTime               ? "time" :
               row.standing === "best" ? "best" :
                                         null},
          text, mistakes.length ? " !" : "");
    const tip = [
        `${row.shot}\n${pointText(row)}`, row.isTime ? `${number(row.value)} ms ${interval(row)}` : rowText(row),
        ratio === null || reference === row ? null : `${number(ratio, 3)} times the value of ${pointLabel(reference)}`,
        row.isTime ? null : standingText(row), row.isTime ? null : shortWhy(row),
        ...mistakes.map(m => `! ${m.text}: ${m.why}`), madeText(row)
    ].filter(Boolean).join("\n");
    withTip(button, tip);
    button.removeAttribute("role");  // it has its own
    button.setAttribute("aria-label", `${text}${mistakes.length ? " !" : ""}; ${button.getAttribute("aria-label")}`);
    button.addEventListener("click", () => openPoint(row));
    return button;
}

const standingText = row => ({
    best: "significantly the best of its shot",
    tied: "not certainly worse than the best of its shot (undecided)",
    equivalent: "certainly within the margin of the best of its shot",
    behind: "significantly worse than the best of its shot"
})[row.standing] ?? "not ranked";

const timeColumn = "time";

/// The total times of the points of `rows`, as rows for a group of columns.
export const timeRows = rows => rows.flatMap(row => {
    const time = totalTime(row);
    return time ? [changedRow(row, {
        metric: timeColumn,
        isTime: true,
        isRanked: false,
        standing: "",
        value: time.value,
        low: time.low,
        high: time.high
    })] :
                  [];
});

export const sortKeys = {
    study: "order of the study",
    name: "name",
    error: "mean error",
    time: "mean time"
};

/// Mean of the logarithms over the shots, so that no shot outweighs others; missing ones come last.
function meanLog(values) {
    const known = values.filter(v => v > 0);
    return known.length ? known.reduce((sum, v) => sum + Math.log(v), 0) / known.length : Infinity;
}

/// The points of `rows` as the reader sorts and groups them.
export function sortedPoints(rows) {
    const points = grouped(rows, pointKey);
    const keys = {
        study: own => places.get(pointKey(own[0])),
        name: own => pointLabel(own[0]),
        error: own => meanLog(own.map(r => r.badness)),
        time: own => meanLog(own.map(r => totalTime(r)?.value))
    };
    const by = keys[shownPoints.sort];
    const ordered = [...points.values()]
                        .map(own => ({key: by(own), point: own[0]}))
                        .sort((a, b) => compareCells(a.key, b.key, true));
    const result = ordered.map(o => o.point);
    if (!shownPoints.isGrouped) return result;
    const first = new Map(result.map(p => p.technique).reverse().map((v, i) => [v, -i]));
    return result.map((p, i) => [p, i])
        .sort(([a, i], [b, j]) => first.get(a.technique) - first.get(b.technique) || i - j)
        .map(([p]) => p);
}
