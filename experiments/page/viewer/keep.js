// What a reader takes along from the viewer: the address that shows the same again, and the picture.

import {at, h} from "../elements/elements.js";
import {attempt, saveFile} from "../elements/files.js";
import {toneCurves} from "../images/colors.js";
import {budgetMilliseconds} from "../first_screen/budget.js";
import {report} from "../study/data.js";
import {setFrame, setSplit} from "./chooser.js";
import {crops, setCropBox} from "./crops.js";
import {pin} from "./input.js";
import {setExposure, setScale, viewerModes} from "./look.js";
import {limitView, view} from "./panes.js";
import {framesOf, shotsBeside, truthKey, viewer} from "./state.js";
import {layOut, paneColumns, showImages} from "./viewer.js";

const addressStart = "#viewer?";

/// All that decides what is seen, as a part of the address.
export function viewerAddress() {
    const numbers = (...values) => values.map(v => Number(v.toPrecision(6))).join(" ");
    const state = new URLSearchParams({shot: viewer.shot, frame: viewer.frame, target: viewer.target});
    for (const key of viewer.chosen) state.append("image", key);
    for (const key of ["mode", "layout", "baseKey", "curve"]) state.append(key, viewer[key]);
    state.append("view", numbers(view.zoom, view.x, view.y));
    state.append("look", numbers(viewer.exposure, viewer.scale, viewer.splitAt, Number(viewer.hasErrorRow)));
    state.append("pair", numbers(viewer.active, viewer.previous));
    if (at("viewer").getBoundingClientRect().top > innerHeight) state.append("top", 1);  // the reader is above it
    if (viewer.beside) state.append("beside", viewer.beside);
    if (viewer.pinned) state.append("pinned", numbers(viewer.pinned.x, viewer.pinned.y));
    if (crops.box) state.append("crop", numbers(...crops.box));
    if (budgetMilliseconds()) state.append("budget", numbers(budgetMilliseconds()));
    return addressStart + state;
}

/// Puts what is seen into the address, once the reader has changed it; a while later, as browsers allow few changes.
export function keepAddress() {
    if (!viewer.shown.length) return;
    clearTimeout(viewer.keeping);
    viewer.keeping = setTimeout(() => {
        const address = viewerAddress(), isFirst = viewer.address === null;
        if (address === viewer.address) return;
        viewer.address = address;
        // A page in a frame of another origin may not.
        if (!isFirst) attempt(() => history.replaceState(null, "", address));
    }, 250);
}

/// The state that the address holds; null where it holds none of this study.
export function addressedView() {
    if (!location.hash.startsWith(addressStart)) return null;
    const state = new URLSearchParams(location.hash.slice(addressStart.length));
    return report.images.some(i => i.shot === state.get("shot")) ? state : null;
}

/// What the controls begin with; chooseShot() and then restoreView() do the rest. Values that this page does not know
/// are left out.
export function restoreChoice(state) {
    const known = {mode: Object.fromEntries(viewerModes), layout: {side: 1, flip: 1, split: 1}, curve: toneCurves};
    for (const [key, values] of Object.entries(known))
        if (Object.hasOwn(values, state.get(key))) viewer[key] = state.get(key);
    Object.assign(viewer, {chosen: state.getAll("image"), target: state.get("target")});
    viewer.baseKey = state.get("baseKey") ?? truthKey;
    const beside = state.get("beside");
    viewer.beside = shotsBeside(state.get("shot")).includes(beside) ? beside : null;
}

