// Stability under extreme inputs: each technique in each case of `ssrlab stability`, and what failed there.

import {at, choiceBox, h, scroller, select, svg} from "../elements/elements.js";
import {cell, numbers, table} from "../elements/tables.js";
import {leaveOut} from "./parts.js";
import {pointKey, pointLabel, report} from "../study/data.js";
import {list, number, unique} from "../values.js";

/// From the best to the worst, as verdict_names() of experiments/results/stability/stability_rows.cpp has them: a shape and a
/// colour, so that either alone distinguishes them. Shapes fill a square from -1 to 1.
const verdictMarks = [
    {d: "M-.3 0a.3 .3 0 1 0 .6 0a.3 .3 0 1 0 -.6 0", color: "var(--faint)"},
    {d: "M-.9 -.7H.9L0 .9Z", color: "var(--s0)"}, {d: "M0 -1L1 0L0 1L-1 0Z", color: "var(--s4)"},
    {d: "M-.8 -.8H.8V.8H-.8Z", color: "var(--s3)"},
    {d: "M-1 -.6L-.6 -1L0 -.4L.6 -1L1 -.6L.4 0L1 .6L.6 1L0 .4L-.6 1L-1 .6L-.4 0Z", color: "var(--s1)"},
    {d: "M-1 -.25H1V.25H-1Z", color: "var(--ink)"}
];

const stabilityColumns = [
    ["error", "Error", "squared error over squared truth of the specular radiance"],
    ["benignError", "Benign error", "the error without what makes the case hard"],
    ["errorRatio", "Error / benign error", ""],
    ["seeds", "Seeds", "errors are means over so many seeds, where one seed alone might decide the verdict"],
    ["nonFinite", "NaN and Inf", "values of all stages and frames"], ["firstNonFinite", "First in", "stage: image"],
    ["spreadPixels", "Spread", "pixels of one frame that are not finite though their inputs are"],
    ["spreadFrames", "Spread in time", "frames after the fault that have such pixels"],
    ["negative", "Negative pixels", "pixels of all frames"],
    ["tooBright", "Too bright pixels", "pixels of all frames that are brighter than all light by more than 4 %"],
    ["excess", "Excess", "the most by which a pixel is brighter"],
    ["badConfidence", "Confidence outside [0, 1]", "pixels of all frames"],
    ["timeRatio", "Time / benign time", "ratio of the fastest frames; for pictures this small, a ratio below 4 may be noise"],
    ["drift", "Drift", "relative change of the mean over a long rest"], ["driftNoise", "Drift's standard error", ""],
    ["gain", "Gain", "factor from frame to frame of an image that is fed back"], ["refusal", "Refused", ""]
];

/// By name: pointKey() of the technique, names of cases.
const stabilityChoice = {technique: "", case: "", amplified: ""};
const techniqueNames = new Map(list(report.stability?.rows).map(row => [pointKey(row), pointLabel(row)]));
const stabilityCases = new Map(list(report.stability?.cases).map(c => [c.case, c]));

export function showStability() {
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
    const isMetric = row => row.technique === "metrics";
    at("stability-matrix").replaceChildren(...[data.rows.filter(row => !isMetric(row)), data.rows.filter(isMetric)]
                             .filter(own => own.length)
                             .map(stabilityMatrix));
    // At first the worst that was rendered.
    showStabilityCell(
        data.rows.reduce((a, b) => b.verdict > a.verdict && b.verdict < verdictMarks.length - 1 ? b : a));
    at("stability-tables").replaceChildren(...[failureTable(), spreadTable(), amplificationTable()].filter(part => part !== null));
}

const verdictMark = (verdict, x, y, size) => svg("path", {
    class: "verdict",
    d: verdictMarks[verdict].d,
    transform: `translate(${x} ${y}) scale(${size})`,
    fill: verdictMarks[verdict].color
});

