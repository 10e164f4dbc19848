// From pixels' values to colours: exposure and tone curve, false colour on a shared scale, categories.

import {halfValues} from "./packed.js";

/// Rec. 709.
export const luminance = rgb => 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
export const hexColor = code => [0, 2, 4].map(i => parseInt(code.slice(i, i + 2), 16));

/// 256 colours through evenly spaced codes.
function colorRamp(codes) {
    const stops = codes.split(" ").map(hexColor), last = stops.length - 1;
    return Array.from({length: 256}, (_, i) => {
        const place = i / 255 * last, low = Math.min(Math.floor(place), last - 1), t = place - low;
        return [0, 1, 2].map(c => Math.round(stops[low][c] * (1 - t) + stops[low + 1][c] * t));
    });
}

/// magma by Stefan van der Walt and Nathaniel Smith (matplotlib, CC0), every eighth entry, interpolated.
export const magma = colorRamp(
    "000004 030312 0a0822 130d34 1d1147 29115a 36106b 440f76 51127c 5d177f 6a1c81 762181 832681 902a81 9c2e7f aa337d b73779 c23b75 cf4070 db476a e55064 ee5b5e f4695c f9785d fb8761 fd9668 fea571 feb47b fec287 fed194 fde0a1 fceeb0 fcfdbf");
/// Signed values: Okabe and Ito's blue and vermilion, distinct with all kinds of colour vision, white between them,
/// and darker ends.
export const diverging = colorRamp("002a44 0072b2 ffffff d55e00 552500");
const badColor = [255, 0, 255];  // NaN and infinity: a colour that no scale has

/// IEC 61966-2-1, as 0..255.
const srgbCode = v => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));

/// Curves from exposed radiance, 0 or more, to [0, 1], for each channel by itself. For display alone: what the
/// inspector lists has passed none of them.
export const toneCurves = {
    none: {title: "none (clipped at 1)", of: v => Math.min(v, 1)},
    reinhard: {title: "Reinhard et al. 2002, v / (1 + v)", of: v => v / (1 + v)},
    aces: {
        title: "ACES, Narkowicz's fit of 2015",
        of: v => Math.min(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 1)
    },
};

/// The display code of each half float at this exposure; 256 marks what is not finite.
export function displayTable(exposure, curve) {
    const gain = 2 ** exposure, {of} = toneCurves[curve];
    return Uint16Array.from(halfValues, v => Number.isFinite(v) ? srgbCode(of(Math.max(v * gain, 0))) : 256);
}

/// RGBA pixels of `colorAt(i)`, [red, green, blue] from 0 to 255.
function paintedPixels({width, height}, colorAt) {
    const out = new ImageData(width, height), {data} = out;
    for (let i = 0; i < width * height; ++i) {
        const [red, green, blue] = colorAt(i);
        data[4 * i] = red;
        data[4 * i + 1] = green;
        data[4 * i + 2] = blue;
        data[4 * i + 3] = 255;
    }
    return out;
}

/// Of an image in colour, by displayTable().
export function colorPixels(image, table) {
    const {halves, pixels} = image;
    return paintedPixels(image, i => {
        const color = [table[halves[i]], table[halves[pixels + i]], table[halves[2 * pixels + i]]];
        return color.includes(256) ? badColor : color;
    });
}

/// Of linear RGB, interleaved, at an exposure (gain), through a tone curve.
export function lightPixels(rgb, extent, gain, curve) {
    const {of} = toneCurves[curve];
    return paintedPixels(extent, i => {
        const color = [rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]];
        return color.every(Number.isFinite) ? color.map(v => srgbCode(of(Math.max(v * gain, 0)))) : badColor;
    });
}

/// Of one value each: 0 to `maximum` through magma, or -maximum to maximum through the diverging colours.
export function falseColorPixels(values, extent, maximum, isSigned) {
    const ramp = isSigned ? diverging : magma;
    return paintedPixels(extent, i => {
        const v = isSigned ? 0.5 + 0.5 * values[i] / maximum : values[i] / maximum;
        return Number.isFinite(v) ? ramp[Math.round(255 * Math.min(Math.max(v, 0), 1))] : badColor;
    });
}

/// Of categories: `places` index `colors`.
export const categoryPixels = (places, extent, colors) => paintedPixels(extent, i => colors[places[i]]);

/// Shows pixels in a canvas of their size.
export function putPixels(canvas, pixels) {
    if (canvas.width !== pixels.width || canvas.height !== pixels.height)
        Object.assign(canvas, {width: pixels.width, height: pixels.height});
    canvas.getContext("2d").putImageData(pixels, 0, 0);
    return canvas;
}
