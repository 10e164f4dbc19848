// Images of the page: from its text, or from scripts beside it.

import {at, h} from "../elements/elements.js";
import {colorPixels, displayTable, putPixels} from "../images/colors.js";
import {decodeHalves, hasInflate, inflated} from "../images/packed.js";
import {report, shotExposure} from "../study/data.js";

const loading = new Map();  // index to promise
export const loadedImages = new Map();  // index to image
const imageTexts = new Map();  // of files, until they are decoded

/// The scripts of report_images/ call it.
window.registerImage = (file, text) => imageTexts.set(file, text);

/// A promise of the image's description with its pixels: `halves` (planes R, G, B of half-float bits) or `codes` (a
/// byte per pixel: see encode_bytes() and encode_palette() of experiments/report/image_encoding.h). It fails with a
/// sentence.
function loadImage(index) {
    if (!loading.has(index)) loading.set(index, decodeImage(index));
    return loading.get(index);
}

/// All of them; those that cannot be had are left out, and the first reason is shown.
export async function loadImages(indices) {
    const results = await Promise.allSettled(indices.map(loadImage));
    const failed = results.find(r => r.status === "rejected");
    if (failed) showImageProblem(failed.reason.message);
    return results.filter(r => r.status === "fulfilled").map(r => r.value);
}

async function decodeImage(index) {
    const description = report.images[index];
    const bytes =
        await inflated(description.file ? await linkedText(description.file) : at("image-" + index).textContent);
    const {shot, width, height} = description;
    const image = {...description, index, pixels: width * height, exposure: shotExposure(shot), scalars: new Map()};
    if (description.format === "halves")
        image.halves = decodeHalves(bytes, description);
    else
        image.codes = bytes;
    loadedImages.set(index, image);
    return image;
}

/// By a script element: a page that is a file may not fetch, but it may run scripts beside it.
function linkedText(file) {
    return new Promise((resolve, reject) => {
        const fail = () => reject(new Error(
            `${file} cannot be read. The images of this report are in the folder report_images beside the report: ` +
            "keep both together."));
        const script = h("script", {
            src: file.split("/").map(encodeURIComponent).join("/"),
            load: () => {
                script.remove();
                imageTexts.has(file) ? resolve(imageTexts.get(file)) : fail();
                imageTexts.delete(file);
            },
            error: () => {
                script.remove();
                fail();
            }
        });
        document.head.append(script);
    });
}

function showImageProblem(text) {
    at("viewer-problem").textContent = text;
    at("viewer-problem").hidden = false;
}

/// A canvas with the image as displays show it; null where it cannot be had. Without a label it is decoration.
export async function imageCanvas(image, label) {
    const pixels = image && hasInflate && await loadImage(image.index).catch(() => null);
    if (!pixels) return null;
    const canvas = h("canvas", {
        width: pixels.width,
        height: pixels.height,
        role: label && "img",
        "aria-label": label,
        "aria-hidden": label ? null : "true"
    });
    const codes = displayTable(pixels.exposure, "none");
    return putPixels(canvas, colorPixels(pixels, codes));
}
