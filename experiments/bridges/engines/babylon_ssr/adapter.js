// Babylon.js SSRRenderingPipeline. README.md says what was seen to matter.
import { Engine } from "@babylonjs/core/Engines/engine.js";
import "@babylonjs/core/Engines/Extensions/engine.multiRender.js";
import "@babylonjs/core/Engines/Extensions/engine.rawTexture.js";
import "@babylonjs/core/Engines/Extensions/engine.readTexture.js";
import "@babylonjs/core/Engines/Extensions/engine.renderTarget.js";
import "@babylonjs/core/Engines/Extensions/engine.renderTargetCube.js";
import { Scene } from "@babylonjs/core/scene.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Matrix, Quaternion, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { CubeMapToSphericalPolynomialTools } from "@babylonjs/core/Misc/HighDynamicRange/cubemapToSphericalPolynomial.js";
import { HDRFiltering } from "@babylonjs/core/Materials/Textures/Filtering/hdrFiltering.js";
import { RawCubeTexture } from "@babylonjs/core/Materials/Textures/rawCubeTexture.js";
import { RawTexture } from "@babylonjs/core/Materials/Textures/rawTexture.js";
import { MaterialPluginBase } from "@babylonjs/core/Materials/materialPluginBase.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { ShaderMaterial } from "@babylonjs/core/Materials/shaderMaterial.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { VertexData } from "@babylonjs/core/Meshes/mesh.vertexData.js";
import { ImageProcessingPostProcess } from "@babylonjs/core/PostProcesses/imageProcessingPostProcess.js";
import { SSRRenderingPipeline } from "@babylonjs/core/PostProcesses/RenderPipeline/Pipelines/ssrRenderingPipeline.js";
import "@babylonjs/core/PostProcesses/RenderPipeline/postProcessRenderPipelineManagerSceneComponent.js";
import { LoadAssetContainerAsync } from "@babylonjs/core/Loading/sceneLoader.js";
import "@babylonjs/loaders/glTF/2.0/index.js";
import { exposed, exposureOf, scaled } from "ssrlab/light.js";
import { Mistake } from "ssrlab/mistake.js";
import { driverOf, turned } from "ssrlab/page.js";

const BYTE = 0, FLOAT = 1, HALF = 2, RGBA = 5, NEAREST = 1, TRILINEAR = 3, PRE_PASS_DEPTH = 5;  // of Babylon's Constants
const TEXTURE_TYPES = { byte: BYTE, half: HALF, float: FLOAT };
const OWN = ["forceGeometryBuffer", "textureType", "useScreenspaceDepth", "environment", "environmentSize", "exposure"];

/** Surfaces emit the light of their pixel; of the environment's light only the specular part stays. */
class PixelLight extends MaterialPluginBase {
    constructor(material, light) {
        super(material, "PixelLight", 200, {});
        this.light = light;
        this._enable(true);
    }
    getSamplers(names) {
        names.push("ssrlabLight");
    }
    bindForSubMesh(uniforms) {
        uniforms.setTexture("ssrlabLight", this.light);
    }
    getCustomCode(stage) {
        if (stage !== "fragment") return null;
        return {
            CUSTOM_FRAGMENT_DEFINITIONS: "uniform highp sampler2D ssrlabLight;",
            CUSTOM_FRAGMENT_BEFORE_FINALCOLORCOMPOSITION: `finalEmissive = texelFetch(ssrlabLight, ivec2(gl_FragCoord.xy), 0).rgb;
                #ifdef REFLECTION
                finalIrradiance = vec3(0.0);
                #endif`,
        };
    }
}

/** Behind everything, and only in the colour target: the other targets of the pre-pass keep their cleared values there. */
function drawBackground(scene, light) {
    const mesh = new Mesh("ssrlab background", scene), triangle = new VertexData();
    triangle.positions = [-1, -1, 0, 3, -1, 0, -1, 3, 0];
    triangle.indices = [0, 1, 2];
    triangle.applyToMesh(mesh);
    const material = new ShaderMaterial("ssrlab background", scene, {
        vertexSource: "attribute vec3 position; void main() { gl_Position = vec4(position.xy, 1.0, 1.0); }",
        fragmentSource: `precision highp float; uniform highp sampler2D ssrlabLight;
            void main() { gl_FragColor = vec4(texelFetch(ssrlabLight, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }`,
    }, { attributes: ["position"], samplers: ["ssrlabLight"] });
    material.setTexture("ssrlabLight", light);
    material.backFaceCulling = false;
    material.disableDepthWrite = true;
    mesh.material = material;
    mesh.alwaysSelectAsActiveMesh = true;
}

/** Faces +x, -x, +y, -y, +z, -z of the environment in Babylon's left-handed world, in which glTF's x is -x. */
function cubeOf({ width, height, rgba }, size) {
    const directions = [(s, t) => [1, -t, -s], (s, t) => [-1, -t, s], (s, t) => [s, 1, t], (s, t) => [s, -1, -t], (s, t) => [s, -t, 1], (s, t) => [-s, -t, -1]];
    return directions.map((direction) => {
        const face = new Float32Array(4 * size * size);
        for (let row = 0; row < size; ++row)
            for (let column = 0; column < size; ++column) {
                const [x, y, z] = direction((2 * column + 1) / size - 1, (2 * row + 1) / size - 1);
                const u = 0.5 + Math.atan2(z, -x) / (2 * Math.PI), v = Math.acos(y / Math.hypot(x, y, z)) / Math.PI;
                const from = 4 * (Math.min(height - 1, Math.floor(v * height)) * width + (Math.floor(u * width) % width));
                face.set(rgba.subarray(from, from + 4), 4 * (row * size + column));
            }
        return face;
    });
}

