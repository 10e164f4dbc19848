"""Run by cycles_variance.py within Blender 3.4: imports a scene of ours and renders it with Cycles, several times.

usage: blender -b --factory-startup -P cycles_scene.py -- JOB.json

JOB.json holds `scene` (a scene.json with absolute paths), `size` (pixels), `seconds` (CPU time that a render should take), `adaptive` (whether
pixels end by a noise threshold), `seeds` and `out`, a folder: it receives `0.exr`, `1.exr`, ... of the seeds and `times.json`.
"""

import json
import math
import resource
import sys
from pathlib import Path

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).parent))
from cycles_materials import build_material, overridden  # noqa: E402

np.bool = bool  # Debian's glTF importer of Blender 3.4 uses the name, which its numpy has no more
BOUNCES = 64  # the default of `ssrlab reference --max-depth`
MOST_SAMPLES = 1 << 14
LEAST_THRESHOLD = 1e-3  # of noise, where pixels end by it


def blender_vector(v):
    """Ours is y up, Blender's z up."""
    return Vector((v[0], -v[2], v[1]))


def remove_faces(material):
    """Of all meshes, those with the material: an override hides it."""
    for mesh in bpy.data.meshes:
        slots = {i for i, m in enumerate(mesh.materials) if m == material}
        if slots:
            edited = bmesh.new()
            edited.from_mesh(mesh)
            bmesh.ops.delete(edited, geom=[f for f in edited.faces if f.material_index in slots], context="FACES")
            edited.to_mesh(mesh)
            edited.free()


def unmirror_emitters():
    """Where an object is mirrored, Cycles 3.4 takes the emitters' fronts for backs in light samples, but not in hits."""
    for mirrored in [o for o in bpy.data.objects if o.type == "MESH" and o.matrix_world.is_negative]:
        if any(n.type == "EMISSION" for m in mirrored.data.materials for n in m.node_tree.nodes):
            mirrored.data = mirrored.data.copy()
            mirrored.data.transform(mirrored.matrix_world)
            mirrored.data.flip_normals()
            mirrored.parent, mirrored.matrix_world = None, Matrix()


def add_light(light):
    """A light of scene.json. An intensity of I W/sr is a power of 4 pi I W; Blender's sun has W/m^2."""
    is_sun = light["type"] == "directional"
    data = bpy.data.lights.new(light["type"], "SUN" if is_sun else "POINT")
    data.energy = light["irradiance"] if is_sun else 4 * math.pi * light["intensity"]
    data.color = light.get("color", (1, 1, 1))
    added = bpy.data.objects.new(light["type"], data)
    if is_sun:
        data.angle = 0
        added.rotation_euler = blender_vector(light["direction"]).to_track_quat("-Z", "Y").to_euler()
    else:
        data.shadow_soft_size = 0
        added.location = blender_vector(light["position"])
    bpy.context.scene.collection.objects.link(added)


def make_world(environment):
    """Of scene.json's environment, (0.5 + atan2(z, x) / (2 pi), acos(y) / pi) of an image: Blender's mapping of the same direction is the same."""
    world = bpy.context.scene.world = bpy.data.worlds.new("world")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    if "image" in environment:
        image = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        image.image = bpy.data.images.load(environment["image"])
        world.node_tree.links.new(image.outputs["Color"], background.inputs["Color"])
        background.inputs["Strength"].default_value = environment.get("scale", 1)
    else:
        background.inputs["Color"].default_value = (*environment.get("constant", (0, 0, 0)), 1)


def make_camera(camera, size):
    """At frame 0 of a camera of scene.json."""
    first = camera["path"][0] if "path" in camera else camera
    eye, target = (blender_vector(first[k]) for k in ("position", "target"))
    back = (eye - target).normalized()
    right = blender_vector(camera.get("up", (0, 1, 0))).cross(back).normalized()
    scene, data = bpy.context.scene, bpy.data.cameras.new("camera")
    scene.camera = bpy.data.objects.new("camera", data)
    scene.camera.matrix_world = Matrix.Translation(eye) @ Matrix((right, back.cross(right), back)).transposed().to_4x4()
    data.sensor_fit = "HORIZONTAL"
    data.lens = data.sensor_width / 2 / (math.tan(math.radians(camera["vfov_deg"]) / 2) * size[0] / size[1])
    data.clip_start, data.clip_end = camera.get("near", 1e-3), 1e6
    scene.collection.objects.link(scene.camera)


