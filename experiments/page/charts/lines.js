// Lines of points over something else than time.

import Plot from "../vendor/plot.js";
import {clampTo, errorAxis, linearAxis} from "./axes.js";
import {markChart} from "./plots.js";
import {pointMark, styleOf} from "./styles.js";
import {pointKey} from "../study/data.js";
import {unitText} from "../study/errors.js";

/// One line per point over `place(row)`; `tip`: what a mark says.
export function lineChart({title, caption, x, rows, place, tip, isLog, size}) {
    const {metric} = rows[0], yLabel = metric + unitText(metric);
    const y = isLog ? errorAxis(true, rows, yLabel) :
                      linearAxis([0, ...rows.flatMap(r => [r.value, r.low ?? r.value, r.high ?? r.value])], yLabel);
    const sorted = [...rows].sort((a, b) => place(a) - place(b));
    const marks = sorted.map(row => pointMark(row, {
                                 x: place(row),
                                 y: row.value,
                                 spanX: null,
                                 spanY: row.low === null ? null : [row.low, row.high],
                                 tip: tip(row),
                                 number: null,
                                 size
                             }));
    const under = [
        ...(isLog ? [] : [Plot.ruleY([0], {stroke: "var(--faint)"})]), Plot.line(sorted, {
            x: place,
            y: r => clampTo(r.value, y),
            z: pointKey,
            stroke: r => styleOf(r).color,
            strokeWidth: 1.2,
            strokeOpacity: 0.6
        })
    ];
    return markChart({title, caption, x, y, marks, under, height: 270});
}
