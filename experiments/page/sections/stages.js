// Stage times and counted costs: stacked bars per shot and the numbers.

import {stackedBars} from "../charts/bars.js";
import {stageFill, textureLegend, textures, textureSwatch} from "../charts/textures.js";
import {at, choiceBox, folded, h} from "../elements/elements.js";
import {cell, numberCell, numbers, table} from "../elements/tables.js";
import {costRows, costTable} from "./costs.js";
import {leaveOut, longList, longTable, shotParts} from "./parts.js";
import {aaFloor, costKinds, howCounted} from "../study/costs.js";
import {changedRow, manifestShot, ofShot, pointKey, pointLabel, report} from "../study/data.js";
import {badges, mistakesOfTime} from "../study/mistakes.js";
import {filteredRows, isSingleChange} from "../study/points.js";
import {countText, grouped, interval, list, number, percent, unique} from "../values.js";

const stageChoice = {bars: "times"};

export function showStages() {
    const shots = unique([...report.times, ...report.costs].map(t => t.shot));
    if (!shots.length) return leaveOut("stages");
    const ofTimes = report.times.length ? [["times", "times"], ["shares", "shares of each point's total"]] : [],
          ofCosts = report.costs.length ? Object.entries(costKinds).map(([kind, {name}]) => [kind, name]) : [];
    if (!ofTimes.length) stageChoice.bars = "fetches";
    const note = h("p", {class: "note"});
    const bars = choiceBox("Bars show", stageChoice, "bars", [...ofTimes, ...ofCosts], () => {
        note.textContent = stagesText();
        parts.redraw();
    });
    const parts = shotParts(shots, stagesOf);
    if (ofCosts.length) {
        const title = ofTimes.length ? "Stage times and counted costs" : "Counted costs of stages";
        document.querySelector("#stages h2").textContent = title;
        document.querySelector("nav a[href='#stages']").textContent = title;
        note.textContent = stagesText();
        at("stage-shots").append(note);
    }
    at("stage-shots").append(h("div", {class: "controls"}, bars), parts);
}

/// What the switch shows, where there are counts.
function stagesText() {
    if (stageChoice.bars in costKinds)
        return `${howCounted} A count is no time: it ignores caches, compression and lanes that wait for other lanes.`;
    return "Median times over the measured frames, on the machine that measured them. Choose other bars to see the counted work of stages.";
}

function stagesOf(shot) {
    const times = ofShot(report.times, shot);
    const own = filteredRows(times.filter(t => t.technique !== "")), shared = times.filter(t => t.technique === "");
    const stages = unique(own.filter(t => t.stage !== "total").map(t => t.stage));
    const points = unique(own.map(pointLabel));
    const columns = [
        "Technique", "Stage", ...numbers("Median ms", "95 % interval", "Frames"), "Clock"
    ];
    const sorted = [...own].sort((a, b) => points.indexOf(pointLabel(a)) - points.indexOf(pointLabel(b)));
    const swatch = t => t.stage === "total" || t.technique === "" ? null : textureSwatch(lookOf(stageName(t.stage)));
    const row = t =>
        [t.technique === "" ? "–" : pointLabel(t),
         t.stage === "total" ? h("b", {}, "total") : h("span", {}, swatch(t), t.stage), numberCell(t.value),
         interval(t), String(t.frames), t.clock.replaceAll("_", " ")];
    const barRows = stageChoice.bars in costKinds ? costRows(shot, stageChoice.bars) : own;
    if (!times.length) return [stageBars(barRows), costTable(shot)];
    return [
        stages.length ? stageBars(barRows) :
                        h("p", {class: "note"}, "No technique of this shot has a stage, because all stages were skipped."),
        savedNote(shot), floorNote(shot), formNote(own), costTable(shot),
        h("details", {open: own.length <= longTable}, h("summary", {}, "All stages as numbers"),
          table(columns, sorted.map(row), {groupBy: 0})),
        ...(shared.length ?
                [h("h3", {}, "Shared by all techniques: G-buffer and lit colour"), table(columns, shared.map(row))] :
                [])
    ];
}

const lastPart = stage => stage.split("/").pop();
const stageRows = [...report.times, ...report.costs.map(c => changedRow(c, {value: 0}))];  // looks go by times
/// What two stages of one technique end in.
const ambiguousParts = new Set(unique(stageRows.filter(t => t.stage !== "total").map(t => `${t.technique}|${t.stage}`))
                                   .map(key => [key.split("|")[0], lastPart(key.split("|")[1])].join("|"))
                                   .filter((key, i, all) => all.indexOf(key) !== i)
                                   .map(key => key.split("|")[1]));
/// A stage's name, without its folder where the rest says it.
export const stageName = stage => (ambiguousParts.has(lastPart(stage)) ? stage : lastPart(stage)).replaceAll("_", " ");

/// By name of a stage: the index of its look, the same in all techniques. No other name has it as long as there are
/// looks, and none ever has that shares a technique with it as long as a technique has no more stages than there are
/// looks. The plain ones go to those that take longest.
export function stageLooks(times) {
    const own = times.filter(t => t.stage !== "total" && t.technique !== ""), longest = new Map(), together = new Map();
    for (const [stage, rows] of grouped(own, t => t.stage))
        longest.set(stageName(stage), rows.reduce((most, t) => Math.max(most, t.value), longest.get(stageName(stage)) ?? 0));
    for (const [, rows] of grouped(own, t => t.technique)) {
        const names = unique(unique(rows.map(t => t.stage)).map(stageName));
        for (const name of names) together.set(name, [...together.get(name) ?? [], ...names]);
    }
    const looks = new Map(), all = Array.from({length: 8 * textures.length}, (_, i) => i);
    for (const name of [...longest.keys()].sort((a, b) => longest.get(b) - longest.get(a))) {
        const near = new Set(together.get(name).map(other => looks.get(other))), taken = new Set(looks.values());
        looks.set(name, all.find(i => !taken.has(i)) ?? all.find(i => !near.has(i)) ?? looks.size % all.length);
    }
    return looks;
}

