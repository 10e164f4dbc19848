// The first screen: what the scenes say together and each shot says, and for the chosen one its pictures, its errors
// against time, and why the chosen point errs.

import {icon, legend, legendGroups, styleOf} from "../charts/styles.js";
import {at, clickable, h, scroller} from "../elements/elements.js";
import {numberCell, numbers, table} from "../elements/tables.js";
import {drawBudget, showBudget} from "./budget.js";
import {costAxis, costBox, costListeners, errorTimeChart} from "./error_time.js";
import {showInMatrix} from "./explore.js";
import {hasInflate, whyNoImages} from "../images/packed.js";
import {drawWhy} from "../sections/error_shares.js";
import {pointListeners} from "../sections/parts.js";
import {answerChoice, answerOf, chosenPoint} from "../study/answers.js";
import {chipKinds, howEstimated, timedOn, timesOf, totalTime} from "../study/costs.js";
import {manifestShots, ofShot, pointKey, pointLabel, report, shortShot} from "../study/data.js";
import {headline, headlineMetrics, headlineRows, jodMetric} from "../study/errors.js";
import {allPoints} from "../study/points.js";
import {interval, number, percent, preferred, unique} from "../values.js";
import {addressedView} from "../viewer/keep.js";
import {imageCanvas} from "../viewer/page_images.js";
import {frameOf, viewer} from "../viewer/state.js";
import {chooseShot, openPoint} from "../viewer/viewer.js";

/// The sections below show the chosen shot, too.
function showShotBelow(shot) {
    for (const part of document.querySelectorAll("details.shot[data-shot]")) part.open = part.dataset.shot === shot;
    showInMatrix(shot);
    if (viewer.shot !== null && ofShot(report.images, shot).length) chooseShot(shot);
}

/// Resolves when the pictures are there.
export function showAnswers() {
    const shots = unique((report.errors.length ? report.errors : manifestShots()).map(r => r.shot));
    answerChoice.shot = preferred(shots, addressedView()?.get("shot"));
    const said = report.errors.length ?
        [report.inTheseScenes, report.inScenesLikeThese] :
        ["This study ran without truth, so it has no errors. Its other results stand below and in the tables beside this page."];
    const verdict = report.verdict ? verdictLines(report.verdict) : [];
    at("over-scenes").replaceChildren(...verdict, ...said.filter(Boolean).map(text => {
        const [, lead, rest] = text.match(/^(In these \d+ shots|In scenes like these|)(.*)$/s);
        return h("p", {}, lead ? h("b", {}, lead) : "", rest);
    }));
    pointListeners.push(drawAnswerCharts);
    costListeners.push(drawAnswerCharts);
    if (report.errors.length) at("answer-budget").append(costBox() ?? "");
    showBudget();
    return drawAnswers(shots);
}

/// A page of `ssrlab judge` begins with its verdict.
const verdictLines = ({headline, sentences}) =>
    [h("p", {id: "verdict"}, h("b", {}, headline)), h("ul", {}, ...sentences.map(text => h("li", {}, text)))];

function drawAnswers(shots) {
    const isChosen = shot => shot === answerChoice.shot;
    const choose = shot => () => {
        answerChoice.shot = shot;
        drawAnswers(shots);
        showShotBelow(shot);
        at("answer-shots").querySelector("[aria-pressed=true]").focus();
    };
    at("answer-shots").replaceChildren(...shots.map(
            shot =>
                h("li", {},
                  h("button", {
                      "aria-pressed": String(isChosen(shot)),
                      click: choose(shot),
                      title: [shot, answerOf(shot)?.sentence].filter(Boolean).join("\n")
                  },
                    h("b", {}, shortShot(shot)), " ",
                    isChosen(shot) || shots.length <= mostWhole ? answerText(shot) : answerInShort(shot),
                    isChosen(shot) && answerOf(shot)?.perceptual_sentence ?
                        h("small", {id: "answer-note"}, answerOf(shot).perceptual_sentence) :
                        ""))));
    drawAnswerCharts();
    return drawChosenPoint();
}

const mostWhole = 2;  // of more shots only the chosen one has its whole sentence

function answerText(shot) {
    if (report.errors.length) return answerOf(shot)?.sentence ?? "No technique is named.";
    const times = timesOf(shot).map(t => t.value);
    return `${allPoints.length} points` +
        (times.length ? `, ${number(Math.min(...times), 3)} to ${number(Math.max(...times), 3)} ms a frame` : "");
}

/// Where there is no room for its sentence.
function answerInShort(shot) {
    const answer = answerOf(shot), best = answer?.best;
    if (!best) return answer ? "Nothing is ranked." : answerText(shot);
    const count = (points, text) => points?.length ? `, ${points.length} ${text}` : "";
    return `${pointLabel(best)}, ${headline.metric} ${number(best.value, 3)} ${interval(best, 3)}` +
        count(answer.near, `within ${percent(headline.margin)}`) + count(answer.tied, "undecided");
}

