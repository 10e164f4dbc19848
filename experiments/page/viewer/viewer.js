// The viewer: which images are shown, and how.

import {at, h} from "../elements/elements.js";
import {compareCells} from "../elements/tables.js";
import {colorPixels, displayTable, falseColorPixels} from "../images/colors.js";
import {scalarModes, scalarsOf, sharedMaximum} from "../images/differences.js";
import {hasInflate, pixelByte, whyNoImages} from "../images/packed.js";
import {answerChoice, answerOf, baselineLabel} from "../study/answers.js";
import {otherRun, pointKey, pointLabel, report, shotExposure} from "../study/data.js";
import {headline, headlineRows} from "../study/errors.js";
import {isSingleChange} from "../study/points.js";
import {preferred, unique} from "../values.js";
import {showChoiceOfImages, showChosenImages, showPair, showTime} from "./chooser.js";
import {clearCropBox, crops, showCrops} from "./crops.js";
import {newPane, viewerKey} from "./input.js";
import {loadForInspector, showReadout} from "./inspector.js";
import {addressedView, keepAddress, restoreChoice, restoreView} from "./keep.js";
import {keyHelp, setExposure, setScale, showLegend, showLook} from "./look.js";
import {causePicture, ladderIndices, lossMaps, nearestMap, verdictPicture} from "./loss_maps.js";
import {loadedImages, loadImages} from "./page_images.js";
import {drawPane, setPane, view} from "./panes.js";
import {
    allMethods, baseMethod, baseOf, besideKey, firstShown, framesOf, hasBase, isError, jodMap, methodsOf, resultIndex,
    resultOf, sameKey, shotsBeside, targetsOf, truthKey, truthMethod, viewer
} from "./state.js";

/// What can stay beside `shot`; of two runs the other one of it.
function keepBeside(shot) {
    const before = viewer.beside, wanted = report.diff ? otherRun(shot) : before;
    viewer.beside = shotsBeside(shot).includes(wanted) ? wanted : null;
    if (!before || !viewer.beside) return;
    viewer.chosen = viewer.chosen?.map(key => key.startsWith(before + "|") ? besideKey(key.slice(before.length + 1)) : key);
}

/// Shows the same points of another shot beside those that are shown; null: of none.
export function chooseBeside(shot) {
    const chosen = viewer.chosen.filter(key => !viewer.beside || !key.startsWith(besideKey("")));
    if (!shot && viewer.baseKey === sameKey) viewer.baseKey = truthKey;
    viewer.beside = shot;
    viewer.chosen = shot ? chosen.flatMap(own => [own, besideKey(own)]) : chosen;
    return chooseFrame(viewer.frame);
}

export function showViewer() {
    if (!report.images.length) {
        at("viewer").append(h("p", {class: "note"}, "This study has no images."));
        return;
    }
    if (!hasInflate) {
        at("viewer").append(h("p", {class: "note"}, whyNoImages));
        return;
    }
    at("viewer").append(
        ...report.notes.map(text => h("p", {class: "warning", role: "note"}, text)),
        h("p", {class: "warning", id: "viewer-problem", role: "alert", hidden: true}),
        h("div", {class: "controls", id: "viewer-choice"}),
        h("div", {class: "controls", id: "viewer-time", hidden: true}),
        h("div", {class: "controls", id: "viewer-look"}), h("div", {id: "viewer-images"}),
        h("div", {class: "controls", id: "viewer-pair", hidden: true}),
        h("p", {class: "sr-only", id: "viewer-status", role: "status"}), h("div", {class: "panes", id: "panes"}),
        h("div", {id: "viewer-crop", hidden: true}),  // below the images, which stay where the pointer is
        h("div", {id: "viewer-legend"}), h("div", {class: "scroll", id: "readout", "aria-live": "off"}), keyHelp());
    const addressed = addressedView();
    if (addressed) restoreChoice(addressed);
    showLook();
    addEventListener("keydown", viewerKey);
    new ResizeObserver(drawAll).observe(at("panes"));
    const first = report.images.find(i => i.shot === answerChoice.shot) ?? report.images[0];
    const start = () => viewer.shot === null ? chooseShot(first.shot) : undefined;
    addEventListener("hashchange", () => addressedView() && location.reload());
    if (addressed) return chooseShot(addressed.get("shot")).then(() => restoreView(addressed));
    if (!report.images.some(i => i.file)) return start();
    // Images beside the page are loaded when the viewer is about to be seen.
    new IntersectionObserver((entries, observer) => {
        if (!entries.some(e => e.isIntersecting)) return;
        observer.disconnect();
        start();
    }, {rootMargin: "50%"}).observe(at("viewer"));
}

/// For the other sections: scrolls to the viewer and shows truth and points (as pointLabel() names them) side by side.
/// Points without images in this shot are left out. Resolves when they are there; false: nothing of them can be shown.
export async function openViewer({shot, points = [], target}) {
    if (!framesOf(shot).length || !at("viewer-choice")) return false;
    const own = methodsOf(shot, framesOf(shot).at(-1));
    const wanted =
        own.filter(m => points.includes(m.label)).sort((a, b) => points.indexOf(a.label) - points.indexOf(b.label));
    viewer.chosen = [truthKey, ...wanted.map(m => m.key)];
    viewer.beside = null;
    viewer.layout = "side";
    viewer.target = target ?? viewer.target;
    at("viewer").scrollIntoView();
    await chooseShot(shot);
    viewer.panes[0]?.canvas.focus({preventScroll: true});
    return true;
}

