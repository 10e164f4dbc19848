"""The exporter with Blender's later versions, whose names and settings stand-ins have: nodes, image settings, passes. Without Blender.

usage: blender_versions_test.py
"""

import copy
import importlib.util
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

CAPTURES = Path(__file__).resolve().parents[4] / "experiments/bridges/captures"


def exporter(bpy=None):
    """blender_export.py with a stand-in for Blender."""
    spec = importlib.util.spec_from_file_location("blender_export", CAPTURES / "blender_export.py")
    module = importlib.util.module_from_spec(spec)
    with mock.patch.dict(sys.modules, {"bpy": bpy or SimpleNamespace(), "mathutils": SimpleNamespace(Matrix=None)}):
        spec.loader.exec_module(module)
    return module


class Socket:
    def __init__(self, node, name, value=None, kind="VALUE", is_output=False):
        self.node, self.name, self.identifier, self.type, self.is_output = node, name, name, kind, is_output
        self.default_value, self.links = value, []

    @property
    def is_linked(self):
        return bool(self.links)


class Sockets(list):
    """By name or by number, as Blender has them."""

    def __getitem__(self, key):
        return next(s for s in self if s.name == key) if isinstance(key, str) else super().__getitem__(key)

    def __contains__(self, name):
        return any(s.name == name for s in self)

    def get(self, name):
        return self[name] if name in self else None


# Inputs by kind of node, with their values; outputs.
SHADER, NOTHING = ("Shader", None, "SHADER"), ()
KINDS = {
    "ShaderNodeOutputMaterial": ([("Surface", None, "SHADER")], NOTHING),
    "ShaderNodeMixShader": ([("Fac", 0.5), ("Shader 1", None, "SHADER"), ("Shader 2", None, "SHADER")], [SHADER]),
    "ShaderNodeBsdfDiffuse": ([("Color", (0.8, 0.8, 0.8, 1)), ("Roughness", 0.0)], [SHADER]),
    "ShaderNodeBsdfGlossy": ([("Color", (0.8, 0.8, 0.8, 1)), ("Roughness", 0.5)], [SHADER]),
    "ShaderNodeBsdfAnisotropic": ([("Color", (0.8, 0.8, 0.8, 1)), ("Roughness", 0.5), ("Anisotropy", 0.0)], [SHADER]),
    "ShaderNodeBsdfMetallic": (
        [("Base Color", (0.6, 0.6, 0.6, 1)), ("Edge Tint", (0.7, 0.7, 0.7, 1)), ("IOR", (2.0, 2.0, 2.0)), ("Extinction", (3.0, 3.0, 3.0)), ("Roughness", 0.5)],
        [SHADER],
    ),
    "ShaderNodeBsdfPrincipled": (  # of Blender 4 and 5
        [("Base Color", (0.8, 0.8, 0.8, 1)), ("Metallic", 0.0), ("Roughness", 0.5), ("IOR", 1.5), ("Specular IOR Level", 0.5),
         ("Transmission Weight", 0.0), ("Emission Color", (1.0, 1.0, 1.0, 1)), ("Emission Strength", 0.0)],
        [SHADER],
    ),
    "ShaderNodeNewGeometry": ([], [("True Normal", (0, 0, 1))]),
    "ShaderNodeRGB": ([], [("Color", (0, 0, 0, 1))]),
    "ShaderNodeMath": ([("Value", 0.5), ("Value 2", 0.5), ("Value 3", 0.5)], [("Value", 0)]),
    "ShaderNodeVectorMath": ([("Vector", (0, 0, 0)), ("Vector 2", (0, 0, 0)), ("Vector 3", (0, 0, 0)), ("Scale", 1.0)], [("Vector", 0)]),
    "ShaderNodeOutputAOV": ([("Color", (0, 0, 0, 1)), ("Value", 0.0)], NOTHING),
    "NodeGroupInput": (NOTHING, NOTHING),
    "NodeGroupOutput": (NOTHING, NOTHING),
    "ShaderNodeGroup": (NOTHING, NOTHING),
    "NodeReroute": ([("Input", None, "SHADER")], [("Output", None, "SHADER")]),
}  # fmt: skip


