"""Exports frames of a Blender scene as a capture for ssrlab (README.md beside this file).

usage: blender -b FILE.blend -P blender_export.py -- --out DIR [--frames A B] [--size W H] [--camera NAME]
           [--samples N] [--sky-height N] [--no-lit]

Rendered with Cycles: what is drawn with EEVEE alone looks as Cycles draws it. The file itself is not changed.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "python")]
from blender_passes import OLDER_NAMES, PANORAMA_CAMERA, camera_of, layers_of, with_previous  # noqa: E402
from capture_files import frame_folder, write_environment, write_frame  # noqa: E402
from ssrlab.exr import read_exr_planes  # noqa: E402
from ssrlab.mistakes import ResultsError, exit_code, shown  # noqa: E402

COLOR_AOVS = ("base_color", "true_normal", "emission")
VALUE_AOVS = ("roughness", "metallic", "specular")
# The inputs of the Principled BSDF, as Blender 3 calls them, and 4 and 5.
PRINCIPLED = {
    "base_color": ("Base Color",),
    "roughness": ("Roughness",),
    "metallic": ("Metallic",),
    "specular": ("Specular", "Specular IOR Level"),
    "emission": ("Emission", "Emission Color"),
}
OTHER_SHADERS = {  # what is not an input of theirs
    "ShaderNodeBsdfDiffuse": {"metallic": 0.0, "specular": 0.0, "roughness": 1.0, "emission": (0, 0, 0, 1)},
    "ShaderNodeBsdfGlossy": {"metallic": 1.0, "specular": 0.5, "emission": (0, 0, 0, 1)},
    # "Glossy BSDF" since Blender 4.0, which turns those of older files into it; "Anisotropic BSDF" before.
    "ShaderNodeBsdfAnisotropic": {"metallic": 1.0, "specular": 0.5, "emission": (0, 0, 0, 1)},
    "ShaderNodeBsdfMetallic": {"metallic": 1.0, "specular": 0.5, "emission": (0, 0, 0, 1)},  # since Blender 4.3
    "ShaderNodeEmission": {"metallic": 0.0, "specular": 0.0, "roughness": 1.0, "base_color": (0, 0, 0, 1)},
}


def say(text):
    print(f"ssrlab: {shown(text)}", flush=True)


def _arguments():
    parser = argparse.ArgumentParser(prog="blender -b FILE.blend -P blender_export.py --")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--frames", type=int, nargs=2, metavar=("A", "B"), help="default: the current frame")
    parser.add_argument("--size", type=int, nargs=2, metavar=("W", "H"), help="default: the scene's")
    parser.add_argument("--camera", help="default: the scene's")
    parser.add_argument("--samples", type=int, default=128, help="per pixel of the lit colour")
    parser.add_argument("--sky-height", type=int, default=256, help="rows of environment.exr")
    parser.add_argument("--no-lit", action="store_true", help="no lit colour: a reference must provide it")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])


def surface_shader(material):
    """The node whose inputs describe the surface: the first that is known, from the material's output on. It may lie in
    a group, whose inputs and outputs are followed."""
    output = material.node_tree.get_output_node("CYCLES")
    waiting = [(output.inputs["Surface"], ())] if output else []  # inputs, and the nodes of the groups that they lie in
    while waiting:
        socket, groups = waiting.pop(0)
        for link in socket.links:
            node = link.from_node
            if not getattr(link, "is_valid", True):  # one of a circle, which Blender leaves out
                continue
            if node.bl_idname == "ShaderNodeBsdfPrincipled" or node.bl_idname in OTHER_SHADERS:
                return node
            if node.bl_idname == "NodeGroupInput":
                waiting += [(i, groups[:-1]) for i in groups[-1].inputs if i.identifier == link.from_socket.identifier]
            elif node.bl_idname == "ShaderNodeGroup":
                ends = [n for n in node.node_tree.nodes if n.bl_idname == "NodeGroupOutput" and n.is_active_output] if node.node_tree else []
                waiting += [(i, (*groups, node)) for end in ends for i in end.inputs if i.identifier == link.from_socket.identifier]
            else:
                waiting += [(i, groups) for i in node.inputs if i.type == "SHADER"]
    return None


def own_groups(tree):
    """Gives a tree groups of its own, in which outputs can be added without changing other materials."""
    for node in tree.nodes:
        if node.bl_idname == "ShaderNodeGroup" and node.node_tree:
            node.node_tree = node.node_tree.copy()
            own_groups(node.node_tree)


def _feed(tree, source, target):
    """Gives an input what another input has: its link, or its value (of a colour, as many parts as there are); what is no
    input is the value itself."""
    if getattr(source, "is_linked", False):
        tree.links.new(source.links[0].from_socket, target)
        return
    value = getattr(source, "default_value", source)
    target.default_value = tuple(value)[: len(target.default_value)] if hasattr(value, "__len__") else value


def _math(tree, kind, operation, *arguments):
    """The output of a node that calculates; arguments: inputs, outputs or values."""
    node = tree.nodes.new(kind)
    node.operation = operation
    for target, source in zip(node.inputs, arguments):
        if getattr(source, "is_output", False):
            tree.links.new(source, target)
        else:
            _feed(tree, source, target)
    return node.outputs[0]


def reflectance(tree, n, k=None):
    """The output of nodes for ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2), Fresnel's reflectance at normal incidence. n: an input,
    of a number; with k both are of vectors."""
    is_color = k is not None
    kind = "ShaderNodeVectorMath" if is_color else "ShaderNodeMath"
    one = (1.0, 1.0, 1.0) if is_color else 1.0
    parts = [_math(tree, kind, operation, n, one) for operation in ("SUBTRACT", "ADD")]
    parts = [_math(tree, kind, "MULTIPLY", part, part) for part in parts]
    if is_color:
        square = _math(tree, kind, "MULTIPLY", k, k)
        parts = [_math(tree, kind, "ADD", part, square) for part in parts]
    return _math(tree, kind, "DIVIDE", *parts)


def _calculated(name, shader, tree):
    """The output of what no input holds; None for the others."""
    if name == "specular" and "Specular IOR Level" in shader.inputs:  # since Blender 4 it scales what IOR says
        ratio = _math(tree, "ShaderNodeMath", "DIVIDE", reflectance(tree, shader.inputs["IOR"]), 0.04)
        return _math(tree, "ShaderNodeMath", "MULTIPLY", ratio, shader.inputs["Specular IOR Level"])
    if name == "base_color" and getattr(shader, "fresnel_type", "") == "PHYSICAL_CONDUCTOR":
        return reflectance(tree, shader.inputs["IOR"], shader.inputs["Extinction"])
    return None


def add_outputs(material):
    """Gives the material outputs of its parameters. False if it has no surface that is understood."""
    if not getattr(material, "use_nodes", True):  # Blender 5 has no materials without nodes
        color, roughness, metallic = material.diffuse_color[:], material.roughness, material.metallic
        material.use_nodes = True
        for name, value in (("Base Color", color), ("Roughness", roughness), ("Metallic", metallic)):
            surface_shader(material).inputs[name].default_value = value
    own_groups(material.node_tree)
    shader = surface_shader(material)
    if shader is None:
        return False
    tree = shader.id_data  # the material's, or that of a group
    constants = dict(OTHER_SHADERS.get(shader.bl_idname, {}))
    if getattr(shader, "distribution", "") == "SHARP":  # of Blender 3: its roughness counts for nothing
        constants["roughness"] = 0.0

    def output(name, is_color):
        node = tree.nodes.new("ShaderNodeOutputAOV")
        node.name = f"ssrlab_{name}"  # Blender 3 finds the AOV by the node's name, Blender 4 by aov_name
        if hasattr(node, "aov_name"):
            node.aov_name = node.name
        return node.inputs["Color" if is_color else "Value"]

    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    tree.links.new(geometry.outputs["True Normal"], output("true_normal", True))
    for name, inputs in PRINCIPLED.items():
        target = output(name, name in COLOR_AOVS)
        if name in constants:
            target.default_value = constants[name]
            continue
        if calculated := _calculated(name, shader, tree):
            tree.links.new(calculated, target)
            continue
        found = [shader.inputs[i] for i in inputs + ("Color",) if i in shader.inputs]
        if not found:
            continue
        strength = shader.inputs.get("Emission Strength") or shader.inputs.get("Strength")
        if name == "emission" and strength:
            scale = tree.nodes.new("ShaderNodeVectorMath")
            scale.operation = "SCALE"
            _feed(tree, found[0], scale.inputs[0])
            _feed(tree, strength, scale.inputs["Scale"])
            tree.links.new(scale.outputs[0], target)
        else:
            _feed(tree, found[0], target)
    return True


def prepare_materials():
    """Numbers all materials and gives them outputs; what has none gets Cycles' default, diffuse with albedo 0.8."""
    plain = bpy.data.materials.new("ssrlab_default")
    if plain.node_tree is None:  # Blender 5 makes one
        plain.use_nodes = True
    plain.node_tree.nodes.clear()
    diffuse = plain.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (0.8, 0.8, 0.8, 1)
    end = plain.node_tree.nodes.new("ShaderNodeOutputMaterial")
    plain.node_tree.links.new(diffuse.outputs[0], end.inputs["Surface"])
    for thing in bpy.data.objects:
        if thing.type not in ("MESH", "CURVE", "SURFACE", "META", "FONT"):
            continue
        if not thing.material_slots:
            thing.data.materials.append(plain)
        for slot in thing.material_slots:
            slot.material = slot.material or plain
    for number, material in enumerate((m for m in bpy.data.materials if not m.grease_pencil), start=1):
        material.pass_index = number
        if not add_outputs(material):
            say(f"warning: the material '{material.name}' has no surface that is understood: it counts as black")


