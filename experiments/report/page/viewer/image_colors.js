// From pixels' values to colours: exposure and tone curve, false colour on a shared scale, categories.

/// Rec. 709.
const luminance = rgb => 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];

const meanDistance = (x, r) => (Math.abs(x[0] - r[0]) + Math.abs(x[1] - r[1]) + Math.abs(x[2] - r[2])) / 3;

/// What a false-colour mode shows of one pixel, or of all at once (`mapOf`); in the formulas `d` and `r` are difference and reference per channel.
const scalarModes = {
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
        mapOf: (image, base) => flipMap(image, base, shotExposure(image.shot))
    },
    luminance: {title: "luminance", formula: "Rec. 709 luminance", of: x => luminance(x)},
    confidence: {title: "confidence", formula: "share of the result that is the technique's own", isFixed: true},
};

/// One value per pixel, computed once for each image that it is compared with (`base`, null where nothing is).
function scalarsOf(image, base, mode) {
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
function sharedMaximum(pairs, mode) {
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

const hexColor = code => [0, 2, 4].map(i => parseInt(code.slice(i, i + 2), 16));

/// 256 colours through evenly spaced codes.
function colorRamp(codes) {
    const stops = codes.split(" ").map(hexColor), last = stops.length - 1;
    return Array.from({length: 256}, (_, i) => {
        const place = i / 255 * last, low = Math.min(Math.floor(place), last - 1), t = place - low;
        return [0, 1, 2].map(c => Math.round(stops[low][c] * (1 - t) + stops[low + 1][c] * t));
    });
}

/// magma by Stefan van der Walt and Nathaniel Smith (matplotlib, CC0), every eighth entry, interpolated.
const magma = colorRamp(
    "000004 030312 0a0822 130d34 1d1147 29115a 36106b 440f76 51127c 5d177f 6a1c81 762181 832681 902a81 9c2e7f aa337d b73779 c23b75 cf4070 db476a e55064 ee5b5e f4695c f9785d fb8761 fd9668 fea571 feb47b fec287 fed194 fde0a1 fceeb0 fcfdbf");
/// Signed values: Okabe and Ito's blue and vermilion, distinct with all kinds of colour vision, white between them,
/// and darker ends.
const diverging = colorRamp("002a44 0072b2 ffffff d55e00 552500");
const badColor = [255, 0, 255];  // NaN and infinity: a colour that no scale has

/// IEC 61966-2-1, as 0..255.
const srgbCode = v => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));

/// Curves from exposed radiance, 0 or more, to [0, 1], for each channel by itself. For display alone: what the
/// inspector lists has passed none of them.
const toneCurves = {
    none: {title: "none (clipped at 1)", of: v => Math.min(v, 1)},
    reinhard: {title: "Reinhard et al. 2002, v / (1 + v)", of: v => v / (1 + v)},
    aces: {
        title: "ACES, Narkowicz's fit of 2015",
        of: v => Math.min(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 1)
    },
};

/// The display code of each half float at this exposure; 256 marks what is not finite.
function displayTable(exposure, curve) {
    const gain = 2 ** exposure, {of} = toneCurves[curve];
    return Uint16Array.from(halfValues, v => Number.isFinite(v) ? srgbCode(of(Math.max(v * gain, 0))) : 256);
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

/// RGBA pixels of one value each: 0 to `maximum` through magma, or -maximum to maximum through the diverging colours.
function falseColorPixels(values, extent, maximum, isSigned) {
    const out = new ImageData(extent.width, extent.height), {data} = out;
    const ramp = isSigned ? diverging : magma;
    for (let i = 0; i < values.length; ++i) {
        const v = isSigned ? 0.5 + 0.5 * values[i] / maximum : values[i] / maximum;
        const color = Number.isFinite(v) ? ramp[Math.round(255 * Math.min(Math.max(v, 0), 1))] : badColor;
        data[4 * i] = color[0];
        data[4 * i + 1] = color[1];
        data[4 * i + 2] = color[2];
        data[4 * i + 3] = 255;
    }
    return out;
}

/// RGBA pixels of categories: `places` index `colors` ([r, g, b]).
function categoryPixels(places, extent, colors) {
    const out = new ImageData(extent.width, extent.height);
    for (let i = 0; i < places.length; ++i) {
        const color = colors[places[i]];
        for (let c = 0; c < 3; ++c) out.data[4 * i + c] = color[c];
        out.data[4 * i + 3] = 255;
    }
    return out;
}
