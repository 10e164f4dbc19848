"""Builds one glTF 2.0 scene and writes it as binary glTF (.glb)."""
import json
import struct

# Numbers of OpenGL, as glTF uses them.
UNSIGNED_SHORT, FLOAT = 5123, 5126
VERTICES, INDICES = 34962, 34963
LINEAR, CLAMP_TO_EDGE, REPEAT = 9729, 33071, 10497


def tidy(value):
    """Seven significant digits: what a float32 holds."""
    return float(f"{value:.7g}")


def tidy_all(values):
    return [tidy(value) for value in values]


class Model:
    def __init__(self):
        self.materials, self.meshes, self.nodes = [], [], []
        self.accessors, self.buffer_views, self.channels = [], [], []
        self.images, self.samplers, self.textures = [], [], []
        self.binary = bytearray()
        self.known_accessors, self.known_meshes, self.known_textures = {}, {}, {}
        self.extensions = set()

    # Materials

    def surface(self, name, base_color, metalness, roughness):
        """glTF metallic-roughness; `roughness` is perceptual. Returns the material's index."""
        pbr = {"baseColorFactor": tidy_all(base_color) + [1.0], "metallicFactor": metalness,
               "roughnessFactor": tidy(roughness)}
        self.materials.append({"name": name, "pbrMetallicRoughness": pbr})
        return len(self.materials) - 1

    def mirror(self, name="mirror"):
        return self.surface(name, (0.95, 0.95, 0.95), 1.0, 0.0)

    def flat(self, name, radiance):
        """The same radiance in all directions: no diffuse and (KHR_materials_specular) no specular reflection."""
        index = self.surface(name, (0.0, 0.0, 0.0), 0.0, 1.0)
        strength = max(1.0, *radiance)
        extensions = {"KHR_materials_specular": {"specularFactor": 0.0}}
        if strength > 1.0:
            extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": tidy(strength)}
        self.materials[index] |= {"emissiveFactor": tidy_all(c / strength for c in radiance), "extensions": extensions}
        self.extensions |= set(extensions)
        return index

    def texture(self, png, wrap):
        """`wrap`: REPEAT, or CLAMP_TO_EDGE, so that the rim of a surface does not blend with the opposite one. Returns
        the texture's index; equal contents share one."""
        if (png, wrap) not in self.known_textures:
            sampler = {"magFilter": LINEAR, "minFilter": LINEAR, "wrapS": wrap, "wrapT": wrap}
            if sampler not in self.samplers:
                self.samplers.append(sampler)
            self.images.append({"bufferView": self.add_bytes(png), "mimeType": "image/png"})
            self.textures.append({"source": len(self.images) - 1, "sampler": self.samplers.index(sampler)})
            self.known_textures[png, wrap] = len(self.textures) - 1
        return self.known_textures[png, wrap]

    def normal_map(self, material, png, scale, wrap=CLAMP_TO_EDGE):
        """`png`: bytes of a tangent-space normal map; `scale` multiplies its x and y."""
        self.materials[material]["normalTexture"] = {"index": self.texture(png, wrap), "scale": tidy(scale)}

    def colour_map(self, material, png):
        """Multiplies the base colour; repeats."""
        self.materials[material]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": self.texture(png, REPEAT)}

    def roughness_map(self, material, png):
        """Green multiplies the roughness, blue the metalness; repeats."""
        pbr = self.materials[material]["pbrMetallicRoughness"]
        pbr["metallicRoughnessTexture"] = {"index": self.texture(png, REPEAT)}

    # Geometry

    def add_bytes(self, data, target=None):
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data + bytes(-len(data) % 4)
        self.buffer_views.append(view)
        return len(self.buffer_views) - 1

    def accessor(self, values, width, target=None):
        """Vectors of `width` floats. Equal contents share one accessor."""
        flat_values = [c for value in values for c in (value if width > 1 else (value,))]
        data = struct.pack(f"<{len(flat_values)}f", *flat_values)
        if (width, data) not in self.known_accessors:
            stored = struct.unpack(f"<{len(flat_values)}f", data)
            kind = "SCALAR" if width == 1 else f"VEC{width}"
            self.accessors.append({
                "bufferView": self.add_bytes(data, target), "componentType": FLOAT, "count": len(values), "type": kind,
                "min": [min(stored[i::width]) for i in range(width)],
                "max": [max(stored[i::width]) for i in range(width)]})
            self.known_accessors[width, data] = len(self.accessors) - 1
        return self.known_accessors[width, data]

    def index_accessor(self, indices):
        assert max(indices) < 65535, "a mesh for 16-bit indices"
        data = struct.pack(f"<{len(indices)}H", *indices)
        if ("index", data) not in self.known_accessors:
            self.accessors.append({"bufferView": self.add_bytes(data, INDICES), "componentType": UNSIGNED_SHORT,
                                   "count": len(indices), "type": "SCALAR"})
            self.known_accessors["index", data] = len(self.accessors) - 1
        return self.known_accessors["index", data]

    def mesh(self, name, shape, materials):
        attributes = {"POSITION": self.accessor(shape.positions, 3, VERTICES),
                      "NORMAL": self.accessor(shape.normals, 3, VERTICES)}
        if shape.uvs:
            attributes["TEXCOORD_0"] = self.accessor(shape.uvs, 2, VERTICES)
        if shape.tangents:
            attributes["TANGENT"] = self.accessor(shape.tangents, 4, VERTICES)
        primitives = [{"attributes": attributes, "indices": self.index_accessor(part), "material": material}
                      for part, material in zip(shape.parts, materials, strict=True)]
        key = json.dumps(primitives)
        if key not in self.known_meshes:
            self.meshes.append({"name": name, "primitives": primitives})
            self.known_meshes[key] = len(self.meshes) - 1
        return self.known_meshes[key]

    def add(self, name, shape, *materials, at=None, scale=None, rotation=None):
        """A node that draws `shape`, one material per part; `rotation`: quaternion xyzw. Returns the node's index."""
        node = {"name": name, "mesh": self.mesh(name, shape, materials)}
        if at:
            node["translation"] = tidy_all(at)
        if rotation:
            node["rotation"] = tidy_all(rotation)
        if scale:
            node["scale"] = tidy_all(scale)
        self.nodes.append(node)
        return len(self.nodes) - 1

    def animate(self, node, path, times, values, interpolation="LINEAR"):
        """`path`: translation or rotation; `times` in seconds; STEP in place of LINEAR holds a key until the next. The
        node rests at its first key."""
        self.nodes[node][path] = tidy_all(values[0])
        output = self.accessor(values, 4 if path == "rotation" else 3)
        self.channels.append((node, path, self.accessor(times, 1), output, interpolation))

    # The file

    def document(self):
        gltf = {"asset": {"version": "2.0", "generator": "ssrlab scenes/generate.py"}, "scene": 0, "scenes": [{}]}
        if self.nodes:
            gltf["scenes"][0]["nodes"] = list(range(len(self.nodes)))
        members = {"nodes": self.nodes, "meshes": self.meshes, "materials": self.materials, "accessors": self.accessors,
                   "bufferViews": self.buffer_views, "images": self.images, "extensionsUsed": sorted(self.extensions),
                   "samplers": self.samplers, "textures": self.textures}
        gltf |= {key: value for key, value in members.items() if value}
        if self.channels:
            gltf["animations"] = [{
                "samplers": [{"input": times, "output": output, "interpolation": interpolation}
                             for _, _, times, output, interpolation in self.channels],
                "channels": [{"sampler": i, "target": {"node": node, "path": path}}
                             for i, (node, path, *_) in enumerate(self.channels)]}]
        if self.binary:
            gltf["buffers"] = [{"byteLength": len(self.binary)}]
        return gltf

    def glb(self):
        text = json.dumps(self.document(), separators=(",", ":")).encode()
        chunks = struct.pack("<I4s", len(text) + -len(text) % 4, b"JSON") + text + b" " * (-len(text) % 4)
        if self.binary:
            chunks += struct.pack("<I4s", len(self.binary), b"BIN\0") + bytes(self.binary)
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
