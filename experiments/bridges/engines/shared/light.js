// What adapters do with light before an engine gets it, and with settings.

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

/** An image whose colours are multiplied by a factor; alpha stays. */
export function exposed({ width, height, rgba }, factor) {
    return { width, height, rgba: scaled(rgba, factor) };
}

/** The same of RGBA values. */
export function scaled(rgba, factor) {
    return factor === 1 ? rgba : rgba.map((value, i) => (i % 4 === 3 ? value : value * factor));
}

/** Names of settings that begin with `group` and a point, without both: {radius: 5} of {"denoise.radius": 5}. */
export function settingsOf(settings, group) {
    return Object.fromEntries(Object.entries(settings).filter(([key]) => key.startsWith(`${group}.`)).map(([key, value]) => [key.slice(group.length + 1), value]));
}
