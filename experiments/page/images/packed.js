// Images as the C++ of ssrlab packs them, to half floats.

/// The value of each of the 65536 half floats (IEEE 754 binary16).
export const halfValues = Float32Array.from({length: 65536}, (_, bits) => {
    const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * (exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25));
});

export const hasInflate = typeof DecompressionStream !== "undefined";
export const whyNoImages = "Images need a browser of 2023 or later (DecompressionStream).";

/// The bytes of a stream that is deflated (zlib).
export const inflatedStream = async stream =>
    new Uint8Array(await new Response(stream.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());

/// The same of a text in base 64.
export function inflated(text) {
    const binary = atob(text), packed = new Uint8Array(binary.length);
    for (let i = 0; i < packed.length; ++i) packed[i] = binary.charCodeAt(i);
    return inflatedStream(new Blob([packed]).stream());
}

/// Fills a plane, row by row, from what each pixel differs by from the prediction of its neighbours (the median of left,
/// above, and left + above - corner): `codeAt(i)` is that difference, twice its size, less one where it is negative.
function undoPrediction(plane, width, codeAt) {
    for (let i = 0, x = 0; i < plane.length; ++i) {
        const left = x ? plane[i - 1] : 0, above = i < width ? 0 : plane[i - width], code = codeAt(i);
        let predicted = x ? left : above;
        if (x && i >= width) {
            const corner = plane[i - width - 1], low = Math.min(left, above), high = Math.max(left, above);
            predicted = corner >= high ? low : corner <= low ? high : left + above - corner;
        }
        plane[i] = predicted + (code >>> 1 ^ -(code & 1));
        if (++x === width) x = 0;
    }
    return plane;
}

/// Undoes encode_halves() of experiments/report/image_encoding.cpp.
export function decodeHalves(bytes, {width, height, significand_bits: kept = 10}) {
    const pixels = width * height, count = 3 * pixels;
    const planes = [0, pixels, 2 * pixels].map(
        start => undoPrediction(new Int16Array(pixels), width, i => bytes[start + i] | bytes[count + start + i] << 8));
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

/// Undoes encode_floats() of experiments/live/record/texel_stream.cpp: channels interleaved.
export function decodeFloats(bytes, {width, height, channels, shifts}) {
    const pixels = width * height, bits = new Int32Array(pixels * channels), plane = new Int32Array(pixels);
    for (let c = 0; c < channels; ++c) {
        const start = 4 * c * pixels, shift = shifts[c];
        const byte = (i, n) => bytes[start + n * pixels + i] << 8 * n;
        undoPrediction(plane, width, i => byte(i, 0) | byte(i, 1) | byte(i, 2) | byte(i, 3));
        plane.forEach((ordered, i) => {
            bits[i * channels + c] = (ordered < 0 ? ordered ^ 0x7fffffff >> shift : ordered) << shift;
        });
    }
    return new Float32Array(bits.buffer);
}

/// Of an image with `halves`.
export const pixelRgb = (image, i) => [0, 1, 2].map(c => halfValues[image.halves[c * image.pixels + i]]);

/// Of an image with `codes` of encode_bytes(): a number from 0 to 1, or NaN.
export const pixelByte = (image, i) => image.codes[i] === 255 ? NaN : image.codes[i] / 254;
