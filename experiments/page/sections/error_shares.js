// Where a technique's error lies: shares of the squared error by what became of the pixel's ray.

import {stackedBars} from "../charts/bars.js";
import {at, folded, h} from "../elements/elements.js";
import {showRaysOf, verdictLegend} from "./hits.js";
import {leaveOut, shotParts} from "./parts.js";
import {answerOf} from "../study/answers.js";
import {byShot, isSamePoint, manifestShot, ofShot, pointKey, pointLabel, report, shortShot} from "../study/data.js";
import {headline, metricKey, rowText, unitText} from "../study/errors.js";
import {ladderOf} from "../study/ladder.js";
import {filteredRows, mayShow} from "../study/points.js";
import {causeTexts, errorStage, missTexts, sharedOut} from "../study/verdicts.js";
import {grouped, interval, list, number, percent, percentInterval, preferred, unique} from "../values.js";
import {openPoint} from "../viewer/viewer.js";

const sharedError = {
    metric: "mse",
    target: "specular"
};  // what hits.csv shares out

const lastFrame = rows => String(Math.max(...rows.map(r => Number(r.frame))));

const isShare = r => r.stage === errorStage && r.quantity.startsWith("error: ");
const groupsOf = new Map();

/// [{row, error, by}] of a shot's points: shares by verdict, and the error that they are shares of; undefined if it was
/// not measured. Of several frames the last.
function errorGroups(shot) {
    if (!groupsOf.has(shot)) groupsOf.set(shot, errorGroupsOf(shot, ofShot(report.hits, shot).filter(isShare)));
    return groupsOf.get(shot);
}

function errorGroupsOf(shot, all) {
    const mask = preferred(unique(all.map(r => r.mask)), headline.mask), frame = lastFrame(all);
    const {metric, target} = sharedError, own = all.filter(r => r.mask === mask && r.frame === frame);
    const errors = [...ofShot(report.frames, shot), ...ofShot(report.errors, shot)].filter(
        e => e.metric === metric && e.target === target && e.mask === mask && e.value > 0);
    return [...grouped(own, pointKey)].map(([key, rows]) => {
        const ofPoint = errors.filter(e => pointKey(e) === key);
        const by = new Map(rows.map(r => [r.quantity.slice("error: ".length), r]));
        return {row: rows[0], by, error: ofPoint.find(e => e.frame === frame) ?? ofPoint[0]};
    });
}
const errorShares = shot => errorGroups(shot).filter(g => filteredRows([g.row]).length);
const errorGroupOf = row => errorGroups(row.shot).find(g => isSamePoint(g.row, row));
const leastShare = 0.01;  // smaller ones are not named

/// [{key, value}] of what `of(verdict)` gives, the largest first.
const rankedCauses = of =>
    Object.keys(causeTexts).map(key => ({key, value: of(key)})).sort((a, b) => b.value - a.value);
const ownCauses = ({by}) => rankedCauses(key => by.get(key)?.value ?? 0).filter(c => c.value >= leastShare);
const causesText = ([first, ...others]) => `${percent(first.value, 2)} of its error lies ${causeTexts[first.key]}` +
    others.map(c => `, ${percent(c.value, 2)} ${causeTexts[c.key]}`).join("");

/// For tips: the largest causes alone; empty where no shares were measured.
export function shortWhy(row) {
    const group = errorGroupOf(row), own = group ? ownCauses(group) : [];
    return own.length ? `why (${sharedError.metric}): ${causesText(own.slice(0, 2))}` : "";
}

