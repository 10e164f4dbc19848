// All points in all shots at a glance: a matrix per metric, coloured by the error relative to that of none.

const fullColour = 8;  // a ratio of that size, or its inverse, has the full colour

/// What the cells of one shot are relative to: its row of none, else its least error.
function columnReference(rows) {
    const none = rows.find(r => r.variant === "none");
    if (none?.value > 0) return none;
    return rows.filter(r => r.value > 0).reduce((least, r) => !least || r.value < least.value ? r : least, null);
}

/// Blue below 1, orange above, the stronger the farther; readable text on either.
function ratioColour(ratio) {
    const size = Math.min(Math.abs(Math.log(Math.max(ratio, 1e-9))) / Math.log(fullColour), 1);
    return `color-mix(in oklab, var(${ratio < 1 ? "--less" : "--more"}) ${(100 * size).toFixed(0)}%, var(--card))`;
}

/// `rows`: of one metric, filtered; `order`: the points, as the reader sorted them.
function matrix(rows, order) {
    const {metric} = rows[0], isRatio = better(metric) === "lower", shots = unique(rows.map(r => r.shot));
    const byCell = new Map(rows.map(r => [r.shot + "|" + pointKey(r), r]));
    const best = clearlyBestRows(rows);
    const columns = shots.map(shot => {
        const all = rowsOfMetric(metricKey(rows[0])).filter(r => r.shot === shot && r.value !== null);
        return {shot, reference: isRatio ? columnReference(all) : null};
    });
    const named = unique(columns.map(c => c.reference?.variant).filter(Boolean));
    const relative = !isRatio ? "no colours: less is not better" :
        named.length === 1 && named[0] === "none" ? "÷ that of none in the same column" :
                                                    "÷ the least of the same column";
    const head = h("tr", {}, h("th", {scope: "col"}, "Point"), columns.map(({shot}) => {
        const mistakes = mistakesOfReference(manifestShots().find(s => s.shot === shot)?.reference);
        return h("th", {scope: "col", title: shot}, shortShot(shot), " ", badges(mistakes));
    }));
    const buttons = [];
    const lines = order.flatMap((point, i) => {
        const cells = columns.map(({shot, reference}) => {
            const row = byCell.get(shot + "|" + pointKey(point));
            if (!row) return h("td", {}, "–");
            const button = matrixButton(row, reference, best.has(row));
            buttons.push(button);
            const ratio = reference && row.value > 0 ? row.value / reference.value : null;
            return h("td", {style: ratio ? `background:${ratioColour(ratio)}` : null}, button);
        });
        const isFirst = shownPoints.isGrouped && (i === 0 || order[i - 1].variant !== point.variant);
        const label = shownPoints.colourBy === "point" ? `${pointNumber(point)} ${pointLabel(point)}` : pointLabel(point);
        return [
            isFirst ? h("tr", {class: "variant"}, h("th", {scope: "rowgroup", colspan: columns.length + 1}, point.variant)) : null,
            h("tr", {}, h("th", {scope: "row", title: pointText(point)}, icon(styleOf(point)), label), cells)
        ].filter(Boolean);
    });
    const caption = `${metric}${unitText(metric)} of ${choice.target}, ${choice.mask} pixels${isRatio ? `: error ${relative}` : ""}`;
    const element = h("table", {class: "matrix"}, h("caption", {}, caption), h("thead", {}, head), h("tbody", {}, lines));
    rove(element, buttons);
    return h("div", {class: "scroll"}, element);
}

function matrixButton(row, reference, isBest) {
    const ratio = reference && row.value !== null ? row.value / reference.value : null;
    const text = row.value === null ? "–" : ratio === null ? number(row.value, 3) : number(ratio, 2);
    const mistakes = mistakesOfError(row);
    const button = h("button", {"data-value": row.value, class: isBest ? "best" : null}, text, mistakes.length ? " !" : "");
    withTip(button, [
        `${row.shot}\n${pointText(row)}`, rowText(row), ratio === null || reference === row ? null : `× ${number(ratio, 3)} of ${pointLabel(reference)}`,
        isBest ? "best of its shot, no other interval touches its own" : null, ...mistakes.map(m => `! ${m.text}: ${m.why}`), madeText(row)
    ].filter(Boolean).join("\n"));
    clickable(button, () => openPoint(row));
    button.removeAttribute("role");  // it is one
    return button;
}

const sortKeys = {
    study: "order of the study",
    name: "name",
    error: "mean error",
    time: "mean time"
};

/// Mean of the logarithms over the shots, so that no shot outweighs others; missing ones come last.
function meanLog(values) {
    const known = values.filter(v => v > 0);
    return known.length ? known.reduce((sum, v) => sum + Math.log(v), 0) / known.length : Infinity;
}

/// The points of `rows` as the reader sorts and groups them.
function sortedPoints(rows) {
    const points = new Map();
    for (const r of rows) {
        if (!points.has(pointKey(r))) points.set(pointKey(r), []);
        points.get(pointKey(r)).push(r);
    }
    const keys = {
        study: own => places.get(pointKey(own[0])),
        name: own => pointLabel(own[0]),
        error: own => meanLog(own.map(r => badness(r.metric, r.value))),
        time: own => meanLog(own.map(r => totalTime(r)?.value))
    };
    const by = keys[shownPoints.sort];
    const ordered = [...points.values()].map(own => ({key: by(own), point: own[0]})).sort((a, b) => compareCells(a.key, b.key, true));
    const result = ordered.map(o => o.point);
    if (!shownPoints.isGrouped) return result;
    const first = new Map(result.map(p => p.variant).reverse().map((v, i) => [v, -i]));
    return result.map((p, i) => [p, i]).sort(([a, i], [b, j]) => first.get(a.variant) - first.get(b.variant) || i - j).map(([p]) => p);
}
