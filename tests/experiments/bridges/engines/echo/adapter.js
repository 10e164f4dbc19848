// No engine: gives back what it got, so that everything around an engine is tested without any.
import { Mistake } from "ssrlab/mistake.js";
import { turned } from "ssrlab/page.js";

export async function open({ view, settings, scene }) {
    if (settings.wrong === "setting") throw new Mistake("wrong = setting: must be another");
    let light, frame;
    return {
        driver: "none",
        pose(posed, image) {
            frame = posed;
            light = image;
        },
        async depth() {
            const values = new Float32Array(await (await fetch(`/scene/${frame.depth_raw}`)).arrayBuffer());
            return { values: settings.wrong === "depth" ? values.map((v) => v * 1.1) : values, components: 1, rows: settings.wrong === "turned" ? "bottom" : "top" };
        },
        render({ reflections, seed }) {
            const values = turned(light).rgba;
            if (reflections && settings.wrong === "endless") return new Promise(() => {});
            if (settings.wrong === "light") values.fill(1);
            if (reflections) for (let i = 0; i < values.length; ++i) values[i] += settings.reflection * (1 + seed);
            if (reflections && settings.wrong === "NaN") values[5] = NaN;
            if (settings.wrong === "size") return { values: values.subarray(4), components: 4 };
            return { values, components: 4, rows: "bottom", milliseconds: reflections ? 1.5 : undefined };
        },
    };
}
