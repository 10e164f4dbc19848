// Head, warnings and the tables that do not change: references, needs, parameters.

import {at, folded, h, scroller, withTip} from "../elements/elements.js";
import {foldedLater} from "../elements/later.js";
import {numbers, table} from "../elements/tables.js";
import {longTable} from "./parts.js";
import {reloadInPlace} from "./start.js";
import {manifestShots, report, shotName} from "../study/data.js";
import {makers} from "../study/makers.js";
import {allPoints, isSingleChange} from "../study/points.js";
import {list, number, percent, unique} from "../values.js";

export const known = (value, text = String(value)) =>
    value === null || value === undefined || value === "" ? "not recorded" : text;

export function showHead() {
    const {manifest} = report;
    const shots = list(manifest.shots).length;
    const parts = [
        `${shots} ${shots === 1 ? "shot" : "shots"}`,
        `${allPoints.length} technique ${allPoints.length === 1 ? "point" : "points"}`,
        ...unique(makers.map(m => m.device?.name)), makers.map(m => m.started).sort()[0]
    ];
    at("subtitle").textContent = parts.filter(Boolean).join(" · ");
    const {warnings} = report, count = `${warnings.length} ${warnings.length === 1 ? "warning" : "warnings"}`;
    const items = warnings.map(text => h("li", {class: "warning"}, text));
    at("warnings").replaceChildren(items.length ? folded(`${count} of the study`, h("ul", {}, items)) : "");
    if (manifest.is_complete === false) showProgress(manifest.cells ?? {}, new Date(manifest.written?.at));
}

/// A study writes its page again and again while it runs: whoever only looks sees it fill. Long studies write seldom,
/// so an old page looks for the next one seldom, too; whether the study still runs it cannot know.
function showProgress({done, planned}, written) {
    const second = 1000, day = 86400 * second, age = () => Date.now() - written;
    const when = Number.isNaN(+written) ? "a time not recorded" : written.toLocaleTimeString();
    at("warnings").before(
        h("p", {id: "progress", class: "warning"}, `Not finished: ${done ?? "?"} of ${planned ?? "?"} cells were done at ${
            when}. While the study runs, this page reloads by itself. To continue a stopped study, run the same command again.`));
    let used = 0;
    for (const act of ["pointerdown", "keydown", "wheel"]) addEventListener(act, () => used = Date.now());
    const look = () => {
        if (Date.now() - used > 30 * second) return reloadInPlace();
        setTimeout(look, 15 * second);
    };
    if (age() < day) setTimeout(look, Math.min(Math.max(age() / 4, 15 * second), 600 * second));
}

export function showReferences() {
    const columns = [
        "Shot",
        ...numbers(
            "Samples per pixel", "Seconds", "Rays", "Longest path", "Error, median", "Error, 95 %", "Reached target",
            "Poses"),
        "Lit colour", "Hash"
    ];
    const rows = list(manifestShots()).map(s => () => {
        const r = s.reference ?? {}, e = r.relative_error ?? {};
        return [
            shotName(s.shot), number(r.samples_median), number(r.seconds, 3) + (r.from_cache ? " (cached)" : ""),
            number(r.rays, 3), number(r.max_depth), percent(e.median), percent(e.p95), reachedCell(r),
            s.references ? String(s.references.length) : "1", known(s.lit, String(s.lit).replace("_", "\u2011")),
            h("span", {class: "hash", title: r.hash ?? ""}, known(r.hash, String(r.hash).slice(0, 12)))
        ];
    });
    at("references").append(
            h("p", {class: "note"},
              "Errors are relative standard errors of the truth's specular light at a pixel, in the last frame. " +
                  "Every comparison accounts for them."),
            scroller(table(columns, rows)));
}

