// Which pixel loses to what: the method that is nearest to the truth, and the cause of each method's error.

import {h, swatch} from "../elements/elements.js";
import {shareCell, table} from "../elements/tables.js";
import {categoryPixels, hexColor} from "../images/colors.js";
import {meanDistance, scalarsOf, sharedMaximum} from "../images/differences.js";
import {pixelRgb} from "../images/packed.js";
import {isLadderRung} from "../study/ladder.js";
import {verdicts} from "../study/verdicts.js";
import {percent} from "../values.js";
import {loadedImages} from "./page_images.js";
import {shownOfShot, truth, truthKey, truthMethod, viewer} from "./state.js";

/// Okabe and Ito's colours, distinct with all kinds of colour vision.
const categoryCodes = ["e69f00", "56b4e9", "009e73", "f0e442", "0072b2", "d55e00", "cc79a7", "ffffff"];
const darkGrey = [40, 40, 40], midGrey = [128, 128, 128];
const legendItem = (color, ...text) => h("span", {}, swatch(`rgb(${color})`), text);

/// What legend and pictures of one painting share, by name.
export const lossMaps = new Map();
function ofPainting(name, make) {
    if (!lossMaps.has(name)) lossMaps.set(name, make());
    return lossMaps.get(name);
}

/// Of the errors that a pixel's methods have, the second-best must be this much larger than the best for a winner.
const clearLead = 1.01;

/// For each pixel which of the shown methods has the least absolute difference: {pixels, names, colors, shares}.
export const nearestMap = () => ofPainting("nearest", () => {
    const ref = truth(), methods = shownOfShot().filter(s => s.method.key !== truthKey);
    const errors = methods.map(s => scalarsOf(s.image, ref, "absolute"));
    const alike = methods.length, places = new Uint16Array(ref.pixels), counts = new Array(alike + 1).fill(0);
    for (let i = 0; i < ref.pixels; ++i) {
        let best = Infinity, second = Infinity, winner = alike;
        errors.forEach((error, m) => {
            if (error[i] < best) {
                second = best;
                best = error[i];
                winner = m;
            } else if (error[i] < second)
                second = error[i];
        });
        places[i] = second > clearLead * best ? winner : alike;
        ++counts[places[i]];
    }
    // Where there are more methods than colours, those that win most often have one.
    const order = methods.map((_, m) => m).sort((a, b) => counts[b] - counts[a]).slice(0, categoryCodes.length);
    const colors = methods.map((_, m) => order.includes(m) ? hexColor(categoryCodes[order.indexOf(m)]) : midGrey);
    return {
        pixels: categoryPixels(places, ref, [...colors, darkGrey]),
        methods: methods.map(
            (s, m) =>
                ({label: s.method.label, color: colors[m], hasOwn: order.includes(m), share: counts[m] / ref.pixels})),
        alike: counts[alike] / ref.pixels
    };
});

export function nearestLegend() {
    if (!truth() || viewer.shown.length < 2) return [];
    const map = nearestMap(), named = map.methods.filter(m => m.hasOwn).sort((a, b) => b.share - a.share);
    const others = map.methods.filter(m => !m.hasOwn);
    return [
        h("p", {class: "note"},
          "The truth's pane shows which method has the least absolute difference at each pixel. " +
              "Percentages are shares of the pixels."),
        h("div", {class: "legend", id: "nearest-legend"},
          named.map(m => legendItem(m.color, `${m.label}: ${percent(m.share)}`)),
          others.length ?
              legendItem(midGrey, `${others.length} others: ${percent(others.reduce((sum, m) => sum + m.share, 0))}`) :
              null,
          legendItem(darkGrey, `two or more alike (within 1 %): ${percent(map.alike)}`))
    ];
}

// --- rays

const verdictKey = Object.fromEntries(verdicts.map(v => [v.color.slice(1), v.key]));
const codeOf = color => color.map(c => c.toString(16).padStart(2, "0")).join("");

/// What became of the pixel's first ray by an image of verdicts: a key of `verdicts`, or null where none was traced.
export function verdictAt(image, i) {
    image.verdicts ??= image.palette.map(color => verdictKey[codeOf(color)] ?? null);
    return image.verdicts[image.codes[i]];
}

/// The maps of a method's passes, those that traced more rays first.
function verdictImages(method) {
    const images = method.verdicts.map(v => loadedImages.get(v.index)).filter(Boolean);
    for (const image of images)
        image.traced ??= image.codes.reduce((sum, _, i) => sum + (verdictAt(image, i) !== null), 0);
    return images.sort((a, b) => b.traced - a.traced);
}

/// By the first of these images that has a ray there.
const firstVerdict = (images, i) => images.reduce((found, image) => found ?? verdictAt(image, i), null);

/// Where a pixel has no ray of its own, as with one ray for four pixels, that of its 2 x 2 pixels.
function verdictOfQuad(images, i) {
    const own = firstVerdict(images, i);
    if (own !== null || !images.length) return own;
    const {width, height} = images[0], x = i % width & ~1, y = Math.floor(i / width) & ~1;
    for (const [dx, dy] of [[0, 0], [1, 0], [0, 1], [1, 1]]) {
        if (x + dx >= width || y + dy >= height) continue;
        const verdict = firstVerdict(images, (y + dy) * width + x + dx);
        if (verdict !== null) return verdict;
    }
    return null;
}

export function verdictPicture(method) {
    const images = verdictImages(method);
    if (!images.length) return null;
    const places =
        Uint8Array.from(images[0].codes, (_, i) => verdicts.findIndex(v => v.key === firstVerdict(images, i)) + 1);
    const colors = [[0, 0, 0], ...verdicts.map(v => hexColor(v.color.slice(1)))];
    return {
        pixels: categoryPixels(places, images[0], colors),
        note: `first rays of ${images.map(i => i.target).join(", ")}`
    };
}

