"""Materials of a scene: base colour, metalness and roughness from stated densities, with maps of noise at several
scales where a finish has some."""
import colorsys
from dataclasses import dataclass

from ..gltf import REPEAT
from .densities import CANDELA, LIGHTNESS, ROUGHNESS
from .noise import colour_png, grey_png, grooves, metal_png, mixed, noise, normal_png

SIZE = 128  # texels of a map per side; floors have twice as many


@dataclass(frozen=True)
class Finish:
    material: int  # index in the glTF
    colour: tuple  # mean base colour
    roughness: float
    metalness: float = 0.0
    radiance: tuple = (0.0, 0.0, 0.0)
    period: float = 1.0  # metres over which its maps repeat


def grey(colour):
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]


def shaded(hue, saturation, lightness):
    """A colour of this reflectance, or a little less where that is out of gamut."""
    colour = colorsys.hsv_to_rgb(hue, saturation, 1)
    scale = min(lightness / grey(colour), 0.9)
    return tuple(round(c * scale, 6) for c in colour)


def warm_white(kelvin, luminance):
    """Radiance of a lamp (luminance in cd/m^2): linear sRGB between 2400 K and 6500 K, in a straight line."""
    t = (kelvin - 2400) / 4100
    colour = mixed((1.0, 0.56, 0.2), (1.0, 1.0, 1.0), t)
    return tuple(c * luminance / CANDELA / grey(colour) for c in colour)


