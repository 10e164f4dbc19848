// All methods at one pixel: value, error, confidence, what became of the ray, and what no single image can know.

import {at, h} from "../elements/elements.js";
import {cell, numberCell, numbers, table} from "../elements/tables.js";
import {luminance} from "../images/colors.js";
import {scalarModes} from "../images/differences.js";
import {pixelByte, pixelRgb} from "../images/packed.js";
import {verdicts} from "../study/verdicts.js";
import {number, percent, twoDecimals, unique} from "../values.js";
import {ladderImage, ladderIndices, rungDifference, rungDistances, verdictAt} from "./loss_maps.js";
import {loadedImages, loadImages} from "./page_images.js";
import {baseOf, hasBase, resultIndex, resultOf, truthKey, truthMethod, viewer} from "./state.js";

const inspected = {
    wanted: null,      // what images were asked for
    isWaiting: false,  // for some of them
};
const missingText = () => inspected.isWaiting ? "loading" : "not there";

/// The images behind a pixel's values: of all methods of the shot for the pinned one, of those shown for the one that
/// is pointed at; what is there is shown while the rest comes.
export async function loadForInspector() {
    const {request} = viewer, wanted = `${request} ${viewer.pinned ? "all" : "shown"}`;
    if (inspected.wanted === wanted) return;
    Object.assign(inspected, {wanted, isWaiting: true});
    const indices =
        inspectedMethods().flatMap(m => [resultIndex(m), m.confidence, m.roughness, ...m.verdicts.map(v => v.index)]);
    const missing = unique([...ladderIndices(), ...indices]).filter(i => i !== undefined && !loadedImages.has(i));
    for (let first = 0; first < missing.length; first += 8) {
        await loadImages(missing.slice(first, first + 8));
        if (request !== viewer.request || inspected.wanted !== wanted) return;
        showReadout();
    }
    inspected.isWaiting = false;
    showReadout();
}

const inspectedMethods = () => viewer.pinned ? viewer.methods : viewer.shown.map(s => s.method);

/// What became of a method's rays at a pixel, by pass where there are several; of these those that traced one.
function verdictText(method, i) {
    if (!method.verdicts.length) return "–";
    const images = method.verdicts.map(v => loadedImages.get(v.index));
    if (images.some(image => !image)) return missingText();
    const pass = ({stage}) => images.length > 1 ? stage.split("/").pop() + ": " : "";
    const texts = method.verdicts.flatMap((v, k) => {
        const found = verdicts.find(known => known.key === verdictAt(images[k], i));
        return found ? [pass(v) + found.name] : [];
    });
    return texts.join("; ") || "no ray";
}

const rgbText = rgb => rgb.map(v => number(v, 4)).join(", ");

/// The surface and the truth ladder at the pixel, in words.
function pixelFacts(i) {
    const facts = [];
    const surface = loadedImages.get(truthMethod()?.roughness);
    if (surface)
        facts.push(
            ["Roughness", Number.isFinite(pixelByte(surface, i)) ? twoDecimals(pixelByte(surface, i)) : "not finite"]);
    for (const rung of ["camera_radiance", "on_screen"]) {
        const image = ladderImage(rung), difference = rungDifference(rung, i);
        if (image) facts.push([`Rung ${rung} (incident)`, rgbText(pixelRgb(image, i))]);
        if (difference && rung === "on_screen")
            facts.push(["No single image can know", `${rgbText(difference)} of ${viewer.target}`]);
    }
    return facts;
}

/// The values of all images at the pinned or pointed pixel.
export function showReadout() {
    const place = viewer.pinned ?? viewer.pointed;
    if (!place || !viewer.shown.length) {
        at("readout").replaceChildren(
            h("p", {class: "note"}, "Point at an image to read all values of a pixel. Click, or press Enter, to pin the pixel."));
        return;
    }
    const i = place.y * viewer.shown[0].image.width + place.x;
    const unknowable = rungDistances()?.[i] ?? null;
    const columns = [
        "Image",
        ...numbers(
            "R", "G", "B", "Luminance", "Signed difference", "Absolute difference", "Relative error",
            ...(viewer.mode === "flip" ? ["FLIP"] : []), "Unknowable share", "Confidence"),
        "Ray"
    ];
    const flipCell = (image, ref) => {
        const values = ref && image.scalars.get("flip" + ref.index);  // of images that are shown
        return values ? numberCell(values[i], 4) : "–";
    };
    const rows = inspectedMethods().filter(m => resultIndex(m) !== undefined).map(method => {
        const image = resultOf(method);
        if (!image) return [method.label, missingText(), ...Array(columns.length - 2).fill("")];
        const rgb = pixelRgb(image, i), ref = baseOf(method), hasError = hasBase({method, image});
        const error = mode => hasError ? scalarModes[mode].of(rgb, pixelRgb(ref, i)) : null;
        const absolute = error("absolute"), confidence = loadedImages.get(method.confidence);
        const isOfTruth = viewer.baseKey === truthKey && method.shot === viewer.shot;
        const share = unknowable === null || !(absolute > 0) || !isOfTruth ?
            null :
            Math.min(unknowable / absolute, 1);
        return [
            method.label, ...rgb.map(v => numberCell(v, 5)), number(luminance(rgb), 5),
            cell(error("signed"), hasError && error("signed") > 0 ? "+" : "", number(error("signed"), 4)),
            numberCell(absolute, 5), numberCell(error("relative"), 4),
            ...(viewer.mode === "flip" ? [flipCell(image, ref)] : []), percent(share),
            confidence                          ? cell(pixelByte(confidence, i), twoDecimals(pixelByte(confidence, i))) :
                method.confidence === undefined ? "–" :
                                                  missingText(),
            verdictText(method, i)
        ];
    });
    at("readout").replaceChildren(
        table(columns, rows, {
            caption: `Pixel ${place.x}, ${place.y}${
                viewer.pinned ? " (pinned: click it again or press Enter to unpin)" : ""}`
        }),
        h("dl", {class: "pixel-facts", id: "pixel-facts"},
          pixelFacts(i).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value)))));
}
