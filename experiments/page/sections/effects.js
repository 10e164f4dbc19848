// What each change of a baseline does to an error: ratios over paired seeds, for all shots at once or one in detail.

import {strip, stripAxis, stripScale} from "../charts/strips.js";
import {legend, mostStyles, seriesStyle} from "../charts/styles.js";
import {at, choiceBox, h, scroller} from "../elements/elements.js";
import {cell, countCell, numberCell, numbers, table, valueCell} from "../elements/tables.js";
import {drawnPart, leaveOut} from "./parts.js";
import {whyMissing} from "./temporal.js";
import {byShot, manifestShots, ofShot, pointKey, pointLabel, report, shortShot} from "../study/data.js";
import {headlineMetric, metricKey, metricName, otherMetric} from "../study/errors.js";
import {isSingleChange} from "../study/points.js";
import {grouped, interval, list, number, percent, preferred, unique} from "../values.js";

const effectChoice = {
    against: null,
    target: null,
    metric: null,
    mask: null,
    shot: "all shots",
    scale: "all"
};
const hiddenShots = new Set();  // by the legend
const errorParts = {bias_squared: "bias²", variance: "variance"};  // what a mean squared error is the sum of
const scales = {all: "all ratios", "1.5": "2/3 to 1.5", "1.1": "0.91 to 1.1", "1.01": "0.99 to 1.01"};

const effectShots = () => unique([
                              ...manifestShots().map(s => s.shot), ...byShot(report.effects).keys()
                          ]).filter(shot => ofShot(report.effects, shot).length);
const againstLabel = e => e.against === "baseline" ? pointLabel({technique: e.againstTechnique, point: e.againstPoint}) :
                                                     `${e.technique} with ${e.against} and otherwise the same`;
/// What effects on errors and times of the same points and shot share.
const pairKey = e => [e.shot, pointKey(e), againstLabel(e)].join("|");

export function showEffects() {
    const rows = report.effects;
    if (!rows.length) return leaveOut("effects");
    const options = {
        against: unique(rows.map(againstLabel)),
        target: unique(rows.map(e => e.target)),
        metric: unique(rows.map(metricKey)),
        mask: unique(rows.map(e => e.mask)),
        shot: ["all shots", ...effectShots()],
        scale: Object.keys(scales)
    };
    const primary = rows.find(e => e.isPrimary);
    Object.assign(effectChoice, {
        against: options.against[0],
        target: primary?.target ?? preferred(options.target, "specular"),
        metric: primary ? metricKey(primary) : headlineMetric(rows),
        mask: primary?.mask ?? preferred(options.mask, "reflective")
    });
    const box = (label, key, show = o => o) => options[key].length < 2 ?
        null :
        choiceBox(label, effectChoice, key, options[key].map(o => [o, show(o)]), drawEffects);
    const place = h("div", {class: "strips", id: "effect-table"});
    at("effects").append(
        h("div", {class: "controls"}, box("Against", "against"), box("Shot", "shot"), box("Target", "target"),
          box("Metric", "metric", metricName), box("Mask", "mask"), box("Scale", "scale", o => scales[o])),
        h("p", {class: "note", id: "effect-family"}), h("div", {id: "effect-legend"}),
        scroller(place));
    drawnPart(place, drawEffects);
}

const presetOf = point => point.split(" ").filter(word => !word.includes("=") && word !== "default").join(" ");
/// Of the baseline that it is compared with: a study may have several, and a change of one is a whole point to another.
const isChangeOfBaseline = e =>
    e.against === "baseline" && isSingleChange(e) && presetOf(e.point) === presetOf(e.againstPoint);

/// [{label, doc, rows}] in the order of the study: single changes of a baseline first, then whole points.
function effectGroups(rows) {
    const isBaseline = rows.some(e => e.against === "baseline");
    const byPoint = grouped(rows, pointKey), of = key => byPoint.get(key) ?? [];
    const docs = report.manifest.parameter_docs ?? {};
    const singles = report.singleChanges.map(c => ({
                                                 label: `${c.parameter} = ${JSON.stringify(c.value)}`,
                                                 doc: docs[c.technique]?.[c.parameter] ?? "",
                                                 rows: of(pointKey(c)).filter(isChangeOfBaseline)
                                             }));
    const wholes = unique(rows.filter(e => !isChangeOfBaseline(e)).map(pointKey))
                       .map(key => ({
                                label: pointLabel(of(key)[0]),
                                doc: isBaseline ? "all of its changes together" : "",
                                rows: of(key)
                            }));
    return [...singles, ...wholes].filter(g => g.rows.length);
}

