// The summary table, and the choice of target, metric and mask that it shares with the matrix and the charts.

import {at, h, scroller} from "../elements/elements.js";
import {foldedLater} from "../elements/later.js";
import {cell, countCell, numberCell, numbers, table, tableActions} from "../elements/tables.js";
import {choiceBoxes, longTable} from "../sections/parts.js";
import {totalTime} from "../study/costs.js";
import {isSamePoint, ofShot, ownLabel, report, shotName} from "../study/data.js";
import {againstNone, bestRows, better, metricKey, otherMetric} from "../study/errors.js";
import {besideTheirShots, ladderRows} from "../study/ladder.js";
import {madeCell} from "../study/makers.js";
import {badges, isOneSeed, mistakesOfError, mistakesOfTime} from "../study/mistakes.js";
import {choice, filteredRows, mayShow, showsAll} from "../study/points.js";
import {grouped, interval, number} from "../values.js";

export const choiceListeners = [];
const errorKey = (target, metric, mask) => [target, metric, mask].join("\n");
const errorsByKey = grouped(report.errors, r => errorKey(r.target, metricKey(r), r.mask));
function rowsOfMetric(metric) {
    const rows = errorsByKey.get(errorKey(choice.target, metric, choice.mask)) ?? [];
    return showsAll() ? rows : rows.filter(mayShow);
}
export const chosenRows = () => rowsOfMetric(choice.metric);
export const otherRows = () => rowsOfMetric(otherMetric(choice.metric, report.errors));

export const showChoice = () => at("choice").append(...choiceBoxes(
    choice, ["target", "metric", "mask"], report.errors, () => choiceListeners.forEach(f => f())));

/// Worth a column: from 2 % of the error.
const isLitNoisy = row => row.litNoise > 0.02 * Math.abs(row.value);

function errorCell(row, isBest) {
    const notes = [];
    if (row.value === null)
        notes.push("not finite");
    else if (row.corrected && row.low !== null && row.low <= 0 && row.high >= 0)
        notes.push("not distinguishable from 0");
    else if (!row.corrected && better(row.metric) === "lower" && row.floor > 0 && row.value <= row.floor)
        notes.push("within the floor");
    return cell(
        row.value, h(isBest ? "b" : "span", {class: notes.length ? "below-floor" : null}, number(row.value)), " ",
        h("small", {class: row.low === null ? "reason" : null},
          [interval(row), ...notes].filter(Boolean).join(" ")));
}

function summaryRow(row, rows, best, others, otherBest, hasLitNoise) {
    const ratio = againstNone(row, rows), time = totalTime(row),
          other = ofShot(others, row.shot).find(o => isSamePoint(o, row));
    return [
        shotName(row.shot), row.technique, cell(row.point, ownLabel(row) ?? row.point, " ", badges(mistakesOfError(row))),
        errorCell(row, best.has(row)), ...(others.length ? [other ? errorCell(other, otherBest.has(other)) : ""] : []),
        numberCell(row.floor),
        ...(hasLitNoise ? [cell(row.litNoise ?? null, number(row.litNoise))] : []),
        cell(
            ratio?.value ?? null, ratio ? number(ratio.value, 3) : "", " ",
            h("small", {}, ratio ? interval({low: ratio.low, high: ratio.high}) : "")),
        cell(
            time?.value ?? null, time ? number(time.value) : "–", " ", h("small", {}, time ? interval(time) : ""),
            ...(time ? badges(mistakesOfTime(row)) : [])),
        cell(
            row.seeds, row.seeds === null ? "–" : String(row.seeds),
            row.deviation === null ? "" : h("small", {}, ` (±${number(row.deviation, 2)})`)),
        countCell(row.pixels), madeCell(row)
    ];
}

export function showSummary() {
    const chosen = filteredRows(chosenRows()), ladder = ladderRows(choice.metric),
          rows = besideTheirShots(chosen, ladder);
    const others = [...otherRows(), ...ladderRows(otherMetric(choice.metric, report.errors))];
    const best = bestRows(chosen), otherBest = bestRows(otherRows());
    const name = choice.metric.split("|")[0], hasLitNoise = rows.some(isLitNoisy);
    const columns = [
        "Shot", "Technique", "Point", ...numbers(name),
        ...(others.length ? numbers(others[0].metric) : []), ...numbers("Noise floor"),
        ...(hasLitNoise ? numbers("Lit noise") : []), ...numbers("× none", "Total ms", "Seeds", "Pixels"),
        "Made by"
    ];
    const lines = rows.map(r => () => summaryRow(r, rows, best, others, otherBest, hasLitNoise));
    const isOpen = at("summary").querySelector("details")?.open ?? chosen.length <= longTable;
    const title = `All ${rows.length} values, with noise floors, times and seeds`;
    const part = foldedLater(title, () => {
        const whole = table(columns, lines, {sortable: true, groupBy: 0});
        return [tableActions(whole, "summary_shown.csv"), scroller(whole)];
    });
    at("summary").replaceChildren(part);
    part.open = isOpen;
    part.drawNow();
    const about = report.metrics[name];
    const corrected = rows.some(r => r.corrected) ?
        "The reference's noise is subtracted." :
        "The reference's noise cannot be subtracted from this metric: compare values with the noise floor.";
    at("summary-note").textContent = [
        about?.doc && about.doc + ".", about?.direction ?? "It is unknown whether less is better, so nothing is printed bold.",
        corrected,
        others.length &&
            `${others[0].metric} stands beside ${name}, because physical and perceptual errors order techniques differently. ` +
                `Noise floor and × none are about ${name}.`,
        ladder.length &&
            "Truth ladder: images with less of the truth's light (see How to read this). They are no techniques, so they are never bold.",
        hasLitNoise &&
            "Lit noise: how much the noise of the path-traced light that techniques read adds to the " +
                "value. Intervals reach down by this amount.",
        "Brackets hold 95 % intervals." +
            (rows.some(isOneSeed) ? " A technique that draws random numbers has no interval and no rank with one seed." :
                                    ""),
        "± after the seeds is the standard deviation over seeds."
    ].filter(Boolean).join(" ").replaceAll("..", ".");
}
