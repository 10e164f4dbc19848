// Renders a scene folder of `ssrlab scene-for` with an engine, in a browser or (program.js) a program of its own; render.sh
// says how it is called.
import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { existsSync, mkdtempSync, readFileSync, readdirSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, extname, join, normalize, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { atEnd, endGroup, removeFolder } from "./at_end.js";
import { readExr } from "./exr.js";
import { FrameWriter } from "./frames.js";
import { Mistake } from "./mistake.js";
import { renderWithProgram } from "./program.js";
import { jsonOf, pathInside, readScene } from "./scene_folder.js";

const ENGINES = dirname(dirname(fileURLToPath(import.meta.url)));
const PACKAGES = join(dirname(dirname(dirname(ENGINES))), "build/engines");  // where run.sh installs them
const TYPES = { ".js": "text/javascript", ".mjs": "text/javascript", ".json": "application/json", ".wasm": "application/wasm", ".html": "text/html" };
const MINUTES = 20;  // for all frames, on a processor

export function adapters() {
    return readdirSync(ENGINES).filter((name) => existsSync(join(ENGINES, name, "engine.json"))).sort();
}

/** KEY=VALUE, the value as JSON or else a text. */
function setting(text) {
    const equals = text.indexOf("=");
    if (equals < 1) throw new Mistake(`--set ${text}: must be KEY=VALUE`);
    const value = text.slice(equals + 1);
    try {
        return [text.slice(0, equals), JSON.parse(value)];
    } catch {
        return [text.slice(0, equals), value];
    }
}

export function parse(words) {
    const job = { positional: [], point: undefined, set: [], seeds: 1, chromium: process.env.CHROMIUM ?? "chromium" };
    for (let i = 0; i < words.length; ++i) {
        const value = () => {
            if (++i >= words.length) throw new Mistake(`${words[i - 1]} needs a value`);
            return words[i];
        };
        if (words[i] === "--point") job.point = value();
        else if (words[i] === "--set") job.set.push(setting(value()));
        else if (words[i] === "--seeds") job.seeds = Number(value());
        else if (words[i].startsWith("-")) throw new Mistake(`unknown option ${words[i]}; known are --point NAME, --set KEY=VALUE and --seeds N`);
        else job.positional.push(words[i]);
    }
    if (job.positional.length !== 3) throw new Mistake("three words are needed: ENGINE SCENE_FOLDER OUT");
    const [name, folder, out] = job.positional;
    const adapter = name.includes("/") ? resolve(name) : join(ENGINES, name);
    if (!existsSync(join(adapter, "engine.json")))
        throw new Mistake(`no engine '${name}'; there are ${adapters().join(", ")}, and paths of folders with engine.json and adapter.js`);
    if (!(Number.isInteger(job.seeds) && job.seeds >= 1 && job.seeds <= 1000)) throw new Mistake(`--seeds must be from 1 to 1000`);
    const engine = jsonOf(join(adapter, "engine.json"));
    const preset = job.point ?? "default";
    const is_known = Object.hasOwn(engine.points, preset);
    if (!is_known && job.set.length === 0)
        throw new Mistake(`${name} has no point '${preset}'; there are ${Object.keys(engine.points).join(", ")}, and --set names settings of a new one`);
    const set = Object.fromEntries(job.set), settings = { ...(is_known ? engine.points[preset] : {}), ...set };
    const own = engine.defaults ?? {};
    for (const key of Object.keys(settings))
        if (!Object.hasOwn(own, key)) throw new Mistake(`${name} has no setting '${key}'; there are ${Object.keys(own).join(", ")}`);
    for (const [key, value] of Object.entries(settings))
        if (typeof value !== typeof own[key] && own[key] !== "auto")  // which is of the adapter's, or a number
            throw new Mistake(`${name}: --set ${key} must be a ${typeof own[key]} like the default ${JSON.stringify(own[key])}, not ${JSON.stringify(value)}`);
    const point = job.point ?? (job.set.length ? job.set.map(([key, value]) => `${key}_${value}`).join("-").replace(/[^A-Za-z0-9_.-]/g, "_") : "default");
    return { name: basename(adapter), adapter, folder: resolve(folder), out, engine, point, settings: { ...own, ...settings }, seeds: job.seeds, chromium: job.chromium };
}

function page(job) {
    const map = JSON.stringify({ imports: { ...job.engine.imports, "ssrlab/": "/engines/shared/" } });
    return `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="importmap">${map}</script><body>
<script>addEventListener("error", (e) => fetch("/fail", {method: "POST", body: e.message || "a script cannot be loaded"}), true)</script>
<script type="module">
import("ssrlab/page.js").then(async (page) => page.run(await import("/adapter/adapter.js")))
    .catch((e) => fetch("/fail", {method: "POST", body: e.stack || String(e)}));
</script>`;
}

function rgba_of({ width, height, channels }) {
    const rgba = new Float32Array(width * height * 4).fill(1);
    ["R", "G", "B"].forEach((name, c) => {
        for (let i = 0; i < width * height; ++i) rgba[4 * i + c] = channels[name][i];
    });
    return { width, height, bytes: Buffer.from(rgba.buffer) };
}

const body_of = async (request) => {
    const parts = [];
    for await (const part of request) parts.push(part);
    return Buffer.concat(parts);
};

/** Serves the page until it is done; resolves to what it said last. */
function serve(job, scene, writer) {
    let end;
    const done = new Promise((resolve, reject) => (end = { resolve, reject }));
    const send_file = (answer, root, path) => {
        const file = normalize(join(root, path));
        if (!file.startsWith(normalize(root + "/")) || !existsSync(file)) return answer.writeHead(404).end();
        answer.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" }).end(readFileSync(file));
    };
    const answers = {
        "/": (_, answer) => answer.writeHead(200, { "content-type": "text/html" }).end(page(job)),
        "/job": (_, answer) => answer.end(JSON.stringify({ scene, settings: job.settings, seeds: job.seeds })),
        "/environment": (_, answer) => {
            const { width, height, bytes } = rgba_of(readExr(pathInside(job.folder, scene.background.image)));
            answer.writeHead(200, { "x-width": width, "x-height": height }).end(bytes);
        },
        "/log": async (request, answer) => {
            process.stderr.write(`  ${job.name}: ${await body_of(request)}\n`);
            answer.end();
        },
        "/fail": async (request, answer, url) => {
            const said = (await body_of(request)).toString();
            end.reject(url.searchParams.has("mistake") ? new Mistake(said) : new Error(`in the page: ${said}`));
            answer.end();
        },
        "/done": async (request, answer) => {
            const said = JSON.parse((await body_of(request)).toString());
            answer.end();
            end.resolve(said);
        },
        "/image": async (request, answer, url) => {
            const bytes = await body_of(request), query = Object.fromEntries(url.searchParams);
            const found = writer.add({
                ...query,
                frame: Number(query.frame),
                components: Number(query.components),
                milliseconds: query.milliseconds === undefined ? undefined : Number(query.milliseconds),
                values: new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)),
            });
            if (found) console.log(`${query.view}, frame ${query.frame}: ${found}`);
            answer.end();
        },
    };
    const server = createServer(async (request, answer) => {
        try {
            const url = new URL(request.url, "http://localhost"), path = decodeURIComponent(url.pathname);
            if (answers[path]) return await answers[path](request, answer, url);
            if (path.startsWith("/engines/")) return send_file(answer, ENGINES, path.slice("/engines/".length));
            if (path.startsWith("/adapter/")) return send_file(answer, job.adapter, path.slice("/adapter/".length));
            if (path.startsWith("/node_modules/")) return send_file(answer, PACKAGES, path);
            if (path.startsWith("/scene/")) return send_file(answer, job.folder, path.slice("/scene/".length));
            if (path.startsWith("/light/")) {
                const [, , view, frame] = path.split("/");
                return answer.end(rgba_of(writer.read(view, Number(frame), "light")).bytes);
            }
            answer.writeHead(404).end();
        } catch (error) {
            answer.writeHead(400).end(error.message);
            end.reject(error);
        }
    });
    return { server, done, end };
}