export function chooseShot(shot) {
    if (shot !== viewer.shot) {
        keepBeside(shot);
        Object.assign(viewer, {shot, pinned: null, pointed: null, frame: framesOf(shot).at(-1)});
        Object.assign(view, {x: 0.5, y: 0.5, zoom: 1});
        setScale(0);
        setExposure(shotExposure(shot));
        clearCropBox();
    }
    showTime();
    return chooseFrame(viewer.frame);
}

export function chooseFrame(frame) {
    viewer.frame = frame;
    viewer.methods = allMethods(frame);
    const targets = targetsOf(viewer.methods);
    viewer.target = preferred(targets, viewer.target ?? "image");
    const compared = viewer.methods.filter(m => m.shot === viewer.shot && (m.key === truthKey || !isSingleChange(m)));
    if (!viewer.methods.some(m => viewer.chosen?.includes(m.key))) viewer.chosen = firstKeys(compared);
    const choices = JSON.stringify([viewer.shot, viewer.beside, viewer.target, targets, viewer.methods.map(m => m.key)]);
    if (viewer.choices !== choices) showChoiceOfImages(targets);  // else the reader keeps filter and focus
    viewer.choices = choices;
    return showImages();
}

/// The truth and those of the least error, in the study's order.
function firstKeys(methods) {
    const errors =
        new Map(headlineRows(viewer.shot, headline.metric).map(r => [pointKey(r), r.badness]));
    const place = m => m.key === truthKey ? -Infinity : errors.get(m.key) ?? Infinity;
    const first = [...methods].sort((a, b) => compareCells(place(a), place(b), true)).slice(0, firstShown);
    return methods.filter(m => first.includes(m)).map(m => m.key);
}

/// What is to be there before the current choice can be painted.
function neededImages() {
    const chosen = viewer.methods.filter(m => viewer.chosen.includes(m.key));
    const methods = [...chosen, ...chosen.map(baseMethod), truthMethod()].filter(Boolean);
    const needed = methods.map(resultIndex);
    if (viewer.mode === "confidence") needed.push(...methods.map(m => m.confidence));
    if (viewer.mode === "jod") needed.push(...methods.map(m => m.jod));
    if (viewer.mode === "rays" || viewer.mode === "cause")
        needed.push(...methods.flatMap(m => m.verdicts.map(v => v.index)));
    if (viewer.mode === "cause") needed.push(...ladderIndices());
    return unique(needed.filter(i => i !== undefined));
}

/// Loads what is chosen, and shows it.
export async function showImages() {
    const request = ++viewer.request;
    const missing = neededImages().some(i => !loadedImages.has(i)), isFlip = viewer.mode === "flip";
    at("panes").setAttribute("aria-busy", missing || isFlip);
    await loadImages(neededImages());
    if (request !== viewer.request) return;  // another choice was made meanwhile
    setShown();
    if (isFlip)
        for (const {method, image} of viewer.shown.filter(hasBase)) {
            scalarsOf(image, baseOf(method), "flip");  // takes seconds for two megapixels
            await new Promise(resolve => setTimeout(resolve));
            if (request !== viewer.request) return;
        }
    at("panes").setAttribute("aria-busy", "false");
    layOut();
    if (viewer.pinned) loadForInspector();
}

function setShown() {
    const before = [viewer.active, viewer.previous].map(i => viewer.shown[i]?.method.key);
    viewer.shown = viewer.chosen.map(key => viewer.methods.find(m => m.key === key))
                       .filter(m => m && resultOf(m))
                       .map(method => ({method, image: resultOf(method)}));
    const place = (key, other) => {
        const found = viewer.shown.findIndex(s => s.method.key === key);
        return found < 0 ? Math.min(other, Math.max(viewer.shown.length - 1, 0)) : found;
    };
    viewer.active = place(before[0], 0);
    viewer.previous = place(before[1], 1);
    if (viewer.previous === viewer.active && viewer.shown.length > 1) viewer.previous = viewer.active ? 0 : 1;
}

/// `keys` are shown from now on, the truth first, then in the study's order.
export function setChosen(keys) {
    const isWanted = new Set(keys);
    viewer.chosen = viewer.methods.filter(m => isWanted.has(m.key)).map(m => m.key);
    showChosenImages();
    return showImages();
}

export function setLayout(layout) {
    viewer.layout = layout;
    layOut();
    viewer.panes[0]?.canvas.focus({preventScroll: true});
}

/// At most; few images share two rows, so that they are large.
export const paneColumns = count => count <= 3 ? Math.max(count, 1) : count <= 10 ? Math.ceil(count / 2) : 6;

