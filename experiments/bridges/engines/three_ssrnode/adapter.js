// three.js SSRNode: WebGPURenderer on its WebGL 2 backend. README.md says what was seen to matter.
import * as THREE from "three/webgpu";
import * as TSL from "three/tsl";
import { ssr } from "three/addons/tsl/display/SSRNode.js";
import { temporalReproject } from "three/addons/tsl/display/TemporalReprojectNode.js";
import { recurrentDenoise } from "three/addons/tsl/display/RecurrentDenoiseNode.js";
import { exposed, exposureOf, scaled, settingsOf } from "ssrlab/light.js";
import { driverOf } from "ssrlab/page.js";
import { environmentTexture, loadScene, replaceMaterials } from "ssrlab/three_scene.js";

const MOST_FRAMES = 4096;  // of an image: random numbers follow from the frame's number
const CONSTRUCTOR = ["stochastic", "reflectNonMetals", "binaryRefine", "envImportanceSampling"];
const UNIFORMS = ["maxDistance", "thickness", "intensity", "quality", "screenEdgeFade", "maxLuminance", "mirrorBias", "environmentIntensity"];
const PROPERTIES = ["resolutionScale", "blurQuality", "screenEdgeFadeBlack", "stepExponent"];

/** The environment's specular light alone: diffuse light is part of what surfaces emit. */
class SpecularOnly extends THREE.PhysicalLightingModel {
    indirect(builder) {
        super.indirect(builder);
        builder.context.reflectedLight.indirectDiffuse.assign(0);
    }
}

/** A material that emits the light of its pixel. */
function lit(material, light) {
    const node = new (material.isMeshPhysicalMaterial ? THREE.MeshPhysicalNodeMaterial : THREE.MeshStandardNodeMaterial)();
    node.copy(material);
    node.emissiveNode = light.rgb;
    node.setupLightingModel = () => new SpecularOnly();
    return node;
}

/** The node with what it reads, and its reflections. */
function reflected(scene_pass, camera, settings, environment) {
    const bytes = settings.byteNormals, packed = bytes || settings.denoise;
    scene_pass.setMRT(TSL.mrt({
        output: TSL.output,
        normal: packed ? TSL.packNormalToRGB(TSL.normalView) : TSL.normalView,
        metalrough: TSL.vec2(TSL.metalness, TSL.roughness),
        specular: TSL.specularColorBlended,
        velocity: TSL.velocity,
    }));
    const [color, depth, normal, metal_rough, specular, velocity] =
        ["output", "depth", "normal", "metalrough", "specular", "velocity"].map((name) => scene_pass.getTextureNode(name));
    if (bytes) scene_pass.getTexture("normal").type = THREE.UnsignedByteType;
    const node = ssr(color, depth, packed ? TSL.sample((uv) => TSL.unpackRGBToNormal(normal.sample(uv))) : normal, {
        metalnessNode: metal_rough.r,
        roughnessNode: settings.blur || settings.stochastic ? metal_rough.g : TSL.float(0),
        ...(settings.stochastic ? { specularNode: specular.rgb, environmentNode: environment } : {}),
        ...Object.fromEntries(CONSTRUCTOR.map((key) => [key, settings[key]])),
    });
    for (const key of UNIFORMS) node[key].value = settings[key];
    for (const key of PROPERTIES) node[key] = settings[key];
    if (!settings.denoise) return { node, reflections: node.rgb };
    const history = temporalReproject(node, depth, normal, velocity, camera, { mode: "specular" });
    const filter = recurrentDenoise(history, camera, { depth, normal, raw: node, metalRoughness: metal_rough, mode: "specular" });
    history.setHistoryTexture(filter);
    for (const [key, value] of Object.entries(settingsOf(settings, "reproject"))) history[key].value = value;
    for (const [key, value] of Object.entries(settingsOf(settings, "denoise"))) filter[key].value = value;
    return { node, history, reflections: filter.rgb };
}

export async function open({ view, settings, background, light, canvas, glb }) {
    const { width, height } = view;
    const renderer = new THREE.WebGPURenderer({ canvas, forceWebGL: true, antialias: false });
    await renderer.init();
    if (!renderer.backend.isWebGLBackend) throw new Error("three.js did not take its WebGL 2 backend");
    renderer.setPixelRatio(1);
    renderer.setSize(width, height, false);
    const exposure = exposureOf(settings.exposure, await light(view.frames[0]));
    const environment = settings.environment ? environmentTexture(exposed(background, exposure)) : null;
    const loaded = await loadScene({ glb, view }), { root: scene, camera, meshes } = loaded;
    const pixel = TSL.ivec2(TSL.screenCoordinate.xy);  // rows from the top
    const light_of_pixel = TSL.textureLoad(loaded.light, TSL.ivec2(pixel.x, TSL.int(height - 1).sub(pixel.y)));
    replaceMaterials(meshes, (material) => lit(material, light_of_pixel));
    scene.backgroundNode = light_of_pixel;

    const scene_pass = TSL.pass(scene, camera);
    const { node, history, reflections: added } = reflected(scene_pass, camera, settings, environment);
    // Texel by texel: filtered at a texel's centre, software rasterisers mix in 1/256 of the neighbours.
    const color = scene_pass.getTextureNode("output").load(pixel).rgb;
    const is_background = TSL.isBackgroundDepth(scene_pass.getTextureNode("depth").r);
    const pipelines = {
        image: TSL.vec4(color.add(added), 1),
        off: TSL.vec4(color, 1),
        depth: TSL.vec4(TSL.vec3(is_background.select(0, scene_pass.getViewZNode().negate())), 1),
    };
    const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType, depthBuffer: false });
    for (const [name, output] of Object.entries(pipelines)) {
        pipelines[name] = new THREE.RenderPipeline(renderer, output);
        pipelines[name].outputColorTransform = false;
    }
    // Nodes draw once per frame of the browser's clock: frames are counted here, so that images are the same every time.
    renderer._animation.stop();
    const clock = renderer._nodes.nodeFrame;
    let images = 0;
    const read = async (pipeline, frames) => {
        clock.frameId = node._noiseIndex.value = MOST_FRAMES * ++images;
        renderer.setRenderTarget(target);
        for (let i = 0; i < frames; ++i) {
            clock.update();
            pipeline.render();
        }
        const values = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
        renderer.setRenderTarget(null);
        return values;
    };
    return {
        driver: driverOf(renderer.backend.gl),
        pose: (frame, image) => loaded.pose(frame, exposed(image, exposure)),
        async depth() {
            scene.environment = null;
            return { values: await read(pipelines.depth, 1) };
        },
        async render({ reflections }) {
            scene.environment = reflections && !settings.stochastic ? environment : null;
            history?._historyRenderTarget.setSize(1, 1);  // another size than the frame's: the history starts anew
            const values = await read(reflections ? pipelines.image : pipelines.off, reflections ? settings.frames : 1);
            return { values: scaled(values, 1 / exposure) };
        },
    };
}
