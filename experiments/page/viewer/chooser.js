// Which images: shot, target, frame, and any number of methods, grouped by technique.

import {at, choiceBox, h, select} from "../elements/elements.js";
import {byShot, report} from "../study/data.js";
import {unique} from "../values.js";
import {crops, toggleCropMode} from "./crops.js";
import {showInPlace} from "./input.js";
import {copyPicture, nameKeeping, savePicture, toggleFullScreen} from "./keep.js";
import {setScale, showBases} from "./look.js";
import {framesOf, shotsBeside, truthKey, viewer} from "./state.js";
import {chooseBeside, chooseFrame, chooseShot, drawAll, layOut, setChosen, setLayout, showImages} from "./viewer.js";

export function showChoiceOfImages(targets) {
    const layouts = [["side", "Side by side"], ["flip", "Flip in place"], ["split", "Split"]];
    const others = shotsBeside(viewer.shot), names = viewer.methods.map(m => [m.key, m.label]);
    const chooseTarget = () => {
        setScale(0);
        return showImages();
    };
    const beside = () => select(
        "Beside it", [["", "no other shot"], ...others], viewer.beside ?? "", shot => chooseBeside(shot || null));
    at("viewer-choice").replaceChildren(
        select("Shot", [...byShot(report.images).keys()], viewer.shot, chooseShot),
        others.length ? beside() : "", choiceBox("Target", viewer, "target", targets, chooseTarget),
        h("span", {class: "button-row", role: "group", "aria-label": "Layout"},
          layouts.map(([key, name]) => h("button", {id: "layout-" + key, click: () => setLayout(key)}, name))),
        h("button", {id: "crop-mode", "aria-pressed": crops.isOn, click: toggleCropMode}, "Crop"),
        h("button", {id: "save-picture", click: savePicture}), h("button", {id: "copy-picture", click: copyPicture}),
        h("button", {id: "full-screen", click: toggleFullScreen}, "Full screen"), h("output", {id: "viewer-kept"}));
    nameKeeping();
    at("viewer-images").replaceChildren(h("div", {class: "controls", id: "viewer-chips"}), chooser());
    const input = event => setSplit(Number(event.target.value) / 100);
    at("viewer-pair").replaceChildren(
        select("Left", names, truthKey, key => pair("active", key)),
        select("Right", names, truthKey, key => pair("previous", key)),
        h("label", {}, "Split at",
          h("input", {type: "range", id: "split-at", min: 0, max: 100, value: 100 * viewer.splitAt, input})));
    showBases();
    showChosenImages();
}

/// Chooses an image of the pair; one that is not shown yet is from now on.
async function pair(which, key) {
    if (!viewer.chosen.includes(key)) await setChosen([...viewer.chosen, key]);
    viewer[which] = viewer.shown.findIndex(s => s.method.key === key);
    layOut();
}

export function showPair() {
    at("viewer-pair").hidden = viewer.layout !== "split";
    const [left, right] = at("viewer-pair").querySelectorAll("select");
    left.value = viewer.shown[viewer.active]?.method.key;
    right.value = viewer.shown[viewer.previous]?.method.key;
}

export function setSplit(place) {
    viewer.splitAt = Math.min(Math.max(place, 0), 1);
    at("split-at").value = 100 * viewer.splitAt;
    drawAll();
}

const manyPoints = 12;  // of a technique: they have the whole width

/// All methods with a box each, by technique; `filter` leaves those that hold all of its words.
function chooser() {
    const box = (method, hasShortName) => h(
        "label", {"data-key": method.key}, h("input", {
            type: "checkbox",
            checked: viewer.chosen.includes(method.key),
            change: event => choose([method.key], event.target.checked)
        }),
        hasShortName && method.shot === viewer.shot ? method.point || method.label : method.label);
    const groups = unique(viewer.methods.map(m => m.technique)).map(technique => {
        const own = viewer.methods.filter(m => m.technique === technique);
        const click = () => choose(listedKeys(own), !listedKeys(own).every(key => viewer.chosen.includes(key)));
        const all = h("button", {click, "aria-label": `all / none of ${technique}`}, "all / none");
        return h(
            "fieldset", {class: own.length > manyPoints ? "many" : null},
            h("legend", {}, technique === truthKey ? "truth" : technique, " ", own.length > 1 ? all : ""),
            own.map(method => box(method, own.length > 1)));
    });
    const input = event => filterChooser(event.target.value), listed = () => listedKeys(viewer.methods);
    return h(
        "details", {id: "chooser"}, h("summary", {id: "chooser-count"}),
        h("div", {class: "controls"},
          h("label", {}, "Filter", h("input", {type: "search", id: "chooser-filter", placeholder: "words of a name", input})),
          h("button", {id: "chooser-all", click: () => choose(listed(), true)}, "Show all listed"),
          h("button", {id: "chooser-none", click: () => choose(listed(), false)}, "Show none of them")),
        h("div", {class: "chooser-groups"}, groups));
}

