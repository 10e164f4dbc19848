// Texels of the page, from their text to numbers.

/// All of them, each with its `values`, channels interleaved, rows from the top (experiments/live/record/recorder.h).
function decodeTexels(descriptions) {
    return Promise.all(descriptions.map(async (description, place) => {
        const bytes = await inflated(document.getElementById("texels-" + place).textContent);
        return description.shifts ? {...description, values: decodeFloats(bytes, description)} :
                                    {...description, channels: 3, values: decodeRounded(bytes, description)};
    }));
}

/// Undoes encode_floats() of experiments/live/record/texel_stream.cpp.
function decodeFloats(bytes, {width, height, channels, shifts}) {
    const pixels = width * height, bits = new Int32Array(pixels * channels), plane = new Int32Array(pixels);
    for (let c = 0; c < channels; ++c) {
        const start = 4 * c * pixels, shift = shifts[c];
        for (let i = 0, x = 0; i < pixels; ++i) {
            const at = start + i;
            const code = bytes[at] | bytes[at + pixels] << 8 | bytes[at + 2 * pixels] << 16 | bytes[at + 3 * pixels] << 24;
            const left = x ? plane[i - 1] : 0, above = i < width ? 0 : plane[i - width];
            let predicted = x ? left : above;
            if (x && i >= width) {
                const corner = plane[i - width - 1], low = Math.min(left, above), high = Math.max(left, above);
                predicted = corner >= high ? low : corner <= low ? high : left + above - corner;
            }
            const ordered = predicted + (code >>> 1 ^ -(code & 1)) | 0;
            plane[i] = ordered;
            bits[i * channels + c] = (ordered < 0 ? ordered ^ 0x7fffffff >> shift : ordered) << shift;
            if (++x === width) x = 0;
        }
    }
    return new Float32Array(bits.buffer);
}

/// RGB of what encode_halves() of the report wrote.
function decodeRounded(bytes, description) {
    const pixels = description.width * description.height, halves = decodeHalves(bytes, description);
    return Float32Array.from({length: 3 * pixels}, (_, i) => halfValues[halves[i % 3 * pixels + (i / 3 | 0)]]);
}