/// [{name, rows}]: the ratios that are read beside those of the chosen metric. Beside a squared error stand its parts.
function otherEffects() {
    const other = otherMetric(effectChoice.metric, report.effects);
    const hasParts = [effectChoice.metric, other].some(key => key?.startsWith("mse|"));
    const keys = [other, ...(hasParts ? Object.keys(errorParts).map(part => `${part}|seed_pairs`) : [])];
    const isShown = e => e.target === effectChoice.target && e.mask === effectChoice.mask;
    return keys.map(key => report.effects.filter(e => metricKey(e) === key && isShown(e)))
        .filter(rows => rows.length)
        .map(rows => ({name: errorParts[rows[0].metric] ?? rows[0].metric, rows}));
}

const isChosen = e => againstLabel(e) === effectChoice.against && e.target === effectChoice.target &&
    metricKey(e) === effectChoice.metric && e.mask === effectChoice.mask;

function drawEffects() {
    const isAll = effectChoice.shot === "all shots", shots = effectShots();
    const rows = (isAll ? report.effects : ofShot(report.effects, effectChoice.shot)).filter(isChosen);
    const scale = effectScale(rows, !isAll);
    at("effect-legend").replaceChildren(isAll && shots.length <= mostStyles ? shotLegend(shots) : "");
    const times = totalTimeEffects(rows);
    const others = [...otherEffects(), ...(times.length ? [{name: "time", rows: times}] : [])]
                       .map(({name, rows}) => ({name, byPair: grouped(rows, pairKey)}));
    at("effect-family").textContent = familyText(rows);
    const cells = rows => {
        const beside = others.map(o => rows.flatMap(e => o.byPair.get(pairKey(e)) ?? []));
        return isAll ? pooledCells(rows, beside) : effectCells(rows[0], beside.map(found => found[0]));
    };
    const columns = (isAll ? pooledColumns : effectColumns)(others.map(o => o.name));
    const lines = effectGroups(rows).map(
        g => () =>
            [h("div", {class: "change"}, h("b", {}, g.label), g.doc ? h("small", {}, g.doc) : null, repeatNote(g.rows)),
             strip(
                 scale,
                 g.rows.filter(e => e.value !== null && !(isAll && hiddenShots.has(e.shot)))
                     .map(e => effectMark(e, shots, isAll))),
             ...cells(g.rows)]);
    const label = `${metricName(effectChoice.metric)}: ratio, logarithmic`;
    const last = ["", stripAxis(scale, label), ...columns.slice(2).map(() => "")];
    at("effect-table").replaceChildren(table(columns, lines, {last}));
}

/// A button per shot: it shows and hides that shot's marks.
const shotLegend = shots =>
    legend(shots.map((shot, i) => ({
                         label: shortShot(shot),
                         style: seriesStyle(i),
                         isShown: !hiddenShots.has(shot),
                         toggle: () => {
                             hiddenShots.has(shot) ? hiddenShots.delete(shot) : hiddenShots.add(shot);
                             drawEffects();
                         }
                     })));

function familyText(rows) {
    const {metric, mask, target} = report.manifest.primary ?? {};
    if (rows.some(e => e.isPrimary))
        return `Primary: this study was made to compare ${metric} of ${target}, ${
                   mask} pixels, of all points and shots. ` +
            "Filled marks are significant. Verdicts, p and intervals are adjusted for all of these comparisons (Holm).";
    return "Exploratory: this study was made for other comparisons" +
        (metric ? ` (${metric} of ${target}, ${mask} pixels)` : "") +
        ". Verdicts, p and intervals are adjusted for all effects on this error (Holm).";
}

const otherColumns = (others, text) => numbers(...others.map(other => `${other}: ${text}`));
const pooledColumns = others =>
    [`Change of ${effectChoice.against}`, "Ratio, one mark per shot",
     ...numbers("Mean ratio (range over shots)"), ...otherColumns(others, "mean ratio"),
     ...numbers("Helps", "Harms", "Shots")];
