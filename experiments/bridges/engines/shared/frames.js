// The images of one point of an engine, as {"external": FOLDER} reads them, and what is checked before they are written.
import { existsSync, mkdirSync, rmSync, rmdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { readExr, writeExr } from "./exr.js";
import { Mistake } from "./mistake.js";
import { jsonOf, pathInside } from "./scene_folder.js";

/** A pixel's view distance may differ by this share of itself. */
const DEPTH_TOLERANCE = 0.01;
/** Rasterisers disagree at edges: in 13 scenes at 3 % of them at most. An image that is off by half a pixel differs at half of them. */
const most_differing = (edges) => 8 + edges / 20;
const MOST_LIT_OTHERWISE = 8;
/** Where engines add nothing their half floats differ by 2^-11 of a value. */
const LIGHT_TOLERANCE = 0.002;
/** And where they copy an image through a linear filter, a pixel's neighbours get this share of it: Godot 3e-5 on llvmpipe. */
const LEAK_TOLERANCE = 1e-4;

/** Rows from the top, three channels apart, of a page's values. `rows`: "top" or "bottom", which comes first. */
export function channelsOf(values, width, height, components, rows) {
    const channels = [0, 1, 2].slice(0, components).map(() => new Float32Array(width * height));
    for (let y = 0; y < height; ++y) {
        const from = rows === "bottom" ? height - 1 - y : y;
        for (let x = 0; x < width; ++x)
            channels.forEach((channel, c) => (channel[y * width + x] = values[(from * width + x) * components + c]));
    }
    return channels;
}

export class FrameWriter {
    /** `scene`: scene.json; `folder`: where it lies; `engine`: the adapter's engine.json. */
    constructor({ scene, folder, out, engine, point, settings, seeds }) {
        Object.assign(this, { scene, folder, out, engine, point, settings, seeds, milliseconds: [], written: [] });
    }

    view(name) {
        const view = this.scene.views.find((v) => v.view === name);
        if (!view) throw new Mistake(`scene.json has no view '${name}'`);
        return view;
    }

    frame(view, number) {
        const frame = this.view(view).frames.find((f) => f.frame === number);
        if (!frame) throw new Mistake(`scene.json has no frame ${number} of '${view}'`);
        return frame;
    }

    /** A file that frame() names, as the folder's. */
    read(view, frame, key) {
        return readExr(pathInside(this.folder, this.frame(view, frame)[key]));
    }

    /** `kind`: "off", "s0", ..., or "depth", which is only compared. Returns a sentence on what was found, or "". */
    add({ view, frame, kind, values, components, rows, milliseconds }) {
        const { width, height } = this.view(view);
        if (!/^(depth|off|s[0-9]+)$/.test(kind)) throw new Mistake(`${view}: '${kind}' is no kind of image`);
        if (values.length !== width * height * components)
            throw new Mistake(`${view}: the page sent ${values.length} values; ${width} x ${height} pixels of ${components} are needed`);
        const channels = channelsOf(values, width, height, components, rows);
        if (kind === "depth") return this.compareDepth(view, frame, channels[0]);
        const broken = channels.reduce((sum, channel) => sum + channel.filter((v) => !Number.isFinite(v)).length, 0);
        if (broken) throw new Mistake(`${view}, frame ${frame}, ${kind}: ${broken} values are NaN or infinite`);
        const said = kind === "off" ? this.compareLight(view, frame, channels) : "", [R, G, B] = channels;
        const { half, half_of } = this.view(view);
        if (half && kind !== "s0") return said;  // of a view in half of the light that is all that is kept
        const file = pathInside(this.out, `${half_of ?? view}/f${this.frame(view, frame).frame}.${half ?? kind}.exr`);
        this.written.push(file);
        writeExr(file, width, height, { R, G, B });
        if (milliseconds !== undefined && !half) this.milliseconds.push(milliseconds);
        return said;
    }

    /** With reflections off every pixel holds the light that it was given: else something else shines or filters. */
    compareLight(view, frame, channels) {
        const { width, height, channels: light } = this.read(view, frame, "light"), pixels = channels[0].length;
        const around = (of, i) => {
            let most = 0;
            for (let y = Math.max(0, Math.floor(i / width) - 1); y <= Math.min(height - 1, Math.floor(i / width) + 1); ++y)
                for (let x = Math.max(0, (i % width) - 1); x <= Math.min(width - 1, (i % width) + 1); ++x) most = Math.max(most, of[y * width + x]);
            return most;
        };
        const is_other = (seen, of, i) => Math.abs(seen[i] - of[i]) > LIGHT_TOLERANCE * of[i] + 1e-5 + LEAK_TOLERANCE * around(of, i);
        let differing = 0;
        for (let i = 0; i < pixels; ++i) differing += [light.R, light.G, light.B].some((of, c) => is_other(channels[c], of, i));
        if (differing > MOST_LIT_OTHERWISE)
            throw new Mistake(`${view}, frame ${frame}: with reflections off ${differing} of ${pixels} pixels are not the light of scene.json`);
        return `${differing} of ${pixels} pixels differ from the light`;
    }

    /** Since each pixel emits its own light, only depth shows whether camera and geometry are the scene's. */
    compareDepth(view, frame, depth) {
        const { width, height, channels } = this.read(view, frame, "depth"), truth = channels.Y;
        const pixels = depth.length, apart = (a, b) => Math.abs(a - b) > DEPTH_TOLERANCE * b;
        const nearest = this.view(view).near / 2;
        const seen = depth.map((value) => (value < nearest ? 0 : value));  // a filter's last bits leak into the background
        let differing = 0, columns = 0, rows = 0;  // where depth steps from a column to the next, and from a row
        for (let i = 0; i < pixels; ++i) {
            differing += apart(seen[i], truth[i]);
            columns += (i + 1) % width && apart(truth[i + 1], truth[i]);
            rows += i + width < width * height && apart(truth[i + width], truth[i]);
        }
        if (differing > most_differing(Math.min(columns, rows)))
            throw new Mistake(`${view}, frame ${frame}: depth differs from the scene's in ${differing} of ${pixels} pixels: another camera or geometry`);
        return `${differing} of ${pixels} pixels have another depth`;
    }

    /** What external.json says; `driver` and times are known when all is rendered. */
    description(driver = "") {
        const { name, engine, version, licence } = this.engine;
        return { name, point: this.point, engine, version, driver, licence, settings: this.settings, seeds: this.seeds, given_light: true };
    }

    /** Several scenes share a folder, if all is rendered alike. Returns what differs from what is there; "": nothing. */
    otherThanThere() {
        const file = join(this.out, "external.json");
        if (!existsSync(file)) return "";
        const there = jsonOf(file);
        return Object.entries(this.description()).find(([key, value]) => key !== "driver" && JSON.stringify(there[key]) !== JSON.stringify(value))?.[0] ?? "";
    }

    /** Removes what was written: half of a view's images would be taken for all of them. */
    discard() {
        for (const file of this.written) rmSync(file, { force: true });
        for (const folder of new Set([...this.written.map(dirname), this.out]))
            try {
                rmdirSync(folder);
            } catch {
                // Other images are there, or nothing is.
            }
        this.written = [];
    }

    finish({ driver }) {
        const external = this.description(driver), times = this.milliseconds.sort((a, b) => a - b);
        const isAlone = !existsSync(join(this.out, "external.json"));  // several scenes have no time in common
        if (times.length && isAlone) external.milliseconds = times[times.length >> 1];
        mkdirSync(this.out, { recursive: true });
        writeFileSync(join(this.out, "external.json"), JSON.stringify(external, null, 1) + "\n");
    }
}