/// How a point compares with the least error of its shot, and where it errs more.
function comparisonText({row, by, error}) {
    if (!error?.standing) return "";
    const {metric} = sharedError;
    const others = errorGroups(row.shot).filter(g => g.error?.standing && mayShow(g.row));
    const least = others.reduce((a, b) => b.error.value < a.error.value ? b : a);
    const own = `Its ${metric}, ${number(error.value, 3)},`,
          best = `the least (${pointLabel(least.row)}, ${number(least.error.value, 3)})`;
    if (least.row === row) return `${own} is the least here. `;
    if (error.standing === "equivalent") return `${own} is certainly within the margin of ${best}. `;
    if (error.standing !== "behind") return `${own} is not certainly larger than ${best}. `;
    const part = (g, key) => (g.by.get(key)?.value ?? 0) * g.error.value;
    const [{key}] = rankedCauses(key => part({by, error}, key) - part(least, key));
    return `${own} is ${number(error.value / least.error.value, 3)} times ${best}. The largest part of the difference lies ${
        causeTexts[key]}: ${number(part({by, error}, key), 2)} against ${number(part(least, key), 2)}. `;
}

/// Which rays missed what the screen shows, and what their tracer said of them.
function missesText({row, by}) {
    if (!(by.get("avoidable_miss")?.value >= leastShare)) return "";
    const own = ofShot(report.hits, row.shot).filter(
        r => r.stage !== errorStage && isSamePoint(r, row) && r.mask === row.mask && r.frame === row.frame);
    const of = quantity => own.filter(r => r.quantity === quantity), missed = of("avoidable_miss"),
          all = missed.reduce((sum, r) => sum + r.rays, 0);
    if (!all) return "";
    const share = quantity => of(quantity).reduce((sum, r) => sum + r.rays * r.value, 0) / all;
    const reasons = Object.keys(missTexts)
                        .map(key => ({key, value: share("miss: " + key)}))
                        .filter(m => m.value > 0.1 * share("avoidable_miss"))
                        .sort((a, b) => b.value - a.value);
    return `${percent(share("avoidable_miss"), 2)} of its rays missed what the screen shows` +
        (reasons.length ? `: ${reasons.map(m => `${percent(m.value, 2)} ${missTexts[m.key]}`).join(", ")}` : "") + ". ";
}

/// "technique in scene, frame 3"
function placeText(row) {
    const hasFrames = list(manifestShot(row.shot)?.frames).length > 1;
    return `${pointLabel(row)} in ${shortShot(row.shot)}${hasFrames ? `, frame ${row.frame}` : ""}`;
}

/// Links to a point's rays and its images.
function rayLinks(row) {
    const hasRays = ofShot(report.hits, row.shot).some(r => r.stage !== errorStage);
    const link = (text, href, act) => {
        const click = event => {
            event.preventDefault();
            act();
        };
        return h("a", {href, click}, text);
    };
    return [
        ...(hasRays ? [link("Its\u00a0rays", "#hits", () => showRaysOf(row.shot)), " "] : []),
        ofShot(report.images, row.shot).some(i => isSamePoint(i, row)) ? link("Its\u00a0images", "#viewer", () => openPoint(row)) : ""
    ];
}

/// Why a point errs, in sentences.
function whyText(group) {
    const {row} = group, own = ownCauses(group);
    return h(
        "span", {}, h("b", {}, `${placeText(row)}: `),
        own.length ? causesText(own) + ". " : "It has no error that could be divided by causes. ", missesText(group),
        comparisonText(group), ...rayLinks(row));
}

/// Causes that a reader takes for one: what happened to the rays.
const causeGroups = [
    {name: "rays were wrong", keys: ["avoidable_miss", "wrong_place", "false_hit"]},
    {name: "rays were right (filter, fallback, view)", keys: ["right"]},
    {name: "the screen does not show it", keys: ["unavoidable_miss", "empty"]},
    {name: "no ray was traced", keys: ["untraced"]}
];

