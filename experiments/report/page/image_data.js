// Images: from the page's text to half floats, and from those to display colours and error values.

/// The value of each of the 65536 half floats (IEEE 754 binary16).
const halfValues = Float32Array.from({length: 65536}, (_, bits) => {
    const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * (exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25));
});

const loading = new Map();

/// A promise of the image's description with `halves`: planes R, G, B of half-float bits.
function loadImage(index) {
    if (!loading.has(index)) loading.set(index, decodeImage(index));
    return loading.get(index);
}

/// Undoes encode_halves() of experiments/report/report_images.cpp.
async function decodeImage(index) {
    const text = atob(at("image-" + index).textContent);
    const packed = Uint8Array.from(text, c => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    for (let i = 1; i < bytes.length; ++i) bytes[i] = bytes[i] + bytes[i - 1] & 255;
    const count = bytes.length / 2;
    const halves = new Uint16Array(count);
    for (let i = 0; i < count; ++i) halves[i] = bytes[i] | bytes[count + i] << 8;
    const description = report.images[index];
    return {
        ...description,
        index,
        label: description.kind === "reference" ? "reference" : pointLabel(description),
        halves,
        pixels: description.width * description.height,
        scalars: {}
    };
}

function pixelRgb(image, i) { return [0, 1, 2].map(c => halfValues[image.halves[c * image.pixels + i]]); }

/// Rec. 709.
const luminance = rgb => 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];

/// What a false-colour mode shows of one pixel; `d` and `r` below are difference and reference per channel.
const scalarModes = {
    absolute: {
        title: "absolute error",
        formula: "mean over channels of |d|",
        of: (x, r) => (Math.abs(x[0] - r[0]) + Math.abs(x[1] - r[1]) + Math.abs(x[2] - r[2])) / 3
    },
    relative: {
        title: "relative error",
        formula: "mean over channels of |d| / sqrt(r² + 0.01)",
        of: (x, r) => [0, 1, 2].reduce((sum, c) => sum + Math.abs(x[c] - r[c]) / Math.sqrt(r[c] * r[c] + 0.01), 0) / 3
    },
    luminance: {title: "luminance", formula: "Rec. 709 luminance", of: x => luminance(x)},
};

/// One value per pixel, computed once.
function scalarsOf(image, reference, mode) {
    if (!image.scalars[mode]) {
        const {of} = scalarModes[mode];
        const values = new Float32Array(image.pixels);
        for (let i = 0; i < image.pixels; ++i)
            values[i] = of(pixelRgb(image, i), reference ? pixelRgb(reference, i) : null);
        image.scalars[mode] = values;
    }
    return image.scalars[mode];
}

/// The scale that all images of a mode share: the largest of their 99 % quantiles, so that single pixels do not darken
/// the rest.
function sharedMaximum(images, reference, mode) {
    let largest = 0;
    for (const image of images) {
        const all = scalarsOf(image, reference, mode);
        const step = Math.max(1, Math.floor(all.length / 20000));
        const sample = Float32Array.from({length: Math.floor(all.length / step)}, (_, i) => all[i * step])
                           .filter(Number.isFinite)
                           .sort();
        if (sample.length) largest = Math.max(largest, sample[Math.floor(0.99 * (sample.length - 1))]);
    }
    return largest > 0 ? largest : 1;
}

/// magma by Stefan van der Walt and Nathaniel Smith (matplotlib, CC0), every eighth entry, interpolated.
const magmaCodes =
    "000004 030312 0a0822 130d34 1d1147 29115a 36106b 440f76 51127c 5d177f 6a1c81 762181 832681 902a81 9c2e7f aa337d b73779 c23b75 cf4070 db476a e55064 ee5b5e f4695c f9785d fb8761 fd9668 fea571 feb47b fec287 fed194 fde0a1 fceeb0 fcfdbf"
        .split(" ")
        .map(code => [0, 2, 4].map(i => parseInt(code.slice(i, i + 2), 16)));
const magma = Array.from({length: 256}, (_, i) => {
    const at32 = i / 255 * 32, low = Math.min(Math.floor(at32), 31), t = at32 - low;
    return [0, 1, 2].map(c => Math.round(magmaCodes[low][c] * (1 - t) + magmaCodes[low + 1][c] * t));
});
const badColor = [255, 0, 255];  // NaN and infinity: a colour that no scale has

/// IEC 61966-2-1, as 0..255.
const srgbCode = v => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));

/// The display code of each half float at this exposure; 256 marks what is not finite.
function displayTable(exposure) {
    const gain = 2 ** exposure;
    return Uint16Array.from(halfValues, v => Number.isFinite(v) ? srgbCode(Math.min(Math.max(v * gain, 0), 1)) : 256);
}

/// RGBA pixels of an image in colour.
function colorPixels(image, table) {
    const out = new ImageData(image.width, image.height), {data} = out, {halves, pixels} = image;
    for (let i = 0; i < pixels; ++i) {
        const r = table[halves[i]], g = table[halves[pixels + i]], b = table[halves[2 * pixels + i]];
        const isBad = r === 256 || g === 256 || b === 256;
        data[4 * i] = isBad ? badColor[0] : r;
        data[4 * i + 1] = isBad ? badColor[1] : g;
        data[4 * i + 2] = isBad ? badColor[2] : b;
        data[4 * i + 3] = 255;
    }
    return out;
}

/// RGBA pixels of an image in false colour: 0 to `maximum` through magma.
function falseColorPixels(image, reference, mode, maximum) {
    const out = new ImageData(image.width, image.height), values = scalarsOf(image, reference, mode);
    for (let i = 0; i < image.pixels; ++i) {
        const v = values[i];
        const color = Number.isFinite(v) ? magma[Math.round(255 * Math.min(Math.max(v / maximum, 0), 1))] : badColor;
        out.data.set([color[0], color[1], color[2], 255], 4 * i);
    }
    return out;
}
