// The page: plays the recorded frames, and shows them beside the truth.

import "./style.css";
import "./record/record.css";
import {at, factList, fillOptions, h, titlesOf} from "./elements/elements.js";
import {parameterRows} from "./elements/parameters.js";
import {fillTable} from "./elements/tables.js";
import {putPixels, toneCurves} from "./images/colors.js";
import {hasInflate, inflated, whyNoImages} from "./images/packed.js";
import {differenceFromRecorded, reflectedLight, relativeError, shown} from "./record/compare.js";
import {blockParameters, Replay} from "./record/replay.js";
import {decodeTexels} from "./record/texels.js";
import {grouped, number} from "./values.js";

const page = {
    replay: null,
    place: 0,        // of the frame that is shown
    isPlaying: false,
    times: [],       // of the GPU, ms
    results: null,   // of the frame that is shown
    look: {mode: "image", wipe: 0.5, gain: 1, curve: "none"},
    pictures: [document.createElement("canvas"), document.createElement("canvas")],
};

const frames = () => page.replay.recording.frames;
const isAsRecorded = () =>
    blockParameters(page.replay.recording).every(p => page.replay.values.get(p.name) === p.value);

/// Renders a frame, reads it, and says what its error is.
function showFrame(place) {
    const {replay} = page, frame = frames()[place], {texels} = replay;
    page.place = place;
    replay.show(place);
    replay.requireNoError();
    const values = of => texels[of].values, {width, height} = replay.recording.facts;
    const reflected = reflectedLight(replay, frame), confidence = replay.images.read(frame.confidence);
    page.results = {
        width,
        height,
        reflected,
        truth: values(frame.truth),
        lit: values(frame.lit),
        mask: values(frame.mask),
        confidence: Float32Array.from({length: width * height}, (_, i) => confidence[4 * i + frame.confidence_channel]),
        error: relativeError(reflected, values(frame.truth), values(frame.mask)),
        difference: isAsRecorded() ? differenceFromRecorded(replay, frame) : null,
    };
    at("frame").value = place;
    at("frame-number").value = `frame ${frame.number}`;
    paint();
    writeNumbers();
}

/// Draws both pictures anew; `drawWipe` alone, where only the wipe has moved.
function paint() {
    const {results, look, pictures} = page, {left, right, scale} = shown[look.mode];
    [left, right].forEach((picture, i) => putPixels(pictures[i], picture(results, look)));
    at("scale").textContent = scale ?? "";
    drawWipe();
}

function drawWipe() {
    const canvas = at("picture"), {width, height} = page.results, {wipe, mode} = page.look;
    const factor = Math.max(1, Math.round(1280 / width));
    if (canvas.width !== width * factor) Object.assign(canvas, {width: width * factor, height: height * factor});
    const context = canvas.getContext("2d"), edge = Math.round(wipe * width);
    context.imageSmoothingEnabled = false;
    const strip = (picture, x, to) => x < to &&
        context.drawImage(picture, x, 0, to - x, height, x * factor, 0, (to - x) * factor, height * factor);
    strip(page.pictures[0], 0, edge);
    strip(page.pictures[1], edge, width);
    context.fillStyle = "#fff";
    context.fillRect(edge * factor - 1, 0, 2, height * factor);
    canvas.setAttribute("aria-label", `${shown[mode].title}: the technique left of the line, the truth right of it`);
    at("wipe").value = 100 * wipe;
}

function writeNumbers() {
    const {results, place, replay} = page, frame = frames()[place], recorded = number(frame.error);
    at("error").textContent = isAsRecorded() ?
        `Error of this frame (relmse): ${number(results.error)}. Error of the recording on Vulkan: ${recorded}.` :
        `Error of this frame (relmse): ${number(results.error)}. Error with the recorded parameters: ${recorded}.`;
    const {difference} = results;
    at("difference").textContent = difference ?
        `${difference.differing} of ${difference.kept} pixels with reflections differ from the recording. ${
            difference.far} pixels differ by more than 0.01, at most by ${number(difference.largest)}.` :
        "";
}

/// A table of what each pass writes, each on recorded inputs, against what was recorded.
function writePasses() {
    const names = ["pass", "image", "pixels", "pixels that differ", "largest difference", "relative"];
    const rows = page.replay.checkPasses(page.place).map(r => [
        r.stage, `${r.image} (${r.format}${r.mip ? `, mip ${r.mip}` : ""})`, String(r.pixels), String(r.differing),
        number(r.largest), number(r.relative)
    ]);
    fillTable(at("passes"), names.map((name, i) => ({name, number: i > 1})), rows);
    showFrame(page.place);
}

