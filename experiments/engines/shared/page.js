// Runs in the browser: hands the scene's frames to an adapter, and its images to the server that started the page.

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

/** {color: [r, g, b]} or {width, height, rgba, rotation}; scene.json says how it lies. */
async function backgroundOf(scene) {
    if (scene.background.color) return scene.background;
    const answer = await fetch("/environment");
    return {
        width: Number(answer.headers.get("x-width")),
        height: Number(answer.headers.get("x-height")),
        rotation: scene.background.rotation,
        rgba: new Float32Array(await answer.arrayBuffer()),
    };
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
        await fetch("/fail", { method: "POST", body: error.stack || String(error) });
    }
}
