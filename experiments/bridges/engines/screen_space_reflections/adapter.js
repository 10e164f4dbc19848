// The npm package screen-space-reflections, an effect of postprocessing for three.js. README.md says what was seen to matter.
import * as THREE from "three";
import { EffectComposer, EffectPass, Pass, RenderPass } from "postprocessing";
import { SSREffect } from "screen-space-reflections";
import { exposed, exposureOf, scaled } from "ssrlab/light.js";
import { Mistake } from "ssrlab/mistake.js";
import { driverOf } from "ssrlab/page.js";
import { SPECULAR_OF_ENVIRONMENT, drawDepth, emitLight, environmentTexture, loadScene, replaceMaterials } from "ssrlab/three_scene.js";

const JITTERS_OF_SEED = 37;  // of its 1,024 jitters of the camera, between the first ones of two seeds
const SELECTIONS = { all: () => true, metals: (material) => material.metalness >= 0.5 };
const OWN = ["selection", "environment", "materialEnvironment", "exposure", "frames"];

/** The light of all pixels, onto which meshes are drawn: a background of the scene would be drawn into the effect's buffers. */
class LightPass extends Pass {
    constructor(light) {
        super("ssrlab light");
        this.needsSwap = false;
        this.fullscreenMaterial = new THREE.ShaderMaterial({
            glslVersion: THREE.GLSL3, depthTest: false, depthWrite: false, uniforms: { light: { value: light } },
            vertexShader: "void main() { gl_Position = vec4(position.xy, 1.0, 1.0); }",
            fragmentShader: "uniform highp sampler2D light; out highp vec4 color; void main() { color = vec4(texelFetch(light, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }",
        });
    }
    render(renderer, target) {
        renderer.setRenderTarget(target);
        renderer.clear();
        renderer.render(this.scene, this.camera);
    }
}

export async function open({ view, settings, background, light: light_of, canvas, glb }) {
    const { width, height } = view;
    const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, alpha: true });
    renderer.setPixelRatio(1);
    renderer.setSize(width, height, false);
    renderer.outputEncoding = THREE.LinearEncoding;
    renderer.toneMapping = THREE.NoToneMapping;
    renderer.setClearColor(0x000000, 0);
    const exposure = exposureOf(settings.exposure, await light_of(view.frames[0]));
    // Filtered here: the effect takes the size of the levels from the scene's texture.
    const environment = settings.environment
        ? new THREE.PMREMGenerator(renderer).fromEquirectangular(environmentTexture(exposed(background, exposure))).texture : null;
    const loaded = await loadScene({ glb, view }), { root, camera, meshes, light } = loaded;
    if (!(settings.selection in SELECTIONS)) throw new Mistake(`selection = ${settings.selection}: must be ${Object.keys(SELECTIONS).join(", ")}`);
    const selected = Object.values(meshes).filter((mesh) => SELECTIONS[settings.selection](mesh.material));
    const on = { value: 0 };
    replaceMaterials(meshes, (material) => emitLight(material, light, on, settings.materialEnvironment ? SPECULAR_OF_ENVIRONMENT : "vec3(0.0)"));

    const effectOf = (seed) => {
        const options = Object.fromEntries(Object.entries(settings).filter(([key]) => !OWN.includes(key)));
        const effect = new SSREffect(root, camera, { ...options, width, height });
        effect.haltonIndex = (seed * JITTERS_OF_SEED) % effect.haltonSequence.length;
        if (settings.selection !== "all") effect.selection.set(selected);
        return effect;
    };
    return {
        driver: driverOf(renderer.getContext()),
        pose: (frame, image) => loaded.pose(frame, exposed(image, exposure)),
        depth: () => drawDepth(renderer, loaded, view),
        render({ reflections, seed }) {
            root.environment = reflections ? environment : null;
            on.value = reflections ? 1 : 0;
            renderer.autoClear = false;
            const composer = new EffectComposer(renderer, { frameBufferType: THREE.FloatType });
            composer.autoRenderToScreen = false;
            composer.setSize(width, height, false);
            const meshes_pass = new RenderPass(root, camera);
            meshes_pass.clearPass.enabled = false;
            composer.addPass(new LightPass(light));
            composer.addPass(meshes_pass);
            if (reflections) composer.addPass(new EffectPass(camera, effectOf(seed)));
            for (let i = 0; i < (reflections ? settings.frames : 1); ++i) composer.render(1 / 60);
            const values = new Float32Array(4 * width * height);
            // Only the effect exchanges the buffers.
            renderer.readRenderTargetPixels(reflections ? composer.outputBuffer : composer.inputBuffer, 0, 0, width, height, values);
            composer.dispose();
            renderer.autoClear = true;
            return { values: scaled(values, 1 / exposure) };
        },
    };
}
