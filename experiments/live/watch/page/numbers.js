// Verdicts, errors, times, and why pixels are off.

const cells = (tag, row, first = tag) => row.map((text, i) => element(i ? tag : first, i ? {class: "number"} : {}, text));
const tableRow = (row, tag = "td") => element("tr", {}, ...cells(tag, row, tag === "td" ? "td" : "th"));

function fillTable(id, header, rows) {
    at(id).replaceChildren(...rows.length ? [element("thead", {}, tableRow(header, "th")),
                                             element("tbody", {}, ...rows.map(row => tableRow(row)))] :
                                            []);
}

const ends = ({low, high}) => low === null || high === null ? "" : ` [${fourDigits(low)}, ${fourDigits(high)}]`;

/// "no difference of less than 1.08 times would have been seen", of the view that says most.
function verdictText({verdict, why, views}) {
    if (verdict === "identical") return "all errors are the same to the last digit";
    if (!verdict) return why;
    return views
        .map(v => `${views.length > 1 ? v.shot + ": " : ""}${fourDigits(v.ratio)}${ends(v)} times its error${
                 v.verdict === "undecided" ? `; ${fourDigits(v.detectable)} times would be seen` : ""}`)
        .join("; ");
}

function writeVerdicts({result}) {
    at("verdicts").replaceChildren(...(result?.verdicts ?? []).map(said => {
        const name = said.verdict || "not decided";
        const card = element("div", {class: "verdict"}, element("small", {}, `against ${said.label}`),
                             element("b", {}, name), element("small", {}, verdictText(said)));
        card.classList.add(name.replaceAll(" ", "-"));
        card.dataset.against = said.label;
        card.dataset.verdict = said.verdict;
        return card;
    }));
}

const errorText = ({error, pixels, non_finite}) => {
    if (error.value === null) return non_finite && !pixels ? "every pixel is NaN or infinite" : "cannot be measured";
    const interval = ends(error) || ` (no interval yet: ${error.interval.replace("none: ", "")})`;
    return fourDigits(error.value) + interval + (non_finite ? `, without ${non_finite} pixels that are NaN or infinite` : "");
};

/// What is not finite is in no error, so that a verdict on the rest says little.
function writeNonFinite({result}) {
    const texts = (result?.shots ?? []).filter(s => s.non_finite).map(s => `${s.non_finite} of ${s.non_finite + s.pixels} in ${s.shot}`);
    at("non-finite").hidden = !texts.length;
    at("non-finite").textContent =
        `Reflective pixels are NaN or infinite: ${texts.join(", ")}. Errors and verdicts are of the others alone.`;
}

function writeShots({result}) {
    fillTable("shots", ["shot", "mse of reflective pixels", "seeds"],
              (result?.shots ?? []).map(s => [s.shot, errorText(s), String(s.seeds)]));
}

/// What the report says of them, by the same names.
const causeTexts = {
    wrong_place: ["hit", "rays hit the wrong place"],
    false_hit: ["thickness", "rays hit what is not there"],
    avoidable_miss: ["thickness", "rays missed what the screen shows"],
    unavoidable_miss: ["screen", "the truth is not on the screen"],
    empty: ["screen", "nothing is there to be hit"],
    right: ["filter", "rays were right: drawing, filter, fallback, view dependence"],
    untraced: ["filter", "no ray was traced"],
};

function writeWhy({why, state}) {
    const causes = (why?.causes ?? []).filter(c => causeTexts[c.cause]).sort((a, b) => b.share - a.share);
    at("why-note").textContent = !why ? "Found out once the errors are there." :
        causes.length                 ? "Shares of the squared error by what became of a pixel's rays, in the first scene." :
                                        "This technique's rays are not recorded: it traces none by a tracer of ssrlab.";
    at("causes").replaceChildren(...causes.map(({cause, share}) => {
        const bar = element("span", {});
        bar.style.width = `${Math.max(0, Math.min(100, 100 * share))}%`;
        bar.style.background = "var(--accent)";
        const [kind, text] = causeTexts[cause];
        return element("li", {"data-cause": cause}, element("span", {class: "share"}, `${Math.round(100 * share)} %`),
                       element("span", {class: "bar-room"}, bar), element("span", {}, `${kind}: ${text}`));
    }));
    at("causes").classList.toggle("is-old", Boolean(why) && why.state !== state);
}

function writeTimes({times, state}) {
    const estimates = new Map((times?.estimates ?? []).map(e => [e.stage, e]));
    const [one] = estimates.values(), refusal = [...estimates.values()].find(e => e.refusal)?.refusal;
    const estimate = e => !e ? "" : e.microseconds === null ? "–" : `${fourDigits(e.microseconds)}${ends(e)} (${e.bound})`;
    fillTable("times", ["stage", "here, ms", one ? `${one.product}, estimated µs` : "GPU"],
              (times?.stages ?? []).map(t => [t.stage, fourDigits(t.median) + ends(t), estimate(estimates.get(t.stage))]));
    const notes = (times?.effects ?? []).map(
        e => `${fourDigits(e.ratio)}${ends(e)} times the time of ${e.label}${e.verdict ? `: ${e.verdict}` : ""}`);
    if (refusal) notes.push(`No estimate of a GPU's time: ${refusal}`);
    if ([...estimates.values()].some(e => e.microseconds !== null))
        notes.push(`Intervals of estimates are of sampling alone: ${times.model_range}`);
    at("time-note").textContent = times ? notes.join("; ") : "Taken once the errors are there.";
    at("times").classList.toggle("is-old", Boolean(times) && times.state !== state);
}

function writeSeconds({seconds, result, samples, truths, scenes}) {
    at("truth-note").textContent = result?.is_coarse ?
        `Beside a coarse truth of ${result.samples} samples per pixel; ${samples} are being path traced.` :
        truths < scenes.length ? `The truth of ${scenes[truths]} is being path traced.` : "";
    const parts = [["began", "began"], ["picture", "picture"], ["number", "interval"]]
                      .filter(([key]) => seconds[key] !== undefined)
                      .map(([key, name]) => `${name} after ${seconds[key].toFixed(2)} s`);
    at("seconds").textContent = parts.length ? `From saving: ${parts.join(", ")}.` : "";
}

function writeKept({kept, out}) {
    fillTable("kept", ["version", "mse of reflective pixels"],
              kept.map(v => [v.name, v.shots.map(s => `${v.shots.length > 1 ? s.shot + ": " : ""}${errorText(s)}`).join("; ")]));
    at("keep-note").textContent = kept.length ? `All versions with their numbers: ssrlab report ${out}/kept` : "";
}

function writeProblem({problem}) {
    at("problem").hidden = !problem;
    if (!problem) return at("problem").replaceChildren();
    at("problem").replaceChildren(
        element("pre", {}, problem.text), ...problem.places.flatMap(place => [
            element("div", {}, `${place.file}:${place.line}`),
            element("pre", {class: "place"}, ...place.lines.map(({number, text}) =>
                element("span", number === place.line ? {class: "at"} : {}, `${String(number).padStart(5)}  ${text}\n`)))
        ]));
}
