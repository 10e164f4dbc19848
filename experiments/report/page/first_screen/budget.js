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
            h("label", {}, "Reflections may take ",
              h("input", {type: "number", id: "budget", min: 0, step: "any", placeholder: "any", input: changed}),
              " ms a frame"),
            h("p", {id: "budget-answer", "aria-live": "polite"}));
}

/// Below the charts' marks: where the budget ends.
const budgetLine = x => budget.milliseconds > x.domain[0] && budget.milliseconds < x.domain[1] ?
    [Plot.ruleX([budget.milliseconds], {stroke: "var(--accent)", strokeWidth: 1.5})] :
    [];

function drawBudget(shot) {
    if (!at("budget-answer")) return;
    const parts = budget.milliseconds === null ? [] : headlineMetrics().map(metric => budgetText(shot, metric));
    if (parts.length && !answerOf(shot)?.is_clock_proven) parts.push("The clock did not prove itself: take the times with care.");
    at("budget-answer").textContent = parts.join(" ");
}

/// "By mse A, 0.05 [0.04, 0.06], in 9 ms [8, 11]": the least error of the points whose median is within the budget; and
/// those of less error whose interval holds the budget, so that it cannot be told whether they fit.
function budgetText(shot, metric) {
    const timed = headlineRows(shot, metric)
                      .map(row => ({row, time: totalTime(row), badness: badness(metric, row.value)}))
                      .filter(p => p.time && p.badness !== null && !isOneSeed(p.row))
                      .sort((a, b) => a.badness - b.badness);
    const error = row => row.low === null ? interval(row) && `(${interval(row)})` : interval(row, 3);
    const text = ({row, time}) => `${pointLabel(row)}, ${number(row.value, 3)} ${error(row)}`.trim() +
        `, in ${number(time.value, 3)} ms ${interval(time, 3)}`;
    const best = timed.find(p => p.time.value <= budget.milliseconds);
    const doubtful = timed.filter(
        p => p.time.value > budget.milliseconds && p.time.low <= budget.milliseconds && !(p.badness > best?.badness));
    const none = `By ${metric}: nothing that was timed fits.`;
    return (best ? `By ${metric} ${text(best)}.` : none) +
        (doubtful.length ? ` It cannot be told whether ${doubtful.map(text).join("; ")} fits.` : "");
}
