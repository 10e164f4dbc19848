// Renders with an engine that is a program of its own, not a page: engine.json has "program", the words of its command, in
// which ADAPTER stands for the adapter's folder.
//
// The command gets one more word, the path of request.json: {folder, scene, settings, seeds, out}, `scene` being scene.json's
// content. The program writes into `out`, for each view and frame, VIEW/fN.depth.f32, fN.off.f32, fN.s0.f32, ...: float32,
// first row at the top, one channel (depth) or three. Then it writes done.json: {"driver", "version"}. What it cannot
// do it prints as a line "error: SENTENCE", and ends with 2.
import { spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { atEnd, endGroup, removeFolder } from "./at_end.js";
import { Mistake } from "./mistake.js";

const LINES = 12;  // of its output, where it fails

/** On an X server of its own, so that no screen's driver or settings count. */
const on_display = (words) => ["xvfb-run", "-a", "-s", "-screen 0 640x480x24", ...words];

/** Resolves to what it printed, if it ended well. */
function ended(words, home, minutes) {
    return new Promise((resolve, reject) => {
        // A software rasteriser, so that images are the same on every machine; a home of its own: settings of the user's change nothing.
        const env = { ...process.env, HOME: home, TMPDIR: home, LIBGL_ALWAYS_SOFTWARE: "1" };
        for (const name of ["XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"]) delete env[name];
        const program = spawn(words[0], words.slice(1), { env, stdio: ["ignore", "pipe", "pipe"], detached: true });
        const stop = atEnd(() => endGroup(program));
        let text = "";
        for (const stream of [program.stdout, program.stderr]) stream.on("data", (bytes) => (text = (text + bytes).slice(-100000)));
        const last = () => text.trim().split("\n").slice(-LINES).join("\n");
        const timer = setTimeout(() => {
            stop();
            reject(new Error(`no end after ${minutes} minutes:\n${last()}`));
        }, minutes * 60000);
        program.on("error", (error) => reject(new Error(`${words[0]} cannot be started: ${error.message}; experiments/bridges/engines/run.sh installs it`)));
        program.on("exit", () => clearTimeout(timer));
        program.on("close", (code) => {
            stop();
            const said = text.split("\n").find((line) => line.startsWith("error: "));
            if (code === 0) resolve(text);
            else if (code === 2 && said) reject(new Mistake(said.slice("error: ".length)));
            else reject(new Error(`${words[0]} ended with ${code}:\n${last()}`));
        });
    });
}

function add_images(writer, scene, seeds, out) {
    for (const view of scene.views)
        for (const { frame } of view.frames) {
            const kinds = ["depth", "off", ...Array.from({ length: seeds }, (_, seed) => `s${seed}`)];
            for (const kind of kinds) {
                const bytes = readFileSync(join(out, view.view, `f${frame}.${kind}.f32`));
                const found = writer.add({
                    view: view.view,
                    frame,
                    kind,
                    components: kind === "depth" ? 1 : 3,
                    rows: "top",
                    values: new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)),
                });
                if (found) console.log(`${view.view}, frame ${frame}: ${found}`);
            }
        }
}

/** Resolves to done.json when `writer` has all images. `job`: of render.js; `minutes`: at most. */
export async function renderWithProgram({ job, scene, writer, minutes }) {
    const { adapter, folder, settings, seeds, engine } = job;
    const place = mkdtempSync(join(tmpdir(), "ssrlab-engine-")), out = join(place, "out"), home = join(place, "home");
    const remove = atEnd(() => removeFolder(place));
    try {
        for (const view of scene.views) mkdirSync(join(out, view.view), { recursive: true });
        mkdirSync(home);
        writeFileSync(join(place, "request.json"), JSON.stringify({ folder, scene, settings, seeds, out }));
        const words = [...engine.program.map((word) => word.replace("ADAPTER", adapter)), join(place, "request.json")];
        const text = await ended(engine.needs_display ? on_display(words) : words, home, minutes);
        if (!existsSync(join(out, "done.json"))) throw new Error(`${words[0]} wrote no images:\n${text.trim().split("\n").slice(-LINES).join("\n")}`);
        const done = JSON.parse(readFileSync(join(out, "done.json"), "utf8"));
        if (done.version !== engine.version)
            throw new Mistake(`${words[0]} is version ${done.version}; the adapter is for ${engine.version}, and others may mean something else by the same settings`);
        add_images(writer, scene, seeds, out);
        return done;
    } finally {
        remove();
    }
}