export async function restoreView(state) {
    const numbers = (key, count) => {
        const values = (state.get(key) ?? "").split(" ").map(Number);
        return values.length === count && values.every(Number.isFinite) ? values : null;
    };
    const frame = framesOf(viewer.shot).find(f => String(f) === state.get("frame"));
    await (framesOf(viewer.shot).length > 1 && frame !== undefined ? setFrame(frame) : showImages());
    const [zoom, x, y] = numbers("view", 3) ?? [1, 0.5, 0.5];
    Object.assign(view, {zoom, x, y});
    limitView();
    const [exposure, scale, splitAt, hasErrorRow] = numbers("look", 4) ?? [viewer.exposure, 0, 0.5, 0];
    setExposure(exposure);
    setScale(scale);
    setSplit(splitAt);
    viewer.hasErrorRow = at("error-row").checked = hasErrorRow === 1;
    const pair = numbers("pair", 2), pinned = numbers("pinned", 2), box = numbers("crop", 4);
    if (pair?.every(i => viewer.shown[i])) [viewer.active, viewer.previous] = pair;
    layOut();
    if (box) setCropBox(box);
    if (pinned) pin({x: pinned[0], y: pinned[1]});
    if (!state.has("top")) at("viewer").scrollIntoView();
}

/// The panes as they are seen, with their captions, and the scale of their colours if they have one; of each the crop alone where there is
/// one.
export function shownPicture() {
    const {panes} = viewer,
          columns = viewer.layout === "side" ? Math.min(paneColumns(viewer.shown.length), panes.length) : 1;
    const {width} = panes[0].canvas, gap = 12, line = 24;
    const boxOf = pane => crops.box && !pane.second ? crops.box : [0, 0, pane.picture.width, pane.picture.height];
    const [, , boxWidth, boxHeight] = boxOf(panes[0]), height = Math.round(width * boxHeight / boxWidth);
    const rows = Math.ceil(panes.length / columns);
    const bar = at("color-bar"), below = rows * (height + line + gap) - gap;
    const canvas = h("canvas", {width: columns * (width + gap) - gap, height: below + (bar ? line + gap : 0)});
    const context = canvas.getContext("2d");
    context.fillStyle = "#fff";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.font = `14px ${getComputedStyle(document.body).fontFamily}`;
    context.fillStyle = "#000";
    context.imageSmoothingEnabled = false;
    panes.forEach((pane, i) => {
        const x = i % columns * (width + gap), y = Math.floor(i / columns) * (height + line + gap);
        context.fillText(pane.caption.textContent.replace(/^\d/, ""), x, y + 17, width);
        if (crops.box && !pane.second)
            context.drawImage(pane.picture, ...crops.box, x, y + line, width, height);
        else
            context.drawImage(pane.canvas, x, y + line, width, height);
    });
    if (bar) drawColorBar(context, bar, below + gap);
    return canvas;
}

/// The bar of the legend with the numbers at its ends, from `y` on.
function drawColorBar(context, bar, y) {
    const [low, colors, high] = bar.children, left = context.measureText(low.textContent).width + 8, width = 180;
    context.fillText(low.textContent, 0, y + 17);
    context.drawImage(colors, left, y + 6, width, 12);
    context.fillText(high.textContent, left + width + 8, y + 17, Math.max(context.canvas.width - left - width - 8, 1));
}

/// Says what is saved and copied.
export function nameKeeping() {
    for (const [id, does] of [["save-picture", "Save"], ["copy-picture", "Copy"]])
        if (at(id)) at(id).textContent = `${does} ${crops.box ? "crop" : "picture"}`;
}

const pictureBlob = () => new Promise(resolve => shownPicture().toBlob(resolve, "image/png"));

export async function savePicture() {
    saveFile(await pictureBlob(), `${viewer.shot}_${viewer.target}_${viewer.mode}.png`);
    at("viewer-kept").textContent = "Saved as PNG.";
}

export async function copyPicture() {
    const isCopied = await attempt(() => navigator.clipboard.write([new ClipboardItem({"image/png": pictureBlob()})]));
    at("viewer-kept").textContent = isCopied ? "Copied." : "This browser does not let the page copy pictures. Save the picture instead.";
}

export function toggleFullScreen() {
    return attempt(() => document.fullscreenElement ? document.exitFullscreen() : at("viewer").requestFullscreen());
}
