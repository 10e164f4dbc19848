// What pointer and keys do to the viewer.

import {at} from "../elements/elements.js";
import {setSplit, stepFrame, togglePlaying} from "./chooser.js";
import {boxBetween, crops, moveCropBox, setCropBox, toggleCropMode} from "./crops.js";
import {loadForInspector, showReadout} from "./inspector.js";
import {toggleFullScreen} from "./keep.js";
import {reset, setExposure, setMode} from "./look.js";
import {createPane, limitView, pointerPlace, view, zoomAbout} from "./panes.js";
import {framesOf, viewer} from "./state.js";
import {drawAll, layOut, paint, setLayout} from "./viewer.js";

export function newPane() {
    const pane = createPane({
        wheel: event => {
            event.preventDefault();
            const {u, v} = pointerPlace(pane, event);
            zoomAbout(u, v, 2 ** (-event.deltaY / (event.deltaMode ? 10 : 300)));
            drawAll();
        },
        pointerdown: event => {
            pane.canvas.setPointerCapture(event.pointerId);
            const place = pointerPlace(pane, event), width = pane.canvas.getBoundingClientRect().width;
            const isAtSplit = pane.second && Math.abs(place.u - viewer.splitAt) * width < 10;
            const does = isAtSplit ? "split" : crops.isOn || event.shiftKey ? "crop" : "pan";
            viewer.drag = {x: event.clientX, y: event.clientY, hasMoved: false, does, from: place};
        },
        pointermove: event => {
            viewer.pointed = pointerPlace(pane, event);
            if (viewer.drag)
                drag(pane, event);
            else if (!viewer.pinned) {
                loadForInspector();
                showReadout();
            }
        },
        pointerup: event => {
            if (viewer.drag && !viewer.drag.hasMoved && viewer.drag.does !== "split") pin(pointerPlace(pane, event));
            viewer.drag = null;
        },
        pointercancel: () => {
            viewer.drag = null;
        },
    });
    return pane;
}

function drag(pane, event) {
    const {drag} = viewer, dx = event.clientX - drag.x, dy = event.clientY - drag.y;
    if (!drag.hasMoved && Math.hypot(dx, dy) < 3) return;  // a click of an unsteady hand
    drag.hasMoved = true;
    if (drag.does === "split") return setSplit(viewer.pointed.u);
    if (drag.does === "crop") return setCropBox(boxBetween(drag.from, viewer.pointed));
    const box = pane.canvas.getBoundingClientRect();
    moveView(-dx / box.width, -dy / box.height);
    Object.assign(drag, {x: event.clientX, y: event.clientY});
}

/// By parts of a pane.
function moveView(dx, dy) {
    view.x += dx / view.zoom;
    view.y += dy / view.zoom;
    limitView();
    drawAll();
}

export function pin(place) {
    const isSame = viewer.pinned && viewer.pinned.x === place.x && viewer.pinned.y === place.y;
    viewer.pinned = isSame ? null : {x: place.x, y: place.y};
    if (viewer.pinned) loadForInspector();
    drawAll();
}

function pinMiddle() {
    const {width, height} = viewer.shown[0].image;
    pin(viewer.pinned ??
        {x: Math.min(Math.floor(view.x * width), width - 1), y: Math.min(Math.floor(view.y * height), height - 1)});
}

/// `index` of the shown images.
export function showInPlace(index) {
    if (index < 0 || index >= viewer.shown.length) return;
    if (index !== viewer.active) viewer.previous = viewer.active;
    viewer.active = index;
    if (viewer.layout === "side") viewer.layout = "flip";
    layOut();
    at("viewer-status").textContent = `Showing ${viewer.shown[index].method.label}`;
}

function showNext(step) {
    const count = viewer.shown.length, {layout} = viewer;
    showInPlace(layout === "side" ? viewer.active : (viewer.active + step + count) % count);
}

const toggledMode = mode => setMode(viewer.mode === mode ? "color" : mode);

const zoomByKey = factor => {
    zoomAbout(0.5, 0.5, factor);
    drawAll();
};

function exposeByKey(step) {
    setExposure(viewer.exposure + step);
    paint();
}

function focusFilter() {
    at("chooser").open = true;
    at("chooser-filter").focus();
}

const viewerKeys = {
    "0": reset,
    "+": () => zoomByKey(1.5),
    "-": () => zoomByKey(1 / 1.5),
    "e": () => toggledMode("absolute"),
    "d": () => toggledMode("signed"),
    "v": () => toggledMode("flip"),
    "s": () => setLayout("side"),
    "x": () => setLayout("split"),
    "[": () => setSplit(viewer.splitAt - 0.05),
    "]": () => setSplit(viewer.splitAt + 0.05),
    "n": () => showNext(1),
    "p": () => showNext(-1),
    "<": () => exposeByKey(-0.25),
    ">": () => exposeByKey(0.25),
    ",": () => stepFrame(-1),
    ".": () => stepFrame(1),
    "k": () => framesOf(viewer.shot).length > 1 ? togglePlaying() : undefined,
    "c": toggleCropMode,
    "f": toggleFullScreen,
    "/": focusFilter,
};
// Those that a focused control needs for itself.
const paneKeys = {
    " ": () => showInPlace(viewer.previous),
    "Enter": pinMiddle,
};
const arrowKeys = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, -1],
    ArrowDown: [0, 1]
};

/// Keys work while the viewer has the focus or the pointer; those that a focused control needs are left to it.
export function viewerKey(event) {
    const section = at("viewer"), focused = document.activeElement;
    if (event.ctrlKey || event.metaKey || event.altKey || !(section.contains(focused) || section.matches(":hover")) ||
        !viewer.shown.length)
        return;
    const takesText = focused.matches("input[type=search], input[type=number], textarea");
    const isControl = focused.matches("input, select, button, textarea, summary, a");
    if (takesText) return;
    if (event.key >= "1" && event.key <= "9")
        showInPlace(Number(event.key) - 1);
    else if (viewerKeys[event.key])
        viewerKeys[event.key]();
    else if (paneKeys[event.key] && !isControl)
        paneKeys[event.key]();
    else if (arrowKeys[event.key] && !isControl)
        arrowKey(...arrowKeys[event.key], event.shiftKey);
    else
        return;
    event.preventDefault();
}

function arrowKey(dx, dy, isSizing) {
    if (crops.isOn && crops.box)
        moveCropBox(dx, dy, isSizing);
    else if (viewer.pinned)
        movePin(dx, dy);
    else
        moveView(0.1 * dx, 0.1 * dy);
}

function movePin(dx, dy) {
    const {width, height} = viewer.shown[0].image;
    viewer.pinned = {
        x: Math.min(Math.max(viewer.pinned.x + dx, 0), width - 1),
        y: Math.min(Math.max(viewer.pinned.y + dy, 0), height - 1)
    };
    drawAll();
}
