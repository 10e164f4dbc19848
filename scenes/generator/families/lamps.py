"""Lamps of rooms. What they emit is set when all are known: each is a share of the room's light."""
from dataclasses import dataclass, field

from . import densities as of
from .finishes import warm_white
from .solids import ball, moved, smooth_grid, turned, wire
from .thing import Thing

PI = 3.141592654


@dataclass
class Lamp:
    """A lamp as thing, and how it emits: `area` in m^2 of the surfaces of `glow`, or a spot light."""
    thing: Thing
    light: tuple  # the middle of what emits, in the thing's coordinates
    area: float = 0.0
    glow: list = field(default_factory=list)  # (shape, at): put when the radiance is known
    is_spot: bool = False
    weight: float = 1.0  # of its share of the room's light

    def finish(self, finishes, kelvin, lumens, is_lit):
        """Puts what glows; returns scene.json's light of a spot light without its place, or None."""
        luminance = lumens / (PI * self.area) if self.area and is_lit else 0.0
        if self.glow and not is_lit:
            white = finishes.get("ceramic", "lamp_off", "ceilings")
        elif self.glow:
            white = finishes.lamp(self.thing.name, warm_white(kelvin, luminance))
        for shape, at in self.glow:
            self.thing.put(shape, white, at)
        if not (self.is_spot and is_lit):
            return None
        # A cone of 36 degrees, half way between the inner and the outer one, has 1.2 sr.
        colour = warm_white(kelvin, of.CANDELA)
        return {"type": "spot", "direction": [0, -1, 0], "intensity": round(lumens / 1.2 / of.CANDELA, 4),
                "color": [round(c, 4) for c in colour], "inner_cone_deg": 25, "outer_cone_deg": 48}


def cone(low, high, height, thick=0.004, sides=28):
    """A shade, open above and below."""
    return turned([(low, 0), (high, height), (high - thick, height), (low - thick, 0)], sides)


def bulb(radius):
    """A globe and its area, which emits to all sides."""
    return ball(radius, 14), 4 * PI * radius * radius


def pendant(dice, finishes, drop):
    """Hangs from y = 0 by `drop` metres on a thin wire."""
    thing = Thing("pendant")
    metal = finishes.get(dice.draw(of.LEGS), "pendant")
    thing.put(moved(turned([(0, 0), (0.05, 0), (0.05, 0.02), (0, 0.02)], 20), (0, -0.021, 0)), metal)
    thing.put(wire([(0, -0.02, 0), (0, -drop + 0.12, 0)], 0.0025, 5), finishes.get("plastic", "flex"))
    if dice.chance(of.IS_BARE):
        globe, area = bulb(dice.uniform(0.045, 0.14))
        thing.pole(metal, 0.018, 0.07, (0, -drop + 0.08, 0))
        return Lamp(thing, (0, -drop, 0), area, [(globe, (0, -drop, 0))])
    kind = dice.one_of(["cone", "dome", "drum"])
    r = dice.uniform(0.14, 0.26)
    if kind == "drum":  # of cloth that glows itself
        shape = turned([(r, 0), (r, 0.22)], 32)
        return Lamp(thing, (0, -drop + 0.05, 0), 2 * PI * r * 0.22, [(shape, (0, -drop, 0))])
    shade = finishes.get("lacquer" if dice.chance(0.6) else "brushed_metal", "pendant_shade")
    profile = (cone(r, 0.05, r * 0.8) if kind == "cone" else
               turned([(r, 0), (0.92 * r, 0.35 * r), (0.65 * r, 0.65 * r), (0.05, 0.8 * r), (0.045, 0.79 * r),
                       (0.63 * r, 0.63 * r), (0.9 * r, 0.34 * r), (0.985 * r, 0)], 32))
    thing.put(profile, shade, (0, -drop, 0))
    globe, area = bulb(0.05)
    return Lamp(thing, (0, -drop + 0.05, 0), area, [(globe, (0, -drop + 0.06, 0))])


def downlight(dice, finishes):
    """A ring in the ceiling at y = 0 with a disc that emits, or before which a spot light hangs."""
    thing = Thing("downlight")
    thing.put(turned([(0.045, -0.006), (0.055, -0.004), (0.058, 0.0)], 24), finishes.get("chrome", "downlight"))
    disc = turned([(0, -0.003), (0.044, -0.003)], 24)
    if dice.chance(of.IS_PUNCTUAL):
        thing.put(disc, finishes.get("ceramic", "lamp_off", "ceilings"))
        return Lamp(thing, (0, -0.02, 0), is_spot=True)
    return Lamp(thing, (0, -0.004, 0), PI * 0.044 * 0.044, [(disc, (0, 0, 0))])


def panel(dice, finishes):
    """0.6 x 0.6 m, or a tube of light of 1.2 m, below the ceiling at y = 0."""
    thing = Thing("panel")
    metal = finishes.get("satin_paint", "panel", "ceilings")
    width, depth = dice.one_of(((0.6, 0.6), (1.2, 0.12), (1.2, 0.3)))
    thing.box(metal, width + 0.03, 0.035, depth + 0.03, (0, -0.036, 0))
    glow = smooth_grid([[(-width / 2, -0.0375, z), (width / 2, -0.0375, z)] for z in (-depth / 2, depth / 2)])
    return Lamp(thing, (0, -0.05, 0), width * depth, [(glow, (0, 0, 0))])


def standing_lamp(dice, finishes, height, use):
    """On the floor or, of 0.5 m and less, on a table."""
    thing = Thing(use)
    metal = finishes.get(dice.draw(of.LEGS), use)
    r = 0.12 + 0.07 * height
    thing.put(turned([(0, 0), (0.55 * r + 0.03, 0), (0.55 * r + 0.03, 0.012), (0.02, 0.03), (0, 0.03)], 28), metal)
    shade = (0.2 + 0.1 * height) * dice.uniform(0.8, 1.1)
    thing.pole(metal, 0.009, height - shade, (0, 0.02, 0))
    if dice.chance(of.IS_BARE):
        globe, area = bulb(0.06 + 0.04 * min(height, 1))
        return Lamp(thing, (0, height - 0.1, 0), area, [(globe, (0, height - shade + 0.08, 0))], weight=0.5)
    cover = turned([(r, 0), (0.72 * r, shade)], 28)
    return Lamp(thing, (0, height - shade / 2, 0), 2 * PI * 0.86 * r * shade, [(cover, (0, height - shade, 0))],
                weight=0.5)


def cable(finishes, points):
    """Along the floor and up the wall."""
    thing = Thing("cable")
    thing.put(wire(points, 0.004, 6), finishes.get("plastic", "flex"))
    thing.box(finishes.get("plastic", "socket", "ceilings"), 0.08, 0.08, 0.012,
              (points[-1][0], points[-1][1] - 0.04, points[-1][2]), bevel=0.003)
    return thing
