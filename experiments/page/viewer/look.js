// How images are shown: mode, exposure, tone curve, scale; and the legend of what is seen.

import {at, choiceBox, h, select, titlesOf} from "../elements/elements.js";
import {diverging, magma, toneCurves} from "../images/colors.js";
import {scalarModes} from "../images/differences.js";
import {report, shotExposure} from "../study/data.js";
import {number} from "../values.js";
import {causeLegend, nearestLegend, verdictMapLegend} from "./loss_maps.js";
import {view, zoomAbout} from "./panes.js";
import {hasBase, isError, jodMap, ownWords, sameKey, truthKey, viewer} from "./state.js";
import {drawAll, layOut, paint, showImages} from "./viewer.js";

export const viewerModes = [
    ["color", "colour"], ["absolute", "absolute difference"], ["signed", "signed difference"],
    ["relative", "relative error"], ["flip", "FLIP"], ["jod", "visible difference (JOD)"], ["luminance", "luminance"], ["nearest", "which method is nearest to the truth"],
    ["cause", "cause of the error"], ["rays", "where rays ended"], ["confidence", "confidence"]
];

/// A study that measures no JOD has none.
const hasJodMaps = () => report.images.some(i => i.kind === "jod");

const lookRange = (id, label, size, set) => {
    const input = event => {
        set(Number(event.target.value));
        paint();
    };
    return h(
        "label", {}, label, h("input", {type: "range", id, step: 0.25, min: -size, max: size, input}),
        h("output", {id: id + "-value"}));
};

export function showLook() {
    const zoom = (text, label, factor) => {
        const click = () => {
            zoomAbout(0.5, 0.5, factor);
            drawAll();
        };
        return h("button", {click, "aria-label": label}, text);
    };
    const change = event => {
        viewer.hasErrorRow = event.target.checked;
        layOut();
    };
    at("viewer-look").append(
        select("Show", viewerModes.filter(([mode]) => mode !== "jod" || hasJodMaps()), viewer.mode, setMode), h("span", {id: "viewer-base"}),
        h("label", {}, h("input", {type: "checkbox", id: "error-row", change}), "absolute difference below"),
        lookRange("exposure", "Exposure (EV)", 10, setExposure),
        choiceBox("Tone curve", viewer, "curve", titlesOf(toneCurves), paint),
        lookRange("scale", "False-colour scale", 6, setScale), zoom("+", "Zoom in", 1.5),
        zoom("−", "Zoom out", 1 / 1.5), h("button", {id: "reset", click: reset}, "Reset view"));
}

const baseNames = () =>
    [...viewer.methods.map(m => [m.key, m.label]),
     ...(viewer.beside ? [[sameKey, `the same point, ${ownWords(viewer.shot, viewer.beside)}`]] : [])];

/// What differences are taken against: the truth, or any other image.
export function showBases() {
    at("viewer-base").replaceChildren(choiceBox("Against", viewer, "baseKey", baseNames(), showImages));
}

export function setMode(mode) {
    viewer.mode = mode;
    at("viewer-look").querySelector("select").value = mode;
    // The map of the nearest method stands in the truth's place.
    if (mode === "nearest" && !viewer.chosen.includes(truthKey)) viewer.chosen = [truthKey, ...viewer.chosen];
    return showImages();
}

export function setExposure(value) {
    viewer.exposure = Math.min(Math.max(value, -10), 10);
    at("exposure").value = viewer.exposure;
    at("exposure-value").textContent = (viewer.exposure > 0 ? "+" : "") + number(viewer.exposure);
}

/// `value`: the logarithm of what the scale is multiplied by, to the base of 2.
export function setScale(value) {
    viewer.scale = value;
    at("scale").value = value;
    at("scale-value").textContent = "× " + number(2 ** value, 3);
}

export function reset() {
    Object.assign(view, {x: 0.5, y: 0.5, zoom: 1});
    viewer.pinned = null;
    setScale(0);
    setExposure(shotExposure(viewer.shot));
    paint();
}

