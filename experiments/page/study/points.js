// The points that a study compares: which are shown, and the number, colour and shape that each keeps on the page.

import {ownLabel, pointKey, pointLabel, report} from "./data.js";
import {list, unique} from "../values.js";

export const singleChangeKeys = new Set(report.singleChanges.map(pointKey));
export const isSingleChange = row => singleChangeKeys.has(pointKey(row));

/// Of a capture without truth, which has no errors, those that it ran.
export const allPoints = [...new Map((report.errors.length ? report.errors : list(report.manifest.techniques))
                                  .map(r => [pointKey(r), {technique: r.technique, point: r.point}]))
                       .values()];
export const comparedPoints = allPoints.filter(p => !isSingleChange(p));
export const places = new Map(allPoints.map((p, i) => [pointKey(p), i]));
export const techniques = unique(allPoints.map(p => p.technique));
export const mostNamed = 30;  // more names than that cover each other
/// The point's name at a mark, no longer than it takes to differ from the others.
export const markName = (() => {
    const count = technique => comparedPoints.filter(p => p.technique === technique).length;
    const others = techniques.filter(t => t !== "none");
    return row => ownLabel(row) ??
        (count(row.technique) === 1 ? row.technique :
             others.length === 1    ? row.point :
                                      pointLabel(row));
})();

/// What the reader chose to see. `hidden`: keys of points that legends switched off.
export const shownPoints = {
    filter: "",
    sort: "study",
    isGrouped: false,
    relativeTo: "best",  // or none: what cells of the matrix are divided by
    colourBy: comparedPoints.length <= mostNamed ? "point" : "technique",
    // A grid has holes without them; a list of changes to a baseline is shown by its effects.
    hasSingleChanges: comparedPoints.some(p => (p.point.match(/=/g) ?? []).length > 1),
    hidden: new Set()
};

const parametersByPoint = new Map(list(report.manifest.techniques).map(v => [pointKey(v), v.parameters ?? {}]));
export const parametersOf = row => parametersByPoint.get(pointKey(row)) ?? {};
const groupsByPoint = new Map(list(report.manifest.techniques).map(v => [pointKey(v), v.group ?? ""]));
export const groupOf = row => groupsByPoint.get(pointKey(row)) ?? "";
export const pointGroups = unique(allPoints.map(groupOf));

/// Names of parameters in which points of one technique differ.
export const sweptParameters = (() => {
    const swept = new Map();
    for (const technique of techniques) {
        const all = allPoints.filter(p => p.technique === technique).map(parametersOf);
        const names = unique(all.flatMap(Object.keys));
        swept.set(technique, names.filter(name => unique(all.map(p => JSON.stringify(p[name]))).length > 1));
    }
    return swept;
})();

/// The points of each sweep in its order: they differ in one parameter alone, whose values are numbers.
export const sweeps = (() => {
    const found = [];
    for (const [technique, names] of sweptParameters)
        for (const name of names) {
            const byRest = new Map();
            for (const point of comparedPoints.filter(p => p.technique === technique)) {
                const {[name]: value, ...rest} = parametersOf(point), key = JSON.stringify(Object.entries(rest).sort());
                if (typeof value === "number") byRest.set(key, [...byRest.get(key) ?? [], {point, value}]);
            }
            for (const own of byRest.values())
                if (own.length > 1) found.push(own.sort((a, b) => a.value - b.value).map(o => o.point));
        }
    return found;
})();

const mostParameters = 8;  // in a tip
/// For tips: the parameters that differ among the points of the technique; a swept point's name has them already.
export function parameterLines(row) {
    if (row.point.includes("=")) return [];
    const names = sweptParameters.get(row.technique) ?? [], parameters = parametersOf(row);
    const shown = names.slice(0, mostParameters), rest = names.length - shown.length;
    return [
        ...shown.map(name => `${name} = ${JSON.stringify(parameters[name])}`),
        ...(rest ? [`and ${rest} more parameters (see the section Parameters)`] : [])
    ];
}
/// What the point is, for tips: its name, and those parameters.
export const pointText = row => [pointLabel(row), ...parameterLines(row)].join("\n");
export const showsAll = () => shownPoints.hasSingleChanges || singleChangeKeys.size === 0;
export const mayShow = row => showsAll() || !isSingleChange(row);
/// By what is read, and by what results are keyed by.
function matchesFilter(row) {
    const {filter} = shownPoints, key = pointKey(row);
    if (matches.filter !== filter) matches = {filter, byPoint: new Map()};
    if (!matches.byPoint.has(key)) {
        const names = `${pointLabel(row)} ${row.technique} ${row.point} ${groupOf(row)}`.toLowerCase();
        matches.byPoint.set(key, filter.toLowerCase().split(/\s+/).every(word => names.includes(word)));
    }
    return matches.byPoint.get(key);
}
let matches = {};  // of the last filter
/// Rows of the points that the reader has not filtered out.
export const filteredRows = rows =>
    showsAll() && !shownPoints.filter ? rows : rows.filter(r => mayShow(r) && matchesFilter(r));
/// Those of them that no legend switched off: what charts draw.
export const chartedRows = rows =>
    shownPoints.hidden.size ? filteredRows(rows).filter(r => !shownPoints.hidden.has(pointKey(r))) : filteredRows(rows);
export const choice = {};
