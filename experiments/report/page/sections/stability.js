// What techniques bear: each technique in each case of `ssrlab stability`, and what failed there.

/// From the best to the worst, as verdict_names() of experiments/stability/stability_rows.cpp has them: a shape and a
/// colour, so that either alone tells them apart. Shapes fill a square from -1 to 1.
const verdictMarks = [
    {d: "M-.3 0a.3 .3 0 1 0 .6 0a.3 .3 0 1 0 -.6 0", color: "var(--faint)"},
    {d: "M-.9 -.7H.9L0 .9Z", color: "var(--s0)"}, {d: "M0 -1L1 0L0 1L-1 0Z", color: "var(--s4)"},
    {d: "M-.8 -.8H.8V.8H-.8Z", color: "var(--s3)"},
    {d: "M-1 -.6L-.6 -1L0 -.4L.6 -1L1 -.6L.4 0L1 .6L.6 1L0 .4L-.6 1L-1 .6L-.4 0Z", color: "var(--s1)"},
    {d: "M-1 -.25H1V.25H-1Z", color: "var(--ink)"}
];

const stabilityColumns = [
    ["error", "Error", "squared error over squared truth of the specular radiance"],
    ["benign_error", "Benign error", "the same without what makes the case hard"],
    ["error_ratio", "Error / benign error", ""],
    ["seeds", "Seeds", "of which the errors are means, where one alone might decide the verdict"],
    ["non_finite", "NaN and Inf", "values of all stages and frames"], ["first_non_finite", "First in", "stage: image"],
    ["spread_pixels", "Spread", "pixels of one frame that are not finite though their inputs are"],
    ["spread_frames", "Spread in time", "frames after the fault in which there are any"],
    ["negative", "Negative pixels", "of all frames"],
    ["too_bright", "Too bright pixels", "brighter by 4 % than all light, of all frames"],
    ["excess", "Excess", "the most by which a pixel is brighter"],
    ["bad_confidence", "Confidence outside [0, 1]", "pixels of all frames"],
    ["time_ratio", "Time / benign time", "of the fastest frames; of pictures this small anything below 4 may be noise"],
    ["drift", "Drift", "relative change of the mean over a long rest"], ["drift_noise", "Drift's standard error", ""],
    ["gain", "Gain", "factor from frame to frame of an image that is fed back"], ["refusal", "Refused", ""]
];

const stabilityChoice = {
    technique: 0,
    case: 0,
    amplified: 0
};

function showStability() {
    const data = report.stability;
    if (!data) return leaveOut("stability");
    at("stability-lead").textContent = data.lead;
    at("stability-legend").replaceChildren(...data.verdicts.map((verdict, v) => {
        const count = data.rows.filter(row => row.verdict === v).length;
        return h(
            "span", {title: verdict.meaning},
            svg("svg", {viewBox: "-7 -7 14 14", "aria-hidden": "true"}, verdictMark(v, 0, 0, 5)),
            `${verdict.name} (${count})`);
    }));
    const worst = data.rows.reduce((a, b) => b.verdict > a.verdict && b.verdict < verdictMarks.length - 1 ? b : a);
    chooseCell(worst);
    const isMetric = technique => technique.variant === "metrics";
    const indices = wanted => data.techniques.flatMap((technique, t) => isMetric(technique) === wanted ? [t] : []);
    at("stability-matrix")
        .replaceChildren(...[indices(false), indices(true)].filter(own => own.length).map(stabilityMatrix));
    showStabilityCell();
    at("stability-tables")
        .replaceChildren(...[failureTable(), spreadTable(), amplificationTable()].filter(part => part !== null));
}

function chooseCell({case: place, technique}) { Object.assign(stabilityChoice, {case: place, technique}); }

const techniqueName = t => pointLabel(report.stability.techniques[t]);
const verdictMark = (verdict, x, y, size) => svg("path", {
    class: "verdict",
    d: verdictMarks[verdict].d,
    transform: `translate(${x} ${y}) scale(${size})`,
    fill: verdictMarks[verdict].color
});

