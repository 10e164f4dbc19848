// Which points tables and charts compare, and the colour and mark that each keeps throughout the page.

const pointKey = row => row.variant + "|" + row.point;
const singleChangeKeys = new Set(report.singleChanges.map(pointKey));
const isSingleChange = row => singleChangeKeys.has(pointKey(row));

const comparedPoints = unique(report.errors.filter(r => !isSingleChange(r)).map(pointLabel));
const mostSeries = 8;  // as many colours as can be told apart
const charted = comparedPoints.slice(0, mostSeries);
const chartedIndex = row => isSingleChange(row) ? -1 : charted.indexOf(pointLabel(row));

/// Rows of the charted points, single changes left out.
const chartedRows = rows => rows.filter(r => chartedIndex(r) >= 0);

/// Marks and names; where there are more points than colours, that too.
function pointLegend() {
    const hidden = comparedPoints.length - charted.length;
    return h(
        "div", {class: "legend"}, charted.map((name, i) => legendEntry(i, name)),
        hidden ? h("span", {class: "note"},
                   `The first ${charted.length} of ${comparedPoints.length} points; all are in summary.csv.`) :
                 null);
}

const headlineMetric = rows =>
    preferred(unique(rows.map(metricKey)), unique(rows.map(metricKey)).find(m => m.startsWith("relmse|")));
/// The metric that is read beside it: relative errors weigh dark places, absolute ones bright places, and either can
/// hide how large a gain is. Undefined if `rows` have none.
const otherMetric = (key, rows) => {
    const other = {relmse: "mse", mse: "relmse"}[key.split("|")[0]];
    return unique(rows.map(metricKey)).find(k => other && k.startsWith(other + "|"));
};
const metricName = key => {
    const [metric, formula] = key.split("|");
    return metric === formula || !formula ? metric : `${metric} (${formula})`;
};
/// Which frames a row of errors speaks for; empty for a shot of one frame.
function framesText(row) {
    const frames = list(manifestShots().find(s => s.shot === row.shot)?.frames);
    if (frames.length < 2) return "";
    return row.frame === "all" ? "mean over frames" : `frame ${row.frame} alone`;
}
const unitText = metric => {
    const unit = report.metrics[metric]?.unit;
    return unit && unit !== "1" ? ` (${unit.replace("^2", "²")})` : "";
};

/// Takes a section that a study has nothing for off the page, and the link to it.
function leaveOut(id) {
    at(id).remove();
    document.querySelector(`nav a[href="#${id}"]`)?.remove();
}
