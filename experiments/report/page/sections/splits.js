// Bias and variance: what of an error all seeds share, and what differs from seed to seed.

const splitChoice = {};

function showSplits() {
    if (!report.splits.some(mayShow)) return leaveOut("splits");
    at("splits").append(
        h("div", {class: "controls"}, choiceBoxes(splitChoice, ["target", "mask"], report.splits, drawSplits)),
        legend([{label: "bias²", style: splitStyles[0]}, {label: "variance", style: splitStyles[1], isHollow: true}]),
        scroller(h("div", {class: "strips", id: "split-table"})));
    pointListeners.push(drawSplits);
    drawSplits();
}

const splitStyles = [seriesStyle(0), seriesStyle(1)];

function drawSplits() {
    const rows =
        filteredRows(report.splits.filter(s => s.target === splitChoice.target && s.mask === splitChoice.mask));
    const ends = part => [part.value, part.low ?? part.value, part.high ?? part.value];
    const scale = stripScale(rows.flatMap(s => [...ends(s.biasSquared), ...ends(s.variance)]), true);
    const columns = [
        {name: "Shot"}, {name: "Point"}, {name: "Bias² and variance"}, {name: "MSE", number: true},
        {name: "Bias²", number: true}, {name: "Variance", number: true}, {name: "Seeds", number: true}
    ];
    const lines = rows.map(s => {
        const tip = (name, part) => `${pointLabel(s)}\n${name} ${number(part.value)} ${interval(part)}`;
        const marks = [
            {style: splitStyles[0], row: s.biasSquared, tip: tip("bias²", s.biasSquared), lane: 0},
            {style: splitStyles[1], row: s.variance, isHollow: true, tip: tip("variance", s.variance), lane: 1}
        ];
        return [
            shotName(s.shot), pointLabel(s), strip(scale, marks), cell(s.mse, number(s.mse, 3)),
            partCell(s.biasSquared, isAboutZero(s.biasSquared)), partCell(s.variance, false),
            cell(s.seeds, String(s.seeds))
        ];
    });
    lines.push(["", "", stripAxis(scale, "radiance², logarithmic"), "", "", "", ""]);
    at("split-table").replaceChildren(table(columns, lines, {groupBy: 0}));
}

/// A squared bias that is not distinguishable from 0.
const isAboutZero = part => part.value <= 0 || (part.low !== null && part.low <= 0);

const partCell = (part, hasNote) =>
    cell(part.value, number(part.value, 3), " ", h("small", {}, interval(part, 3), hasNote ? " about 0" : ""));
