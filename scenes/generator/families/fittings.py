"""What is built into kitchens and bathrooms, and radiators."""
from ..shapes import cosine, sine
from . import densities as of
from .furniture import cupboard, handle
from .solids import scaled, smooth_grid, turned, wire
from .thing import Thing


def kitchen_row(dice, finishes, width, has_wall_units):
    """Worktop with sink, hob, tap; cupboards below and above."""
    height = dice.draw(of.WORKTOP_HEIGHT)
    thing = cupboard(dice, finishes, "kitchen", width, height, 0.62, foot=0.1,
                     top_kind=dice.about("top").one_of(["polished_stone", "lacquer", "brushed_metal", "wood"]))
    thing.name = "kitchen_row"
    steel, black = finishes.get("brushed_metal", "kitchen"), finishes.get("screen", "hob")
    hob = dice.uniform(-width / 2 + 0.4, -0.05)
    sink = dice.uniform(0.25, width / 2 - 0.35) if width > 1.6 else width / 2 - 0.3
    thing.box(black, 0.58, 0.008, 0.5, (hob, height, 0), bevel=0.002)
    thing.box(steel, 0.5, 0.006, 0.42, (sink, height, 0), bevel=0.002)
    thing.box(black, 0.42, 0.004, 0.34, (sink, height + 0.004, 0.01), bevel=0.001)
    tap = finishes.get("chrome", "tap")
    thing.put(wire([(sink, height, -0.22), (sink, height + 0.24, -0.22), (sink, height + 0.3, -0.18),
                    (sink, height + 0.31, -0.12), (sink, height + 0.27, -0.06), (sink, height + 0.22, -0.05)], 0.012,
                   10),
              tap)
    if has_wall_units:
        front = finishes.get(dice.draw(of.FRONTS), "wall_units")
        count = max(1, round((width - 0.62) / 0.55))
        places = [-width / 2 + (k + 0.5) * width / (count + 1) for k in range(count + 1)]
        for x in places:
            if abs(x - hob) < 0.4:
                continue
            wide = width / (count + 1) - 0.006
            thing.box(front, wide, 0.62, 0.34, (x, 1.42, -0.13), bevel=0.004)
            handle(thing, tap, 0.12, (x + wide / 2 - 0.05, 1.53, 0.042), upright=True)
        thing.box(steel, 0.58, 0.06, 0.42, (hob, 1.55, -0.09))
        thing.box(steel, 0.26, 0.75, 0.24, (hob, 1.6, -0.18))
    thing.tops = [(-width / 2 + 0.1, hob - 0.33, -0.2, 0.2, height), (hob + 0.33, sink - 0.3, -0.2, 0.2, height)]
    thing.tops = [top for top in thing.tops if top[1] - top[0] > 0.12]
    return thing


def fridge(dice, finishes):
    thing = Thing("fridge")
    body = finishes.get("brushed_metal" if dice.chance(0.5) else "lacquer", "fridge")
    metal = finishes.get("chrome", "handles")
    split, height = dice.uniform(0.6, 0.8), dice.uniform(1.6, 1.95)
    thing.box(body, 0.6, height - 0.05, 0.58, (0, 0.05, -0.03), bevel=0.01)
    thing.box(body, 0.598, split - 0.01, 0.05, (0, 0.06, 0.29), bevel=0.012)
    thing.box(body, 0.598, height - split - 0.07, 0.05, (0, split + 0.06, 0.29), bevel=0.012)
    for y in (split - 0.2, split + 0.32):
        handle(thing, metal, 0.3, (-0.25, y, 0.315), upright=True)
    for x in (-0.25, 0.25):
        thing.pole(finishes.get("plastic", "plinth"), 0.02, 0.06, (x, 0, 0.2))
    return thing


def washbasin(dice, finishes, width):
    thing = cupboard(dice, finishes, "bath", width, 0.84, 0.48, foot=0.12, top_kind="ceramic")
    white, tap = finishes.get("ceramic", "sanitary", "ceilings"), finishes.get("chrome", "tap")
    thing.put(scaled(turned([(0, 0), (0.12, 0), (0.2, 0.05), (0.24, 0.14), (0.22, 0.14), (0.17, 0.05), (0, 0.03)], 28),
                     1, 1, 0.8), white, (0, 0.84, 0.02))
    thing.put(wire([(0, 0.84, -0.2), (0, 1.08, -0.2), (0, 1.12, -0.16), (0, 1.11, -0.08), (0, 1.08, -0.06)], 0.011,
                   10), tap)
    thing.tops = [(0.27, width / 2 - 0.05, -0.18, 0.18, 0.84), (-width / 2 + 0.05, -0.27, -0.18, 0.18, 0.84)]
    thing.tops = [top for top in thing.tops if top[1] - top[0] > 0.12]
    return thing


def bathtub(dice, finishes):
    """1.7 x 0.75 m, hollow: a loft of rounded rings, outside up and inside down."""
    thing = Thing("bathtub")
    white, tap = finishes.get("ceramic", "sanitary", "ceilings"), finishes.get("chrome", "tap")
    rows = []
    for y, grow in ((0, 0.84), (0.1, 0.92), (0.5, 1), (0.57, 1.04), (0.58, 1.0), (0.55, 0.93), (0.2, 0.84), (0.14, 0.7),
                    (0.13, 0.02)):
        ring = []
        for k in range(32):
            c, s = cosine(360 * k / 32), sine(360 * k / 32)
            bulge = 1 / max(abs(c), abs(s)) ** 0.75
            ring.append((0.84 * grow * c * bulge * 0.98, y, -0.37 * grow * s * bulge * 0.98))
        rows.append(ring)
    thing.put(smooth_grid(rows, closed=True), white)
    thing.put(wire([(0.6, 0.58, -0.34), (0.6, 0.75, -0.34), (0.6, 0.78, -0.28), (0.6, 0.76, -0.22)], 0.012, 10), tap)
    return thing


def toilet(dice, finishes):
    thing = Thing("toilet")
    white = finishes.get("ceramic", "sanitary", "ceilings")
    thing.put(scaled(turned([(0, 0), (0.13, 0), (0.12, 0.1), (0.17, 0.3), (0.2, 0.4), (0.19, 0.42), (0, 0.42)], 24),
                     0.95, 1,
                     1.25), white, (0, 0, 0.08))
    thing.box(white, 0.36, 0.36, 0.17, (0, 0.4, -0.25), bevel=0.03)
    thing.box(finishes.get("chrome", "tap"), 0.06, 0.008, 0.03, (0, 0.76, -0.25))
    thing.box(white, 0.3, 0.4, 0.3, (0, 0, -0.2), bevel=0.04)
    return thing


def radiator(dice, finishes, width):
    thing = Thing("radiator")
    white = finishes.get("satin_paint", "radiator", "ceilings")
    count = max(4, round(width / 0.06))
    for k in range(count):
        thing.box(white, 0.045, 0.58, 0.07, ((k - (count - 1) / 2) * 0.06, 0.12, 0), bevel=0.012)
    for y in (0.16, 0.62):
        thing.box(white, 0.06 * count, 0.03, 0.03, (0, y, 0), bevel=0.01)
    thing.put(wire([(0.03 * count - 0.02, 0.17, -0.02), (0.03 * count + 0.05, 0.17, -0.02),
                    (0.03 * count + 0.05, 0, -0.02)],
                   0.01, 8), finishes.get("chrome", "tap"))
    return thing