class Finishes:
    """Makes each finish that is asked for once by name, so that all chairs of a room are alike."""

    def __init__(self, model, dice):
        self.model, self.dice, self.made = model, dice, {}
        self.maps = {}  # of materials: what makes their images

    def get(self, kind, use, lightness="furniture"):
        """`kind`: a name of ROUGHNESS; `use`: whose it is, each with its own draw; `lightness`: a name of LIGHTNESS."""
        if (kind, use) not in self.made:
            self.made[kind, use] = self.make(kind, use, self.dice.about(f"{kind}/{use}"), lightness)
        return self.made[kind, use]

    def lamp(self, use, radiance):
        """A surface of this radiance, white when it is off."""
        radiance = tuple(round(c, 6) for c in radiance)
        if ("lamp", radiance) not in self.made:
            self.made["lamp", radiance] = Finish(self.model.flat(f"lamp_{use}", radiance), (0.0, 0.0, 0.0), 1.0,
                                                 radiance=radiance)
        return self.made["lamp", radiance]

    def plain(self, name, colour, roughness, metalness=0.0, period=1.0):
        return Finish(self.model.surface(name, colour, metalness, roughness), colour, roughness, metalness, period=period)

    def make(self, kind, use, dice, lightness):
        roughness = round(dice.draw(ROUGHNESS[kind]), 4)
        reflectance = dice.draw(LIGHTNESS[lightness])
        seed = int(dice.uniform(0, 1 << 30))
        name = f"{kind}_{use}"
        make = getattr(self, f"make_{kind}", None)
        if make:
            return make(name, dice, roughness, reflectance, seed)
        colour = shaded(dice.uniform(), dice.uniform(0, 0.75) ** 2 if kind != "ceramic" else dice.uniform(0, 0.1),
                        reflectance if kind != "ceramic" else max(reflectance, 0.55))
        return self.plain(name, colour, roughness)

    def mapped(self, name, colour, roughness, period, maps, metalness=0.0):
        """`maps()` gives (image of base colours of mean `colour`, image of roughnesses, (heights, slope)), each or None."""
        finish = self.plain(name, colour, roughness, metalness, period)
        self.maps[finish.material] = maps
        return finish

    def write_maps(self):
        """Makes the maps of all materials that something is of: after a scene is accepted, since they take most of the
        time."""
        used = {primitive["material"] for mesh in self.model.meshes for primitive in mesh["primitives"]}
        for material, maps in self.maps.items():
            if material not in used:
                continue
            colours, roughnesses, relief = maps()
            pbr = self.model.materials[material]["pbrMetallicRoughness"]
            if colours:
                pbr["baseColorFactor"] = [1.0, 1.0, 1.0, 1.0]
                self.model.colour_map(material, colour_png(colours))
            if roughnesses:
                pbr["roughnessFactor"] = 1.0
                self.model.roughness_map(material, (metal_png if pbr["metallicFactor"] else grey_png)(roughnesses))
            if relief:
                self.model.normal_map(material, normal_png(*relief), 1.0, REPEAT)

    def make_polished_stone(self, name, dice, roughness, reflectance, seed):
        """Veins where a warped noise crosses a half; polished unevenly, in patches."""
        size = 2 * SIZE
        base = shaded(dice.one_of((0.08, 0.1, 0.3, 0.6)), dice.uniform(0, 0.25), reflectance)
        vein = mixed(base, (0.8, 0.78, 0.74) if reflectance < 0.3 else (0.12, 0.11, 0.1), 0.65)
        def maps():
            clouds, fine = noise(seed, size, 3, 4), noise(seed + 9, size, 12, 3)
            image = []
            for a, b in zip(clouds, fine):
                row = []
                for p, q in zip(a, b):
                    distance = abs(p + 0.12 * q - 0.56)
                    strength = max(0.0, 1 - 22 * distance)
                    row.append(mixed(mixed(base, vein, strength * strength), (0.0, 0.0, 0.0), 0.35 * (q - 0.4)))
                image.append(row)
            image = [[tuple(max(0.0, c) for c in colour) for colour in row] for row in image]
            rough = [[max(0.01, roughness * (0.55 + 0.9 * p)) for p in row] for row in clouds]
            return image, rough, None

        return self.mapped(name, base, roughness, dice.uniform(1.6, 2.6), maps)

    def make_parquet(self, name, dice, roughness, reflectance, seed):
        columns, rows = dice.one_of(((2, 12), (3, 16), (4, 12), (2, 8)))
        return self.boards(name, dice, roughness, reflectance, seed, columns, rows, dice.uniform(1.2, 2.2), 2 * SIZE)

    def make_wood(self, name, dice, roughness, reflectance, seed):
        return self.boards(name, dice, roughness, reflectance, seed, 1, 1, dice.uniform(0.6, 1.2), SIZE)

    def boards(self, name, dice, roughness, reflectance, seed, columns, rows, period, size):
        """Wood with grain along u, in boards whose joints are V-grooves."""
        base = shaded(dice.uniform(0.06, 0.1), dice.uniform(0.3, 0.65), reflectance)
        dark = tuple(0.45 * c for c in base)
        def maps():
            grain, pores = noise(seed, size, (2, 6), 3), noise(seed + 5, size, (4, 48), 2)
            heights, plates = grooves(size, columns, rows, 1.5, is_staggered=True)
            tints = noise(seed + 11, 64, 64, 1)
            image, rough = [], []
            for j in range(size):
                line = []
                for i in range(size):
                    tint = tints[plates[j][i] % 64][plates[j][i] // 64 % 64] if rows > 1 else 0.5
                    rings = 7 * grain[j][i] + 9 * tint
                    ring = rings - int(rings)
                    shade = 0.25 * ring + 0.3 * pores[j][i] + (0.5 * tint if rows > 1 else 0.2)
                    line.append(mixed(base, dark, shade * heights[j][i] + (1 - heights[j][i])))
                image.append(line)
                rough.append([max(0.02, roughness * (0.7 + 0.6 * p) + 0.3 * (1 - h)) for p, h in zip(grain[j], heights[j])])
            normals = None
            if rows > 1:
                normals = ([[h + 0.05 * p for h, p in zip(a, b)] for a, b in zip(heights, pores)], 0.5)
            return image, rough, normals

        return self.mapped(name, mixed(base, dark, 0.4), roughness, period, maps)

    def make_tiles(self, name, dice, roughness, reflectance, seed):
        """Glazed plates, each tilted a little, with rough joints."""
        size = 2 * SIZE
        plates_a_side = dice.one_of((2, 3, 4, 5))
        side = dice.one_of((0.15, 0.2, 0.3, 0.45, 0.6)) if "floor" in name else dice.one_of((0.1, 0.15, 0.2, 0.3))
        base = shaded(dice.uniform(), dice.uniform(0, 0.4), reflectance)
        joint = shaded(0.1, 0.05, min(0.6, max(0.1, dice.uniform(0.5, 1.5) * reflectance)))
        def maps():
            heights, plates = grooves(size, plates_a_side, plates_a_side, 1.6, is_staggered=dice.chance(0.3))
            glaze, clouds = noise(seed, size, 8, 3), noise(seed + 7, size, 3, 2)
            tints = noise(seed + 11, 64, 64, 1)
            image, rough, relief = [], [], []
            for j in range(size):
                colours, roughs, reliefs = [], [], []
                for i in range(size):
                    h, plate = heights[j][i], plates[j][i]
                    tint = tints[plate][plate]
                    colours.append(mixed(joint, tuple(c * (0.8 + 0.25 * tint + 0.15 * clouds[j][i]) for c in base), h))
                    roughs.append(0.85 + (max(0.01, roughness * (0.6 + 0.8 * clouds[j][i])) - 0.85) * h)
                    reliefs.append(h + 0.06 * glaze[j][i] + 0.012 * (tint - 0.5) * i)
                image.append(colours)
                rough.append(roughs)
                relief.append(reliefs)
            return image, rough, (relief, 0.6)

        return self.mapped(name, base, roughness, side * plates_a_side, maps)

    def make_concrete(self, name, dice, roughness, reflectance, seed):
        base = shaded(0.1, dice.uniform(0, 0.08), reflectance)
        def maps():
            clouds, fine = noise(seed, 2 * SIZE, 3, 5), noise(seed + 9, 2 * SIZE, 40, 2)
            image = [[tuple(c * (0.75 + 0.5 * p) for c in base) for p in row] for row in clouds]
            rough = [[max(0.02, roughness * (0.5 + p)) for p in row] for row in clouds]
            return image, rough, (fine, 0.15)

        return self.mapped(name, base, roughness, dice.uniform(2, 3), maps)

    def make_asphalt(self, name, dice, roughness, reflectance, seed):
        base = shaded(0.6, 0.05, 0.06 + 0.1 * reflectance)
        def maps():
            stones = noise(seed, 2 * SIZE, 64, 2)
            image = [[tuple(c * (0.5 + p) for c in base) for p in row] for row in stones]
            return image, None, (stones, 0.9)

        return self.mapped(name, base, roughness, 1.6, maps)

    def make_wet_asphalt(self, name, dice, roughness, reflectance, seed, water=(0.0, 0.3)):
        """A film of water over stones: dark, smooth where the ground is low (`water`: heights of the shore)."""
        base = shaded(0.6, 0.06, 0.03 + 0.05 * reflectance)
        def maps():
            ground, stones = noise(seed, 2 * SIZE, 3, 4), noise(seed + 5, 2 * SIZE, 64, 2)
            low, high = water
            image, rough, relief = [], [], []
            for a, b in zip(ground, stones):
                dry = [min(1.0, max(0.0, (p - low) / (high - low))) for p in a]
                image.append([tuple(c * (0.7 + 0.6 * q) * (0.7 + 0.8 * d) for c in base) for q, d in zip(b, dry)])
                rough.append([roughness * (0.25 + 0.75 * d) + (0.25 * d * q) for q, d in zip(b, dry)])
                relief.append([q * d for q, d in zip(b, dry)])
            return image, rough, (relief, 0.25)

        return self.mapped(name, base, roughness, dice.uniform(5, 8), maps)

    def make_paving(self, name, dice, roughness, reflectance, seed):
        base = shaded(0.09, dice.uniform(0, 0.15), 0.1 + 0.4 * reflectance)
        def maps():
            heights, plates = grooves(SIZE, 4, 4, 1.5, is_staggered=True)
            stones = noise(seed, SIZE, 24, 3)
            image = [[tuple(c * (0.4 + 0.4 * h + 0.4 * p) for c in base) for h, p in zip(a, b)]
                     for a, b in zip(heights, stones)]
            relief = [[h + 0.3 * p for h, p in zip(a, b)] for a, b in zip(heights, stones)]
            return image, None, (relief, 0.5)

        return self.mapped(name, base, roughness, dice.uniform(1.2, 2.4), maps)

    def make_carpet(self, name, dice, roughness, reflectance, seed):
        base = shaded(dice.uniform(), dice.uniform(0, 0.5), min(reflectance, 0.5))
        def maps():
            pile = noise(seed, SIZE, 32, 2)
            image = [[tuple(c * (0.6 + 0.8 * p) for c in base) for p in row] for row in pile]
            return image, None, (pile, 0.6)

        return self.mapped(name, base, roughness, 0.5, maps)

    def make_plaster(self, name, dice, roughness, reflectance, seed):
        base = shaded(dice.uniform(), dice.uniform(0, 0.5) ** 2, reflectance)
        return self.mapped(name, base, roughness, 1.2,
                           lambda: (None, None, (noise(seed, SIZE, 16, 3), dice.uniform(0.05, 0.3))))

    def make_satin_paint(self, name, dice, roughness, reflectance, seed):
        base = shaded(dice.uniform(), dice.uniform(0, 0.7) ** 2, reflectance)
        return self.mapped(name, base, roughness, 0.8,
                           lambda: (None, None, (noise(seed, SIZE, 12, 2), dice.uniform(0, 0.12))))

    def make_lacquer(self, name, dice, roughness, reflectance, seed):
        """With the orange peel of spraying."""
        base = shaded(dice.uniform(), dice.uniform(0, 0.9) ** 2, reflectance)
        return self.mapped(name, base, roughness, 0.6,
                           lambda: (None, None, (noise(seed, SIZE, 16, 2), dice.uniform(0, 0.04))))

    def make_brushed_metal(self, name, dice, roughness, reflectance, seed):
        base = dice.one_of(((0.56, 0.57, 0.58), (0.91, 0.92, 0.92), (0.83, 0.69, 0.42), (0.45, 0.42, 0.4)))
        def maps():
            streaks = noise(seed, SIZE, (2, 64), 2)
            rough = [[max(0.02, roughness * (0.7 + 0.6 * p)) for p in row] for row in streaks]
            return None, rough, (streaks, 0.25)

        return self.mapped(name, base, roughness, 0.3, maps, metalness=1.0)

    def make_chrome(self, name, dice, roughness, reflectance, seed):
        base = dice.one_of(((0.55, 0.56, 0.55), (0.6, 0.6, 0.6), (0.95, 0.78, 0.46), (0.78, 0.77, 0.74)))
        return self.plain(name, base, roughness, 1.0)

    def make_mirror(self, name, dice, roughness, reflectance, seed):
        return self.plain(name, (0.92, 0.93, 0.92), roughness, 1.0)

    def make_screen(self, name, dice, roughness, reflectance, seed):
        return self.plain(name, (0.01, 0.01, 0.012), roughness)

    def make_cloth(self, name, dice, roughness, reflectance, seed):
        base = shaded(dice.uniform(), dice.uniform(0, 0.8) ** 2, reflectance)
        def maps():
            threads = noise(seed, SIZE, 32, 1)
            weave = [[0.5 * p + 0.5 * ((i // 2 + j // 2) % 2) for i, p in enumerate(row)] for j, row in enumerate(threads)]
            return None, None, (weave, 0.3)

        return self.mapped(name, base, roughness, 0.4, maps)

    def make_leather(self, name, dice, roughness, reflectance, seed):
        base = shaded(dice.one_of((0.05, 0.07, 0.0, 0.6)), dice.uniform(0.1, 0.7), min(reflectance, 0.4))
        return self.mapped(name, base, roughness, 0.3, lambda: (None, None, (noise(seed, SIZE, 20, 2), 0.3)))

    def make_leaf(self, name, dice, roughness, reflectance, seed):
        return self.plain(name, shaded(dice.uniform(0.22, 0.36), dice.uniform(0.5, 0.85), dice.uniform(0.08, 0.25)),
                          roughness)

    def make_car_paint(self, name, dice, roughness, reflectance, seed):
        base = shaded(dice.uniform(), 0.9 if dice.chance(0.4) else 0.05, min(reflectance, 0.75))
        return self.plain(name, base, roughness, 0.0 if dice.chance(0.6) else 0.6)