const boxOf = key => at("chooser").querySelector(`label[data-key="${CSS.escape(key)}"]`);
export const listedKeys = methods => methods.filter(m => !boxOf(m.key).hidden).map(m => m.key);

export function choose(keys, isShown) {
    const others = viewer.chosen.filter(key => !keys.includes(key));
    return setChosen(isShown ? [...others, ...keys] : others);
}

export function filterChooser(text) {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    for (const method of viewer.methods)
        boxOf(method.key).hidden = !words.every(w => method.label.toLowerCase().includes(w));
    for (const group of at("chooser").querySelectorAll("fieldset"))
        group.hidden = !group.querySelector("label:not([hidden])");
}

/// What is shown, as chips, and the chooser's state.
export function showChosenImages() {
    const shownKeys = viewer.chosen.filter(key => viewer.methods.some(m => m.key === key));
    at("chooser-count").textContent = `Choose images: ${shownKeys.length} of ${viewer.methods.length} shown`;
    for (const method of viewer.methods)
        boxOf(method.key).querySelector("input").checked = viewer.chosen.includes(method.key);
    const current = viewer.layout === "side" ? null : viewer.shown[viewer.active]?.method.key;
    const focused = [...at("viewer-chips").querySelectorAll("button")].indexOf(document.activeElement);
    at("viewer-chips").replaceChildren(...shownKeys.map((key, i) => {
        const {label} = viewer.methods.find(m => m.key === key);
        return h(
            "span", {class: "chip"},
            h("button", {
                "aria-pressed": key === current ? "true" : "false",
                title: "Show in place",
                click: () => showInPlace(viewer.shown.findIndex(s => s.method.key === key))
            },
              i < 9 ? h("kbd", {}, String(i + 1)) : null, label),
            h("button", {"aria-label": `Remove ${label}`, title: "Remove", click: () => choose([key], false)}, "×"));
    }));
    const buttons = at("viewer-chips").querySelectorAll("button");
    if (focused >= 0 && buttons.length) buttons[Math.min(focused, buttons.length - 1)].focus();
}

/// The slider over the frames that have images, where there are several.
export function showTime() {
    const frames = framesOf(viewer.shot);
    at("viewer-time").hidden = frames.length < 2;
    if (frames.length < 2) return;
    const slider = h("input", {
        type: "range",
        id: "time",
        min: 0,
        max: frames.length - 1,
        step: 1,
        value: frames.indexOf(viewer.frame),
        "aria-valuetext": `frame ${viewer.frame}`,
        input: event => setFrame(frames[Number(event.target.value)])
    });
    at("viewer-time").replaceChildren(
        h("button", {id: "play", "aria-pressed": "false", click: togglePlaying}, "Play"),
        h("label", {}, "Frame", slider), h("output", {id: "time-text"}, String(viewer.frame)));
}

export function setFrame(frame) {
    const frames = framesOf(viewer.shot);
    at("time").value = frames.indexOf(frame);
    at("time").setAttribute("aria-valuetext", `frame ${frame}`);
    at("time-text").textContent = String(frame);
    return chooseFrame(frame);
}

/// `step` frames on, around the end.
export function stepFrame(step) {
    const frames = framesOf(viewer.shot);
    if (frames.length < 2) return;
    const place = (frames.indexOf(viewer.frame) + step + frames.length) % frames.length;
    return setFrame(frames[place]);
}

export async function playShot(shot) {
    at("viewer").scrollIntoView();
    await chooseShot(shot);
    if (at("panes").getBoundingClientRect().top > 0.7 * innerHeight) at("panes").scrollIntoView();  // in small windows
    if (!viewer.isPlaying) togglePlaying();
}

const playInterval = 200;  // ms between frames, longer where images must be loaded

export async function togglePlaying() {
    viewer.isPlaying = !viewer.isPlaying;
    const {shot} = viewer;
    while (viewer.isPlaying && viewer.shot === shot) {
        at("play").setAttribute("aria-pressed", "true");
        await Promise.all([stepFrame(1), new Promise(resolve => setTimeout(resolve, playInterval))]);
    }
    viewer.isPlaying = false;
    at("play")?.setAttribute("aria-pressed", "false");
}