const ownLooks = stageLooks(stageRows);
const lookOf = name => stageFill(ownLooks.get(name));

/// Rows of stackedBars(), one for each point of `rows`, whose parts are its stages: `part(row, stages)` gives how one
/// is drawn, and what its tip says; `totalOf(rows)` the row of a point's total, if there is one.
export const stackedStages = (rows, totalOf, part) => unique(rows.map(pointLabel)).map(label => {
    const own = rows.filter(r => pointLabel(r) === label), stages = own.filter(r => r.stage !== "total");
    const total = totalOf(own), share = r => total?.value > 0 ? `\n${percent(r.value / total.value)} of the total` : "";
    const parts = stages.map(r => {
        const {said, ...drawn} = part(r, stages);
        return {text: stageName(r.stage), tip: `${label}\n${r.stage}: ${said}${share(r)}`, ...drawn};
    });
    return {label, parts, total};
});

function stageBars(own) {
    const areShares = stageChoice.bars === "shares", cost = costKinds[stageChoice.bars];
    const valueText = t => cost ? `${countText(t.value * 1e6)} ${cost.name}` : `${number(t.value)} ms ${interval(t)}`;
    const sum = stages => stages.reduce((all, t) => all + t.value, 0);
    const rows = stackedStages(own, of => of.find(t => t.stage === "total"), (t, stages) => ({
        value: areShares ? t.value / sum(stages) : t.value,
        fill: lookOf(stageName(t.stage)),
        data: {stage: t.stage, value: t.value},
        said: valueText(t)
    })).filter(row => row.parts.length).map(row => ({...row, total: areShares || cost ? null : row.total}));
    const names = unique(rows.flatMap(row => row.parts.map(p => p.text)));
    const chart = stackedBars({
        title: `Stage ${cost ? "costs" : "times"}, ${own[0].shot}`,
        rows,
        isShare: areShares,
        xLabel: areShares ? "share of the point's time (medians)" :
            cost          ? `${cost.axis}, in the last frame` :
                            "median time (ms); the line is the 95 % interval of the total"
    });
    return h("div", {class: "bars"}, chart, h("div", {}, textureLegend(names.map(name => [lookOf(name), name]))));
}

/// What each point saves by leaving out what the scene has no use for: medians and intervals over the frames.
function savedNote(shot) {
    const savings = list(report.manifest.clock?.savings).filter(s => s.shot === shot);
    if (!savings.length) return "";
    const leftOut = list(manifestShot(shot)?.left_out).length;
    const share = s => cell(s.share, `${percent(s.share)} `, h("small", {}, `[${percent(s.low)}, ${percent(s.high)}]`));
    return folded(
        `Work that can be skipped: time saved by leaving out ${leftOut} parts`,
        table(
            [
                "Point", ...numbers("Share of its total that is saved", "Total without saving (ms)")
            ],
            savings.map(s => [pointLabel(s), share(s), number(s.complete_ms, 3)])),
        h("p", {class: "note"}, "Which parts, and why: ", h("a", {href: "#needs"}, "What the scenes need"), "."));
}
/// What was timed: a point's name does not say which form of a stage ran. Single changes equal their baseline in all
/// but what their name says.
function formNote(times) {
    const isTimed = v => times.some(t => pointKey(t) === pointKey(v));
    const lines = list(report.manifest.techniques)
                      .filter(v => isTimed(v) && !isSingleChange(v))
                      .map(v => [pointLabel(v), formText(v)])
                      .filter(([, text]) => text);
    if (!lines.length) return "";
    const items = lines.map(([label, text]) => h("li", {}, h("b", {}, label), ": " + text));
    const note = h("div", {class: "note forms"}, "What was timed:", h("ul", {}, items));
    return lines.length > longList ? folded("What was timed", note) : note;
}

/// The forms a point chose, and what else it changes of its technique's defaults.
function formText({technique, parameters}) {
    const entries = Object.entries(parameters ?? {}), defaults = report.defaults[technique];
    const show = some => some.map(([name, value]) => `${name} = ${JSON.stringify(value)}`).join(", ");
    const isForm = ([, value]) => typeof value === "string", forms = show(entries.filter(isForm));
    if (!defaults || !entries.length) return forms;
    const changed = entries.filter(([name, value]) => name in defaults && defaults[name] !== value);
    const others = show(changed.filter(e => !isForm(e)));
    return [forms, others ? `not at the default: ${others}` : "all else at the default"].filter(Boolean).join("; ");
}

/// How far two interleaved copies of the same point were apart: smaller differences are none.
function floorNote(shot) {
    const pairs = list(report.manifest.clock?.aa_pairs).filter(p => p.shot === shot);
    if (!pairs.length) return "";
    const one =
        p => [`${percent(p.floor)} (${pointLabel(p)}, ${number(p.first_ms, 3)} ms)`, ...badges(mistakesOfTime(p))];
    const floors = pairs.map(p => p.floor), most = pairs.find(p => p.floor === Math.max(...floors));
    const text = [
        `Two interleaved copies of the same point differed by ${
            pairs.length > 1 ? `${percent(Math.min(...floors))} to ` : ""}`,
        ...one(most),
        `. A/A floor of this shot: ${
            percent(aaFloor(shot))}. Smaller differences between times say nothing.`
    ];
    const rest = () => folded("The copies of each point", h("ul", {}, pairs.map(p => h("li", {}, one(p)))));
    return h("div", {class: "note"}, text, pairs.length > 1 ? rest() : "");
}