export async function render(job) {
    const scene = readScene(job.folder);
    const writer = new FrameWriter({ scene, ...job }), other = writer.otherThanThere();
    if (other) throw new Mistake(`${job.out} holds images whose ${other} is another: name another folder`);
    let is_whole = false;
    const clean = atEnd(() => is_whole || writer.discard());
    try {
        const images = scene.views.reduce((sum, view) => sum + view.frames.length, 0) * job.seeds;
        writer.finish(await (job.engine.program ? renderWithProgram({ job, scene, writer, minutes: MINUTES * images }) : renderWithPage(job, scene, writer)));
        is_whole = true;
    } finally {
        clean();
    }
}

/** Resolves to what the page said last, when `writer` has all images. */
async function renderWithPage(job, scene, writer) {
    const { server, done, end } = serve(job, scene, writer);
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    const profile = mkdtempSync(join(tmpdir(), "ssrlab-engine-")), remove = atEnd(() => removeFolder(profile));
    // A software rasteriser, so that images are the same on every machine; --no-sandbox: containers run as root.
    const browser = spawn(job.chromium, ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", "--mute-audio",
        "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", ...(job.engine.chromium ?? []),
        `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/`], { stdio: "ignore", detached: true, env: { ...process.env, TMPDIR: profile } });
    const stop = atEnd(() => endGroup(browser));
    browser.on("error", (error) => end.reject(new Error(`${job.chromium} cannot be started: ${error.message}; install Debian's chromium, or name one by CHROMIUM`)));
    browser.on("exit", () => end.reject(new Error(`${job.chromium} ended before the images were there`)));
    const timer = setTimeout(() => end.reject(new Error(`no end after ${MINUTES} minutes`)), MINUTES * 60000);
    try {
        return await done;
    } finally {
        clearTimeout(timer);
        server.close();
        server.closeAllConnections();
        stop();
        await new Promise((resolve) => (browser.exitCode !== null || browser.signalCode !== null || !browser.pid ? resolve() : browser.once("exit", resolve)));
        remove();
    }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    try {
        const job = parse(process.argv.slice(2));
        await render(job);
        console.log(`${join(job.out, "external.json")}: ${job.engine.engine} ${job.engine.version}, ${job.point}`);
    } catch (error) {
        console.error(`error: ${error instanceof Mistake ? error.message : error.stack}`);
        process.exit(error instanceof Mistake ? 2 : 3);
    }
}