async function environmentOf(background, exposure, largest, scene, engine) {
    const size = Math.min(largest, background.height / 2);
    const faces = cubeOf(exposed(background, exposure), size), [right, left, up, down, front, back] = faces;
    const cube = new RawCubeTexture(scene, faces, size, RGBA, FLOAT, true, false, TRILINEAR);
    cube.gammaSpace = false;
    // Irradiance, which materials mix into the specular light of rough surfaces.
    cube.sphericalPolynomial = CubeMapToSphericalPolynomialTools.ConvertCubeMapToSphericalPolynomial(
        { size, right, left, up, down, front, back, format: RGBA, type: FLOAT, gammaSpace: false });
    await new HDRFiltering(engine).prefilter(cube);
    return cube;
}

function cameraOf(view, scene) {
    const camera = new FreeCamera("ssrlab", new Vector3(), scene);
    camera.fov = view.vertical_fov ?? camera.fov;
    camera.minZ = view.near;
    camera.maxZ = view.far;
    if (view.orthographic_height) {
        const half = view.orthographic_height / 2, aspect = view.width / view.height;
        Object.assign(camera, { mode: FreeCamera.ORTHOGRAPHIC_CAMERA, orthoLeft: -half * aspect, orthoRight: half * aspect, orthoBottom: -half, orthoTop: half });
    }
    return camera;
}

export async function open({ view, settings, background, light: light_of, canvas, glb }) {
    const { width, height } = view;
    const engine = new Engine(canvas, false, { antialias: false, alpha: false }, false);
    const scene = new Scene(engine);
    scene.imageProcessingConfiguration.skipFinalColorClamp = true;
    const exposure = exposureOf(settings.exposure, await light_of(view.frames[0]));
    const light = RawTexture.CreateRGBATexture(new Float32Array(4 * width * height), width, height, scene, false, false, NEAREST, FLOAT);

    const file = new File([await (await fetch(glb)).blob()], "scene.glb");
    const container = await LoadAssetContainerAsync(file, scene, { pluginExtension: ".glb" });
    container.addAllToScene();
    for (const unwanted of [...scene.lights, ...scene.cameras]) unwanted.dispose();
    for (const material of scene.materials) if (material instanceof PBRMaterial) new PixelLight(material, light);
    drawBackground(scene, light);
    const camera = (scene.activeCamera = cameraOf(view, scene));
    const environment = settings.environment ? await environmentOf(background, exposure, settings.environmentSize, scene, engine) : null;

    const pipelineOf = (settings) => {
        const type = TEXTURE_TYPES[settings.textureType];
        if (type === undefined) throw new Mistake(`textureType = ${settings.textureType}: must be ${Object.keys(TEXTURE_TYPES).join(", ")}`);
        const pipeline = new SSRRenderingPipeline("ssrlab", scene, [camera], settings.forceGeometryBuffer, type, settings.useScreenspaceDepth);
        pipeline.inputTextureColorIsInGammaSpace = pipeline.generateOutputInGammaSpace = false;
        pipeline.environmentTexture = environment;
        for (const [key, value] of Object.entries(settings)) if (!OWN.includes(key)) pipeline[key] = value;
        return pipeline;
    };
    /** Draws, with reflections if there are settings of them, and reads what `texture` returns of the last post-process. */
    const draw = async (of_reflections, texture) => {
        const pipeline = of_reflections ? pipelineOf(of_reflections) : null;
        scene.environmentTexture = of_reflections ? environment : null;
        // It makes materials write linear light, and is the last in the chain: what it reads is the image.
        const last = new ImageProcessingPostProcess("ssrlab", 1, camera, NEAREST, engine, false, FLOAT);
        await scene.whenReadyAsync();
        for (let i = 0; i < 3; ++i) {  // the first ones rebuild the pre-pass, and miss effects that are still compiled
            scene.render();
            await new Promise((done) => setTimeout(done, 10));
        }
        const pixels = await engine._readTexturePixels(texture(last), width, height, -1, 0, null, true, false);
        last.dispose(camera);
        pipeline?.dispose();
        return new Float32Array(pixels.buffer, pixels.byteOffset, pixels.byteLength / 4);
    };
    return {
        driver: driverOf(engine._gl),
        pose(frame, image) {
            light.update(turned(exposed(image, exposure)).rgba);
            // glTF's right-handed world as Babylon's loader turns it: x is -x.
            const m = frame.world_from_camera, point = (x, y, z) => new Vector3(-x, y, z);
            camera.position = point(m[12], m[13], m[14]);
            camera.rotationQuaternion = Quaternion.RotationQuaternionFromAxis(point(m[0], m[1], m[2]), point(m[4], m[5], m[6]), point(-m[8], -m[9], -m[10]));
            for (const [name, matrix] of Object.entries(frame.nodes)) {
                const node = scene.getNodeByName(name);
                if (!node) throw new Error(`scene.glb lacks the node '${name}' of scene.json`);
                node.freezeWorldMatrix(Matrix.FromArray(matrix).multiply(node.parent.computeWorldMatrix(true)));
            }
        },
        /** What the rays are traced through: the pre-pass's depth, which is cleared to 0. */
        async depth() {
            const values = await draw({ ...settings, forceGeometryBuffer: false, useScreenspaceDepth: false }, () => {
                const pre_pass = scene.prePassRenderer;
                return pre_pass.getRenderTarget().textures[pre_pass.getIndex(PRE_PASS_DEPTH)].getInternalTexture();
            });
            return { values, components: values.length / (width * height) };
        },
        async render({ reflections }) {
            const values = await draw(reflections ? settings : null, (last) => last.inputTexture.texture);
            return { values: scaled(values, 1 / exposure) };
        },
    };
}