/// The GPU reports a frame's time some frames later.
export function writeTimes() {
    const {replay, times} = page;
    times.push(...replay.times());
    if (times.length > 200) times.splice(0, times.length - 200);
    const sorted = [...times].sort((a, b) => a - b);
    at("time").textContent = !replay.timer ? "This browser has no GPU timer (EXT_disjoint_timer_query_webgl2)." :
        sorted.length                      ? `GPU time of a frame: ${number(sorted[sorted.length >> 1])} ms, median of ${sorted.length}.` :
                                             "GPU time of a frame: not measured yet.";
}

function play(isPlaying) {
    page.isPlaying = isPlaying;
    at("play").textContent = isPlaying ? "pause" : "play";
    at("play").setAttribute("aria-pressed", isPlaying);
}

let lastStep = 0;
function tick(now) {
    if (page.isPlaying && now - lastStep > 100) {
        lastStep = now;
        try {
            showFrame((page.place + 1) % frames().length);
        } catch (error) {
            showProblem(error);
        }
    }
    writeTimes();
    requestAnimationFrame(tick);
}

function listen() {
    const {look} = page;
    at("frame").max = frames().length - 1;
    at("frame").addEventListener("input", e => { play(false), showFrame(Number(e.target.value)); });
    at("play").addEventListener("click", () => play(!page.isPlaying));
    fillOptions(at("mode"), titlesOf(shown));
    fillOptions(at("curve"), titlesOf(toneCurves));
    at("mode").addEventListener("change", e => { look.mode = e.target.value, paint(); });
    at("curve").addEventListener("change", e => { look.curve = e.target.value, paint(); });
    at("exposure").addEventListener("input", e => { look.gain = 2 ** Number(e.target.value), paint(); });
    at("wipe").addEventListener("input", e => { look.wipe = Number(e.target.value) / 100, drawWipe(); });
    const drag = e => {
        if (!e.buttons) return;
        const box = at("picture").getBoundingClientRect();
        look.wipe = Math.min(Math.max((e.clientX - box.left) / box.width, 0), 1);
        drawWipe();
    };
    at("picture").addEventListener("pointerdown", drag);
    at("picture").addEventListener("pointermove", drag);
    at("check").addEventListener("click", writePasses);
    at("passes-room").hidden =
        !page.replay.recording.command_lists.some(commands => commands.some(command => command.check));
}

/// What the page is of. The rest of its text is in the template.
function writeFacts({facts, frames, command_lists, programs}) {
    const passes = command_lists[frames.at(-1).commands].filter(c => c.program !== undefined).length;
    const rows = {
        scene: `${facts.scene}, camera ${facts.camera}`,
        technique: `${facts.technique}, ${facts.point}`,
        frames: `${frames.length} of ${facts.width}x${facts.height}, each of ${passes} passes with ${programs.length} shaders`,
        "G-buffer": facts.is_packed ? "formats of engines (half floats, 8 bits)" : "float32",
        truth: `path-traced, ${facts.samples} samples per pixel, shown with ${facts.truth_significand_bits} bits`,
        "recorded on": facts.device,
        "ssrlab commit": facts.commit,
        "this browser": page.replay.renderer,
    };
    at("facts").replaceWith(factList(Object.entries(rows)));
}

/// The parameters that have no slider, by the reason.
function leftOut(parameters) {
    const reasons = grouped(parameters.filter(p => !p.is_slider), p => p.why_not);
    const names = some => some.map(p => `${p.name} = ${p.value}`).join(", ");
    return [...reasons].flatMap(([why, some]) => [h("dt", {}, why), h("dd", {}, names(some))]);
}

async function start() {
    const recording = JSON.parse(new TextDecoder().decode(await inflated(at("recording").textContent)));
    page.replay = new Replay(recording, await decodeTexels(recording.texels));
    writeFacts(recording);
    at("exposure").value = recording.facts.exposure_ev;
    page.look.gain = 2 ** recording.facts.exposure_ev;
    at("sliders").append(...parameterRows(recording.parameters.filter(p => p.is_slider), {
        original: p => p.value,
        origin: "as recorded",
        changed: (p, value) => {
            page.replay.set(p.name, value);
            showFrame(page.place);
        }
    }));
    at("left-out").append(...leftOut(recording.parameters));
    listen();
    showFrame(0);
    requestAnimationFrame(tick);
    document.documentElement.dataset.ready = "";
}

function showProblem(error) {
    play(false);
    at("problem").textContent = hasInflate ? error.message : whyNoImages;
    at("problem").hidden = false;
    document.documentElement.dataset.ready = "failed";
}

start().catch(showProblem);

export {at, frames, page, Replay, showFrame};  // for tests
