// three.js: SSRPass of the examples. README.md of the folder above lists its traps.
import * as THREE from "three";
import { SSRPass } from "three/addons/postprocessing/SSRPass.js";
import { driverOf } from "ssrlab/page.js";
import { drawDepth, emitLight, loadScene, readFloats, replaceMaterials } from "ssrlab/three_scene.js";

/** The pass reflects in chosen objects, fully or not at all, and knows nothing of roughness and F0. */
const SELECTS = {
    metals: (material) => material.metalness >= 0.5,
    mirrors: (material) => material.metalness >= 0.5 && material.roughness <= 0.1,
    all: () => true,
};

export async function open({ view, settings, canvas, glb }) {
    const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, alpha: true });
    renderer.setPixelRatio(1);
    renderer.setSize(view.width, view.height, false);
    renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    renderer.toneMapping = THREE.NoToneMapping;
    const loaded = await loadScene({ glb, view }), { root, camera, meshes, light } = loaded;
    if (!(settings.selects in SELECTS)) throw new Error(`selects = ${settings.selects}: must be ${Object.keys(SELECTS).join(", ")}`);
    const selects = Object.values(meshes).filter((mesh) => SELECTS[settings.selects](mesh.material));
    replaceMaterials(meshes, (material) => emitLight(material, light));
    root.background = light;  // pixel by pixel, too

    const pass = new SSRPass({ renderer, scene: root, camera, width: view.width, height: view.height, selects });
    for (const [name, value] of Object.entries(settings)) if (name !== "selects") pass[name] = value;
    return {
        driver: driverOf(renderer.getContext()),
        pose: (frame, image) => loaded.pose(frame, image),
        depth: () => drawDepth(renderer, loaded, view),
        render: ({ reflections }) =>
            readFloats(renderer, view, (target) => {
                if (!reflections) return renderer.render(root, camera);
                pass.render(renderer, target);
            }),
    };
}
