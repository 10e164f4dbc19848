// A folder of `ssrlab scene-for`, which may come from a stranger: what scene.json names lies in the folder, or it is refused.
import { lstatSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { Mistake } from "./mistake.js";

/** A file's content; a Mistake where it cannot be read. */
export function jsonOf(file) {
    try {
        return JSON.parse(readFileSync(file, "utf8"));
    } catch (error) {
        throw new Mistake(`${file} cannot be read as JSON: ${error.message}`);
    }
}

/** The path below `folder` of what a file calls `name`, by the rule of core/path_inside.h: relative, without "..", and through no link. */
export function pathInside(folder, name) {
    const parts = typeof name === "string" ? name.split("/") : [];
    if (!name || !parts.length || name.startsWith("/") || name.includes("\0") || parts.includes(".."))
        throw new Mistake(`${JSON.stringify(name)} is no path below ${folder}: such a name is relative and has no '..'`);
    let path = folder;
    for (const part of parts) {
        path = join(path, part);
        if (lstatSync(path, { throwIfNoEntry: false })?.isSymbolicLink())
            throw new Mistake(`${path} is a symbolic link, which may lead out of ${folder} and is not followed; put what it points to in its place`);
    }
    return path;
}

const FILES_OF_BACKGROUND = ["image", "hdr", "raw"], FILES_OF_FRAMES = ["light", "depth", "light_raw", "depth_raw"];

/** Two views more, of one in whose frames each half of the light's samples is known: as it is, but in the light of one half. */
function viewsOfHalves(view) {
    if (!view.frames.every((frame) => frame.light_halves)) return [];
    return ["half_a", "half_b"].map((half, h) => ({
        ...view,
        view: `${view.view}.${half}`,
        half,
        half_of: view.view,
        frames: view.frames.map((frame) => ({ ...frame, light: frame.light_halves[h], light_raw: frame.light_halves_raw?.[h] })),
    }));
}

/** The folder's scene.json, of which programs, too, may take names of files and views as they are; views of halves of the light come with it. */
export function readScene(folder) {
    const scene = jsonOf(join(folder, "scene.json"));
    const check = (owner, keys) => keys.forEach((key) => owner[key] === undefined || pathInside(folder, owner[key]));
    if (!Array.isArray(scene?.views) || !scene.background) throw new Mistake(`${folder}/scene.json has no views or no background: ssrlab scene-for writes both`);
    check(scene, ["meshes"]);
    check(scene.background, FILES_OF_BACKGROUND);
    for (const view of scene.views) {
        pathInside(folder, view.view);
        for (const frame of view.frames) {
            if (!Number.isInteger(frame.frame)) throw new Mistake(`${folder}/scene.json: 'frame' = ${JSON.stringify(frame.frame)} is no whole number`);
            check(frame, FILES_OF_FRAMES);
            for (const halves of [frame.light_halves, frame.light_halves_raw]) halves?.forEach((file) => pathInside(folder, file));
        }
    }
    scene.views = scene.views.flatMap((view) => [view, ...viewsOfHalves(view)]);
    return scene;
}
