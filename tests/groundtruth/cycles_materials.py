"""glTF's materials as shaders of Cycles, for cycles_scene.py, which runs within Blender 3.4.

They are built anew from what Blender's importer found: glTF's BRDF has a diffuse lobe of (1 - F) c / pi, while Blender's Principled shader adds its
specular lobe to a diffuse one of whole albedo, which makes a closed room brighter.
"""

import math
import re

import bpy

BLACK = (0.0, 0.0, 0.0, 1.0)
DIELECTRIC_F0 = 0.04
# What the dielectric lobe leaves to the diffuse one, 1 - F over light from all directions: 0.960 as seen along the normal, 0.934 at grazing angles.
DIFFUSE_SHARE = 0.957
LEAST_ROUGHNESS = math.sqrt(1e-3)  # core/shared/brdf.h: min_ggx_alpha


class Nodes:
    """The node tree of a material. A `source` is a number, an RGBA tuple, or another node's output."""

    def __init__(self, tree):
        self.tree = tree

    def source(self, socket):
        if socket.is_linked:
            return socket.links[0].from_socket
        return socket.default_value if isinstance(socket.default_value, float) else tuple(socket.default_value)

    def feed(self, source, socket):
        if isinstance(source, bpy.types.NodeSocket):
            self.tree.links.new(source, socket)
        else:
            socket.default_value = source

    def add(self, kind, inputs=(), **settings):
        """A new node of `kind`; `inputs` are pairs of a name or number and a source."""
        node = self.tree.nodes.new(kind)
        for key, value in settings.items():
            setattr(node, key, value)
        for key, source in inputs:
            self.feed(source, node.inputs[key])
        return node

    def at_least(self, source, least):
        if not isinstance(source, bpy.types.NodeSocket):
            return max(source, least)
        return self.add("ShaderNodeMath", ((0, source), (1, least)), operation="MAXIMUM").outputs[0]

    def mix(self, factor, a, b):
        """a (1 - factor) + b factor, of colours."""
        if factor in (0.0, 1.0):
            return b if factor else a
        return self.add("ShaderNodeMix", ((0, factor), (6, a), (7, b)), data_type="RGBA").outputs[2]

    def scaled(self, color, factor):
        """A colour times a number."""
        if not isinstance(color, bpy.types.NodeSocket):
            return (*(c * factor for c in color[:3]), 1.0)
        inputs = ((0, 1.0), (6, color), (7, (factor, factor, factor, 1.0)))
        return self.add("ShaderNodeMix", inputs, data_type="RGBA", blend_type="MULTIPLY").outputs[2]


def overridden(material, scene):
    """The keys of scene.json's overrides that hold for the material, the last of each, and the `specular` of its glTF, which the importer changes."""
    found = {"specular": scene["specular"].get(material.name, 1)}
    for change in scene.get("overrides", ()):
        if re.fullmatch(change["material"], material.name):
            found.update(change)
    return found


def is_black(color):
    return not isinstance(color, bpy.types.NodeSocket) and max(color[:3]) == 0


def properties(nodes, old, change):
    """What glTF says of a material, by the keys of scene.json's overrides: of `old`, the inputs of the importer's Principled shader, unless `change`
    holds the key. `emission` is a colour with its strength; `normal` is None without a normal map."""
    keys = {"base_color": "Base Color", "metalness": "Metallic", "roughness": "Roughness", "alpha": "Alpha"}
    found = {key: nodes.source(old[name]) for key, name in keys.items()}
    found["emission"] = nodes.source(old["Emission"]), old["Emission Strength"].default_value
    found["normal"] = nodes.source(old["Normal"]) if old["Normal"].is_linked and not change.get("drop_normal_map") else None
    found |= {key: float(change[key]) for key in ("metalness", "roughness", "specular") if key in change}
    if "base_color" in change:
        found["base_color"] = (*change["base_color"], 1.0)
    if "emission" in change:
        found["emission"] = (*change["emission"], 1.0), 1.0
    return found


def reflecting_shaders(nodes, found):
    """Specular and diffuse lobe of properties(), those that are not black."""
    color, metalness, specular = found["base_color"], found["metalness"], found["specular"]
    normal = [("Normal", found["normal"])] if found["normal"] else []
    if specular or metalness != 0.0:
        # As a metal, Principled has no diffuse lobe, and a specular one of F0 = its base colour and F90 = 1.
        f0 = nodes.mix(metalness, (*(DIELECTRIC_F0 * specular,) * 3, 1.0), color)
        roughness = nodes.at_least(found["roughness"], LEAST_ROUGHNESS)
        inputs = [("Base Color", f0), ("Metallic", 1.0), ("Specular", 0.5), ("Roughness", roughness), *normal]
        yield nodes.add("ShaderNodeBsdfPrincipled", inputs, distribution="GGX").outputs[0]
    if metalness != 1.0 and not is_black(color):
        dielectric = nodes.scaled(color, DIFFUSE_SHARE if specular else 1.0)
        inputs = [("Color", nodes.mix(metalness, dielectric, BLACK)), ("Roughness", 0.0), *normal]
        yield nodes.add("ShaderNodeBsdfDiffuse", inputs).outputs[0]


def emitting_shader(nodes, emission, is_double_sided):
    """Of a colour with its strength; Cycles emits on both sides unless told otherwise."""
    color, strength = emission
    if not is_double_sided:
        back = nodes.add("ShaderNodeNewGeometry").outputs["Backfacing"]
        strength = nodes.add("ShaderNodeMath", ((0, back), (1, -strength), (2, strength)), operation="MULTIPLY_ADD").outputs[0]
    return nodes.add("ShaderNodeEmission", (("Color", color), ("Strength", strength))).outputs[0]


def build_material(material, change):
    """Replaces the surface shader of an imported material; `change` as overridden() returns it."""
    nodes = Nodes(material.node_tree)
    imported = [n for n in nodes.tree.nodes if n.type == "BSDF_PRINCIPLED"]
    if len(imported) != 1:
        raise SystemExit(f"error: the material {material.name} has no Principled shader.")
    found = properties(nodes, imported[0].inputs, change)
    if found["specular"] not in (0, 1):  # F90 depends on it, but Blender's is 1
        raise SystemExit(f"error: the material {material.name} has a specular factor of {found['specular']:.3g}: only 0 and 1 have a counterpart.")
    shaders = list(reflecting_shaders(nodes, found))
    color, strength = found["emission"]
    if strength > 0 and not is_black(color):
        shaders.append(emitting_shader(nodes, found["emission"], not material.use_backface_culling))  # of glTF's doubleSided
    surface = shaders[0] if shaders else nodes.add("ShaderNodeBsdfDiffuse", [("Color", BLACK)]).outputs[0]
    for shader in shaders[1:]:
        surface = nodes.add("ShaderNodeAddShader", ((0, surface), (1, shader))).outputs[0]
    if material.blend_method == "CLIP":  # the importer leaves alpha without its threshold; what glTF blends is opaque, as in ssrlab
        inside = nodes.add("ShaderNodeMath", ((0, found["alpha"]), (1, material.alpha_threshold)), operation="GREATER_THAN").outputs[0]
        inputs = ((0, inside), (1, nodes.add("ShaderNodeBsdfTransparent").outputs[0]), (2, surface))
        surface = nodes.add("ShaderNodeMixShader", inputs).outputs[0]
    output = next(n for n in nodes.tree.nodes if n.type == "OUTPUT_MATERIAL")
    nodes.feed(surface, output.inputs["Surface"])
    nodes.tree.nodes.remove(imported[0])
