// From what a frame's passes left behind to reflected light, its error, and pictures.

import {falseColorPixels, lightPixels} from "../images/colors.js";
import {scalarModes} from "../images/differences.js";

/// The technique's light in the image, RGB: the split-sum reflectance times a mix of fallback and what the technique
/// found (core/gbuffer/composite.h).
export function reflectedLight(replay, frame) {
    const {texels, images} = replay, radiance = images.read(frame.radiance);
    const confidence = frame.confidence === frame.radiance ? radiance : images.read(frame.confidence);
    const reflectance = texels[frame.reflectance].values, fallback = texels[frame.fallback].values;
    return Float32Array.from(reflectance, (factor, i) => {
        if (factor === 0) return 0;
        const pixel = i / 3 | 0, weight = confidence[4 * pixel + frame.confidence_channel];
        return factor * (fallback[i] * (1 - weight) + radiance[4 * pixel + i % 3] * weight);
    });
}

/// Relative squared error: mean of d^2 / (r^2 + 0.01) over the mask's pixels and the channels, without the noise of the
/// truth taken off. null: the mask is empty.
export function relativeError(test, truth, mask) {
    let sum = 0, count = 0;
    for (let i = 0; i < test.length; ++i) {
        if (!mask[i / 3 | 0]) continue;
        sum += (test[i] - truth[i]) ** 2 / (truth[i] ** 2 + 0.01);
        ++count;
    }
    return count ? sum / count : null;
}

/// Of each pixel the relative error of the report's viewer; 0 outside of the mask.
function errorMap(test, truth, mask) {
    const rgb = (values, i) => [values[3 * i], values[3 * i + 1], values[3 * i + 2]];
    return Float32Array.from(mask, (isInside, i) => isInside ? scalarModes.relative.of(rgb(test, i), rgb(truth, i)) : 0);
}

/// Four channels against the first `channels` of what was recorded: {pixels, differing: those whose bits differ, far:
/// those that differ by more than a hundredth, largest: difference, relative: to the recorded value, above 1e-4}.
export function compared(now, recorded, channels) {
    const found = {pixels: recorded.length / channels, differing: 0, far: 0, largest: 0, relative: 0};
    for (let i = 0; i < found.pixels; ++i) {
        let most = 0;
        for (let c = 0; c < channels; ++c) {
            const a = now[4 * i + c], b = recorded[channels * i + c];
            if (a === b || (Number.isNaN(a) && Number.isNaN(b))) continue;
            const difference = Number.isNaN(a - b) ? Infinity : Math.abs(a - b);
            most = Math.max(most, difference);
            found.relative = Math.max(found.relative, difference / Math.max(Math.abs(b), 1e-4));
        }
        found.differing += most > 0;
        found.far += most > 0.01;
        found.largest = Math.max(found.largest, most);
    }
    return found;
}

/// What a frame left behind against what was recorded, and which of its pixels are `kept`: those where either holds
/// something; null where the page does not hold results.
export function differenceFromRecorded(replay, frame) {
    if (frame.result === undefined) return null;
    const now = replay.images.read(frame.radiance), {values, channels} = replay.texels[frame.result];
    let kept = 0;
    for (let i = 0; i < values.length / channels; ++i)
        kept += [0, 1, 2, 3].some(c => now[4 * i + c] || (c < channels && values[channels * i + c]));
    return {...compared(now, values, channels), kept};
}

const sumOf = (a, b) => Float32Array.from(a, (v, i) => v + b[i]);
const truthPixels = (r, look) => lightPixels(r.truth, r, look.gain, look.curve);

/// What can be looked at: of a frame's results the picture on the left of the wipe, and on its right the truth's.
export const shown = {
    image: {
        title: "image",
        left: (r, look) => lightPixels(sumOf(r.lit, r.reflected), r, look.gain, look.curve),
        right: (r, look) => lightPixels(sumOf(r.lit, r.truth), r, look.gain, look.curve)
    },
    reflections: {
        title: "reflected light alone",
        left: (r, look) => lightPixels(r.reflected, r, look.gain, look.curve),
        right: truthPixels
    },
    error: {
        title: "error map",
        scale: `black 0, yellow 1 and more: ${scalarModes.relative.formula}, where surfaces reflect`,
        left: r => falseColorPixels(errorMap(r.reflected, r.truth, r.mask), r, 1),
        right: truthPixels
    },
    confidence: {
        title: "confidence",
        scale: "black 0, yellow 1: share of the reflected light that the technique found; the rest is the fallback",
        left: r => falseColorPixels(r.confidence, r, 1),
        right: truthPixels
    },
};