def import_scene(scene, size):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for gltf in scene["gltfs"]:
        bpy.ops.import_scene.gltf(filepath=gltf)
    for material in list(bpy.data.materials):
        change = overridden(material, scene)
        if change.get("hidden"):
            remove_faces(material)
        elif material.node_tree:
            build_material(material, change)
    unmirror_emitters()
    for image in bpy.data.images:
        image.alpha_mode = "CHANNEL_PACKED"  # colours as they are, whatever their alpha
    for light in scene.get("lights", ()):
        add_light(light)
    make_world(scene.get("environment", {}))
    make_camera(scene["cameras"][0], size)


def set_up_cycles(size):
    """All light of up to BOUNCES reflections, one ray through the middle of each pixel, nothing clamped, filtered or left out."""
    scene = bpy.context.scene
    render, cycles = scene.render, scene.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage, render.threads_mode, render.threads = 100, "FIXED", 2
    render.use_persistent_data = True  # so that the times of later renders lack the scene's import and its BVH
    render.use_compositing = render.use_sequencer = False
    for kind in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "transparent_max_bounces"):
        setattr(cycles, kind, BOUNCES)
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.light_sampling_threshold = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.use_denoising = cycles.use_adaptive_sampling = cycles.use_auto_tile = cycles.use_guiding = False
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01  # pixels; a box would be one pixel wide
    settings = render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth, settings.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"


def render(samples, seed, out):
    """CPU seconds of a render with the scene already built."""
    scene = bpy.context.scene
    scene.cycles.samples, scene.cycles.seed, scene.render.filepath = samples, seed, str(out)
    before = resource.getrusage(resource.RUSAGE_SELF)
    bpy.ops.render.render(write_still=True)
    after = resource.getrusage(resource.RUSAGE_SELF)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def sample_limit(seconds, least, out):
    """Samples of each pixel for about `seconds`, and what they are called. `least`: the time of a render of one sample (s)."""
    trial = max((render(16, 1, out / "warm_up.exr") - least) / 15, 1e-4)
    samples = min(MOST_SAMPLES, 2 ** max(4, round(math.log2(seconds / trial))))  # powers of two suit Sobol' points best
    return samples, f"{samples} samples"


def adaptive_limit(seconds, least, out):
    """The same, for pixels that end by a noise threshold, which is set."""
    cycles = bpy.context.scene.cycles
    cycles.use_adaptive_sampling, threshold = True, 1.0
    spent = {}
    while not spent or (spent[threshold] < seconds and threshold > LEAST_THRESHOLD):
        threshold /= 2
        cycles.adaptive_threshold = threshold
        spent[threshold] = max(render(MOST_SAMPLES, 1, out / "warm_up.exr") - least, 1e-4)
    cycles.adaptive_threshold = min(spent, key=lambda t: abs(math.log(spent[t] / seconds)))
    return MOST_SAMPLES, f"a noise threshold of {cycles.adaptive_threshold:.4g}"


def main():
    job = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    out = Path(job["out"])
    import_scene(job["scene"], job["size"])
    set_up_cycles(job["size"])
    render(1, 1, out / "warm_up.exr")  # builds the BVH
    least = min(render(1, 1, out / "warm_up.exr") for _ in range(3))
    samples, limit = adaptive_limit(job["seconds"], least, out) if job["adaptive"] else sample_limit(job["seconds"], least, out)
    times = [render(samples, seed, out / f"{i}.exr") - least for i, seed in enumerate(job["seeds"])]
    (out / "times.json").write_text(json.dumps({"limit": limit, "seconds": times}))


main()