def prepare_scene(scene, size):
    """Cycles, one layer, the samples in the middle of the pixels, nothing that blurs or is done to the image after."""
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    if size:
        render.resolution_x, render.resolution_y = size
        render.resolution_percentage = 100
    render.use_border = render.use_motion_blur = render.use_compositing = render.use_sequencer = False
    render.pixel_aspect_x = render.pixel_aspect_y = 1
    render.film_transparent = False
    scene.camera.data.dof.use_dof = False
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    # Pixels; the first sample lies in the middle, whatever the filter. A box filter would be one pixel wide.
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    settings = render.image_settings
    if hasattr(settings, "media_type"):  # Blender 5, which offers the formats of this kind alone
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIPS"
    if hasattr(settings, "use_exr_interleave"):  # else Blender 5 writes a part for each pass
        settings.use_exr_interleave = True
    settings.color_mode = "RGBA"
    layer = scene.view_layers[0]
    for other in scene.view_layers:
        other.use = other == layer
    for name in ("z", "normal", "position", "vector", "material_index", "emit", "environment", "diffuse_direct",
                 "diffuse_indirect", "diffuse_color"):  # fmt: skip
        setattr(layer, f"use_pass_{name}", True)
    for names, kind in ((COLOR_AOVS, "COLOR"), (VALUE_AOVS, "VALUE")):
        for name in names:
            aov = layer.aovs.add()
            aov.name, aov.type = f"ssrlab_{name}", kind
    return layer


