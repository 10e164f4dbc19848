// The question of an engine: of what fits into so many milliseconds, which errs least?

const budget = {
    milliseconds: null  // none: not asked
};

/// The box for the time, and the answer below it; once. Nothing where no time was measured.
function showBudget() {
    if (!report.times.some(t => t.stage === "total" && t.variant !== "none" && t.variant !== "")) return;
    const changed = event => {
        budget.milliseconds = event.target.valueAsNumber > 0 ? event.target.valueAsNumber : null;
        drawAnswerCharts();
    };
    at("answer-budget")
        .append(
            h("label", {}, "Time budget per frame ",
              h("input", {type: "number", id: "budget", min: 0, step: "any", placeholder: "any", input: changed}),
              " ms"),
            h("p", {id: "budget-answer", "aria-live": "polite"}));
}

/// Below the charts' marks: where the budget ends.
const budgetLine = x => budget.milliseconds > x.domain[0] && budget.milliseconds < x.domain[1] ?
    [Plot.ruleX([budget.milliseconds], {stroke: "var(--accent)", strokeWidth: 1.5})] :
    [];

function drawBudget(shot) {
    if (!at("budget-answer")) return;
    const parts = budget.milliseconds === null ? [] : headlineMetrics().flatMap(metric => budgetParts(shot, metric));
    if (parts.length && !answerOf(shot)?.is_clock_proven)
        parts.push("Timer validation failed: take the times with care. ");
    if (parts.length) parts.push(floorText(shot));
    at("budget-answer").replaceChildren(...parts);
}

/// From where on times differ, by two copies of a point.
function floorText(shot) {
    const floor = aaFloor(shot);
    if (floor === undefined) return "No point was timed twice: the noise of times is not known.";
    return floor > 0 ? `Times within ${percent(floor)} are not distinguishable.` : "";
}

/// "By mse A, 0.05 [0.04, 0.06], in 9 ms [8, 11]": the least error of the points whose median is within the budget, and
/// those of less error whose median is not. What fits, and what may, is as time_summary.csv has it (fits_from_ms,
/// may_fit_from_ms). Each name opens its images.
function budgetParts(shot, metric) {
    const timed = headlineRows(shot, metric)
                      .map(row => ({row, time: totalTime(row), badness: badness(metric, row.value)}))
                      .filter(p => p.time && p.badness !== null && !isOneSeed(p.row))
                      .sort((a, b) => a.badness - b.badness);
    const error = row => row.low === null ? interval(row) && `(${interval(row)})` : interval(row, 3);
    const parts = ({row, time}) => {
        const open = event => {
            event.preventDefault();
            openPoint(row);
        };
        return [
            h("a", {href: "#viewer", title: pointText(row), click: open}, pointLabel(row)),
            `, ${number(row.value, 3)} ${error(row)}`.trimEnd() + `, in ${number(time.value, 3)} ms ${interval(time, 3)}`
        ];
    };
    const limit = budget.milliseconds;
    const best = timed.find(p => p.time.value <= limit), sure = timed.find(p => p.time.fitsFromMs <= limit);
    const doubtful = timed.filter(
        p => p.time.value > limit && p.time.mayFitFromMs <= limit && !(p.badness > best?.badness));
    if (!best && !doubtful.length) return [`By ${metric}: no timed point fits. `];
    return [
        ...(best ? [`By ${metric} `, ...parts(best)] : [`By ${metric}: no timed point surely fits`]),
        ...(best && best !== sure ? [", which may not fit", ...(sure ? ["; surely fits ", ...parts(sure)] : [])] : []),
        ". ",
        ...(doubtful.length ? ["It is open whether ",
                               ...doubtful.flatMap((p, i) => [i ? "; " : "", ...parts(p)]), " fits. "] : [])
    ];
}