/// Of the rows `own` of stability.csv: techniques as rows, the cases that they were in as columns.
function stabilityMatrix(own) {
    const techniques = unique(own.map(pointKey)), columns = unique(own.map(row => row.case));
    const group = c => stabilityCases.get(c).group, technique = t => t.split("|")[0];
    const longest = (names, size) => Math.ceil(Math.max(...names.map(name => name.length)) * size * 0.56) + 10;
    const cellWidth = Math.max(9, Math.min(16, Math.floor(900 / columns.length))), cellHeight = 13;
    const left = longest(techniques.map(t => techniqueNames.get(t)), 10.5), top = longest(columns, 9),
          bottom = longest(columns.map(group), 10.5);
    const width = columns.length * cellWidth, height = techniques.length * cellHeight;
    const middle = (index, size) => (index + 0.5) * size;
    const isFirst = (list, i, key) => i > 0 && key(list[i]) !== key(list[i - 1]);
    const places = (list, key) => list.map((_, i) => i).filter(i => isFirst(list, i, key));
    const upright = (x, y) => `translate(${x} ${y}) rotate(-90)`, atEnd = {"text-anchor": "end", class: "small"};
    const rowLabels = techniques.map(
        (t, i) => svg("text", {x: -6, y: middle(i, cellHeight) + 3.5, ...atEnd}, techniqueNames.get(t)));
    const columnLabels = columns.map((c, i) => svg(
        "text", {transform: upright(middle(i, cellWidth) + 3, -6), class: "smaller"},
        svg("title", {}, `${c}: ${stabilityCases.get(c).why}`), c));
    const groupLabels = [0, ...places(columns, group)].map(
        i => svg("text", {transform: upright(i * cellWidth + 9, height + 6), ...atEnd}, group(columns[i])));
    const lines = [
        ...places(columns, group).map(i => ({x1: i * cellWidth, x2: i * cellWidth, y1: -6, y2: height + 6})),
        ...places(techniques, technique).map(i => ({x1: -6, x2: width, y1: i * cellHeight, y2: i * cellHeight}))
    ].map(ends => svg("line", {class: "axis", ...ends}));
    const marks = own.map(row => {
        const [x, y] = [columns.indexOf(row.case) * cellWidth, techniques.indexOf(pointKey(row)) * cellHeight];
        const mark =
            svg("g", {transform: `translate(${x} ${y})`, class: "cell", click: () => showStabilityCell(row)},
                svg("title", {}, `${pointLabel(row)}\n${row.case}: ${report.stability.verdicts[row.verdict].name}`),
                svg("rect", {width: cellWidth, height: cellHeight}),
                verdictMark(row.verdict, cellWidth / 2, cellHeight / 2, 4));
        mark.isOf = ({technique, case: name}) => row.case === name && pointKey(row) === technique;
        return mark;
    });
    const field = svg("rect", {class: "field", width, height});
    return svg(
        "svg", {
            class: "matrix",
            viewBox: `${- left} ${- top} ${left + width + 4} ${top + height + bottom}`,
            style: `min-width: ${left + width + 4}px; max-width: ${1.3 * (left + width + 4)}px`,
            role: "img",
            "aria-label": "Verdicts of techniques (rows) in cases (columns). Choose one below for its numbers."
        },
        field, lines, rowLabels, columnLabels, groupLabels, marks);
}

/// The technique and the case of a row, or else the chosen ones: their numbers, and the stages of which not all was
/// finite.
function showStabilityCell(chosenRow) {
    if (chosenRow) Object.assign(stabilityChoice, {case: chosenRow.case, technique: pointKey(chosenRow)});
    const data = report.stability, {technique, case: chosen} = stabilityChoice;
    document.querySelectorAll("#stability-matrix .cell")
        .forEach(mark => mark.classList.toggle("chosen", mark.isOf(stabilityChoice)));
    const change = key => value => {
        stabilityChoice[key] = value;
        showStabilityCell();
        at("stability-choice").querySelectorAll("select")[key === "case" ? 1 : 0].focus();
    };
    at("stability-choice").replaceChildren(
            select("Technique", [...techniqueNames], technique, change("technique")),
            select("Case", unique(data.rows.map(r => r.case)), chosen, change("case")));
    const isChosen = r => r.case === chosen && pointKey(r) === technique, row = data.rows.find(isChosen);
    const verdict = row ? data.verdicts[row.verdict] : {name: "not run", meaning: "the case does not apply to this technique"};
    const shown = row ? stabilityColumns.filter(([column]) => row[column] && (column !== "seeds" || row.seeds > 1)) : [];
    const stages = data.stages.filter(isChosen);
    at("stability-cell").replaceChildren(
            h("p", {}, h("b", {}, `${techniqueNames.get(technique)}, ${chosen}: ${verdict.name}`),
              ` – ${verdict.meaning}.`),
            h("p", {class: "note"}, `The case: ${stabilityCases.get(chosen).why}`),
            shown.length ?
                table(
                    ["Quantity", ...numbers("Value"), "Meaning"],
                    shown.map(([column, name,
                                meaning]) => [name, cell(row[column], stabilityNumber(row[column])), meaning])) :
                "",
            stages.length ?
                table(
                    ["Stage: image", ...numbers("NaN", "Inf")],
                    stages.map(s => [`${s.stage}: ${s.image}`, s.nan, s.infinite].map(String)),
                    {caption: "Values of all frames"}) :
                "");
}

