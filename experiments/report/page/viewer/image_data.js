// Images: from the page's text, or from scripts beside it, to half floats.

/// The value of each of the 65536 half floats (IEEE 754 binary16).
const halfValues = Float32Array.from({length: 65536}, (_, bits) => {
    const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * (exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25));
});

const hasInflate = typeof DecompressionStream !== "undefined";
const whyNoImages = "Images need a browser of 2023 or later (DecompressionStream).";
const loading = new Map();       // index to promise
const loadedImages = new Map();  // index to image
const imageTexts = new Map();    // of files, until they are decoded

/// Called by the scripts of report_images/.
function registerImage(file, text) { imageTexts.set(file, text); }

/// A promise of the image's description with its pixels: `halves` (planes R, G, B of half-float bits) or `codes` (a
/// byte per pixel: see encode_bytes() and encode_palette() of experiments/report/report_images.h). It fails with a
/// sentence.
function loadImage(index) {
    if (!loading.has(index)) loading.set(index, decodeImage(index));
    return loading.get(index);
}

/// All of them; those that cannot be had are left out, and the first reason is shown.
async function loadImages(indices) {
    const results = await Promise.allSettled(indices.map(loadImage));
    const failed = results.find(r => r.status === "rejected");
    if (failed) showImageProblem(failed.reason.message);
    return results.filter(r => r.status === "fulfilled").map(r => r.value);
}

async function decodeImage(index) {
    const description = report.images[index];
    const bytes =
        await inflated(description.file ? await linkedText(description.file) : at("image-" + index).textContent);
    const image = {...description, index, pixels: description.width * description.height, scalars: new Map()};
    if (description.format === "halves")
        image.halves = decodeHalves(bytes, description);
    else
        image.codes = bytes;
    loadedImages.set(index, image);
    return image;
}

async function inflated(text) {
    const binary = atob(text), packed = new Uint8Array(binary.length);
    for (let i = 0; i < packed.length; ++i) packed[i] = binary.charCodeAt(i);
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// By a script element: a page that is a file may not fetch, but it may run scripts beside it.
function linkedText(file) {
    return new Promise((resolve, reject) => {
        const fail = () => reject(new Error(
            `${file} cannot be read. The images of this report lie in the folder report_images beside it: ` +
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

/// Undoes encode_halves() of experiments/report/report_images.cpp.
function decodeHalves(bytes, {width, height, significand_bits: kept = 10}) {
    const pixels = width * height, count = 3 * pixels;
    const planes = [0, 1, 2].map(p => {
        const plane = new Int16Array(pixels);
        for (let i = 0, x = 0; i < pixels; ++i) {
            const code = bytes[p * pixels + i] | bytes[count + p * pixels + i] << 8;
            const left = x ? plane[i - 1] : 0, above = i < width ? 0 : plane[i - width];
            let predicted = x ? left : above;
            if (x && i >= width) {
                const corner = plane[i - width - 1], low = Math.min(left, above), high = Math.max(left, above);
                predicted = corner >= high ? low : corner <= low ? high : left + above - corner;
            }
            plane[i] = predicted + (code >> 1 ^ -(code & 1));
            if (++x === width) x = 0;
        }
        return plane;
    });
    const halves = new Uint16Array(count), dropped = 10 - kept;
    const bits = ordered => ordered < 0 ? 0x8000 | -1 - ordered << dropped : ordered << dropped;
    for (let i = 0; i < pixels; ++i) {
        const green = planes[0][i];
        halves[i] = bits(planes[1][i] + green << 16 >> 16);
        halves[pixels + i] = bits(green);
        halves[2 * pixels + i] = bits(planes[2][i] + green << 16 >> 16);
    }
    return halves;
}

function pixelRgb(image, i) { return [0, 1, 2].map(c => halfValues[image.halves[c * image.pixels + i]]); }

/// Of an image with `codes` of encode_bytes(): a number from 0 to 1, or NaN.
const pixelByte = (image, i) => image.codes[i] === 255 ? NaN : image.codes[i] / 254;
