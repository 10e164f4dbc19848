// Crops for figures: a box that is drawn on the images, and the list of boxes that `ssrlab figures DIR --choice FILE` reads.

import {at, h} from "../elements/elements.js";
import {copyText} from "../elements/files.js";
import {scalarsOf} from "../images/differences.js";
import {pointKey} from "../study/data.js";
import {number, unique} from "../values.js";
import {nameKeeping} from "./keep.js";
import {shownOfShot, truthKey, viewer} from "./state.js";
import {drawAll} from "./viewer.js";

export const crops = {
    isOn: false,
    box: null,  // [x, y, width, height] in pixels, y from the top
    list: []    // as figures.json has them
};
const mostCropPoints = 13;  // besides the truth: two rows of seven across a page

export function toggleCropMode() {
    crops.isOn = !crops.isOn;
    at("crop-mode").setAttribute("aria-pressed", crops.isOn);
    at("panes").classList.toggle("cropping", crops.isOn);
    if (crops.isOn && !crops.box) {
        setCropBox(worstBox());
    }
    showCrops();
}

/// Of the boxes of a quarter of the image's width and height, the one in which the methods shown beside the truth err
/// most together; in the middle, where there is no error to look at.
export function worstBox() {
    const {width, height} = viewer.shown[0].image, w = Math.max(width >> 2, 1), h = Math.max(height >> 2, 1);
    const truth = viewer.shown.find(s => s.method.key === truthKey);
    const others = shownOfShot().filter(s => s !== truth);
    const middle = [(width - w) >> 1, (height - h) >> 1, w, h];
    if (!truth || !others.length) return middle;
    const sums = new Float64Array((width + 1) * (height + 1));  // of all pixels above and to the left
    const errors = others.map(s => scalarsOf(s.image, truth.image, "absolute"));
    for (let y = 0; y < height; ++y)
        for (let x = 0, line = 0; x < width; ++x) {
            for (const values of errors)
                line += Number.isFinite(values[y * width + x]) ? values[y * width + x] : 0;
            sums[(y + 1) * (width + 1) + x + 1] = sums[y * (width + 1) + x + 1] + line;
        }
    const sumAt = (x, y) => sums[y * (width + 1) + x];
    let worst = middle, most = 0;
    for (let y = 0; y + h <= height; ++y)
        for (let x = 0; x + w <= width; ++x) {
            const sum = sumAt(x + w, y + h) - sumAt(x, y + h) - sumAt(x + w, y) + sumAt(x, y);
            if (sum > most) [worst, most] = [[x, y, w, h], sum];
        }
    return worst;
}

export function clearCropBox() {
    crops.box = null;
    if (crops.list.length || crops.isOn) showCrops();
    nameKeeping();
}

/// The pixels of both places, and all between.
export function boxBetween(a, b) {
    const x = Math.min(a.x, b.x), y = Math.min(a.y, b.y);
    return [x, y, Math.abs(a.x - b.x) + 1, Math.abs(a.y - b.y) + 1];
}

export function setCropBox([x, y, width, height]) {
    const {image} = viewer.shown[0], clamped = (v, low, high) => Math.min(Math.max(Math.round(v) || 0, low), high);
    const w = clamped(width, 1, image.width), h = clamped(height, 1, image.height);
    crops.box = [clamped(x, 0, image.width - w), clamped(y, 0, image.height - h), w, h];
    showCrops();
    drawAll();
}

export function moveCropBox(dx, dy, isSizing) {
    const [x, y, width, height] = crops.box;
    setCropBox(isSizing ? [x, y, width + dx, height + dy] : [x + dx, y + dy, width, height]);
}

/// The current box with all that its figure is to show.
function currentCrop() {
    const points = shownOfShot().filter(s => s.method.key !== truthKey)
                       .map(s => ({technique: s.method.technique, point: s.method.point}));
    return {
        shot: viewer.shot,
        frame: viewer.frame,
        target: viewer.target,
        box: crops.box,
        exposure: viewer.exposure,
        tone_curve: viewer.curve,
        points: points.slice(0, mostCropPoints)
    };
}