/// Techniques as rows, the cases that they were in as columns.
function stabilityMatrix(techniques) {
    const {rows, cases} = report.stability;
    const own = rows.filter(row => techniques.includes(row.technique)), columns = unique(own.map(row => row.case));
    const longest = (names, size) => Math.ceil(Math.max(...names.map(name => name.length)) * size * 0.56) + 10;
    const cellWidth = Math.max(9, Math.min(16, Math.floor(900 / columns.length))), cellHeight = 13;
    const left = longest(techniques.map(techniqueName), 10.5), top = longest(columns.map(c => cases[c].name), 9),
          bottom = longest(columns.map(c => cases[c].group), 10.5);
    const width = columns.length * cellWidth, height = techniques.length * cellHeight;
    const middle = (index, size) => (index + 0.5) * size;
    const isFirst = (list, i, key) => i > 0 && key(list[i]) !== key(list[i - 1]);
    const group = c => cases[c].group, variant = t => report.stability.techniques[t].variant;
    const rowLabels = techniques.map(
        (t, i) => svg(
            "text", {x: -6, y: middle(i, cellHeight) + 3.5, "text-anchor": "end", class: "small"}, techniqueName(t)));
    const columnLabels = columns.map(
        (c, i) =>
            svg("text", {transform: `translate(${middle(i, cellWidth) + 3} -6) rotate(-90)`, class: "smaller"},
                svg("title", {}, `${cases[c].name}: ${cases[c].why}`), cases[c].name));
    const groupLabels = columns.flatMap(
        (c, i) => i === 0 || isFirst(columns, i, group) ?
            [svg(
                "text", {
                    transform: `translate(${i * cellWidth + 9} ${height + 6}) rotate(-90)`,
                    "text-anchor": "end",
                    class: "small"
                },
                group(c))] :
            []);
    const lines = [
        ...columns.flatMap(
            (c, i) =>
                isFirst(columns, i, group) ? [{x1: i * cellWidth, x2: i * cellWidth, y1: -6, y2: height + 6}] : []),
        ...techniques.flatMap(
            (t, i) =>
                isFirst(techniques, i, variant) ? [{x1: -6, x2: width, y1: i * cellHeight, y2: i * cellHeight}] : [])
    ].map(ends => svg("line", {class: "axis", ...ends}));
    const marks = own.map(
        row => verdictMark(
            row.verdict, middle(columns.indexOf(row.case), cellWidth),
            middle(techniques.indexOf(row.technique), cellHeight), 4));
    const chosen = svg("rect", {class: "chosen", width: cellWidth, height: cellHeight, hidden: true});
    const field = svg("rect", {class: "field", width, height});
    const chart =
        svg("svg", {
            class: "matrix",
            viewBox: `${- left} ${- top} ${left + width + 4} ${top + height + bottom}`,
            style: `min-width: ${left + width + 4}px; max-width: ${1.3 * (left + width + 4)}px`,
            role: "img",
            "aria-label": "Verdicts of techniques (rows) in cases (columns). Choose one below for its numbers."
        },
            field, lines, rowLabels, columnLabels, groupLabels, marks, chosen);
    const cellAt = event => {
        const box = field.getBoundingClientRect();
        const column = Math.floor((event.clientX - box.left) / box.width * columns.length),
              row = Math.floor((event.clientY - box.top) / box.height * techniques.length);
        return own.find(cell => cell.case === columns[column] && cell.technique === techniques[row]);
    };
    chart.addEventListener("pointermove", event => {
        const row = cellAt(event);
        tip.hidden = !row;
        if (!row) return;
        tip.textContent =
            `${techniqueName(row.technique)}\n${cases[row.case].name}: ${report.stability.verdicts[row.verdict].name}`;
        tip.style.left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8) + "px";
        tip.style.top = Math.min(event.clientY + 14, innerHeight - tip.offsetHeight - 8) + "px";
    });
    chart.addEventListener("pointerleave", () => {
        tip.hidden = true;
    });
    chart.addEventListener("click", event => {
        const row = cellAt(event);
        if (!row) return;
        chooseCell(row);
        showStabilityCell();
    });
    chart.markChosen = () => {
        const column = columns.indexOf(stabilityChoice.case), row = techniques.indexOf(stabilityChoice.technique);
        chosen.toggleAttribute("hidden", column < 0 || row < 0);
        chosen.setAttribute("x", column * cellWidth), chosen.setAttribute("y", row * cellHeight);
    };
    return chart;
}

/// The chosen technique in the chosen case: its numbers, and its stages of which not all was finite.
function showStabilityCell() {
    const data = report.stability, {technique, case: chosen} = stabilityChoice;
    document.querySelectorAll("svg.matrix").forEach(chart => chart.markChosen());
    const change = key => value => {
        stabilityChoice[key] = Number(value);
        showStabilityCell();
        at("stability-choice").querySelectorAll("select")[key === "case" ? 1 : 0].focus();
    };
    const options = names => names.map((name, i) => [i, name]);
    at("stability-choice")
        .replaceChildren(
            select("Technique", options(data.techniques.map(pointLabel)), technique, change("technique")),
            select("Case", options(data.cases.map(c => c.name)), chosen, change("case")));
    const row = data.rows.find(r => r.case === chosen && r.technique === technique);
    const verdict = row ? data.verdicts[row.verdict] : {name: "not run", meaning: "the case is not for this technique"};
    const values = row ? row.values : {};
    const shown = stabilityColumns.filter(([column]) => column in values && (column !== "seeds" || values.seeds > 1));
    const stages = data.stages.filter(s => s.case === chosen && s.technique === technique);
    at("stability-cell")
        .replaceChildren(
            h("p", {}, h("b", {}, `${techniqueName(technique)}, ${data.cases[chosen].name}: ${verdict.name}`),
              ` – ${verdict.meaning}.`),
            h("p", {class: "note"}, `The case: ${data.cases[chosen].why}`),
            shown.length ?
                table(
                    [{name: "Quantity"}, {name: "Value", number: true}, {name: "Meaning"}],
                    shown.map(([column, name,
                                meaning]) => [name, cell(values[column], stabilityNumber(values[column])), meaning])) :
                "",
            stages.length ?
                table(
                    [{name: "Stage: image"}, {name: "NaN", number: true}, {name: "Inf", number: true}],
                    stages.map(s => [s.image, s.nan, s.infinite].map(String)), {caption: "Values of all frames"}) :
                "");
}