/// The same at a glance: a bar for each group of causes and, below it, for its parts.
function whyBars(group) {
    const {row} = group, own = ownCauses(group);
    if (!own.length) return whyText(group);
    const groups = causeGroups
                       .map(({name, keys}) => {
                           const parts = own.filter(c => keys.includes(c.key));
                           return {name, parts, value: parts.reduce((sum, p) => sum + p.value, 0)};
                       })
                       .filter(g => g.parts.length)
                       .sort((a, b) => b.value - a.value);
    const bar = (value, text, fill, isGroup) =>
        h("li", {class: isGroup ? "group" : null}, h("span", {class: "share"}, percent(value, 2)),
          h("span", {class: "bar-room"},
            h("span", {style: `width: ${Math.min(100 * value / groups[0].value, 100)}%; background: ${fill}`})),
          text);
    const color = key => sharedOut.find(v => v.key === key).color;
    const bars = groups.flatMap(({name, parts, value}) => [
        bar(value, name, parts.length > 1 ? "var(--ink)" : color(parts[0].key), true),
        ...(parts.length > 1 ? parts.map(p => bar(p.value, causeTexts[p.key].replace("where ", ""), color(p.key))) : [])
    ]);
    return h("div", {}, h("b", {}, `Its squared error: ${placeText(row)}`), h("ul", {class: "causes"}, bars),
             ...rayLinks(row));
}

/// Empty where nobody asked what became of rays.
function whyNoShares() {
    const {every} = report.manifest.config?.hits ?? {};
    return every > 1 && !report.hits.some(isShare) ?
        `The causes of errors are unknown: this study judged the rays of one pixel in ${every} along each axis. ` +
            "Dividing the error by causes takes the rays of all pixels (\"hits\": {\"every\": 1})." :
        "";
}

export function showErrorShares() {
    const shots = [...byShot(report.hits)].filter(([, rows]) => rows.some(isShare)).map(([shot]) => shot);
    if (!shots.length) {
        const why = whyNoShares();
        return why ? at("error-shares").append(h("p", {class: "note"}, why)) : leaveOut("error-shares");
    }
    at("error-shares").append(verdictLegend(sharedOut), shotParts(shots, errorSharesPart));
}

function errorSharesPart(shot) {
    const groups = errorShares(shot), {metric, target} = sharedError;
    if (!groups.length) return [];
    const why = h("p", {class: "why", role: "status"});
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
                                            percentInterval(r)}${g.error ? `\n${rowText(g.error)}` : ""}\nClick: why`,
                                        open: () => why.replaceChildren(whyText(g))
                                    };
                                })
                            }));
    const key = groups[0].error && metricKey(groups[0].error), {mask} = groups[0].row;
    const limit = isAbsolute ?
        ladderOf(shot, {target, metricKey: key, mask}).find(r => r.rung === "on_screen" && r.value > 0) :
        null;
    const xLabel = isAbsolute ? `${metric}${unitText(metric)} of ${target}, ${mask}` :
                                `share of the ${metric} of ${target}, ${mask}`;
    const frames = list(manifestShot(shot)?.frames);
    why.append(...groups.filter(g => isSamePoint(g.row, {shot, ...answerOf(shot)?.best})).map(whyText));
    return [
        h("div", {class: "bars"}, stackedBars({
              title: `Where the error lies, ${shot}`,
              rows,
              xLabel: xLabel + (frames.length > 1 ? `, frame ${groups[0].row.frame} alone` : ""),
              isShare: !isAbsolute,
              limits: limit ? [{x: limit.value, rows: rows.map(r => r.label)}] : []
          }),
          h("div", {}, why,
            limit ? h("p", {class: "note"},
                      `The dotted line is the lower bound for any single-frame technique, ${
                      `${metric} ${number(limit.value)} ${interval(limit)}`.trim()}.`) :
                    "")),
        folded("All points in sentences", h("ul", {class: "sentences"}, groups.map(g => h("li", {}, whyText(g)))))
    ];
}

/// For the first screen: why the chosen point errs; where no errors were shared out, what that takes.
export function drawWhy(shot, point) {
    const group = errorGroups(shot).find(g => pointKey(g.row) === pointKey(point ?? {}));
    at("why-answer").replaceChildren(group ? whyBars(group) : whyNoShares());
}