/// Makes the panes that the layout asks for: one per image, with that of its error below it if asked for.
export function layOut() {
    const {layout, shown} = viewer;
    for (const name of ["side", "flip", "split"]) at("layout-" + name).setAttribute("aria-pressed", layout === name);
    at("panes").classList.toggle("single", layout !== "side");
    at("panes").style.setProperty("--columns", paneColumns(shown.length));
    if (shown.length) at("panes").style.setProperty("--aspect", shown[0].image.width / shown[0].image.height);
    showChosenImages();
    showPair();
    showCrops();
    const wantedOf = item => {
        const hasError = viewer.hasErrorRow && hasBase(item);
        return [{item, mode: viewer.mode}, ...(hasError ? [{item, mode: "absolute"}] : [])];
    };
    const current = shown[viewer.active];
    const columns = layout === "side" ? shown.map(wantedOf) :
        !current                      ? [] :
        layout === "flip"             ? [wantedOf(current)] :
                                        [[{item: current, mode: viewer.mode, other: shown[viewer.previous]}]];
    const wanted = columns.flat();
    const focused = viewer.panes.findIndex(p => p.canvas === document.activeElement);
    while (viewer.panes.length < wanted.length) viewer.panes.push(newPane());
    viewer.panes.length = wanted.length;
    viewer.panes.forEach((pane, i) => Object.assign(pane, {wanted: wanted[i]}));
    at("panes").replaceChildren(...columns.map(
        column => h("div", {}, viewer.panes.filter(p => column.includes(p.wanted)).map(p => p.element))));
    if (focused >= 0) (viewer.panes[focused] ?? viewer.panes[0])?.canvas.focus({preventScroll: true});
    paint();
}

/// What a mode shows of an image: {pixels, note}; `maximum` of a mode is its false-colour scale.
function pictureOf({method, image}, mode, table, maximumOf) {
    const inColor = note => ({pixels: colorPixels(image, table), note});
    if (mode === "nearest")
        return method.key === truthKey ? {pixels: nearestMap().pixels, note: "nearest method"} : inColor("");
    if (mode === "cause") return method.shot === viewer.shot && causePicture(method, image) || inColor("");
    if (mode === "rays") return verdictPicture(method) ?? inColor(method.key === truthKey ? "" : "no verdicts");
    if (mode === "confidence") {
        const own = loadedImages.get(method.confidence);
        if (!own) return inColor(method.key === truthKey ? "" : "no confidence");
        return {
            pixels: falseColorPixels(Float32Array.from(own.codes, (_, i) => pixelByte(own, i)), own, 1),
            note: "confidence"
        };
    }
    if (mode === "jod") {
        const map = jodMap(method);
        if (!map) return inColor(method.key === truthKey ? "" : "no JOD map of this image");
        const values = scalarsOf(map, null, mode);
        return {pixels: falseColorPixels(values, map, maximumOf(mode)), note: scalarModes[mode].title};
    }
    if (mode === "color" || isError(mode) && !hasBase({method, image})) return inColor("");
    const {title, isSigned} = scalarModes[mode], values = scalarsOf(image, baseOf(method), mode);
    return {pixels: falseColorPixels(values, image, maximumOf(mode), isSigned), note: title};
}

/// Fills the panes' pictures anew: colours depend on mode, exposure, curve and scale.
export function paint() {
    lossMaps.clear();
    const table = displayTable(viewer.exposure, viewer.curve), maxima = {};
    const scaledBy = mode => mode === "jod" ?
        viewer.shown.map(s => jodMap(s.method)).filter(Boolean).map(map => [map, null]) :
        viewer.shown.filter(s => !isError(mode) || hasBase(s)).map(s => [s.image, baseOf(s.method)]);
    const maximumOf = mode => maxima[mode] ??= 2 ** viewer.scale * sharedMaximum(scaledBy(mode), mode);
    for (const pane of viewer.panes) {
        const {item, mode, other} = pane.wanted;
        const picture = pictureOf(item, mode, table, maximumOf);
        const second = other ? pictureOf(other, mode, table, maximumOf) : null;
        const place = viewer.shown.indexOf(item);
        const caption = [
            place < 9 ? h("kbd", {}, String(place + 1)) : "", item.method.label,
            second ? " | " + other.method.label : "",
            picture.note || second?.note ? h("small", {}, " " + (picture.note || second.note)) : ""
        ];
        setPane(pane, item.image, picture.pixels, second?.pixels, caption, viewer.target);
    }
    showLegend(maximumOf);
    drawAll();
}

export function drawAll() {
    for (const pane of viewer.panes)
        if (pane.image) drawPane(pane, {pinned: viewer.pinned, splitAt: viewer.splitAt, box: crops.box});
    showReadout();
    keepAddress();
}

/// The viewer at that shot with the truth, this point and the best, or the baseline beside the best itself.
export function openPoint(row) {
    const best = answerOf(row.shot)?.best, isOther = best && pointLabel(best) !== pointLabel(row);
    const points = unique([pointLabel(row), isOther ? pointLabel(best) : baselineLabel(row.shot)].filter(Boolean));
    return openViewer({shot: row.shot, points});
}
