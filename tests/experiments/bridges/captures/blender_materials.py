"""Run by blender_check.py within Blender: a row of squares seen from above, each with another material, as a .blend.

usage: blender -b --factory-startup -P blender_materials.py -- OUT.blend EXPECTED.json

EXPECTED.json gets what the exporter has to write of each, from left to right: base_color, roughness, metalness, specular.
"""

import json
import sys

import bpy

out, expected = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
COLOR = (0.25, 0.5, 0.75)


def new_material(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.node_tree.nodes.clear()
    return material.node_tree


def put(tree, kind, **values):
    node = tree.nodes.new(kind)
    for name, value in values.items():
        node.inputs[name.replace("_", " ")].default_value = value
    return node


def end_of(tree):
    return tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"]


def new_group(name, inputs=(), outputs=("NodeSocketShader",)):
    """A group with sockets Input 0, ... and Output 0, ...; Blender 4 declares them in another way than 3."""
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    for way, kinds in (("Input", inputs), ("Output", outputs)):
        for i, kind in enumerate(kinds):
            if hasattr(tree, "interface"):
                tree.interface.new_socket(f"{way} {i}", in_out=way.upper(), socket_type=kind)
            else:
                (tree.inputs if way == "Input" else tree.outputs).new(kind, f"{way} {i}")
    return tree, tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")


def put_group(tree, group):
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    return node


def glossy():
    tree = new_material("glossy")
    kind = "ShaderNodeBsdfGlossy" if hasattr(bpy.types, "ShaderNodeBsdfGlossy") else "ShaderNodeBsdfAnisotropic"
    node = put(tree, kind, Color=(0.9, 0.8, 0.7, 1), Roughness=0.1)
    if kind == "ShaderNodeBsdfGlossy":
        node.distribution = "GGX"
    tree.links.new(node.outputs[0], end_of(tree))
    return (0.9, 0.8, 0.7), 0.1, 1, 1


def anisotropic():
    tree = new_material("anisotropic")
    tree.links.new(put(tree, "ShaderNodeBsdfAnisotropic", Color=(*COLOR, 1), Roughness=0.3).outputs[0], end_of(tree))
    return COLOR, 0.3, 1, 1


def shared_group():
    """A Principled shader whose colour and roughness come from the group's inputs, behind a link and a value."""
    group, begin, end = new_group("shared", ("NodeSocketColor", "NodeSocketFloat"))
    shader = put(group, "ShaderNodeBsdfPrincipled", Metallic=0.5)
    group.links.new(begin.outputs["Input 0"], shader.inputs["Base Color"])
    group.links.new(begin.outputs["Input 1"], shader.inputs["Roughness"])
    group.links.new(shader.outputs[0], end.inputs["Output 0"])
    return group


def in_group(group, color, roughness):
    def of():
        tree = new_material(f"in group {roughness}")
        node = put_group(tree, group)
        rgb = tree.nodes.new("ShaderNodeRGB")
        rgb.outputs[0].default_value = (*color, 1)
        tree.links.new(rgb.outputs[0], node.inputs["Input 0"])
        node.inputs["Input 1"].default_value = roughness
        tree.links.new(node.outputs["Output 0"], end_of(tree))
        return color, roughness, 0.5, 1

    return of


def through_groups():
    """A diffuse shader that enters a group, and leaves one around it by the second of two outputs."""
    inner, begin, end = new_group("inner", ("NodeSocketShader",))
    mix = put(inner, "ShaderNodeMixShader")
    inner.links.new(begin.outputs["Input 0"], mix.inputs[1])
    inner.links.new(mix.outputs[0], end.inputs["Output 0"])
    outer, begin, end = new_group("outer", ("NodeSocketShader",), ("NodeSocketShader", "NodeSocketShader"))
    node = put_group(outer, inner)
    outer.links.new(begin.outputs["Input 0"], node.inputs["Input 0"])
    outer.links.new(node.outputs["Output 0"], end.inputs["Output 1"])
    tree = new_material("through groups")
    node = put_group(tree, outer)
    tree.links.new(put(tree, "ShaderNodeBsdfDiffuse", Color=(*COLOR, 1)).outputs[0], node.inputs["Input 0"])
    tree.links.new(node.outputs["Output 1"], end_of(tree))
    return COLOR, 1, 0, 0


def dielectric():
    """Of an index of 2, which Blender 3 uses for transmission alone: ((2 - 1) / (2 + 1))^2 = 1/9 of 0.04."""
    tree = new_material("dielectric")
    shader = put(tree, "ShaderNodeBsdfPrincipled", Base_Color=(*COLOR, 1), Roughness=0.2, IOR=2.0)
    tree.links.new(shader.outputs[0], end_of(tree))
    return COLOR, 0.2, 0, 1 / 9 / 0.04 if "Specular IOR Level" in shader.inputs else 1


def sharp():
    """A glossy shader of Blender 3 whose roughness counts for nothing."""
    if not hasattr(bpy.types, "ShaderNodeBsdfGlossy"):
        return glossy()
    tree = new_material("sharp")
    node = put(tree, "ShaderNodeBsdfGlossy", Color=(*COLOR, 1), Roughness=0.4)
    node.distribution = "SHARP"
    tree.links.new(node.outputs[0], end_of(tree))
    return COLOR, 0, 1, 1


def conductor():
    """Of Blender 4.3 and later: index 0.5 and extinction 2: (0.25 + 4) / (2.25 + 4)."""
    if not hasattr(bpy.types, "ShaderNodeBsdfMetallic"):
        return glossy()
    tree = new_material("conductor")
    node = put(tree, "ShaderNodeBsdfMetallic", IOR=(0.5, 0.5, 0.5), Extinction=(2, 2, 2), Roughness=0.25)
    node.fresnel_type = "PHYSICAL_CONDUCTOR"
    tree.links.new(node.outputs[0], end_of(tree))
    return (4.25 / 6.25,) * 3, 0.25, 1, 1


shared = shared_group()
rows = []
for i, make in enumerate((glossy, anisotropic, in_group(shared, COLOR, 0.6), in_group(shared, (0.1, 0.2, 0.3), 0.7),
                          through_groups, dielectric, sharp, conductor)):  # fmt: skip
    before = set(bpy.data.materials)
    base_color, roughness, metalness, specular = make()
    rows.append({"base_color": base_color, "roughness": roughness, "metalness": metalness, "specular": specular})
    bpy.ops.mesh.primitive_plane_add(size=1, location=(i, 0, 0))
    bpy.context.object.data.materials.append((set(bpy.data.materials) - before).pop())

data = bpy.data.cameras.new("camera")
data.type, data.ortho_scale = "ORTHO", len(rows)
scene.camera = bpy.data.objects.new("camera", data)
scene.camera.location = ((len(rows) - 1) / 2, 0, 5)
scene.collection.objects.link(scene.camera)
with open(expected, "w", encoding="utf-8") as stream:
    json.dump(rows, stream)
bpy.ops.wm.save_as_mainfile(filepath=out)
