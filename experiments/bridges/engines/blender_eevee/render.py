"""Renders a folder of `ssrlab scene-for` with Blender's EEVEE (README.md beside this file).

Run by render.sh as blender -b -P render.py -- REQUEST.json; ../shared/program.js says what it reads and writes.
"""

import json
import sys
import tempfile
from pathlib import Path

import bpy
import gpu
import numpy as np
from mathutils import Matrix

Y_UP_TO_Z_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
DIELECTRIC_F0 = 0.04
OWN_SETTINGS = ("environment",)  # of this adapter; the others are properties of Scene.eevee


class AdapterError(Exception):
    """The scene or a setting cannot be used: one sentence."""


def gltf_of(path):
    data = path.read_bytes()
    return json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])


def load_objects(path):
    """Imports the glTF into an empty file; returns its meshes by the names of their nodes."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    np.bool = bool  # the importer of 3.4 uses a name that numpy removed in 1.24
    bpy.ops.import_scene.gltf(filepath=str(path), import_shading="NORMALS")
    for thing in list(bpy.data.objects):
        if thing.type != "MESH":
            bpy.data.objects.remove(thing)
    return {o.name: o for o in bpy.data.objects}


def linked_or_value(tree, socket):
    """The output that feeds `socket`, or that of a new node with its value."""
    if socket.is_linked:
        return socket.links[0].from_socket
    node = tree.nodes.new("ShaderNodeRGB" if socket.type == "RGBA" else "ShaderNodeValue")
    node.outputs[0].default_value = socket.default_value
    return node.outputs[0]


class Emitters:
    """What surfaces and the background show: the light image by the window's pixel, or the depth along the view."""

    def __init__(self):
        self._inputs = []

    def add(self, tree, target, is_surface):
        window, image = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeTexImage")
        image.interpolation, image.extension = "Closest", "EXTEND"
        tree.links.new(window.outputs["Window"], image.inputs["Vector"])
        depth = tree.nodes.new("ShaderNodeCameraData").outputs["View Z Depth"]
        if not is_surface:  # which is at no distance
            depth = tree.nodes.new("ShaderNodeValue").outputs[0]
            depth.default_value = 0
        self._inputs.append((tree, target, image, depth))

    def show(self, light):
        """`light`: an image, or None for the depth."""
        for tree, target, image, depth in self._inputs:
            image.image = light
            tree.links.new(image.outputs["Color"] if light else depth, target)


