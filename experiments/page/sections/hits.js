// Where rays ended, against what they truly meet: hits.csv.

import {stackedBars} from "../charts/bars.js";
import {legend} from "../charts/styles.js";
import {at, h, scroller, swatch} from "../elements/elements.js";
import {cell, numberCell, numbers, table} from "../elements/tables.js";
import {choiceBoxes, leaveOut, longTable, shotParts} from "./parts.js";
import {ofShot, pointLabel, report} from "../study/data.js";
import {filteredRows} from "../study/points.js";
import {errorStage, verdicts} from "../study/verdicts.js";
import {grouped, number, percent, percentInterval, unique} from "../values.js";

const hitChoice = {};
export const verdictLegend = some => legend(some.map(v => ({label: v.name, swatch: swatch(v.color)})));

export function showHits() {
    const rays = report.hits.filter(r => r.stage !== errorStage);
    if (!rays.length) return leaveOut("hits");
    const boxes = choiceBoxes(hitChoice, ["mask"], rays, () => parts.redraw());
    const parts = shotParts(unique(rays.map(r => r.shot)), hitPart);
    at("hits").append(h("div", {class: "controls"}, boxes), verdictLegend(verdicts), parts);
}

/// Rows of one point, frame and pass, by quantity.
function hitGroups(shot) {
    const own = filteredRows(ofShot(report.hits, shot)).filter(r => r.mask === hitChoice.mask && r.stage !== errorStage);
    return [...grouped(own, r => [r.technique, r.point, r.stage, r.frame].join("|")).values()].map(
        rows => ({first: rows[0], by: new Map(rows.map(r => [r.quantity, r]))}));
}

const passName = (first, hasFrames) => first.stage.split("/").pop() + (hasFrames ? `, frame ${first.frame}` : "");

function hitPart(shot) {
    const groups = hitGroups(shot), hasFrames = unique(groups.map(g => g.first.frame)).length > 1;
    if (!groups.length) return [];
    const rows = groups.map(
        ({first, by}) => ({
            label: `${pointLabel(first)}: ${passName(first, hasFrames)}`,
            parts: verdicts.filter(v => by.has(v.key)).map(v => {
                const r = by.get(v.key);
                return {
                    value: r.value,
                    fill: v.color,
                    text: v.short,
                    tip: `${pointLabel(first)}\n${v.name}: ${percent(r.value)} of its rays${percentInterval(r)}`
                };
            })
        }));
    const columns = [
        "Point", "Rays of", ...numbers("Correct", "Error of distance", "Depth fetches", "Rays"),
        "Avoidable misses reported as"
    ];
    const lines = groups.map(({first, by}) => {
        const correct = by.get("correct"), distance = by.get("distance_error"), fetches = by.get("fetches");
        const misses = [...by.values()].filter(r => r.quantity.startsWith("miss: ")).sort((a, b) => b.value - a.value);
        return [
            pointLabel(first), passName(first, hasFrames),
            cell(correct.value, percent(correct.value), h("small", {}, percentInterval(correct))),
            cell(distance?.value, distance ? number(distance.value, 2) : ""),
            numberCell(fetches.value, 3), numberCell(first.rays, 6),
            misses.slice(0, 3).map(r => `${r.quantity.slice(6).replace("_", " ")} ${percent(r.value)}`).join(", ")
        ];
    });
    return [h(
        "div", {class: "bars"},
        stackedBars({title: `Where rays ended, ${shot}`, rows, xLabel: "share of the rays", isShare: true}),
        h("details", {open: lines.length <= longTable},
          h("summary", {}, "The same as numbers, with fetches and reasons"), scroller(table(columns, lines))))];
}

/// Opens and scrolls to the rays of a shot.
export function showRaysOf(shot) {
    const part = [...at("hits").querySelectorAll("details.shot")].find(p => p.dataset.shot === shot);
    if (!part) return;
    part.open = true;
    part.drawNow();
    part.scrollIntoView();
}
