// Error and bias by class of roughness: which surfaces a technique gets wrong, and in which direction.

/// [from, below] of a mask `roughness_<from>_<below>`, or null.
function roughnessClass(mask) {
    const parts = /^roughness_([0-9.e+-]+)_([0-9.e+-]+)$/.exec(mask);
    return parts && [Number(parts[1]), Number(parts[2])];
}

function showRoughness() {
    const rows = chartedRows(report.errors).filter(r => r.value !== null && roughnessClass(r.mask));
    if (!rows.length) {
        leaveOut("roughness");
        return;
    }
    const specular = rows.filter(r => r.target === preferred(unique(rows.map(o => o.target)), "specular"));
    const metric = headlineMetric(specular);
    const incident =
        rows.filter(r => r.metric === "bias" && r.target === preferred(unique(rows.map(o => o.target)), "incident"));
    at("roughness")
        .append(
            pointLegend(), ...roughnessCharts(specular.filter(r => metricKey(r) === metric), true, "Error"),
            ...(incident.length ? roughnessCharts(incident, false, "Signed bias: above 0 too bright, below too dark") :
                                  []));
}

function roughnessCharts(rows, isLog, title) {
    const {metric, target} = rows[0];
    const yLabel = `${metric}${unitText(metric)}`;
    const charts = unique(rows.map(r => r.shot))
                       .map(shot => roughnessChart(shot, rows.filter(r => r.shot === shot), isLog, yLabel));
    return [h("h3", {}, `${title}: ${metric} of target ${target}`), h("div", {class: "grid small"}, charts)];
}

function roughnessChart(shot, rows, isLog, yLabel) {
    const masks = unique(rows.map(r => r.mask)).sort((a, b) => roughnessClass(a)[0] - roughnessClass(b)[0]);
    const ticks = masks.map((mask, at) => ({at, text: roughnessClass(mask).map(v => number(v, 3)).join("–")}));
    const lines = unique(rows.map(chartedIndex)).map(series => {
        const own =
            rows.filter(r => chartedIndex(r) === series).sort((a, b) => masks.indexOf(a.mask) - masks.indexOf(b.mask));
        return {
            series,
            points: own.map(row => ({
                                at: masks.indexOf(row.mask),
                                row,
                                tip: `${pointLabel(row)}\nroughness ${ticks[masks.indexOf(row.mask)].text}, ${
                                    row.pixels} pixels\n${row.metric} ${number(row.value)} ${interval(row)}`
                            }))
        };
    });
    const frames = unique(rows.map(framesText)).filter(Boolean).join("; ");
    return lineChart({
        title: frames ? `${shot}: ${frames}` : shot,
        xLabel: "perceptual roughness",
        yLabel,
        ticks,
        lines,
        isLog,
        spread: true
    });
}
