// Verdicts, errors, times, and why pixels are wrong.

import {at, h} from "../elements/elements.js";
import {fillTable} from "../elements/tables.js";
import {causeTexts} from "../study/verdicts.js";
import {interval, number, percent, twoDecimals} from "../values.js";

const writeTable = (id, names, rows) => fillTable(at(id), names.map((name, i) => ({name, number: i > 0})), rows);

/// Behind a number: " [low, high]".
const ends = row => row.low === null ? "" : " " + interval(row);

/// "1.02 [0.99, 1.05] times the error of my_ssr_1; a ratio of 1.08 would be detected", of each view.
function verdictText({label, verdict, why, views}) {
    if (verdict === "identical") return "all errors are the same to the last digit";
    if (!verdict) return why;
    return views
        .map(v => `${views.length > 1 ? v.shot + ": " : ""}${number(v.ratio)}${ends(v)} times the error of ${label}${
                 v.verdict === "undecided" ? `; a ratio of ${number(v.detectable)} would be detected` : ""}`)
        .join("; ");
}

export function writeVerdicts({result}) {
    at("verdicts").replaceChildren(...(result?.verdicts ?? []).map(said => {
        const name = said.verdict || "not decided";
        const card = h("div", {class: "verdict"}, h("small", {}, `against ${said.label}`),
                             h("b", {}, name), h("small", {}, verdictText(said)));
        card.classList.add(name.replaceAll(" ", "-"));
        card.dataset.against = said.label;
        card.dataset.verdict = said.verdict;
        return card;
    }));
}

const errorText = ({error}) => {
    const {value, pixels, non_finite} = error;
    if (value === null) return non_finite && !pixels ? "every pixel is NaN or infinite" : "cannot be measured";
    const interval = ends(error) || ` (no interval yet: ${error.interval.replace("none: ", "")})`;
    return number(value) + interval + (non_finite ? `, without ${non_finite} pixels that are NaN or infinite` : "");
};

/// What is not finite is in no error, so that a verdict on the rest says little.
export function writeNonFinite({result}) {
    const texts = (result?.shots ?? []).map(s => s.error).filter(e => e.non_finite)
                      .map(e => `${e.non_finite} of ${e.non_finite + e.pixels} in ${e.shot}`);
    at("non-finite").hidden = !texts.length;
    at("non-finite").textContent =
        `Reflective pixels are NaN or infinite: ${texts.join(", ")}. Errors and verdicts are about the other pixels alone.`;
}

export function writeShots({result}) {
    const shots = result?.shots ?? [], labels = (result?.verdicts ?? []).map(v => v.label);
    const errorOf = (shot, label) => shot.others.filter(o => o.label === label).map(errorText)[0] ?? "–";
    writeTable("shots", ["shot", "mse of reflective pixels, now", "its seeds", ...labels],
              shots.map(s => [s.shot, errorText(s), String(s.error.seeds), ...labels.map(label => errorOf(s, label))]));
}

/// What of a technique to look at, by the cause of an error.
const causeParts = {
    wrong_place: "hit",
    false_hit: "thickness",
    avoidable_miss: "thickness",
    unavoidable_miss: "screen",
    empty: "screen",
    right: "filter",
    untraced: "filter"
};

export function writeWhy({why, state}) {
    const causes = (why?.causes ?? []).filter(c => causeTexts[c.cause]).sort((a, b) => b.share - a.share);
    at("why-note").textContent = !why ? "ssrlab finds the causes after the errors are measured." :
        causes.length ? "Shares of the squared error in the first scene, by what became of each pixel's rays." :
                        "This technique uses no tracer of ssrlab, so its rays are not recorded.";
    at("causes").replaceChildren(...causes.map(({cause, share}) => {
        const width = 100 * Math.min(Math.max(share, 0), 1);
        const bar = h("span", {style: `width: ${width}%; background: var(--accent)`});
        const text = `${causeParts[cause]}: ${causeTexts[cause].replace("where ", "")}`;
        return h(
            "li", {"data-cause": cause}, h("span", {class: "share"}, percent(share, 2)),
            h("span", {class: "bar-room"}, bar), h("span", {}, text));
    }));
    at("causes").classList.toggle("is-old", Boolean(why) && why.state !== state);
}

export function writeTimes({times, state, size}) {
    const estimates = new Map((times?.estimates ?? []).map(e => [e.stage, e]));
    const [one] = estimates.values(), refusal = [...estimates.values()].find(e => e.refusal)?.refusal;
    const estimate = e => !e ? "" : e.microseconds === null ? "–" : `${number(e.microseconds)}${ends(e)} (${e.bound})`;
    writeTable("times", ["stage", "here, ms", one ? `${one.product}, estimated µs at ${size}` : "GPU"],
        (times?.stages ?? [])
            .map(t => [t.stage, number(t.median_ms) + ends({low: t.low_ms, high: t.high_ms}),
                     estimate(estimates.get(t.stage))]));
    const notes = (times?.effects ?? []).map(
        e => `${number(e.ratio)}${ends(e)} times the time of ${e.label}${e.verdict ? `: ${e.verdict}` : ""}`);
    if (refusal) notes.push(`No estimate of a GPU's time: ${refusal}`);
    if ([...estimates.values()].some(e => e.microseconds !== null))
        notes.push(`Intervals of estimates hold sampling alone: ${times.model_range}`);
    at("time-note").textContent = times ? notes.join("; ") : "ssrlab measures times after the errors.";
    at("times").classList.toggle("is-old", Boolean(times) && times.state !== state);
}

export function writeSeconds({seconds, result, samples, truths, scenes}) {
    at("truth-note").textContent = result?.is_coarse ?
        `Compared with a coarse truth of ${result.samples} samples per pixel. The truth of ${samples} samples is being path-traced.` :
        truths < scenes.length ? `The truth of ${scenes[truths]} is being path-traced.` : "";
    const parts = [["began", "began"], ["picture", "picture"], ["number", "interval"]]
                      .filter(([key]) => seconds[key] !== undefined)
                      .map(([key, name]) => `${name} after ${twoDecimals(seconds[key])} s`);
    at("seconds").textContent = parts.length ? `Since the last save: ${parts.join(", ")}.` : "";
}

export function writeKept({kept, out, is_to_be_kept, keep_note}) {
    writeTable("kept", ["version", "mse of reflective pixels"],
              kept.map(v => [v.name, v.shots.map(s => `${s.shot}: ${errorText(s)}`).join("; ")]));
    at("keep-note").textContent = is_to_be_kept ? "This version is kept as soon as its errors are measured." :
        keep_note ? keep_note : kept.length ? `To see all versions with their numbers, run: ssrlab report ${out}/kept` : "";
}

export function writeProblem({problem}) {
    at("problem").hidden = !problem;
    if (!problem) return at("problem").replaceChildren();
    at("problem").replaceChildren(
        h("pre", {}, problem.text), ...problem.places.flatMap(place => [
            h("div", {}, `${place.file}:${place.line}`),
            h("pre", {class: "place"}, ...place.lines.map(({number, text}) =>
                h("span", number === place.line ? {class: "at"} : {}, `${String(number).padStart(5)}  ${text}\n`)))
        ]));
}