const effectColumns = others =>
    [`Change of ${effectChoice.against}`, "Ratio", ...numbers("Ratio [95 %]"),
     ...otherColumns(others, "ratio"), ...numbers("p (Holm)", "Seeds"), "Result"];

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

/// Why a ratio has no interval though there are seeds enough; null if it has one. Seeds stand for what differs from
/// run to run only where the same seed gives the same result again.
function whyNotRepeatable(e) {
    if (e.low !== null) return null;
    const reason = (technique, point) =>
        list(report.manifest.techniques).find(v => v.technique === technique && v.point === point)?.not_repeatable;
    return reason(e.technique, e.point) || reason(e.againstTechnique, e.againstPoint) || null;
}

const isSignificant = e => e.verdict === "less" || e.verdict === "more";

/// The times of the points that are compared, as ratios like the errors'.
function totalTimeEffects(rows) {
    const pairs = new Set(rows.map(pairKey));
    return report.timeEffects.filter(t => t.stage === "total" && pairs.has(pairKey(t)));
}

function repeatNote(rows) {
    const reasons = unique(rows.map(whyNotRepeatable).filter(Boolean));
    return reasons.length ? h("small", {class: "not-repeatable"}, "no interval: " + reasons.join("; ")) : null;
}

function effectMark(e, shots, isAll) {
    return {
        style: seriesStyle(isAll ? shots.indexOf(e.shot) : 0),
        row: isAll ? {value: e.value} : e,
        isHollow: !isSignificant(e),
        tip: `${e.shot}\n${e.point}\n${e.metric} × ${number(e.value)} ${interval(e)}\n${
            whyNotRepeatable(e) ?? `p (Holm) ${number(e.holm, 2)}, ${e.seeds} seeds`}`
    };
}

/// The geometric mean over the shots with the least and the largest of them: shots are no sample of anything, so it has
/// no interval.
function meanCell(rows) {
    const ratios = rows.map(e => e.value).filter(v => v > 0);
    if (!ratios.length) return cell(null, "–");
    const mean = Math.exp(ratios.reduce((sum, v) => sum + Math.log(v), 0) / ratios.length);
    const range = `(${number(Math.min(...ratios), 3)} to ${number(Math.max(...ratios), 3)})`;
    return cell(mean, number(mean), " ", h("small", {}, ratios.length > 1 ? range : ""));
}

/// How many shots the change helps or harms beyond chance.
function pooledCells(rows, others) {
    const count = f => rows.filter(f).length;
    const boldCount = f => {
        const n = count(f);
        return cell(n, n ? h("b", {}, String(n)) : "0");
    };
    const measured = count(e => e.value > 0);
    return [
        meanCell(rows), ...others.map(meanCell), boldCount(e => e.verdict === "less"),
        boldCount(e => e.verdict === "more"), countCell(measured)
    ];
}

/// Why there is no ratio: no pairs, an error without a value, or one that is 0 or that the reference's noise hides.
function whyNoRatio(e) {
    if (!e.seeds) return "no seed in common";
    const error = (technique, point) => ofShot(report.errors, e.shot).find(
        r => r.technique === technique && r.point === point && r.target === e.target &&
            metricKey(r) === metricKey(e) && r.mask === e.mask);
    const lacking = [error(e.technique, e.point), error(e.againstTechnique, e.againstPoint)].find(r => r?.value === null);
    return lacking ? `no value for ${lacking.point}: ${whyMissing(lacking)}` :
                    `${errorParts[e.metric] ?? "an error"} is not above 0`;
}

function effectCells(e, others) {
    const result = e.value === null                              ? whyNoRatio(e) :
        whyNotRepeatable(e)                                      ? "not repeatable: no interval" :
        e.low === e.value && e.high === e.value && e.value === 1 ? "changes nothing" :
        e.verdict === "equivalent"                               ? "equivalent" :
        !isSignificant(e)                                        ? "undecided" :
        e.verdict === "less"                                     ? `${percent(1 - e.value, 2)} less error` :
                                                                   `${percent(e.value - 1, 2)} more error`;
    return [
        valueCell(e), ...others.map(other => other ? valueCell(other) : "–"), numberCell(e.holm, 2),
        countCell(e.seeds), isSignificant(e) ? h("b", {}, result) : result
    ];
}
