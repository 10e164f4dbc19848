// What differences of two images are: of a pixel, of all, and their common scale.

import {luminance} from "./colors.js";
import {flipMap} from "./flip.js";
import {pixelRgb} from "./packed.js";

export const meanDistance = (x, r) => (Math.abs(x[0] - r[0]) + Math.abs(x[1] - r[1]) + Math.abs(x[2] - r[2])) / 3;

/// What a false-colour mode shows of one pixel, or of all at once (`mapOf`); in the formulas `d` and `r` are difference and reference per channel.
export const scalarModes = {
    absolute: {title: "absolute difference", formula: "mean over channels of |d|", isError: true, of: meanDistance},
    signed: {
        title: "signed difference",
        formula: "luminance of d: blue too dark, red too bright",
        isError: true,
        isSigned: true,
        of: (x, r) => luminance(x) - luminance(r)
    },
    relative: {
        title: "relative error",
        formula: "mean over channels of |d| / sqrt(r² + 0.01)",
        isError: true,
        of: (x, r) => [0, 1, 2].reduce((sum, c) => sum + Math.abs(x[c] - r[c]) / Math.sqrt(r[c] * r[c] + 0.01), 0) / 3
    },
    flip: {
        title: "FLIP",
        formula: "LDR-FLIP by Andersson et al. 2020 at the shot's exposure, as the metric flip",
        isError: true,
        isFixed: true,
        mapOf: (image, base) => flipMap(image, base, image.exposure)
    },
    luminance: {title: "luminance", formula: "Rec. 709 luminance", of: x => luminance(x)},
    jod: {
        title: "visible difference",
        formula: "JOD lost if this difference were everywhere, ColorVideoVDP 0.5.6 of two stills against the truth",
        of: map => map[0]
    },
    confidence: {title: "confidence", formula: "share of the result that is the technique's own", isFixed: true},
};

/// One value per pixel, computed once for each image that it is compared with (`base`, null where nothing is).
export function scalarsOf(image, base, mode) {
    const key = mode + (scalarModes[mode].isError ? base.index : "");
    if (!image.scalars.has(key)) {
        const {of, mapOf} = scalarModes[mode];
        image.scalars.set(
            key,
            mapOf ? mapOf(image, base) :
                    Float32Array.from(
                        {length: image.pixels}, (_, i) => of(pixelRgb(image, i), base ? pixelRgb(base, i) : null)));
    }
    return image.scalars.get(key);
}

/// The scale that all images of a mode share, each with what it is compared with: the largest of their 99 % quantiles of size, so that single pixels do not
/// darken the rest.
export function sharedMaximum(pairs, mode) {
    if (scalarModes[mode].isFixed) return 1;
    let largest = 0;
    for (const [image, base] of pairs) {
        const all = scalarsOf(image, base, mode);
        const step = Math.max(1, Math.floor(all.length / 20000));
        const sample = Float32Array.from({length: Math.floor(all.length / step)}, (_, i) => Math.abs(all[i * step]))
                           .filter(Number.isFinite)
                           .sort();
        if (sample.length) largest = Math.max(largest, sample[Math.floor(0.99 * (sample.length - 1))]);
    }
    return largest > 0 ? largest : 1;
}