def make_emitter(material, specular, emitters):
    """Emits what `emitters` show, and keeps the mirror lobe alone: the shader becomes a metal of the reflectance at normal
    incidence, which has no diffuse part and the same lobe. `specular`: the factor of KHR_materials_specular, which the
    importer does not read."""
    tree = material.node_tree
    shader = next((n for n in tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled"), None)
    if shader is None:  # KHR_materials_unlit
        tree.nodes.clear()
        shader, end = tree.nodes.new("ShaderNodeBsdfPrincipled"), tree.nodes.new("ShaderNodeOutputMaterial")
        tree.links.new(shader.outputs[0], end.inputs["Surface"])
        specular = 0
    reflectance = tree.nodes.new("ShaderNodeMixRGB")
    reflectance.inputs["Color1"].default_value = (*[DIELECTRIC_F0 * specular] * 3, 1)
    tree.links.new(linked_or_value(tree, shader.inputs["Base Color"]), reflectance.inputs["Color2"])
    tree.links.new(linked_or_value(tree, shader.inputs["Metallic"]), reflectance.inputs["Fac"])
    tree.links.new(reflectance.outputs["Color"], shader.inputs["Base Color"])
    for link in list(shader.inputs["Metallic"].links):
        tree.links.remove(link)
    shader.inputs["Metallic"].default_value = 1
    shader.inputs["Specular"].default_value = 0.5 * specular  # its unit: 0.5 is a reflectance of 0.04
    shader.inputs["Emission Strength"].default_value = 1
    emitters.add(tree, shader.inputs["Emission"], True)
    material.use_backface_culling = False  # ssrlab draws surfaces from both sides


def make_world(scene, folder, background, emitters):
    """The camera sees what `emitters` show; reflections that find nothing see the environment. Returns the environment's
    shader, of which strength 0 switches image-based light off."""
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    tree.nodes.clear()
    seen, around, path, mix, end = (
        tree.nodes.new(f"ShaderNode{n}") for n in ("Background", "Background", "LightPath", "MixShader", "OutputWorld")
    )
    emitters.add(tree, seen.inputs["Color"], False)
    if "color" in background:
        around.inputs["Color"].default_value = (*background["color"], 1)
    else:
        add_environment(tree, load_floats(folder / background["image"]), background["rotation"], around.inputs["Color"])
    tree.links.new(path.outputs["Is Camera Ray"], mix.inputs["Fac"])
    for shader, target in ((around, mix.inputs[1]), (seen, mix.inputs[2]), (mix, end.inputs["Surface"])):
        tree.links.new(shader.outputs[0], target)
    return around


def add_environment(tree, image, rotation, target):
    """Blender's own layout is scene.json's, but for the rotation (radians), which turns the other way about +Z."""
    direction, mapping, texture = (tree.nodes.new(f"ShaderNode{n}") for n in ("TexCoord", "Mapping", "TexEnvironment"))
    mapping.vector_type = "POINT"
    mapping.inputs["Rotation"].default_value = (0, 0, -rotation)
    texture.image = image
    tree.links.new(direction.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], target)


def prepare_render(scene):
    """Everything off that is not reflections; samples in the middle of pixels."""
    render, eevee = scene.render, scene.eevee
    render.engine = "BLENDER_EEVEE"
    render.filter_size = 0  # pixels: the camera is not jittered
    render.resolution_percentage = 100
    render.film_transparent = render.use_motion_blur = render.use_compositing = render.use_sequencer = False
    eevee.use_gtao = eevee.use_bloom = eevee.use_volumetric_lights = eevee.use_overscan = False
    settings = render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    scene.camera = bpy.data.objects.new("ssrlab_camera", bpy.data.cameras.new("ssrlab_camera"))
    scene.collection.objects.link(scene.camera)


def apply_settings(eevee, settings):
    for name, value in settings.items():
        if name in OWN_SETTINGS:
            continue
        try:
            setattr(eevee, name, value)
        except TypeError as e:
            raise AdapterError(f"the setting {name} cannot be {value!r}: {e}") from e
        held = getattr(eevee, name)
        if abs(held - value) > 1e-6 * abs(value):
            raise AdapterError(f"the setting {name} cannot be {value!r}: the engine takes {held!r} for it")


def set_view(scene, view):
    if "vertical_fov" not in view:
        raise AdapterError(f"{view['view']}: this adapter knows perspective cameras alone")
    scene.render.resolution_x, scene.render.resolution_y = view["width"], view["height"]
    lens = scene.camera.data
    lens.sensor_fit, lens.angle = "VERTICAL", view["vertical_fov"]
    lens.clip_start, lens.clip_end = view["near"], view["far"]


def z_up(column_major):
    return Y_UP_TO_Z_UP @ Matrix([column_major[4 * c : 4 * c + 4] for c in range(4)]).transposed()


def pose(scene, objects, frame):
    scene.camera.matrix_world = z_up(frame["world_from_camera"])
    for name, matrix in frame["nodes"].items():
        objects[name].matrix_world = z_up(matrix) @ Y_UP_TO_Z_UP.inverted()  # the importer turned the vertices


def load_floats(path):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    image.use_half_precision = False
    return image


def rendered(scene, samples, place):
    """RGB as float64, first row at the top."""
    scene.eevee.taa_render_samples = samples
    scene.render.filepath = str(place / "frame.exr")
    bpy.ops.render.render(write_still=True)
    image = load_floats(scene.render.filepath)
    pixels = np.empty((image.size[1], image.size[0], image.channels), np.float32)
    image.pixels.foreach_get(pixels.ravel())
    bpy.data.images.remove(image)
    return pixels[::-1, :, :3].astype(np.float64)


def check_names(objects, contract):
    for name in contract["views"][0]["frames"][0]["nodes"]:
        if name not in objects:
            raise AdapterError(f"the node '{name}' is not among the imported meshes; names must be shorter than 64 bytes")


def render_all(request, place):
    folder, contract, out = Path(request["folder"]), request["scene"], Path(request["out"])
    objects = load_objects(folder / "scene.glb")
    check_names(objects, contract)
    scene, emitters = bpy.context.scene, Emitters()
    prepare_render(scene)
    settings = request["settings"]
    apply_settings(scene.eevee, settings)
    gltf = gltf_of(folder / "scene.glb")
    done = set()
    for node in (n for n in gltf["nodes"] if n.get("name") in objects and "mesh" in n):
        index = gltf["meshes"][node["mesh"]]["primitives"][0]["material"]
        if index not in done:
            extensions = gltf["materials"][index].get("extensions", {})
            factor = extensions.get("KHR_materials_specular", {}).get("specularFactor", 1)
            make_emitter(objects[node["name"]].material_slots[0].material, factor, emitters)
        done.add(index)
    world = make_world(scene, folder, contract["background"], emitters)
    samples = settings["taa_render_samples"]

    def write(name, pixels):
        pixels.astype("<f4").tofile(out / f"{name}.f32")

    for view in contract["views"]:
        set_view(scene, view)
        for frame in view["frames"]:
            name = f"{view['view']}/f{frame['frame']}"
            pose(scene, objects, frame)
            scene.eevee.use_ssr, world.inputs["Strength"].default_value = False, 0
            emitters.show(None)
            write(f"{name}.depth", rendered(scene, 1, place)[..., 0])
            light = load_floats(folder / frame["light"])
            emitters.show(light)
            write(f"{name}.off", rendered(scene, 1, place))
            scene.eevee.use_ssr, world.inputs["Strength"].default_value = True, float(settings["environment"])
            before = 0
            for seed in range(request["seeds"]):
                # Sample n is the same however many follow. So a longer render less a shorter one are the samples between.
                total = (seed + 1) * rendered(scene, (seed + 1) * samples, place)
                write(f"{name}.s{seed}", total - before)
                before = total
            bpy.data.images.remove(light)


def main():
    request = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    try:
        with tempfile.TemporaryDirectory() as place:
            render_all(request, Path(place))
    except AdapterError as e:
        print(f"error: {e}")
        sys.exit(2)
    done = {"driver": gpu.platform.renderer_get(), "version": bpy.app.version_string}
    Path(request["out"], "done.json").write_text(json.dumps(done))


main()
