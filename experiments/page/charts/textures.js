// Colours and textures of bars.

import {h, svg} from "../elements/elements.js";

/// Eight colours, each plain and in three textures, of start.js's page-wide <defs>.
export const textures = ["plain", "stripes", "dots", "checks"];
export const stageFill = index => `url(#${textures[Math.floor(index / 8) % textures.length]}-${index % 8})`;

export function textureDefinitions() {
    const size = {width: 8, height: 8, patternUnits: "userSpaceOnUse"},
          over = {fill: "none", stroke: "var(--card)", "stroke-width": 2.2};
    const drawn = {plain: [], stripes: ["M-2 6L6 -2M2 10L10 2"], dots: ["M2 2h.01M6 6h.01"], checks: ["M0 4H8M4 0V8"]};
    const patterns = textures.flatMap(
        texture => Array.from(
            {length: 8},
            (_, i) => svg(
                "pattern", {id: `${texture}-${i}`, ...size}, svg("rect", {width: 8, height: 8, fill: `var(--s${i})`}),
                drawn[texture].map(d => svg("path", {
                                       d,
                                       ...over,
                                       "stroke-linecap": texture === "dots" ? "round" : "butt",
                                       "stroke-width": texture === "dots" ? 3.4 : 2.2
                                   })))));
    return svg("svg", {width: 0, height: 0, "aria-hidden": "true", class: "definitions"}, svg("defs", {}, patterns));
}

export const textureSwatch = fill => svg(
    "svg", {viewBox: "0 0 14 14", "aria-hidden": "true", class: "icon"}, svg("rect", {width: 14, height: 14, fill}));

/// `entries`: [[fill, name]].
export const textureLegend = (entries, lead = "") => h(
    "p", {class: "stage-names"}, lead,
    entries.map(([fill, name]) => h("span", {class: "stage"}, textureSwatch(fill), name)));
