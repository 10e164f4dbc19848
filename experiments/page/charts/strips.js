// Strips: the cells of a table that show values as marks on one scale, which the last row of the table labels.

import Plot from "../vendor/plot.js";
import {axisX, gridX, linearAxis, logAxis} from "./axes.js";
import {markLayers, plot} from "./plots.js";

const stripSize = {width: 330, side: 9, row: 12};

/// One scale for all values of a table, and of the `reference` that a line marks (null if none does).
export function stripScale(values, isLog, reference = null, leastAir = 0.12) {
    const all = reference === null ? values : [...values, reference];
    return {axis: isLog ? logAxis(all, null, leastAir) : linearAxis(all, null), reference};
}

const stripPlot = options => plot({
    width: stripSize.width,
    marginLeft: stripSize.side,
    marginRight: stripSize.side,
    marginTop: 0,
    axis: null,
    ...options
});

/// `marks`: [{style, row: {value, low, high}, isHollow, tip, lane}]; lanes lie below each other.
export function strip({axis, reference}, marks) {
    const lanes = Math.max(0, ...marks.map(m => m.lane ?? 0)) + 1,
          y = {type: "linear", domain: [-0.5, lanes - 0.5], reverse: true};
    const places = marks.map(({style, row, isHollow, tip, lane}) => ({
                                 ...style,
                                 isHollow,
                                 tip,
                                 x: row.value,
                                 y: lane ?? 0,
                                 data: {value: row.value},
                                 spanX: row.low === null || row.low === undefined ? null : [row.low, row.high]
                             }));
    const picture = stripPlot({
        height: lanes * stripSize.row + 6,
        marginBottom: 0,
        x: axis,
        y,
        marks: [
            gridX(axis),
            ...(reference === null ? [] : [Plot.ruleX([reference], {stroke: "var(--faint)", strokeWidth: 1.2})]),
            ...markLayers(places, axis, y)
        ]
    });
    picture.classList.add("strip");
    return picture;
}

/// The labels of the scale, for the last row of a table of strips.
export function stripAxis({axis}, label) {
    const picture = stripPlot({
        height: 36,
        marginBottom: 36,
        x: axis,
        ariaLabel: label,
        marks: [axisX({...axis, label}, {labelOffset: 32})]
    });
    picture.classList.add("strip");
    return picture;
}