export function drawAnswerCharts() {
    const {shot} = answerChoice, metrics = headlineMetrics();
    const size = {width: metrics.length > 1 ? 420 : 840, height: 320, open: choosePoint};
    const rows = [...metrics.map(metric => headlineRows(shot, metric)), headlineRows(shot, jodMetric(), "image")];
    const charts = rows.map(ofMetric => errorTimeChart(shot, ofMetric, size)).filter(Boolean);
    at("answer-charts").replaceChildren(...(metrics.length ? charts : [timeTable(shot)]));
    drawBudget(shot);
    markChosenPoint();
    const isUnnamed = row => charts.some(c => c.unnamed.some(m => pointKey(m) === pointKey(row)));
    const unnamed = metrics.length ? headlineRows(shot, metrics[0]).filter(isUnnamed) : [];
    at("answer-legend").replaceChildren(
            charts.length ? h("p", {class: "note"}, chartNote(shot)) : "",
            ...(unnamed.length ? [h("p", {class: "note"}, "Points without room for their names in a chart:"), legend(legendGroups(unnamed))] :
                                 []));
}

/// How the charts are read.
const chartNote = shot => (timesOf(shot).length || costAxis.kind !== "time" ? "Lower left is better. Dashed steps join the least errors within each time. " :
                                                  "Lower is better. ") + (jodMetric() ? "In JOD, higher is better. " : "") +
    (costAxis.kind in chipKinds ? `Times are estimates. ${howEstimated()} ` : "") +
    "[a, b] and lines at marks are 95 % intervals.";

/// Of a study without errors.
function timeTable(shot) {
    const rows = timesOf(shot).map(
        t => [h("span", {}, icon(styleOf(t)), pointLabel(t)), numberCell(t.value, 3), interval(t, 3)]);
    return rows.length ?
        scroller(table(
            ["Point", ...numbers(`Total time (ms), ${timedOn(shot)}`), "95 % interval"],
            rows)) :
        h("p", {class: "note"}, "No times were measured.");
}

/// The pictures, the marks and the reason follow the choice.
export function choosePoint({technique, point}) {
    answerChoice.point = {technique, point};
    return drawChosenPoint();
}

export function drawChosenPoint() {
    markChosenPoint();
    drawWhy(answerChoice.shot, chosenPoint());
    return drawAnswerPictures();
}

function markChosenPoint() {
    const chosen = chosenPoint(), isChosen = data => Boolean(chosen) && pointKey(data) === pointKey(chosen);
    for (const mark of document.querySelectorAll("#answer-charts .point"))
        mark.classList.toggle("chosen", isChosen(mark.dataset));
    for (const button of document.querySelectorAll("#answer-budget button"))
        button.setAttribute("aria-pressed", String(isChosen(button.dataset)));
}

/// [{title, text, image, row}]: truth, best, baseline, and the chosen point where it is another; all points of a study
/// without errors.
function answerPictures(shot) {
    const answer = answerOf(shot), metric = headline.metric, {point} = answerChoice;
    const of = (title, p) => p && {
        title: `${title}${pointLabel(p)}`,
        text: p.value === undefined ? "" : `${metric} ${number(p.value, 3)} ${interval(p, 3)}`,
        row: {shot, ...p},
        image: answerImage(shot, p)
    };
    const time = p => totalTime({shot, ...p});
    if (!report.errors.length)
        return allPoints.map(p => ({...of("", p), text: time(p) ? `${number(time(p).value, 3)} ms` : ""}));
    const named = [answer?.best, answer?.baseline].filter(Boolean);
    const isOther = point && !named.some(p => pointKey(p) === pointKey(point));
    return [
        {title: "truth", text: "", image: answerImage(shot, null)},
        of(`least ${metric}${answer?.tied?.length ? " measured" : ""}: `, answer?.best),
        of("baseline: ", answer?.baseline),
        isOther ? of("chosen: ", headlineRows(shot, metric).find(r => pointKey(r) === pointKey(point)) ?? point) : null
    ].filter(Boolean);
}

/// Of the shot's last frame; null: the truth.
export function answerImage(shot, point) {
    const images = ofShot(report.images, shot).filter(i => i.kind === "result" || i.kind === "reference");
    const last = Math.max(...images.map(frameOf).map(Number)), own = images.filter(i => Number(frameOf(i)) === last);
    const target = preferred(unique(own.map(i => i.target)), "image");
    return own.find(
        i => i.target === target &&
            (point ? i.kind === "result" && pointKey(i) === pointKey(point) : i.kind === "reference"));
}

export async function drawAnswerPictures() {
    const {shot} = answerChoice, wanted = answerPictures(shot), request = answerChoice.request = {};
    const hasPictures = wanted.some(p => p.image);
    at("answer-pictures").hidden = !hasPictures;
    if (!hasPictures) return;
    if (!hasInflate) return at("answer-pictures").replaceChildren(h("p", {class: "note"}, whyNoImages));
    const canvases = await Promise.all(wanted.map(p => imageCanvas(p.image, `${p.title}, ${shot}`)));
    if (answerChoice.request !== request) return;  // another choice was made meanwhile
    at("answer-pictures").style.setProperty("--columns", Math.min(Math.max(wanted.length, 3), 4));
    at("answer-pictures").replaceChildren(...wanted.map(({title, text, row}, i) => {
        const caption = h("figcaption", {}, h("b", {}, title), " ", h("small", {}, text)), canvas = canvases[i];
        if (!canvas)
            return h(
                "figure", {}, caption,
                h("p", {class: "note"}, "This image is in the results folder, not in this page."));
        if (row) {
            clickable(canvas, () => openPoint(row));
            canvas.tabIndex = 0;
            canvas.title = "Open in the viewer";
        }
        return h("figure", {}, caption, canvas);
    }));
}
