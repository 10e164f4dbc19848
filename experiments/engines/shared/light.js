// What adapters do with light and environment before an engine gets them.

const CONSTANT_SIZE = [64, 32];  // of an environment of one colour: engines filter it into mip levels

/**
 * By what light is multiplied before the engine sees it, and images divided afterwards. "auto": 1 % of the pixels get
 * brighter than 1, as in pictures that engines are made for; light that is nowhere that bright stays as it is. Some
 * engines cut reflections off at absolute values, which would cut most of a room that is lit in physical units.
 */
export function exposureOf(setting, { rgba }) {
    if (setting !== "auto") return setting;
    const brightest = new Float32Array(rgba.length / 4).map((_, i) => Math.max(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2])).sort();
    return 1 / Math.max(1, brightest[Math.floor(0.99 * (brightest.length - 1))]);
}

/** RGBA values times a factor; alpha stays. */
export function scaled(rgba, factor) {
    return factor === 1 ? rgba : rgba.map((value, i) => (i % 4 === 3 ? value : value * factor));
}

/** {width, height, rgba} of the background as scene.json has it, without rotation: first row up, u = 0.5 + atan2(z, x) / 2 pi. */
export function latLong(background, exposure) {
    if (background.color) {
        const [width, height] = CONSTANT_SIZE, rgba = new Float32Array(4 * width * height);
        for (let i = 0; i < width * height; ++i) rgba.set([...background.color.map((value) => value * exposure), 1], 4 * i);
        return { width, height, rgba };
    }
    const { width, height, rgba } = background, turned = new Float32Array(rgba.length);
    const shift = ((background.rotation ?? 0) / (2 * Math.PI)) * width;
    for (let x = 0; x < width; ++x) {
        const at = x + shift, part = at - Math.floor(at), wrap = (column) => ((column % width) + width) % width;
        const left = wrap(Math.floor(at)), right = wrap(left + 1);
        for (let y = 0; y < height; ++y)
            for (let c = 0; c < 4; ++c)
                turned[4 * (y * width + x) + c] = rgba[4 * (y * width + left) + c] * (1 - part) + rgba[4 * (y * width + right) + c] * part;
    }
    return { width, height, rgba: scaled(turned, exposure) };
}

/** Names of settings that begin with `group` and a point, without both: {radius: 5} of {"denoise.radius": 5}. */
export function settingsOf(settings, group) {
    return Object.fromEntries(Object.entries(settings).filter(([key]) => key.startsWith(`${group}.`)).map(([key, value]) => [key.slice(group.length + 1), value]));
}
