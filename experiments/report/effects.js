// What each change of a baseline does to an error: ratios over paired seeds, for all shots at once or one in detail.

const effectChoice = {
    against: null,
    target: null,
    metric: null,
    mask: null,
    shot: "all shots",
    scale: "all"
};
const significant = 0.05;  // of p after Holm's correction
const scales = {
    all: "all ratios",
    "1.5": "2/3 to 1.5",
    "1.1": "0.91 to 1.1",
    "1.01": "0.99 to 1.01"
};

const effectsShown = () => report.effects.filter(e => e.variant === e.againstVariant);
const effectShots = () => unique([
                              ...manifestShots().map(s => s.shot), ...effectsShown().map(e => e.shot)
                          ]).filter(shot => effectsShown().some(e => e.shot === shot));
const againstLabel = e => pointLabel({variant: e.againstVariant, point: e.againstPoint});

function showEffects() {
    const rows = effectsShown();
    if (!rows.length) {
        leaveOut("effects");
        return;
    }
    const options = {
        against: unique(rows.map(againstLabel)),
        target: unique(rows.map(e => e.target)),
        metric: unique(rows.map(metricKey)),
        mask: unique(rows.map(e => e.mask)),
        shot: ["all shots", ...effectShots()],
        scale: Object.keys(scales)
    };
    Object.assign(effectChoice, {
        against: options.against[0],
        target: preferred(options.target, "specular"),
        metric: headlineMetric(rows),
        mask: preferred(options.mask, "reflective")
    });
    const box = (label, key, show = o => o) => options[key].length < 2 ?
        null :
        select(label, options[key].map(o => [o, show(o)]), effectChoice[key], value => {
            effectChoice[key] = value;
            drawEffects();
        });
    at("effects").append(
        h("div", {class: "controls"}, box("Against", "against"), box("Shot", "shot"), box("Target", "target"),
          box("Metric", "metric", metricName), box("Mask", "mask"), box("Scale", "scale", o => scales[o])),
        h("div", {id: "effect-legend"}), h("div", {class: "scroll strips", id: "effect-table"}));
    drawEffects();
}

/// [{label, doc, rows}] in the order of the study: single changes first, then whole points.
function effectGroups(rows) {
    const of = key => rows.filter(e => pointKey(e) === key);
    const docs = report.manifest.parameter_docs ?? {};
    const singles = report.singleChanges.map(c => ({
                                                 label: `${c.parameter} = ${JSON.stringify(c.value)}`,
                                                 doc: docs[c.variant]?.[c.parameter] ?? "",
                                                 rows: of(pointKey(c))
                                             }));
    const wholes =
        unique(rows.filter(e => !isSingleChange(e)).map(pointKey))
            .map(key => ({label: pointLabel(of(key)[0]), doc: "all that it changes, together", rows: of(key)}));
    return [...singles, ...wholes].filter(g => g.rows.length);
}

function drawEffects() {
    const isAll = effectChoice.shot === "all shots", shots = effectShots();
    const rows = effectsShown().filter(
        e => againstLabel(e) === effectChoice.against && e.target === effectChoice.target &&
            metricKey(e) === effectChoice.metric && e.mask === effectChoice.mask &&
            (isAll || e.shot === effectChoice.shot));
    const scale = effectScale(rows, !isAll);
    const legend = h("div", {class: "legend"}, shots.map((s, i) => legendEntry(i, s)));
    at("effect-legend").replaceChildren(isAll ? legend : "");
    const cells = isAll ? pooledCells : group => effectCells(group[0]);
    const lines = effectGroups(rows).map(
        g =>
            [h("div", {class: "change"}, h("b", {}, g.label), g.doc ? h("small", {}, g.doc) : null),
             strip(scale, g.rows.filter(e => e.value !== null).map(e => effectMark(e, shots, isAll))),
             ...cells(g.rows)]);
    const label = `${metricName(effectChoice.metric)}: change / ${effectChoice.against}, logarithmic`;
    lines.push(["", stripAxis(scale, label), "", "", "", ""]);
    at("effect-table").replaceChildren(table(isAll ? pooledColumns : effectColumns, lines));
}

const pooledColumns = [
    {name: "Change"}, {name: "Ratio, one mark per shot"}, {name: "Mean ratio", number: true},
    {name: "Helps", number: true}, {name: "Harms", number: true}, {name: "Shots", number: true}
];
const effectColumns = [
    {name: "Change"}, {name: "Ratio"}, {name: "Ratio [95 %]", number: true}, {name: "p (Holm)", number: true},
    {name: "Seeds", number: true}, {name: "Result"}
];

/// All ratios fit unless a narrower scale is asked for; an interval of few seeds may reach far beyond them and is cut.
function effectScale(rows, hasIntervals) {
    const limit = Number(effectChoice.scale);
    if (limit) return stripScale([1 / limit, limit], true, 1, 0.04 * Math.log10(limit));
    const ratios = [1, ...rows.map(e => e.value).filter(v => v > 0)];
    const low = Math.min(...ratios) / 2, high = Math.max(...ratios) * 2;
    const ends =
        hasIntervals ? rows.flatMap(e => e.low === null ? [] : [Math.max(e.low, low), Math.min(e.high, high)]) : [];
    return stripScale([...ratios, ...ends], true, 1, 0.02);
}

const isSignificant = e => e.holm !== null && e.holm < significant;

function effectMark(e, shots, isAll) {
    return {
        series: isAll ? shots.indexOf(e.shot) : 0,
        row: isAll ? {value: e.value} : e,
        isHollow: !isSignificant(e),
        tip: `${e.shot}\n${e.point}\n${e.metric} × ${number(e.value)} ${interval(e)}\np (Holm) ${number(e.holm, 2)}, ${
            e.seeds} seeds`
    };
}

/// The geometric mean over the shots, and how many shots the change helps or harms beyond chance.
function pooledCells(rows) {
    const told = rows.filter(e => e.value > 0), count = f => rows.filter(f).length;
    const mean = told.length ? Math.exp(told.reduce((sum, e) => sum + Math.log(e.value), 0) / told.length) : null;
    const helps = count(e => isSignificant(e) && e.value < 1), harms = count(e => isSignificant(e) && e.value > 1);
    return [
        cell(mean, number(mean)), cell(helps, helps ? h("b", {}, String(helps)) : "0"),
        cell(harms, harms ? h("b", {}, String(harms)) : "0"), cell(told.length, String(told.length))
    ];
}

function effectCells(e) {
    const result = e.value === null                              ? "an error is not above 0" :
        e.low === e.value && e.high === e.value && e.value === 1 ? "changes nothing" :
        !isSignificant(e)                                        ? "not told from chance" :
        e.value < 1                                              ? `${number(100 * (1 - e.value), 2)} % less error` :
                                                                   `${number(100 * (e.value - 1), 2)} % more error`;
    return [
        cell(e.value, number(e.value), " ", h("small", {}, interval(e))), cell(e.holm, number(e.holm, 2)),
        cell(e.seeds, String(e.seeds)), isSignificant(e) ? h("b", {}, result) : result
    ];
}