const stabilityNumber = value => typeof value === "number" ? number(value) : value;

function failureTable() {
    const {failures} = report.stability;
    if (!failures.length) return null;
    const names = (some, ...before) =>
        h("details", {}, h("summary", {}, ...before, String(some.length)), some.join(", "));
    const line = f =>
        [names(f.points, `${f.technique}, presets: `), f.place, names(f.cases), `${f.nan}, ${f.infinite}`,
         f.first ? String(f.first) : "received",
         [...f.explanations.map(e => e.operation), ...(f.unexplained ? [`unexplained in ${f.unexplained}`] : [])].join(
             "; or "),
         f.explanations.map(e => e.fix).join("; ")];
    const columns = [
        "Technique", "Stage: image", "Cases", ...numbers("NaN, Inf", "Arises there"), "Operation", "Fix"
    ];
    return part(
        "Stages that are not finite",
        "Numbers of values in all frames. Such values arise in a stage if no stage before it has any. The column says " +
            "in how many runs. Other stages received such values as input.",
        table(columns, failures.filter(f => f.is_source).map(line)),
        failures.some(f => !f.is_source) ?
            h("details", {}, h("summary", {}, "Stages that only received such values"),
              table(columns.slice(0, 4), failures.filter(f => !f.is_source).map(f => line(f).slice(0, 4)))) :
            "");
}

/// Of cases in which something spreads, and techniques in which it does.
function spreadTable() {
    const own = report.stability.rows.filter(row => row.spreadPixels);
    if (!own.length) return null;
    const isIn = key => value => own.some(row => key(row) === value);
    const columns = [...stabilityCases.keys()].filter(isIn(row => row.case));
    const text = row => row ? `${row.spreadPixels}${row.spreadFrames ? ` +${row.spreadFrames}` : ""}` : "·";
    const lines = [...techniqueNames.keys()].filter(isIn(pointKey)).map(
        t => [techniqueNames.get(t),
              ...columns.map(c => text(own.find(row => row.case === c && pointKey(row) === t)))]);
    return part(
        "Spread of bad inputs",
        "The largest number of pixels in a frame that are not finite although their inputs are finite. The number after + " +
            "counts the frames after the fault that have such pixels. Cases and techniques without such pixels are left out.",
        table(["Technique", ...numbers(...columns)], lines));
}

function amplificationTable() {
    const inputs = ["depth", "normal", "lit"];
    const own = report.stability.rows.filter(row => inputs.some(input => row[`${input}P999`]));
    if (!own.length) return null;
    const choices = unique(own.map(row => row.case));
    stabilityChoice.amplified = choices[0];
    const body = scroller();
    const value = (row, column) => cell(row[column] ?? 0, number(row[column] ?? 0, 3));
    const show = () => body.replaceChildren(table(
        [
            "Technique",
            ...inputs.flatMap(i => numbers(`${i}, median`, "99.9 %"))
        ],
        own.filter(row => row.case === stabilityChoice.amplified)
            .map(
                row =>
                    [pointLabel(row), ...inputs.flatMap(i => [value(row, `${i}Median`), value(row, `${i}P999`)])]),
        {sortable: true}));
    show();
    return part(
        "Amplification",
        "Relative change of a pixel's result divided by the relative change of its input. The input changes by one step: " +
            "a code of the depth format, 2⁻¹⁵ of the normal, 2⁻¹¹ of the lit colour. Columns hold the median over pixels " +
            "and the 99.9 % quantile.",
        h("div", {class: "controls"}, choiceBox("Case", stabilityChoice, "amplified", choices, show)), body);
}

const part = (title, note, ...content) =>
    h("div", {}, h("h3", {}, title), h("p", {class: "note"}, note),
      ...content.map(c => c instanceof HTMLTableElement ? scroller(c) : c));