/// A share says something only of a target.
const reachedCell = reference => reference.target_relative_error > 0 ?
    `${percent(reference.reached_share)} (of ${percent(reference.target_relative_error)})` :
    reference?.reached_share === undefined ? "" :
    withTip(h("span", {}, "no target"), "The study asks for no relative error of this reference: a share of pixels that reached one has no meaning.");

export function showNeeds() {
    const saved = ({saved_ms: ms}) => ms === null || ms === undefined ? "not measured" : number(ms) + " ms";
    for (const shot of manifestShots()) {
        const needs = list(shot.needs), leftOut = list(shot.left_out);
        if (!needs.length && !leftOut.length) continue;
        const skipped = leftOut.map(l => [l.what, known(l.fact), known(l.why), saved(l)]);
        at("needs").append(foldedLater(
            `${shot.shot}: ${leftOut.length ? leftOut.length + " parts skipped" : "nothing skipped"}`,
            () => [
                table(["Fact", "Value", "Why"], needs.map(n => [n.fact, String(n.value), n.why ?? ""])),
                skipped.length ? table(["Skipped", "Serves only", "Why", ...numbers("Time saved")], skipped) : ""
            ]));
    }
}

/// Names the points if others of the technique have no limits.
function limitsNote(points) {
    const limited = points.filter(p => p.limits);
    if (!limited.length) return null;
    const names = limited.length < points.length ? ": " + limited.map(p => p.point).join(", ") : "";
    return `Held to the limits of ${limited[0].limits}${names}`;
}

export function showParameters() {
    for (const name of unique(list(report.manifest.techniques).map(v => v.technique))) {
        const points = report.manifest.techniques.filter(v => v.technique === name && !isSingleChange(v));
        if (!points.length) continue;
        const first = points[0],
              stages = unique(report.times.filter(t => t.technique === name && t.stage !== "total").map(t => t.stage));
        const about = [first.source, stages.length && "Stages: " + stages.join(", "), limitsNote(points)];
        at("parameters").append(
                h("div", {}, h("h3", {}, first.title && first.title !== name ? `${name}: ${first.title}` : name),
                  h("p", {class: "note"}, about.filter(Boolean).join(". ").replaceAll("..", ".")),
                  parameterTables(points, name)));
    }
}

const parameterText = value => value === undefined ? "–" :
    typeof value === "number"                      ? number(value, 6) :
                                                     JSON.stringify(value);
const mostColumns = 8;  // of points; more of them are rows

/// What differs among the points of a technique, then what is equal for all of them.
function parameterTables(points, technique) {
    const keys = unique(points.flatMap(p => Object.keys(p.parameters ?? {})));
    if (!keys.length) return [];
    const differs = key => unique(points.map(p => JSON.stringify(p.parameters?.[key]))).length > 1;
    const differing = keys.filter(differs), equal = keys.filter(key => !differs(key));
    const name = key => h("span", {title: report.manifest.parameter_docs?.[technique]?.[key] ?? null}, key);
    const value = (p, key) => parameterText(p.parameters?.[key]);
    const areRows = points.length > mostColumns;
    const columns = areRows ? ["Point", ...numbers(...differing)] :
                              ["Parameter", ...numbers(...points.map(p => p.point))];
    const rows = areRows ? points.map(p => [p.point, ...differing.map(key => value(p, key))]) :
                           differing.map(key => [name(key), ...points.map(p => value(p, key))]);
    const common = () => table(
        ["Parameter", ...numbers("Value")], equal.map(key => [name(key), value(points[0], key)]));
    const isLong = rows.length > longTable;
    const shown = () => [scroller(table(columns, rows))];
    return [
        ...(differing.length ?
                (isLong ? [foldedLater(`${points.length} points, and the ${differing.length} parameters in which they differ`, shown)] :
                          shown()) :
                []),
        ...(equal.length ?
                [differing.length && equal.length > 3 ? foldedLater(`${equal.length} more parameters, equal for all points`, () => [common()]) :
                                                        common()] :
                [])
    ];
}
