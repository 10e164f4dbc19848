"""Materials of a scene: base colour, metalness and roughness from stated densities, with maps of noise at several
scales where a finish has some."""
import colorsys
from dataclasses import dataclass

from ..gltf import REPEAT
from .densities import CANDELA, LIGHTNESS, ROUGHNESS
from .noise import grey_png, grooves, metal_png, mixed, noise, normal_png, ramp_png

SIZE = 128  # texels of a map per side; floors have twice as many
RELIEF = 1.0  # slope of a step of 1 between texels of the normal maps; materials scale it


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
        self.maps, self.images = {}, {}  # of materials: what makes their images; the images by name

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
        return Finish(self.model.surface(name, colour, metalness, roughness), colour, roughness, metalness,
                      period=period)

    def make(self, kind, use, dice, lightness):
        roughness = round(dice.draw(ROUGHNESS[kind]), 4)
        reflectance = dice.draw(LIGHTNESS[lightness])
        name = f"{kind}_{use}"
        make = getattr(self, f"make_{kind}", None)
        if make:
            return make(name, dice, roughness, reflectance)
        return self.plain(name, shaded(dice.uniform(), dice.uniform(0, 0.75) ** 2, reflectance), roughness)

    def mapped(self, name, colour, roughness, period, maps, metalness=0.0):
        """`maps()` gives (image, colours of its ramp), an image of roughnesses, (name of a relief, steepness): each or
        None."""
        finish = self.plain(name, colour, roughness, metalness, period)
        self.maps[finish.material] = maps
        return finish

    def image(self, name, make, *arguments):
        """What make(*arguments) gives, made once a scene: materials of a kind share images, not colours."""
        if name not in self.images:
            self.images[name] = make(*arguments)
        return self.images[name]

    def noise(self, name, size, waves, octaves):
        seed = int(self.dice.about(f"noise/{name}").uniform(0, 1 << 30))
        return self.image(name, noise, seed, size, waves, octaves)

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
                self.model.colour_map(material, ramp_png(*colours))
            if roughnesses:
                pbr["roughnessFactor"] = 1.0
                self.model.roughness_map(material, (metal_png if pbr["metallicFactor"] else grey_png)(roughnesses))
            if relief:
                heights, steepness = relief
                png = self.image(f"{heights}/relief", normal_png, self.images[heights], RELIEF)
                self.model.normal_map(material, png, steepness / RELIEF, REPEAT)

    def make_polished_stone(self, name, dice, roughness, reflectance):
        """Veins where a warped noise crosses its middle; polished unevenly, in patches."""
        base = shaded(dice.one_of((0.08, 0.1, 0.3, 0.6)), dice.uniform(0, 0.25), reflectance)
        vein = mixed(base, (0.8, 0.78, 0.74) if reflectance < 0.3 else (0.12, 0.11, 0.1), 0.65)

        def maps():
            clouds, fine = self.noise("stone", 2 * SIZE, 3, 4), self.noise("stone_fine", 2 * SIZE, 12, 3)
            veins = [[max(0.3 + 0.4 * (0.5 - q), 1 - 18 * abs(p + 0.12 * q - 0.56)) for p, q in zip(a, b)]
                     for a, b in zip(clouds, fine)]
            dark, light = tuple(0.7 * c for c in base), tuple(min(1.0, 1.15 * c) for c in base)
            return (veins, [light, dark, vein]), [[roughness * (0.55 + 0.9 * p) for p in row] for row in clouds], None

        return self.mapped(name, base, roughness, dice.uniform(1.6, 2.6), maps)

    def make_parquet(self, name, dice, roughness, reflectance):
        return self.boards(name, dice, roughness, reflectance, dice.one_of(((2, 12), (3, 16), (4, 12), (2, 8))),
                           dice.uniform(1.2, 2.2))

    def make_wood(self, name, dice, roughness, reflectance):
        return self.boards(name, dice, roughness, reflectance, None, dice.uniform(0.6, 1.2))

    def boards(self, name, dice, roughness, reflectance, counts, period):
        """Wood with grain along u; `counts`: of boards along u and v, whose joints are grooves, or None."""
        base = shaded(dice.uniform(0.06, 0.1), dice.uniform(0.3, 0.65), reflectance)
        dark = tuple(0.4 * c for c in base)
        size = 2 * SIZE if counts else SIZE

        def maps():
            grain, pores = self.noise(f"grain{size}", size, (2, 6), 3), self.noise(f"pores{size}", size, (4, 48), 2)
            if counts:
                heights, plates = self.image(f"boards{counts}", grooves, size, *counts, 1.5, True)
                tints = [row[0] for row in self.noise("tints", 64, 64, 1)] * 2
                shades = []
                for a, b, h, plate in zip(grain, pores, heights, plates):
                    rings = [7 * p + 9 * tints[k] for p, k in zip(a, plate)]
                    shades.append([(0.25 * (r - int(r)) + 0.3 * q + 0.45 * tints[k]) * t + 1 - t
                                   for r, q, k, t in zip(rings, b, plate, h)])
                rough = [[roughness * (0.7 + 0.6 * p) + 0.3 * (1 - h) for p, h in zip(a, b)] for a,
                         b in zip(grain, heights)]
                self.image(f"boards{counts}_relief", lambda: [[h + 0.05 * p for h, p in zip(a, b)]
                                                              for a, b in zip(heights, pores)])
                return (shades, [base, dark]), rough, (f"boards{counts}_relief", 0.5)
            shades = self.image("wood", lambda: [[0.2 + 0.35 * (7 * p - int(7 * p)) + 0.3 * q for p, q in zip(a, b)]
                                                 for a, b in zip(grain, pores)])
            return (shades, [base, dark]), [[roughness * (0.7 + 0.6 * p) for p in row] for row in grain], None

        return self.mapped(name, mixed(base, dark, 0.4), roughness, period, maps)

    def make_tiles(self, name, dice, roughness, reflectance):
        """Glazed plates, each tilted a little, with rough joints."""
        count, is_staggered = dice.one_of((2, 3, 4, 5)), dice.chance(0.3)
        side = dice.one_of((0.15, 0.2, 0.3, 0.45, 0.6)) if "floor" in name else dice.one_of((0.1, 0.15, 0.2, 0.3))
        base = shaded(dice.uniform(), dice.uniform(0, 0.4), reflectance)
        joint = shaded(0.1, 0.05, min(0.6, max(0.1, dice.uniform(0.5, 1.5) * reflectance)))

        def maps():
            size = 2 * SIZE
            heights, plates = grooves(size, count, count, 1.6, is_staggered)
            glaze, clouds = self.noise("glaze", size, 8, 3), self.noise("clouds", size, 3, 2)
            tints = [row[0] for row in self.noise("tints", 64, 64, 1)]
            shades, rough, relief = [], [], []
            for h, plate, a, b in zip(heights, plates, glaze, clouds):
                shades.append([t * (0.5 + 0.25 * tints[k] + 0.25 * q) for t, k, q in zip(h, plate, b)])
                rough.append([0.85 + (roughness * (0.6 + 0.8 * q) - 0.85) * t for t, q in zip(h, b)])
                relief.append([t + 0.06 * p + 0.012 * (tints[k] - 0.5) * i
                               for i, (t, p, k) in enumerate(zip(h, a, plate))])
            self.images[name] = relief
            light, dark = (tuple(min(1.0, f * c) for c in base) for f in (1.15, 0.85))
            return (shades, [joint, dark, light]), rough, (name, 0.6)

        return self.mapped(name, base, roughness, side * count, maps)

    def cloudy(self, base, roughness):
        """Maps of patches, rougher where lighter."""
        clouds = self.noise("concrete", 2 * SIZE, 3, 5)
        dark, light = (tuple(min(1.0, f * c) for c in base) for f in (0.75, 1.25))
        return (clouds, [dark, light]), [[roughness * (0.5 + p) for p in row] for row in clouds]

    def make_concrete(self, name, dice, roughness, reflectance):
        base = shaded(0.1, dice.uniform(0, 0.08), reflectance)

        def maps():
            self.noise("concrete_fine", SIZE, 40, 1)
            return *self.cloudy(base, roughness), ("concrete_fine", 0.15)

        return self.mapped(name, base, roughness, dice.uniform(2, 3), maps)

    def grained(self, name, base, roughness, period, relief, waves, octaves, steepness, contrast=0.0):
        """A relief of noise that all finishes of a kind share; where there is `contrast`, the colour follows it."""
        def maps():
            image = self.noise(relief, SIZE, waves, octaves)
            colours = [tuple(min(1.0, f * c) for c in base) for f in (1 - contrast, 1 + contrast)]
            return (image, colours) if contrast else None, None, (relief, steepness) if steepness else None

        return self.mapped(name, base, roughness, period, maps)

    def make_carpet(self, name, dice, roughness, reflectance):
        base = shaded(dice.uniform(), dice.uniform(0, 0.5), min(reflectance, 0.5))
        return self.grained(name, base, roughness, 0.5, "pile", 32, 2, 0.6, contrast=0.4)

    def make_plaster(self, name, dice, roughness, reflectance):
        base = shaded(dice.uniform(), dice.uniform(0, 0.6) ** 3, reflectance)
        return self.grained(name, base, roughness, 1.2, "plaster", 16, 3, dice.uniform(0.05, 0.3))

    def make_satin_paint(self, name, dice, roughness, reflectance):
        base = shaded(dice.uniform(), dice.uniform(0, 0.7) ** 3, reflectance)
        return self.grained(name, base, roughness, 0.8, "paint", 12, 2, dice.uniform(0, 0.12))

    def make_lacquer(self, name, dice, roughness, reflectance):
        """With the orange peel of spraying."""
        base = shaded(dice.uniform(), dice.uniform(0, 0.9) ** 2, reflectance)
        return self.grained(name, base, roughness, 0.6, "peel", 16, 2, dice.uniform(0, 0.04))

    def make_leather(self, name, dice, roughness, reflectance):
        base = shaded(dice.one_of((0.05, 0.07, 0.0, 0.6)), dice.uniform(0.1, 0.7), min(reflectance, 0.4))
        return self.grained(name, base, roughness, 0.3, "leather", 20, 2, 0.3)

    def make_cloth(self, name, dice, roughness, reflectance):
        base = shaded(dice.uniform(), dice.uniform(0, 0.8) ** 2, reflectance)
        return self.grained(name, base, roughness, 0.4, "threads", (64, 32), 1, 0.3)

    def make_brushed_metal(self, name, dice, roughness, reflectance):
        base = dice.one_of(((0.56, 0.57, 0.58), (0.91, 0.92, 0.92), (0.83, 0.69, 0.42), (0.45, 0.42, 0.4)))

        def maps():
            streaks = self.noise("streaks", SIZE, (2, 64), 1)
            return None, [[roughness * (0.7 + 0.6 * p) for p in row] for row in streaks], ("streaks", 0.15)

        return self.mapped(name, base, roughness, 0.3, maps, metalness=1.0)

    def make_ceramic(self, name, dice, roughness, reflectance):
        return self.plain(name, shaded(dice.uniform(), dice.uniform(0, 0.6) ** 2, max(reflectance, 0.3)), roughness)

    def make_chrome(self, name, dice, roughness, reflectance):
        base = dice.one_of(((0.55, 0.56, 0.55), (0.6, 0.6, 0.6), (0.95, 0.78, 0.46), (0.78, 0.77, 0.74)))
        return self.plain(name, base, roughness, 1.0)

    def make_mirror(self, name, dice, roughness, reflectance):
        return self.plain(name, (0.92, 0.93, 0.92), roughness, 1.0)

    def make_screen(self, name, dice, roughness, reflectance):
        return self.plain(name, (0.01, 0.01, 0.012), roughness)

    def make_leaf(self, name, dice, roughness, reflectance):
        return self.plain(name, shaded(dice.uniform(0.22, 0.36), dice.uniform(0.5, 0.85), dice.uniform(0.08, 0.25)),
                          roughness)

    # Streets

    def make_wet_asphalt(self, name, dice, roughness, reflectance, water=0.3):
        """A film of water over stones: smooth up to a height of `water`, rougher above."""
        base = shaded(0.6, 0.06, 0.03 + 0.05 * reflectance)

        def maps():
            ground, stones = self.noise("ground", 2 * SIZE, 3, 4), self.noise("asphalt", 2 * SIZE, 64, 2)
            dry = [[min(1.0, max(0.0, (p - water + 0.15) / 0.3)) for p in row] for row in ground]
            shades = [[0.3 * q + 0.6 * d for q, d in zip(a, b)] for a, b in zip(stones, dry)]
            rough = [[roughness * (0.25 + 0.75 * d) + 0.25 * d * q for q, d in zip(a, b)] for a, b in zip(stones, dry)]
            self.images[name] = [[q * d for q, d in zip(a, b)] for a, b in zip(stones, dry)]
            dark, light = (tuple(f * c for c in base) for f in (0.6, 1.8))
            return (shades, [dark, light]), rough, (name, 0.25)

        return self.mapped(name, base, roughness, dice.uniform(5, 8), maps)

    def make_puddles(self, name, dice, roughness, reflectance):
        """Wet asphalt of which most is above the water."""
        return self.make_wet_asphalt(name, dice, max(0.02, 0.5 * roughness), reflectance, water=-0.1)

    def make_paving(self, name, dice, roughness, reflectance):
        base = shaded(0.09, dice.uniform(0, 0.15), 0.1 + 0.4 * reflectance)

        def maps():
            heights, _ = grooves(SIZE, 4, 4, 1.5, True)
            stones = self.noise("paving", SIZE, 24, 3)
            self.images[name] = relief = [[0.75 * h + 0.25 * p for h, p in zip(a, b)] for a, b in zip(heights, stones)]
            return (relief, [tuple(0.3 * c for c in base), tuple(min(1.0, 1.1 * c) for c in base)]), None, (name, 0.6)

        return self.mapped(name, base, roughness, dice.uniform(1.2, 2.4), maps)

    def make_bricks(self, name, dice, roughness, reflectance):
        base = shaded(dice.uniform(0.01, 0.08), dice.uniform(0.3, 0.6), min(0.4, reflectance))
        light = tuple(min(1.0, 1.2 * c) for c in base)

        def maps():
            heights, plates = self.image("bricks", grooves, 2 * SIZE, 6, 18, 1.5, True)
            tints = [row[0] for row in self.noise("tints", 64, 64, 1)] * 2
            shades = [[t * (0.4 + 0.6 * tints[k]) for t, k in zip(a, b)] for a, b in zip(heights, plates)]
            self.images["bricks_relief"] = heights
            return (shades, [(0.4, 0.38, 0.35), base, light]), None, ("bricks_relief", 0.6)

        return self.mapped(name, base, roughness, 1.5, maps)

    def make_bark(self, name, dice, roughness, reflectance):
        return self.grained(name, shaded(0.08, 0.4, 0.08), roughness, 0.6, "bark", (24, 4), 2, 0.8, contrast=0.4)

    def make_car_paint(self, name, dice, roughness, reflectance):
        base = shaded(dice.uniform(), 0.9 if dice.chance(0.4) else 0.05, min(reflectance, 0.75))
        return self.plain(name, base, roughness, 0.0 if dice.chance(0.6) else 0.6)
