// What stages do, counted (costs.csv): a cost without a clock, beside their times.

/// By name: how charts and controls call a cost, and its value of a row of report.costs, in millions.
const costKinds = {
    fetches: {name: "fetches", axis: "millions of instructions that read images", of: c => c.fetches / 1e6},
    bytes: {name: "bytes", axis: "MB read and written", of: c => (c.bytesRead + c.bytesWritten) / 1e6},
    operations:
        {name: "operations", axis: "millions of scalar operations, as shaders state them", of: c => c.operations / 1e6}
};

const howCounted =
    "Counted by the shaders as they ran, in the shot's last frame with the first seed; of no machine." +
    ` Other seeds of a point that draws random numbers count up to ${report.countSpread} % more or less.`;

const costTotals = new Map(report.costs.filter(c => c.stage === "total").map(c => [c.shot + "|" + pointKey(c), c]));

/// The total of a point as a value of an axis, like totalTime(); undefined where nothing was counted.
function totalCost(row, kind) {
    const total = costTotals.get(row.shot + "|" + pointKey(row));
    return total && {value: costKinds[kind].of(total), low: null, high: null};
}

/// 12 345 678 as 12.3 M: counts have more digits than anyone compares.
function countText(count) {
    const [size, letter] = [[1e9, "G"], [1e6, "M"], [1e3, "k"]].find(([size]) => count >= size) ?? [1, ""];
    return letter ? `${number(count / size, 3)} ${letter}` : String(count);
}

/// Those of a shot that the filter leaves, as rows of bars.
const costRows = (shot, kind) =>
    filteredRows(report.costs.filter(c => c.shot === shot)).map(c => ({...c, value: costKinds[kind].of(c)}));

function costTable(shot) {
    const own = filteredRows(report.costs.filter(c => c.shot === shot));
    if (!own.length) return "";
    const points = unique(own.map(pointLabel));
    const sorted = [...own].sort((a, b) => points.indexOf(pointLabel(a)) - points.indexOf(pointLabel(b)));
    const counted = c => cell(c, countText(c));
    const row = c =>
        [pointLabel(c), c.stage === "total" ? h("b", {}, "total") : c.stage,
         ...[c.invocations, c.idle, c.fetches, c.texels, c.bytesRead, c.bytesWritten, c.uniqueBytes, c.operations].map(
             counted)];
    const names = "Invocations, Idle, Fetches, Texels, Bytes read, Bytes written, Unique bytes, Operations".split(", ");
    return folded(
        "What the stages do, counted",
        h("p", {class: "note"}, howCounted,
          " Idle are invocations that write nothing; unique bytes count what a pass reads or writes of an image or buffer no more than once."),
        table(
            [{name: "Variant"}, {name: "Stage"}, ...names.map(name => ({name, number: true}))], sorted.map(row),
            {groupBy: 0}));
}
