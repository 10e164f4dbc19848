// What stages do, counted (costs.csv): a cost without a clock, beside their times.

import {folded, h} from "../elements/elements.js";
import {cell, numbers, table} from "../elements/tables.js";
import {costKinds, howCounted} from "../study/costs.js";
import {changedRow, ofShot, pointLabel, report} from "../study/data.js";
import {filteredRows} from "../study/points.js";
import {countText, unique} from "../values.js";

/// Those of a shot that the filter leaves, as rows of bars.
export const costRows = (shot, kind) =>
    filteredRows(ofShot(report.costs, shot)).map(c => changedRow(c, {value: costKinds[kind].of(c)}));

export function costTable(shot) {
    const own = filteredRows(ofShot(report.costs, shot));
    if (!own.length) return "";
    const points = unique(own.map(pointLabel));
    const sorted = [...own].sort((a, b) => points.indexOf(pointLabel(a)) - points.indexOf(pointLabel(b)));
    const counted = c => cell(c, countText(c));
    const row = c =>
        [pointLabel(c), c.stage === "total" ? h("b", {}, "total") : c.stage,
         ...[c.invocations, c.idle, c.fetches, c.texels, c.bytesRead, c.bytesWritten, c.uniqueBytes, c.operations].map(
             counted)];
    const names = "Invocations, Idle, Fetches, Texels, Bytes read, Bytes written, Unique bytes, Operations".split(", ");
    return folded(
        "Counted work of the stages",
        h("p", {class: "note"}, howCounted,
          " Idle invocations write nothing. Unique bytes count each byte of an image or buffer at most once for each pass that reads or writes it."),
        table(
            ["Technique", "Stage", ...numbers(...names)], sorted.map(row),
            {groupBy: 0}));
}
