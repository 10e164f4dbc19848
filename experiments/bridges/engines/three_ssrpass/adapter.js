// three.js: SSRPass of the examples. README.md of the folder above lists its traps.
import * as THREE from "three";
import { SSRPass } from "three/addons/postprocessing/SSRPass.js";
import { Mistake } from "ssrlab/mistake.js";
import { driverOf } from "ssrlab/page.js";
import {
    SPECULAR_OF_ENVIRONMENT, drawDepth, emitLight, environmentTexture, loadScene, readFloats, replaceMaterials,
} from "ssrlab/three_scene.js";

/** The pass reflects in chosen objects, fully or not at all, and knows nothing of roughness and F0. */
const SELECTS = {
    metals: (material) => material.metalness >= 0.5,
    mirrors: (material) => material.metalness >= 0.5 && material.roughness <= 0.1,
    smooth: (material) => material.roughness <= 0.3,
    all: () => true,
};

export async function open({ view, settings, background, canvas, glb }) {
    const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, alpha: true });
    renderer.setPixelRatio(1);
    renderer.setSize(view.width, view.height, false);
    renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    renderer.toneMapping = THREE.NoToneMapping;
    const loaded = await loadScene({ glb, view }), { root, camera, meshes, light } = loaded;
    if (!(settings.selects in SELECTS)) throw new Mistake(`selects = ${settings.selects}: must be ${Object.keys(SELECTS).join(", ")}`);
    const selects = Object.values(meshes).filter((mesh) => SELECTS[settings.selects](mesh.material));
    const on = { value: 0 };
    replaceMaterials(meshes, (material) => emitLight(material, light, on, SPECULAR_OF_ENVIRONMENT));
    root.background = light;  // pixel by pixel, too
    if (settings.environment) root.environment = environmentTexture(background);

    const pass = new SSRPass({ renderer, scene: root, camera, width: view.width, height: view.height, selects });
    const { selects: _, environment: __, ...own } = settings;
    Object.assign(pass, own);
    return {
        driver: driverOf(renderer.getContext()),
        pose: (frame, image) => loaded.pose(frame, image),
        depth: () => drawDepth(renderer, loaded, view),
        render: ({ reflections }) =>
            readFloats(renderer, view, (target) => {
                on.value = Number(reflections);
                if (!reflections) return renderer.render(root, camera);
                pass.render(renderer, target);
            }),
    };
}
