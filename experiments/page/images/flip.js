// FLIP (Andersson et al. 2020): the map that metrics/flip.cpp computes, of any two images of the page. Filters are those of
// metrics/flip_filters.cpp, colour spaces those of metrics/flip_color.h, in single precision between the passes.

import {halfValues} from "./packed.js";

const flipPixelsPerDegree = 67.0206432766;  // default_pixels_per_degree of metrics/flip.h

/// {right: taps 0 ... radius, isOdd}, the sums of whose positive and negative taps are `scaled`.
function flipKernel(radius, value, {isOdd = false, isBalanced = false} = {}) {
    let positive = 0, negative = 0;
    for (let u = -radius; u <= radius; ++u) {
        const v = value(u);
        if (v > 0 || !isBalanced)
            positive += v;
        else
            negative -= v;
    }
    const right = Float32Array.from(
        {length: radius + 1}, (_, u) => isOdd && u === 0 ? 0 : value(u) / (value(u) > 0 || !isBalanced ? positive : negative));
    return {right, isOdd, radius};
}

const flipKernels = (() => {
    const ppd = flipPixelsPerDegree, sigma = 0.5 * 0.082 * ppd;  // section 4.2
    const colorRadius = Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI ** 2)) * ppd), featureRadius = Math.ceil(3 * sigma);
    const sensitivity = b => u => Math.exp(-((Math.PI * u / ppd) ** 2) / b);  // table 1
    const blueYellow = [[34.1, 0.04], [13.5, 0.025]].map(
        ([a, b]) => Float64Array.from({length: colorRadius + 1}, (_, u) => Math.sqrt(a * Math.sqrt(Math.PI / b)) * sensitivity(b)(u)));
    const sums = blueYellow.map(taps => taps.reduce((sum, v) => sum + 2 * v, -taps[0]));
    const gauss = u => Math.exp(-u * u / (2 * sigma * sigma));
    return {
        colorRadius,
        featureRadius,
        achromatic: flipKernel(colorRadius, sensitivity(0.0047)),
        redGreen: flipKernel(colorRadius, sensitivity(0.0053)),
        blueYellow: blueYellow.map(
            taps => ({right: Float32Array.from(taps, v => v / Math.hypot(...sums)), isOdd: false, radius: colorRadius})),
        blur: flipKernel(featureRadius, gauss),
        edge: flipKernel(featureRadius, u => -u * gauss(u), {isOdd: true, isBalanced: true}),
        point: flipKernel(featureRadius, u => (u * u / (sigma * sigma) - 1) * gauss(u), {isBalanced: true})
    };
})();

/// Convolves a plane along rows (`step` 1) or columns (`step` its width), without what the kernel would leave.
function flipFiltered(plane, kernel, isOfColumns) {
    const {right, isOdd, radius} = kernel;
    const width = plane.width - (isOfColumns ? 0 : 2 * radius), height = plane.height - (isOfColumns ? 2 * radius : 0);
    const values = new Float32Array(width * height), from = plane.values, step = isOfColumns ? plane.width : 1;
    const first = radius * step;
    for (let y = 0; y < height; ++y) {
        const center = first + y * plane.width, to = y * width;
        for (let x = 0; x < width; ++x) values[to + x] = right[0] * from[center + x];
        for (let k = 1; k <= radius; ++k) {
            const weight = right[k], ahead = center + k * step, behind = center - k * step;
            if (isOdd)
                for (let x = 0; x < width; ++x) values[to + x] += weight * (from[ahead + x] - from[behind + x]);
            else
                for (let x = 0; x < width; ++x) values[to + x] += weight * (from[ahead + x] + from[behind + x]);
        }
    }
    return {width, height, values};
}
const flipInBoth = (plane, ofRows, ofColumns) => flipFiltered(flipFiltered(plane, ofRows, false), ofColumns, true);

/// Linear RGB to XYZ over white's, and to Y, Cx, Cz without their factors; and back.
const flipXyz = (r, g, b) => [
    (10135552 * r + 8788810 * g + 4435075 * b) * 1.052156925 / 24577794,
    (2613072 * r + 8788810 * g + 887015 * b) / 12288897,
    (1425312 * r + 8788810 * g + 70074185 * b) * 0.918357670 / 73733382
];
function flipLab(r, g, b) {
    const edge = 6 / 29;
    const root = t => t > edge ** 3 ? Math.cbrt(t) : t / (3 * edge * edge) + 4 / 29;
    const [tx, ty, tz] = flipXyz(r, g, b), x = root(tx), y = root(ty), z = root(tz);
    const lightness = 116 * y - 16;
    return [lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)];
}
const flipDistance = (a, b) => Math.abs(a[0] - b[0]) + Math.hypot(a[1] - b[1], a[2] - b[2]);