const stabilityNumber = value => typeof value === "number" ? number(value) : value;

function failureTable() {
    const {failures} = report.stability;
    if (!failures.length) return null;
    const isTold = f => f.first || f.explanations.length;
    const names = (some, ...before) =>
        h("details", {}, h("summary", {}, ...before, String(some.length)), some.join(", "));
    const line = f =>
        [names(f.points, `${f.variant}, presets: `), f.place, names(f.cases), `${f.nan}, ${f.infinite}`,
         f.first ? String(f.first) : "passed on",
         [...f.explanations.map(e => e.operation), ...(f.unexplained ? [`unexplained in ${f.unexplained}`] : [])].join(
             "; or "),
         f.explanations.map(e => e.mend).join("; ")];
    const columns = [
        {name: "Technique"}, {name: "Stage: image"}, {name: "Cases"}, {name: "NaN, Inf", number: true},
        {name: "Arises there", number: true}, {name: "Operation"}, {name: "Mend"}
    ];
    return part(
        "Stages that are not finite",
        "Values of all frames. They arise where no stage before fails, in so many runs; other stages were passed them.",
        table(columns, failures.filter(isTold).map(line)),
        failures.some(f => !isTold(f)) ?
            h("details", {}, h("summary", {}, "Stages that were only passed such values"),
              table(columns.slice(0, 4), failures.filter(f => !isTold(f)).map(f => line(f).slice(0, 4)))) :
            "");
}

/// Of cases in which something spreads, and techniques in which it does.
function spreadTable() {
    const {rows, cases} = report.stability, own = rows.filter(row => row.values.spread_pixels);
    if (!own.length) return null;
    const columns = unique(own.map(row => row.case)).sort((a, b) => a - b);
    const text = row =>
        row ? `${row.values.spread_pixels}${row.values.spread_frames ? ` +${row.values.spread_frames}` : ""}` : "·";
    const lines = unique(own.map(row => row.technique))
                      .sort((a, b) => a - b)
                      .map(
                          t =>
                              [techniqueName(t),
                               ...columns.map(c => text(own.find(row => row.case === c && row.technique === t)))]);
    return part(
        "Spread of bad inputs",
        "The most pixels of a frame that are not finite though their inputs are; behind a +, frames after the fault in " +
            "which there are any. Cases and techniques in which there are none are left out.",
        table([{name: "Technique"}, ...columns.map(c => ({name: cases[c].name, number: true}))], lines));
}

function amplificationTable() {
    const {rows, cases} = report.stability, inputs = ["depth", "normal", "lit"];
    const own = rows.filter(row => inputs.some(input => `${input}_p999` in row.values));
    if (!own.length) return null;
    const choices = unique(own.map(row => row.case)).map(c => [c, cases[c].name]);
    stabilityChoice.amplified = choices[0][0];
    const body = scroller();
    const value = (row, column) => cell(row.values[column] ?? 0, number(row.values[column] ?? 0, 3));
    const show = () => body.replaceChildren(table(
        [
            {name: "Technique"},
            ...inputs.flatMap(i => [{name: `${i}, median`, number: true}, {name: "99.9 %", number: true}])
        ],
        own.filter(row => row.case === stabilityChoice.amplified)
            .map(
                row =>
                    [techniqueName(row.technique),
                     ...inputs.flatMap(i => [value(row, `${i}_median`), value(row, `${i}_p999`)])]),
        {sortable: true}));
    show();
    return part(
        "Amplification",
        "Relative change of a pixel's result over that of its input, one step of which is changed: a code of the depth " +
            "format, 2⁻¹⁵ of the normal, 2⁻¹¹ of the lit colour. The median pixel, and that above 99.9 %.",
        h("div", {class: "controls"}, select("Case", choices, stabilityChoice.amplified, c => {
              stabilityChoice.amplified = Number(c);
              show();
          })), body);
}

const part = (title, note, ...content) =>
    h("div", {}, h("h3", {}, title), h("p", {class: "note"}, note),
      ...content.map(c => c instanceof HTMLTableElement ? scroller(c) : c));
