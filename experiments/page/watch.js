// The page: waits for news, and shows them.

import "./style.css";
import "./watch/watch.css";
import {at, fillOptions, titlesOf} from "./elements/elements.js";
import {parameterRows} from "./elements/parameters.js";
import {toneCurves} from "./images/colors.js";
import {scalarModes} from "./images/differences.js";
import {
    writeKept, writeNonFinite, writeProblem, writeSeconds, writeShots, writeTimes, writeVerdicts, writeWhy
} from "./watch/numbers.js";
import {errorMaps, paintPictures, shownImages} from "./watch/pictures.js";

const page = {
    news: null,
    look: {shot: null, target: "image", beside: "truth", map: "relative", exposure: 0, curve: "none"},
    values: {},         // that sliders have changed
    declared: "",       // the parameters that have rows, as text
    isSending: false,   // values, of which the last that are chosen count
};

/// A request of the page; null where ssrlab does not answer.
async function asked(what, value) {
    try {
        const answer = await fetch(what, {
            method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(value)});
        return answer.ok ? (await answer.json()).refusal : "ssrlab refused the request of this page";
    } catch {
        return "ssrlab does not answer";
    }
}

async function sendValues() {
    if (page.isSending) return;
    page.isSending = true;
    for (let sent = null; sent !== JSON.stringify(page.values);) {
        sent = JSON.stringify(page.values);
        at("values-note").textContent = await asked("values", page.values);
    }
    page.isSending = false;
}

function changeValue(p, value) {
    if (value === p.initial)
        delete page.values[p.name];
    else
        page.values[p.name] = value;
    sendValues();
}

/// New rows only where the declaration has changed, or other values came from another page: a slider that is dragged
/// stays.
function writeSliders({parameters, values}) {
    const declared = JSON.stringify(parameters.map(({value, ...rest}) => rest));
    const isOwn = JSON.stringify(values) === JSON.stringify(page.values);
    if (page.declared === declared && (isOwn || page.isSending)) return;
    page.declared = declared;
    page.values = {...values};
    at("sliders").replaceChildren(...parameterRows(parameters.filter(p => p.is_read), {
        original: p => p.initial,
        origin: "as declared",
        changed: changeValue
    }));
    at("left-out").textContent = parameters.filter(p => !p.is_read).map(p => p.name).join(", ");
}

/// Keeps the choice where it is still one.
function fillChoice(id, choices, chosen) {
    const known = [...at(id).options].map(o => o.value + "\n" + o.textContent).join();
    if (known !== choices.map(([value, title]) => value + "\n" + title).join()) fillOptions(at(id), choices);
    const value = choices.some(([v]) => v === chosen) ? chosen : choices[0]?.[0];
    if (value !== undefined) at(id).value = value;
    return value;
}

function writeChoices(news) {
    const {look} = page, shots = (news.result?.shots ?? []).map(s => s.shot);
    look.shot = fillChoice("shot", shots.map(s => [s, s]), look.shot) ?? null;
    const labels = Object.keys(shownImages(news, look.shot)).filter(l => l !== "now");
    look.beside = fillChoice("beside", labels.sort((a, b) => (b === "truth") - (a === "truth")).map(l => [l, l]), look.beside) ?? "truth";
    const rays = Object.keys(news.why?.hits ?? {}).map(stage => [stage, `rays of ${stage}`]);
    look.map = fillChoice("map", [...errorMaps.map(mode => [mode, scalarModes[mode].title]), ...rays], look.map);
}

function paint() {
    paintPictures(page.news, page.look).catch(error => { at("errors-caption").textContent = error.message; });
}

function show(news) {
    page.news = news;
    document.title = `${news.technique} – ssrlab watch`;
    at("technique").textContent = news.technique;
    at("technique").title = news.folder;
    at("doing").textContent = news.doing;
    const isOld = Boolean(news.result) && news.result.state !== news.state;
    for (const id of ["verdicts", "shots"]) at(id).classList.toggle("is-old", isOld);
    at("keep").disabled = news.is_to_be_kept;
    for (const write of [writeProblem, writeVerdicts, writeNonFinite, writeShots, writeWhy, writeTimes, writeSeconds, writeKept, writeSliders, writeChoices])
        write(news);
    paint();
    document.documentElement.dataset.state = isOld ? "" : news.result?.is_coarse ? "coarse" : news.result?.state ?? "";
    document.documentElement.dataset.number = news.number;
}

async function follow() {
    for (let known = "";;) {
        try {
            const answer = await fetch("news?after=" + known);
            if (!answer.ok) throw new Error("refused");
            const news = await answer.json();
            at("ended").hidden = true;
            if (String(news.number) !== known) show(news);
            known = String(news.number);
        } catch {
            at("ended").hidden = false;
            await new Promise(resolve => setTimeout(resolve, 1000));
        }
    }
}

fillOptions(at("curve"), titlesOf(toneCurves));
for (const id of ["shot", "target", "beside", "map", "curve"])
    at(id).addEventListener("change", e => { page.look[id] = e.target.value, writeChoices(page.news), paint(); });
at("exposure").addEventListener("input", e => { page.look.exposure = Number(e.target.value), paint(); });
at("keep").addEventListener("click", async () => {
    at("keep").disabled = true;
    const refusal = await asked("keep", null);
    if (refusal) at("keep-note").textContent = refusal;
});
follow();

export {page};  // for tests
