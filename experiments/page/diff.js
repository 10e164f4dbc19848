// The page of `ssrlab diff --page`: what changed from one run to another, in pictures and numbers. Images of both runs are
// those of two shots, "<shot> (old)" and "<shot> (new)", which the viewer shows beside each other.

import "./style.css";
import "./viewer/viewer.css";
import {at, clickable, folded, h, scroller} from "./elements/elements.js";
import {countCell, numberCell, numbers, table} from "./elements/tables.js";
import {falseColorPixels, putPixels} from "./images/colors.js";
import {scalarModes, scalarsOf, sharedMaximum} from "./images/differences.js";
import {whyNoImages} from "./images/packed.js";
import {startPage} from "./sections/start.js";
import {newShot, ofShot, oldShot, pointKey, pointLabel, report} from "./study/data.js";
import {number} from "./values.js";
import {addressedView} from "./viewer/keep.js";
import {imageCanvas, loadedImages} from "./viewer/page_images.js";
import {sameKey, truthKey, viewer} from "./viewer/state.js";
import {chooseShot, showViewer} from "./viewer/viewer.js";

const isOfChange = number => number.verdict === "changed";

function showDiff() {
    const {diff} = report;
    at("subtitle").textContent = `old: ${diff.before}, new: ${diff.after}`;
    const points = diff.points.length ?
        [h("h2", {}, "Points that differ"), h("p", {class: "note"}, diffNote(diff)), ...diff.points.map(diffBlock)] :
        [];
    at("diff").append(
        h("p", {id: "diff-lead"}, diffLead(diff)), scroller(verdictTable(diff.counts)), ...points, ...aloneParts(diff));
    if (!report.images.length) {
        at("viewer").remove();
        return undefined;
    }
    const first = diff.points.find(p => diffImages(p).every(Boolean));
    return Promise.resolve(showViewer()).then(() => addressedView() || !first ? undefined : openDiff(first));
}

function diffLead(diff) {
    const of = (changed, compared, what) => `${changed} of ${compared} ${what} changed significantly`;
    const pictures = diff.points.filter(p => p.images === "differ").length;
    return [
        of(diff.changed, diff.compared, "errors"),
        diff.compared_times ? of(diff.changed_times, diff.compared_times, "times") : null,
        `images of ${pictures} points differ`
    ].filter(Boolean).join("; ") + ".";
}

const diffNote = diff => [
    "The largest changes come first. Pictures show the shot's last frame, the first seed and the target " +
        `${diff.target}. Click a picture to open both runs in the viewer below.`,
    diff.without_room ? `The last ${diff.without_room} points have no pictures here, because a page has room for 30 MB.` : null,
    diff.moved.length ?
        `Times of ${diff.moved.map(m => m[0]).join(", ")} come from different machines and are not compared.` :
        null
].filter(Boolean).join(" ");

function verdictTable(counts) {
    const verdicts = counts[0]?.verdicts.map(v => v.verdict) ?? [];
    return table(
        ["Technique", ...numbers("Numbers", ...verdicts)],
        counts.map(c => [c.technique, countCell(c.numbers), ...c.verdicts.map(v => countCell(v.count))]),
        {sortable: true});
}

/// The point's image in both runs; undefined where the page has none.
const diffImages = ({shot, technique, point}) => [oldShot(shot), newShot(shot)].map(
    of => ofShot(report.images, of).find(i => i.technique === technique && i.point === point));

function diffBlock(point) {
    const changed = point.numbers.filter(isOfChange), others = point.numbers.filter(n => !isOfChange(n));
    const pictures = h("div", {class: "diff-pictures"});
    const block = h(
        "section", {class: "diff-point"}, h("h3", {}, `${pointLabel(point)}, ${point.shot}`),
        h("p", {class: "note"}, pointSummary(point, changed)), pictures,
        changed.length ? scroller(numberTable(changed)) : null,
        others.length ? folded(`${others.length} other numbers that are not equal`, scroller(numberTable(others))) : null);
    if (diffImages(point).every(Boolean))
        new IntersectionObserver((entries, observer) => {
            if (!entries.some(e => e.isIntersecting)) return;
            observer.disconnect();
            drawDiffPictures(pictures, point);
        }, {rootMargin: "50%"}).observe(block);
    return block;
}

const pointSummary = (point, changed) => [
    `${changed.length} numbers changed, ${point.equal} are equal`,
    {equal: "images are equal", differ: "images differ", none: "a run has no images of this point"}[point.images]
].join("; ") + ".";

function numberTable(changes) {
    const columns = [
        "Metric", "Target", "Pixels", "Frame", ...numbers("Old", "New", "New / old", "p (Holm)"), "Verdict", "By"
    ];
    const rows = changes.map(n => [
        n.metric, n.target, n.mask, n.frame, numberCell(n.before), numberCell(n.after),
        n.before && n.after !== null ? numberCell(n.after / n.before) : "–",
        numberCell(n.p_holm, 2), n.verdict, n.how
    ]);
    return table(columns, rows, {sortable: true});
}

async function drawDiffPictures(box, point) {
    const images = diffImages(point), label = `${pointLabel(point)}, ${point.shot}`;
    const canvases = [await imageCanvas(images[0], `${label}, old`), await imageCanvas(images[1], `${label}, new`)];
    if (!canvases.every(Boolean)) return box.replaceChildren(h("p", {class: "note"}, whyNoImages));
    const [before, after] = images.map(i => loadedImages.get(i.index)), hasSize = before.pixels === after.pixels;
    const names = ["Old", "New", "Difference"];
    if (hasSize) {
        const values = scalarsOf(after, before, "absolute"), maximum = sharedMaximum([[after, before]], "absolute");
        const isEqual = values.every(v => v === 0);
        const canvas = h("canvas", {role: "img", "aria-label": `${label}, difference`});
        canvases.push(putPixels(canvas, falseColorPixels(values, after, maximum)));
        names[2] += isEqual ? ": none" : `, 0 to ${number(maximum, 3)} (${scalarModes.absolute.formula})`;
    }
    box.replaceChildren(...canvases.map((canvas, i) => {
        clickable(canvas, () => openDiff(point, true));
        canvas.tabIndex = 0;
        canvas.title = "Open in the viewer";
        return h("figure", {}, h("figcaption", {}, names[i]), canvas);
    }));
}

/// Shows the point of both runs and their truth; differences are those from the old run.
async function openDiff(point, isAsked = false) {
    const key = pointKey(point), beside = newShot(point.shot);
    Object.assign(viewer, {shot: null, beside, baseKey: sameKey, layout: "side", chosen: [truthKey, key, `${beside}|${key}`]});
    if (isAsked) at("viewer").scrollIntoView();
    await chooseShot(oldShot(point.shot));
}

function aloneParts(diff) {
    const columns = ["Shot", "Point"];
    return [["the old run", diff.only_before], ["the new run", diff.only_after]].filter(([, points]) => points.length).map(
        ([where, points]) => folded(
            `${points.length} points of shots that only ${where} has: not compared`,
            scroller(table(columns, points.map(([shot, technique, point]) => [shot, pointLabel({technique, point})])))));
}

startPage(showDiff);

// What a browser's console reaches as `ssrlab`, and tests.
export * from "./images/differences.js";
export * from "./viewer/state.js";
