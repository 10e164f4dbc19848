// Texels of a recording, from the page's text to numbers.

import {at} from "../elements/elements.js";
import {decodeFloats, decodeHalves, halfValues, inflated} from "../images/packed.js";

/// All of them, each with its `values`, channels interleaved, rows from the top (experiments/live/record/recorder.h).
export function decodeTexels(descriptions) {
    return Promise.all(descriptions.map(async (description, place) => {
        const bytes = await inflated(at("texels-" + place).textContent);
        return description.shifts ? {...description, values: decodeFloats(bytes, description)} :
                                    {...description, channels: 3, values: decodeRounded(bytes, description)};
    }));
}

/// RGB of what encode_halves() of the report wrote.
function decodeRounded(bytes, description) {
    const pixels = description.width * description.height, halves = decodeHalves(bytes, description);
    return Float32Array.from({length: 3 * pixels}, (_, i) => halfValues[halves[i % 3 * pixels + (i / 3 | 0)]]);
}
