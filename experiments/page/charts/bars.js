// Bars of stacked parts: where rays ended, where errors lie, what stages take.

import Plot from "../vendor/plot.js";
import {axisX, gridX, linearAxis} from "./axes.js";
import {named, plot} from "./plots.js";
import {h} from "../elements/elements.js";
import {percent} from "../values.js";

/// Bars of stacked parts. `rows`: [{label, parts: [{value, fill, text, tip, data}], total: {low, high} or null}];
/// `limits`: [{x, rows: [label], tip}], lines across the bars of these rows. A part shows its text where there is room.
export function stackedBars({title, rows, xLabel, limits = [], isShare = false}) {
    const width = 760, barHeight = 20;
    const longest = Math.max(...rows.map(r => r.label.length)), marginLeft = Math.min(300, 16 + 6.8 * longest);
    const parts = rows.flatMap(row => {
        let start = 0;
        return row.parts.map(p => ({
                                 ...p,
                                 row: row.label,
                                 textEnd: row.total?.low ?? Infinity,
                                 from: start,
                                 to: start += p.value,
                                 className: "bar",
                                 data: {value: p.value, ...p.data}
                             }));
    });
    const ends = [...parts.map(p => p.to), ...rows.map(r => r.total?.high ?? 0), ...limits.map(l => l.x)];
    const x = isShare ? {domain: [0, 1], ticks: [0, 0.2, 0.4, 0.6, 0.8, 1], tickFormat: v => percent(v)} :
                        linearAxis(ends, xLabel, true);
    const pixels = (width - marginLeft - 20) / (x.domain[1] - x.domain[0]);
    const textEnd = p => Math.min(p.to, p.textEnd);  // before the interval of the row's total
    const hasRoom = p => p.text && (textEnd(p) - p.from) * pixels > 6.5 * p.text.length + 6;
    const totals = rows.filter(r => r.total);
    const picture = plot({
        width,
        height: rows.length * (barHeight + 6) + 48,
        marginLeft,
        marginRight: 20,
        marginTop: 4,
        marginBottom: 44,
        ariaLabel: title,
        x: {...x, label: xLabel},
        y: {type: "band", domain: rows.map(r => r.label), label: null, padding: 0.2},
        marks: [
            gridX(x), axisX({...x, label: xLabel}, {labelOffset: 36}),
            Plot.axisY(
                {tickSize: 0, label: null, lineWidth: (marginLeft - 10) / 12, textOverflow: "ellipsis", fontSize: 12}),
            Plot.barX(parts, {
                x1: "from",
                x2: "to",
                y: "row",
                fill: "fill",
                stroke: "var(--card)",
                strokeWidth: 0.7,
                ...named(parts)
            }),
            Plot.text(parts.filter(hasRoom), {
                x: p => (p.from + textEnd(p)) / 2,
                y: "row",
                text: "text",
                fill: "var(--ink)",
                stroke: "var(--card)",
                strokeWidth: 4,
                fontSize: 11,
                pointerEvents: "none"
            }),
            Plot.ruleY(totals, {
                y: "label",
                x1: r => r.total.low,
                x2: r => r.total.high,
                stroke: "var(--ink)",
                strokeWidth: 1.6,
                marker: "tick"
            }),
            Plot.tickX(
                limits.flatMap(l => l.rows.map(row => ({...l, row}))),
                {x: "x", y: "row", stroke: "var(--ink)", strokeWidth: 2.5, strokeDasharray: "3 2"})
        ]
    });
    return h("figure", {class: "chart wide"}, picture);
}
