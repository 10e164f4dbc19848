// Where a technique's error lies: shares of the squared error by what became of the pixel's ray.

const untraced = {
    key: "untraced",
    name: "no ray was traced",
    color: "#d5c7a3",
    short: "untraced"
};
const sharedOut = [...verdicts, untraced];
const errorRows = shot =>
    report.hits.filter(r => r.stage === errorStage && r.shot === shot && r.quantity.startsWith("error: "));

/// [{row, error, by, limit}] of the points of a shot: shares by verdict, and the error that they are shares of.
function errorShares(shot) {
    const groups = new Map(), {metric, target} = sharedError;
    for (const r of filteredRows(errorRows(shot))) {
        if (r.mask !== preferred(unique(errorRows(shot).map(o => o.mask)), headline.mask)) continue;
        if (!groups.has(pointKey(r))) groups.set(pointKey(r), {row: r, by: new Map()});
        groups.get(pointKey(r)).by.set(r.quantity.slice("error: ".length), r);
    }
    return [...groups.values()].map(g => ({
                                        ...g,
                                        error: report.errors.find(
                                            e => isSamePoint(e, g.row) && e.metric === metric && e.target === target &&
                                                e.mask === g.row.mask && e.value > 0)
                                    }));
}

const sharedError = {
    metric: "mse",
    target: "specular"
};  // what hits.csv shares out

const shareOf = (by, ...keys) => keys.reduce((sum, key) => sum + (by.get(key)?.value ?? 0), 0);

function shareText({row, by}) {
    const parts = [
        `${percent(shareOf(by, "unavoidable_miss", "empty"))} lies where the truth is not on the screen`,
        `${percent(shareOf(by, "wrong_place", "false_hit", "avoidable_miss"))} where the march erred`,
        `${percent(shareOf(by, "right"))} where the ray was right (filter, fallback, view dependence)`,
        ...(by.has("untraced") ? [`${percent(shareOf(by, "untraced"))} where no ray was traced`] : [])
    ];
    return `Of ${pointLabel(row)}'s error ${parts.join(", ")}.`;
}

function showErrorShares() {
    const shots = unique(report.hits.filter(r => r.stage === errorStage).map(r => r.shot));
    if (!shots.length) return leaveOut("error-shares");
    at("error-shares").append(verdictLegend(sharedOut), ...shotParts(shots, errorSharesPart));
}

function errorSharesPart(shot) {
    const groups = errorShares(shot), {metric, target} = sharedError;
    if (!groups.length) return [];
    const isAbsolute = groups.every(g => g.error);
    const rows = groups.map(g => ({
                                label: pointLabel(g.row),
                                total: isAbsolute && g.error.low !== null ? g.error : null,
                                parts: sharedOut.filter(v => g.by.has(v.key)).map(v => {
                                    const r = g.by.get(v.key);
                                    return {
                                        // Noise may leave a share below 0, which a bar cannot show.
                                        value: Math.max(r.value, 0) * (isAbsolute ? g.error.value : 1),
                                        fill: v.color,
                                        text: v.short,
                                        data: {verdict: v.key, share: r.value},
                                        tip: `${pointLabel(g.row)}\n${v.name}: ${percent(r.value)} of its error${
                                            percentInterval(r)}${g.error ? `\n${rowText(g.error)}` : ""}`
                                    };
                                })
                            }));
    const key = groups[0].error && metricKey(groups[0].error), {mask} = groups[0].row;
    const limit = isAbsolute ?
        ladderOf(shot, {target, metricKey: key, mask}).find(r => r.rung === "on_screen" && r.value > 0) :
        null;
    const xLabel = isAbsolute ? `${metric}${unitText(metric)} of ${target}, ${mask}` :
                                `share of the ${metric} of ${target}, ${mask}`;
    const named = [answerOf(shot)?.best, answerOf(shot)?.baseline].filter(Boolean).map(pointKey);
    const [foremost, others] = [true, false].map(is => groups.filter(g => named.includes(pointKey(g.row)) === is));
    const sentences = some => h("ul", {class: "sentences"}, some.map(g => h("li", {}, shareText(g))));
    return [
        foremost.length ? sentences(foremost) : "", stackedBars({
            title: `Where the error lies, ${shot}`,
            rows,
            xLabel,
            isShare: !isAbsolute,
            limits: limit ? [{x: limit.value, rows: rows.map(r => r.label)}] : []
        }),
        limit ? h("p", {class: "note"},
                  `Dotted: the information limit of one frame, ${`${metric} ${number(limit.value)} ${interval(limit)}`.trim()}.`) :
                "",
        others.length ? h("details", {open: others.length <= 20}, h("summary", {}, "In sentences"), sentences(others)) :
                        ""
    ];
}
