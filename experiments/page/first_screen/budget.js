// The question of an engine: of what fits into so many milliseconds, which errs least?

import Plot from "../vendor/plot.js";
import {at, folded, h} from "../elements/elements.js";
import {answerImage, choosePoint, drawAnswerCharts} from "./answers.js";
import {answerChoice, answerOf} from "../study/answers.js";
import {aaFloor, timesOf, totalTime} from "../study/costs.js";
import {pointKey, pointLabel, report} from "../study/data.js";
import {headlineMetrics, headlineRows} from "../study/errors.js";
import {makers} from "../study/makers.js";
import {isOneSeed} from "../study/mistakes.js";
import {pointText} from "../study/points.js";
import {interval, number, percent, unique} from "../values.js";
import {addressedView, keepAddress} from "../viewer/keep.js";
import {imageCanvas} from "../viewer/page_images.js";

const budget = {
    milliseconds: null  // none: not asked
};

export const budgetMilliseconds = () => budget.milliseconds;

/// The box for the time, and the answer below it; once. Nothing where no time or no error was measured. It begins with the
/// address' time, or the middle of the first shot's times, so that there is something that fits and something that does not.
export function showBudget() {
    const times = timesOf(answerChoice.shot);
    if (!times.length || !report.errors.length) return;
    const addressed = Number(addressedView()?.get("budget"));
    budget.milliseconds = addressed > 0 ? addressed : Number(times[times.length >> 1].value.toPrecision(1));
    const changed = event => {
        budget.milliseconds = event.target.valueAsNumber > 0 ? event.target.valueAsNumber : null;
        drawAnswerCharts();
        keepAddress();
    };
    at("answer-budget").append(
            h("label", {}, "Time budget per frame: ",
              h("input",
                {type: "number", id: "budget", min: 0, step: "any", value: budget.milliseconds, input: changed}),
              " ms. "),
            h("small", {id: "budget-note"}), h("table", {id: "budget-answer", "aria-live": "polite"}));
}

/// Below the charts' marks: where the budget ends.
export const budgetLine = x => budget.milliseconds > x.domain[0] && budget.milliseconds < x.domain[1] ?
    [
        Plot.ruleX([budget.milliseconds], {stroke: "var(--accent)", strokeWidth: 1.5}),
        Plot.text([budget.milliseconds], {
            x: ms => ms,
            text: ms => `budget ${number(ms, 3)} ms`,
            frameAnchor: "top",
            lineAnchor: "bottom",
            dy: -2,
            fill: "var(--accent)"
        })
    ] :
    [];

export function drawBudget(shot) {
    if (!at("budget-answer")) return;
    const isAsked = budget.milliseconds !== null, byMetric = headlineMetrics().map(m => budgetPoints(shot, m));
    const isProven = answerOf(shot)?.is_clock_proven;
    at("budget-note").textContent = !isAsked ? "" :
        isProven                             ? floorText(shot) :
                                               "The timer was not validated: times may be wrong. " + floorText(shot);
    const head = h("tr", {}, h("td"), h("td"), ["ms", ...headlineMetrics()].map(name => h("th", {scope: "col"}, name)));
    at("budget-answer").replaceChildren(...(isAsked ? [h("thead", {}, head), h("tbody", {}, Object.keys(budgetKinds).flatMap(
                                                                               k => budgetRows(k, byMetric)))] :
                                       []));
}

/// From where on times differ, by two copies of a point.
function floorText(shot) {
    const floor = aaFloor(shot), isOfCpu = makers.some(m => m.device?.type === "cpu");
    return (isOfCpu ? "CPU times, not GPU times. " : "") +
        (floor === undefined ? "No point was timed twice: the noise of times is unknown." :
             floor > 0       ? `Times within ${percent(floor, 2)} are undecided.` :
                               "");
}

/// The rows of the answer, and what they say where there is no such point.
const budgetKinds = {
    "fits": "no timed point surely fits",
    "may fit": "no point with less error",
    "just misses": "no point with less error"
};

/// Points by kind, the first the one to show: of those that surely fit the one of the least error; those of less error
/// that may fit; of those of less error that do not fit the cheapest. What fits, and what may, is as time_summary.csv
/// has it (fits_from_ms, may_fit_from_ms).
function budgetPoints(shot, metric) {
    const timed = headlineRows(shot, metric)
                      .map(row => ({row, time: totalTime(row), badness: row.badness}))
                      .filter(p => p.time && p.badness !== null && !isOneSeed(p.row))
                      .sort((a, b) => a.badness - b.badness);
    const limit = budget.milliseconds, fits = timed.find(p => p.time.fitsFromMs <= limit);
    const better = timed.filter(p => p.time.fitsFromMs > limit && !(p.badness >= fits?.badness));
    const misses =
        better.filter(p => p.time.mayFitFromMs > limit).sort((a, b) => a.time.mayFitFromMs - b.time.mayFitFromMs);
    return {
        "fits": fits ? [fits] : [],
        "may fit": better.filter(p => p.time.mayFitFromMs <= limit),
        "just misses": misses.slice(0, 1)
    };
}

/// A point that needs up to so much more than the budget just misses it.
const justMisses = 1.1;

/// A row for each point with its picture, its time and its errors, the least in bold; a click chooses it. Of two points
/// each is the first by one metric.
function budgetRows(kind, byMetric) {
    const points = new Map();
    for (const found of byMetric)
        for (const p of found[kind].slice(0, 1)) points.set(pointKey(p.row), p);
    const shown = [...points.values()], names = found => found[kind].map(p => pointLabel(p.row));
    const others = unique(byMetric.flatMap(names)).filter(name => !shown.some(({row}) => pointLabel(row) === name));
    const misses = kind === "just misses" && shown.every(p => p.time.mayFitFromMs > justMisses * budget.milliseconds);
    const head = h("th", {scope: "rowgroup", rowspan: Math.max(shown.length, 1)}, misses && shown.length ? "needs more" : kind,
                   others.length ? folded(`${others.length} more`, others.join(", ")) : "");
    if (!shown.length) return [h("tr", {}, head, h("td", {colspan: 2 + byMetric.length}, budgetKinds[kind]))];
    return shown.map(({row, time}, i) => {
        const picture = h("span", {class: "thumbnail"});
        imageCanvas(answerImage(row.shot, row), null).then(canvas => canvas && picture.append(canvas));
        const value = (v, isLeast) => h("td", {class: "number"}, isLeast ? h("b", {}, number(v.value, 3)) : number(v.value, 3),
                                        " ", h("small", {}, v.low === null ? "no interval" : interval(v, 3)));
        const errors = headlineMetrics().map((metric, m) => {
            const error = headlineRows(row.shot, metric).find(r => pointKey(r) === pointKey(row));
            return error ? value(error, kind !== "just misses" && byMetric[m][kind][0] && pointKey(byMetric[m][kind][0].row) === pointKey(row)) :
                           h("td");
        });
        return h("tr", {}, i === 0 ? head : "",
                 h("td", {}, h("button", {
                       "data-technique": row.technique,
                       "data-point": row.point,
                       title: pointText(row),
                       click: () => choosePoint(row)
                   },
                     picture, h("b", {}, pointLabel(row)))),
                 value(time), ...errors);
    });
}