const cropsText = () => JSON.stringify({crops: crops.list}, null, 1) + "\n";
const cropPointsOf = list => unique(list.flatMap(c => c.points.map(pointKey)));

/// Why the current box cannot be added: what `ssrlab figures` would refuse. Empty if it can.
function whyNoCrop() {
    if (!crops.box) return "";
    const crop = currentCrop(), others = crops.list.filter(c => c.shot === crop.shot);
    const other = others.find(c => c.target !== crop.target || c.frame !== crop.frame);
    if (!crop.points.length) return "A crop needs at least one point beside the truth.";
    if (other) return `All crops of a shot share one figure, of target ${other.target} and frame ${other.frame}.`;
    if (cropPointsOf([...others, crop]).length > mostCropPoints)
        return `All crops of a shot share one figure, which has room for ${
            mostCropPoints} points: show the points of the other crops.`;
    return "";
}

function addCrop() {
    crops.list.push(currentCrop());
    showCrops();
}

async function copyCrops() {
    await copyText(at("crops-json").value);
    at("viewer-status").textContent = "Copied figures.json";
}

export function showCrops() {
    nameKeeping();
    const panel = at("viewer-crop");
    panel.hidden = !crops.isOn && !crops.box && !crops.list.length;
    if (panel.hidden) return;
    if (!panel.childElementCount) panel.append(cropEditor(), h("div", {id: "crop-list"}));
    const inputs = panel.querySelectorAll("input[type=number]");
    inputs.forEach((input, i) => {
        input.disabled = !crops.box;
        if (document.activeElement !== input) input.value = crops.box?.[i] ?? "";
    });
    at("crop-add").disabled = !crops.box || whyNoCrop() !== "";
    const extra = shownOfShot().filter(s => s.method.key !== truthKey).length - mostCropPoints;
    const ofExtra =
        extra > 0 ? `A figure has room for ${mostCropPoints} points, so the last ${extra} points are left out. ` : "";
    at("crop-note").textContent = ofExtra + whyNoCrop();
    at("crop-list").replaceChildren(...(crops.list.length ? cropList() : []));
}

/// One of the box's four numbers, by its place.
function cropInput(name, place) {
    const changed = event => {
        const box = [...crops.box];
        box[place] = Number(event.target.value);
        event.target.blur();
        setCropBox(box);
    };
    return h(
        "label", {}, name, h("input", {type: "number", min: place < 2 ? 0 : 1, id: "crop-" + name, change: changed}));
}

const cropEditor = () => h(
    "div", {class: "controls"}, h("b", {}, "Crop"), ["x", "y", "width", "height"].map(cropInput),
    h("button", {id: "crop-worst", click: () => setCropBox(worstBox())}, "Where errors are largest"),
    h("button", {id: "crop-add", click: addCrop}, "Add to figures.json"), h("span", {class: "note", id: "crop-note"}),
    h("span", {class: "note"}, "Drag on an image to draw another box."));

function cropList() {
    const lines = crops.list.map((crop, i) => {
        const points = crop.points.length === 1 ? "1 point" : `${crop.points.length} points`;
        const place = `${crop.shot}, ${crop.target}: [${crop.box.join(", ")}], ${number(crop.exposure)} EV`;
        const remove = () => {
            crops.list.splice(i, 1);
            showCrops();
        };
        return h("li", {}, `${place}, truth and ${points} `,
                 h("button", {"aria-label": `Remove crop ${i + 1}`, click: remove}, "×"));
    });
    const url = "data:application/json;charset=utf-8," + encodeURIComponent(cropsText());
    const text = h("textarea", {id: "crops-json", readonly: true, rows: 12, "aria-label": "figures.json"});
    text.value = cropsText();
    return [
        h("ol", {}, lines),
        h("div", {class: "controls"},
          h("a", {href: url, download: "figures.json", id: "crops-download"}, "Download figures.json"),
          h("button", {click: copyCrops}, "Copy"),
          h("span", {class: "note"}, "Then run ", h("code", {}, "ssrlab figures DIR --choice figures.json"),
            ", where DIR is the folder of this page.")),
        text
    ];
}