class Tree:
    """A node tree. Of a group: `sockets` of it."""

    def __init__(self):
        self.nodes, self.links = Nodes(self), self

    def new(self, output, target):
        assert output.is_output and not target.is_output and output.node.id_data is target.node.id_data is self
        target.links = [SimpleNamespace(from_node=output.node, from_socket=output, is_valid=True)]

    def get_output_node(self, engine):
        return next((n for n in self.nodes if n.bl_idname == "ShaderNodeOutputMaterial"), None)

    def copy(self):
        return copy.deepcopy(self)


class Nodes(list):
    def __init__(self, tree):
        super().__init__()
        self.tree = tree

    def new(self, kind, **values):
        inputs, outputs = KINDS[kind]
        node = SimpleNamespace(bl_idname=kind, id_data=self.tree, node_tree=None, operation="", aov_name="", name="", is_active_output=True)
        node.inputs = Sockets(Socket(node, *about) for about in inputs)
        node.outputs = Sockets(Socket(node, *about, is_output=True) for about in outputs)
        for name, value in values.items():
            node.inputs[name.replace("_", " ")].default_value = value
        self.append(node)
        return node


def group(inputs=(), outputs=(SHADER,)):
    tree = Tree()
    begin, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    begin.outputs += [Socket(begin, *about, is_output=True) for about in inputs]
    end.inputs += [Socket(end, *about) for about in outputs]
    return tree, begin, end


def put_group(tree, inner):
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = inner
    node.inputs += [Socket(node, s.name, s.default_value, s.type) for s in inner.nodes[0].outputs]
    node.outputs += [Socket(node, s.name, s.default_value, s.type, is_output=True) for s in inner.nodes[1].inputs]
    return node


def value_of(socket, groups):
    """What arrives at an input; `groups`: the nodes of the groups around its tree."""
    if not socket.is_linked:
        return np.asarray(socket.default_value, float)
    link = socket.links[0]
    node = link.from_node
    if node.bl_idname == "NodeGroupInput":
        return value_of(groups[-1].inputs[link.from_socket.name], groups[:-1])
    if node.bl_idname in ("ShaderNodeMath", "ShaderNodeVectorMath"):
        a, b = (value_of(s, groups) for s in node.inputs[:2])
        if node.operation == "SCALE":
            return a[:3] * value_of(node.inputs["Scale"], groups)
        return {"ADD": np.add, "SUBTRACT": np.subtract, "MULTIPLY": np.multiply, "DIVIDE": np.divide}[node.operation](a, b)
    return np.asarray(link.from_socket.default_value, float)


def written(material):
    """Values of the outputs that the exporter added, by name."""
    found = {}

    def look(tree, groups):
        for node in tree.nodes:
            if node.bl_idname == "ShaderNodeOutputAOV":
                assert node.aov_name == node.name
                name = node.name.removeprefix("ssrlab_")
                found[name] = value_of(node.inputs["Color" if name in ("base_color", "true_normal", "emission") else "Value"], groups)
            if node.bl_idname == "ShaderNodeGroup":
                look(node.node_tree, (*groups, node))

    look(material.node_tree, ())
    return found