/// Explains the colours of the current mode; `maximumOf` gives false colour's scale.
export function showLegend(maximumOf) {
    const curve = viewer.curve === "none" ? "clipped at 1" : `tone curve ${toneCurves[viewer.curve].title}`;
    const shownAs = `${viewer.shot}${at("viewer-time").hidden ? "" : `, frame ${viewer.frame}`}, ${
        viewer.target}; exposure ${at("exposure-value").textContent} EV, ${
        curve} (they change the display only). Magenta pixels are not finite.`;
    const isPlayed = viewer.shown.some(s => s.image.kind === "played");
    const ofPlayed = isPlayed ? " This frame was kept for playing: this page has only its reflections, rounded to 1.6 %." : "";
    const parts = viewer.mode === "nearest" ? nearestLegend() :
        viewer.mode === "cause"             ? causeLegend() :
        viewer.mode === "rays"              ? verdictMapLegend() :
                                              [];
    const scaled = scalarModes[viewer.mode] ? viewer.mode : viewer.hasErrorRow ? "absolute" : null;
    const hasBar = scaled && viewer.shown.length && (!isError(scaled) || viewer.shown.some(hasBase)) &&
        (scaled !== "jod" || viewer.shown.some(s => jodMap(s.method)));
    at("viewer-legend").replaceChildren(...(hasBar ? [colorBar(scaled, maximumOf)] : []), ...parts, h("p", {class: "note"}, shownAs + ofPlayed));
}

function colorBar(mode, maximumOf) {
    const {formula, isSigned} = scalarModes[mode];
    const maximum = mode === "confidence" ? 1 : maximumOf(mode);
    const bar = h("canvas", {width: 256, height: 1, role: "img", "aria-label": "Colour scale"});
    const context = bar.getContext("2d");
    (isSigned ? diverging : magma).forEach((color, i) => {
        context.fillStyle = `rgb(${color})`;
        context.fillRect(i, 0, 1, 1);
    });
    const against = isError(mode) && viewer.baseKey !== truthKey ?
        ` against ${new Map(baseNames()).get(viewer.baseKey)}` :
        "";
    return h(
        "p", {class: "color-bar", id: "color-bar"}, h("span", {}, isSigned ? `−${number(maximum, 3)}` : "0"), bar,
        h("output", {id: "scale-text"}, `${number(maximum, 3)} (${formula}${against}; one scale for all)`));
}

export function keyHelp() {
    const keys = [
        ["1…9", "show one image in place (in a split: on the left)"], ["Space", "show the previous image in place"],
        ["n p", "show the next or previous image in the list"], ["s", "side by side"], ["x", "split"], ["[ ]", "move the split"],
        ["e", "absolute difference"], ["d", "signed difference"], ["v", "FLIP"], ["+ -", "zoom; the wheel zooms at the pointer"],
        ["← ↑ → ↓", "move the pinned pixel; without one, the view"], ["Enter", "pin the pixel in the middle, or unpin"],
        ["< >", "exposure"], [", .", "previous or next frame"], ["k", "play, or stop"],
        ["c", "crop; arrows move the box, Shift and arrows size it"], ["f", "full screen"], ["/", "filter the images"],
        ["0", "reset the view"]
    ];
    return h(
        "details", {id: "viewer-keys"}, h("summary", {}, "Keys"),
        h("p", {class: "note"},
          "Keys work while the viewer has the focus or the pointer. " +
              "Drag to pan, click to pin a pixel, hold Shift and drag to draw a crop. The address of the page holds the " +
              "current view: keep or send the address to open the same view."),
        h("dl", {class: "keys"},
          keys.map(
              ([own, what]) =>
                  h("div", {}, h("dt", {}, own.split(" ").map(key => h("kbd", {}, key))), h("dd", {}, what)))));
}
