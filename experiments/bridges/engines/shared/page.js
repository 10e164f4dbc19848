// Runs in the browser: hands the scene's frames to an adapter, and its images to the server that started the page.
import { Mistake } from "ssrlab/mistake.js";

const sent = async (path, body) => {
    const answer = await fetch(path, { method: "POST", body });
    if (!answer.ok) throw new Error(await answer.text());
};

for (const level of ["log", "warn", "error"]) {
    const own = console[level].bind(console);
    console[level] = (...values) => {
        own(...values);
        fetch("/log", { method: "POST", body: `${level}: ${values.map((v) => (v && v.stack) || String(v)).join(" ")}` });
    };
}

/** Light without reflections: {width, height, rgba: Float32Array}, rows from the top, alpha 1. */
async function lightOf(view, frame) {
    const rgba = new Float32Array(await (await fetch(`/light/${view.view}/${frame.frame}`)).arrayBuffer());
    return { width: view.width, height: view.height, rgba };
}

/** Radiance from infinity, {width, height, rgba: Float32Array}: u = 0.5 + atan2(z, x) / 2 pi, v = acos(y) / pi, first row +y. */
async function backgroundOf({ background }) {
    if (background.color) {
        const width = 64, height = 32, rgba = new Float32Array(width * height * 4);
        for (let i = 0; i < width * height; ++i) rgba.set([...background.color, 1], 4 * i);
        return { width, height, rgba };
    }
    const answer = await fetch("/environment"), rgba = new Float32Array(await answer.arrayBuffer());
    const width = Number(answer.headers.get("x-width")), height = Number(answer.headers.get("x-height"));
    return rotated({ width, height, rgba }, background.rotation);
}

/** The image without its rotation about +y, so that no adapter has to know in which sense its engine counts. */
function rotated({ width, height, rgba }, rotation) {
    const turned = new Float32Array(rgba.length), shift = (rotation / (2 * Math.PI)) * width, whole = Math.floor(shift), part = shift - whole;
    for (let x = 0; x < width; ++x) {
        const left = (((x + whole) % width) + width) % width, right = (left + 1) % width;
        for (let y = 0; y < height; ++y)
            for (let c = 0; c < 4; ++c)
                turned[4 * (y * width + x) + c] = (1 - part) * rgba[4 * (y * width + left) + c] + part * rgba[4 * (y * width + right) + c];
    }
    return { width, height, rgba: turned };
}

/** The same rows in the other order, as OpenGL counts them. */
export function turned({ width, height, rgba }) {
    const rows = new Float32Array(rgba.length);
    for (let y = 0; y < height; ++y) rows.set(rgba.subarray((height - 1 - y) * width * 4, (height - y) * width * 4), y * width * 4);
    return { width, height, rgba: rows };
}

/** What a WebGL context says that it draws with. */
export function driverOf(gl) {
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    return gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
}

async function send(view, frame, kind, { values, components = 4, rows = "bottom", milliseconds }) {
    const query = new URLSearchParams({ view: view.view, frame: frame.frame, kind, components, rows });
    if (milliseconds !== undefined) query.set("milliseconds", milliseconds);
    await sent(`/image?${query}`, new Float32Array(values).buffer);
}

export async function run(adapter) {
    try {
        const { scene, settings, seeds } = await (await fetch("/job")).json();
        const background = await backgroundOf(scene);
        let driver = "";
        for (const view of scene.views) {
            const canvas = document.createElement("canvas");
            canvas.width = view.width;
            canvas.height = view.height;
            document.body.replaceChildren(canvas);
            const light = (frame) => lightOf(view, frame);
            const renderer = await adapter.open({ scene, view, settings, background, light, canvas, glb: "/scene/scene.glb" });
            for (const frame of view.frames) {
                await renderer.pose(frame, await light(frame));
                await send(view, frame, "depth", await renderer.depth());
                await send(view, frame, "off", await renderer.render({ reflections: false, seed: 0 }));
                for (let seed = 0; seed < seeds; ++seed)
                    await send(view, frame, `s${seed}`, await renderer.render({ reflections: true, seed }));
            }
            driver = renderer.driver;
        }
        await sent("/done", JSON.stringify({ driver }));
    } catch (error) {
        const is_mistake = error instanceof Mistake;
        await fetch(is_mistake ? "/fail?mistake" : "/fail", { method: "POST", body: is_mistake ? error.message : error.stack || String(error) });
    }
}