/// What an observer sees of an image at an exposure: {colors: L, a, b; edges, points}. Pixels that are `bad` are black.
function flipLook(image, gain, bad) {
    const {colorRadius, featureRadius, achromatic, redGreen, blueYellow, blur, edge, point} = flipKernels;
    const width = image.width + 2 * colorRadius, height = image.height + 2 * colorRadius;
    const [y, cx, cz] = [0, 1, 2].map(() => ({width, height, values: new Float32Array(width * height)}));
    const within = (v, size) => Math.min(Math.max(v - colorRadius, 0), size - 1);  // the border is repeated
    const display = halfValues.map(v => Math.min(Math.max(v * gain, 0), 1)), {halves, pixels} = image;
    for (let v = 0, to = 0; v < height; ++v)
        for (let u = 0; u < width; ++u, ++to) {
            const i = within(v, image.height) * image.width + within(u, image.width);
            if (bad?.[i]) continue;
            const [x, luminance, z] = flipXyz(display[halves[i]], display[halves[pixels + i]], display[halves[2 * pixels + i]]);
            y.values[to] = luminance;
            cx.values[to] = x - luminance;
            cz.values[to] = luminance - z;
        }
    const colors = [flipInBoth(y, achromatic, achromatic), flipInBoth(cx, redGreen, redGreen), flipInBoth(cz, blueYellow[0], blueYellow[0])]
                       .map(p => p.values);
    const second = flipInBoth(cz, blueYellow[1], blueYellow[1]).values, clamped = v => Math.min(Math.max(v, 0), 1);
    for (let i = 0; i < image.pixels; ++i) {
        const luminance = colors[0][i], x = 0.950428545 * (luminance + colors[1][i]),
              z = 1.088900371 * (luminance - colors[2][i] - second[i]);
        const lab = flipLab(
            clamped(3.241003275 * x - 1.537398934 * luminance - 0.498615861 * z),
            clamped(-0.969224334 * x + 1.875930071 * luminance + 0.041554224 * z),
            clamped(0.055639423 * x - 0.204011202 * luminance + 1.057148933 * z));
        [colors[0][i], colors[1][i], colors[2][i]] = lab;
    }
    const border = colorRadius - featureRadius, inner = {width: width - 2 * border, height: height - 2 * border};
    inner.values = new Float32Array(inner.width * inner.height);
    for (let v = 0; v < inner.height; ++v) {
        const from = (v + border) * width + border;
        inner.values.set(y.values.subarray(from, from + inner.width), v * inner.width);
    }
    const lengths = kernel => {
        const across = flipInBoth(inner, kernel, blur).values, down = flipInBoth(inner, blur, kernel).values;
        return across.map((value, i) => Math.sqrt(value * value + down[i] * down[i]));
    };
    return {colors, edges: lengths(edge), points: lengths(point)};
}

/// LDR-FLIP of each pixel, 0 to 1, at the exposure (EV) that the metric `flip` has of the shot; NaN where either is.
export function flipMap(image, base, exposure) {
    const bad = new Uint8Array(image.pixels), isBad = v => !Number.isFinite(halfValues[v]);
    for (let i = 0; i < 3 * image.pixels; ++i)
        if (isBad(image.halves[i]) || isBad(base.halves[i])) bad[i % image.pixels] = 1;
    const hasBad = bad.includes(1), key = "flip look";
    // That of the base is needed for every other image.
    if (!hasBad && !base.scalars.has(key)) base.scalars.set(key, flipLook(base, 2 ** exposure, null));
    const looks = [hasBad ? flipLook(base, 2 ** exposure, bad) : base.scalars.get(key), flipLook(image, 2 ** exposure, bad)];
    const colorsAt = ({colors: [l, a, b]}, i) => [l[i], a[i], b[i]];
    const greatest = flipDistance(flipLab(0, 1, 0), flipLab(0, 0, 1)) ** 0.7, knee = 0.4 * greatest;
    const differs = (name, i) => Math.abs(looks[0][name][i] - looks[1][name][i]);
    return Float32Array.from({length: image.pixels}, (_, i) => {
        if (bad[i]) return NaN;
        const power = flipDistance(colorsAt(looks[0], i), colorsAt(looks[1], i)) ** 0.7;
        const color = power < knee ? power * 0.95 / knee : 0.95 + (power - knee) / (greatest - knee) * 0.05;  // section 4.1.4
        return color ** (1 - Math.sqrt(Math.max(differs("edges", i), differs("points", i)) * Math.SQRT1_2));
    });
}