def rendered(scene, layer, samples, place):
    """All passes by name, each of shape (height, width, channels), in the order RGBA or XYZW."""
    scene.cycles.samples = samples
    scene.render.filepath = str(place / "passes.exr")
    bpy.ops.render.render(write_still=True, scene=scene.name)
    passes = {}
    for name, plane in read_exr_planes(place / "passes.exr").items():
        of_pass, channel = name.removeprefix(layer.name + ".").rsplit(".", 1)
        of_pass = OLDER_NAMES.get(of_pass, of_pass)
        passes.setdefault(of_pass.removeprefix("ssrlab_"), {})[channel] = plane
    order = "RGBXYZWV"
    return {
        name: np.stack([planes[c] for c in order if c in planes], axis=-1).astype(float)
        for name, planes in passes.items()
    }


def posed_camera(scene, frame):
    scene.frame_set(frame)
    graph = bpy.context.evaluated_depsgraph_get()
    camera = scene.camera.evaluated_get(graph)
    width, height = (x * scene.render.resolution_percentage // 100
                     for x in (scene.render.resolution_x, scene.render.resolution_y))  # fmt: skip
    projection = scene.camera.calc_matrix_camera(graph, x=width, y=height)
    if camera.data.type == "PANO":
        raise ResultsError("the camera is panoramic; ssrlab needs a perspective or an orthographic one")
    return camera_of(camera.matrix_world, projection, (width, height), camera.data.clip_start, camera.data.clip_end,
                     camera.data.type == "ORTHO", max(frame, 0))  # fmt: skip


