// The summary table, and the choice of target, metric and mask that it shares with the matrix and the charts.

const choice = {};
const choiceListeners = [];
const longTable = 20;  // rows; longer tables are folded

const better = metric => report.metrics[metric]?.better;
const metricKey = row => `${row.metric}|${row.formula}`;
const totals = new Map(report.times.filter(t => t.stage === "total").map(t => [t.shot + "|" + pointKey(t), t]));
const totalTime = row => totals.get(row.shot + "|" + pointKey(row));
const rowsOfMetric = metric => report.errors.filter(
    r => r.target === choice.target && metricKey(r) === metric && r.mask === choice.mask && mayShow(r));
const chosenRows = () => rowsOfMetric(choice.metric);
const otherRows = () => rowsOfMetric(otherMetric(choice.metric, report.errors));

/// The value if it is present, else the first one.
const preferred = (values, value) => values.includes(value) ? value : values[0];

const showChoice = () => at("choice").append(...choiceBoxes(
    choice, ["target", "metric", "mask"], report.errors, () => choiceListeners.forEach(f => f())));

/// Distance from perfect, so that less is better for every metric; null if its direction is not known.
function badness(metric, value) {
    switch (better(metric)) {
        case "lower":
            return value;
        case "higher":
            return -value;
        case "near_zero":
            return Math.abs(value);
        case "near_one":
            return Math.abs(value - 1);
        default:
            return null;
    }
}

/// The rows that are significantly the best of their shot, as ssrlab decided (evaluation/standings.h).
const bestRows = rows => new Set(rows.filter(r => r.standing === "best"));

/// The row of `none` over the same frames.
const noneLike = (row, rows) => [...rows, ...report.frames].find(
    r => r.shot === row.shot && r.variant === "none" && r.frame === row.frame && r.target === row.target &&
        r.mask === row.mask && metricKey(r) === metricKey(row));

/// value / none with the worst case of both intervals; only where a quotient of errors makes sense.
function againstNone(row, rows) {
    const none = noneLike(row, rows);
    if (!none || none === row || better(row.metric) !== "lower" || row.value === null || !(none.value > 0)) return null;
    const isBounded = row.low !== null && none.low > 0;
    const ends = isBounded ?
        [row.low / (row.low < 0 ? none.low : none.high), row.high / (row.high < 0 ? none.high : none.low)] :
        [null, null];
    return {value: row.value / none.value, low: ends[0], high: ends[1]};
}

/// Worth a column: from 2 % of the error.
const isLitNoisy = row => row.litNoise > 0.02 * Math.abs(row.value);

function valueCell(row, isBest) {
    const notes = [];
    if (row.value === null)
        notes.push("not finite");
    else if (row.corrected && row.low !== null && row.low <= 0 && row.high >= 0)
        notes.push("not distinct from 0");
    else if (!row.corrected && better(row.metric) === "lower" && row.floor > 0 && row.value <= row.floor)
        notes.push("within the floor");
    return cell(
        row.value, h(isBest ? "b" : "span", {class: notes.length ? "below-floor" : null}, number(row.value)), " ",
        h("small", {class: row.low === null ? "reason" : null},
          [interval(row), ...notes].filter(Boolean).join(" ")));
}

function summaryRow(row, rows, best, others, otherBest) {
    const ratio = againstNone(row, rows), time = totalTime(row), other = others.find(o => isSamePoint(o, row));
    return [
        shotName(row.shot), row.variant, cell(row.point, ownLabel(row) ?? row.point, " ", badges(mistakesOfError(row))),
        valueCell(row, best.has(row)), ...(others.length ? [other ? valueCell(other, otherBest.has(other)) : ""] : []),
        cell(row.floor, number(row.floor)),
        ...(rows.some(isLitNoisy) ? [cell(row.litNoise ?? null, number(row.litNoise))] : []),
        cell(
            ratio?.value ?? null, ratio ? number(ratio.value, 3) : "", " ",
            h("small", {}, ratio ? interval({low: ratio.low, high: ratio.high}) : "")),
        cell(
            time?.value ?? null, time ? number(time.value) : "–", " ", h("small", {}, time ? interval(time) : ""),
            ...(time ? badges(mistakesOfTime(row)) : [])),
        cell(
            row.seeds, row.seeds === null ? "–" : String(row.seeds),
            row.deviation === null ? "" : h("small", {}, ` (±${number(row.deviation, 2)})`)),
        cell(row.pixels, String(row.pixels)), madeCell(row)
    ];
}

function showSummary() {
    const chosen = filteredRows(chosenRows()), ladder = ladderRows(choice.metric),
          rows = besideTheirShots(chosen, ladder);
    const others = [...otherRows(), ...ladderRows(otherMetric(choice.metric, report.errors))];
    const best = bestRows(chosen), otherBest = bestRows(otherRows());
    const name = choice.metric.split("|")[0];
    const columns = [
        {name: "Shot"}, {name: "Variant"}, {name: "Point"}, {name: name, number: true},
        ...(others.length ? [{name: others[0].metric, number: true}] : []), {name: "Noise floor", number: true},
        ...(rows.some(isLitNoisy) ? [{name: "Lit noise", number: true}] : []), {name: "× none", number: true},
        {name: "Total ms", number: true}, {name: "Seeds", number: true}, {name: "Pixels", number: true},
        {name: "Made by"}
    ];
    const whole =
        table(columns, rows.map(r => summaryRow(r, rows, best, others, otherBest)), {sortable: true, groupBy: 0});
    const isOpen = at("summary").querySelector("details")?.open ?? chosen.length <= longTable;
    const title = `All ${rows.length} values, with noise floors, times and seeds`;
    at("summary").replaceChildren(h(
        "details", {open: isOpen}, h("summary", {}, title), tableActions(whole, "summary_shown.csv"), scroller(whole)));
    const about = report.metrics[name];
    const direction = {
        lower: "Less is better.",
        higher: "More is better.",
        near_zero: "Nearer to 0 is better.",
        near_one: "Nearer to 1 is better."
    }[about?.better] ??
        "Its direction is not known, so nothing is printed bold.";
    const corrected = rows.some(r => r.corrected) ?
        "The reference's noise is subtracted." :
        "The reference's noise cannot be subtracted from this metric: compare with the noise floor.";
    at("summary-note").textContent = [
        about?.doc && about.doc + ".", direction, corrected,
        others.length &&
            `${others[0].metric} stands beside it: physical and perceptual errors order techniques differently. ` +
                `Noise floor and × none are those of ${name}.`,
        ladder.length &&
            "Truth ladder: the truth with less of its light, see How to read this. Nothing to rank, so never bold.",
        rows.some(isLitNoisy) &&
            "Lit noise: what the noise of the path-traced light that techniques read adds to the " +
                "value; intervals reach down by it.",
        "Brackets: 95 % interval." +
            (rows.some(isOneSeed) ? " One seed of a technique that draws random numbers has none, and is not ranked." :
                                    ""),
        "± after the seeds: their standard deviation."
    ].filter(Boolean).join(" ").replaceAll("..", ".");
}