export const verdictMapLegend = () => [h(
    "div", {class: "legend"}, verdicts.map(v => legendItem(hexColor(v.color.slice(1)), v.name)),
    legendItem([0, 0, 0], "no ray"))];

// --- causes

/// The images that show what of an error no single frame can know; none without a truth ladder.
export function ladderIndices() {
    const {results} = truthMethod() ?? {results: {}};
    if (!("on_screen" in results)) return [];
    return ["on_screen", "camera_radiance", "incident", "specular"].map(t => results[t]).filter(i => i !== undefined);
}

export const ladderImage = target => loadedImages.get(truthMethod()?.results[target]);

/// How far the rung of the truth ladder is from the truth at a pixel, as [r, g, b] of the current target: what of an
/// error a single image of the scene cannot avoid. Of `specular` and `image` it is that of `incident` times the
/// surface's reflectance, as the truth's specular / incident has it. Null where the study has no such rung.
export function rungDifference(rung, i) {
    const [from, incident, specular] = [rung, "incident", "specular"].map(ladderImage);
    if (isLadderRung(viewer.target) || !from || !incident || !specular) return null;
    const low = pixelRgb(from, i), high = pixelRgb(incident, i);
    const factor =
        viewer.target === "incident" ? [1, 1, 1] : pixelRgb(specular, i).map((s, c) => high[c] > 0 ? s / high[c] : 0);
    return low.map((v, c) => (v - high[c]) * factor[c]);
}

/// Its size at each pixel; null where rungDifference() is.
export function rungDistances() {
    const rung = ladderImage("on_screen"), key = "distance " + viewer.target;
    if (!rung || !rungDifference("on_screen", 0)) return null;
    if (!rung.scalars.has(key))
        rung.scalars.set(
            key,
            Float32Array.from(
                {length: rung.pixels}, (_, i) => meanDistance(rungDifference("on_screen", i), [0, 0, 0])));
    return rung.scalars.get(key);
}

const causes = [
    ["off_screen", "not on the screen: no single image shows it", "56b4e9"],
    ["avoidable_miss", "ray missed what is on the screen", "f0e442"],
    ["wrong_place", "ray hit the wrong place", "e69f00"], ["false_hit", "ray hit what is not there", "cc79a7"],
    ["right", "ray was right: filter and shading", "009e73"],
    ["unavoidable_miss", "rightly missed: fallback and filter", "0072b2"],
    ["no_ray", "no ray: fallback and filter", "d55e00"], ["small", "hardly any error", "282828"]
];
const causePlace = Object.fromEntries(causes.map(([key], i) => [key, i]));
causePlace.empty = causePlace.unavoidable_miss;

const visibleError = 0.01;  // of the false-colour scale: below it a pixel has no cause to look for
const errorPairs = ref => shownOfShot().filter(s => s.image !== ref).map(s => [s.image, ref]);

/// For each pixel the cause of a method's error, and each cause's share of the sum of absolute differences.
const causeMap = (method, image) => ofPainting(method.key, () => {
    const ref = truth(), error = scalarsOf(image, ref, "absolute"), rays = verdictImages(method),
          limit = rungDistances();
    const maximum = ofPainting("maximum", () => sharedMaximum(errorPairs(ref), "absolute"));
    const places = new Uint8Array(image.pixels), sums = new Array(causes.length).fill(0);
    for (let i = 0; i < image.pixels; ++i) {
        const e = error[i];
        if (!Number.isFinite(e)) {
            places[i] = causePlace.small;
            continue;
        }
        const isUnknowable = limit && limit[i] >= 0.5 * e;
        const cause = isUnknowable ? causePlace.off_screen : causePlace[verdictOfQuad(rays, i)] ?? causePlace.no_ray;
        sums[cause] += e;
        places[i] = e < visibleError * maximum ? causePlace.small : cause;
    }
    const total = sums.reduce((a, b) => a + b, 0);
    return {places, shares: sums.map(s => total > 0 ? s / total : 0)};
});

export function causePicture(method, image) {
    if (method.key === truthKey || !truth()) return null;
    const colors = causes.map(([, , code]) => hexColor(code));
    return {pixels: categoryPixels(causeMap(method, image).places, image, colors), note: "cause of the error"};
}

export function causeLegend() {
    const methods = shownOfShot().filter(s => s.method.key !== truthKey);
    if (!truth() || !methods.length) return [];
    const own = causes.filter(([key]) => key !== "small");
    const columns = [
        "Share of its absolute error",
        ...own.map(([, name, code]) => ({name: legendItem(hexColor(code), name), number: true}))
    ];
    const rows = methods.map(s => {
        const {shares} = causeMap(s.method, s.image);
        return [s.method.label, ...own.map(([key]) => shareCell(shares[causePlace[key]]))];
    });
    const missing = [
        ...(ladderIndices().length ? [] :
                                     ["a truth ladder (the last frame of a study with the target on_screen has one)"]),
        ...(methods.some(s => s.method.verdicts.length) ? [] : ["judged rays (hits in the study)"])
    ];
    return [
        h("div", {class: "scroll", id: "cause-table"}, table(columns, rows)),
        h("p", {class: "note"},
          "Not on the screen: the rung on_screen of the truth ladder differs from the truth by half of the error " +
              "or more. Other causes say what became of the pixel's first ray, or of a ray of its 2 x 2 pixels. " +
              `Dark pixels have errors below ${percent(visibleError)} of the scale of absolute differences.` +
              (missing.length ? ` This frame lacks what is needed for all causes: ${missing.join(" and ")}.` : ""))
    ];
}