class BlenderVersionsTest(unittest.TestCase):
    def setUp(self):
        self.export = exporter()

    def material(self, *arguments, **values):
        """One whose surface is a node of a kind, or what `build(tree)` gives."""
        material = SimpleNamespace(node_tree=Tree())  # Blender 6 will have no use_nodes
        build = arguments[0]
        output = build(material.node_tree) if callable(build) else material.node_tree.nodes.new(build, **values).outputs[0]
        material.node_tree.new(output, material.node_tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        return material

    def expect(self, material, **values):
        self.assertTrue(self.export.add_outputs(material))
        found = written(material)
        for name, value in values.items():
            np.testing.assert_allclose(np.ravel(found[name])[: np.size(value)], value, rtol=1e-12, err_msg=name)

    def test_metals(self):
        for kind in ("ShaderNodeBsdfGlossy", "ShaderNodeBsdfAnisotropic"):
            self.expect(self.material(kind, Color=(0.9, 0.8, 0.7, 1), Roughness=0.1),
                        base_color=(0.9, 0.8, 0.7), roughness=0.1, metallic=1, specular=0.5, emission=(0, 0, 0))  # fmt: skip
        metal = self.material("ShaderNodeBsdfMetallic", Base_Color=(0.9, 0.5, 0.3, 1), Roughness=0.2)
        metal.node_tree.nodes[0].fresnel_type = "F82"
        self.expect(metal, base_color=(0.9, 0.5, 0.3), roughness=0.2, metallic=1)
        # Gold by its index and extinction: Fresnel's reflectance at normal incidence.
        n, k = np.array([0.18, 0.42, 1.37]), np.array([3.42, 2.35, 1.77])
        metal = self.material("ShaderNodeBsdfMetallic", IOR=tuple(n), Extinction=tuple(k))
        metal.node_tree.nodes[0].fresnel_type = "PHYSICAL_CONDUCTOR"
        self.expect(metal, base_color=((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2))
        sharp = self.material("ShaderNodeBsdfGlossy", Roughness=0.4)
        sharp.node_tree.nodes[0].distribution = "SHARP"
        self.expect(sharp, roughness=0)

    def test_principled_of_blender_4(self):
        self.expect(self.material("ShaderNodeBsdfPrincipled"), base_color=(0.8, 0.8, 0.8), roughness=0.5, metallic=0, specular=0.5, emission=(0, 0, 0))
        self.expect(self.material("ShaderNodeBsdfPrincipled", Emission_Color=(0.1, 0.2, 0.3, 1), Emission_Strength=4.0), emission=(0.4, 0.8, 1.2))
        # An index of 2 reflects 1/9, and a level of 0.25 half of that; 0.5 is the reflectance 0.04.
        self.expect(self.material("ShaderNodeBsdfPrincipled", IOR=2.0, Specular_IOR_Level=0.25), specular=0.25 / 9 / 0.04)

    def test_groups(self):
        shared, begin, end = group([("Tint", (1, 1, 1, 1)), ("Gloss", 0.5)], [("Other", None, "SHADER"), SHADER])
        shader = shared.nodes.new("ShaderNodeBsdfPrincipled", Metallic=0.25)
        shared.new(begin.outputs["Tint"], shader.inputs["Base Color"])
        shared.new(begin.outputs["Gloss"], shader.inputs["Roughness"])
        shared.new(shader.outputs[0], end.inputs["Shader"])
        shared.new(shared.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Other"])
        outer, _, outer_end = group()

        def nested(tree):
            inner = put_group(outer, shared)
            inner.inputs["Gloss"].default_value = 0.125
            outer.new(inner.outputs["Shader"], outer_end.inputs["Shader"])
            return put_group(tree, outer).outputs["Shader"]

        def tinted(tree):
            node, rgb = put_group(tree, shared), tree.nodes.new("ShaderNodeRGB")
            rgb.outputs[0].default_value = (0.1, 0.2, 0.3, 1)
            tree.new(rgb.outputs[0], node.inputs["Tint"])
            return node.outputs["Shader"]

        self.expect(self.material(nested), base_color=(1, 1, 1), roughness=0.125, metallic=0.25)
        self.expect(self.material(tinted), base_color=(0.1, 0.2, 0.3), roughness=0.5, metallic=0.25)
        self.assertFalse([n for n in shared.nodes if n.bl_idname == "ShaderNodeOutputAOV"], "other materials have the group, too")
        other = self.material(lambda tree: put_group(tree, shared).outputs["Other"])
        self.expect(other, base_color=(0.8, 0.8, 0.8), roughness=1)

    def test_shaders_that_enter_groups(self):
        inner, begin, end = group([SHADER])
        mix, way = inner.nodes.new("ShaderNodeMixShader"), inner.nodes.new("NodeReroute")
        inner.new(begin.outputs["Shader"], way.inputs[0])
        inner.new(way.outputs[0], mix.inputs["Shader 2"])
        inner.new(mix.outputs[0], end.inputs["Shader"])

        def build(tree):
            node = put_group(tree, inner)
            tree.new(tree.nodes.new("ShaderNodeBsdfDiffuse", Color=(0.25, 0.5, 0.75, 1)).outputs[0], node.inputs["Shader"])
            return node.outputs["Shader"]

        self.expect(self.material(build), base_color=(0.25, 0.5, 0.75), metallic=0)
        outer, outer_begin, outer_end = group([("Way", None, "SHADER")])
        node = put_group(outer, inner)
        outer.new(outer_begin.outputs["Way"], node.inputs["Shader"])
        outer.new(node.outputs["Shader"], outer_end.inputs["Shader"])

        def twice(tree):
            node = put_group(tree, outer)
            tree.new(tree.nodes.new("ShaderNodeBsdfDiffuse", Color=(0.5, 0.25, 0.125, 1)).outputs[0], node.inputs["Way"])
            return node.outputs["Shader"]

        self.expect(self.material(twice), base_color=(0.5, 0.25, 0.125))

        def circle(tree):
            first, second = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeMixShader")
            tree.new(first.outputs[0], second.inputs["Shader 1"])
            tree.new(second.outputs[0], first.inputs["Shader 1"])
            second.inputs["Shader 1"].links[0].is_valid = False  # as Blender 3.4.1 says
            tree.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], second.inputs["Shader 2"])
            return first.outputs[0]

        self.expect(self.material(circle), base_color=(0.8, 0.8, 0.8))
        empty = self.material(lambda tree: put_group(tree, group()[0]).outputs["Shader"])
        self.assertFalse(self.export.add_outputs(empty), "a group without a shader")

    def test_settings_of_blender_5(self):
        class ImageSettings:
            """Blender 5 offers formats of the chosen kind alone."""

            media_type, use_exr_interleave, color_depth, exr_codec, color_mode = "IMAGE", False, "8", "ZIP", "RGB"
            format = "PNG"

            @property
            def file_format(self):
                return self.format

            @file_format.setter
            def file_format(self, value):
                if (value == "OPEN_EXR_MULTILAYER") != (self.media_type == "MULTI_LAYER_IMAGE"):
                    raise TypeError(f"enum '{value}' not found")
                self.format = value

        aovs = SimpleNamespace(new=lambda: SimpleNamespace(), add=lambda: SimpleNamespace())
        scene = SimpleNamespace(render=SimpleNamespace(image_settings=ImageSettings()), cycles=SimpleNamespace(), view_layers=[SimpleNamespace(aovs=aovs)],
                                camera=SimpleNamespace(data=SimpleNamespace(dof=SimpleNamespace())))  # fmt: skip
        self.export.prepare_scene(scene, (32, 18))
        settings = scene.render.image_settings
        self.assertEqual((settings.file_format, settings.color_depth, settings.color_mode), ("OPEN_EXR_MULTILAYER", "32", "RGBA"))
        self.assertTrue(settings.use_exr_interleave, "one part, as blender_passes.py reads it")

    def test_passes_have_one_name(self):
        new = {"Diffuse Direct": "RGB", "Diffuse Indirect": "RGB", "Diffuse Color": "RGB", "Emission": "RGB", "Environment": "RGB",
               "Material Index": "V", "Depth": "V", "ssrlab_base_color": "RGBA", "Position": "XYZ"}  # fmt: skip
        planes = {f"ViewLayer.{name}.{c}": np.full((2, 3), i, np.float32) for i, (name, channels) in enumerate(new.items()) for c in channels}
        bpy = SimpleNamespace(ops=SimpleNamespace(render=SimpleNamespace(render=lambda **_: None)))
        export = exporter(bpy)
        scene = SimpleNamespace(cycles=SimpleNamespace(), render=SimpleNamespace(), name="scene")
        with tempfile.TemporaryDirectory() as place, mock.patch.object(export, "read_exr_planes", lambda _: planes):
            passes = export.rendered(scene, SimpleNamespace(name="ViewLayer"), 1, Path(place))
        self.assertEqual(set(passes), {"DiffDir", "DiffInd", "DiffCol", "Emit", "Env", "IndexMA", "Depth", "base_color", "Position"})
        self.assertEqual({name: values.shape[2] for name, values in passes.items() if name in ("Depth", "base_color", "Position")},
                         {"Depth": 1, "base_color": 3, "Position": 3})  # fmt: skip

    def test_worlds_without_a_switch(self):
        background = SimpleNamespace(bl_idname="ShaderNodeBackground", inputs=Sockets())
        background.inputs += [Socket(background, "Color", (0.5, 0.25, 1, 1)), Socket(background, "Strength", 2.0)]
        output = SimpleNamespace(inputs={"Surface": SimpleNamespace(links=[SimpleNamespace(from_node=background)])})
        world = SimpleNamespace(node_tree=SimpleNamespace(get_output_node=lambda engine: output))
        self.assertEqual(self.export.world_radiance(SimpleNamespace(world=world)), (1.0, 0.5, 2.0))


if __name__ == "__main__":
    unittest.main()
