// The scene of a folder of `ssrlab scene-for` in three.js, of any revision with an import map for "three" and "three/addons/".
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { turned } from "ssrlab/page.js";

/** Camera, meshes and the texture of light, which pose() fills. Without lights, environment and background. */
export async function loadScene({ glb, view }) {
    const scene = (await new GLTFLoader().loadAsync(glb)).scene, root = new THREE.Scene(), meshes = {};
    scene.traverse((object) => {
        if (object.isMesh) meshes[object.name] = object;
    });
    for (const mesh of Object.values(meshes)) {
        mesh.matrixAutoUpdate = false;
        mesh.frustumCulled = false;
        root.add(mesh);  // its matrix is that of the world
    }
    const camera = cameraOf(view), light = lightTexture(view);
    return {
        root, camera, meshes, light,
        /** Moves all to a frame of scene.json; `image`: its light, rows from the top. */
        pose(frame, image) {
            for (const [name, matrix] of Object.entries(frame.nodes)) {
                if (!meshes[name]) throw new Error(`scene.glb lacks the node '${name}' of scene.json`);
                meshes[name].matrix.fromArray(matrix);
                meshes[name].matrixWorldNeedsUpdate = true;
            }
            camera.matrix.fromArray(frame.world_from_camera);
            camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
            camera.updateMatrixWorld(true);
            light.image.data.set(turned(image).rgba);
            light.needsUpdate = true;
        },
    };
}

function cameraOf(view) {
    const { near, far } = view, aspect = view.width / view.height, half = view.orthographic_height / 2;
    const camera = view.orthographic_height
        ? new THREE.OrthographicCamera(-half * aspect, half * aspect, half, -half, near, far)
        : new THREE.PerspectiveCamera((view.vertical_fov * 180) / Math.PI, aspect, near, far);
    camera.updateProjectionMatrix();
    return camera;
}

/** Rows from the bottom, so that texelFetch(light, ivec2(gl_FragCoord.xy), 0) is a pixel's own. */
function lightTexture({ width, height }) {
    const texture = new THREE.DataTexture(new Float32Array(width * height * 4).fill(1), width, height, THREE.RGBAFormat, THREE.FloatType);
    texture.minFilter = texture.magFilter = THREE.NearestFilter;
    texture.generateMipmaps = false;
    return texture;
}

/**
 * The material emits `light` by its pixel, and, where `on.value` is 1, `add`, GLSL of what the engine shades: its specular
 * light of the environment, say, of which nothing is diffuse.
 */
export function emitLight(material, light, on = { value: 0 }, add = "vec3(0.0)") {
    material.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, { ssrlabLight: { value: light }, ssrlabOn: on });
        shader.fragmentShader = `uniform highp sampler2D ssrlabLight;\nuniform float ssrlabOn;\n` + shader.fragmentShader
            .replace(/#include <(opaque|output)_fragment>/,
                `gl_FragColor = vec4(texelFetch(ssrlabLight, ivec2(gl_FragCoord.xy), 0).rgb, 1.0);
                if (ssrlabOn > 0.0) gl_FragColor.rgb += ${add};`)
            .replace("#include <tonemapping_fragment>", "");
    };
    material.toneMapped = false;
    material.needsUpdate = true;
    return material;
}

/** GLSL of the specular light that reaches a standard material from scene.environment. */
export const SPECULAR_OF_ENVIRONMENT = "reflectedLight.indirectSpecular";

/** As scene.environment takes it; `background`: as page.js gives it. */
export function environmentTexture(background) {
    const { width, height, rgba } = turned(background);
    const texture = new THREE.DataTexture(rgba, width, height, THREE.RGBAFormat, THREE.FloatType);
    texture.mapping = THREE.EquirectangularReflectionMapping;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.wrapS = THREE.RepeatWrapping;
    texture.needsUpdate = true;
    return texture;
}

/** Replaces the materials of all meshes by `make(material)`, each once. */
export function replaceMaterials(meshes, make) {
    const made = new Map();
    for (const mesh of Object.values(meshes)) {
        if (!made.has(mesh.material)) made.set(mesh.material, make(mesh.material));
        mesh.material = made.get(mesh.material);
    }
}

/** Draws `draw()` into a target of 32-bit floats and reads it. */
export function readFloats(renderer, { width, height }, draw) {
    const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
    const values = new Float32Array(width * height * 4);
    renderer.setRenderTarget(target);
    draw(target);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, values);
    renderer.setRenderTarget(null);
    target.dispose();
    return { values, components: 4, rows: "bottom" };
}

/** Distance along the view's axis (m), 0 where nothing is: what page.js checks. */
export function drawDepth(renderer, { root, camera }, view) {
    const materials = new Map(), background = root.background;
    root.background = null;
    root.traverse((object) => {
        if (!object.isMesh) return;
        const { map, alphaTest } = object.material;
        materials.set(object, object.material);
        object.material = new THREE.ShaderMaterial({
            side: THREE.DoubleSide,
            uniforms: { map: { value: map }, cutoff: { value: map ? alphaTest : 0 }, transform: { value: map ? map.matrix : new THREE.Matrix3() } },
            vertexShader: `varying float distance_; varying vec2 at; uniform mat3 transform;
                void main() { vec4 p = modelViewMatrix * vec4(position, 1.0); distance_ = -p.z; at = (transform * vec3(uv, 1.0)).xy; gl_Position = projectionMatrix * p; }`,
            fragmentShader: `varying float distance_; varying vec2 at; uniform sampler2D map; uniform float cutoff;
                void main() { if (cutoff > 0.0 && texture2D(map, at).a < cutoff) discard; gl_FragColor = vec4(distance_, 0.0, 0.0, 1.0); }`,
        });
    });
    const image = readFloats(renderer, view, () => {
        renderer.setClearColor(0x000000, 0);
        renderer.clear();
        renderer.render(root, camera);
    });
    materials.forEach((material, object) => {
        object.material.dispose();
        object.material = material;
    });
    root.background = background;
    return image;
}