def world_radiance(scene):
    """The radiance of a world of one colour; None for any other."""
    world = scene.world
    if world is None:
        return (0.0, 0.0, 0.0)
    if not getattr(world, "use_nodes", True):  # Blender 5 has no worlds without nodes
        return tuple(world.color)
    output = world.node_tree.get_output_node("CYCLES")
    links = output.inputs["Surface"].links if output else ()
    if not links:
        return (0.0, 0.0, 0.0)
    shader = links[0].from_node
    if shader.bl_idname != "ShaderNodeBackground" or any(i.is_linked for i in shader.inputs):
        return None
    strength = shader.inputs["Strength"].default_value
    return tuple(strength * c for c in shader.inputs["Color"].default_value[:3])


def panorama(scene, height, place):
    """The world alone, rendered in all directions."""
    other = bpy.data.scenes.new("ssrlab_sky")
    other.world = scene.world
    data = bpy.data.cameras.new("ssrlab_sky")
    data.type = "PANO"
    (data if hasattr(data, "panorama_type") else data.cycles).panorama_type = "EQUIRECTANGULAR"
    camera = bpy.data.objects.new("ssrlab_sky", data)
    camera.matrix_world = Matrix(PANORAMA_CAMERA.tolist())  # a bare list would be its columns
    other.collection.objects.link(camera)
    other.camera = camera
    prepare_scene(other, (2 * height, height))
    return rendered(other, other.view_layers[0], 1, place)["Combined"][..., :3]


def main():
    arguments = _arguments()
    scene = bpy.context.scene
    if arguments.camera:
        scene.camera = bpy.data.objects.get(arguments.camera)
        if scene.camera is None or scene.camera.type != "CAMERA":
            cameras = ", ".join(thing.name for thing in bpy.data.objects if thing.type == "CAMERA")
            raise ResultsError(f"no camera is called '{arguments.camera}'; known are: {cameras or 'none'}")
    if scene.camera is None:
        raise ResultsError("the scene has no camera: name one with --camera")
    first, last = arguments.frames or (scene.frame_current, scene.frame_current)
    prepare_materials()
    layer = prepare_scene(scene, arguments.size)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        radiance = world_radiance(scene)
        write_environment(arguments.out, radiance if radiance else panorama(scene, arguments.sky_height, place))
        for frame in range(first, last + 1):
            previous = posed_camera(scene, frame - 1)
            camera = posed_camera(scene, frame)
            passes = rendered(scene, layer, 1, place)
            lit = None if arguments.no_lit else rendered(scene, layer, arguments.samples, place)
            layers = layers_of(passes, camera, previous, lit)
            out = frame_folder(arguments.out, frame)
            write_frame(out, layers, with_previous(camera, previous))
            say(f"{out}")


if __name__ == "__main__":
    code = exit_code(main, "the capture")
    if code:  # else Blender goes on with the rest of its command line
        sys.exit(code)
