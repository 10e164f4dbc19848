"""Houses, cars, and what stands on pavements."""
from ..shapes import cosine, sine
from . import densities as of
from .finishes import warm_white
from .lamps import Lamp
from .solids import bevelled_box, leaf, moved, rotated, smooth_grid, turned, wire
from .thing import Thing


def house(dice, finishes, use, width, depth, is_dusk, kelvin):
    """Its facade at z = 0, facing +z; windows are panes that reflect, some lit at dusk. Returns (thing, height)."""
    thing = Thing("house")
    wall = finishes.get(dice.draw(of.FACADES), use, "walls")
    trim, glass = finishes.get("satin_paint", f"trim_{use}", "ceilings"), finishes.get("screen", "window_glass")
    storeys, rise = max(1, round(dice.draw(of.HOUSE_STOREYS))), dice.draw(of.STOREY_HEIGHT)
    height = storeys * rise + 0.5
    thing.box(wall, width, height, depth, (0, 0, -depth / 2), bevel=0.03)
    thing.box(trim, width - 0.02, 0.22, 0.3, (0, height - 0.24, 0.02), bevel=0.05)
    columns = max(1, round(width / dice.uniform(1.9, 3.2)))
    wide, tall = dice.uniform(0.45, 0.7) * width / columns, dice.uniform(0.45, 0.62) * rise
    has_shop, has_band = dice.chance(of.SHOP), dice.chance(0.5)
    shine = [finishes.lamp(f"window{k}", warm_white(kelvin, dice.about(f"lit{k}").uniform(40, 300))) for k in range(3)]
    for storey in range(storeys):
        y = storey * rise
        if storey == 0:
            ground_floor(dice, finishes, thing, use, width, rise, has_shop, glass, trim, shine if is_dusk else [])
            continue
        if has_band:
            thing.box(trim, width - 0.02, 0.09, 0.08, (0, y - 0.05, 0.03), bevel=0.02)
        for k in range(columns):
            x, sill = (k + 0.5) * width / columns - width / 2, y + 0.3 * rise
            pane = dice.one_of(shine) if is_dusk and dice.chance(of.LIT_WINDOW) else glass
            window(thing, trim, pane, x, sill, wide, tall)
    return thing, height


def window(thing, trim, pane, x, sill, wide, tall):
    thing.box(pane, wide, tall, 0.01, (x, sill, 0.001), bevel=0.001)
    for side in (-1, 1):
        thing.box(trim, 0.07, tall + 0.14, 0.07, (x + side * (wide / 2 + 0.03), sill - 0.07, 0.02), bevel=0.012)
    for y in (sill - 0.07, sill + tall):
        thing.box(trim, wide, 0.07, 0.09, (x, y, 0.02), bevel=0.012)
    thing.box(trim, 0.05, tall, 0.04, (x, sill, 0.015), bevel=0.01)


def ground_floor(dice, finishes, thing, use, width, rise, has_shop, glass, trim, shine):
    """A shop behind large panes with a sign, or windows; and a door."""
    side = dice.one_of((-1, 1))
    door = side * (width / 2 - 0.9)
    thing.box(finishes.get("lacquer", f"door_{use}"), 1.0, 2.15, 0.06, (door, 0.02, 0.01), bevel=0.01)
    thing.box(finishes.get("chrome", "handles"), 0.03, 0.25, 0.05, (door - side * 0.38, 0.95, 0.05), bevel=0.01)
    for x in (-0.56, 0.56):
        thing.box(trim, 0.12, 2.3, 0.1, (door + x, 0, 0.03), bevel=0.02)
    thing.box(trim, 1.24, 0.14, 0.12, (door, 2.18, 0.03), bevel=0.02)
    left, right = (-width / 2 + 0.4, door - 0.9) if side > 0 else (door + 0.9, width / 2 - 0.4)
    count = max(1, int((right - left) / 2.2))
    for k in range(count):
        wide = (right - left) / count
        x = left + (k + 0.5) * wide
        if has_shop:
            pane = dice.one_of(shine) if shine and dice.chance(0.7) else glass
            window(thing, trim, pane, x, 0.45, wide - 0.3, min(2.1, rise - 1.1))
        elif wide > 1.2:
            window(thing, trim, dice.one_of(shine) if shine and dice.chance(of.LIT_WINDOW) else glass, x, 0.95,
                   min(1.3, wide - 0.4), 1.3)
    if has_shop and right - left > 1.5:
        sign = shine[0] if shine else finishes.get("lacquer", f"sign_{use}")
        thing.box(sign, right - left - 0.3, 0.4, 0.1, ((left + right) / 2, min(2.75, rise - 0.45), 0.05), bevel=0.02)
        if dice.chance(0.4):
            awning = moved(rotated(bevelled_box(right - left, 0.02, 1.2, 0.005), 22, 0),
                           ((left + right) / 2, min(2.4, rise - 0.7), 0.6))
            thing.put(awning, finishes.get("cloth", f"awning_{use}"))


def rounded_section(half_width, low, high, power_top=0.35):
    """A ring of 16 points (x, y), counter-clockwise seen from +z: a rectangle with round corners, drawn in above."""
    ring = []
    for k in range(16):
        c, s = cosine(22.5 * k + 11.25), sine(22.5 * k + 11.25)
        bulge = 1 / max(abs(c), abs(s)) ** 0.8
        inward = 1 - power_top * 0.4 * max(0.0, s)
        ring.append((half_width * c * bulge * inward, (low + high) / 2 + (high - low) / 2 * s * bulge * 0.97))
    return ring


def car(dice, finishes, use, is_dusk):
    """Its nose at +z, 1.75 x 1.45 x 4.3 m or so; panels are curved both ways."""
    thing = Thing("car")
    paint, glass = finishes.get("car_paint", use), finishes.get("screen", "car_glass")
    tyre, rim = finishes.get("plastic", "tyre"), finishes.get("chrome", "rim")
    length, half, tall = dice.uniform(3.7, 4.8), dice.uniform(0.82, 0.92), dice.uniform(1.38, 1.62)
    hood = dice.uniform(0.72, 0.85)
    stations = [(-0.5, 0.62, 0.35, 0.6), (-0.49, 0.85, 0.3, hood - 0.05), (-0.42, 0.96, 0.24, hood + 0.06),
                (-0.2, 1.0, 0.22, hood + 0.1), (0.1, 1.0, 0.22, hood + 0.08), (0.3, 0.98, 0.22, hood),
                (0.44, 0.92, 0.26, hood - 0.1), (0.49, 0.8, 0.32, hood - 0.22), (0.5, 0.6, 0.36, 0.52)]
    rows = [[(x, y, length * z) for x, y in rounded_section(half * w, low, high)] for z, w, low, high in stations]
    ends = [[(0.0, 0.48, p[0][2])] * 16 for p in (rows[0], rows[-1])]
    thing.put(smooth_grid([ends[0], *rows, ends[1]], closed=True), paint)
    cabin = [(-0.4, 0.7, hood - 0.02, hood + 0.06), (-0.32, 0.84, hood - 0.05, tall - 0.1),
             (-0.2, 0.86, hood - 0.05, tall),
             (0.02, 0.86, hood - 0.05, tall - 0.02), (0.14, 0.84, hood - 0.05, tall - 0.16),
             (0.28, 0.78, hood - 0.08, hood + 0.02)]
    rows = [[(x, y, length * z) for x, y in rounded_section(half * w, low, high, 0.55)] for z, w, low, high in cabin]
    thing.put(smooth_grid(rows, closed=True), glass)
    thing.put(moved(rotated(bevelled_box(half * 1.22, 0.05, length * 0.34, 0.024), -1, 0),
                    (0, tall - 0.035, -0.12 * length)),
              paint)
    for x in (-1, 1):
        for z in (-0.31, 0.31):
            wheel = turned([(0, 0), (0.2, 0.0), (0.3, 0.01), (0.32, 0.04), (0.32, 0.16), (0.3, 0.19), (0.21, 0.2)], 28)
            face = turned([(0.21, 0.19), (0.12, 0.17), (0.05, 0.195), (0, 0.2)], 28)
            for shape, finish in ((wheel, tyre), (face, rim)):
                thing.put(rotated(shape, -90 * x, 2), finish, (x * (half - 0.19), 0.32, z * length))
        thing.box(paint, 0.16, 0.1, 0.08, (x * (half + 0.06), hood + 0.02, 0.17 * length), bevel=0.03)
        front = finishes.lamp("headlight", (60.0, 58.0, 52.0)) if is_dusk else rim
        rear = finishes.lamp("rear_light", (8.0, 0.3, 0.2)) if is_dusk else finishes.get("lacquer", "rear_light")
        thing.box(front, 0.28, 0.1, 0.1, (x * (half - 0.25), hood - 0.26, 0.485 * length), bevel=0.03)
        thing.box(rear, 0.22, 0.12, 0.06, (x * (half - 0.2), hood - 0.2, -0.49 * length), bevel=0.02)
    thing.box(finishes.get("satin_paint", "plate", "ceilings"), 0.52, 0.11, 0.02, (0, 0.42, 0.5 * length + 0.005),
              bevel=0.003)
    thing.box(finishes.get("satin_paint", "plate", "ceilings"), 0.52, 0.11, 0.02, (0, 0.55, -0.5 * length - 0.005),
              bevel=0.003)
    return thing


def street_lamp(dice, finishes, height):
    """Its arm reaches over the road, to +z."""
    thing = Thing("street_lamp")
    metal = finishes.get("brushed_metal" if dice.chance(0.5) else "satin_paint", "street_lamp")
    thing.put(turned([(0, 0), (0.1, 0), (0.09, 0.6), (0.055, 0.75), (0.04, height), (0, height)], 14), metal)
    thing.put(wire([(0, height - 0.1, 0), (0, height + 0.1, 0.3), (0, height + 0.16, 0.8), (0, height + 0.17, 1.1)],
                   0.03, 8),
              metal)
    thing.box(metal, 0.28, 0.08, 0.6, (0, height + 0.14, 1.3), bevel=0.03)
    glow = smooth_grid([[(-0.11, height + 0.139, z), (0.11, height + 0.139, z)] for z in (1.06, 1.54)])
    return Lamp(thing, (0, height + 0.1, 1.3), 0.22 * 0.48, [(glow, (0, 0, 0))])


def tree(dice, finishes):
    """A trunk, boughs, and leaves around their ends."""
    thing = Thing("tree")
    bark, green = finishes.get("bark", "tree"), finishes.get("leaf", "tree")
    height = dice.uniform(2.2, 3.2)
    thing.put(turned([(0.16, 0), (0.11, 0.4), (0.08, height)], 10), bark)
    for k in range(9):
        turn, up, out = 40 * k + dice.uniform(-15, 15), dice.uniform(0.5, 2.2), dice.uniform(0.4, 1.4)
        tip = (0, height + up, out)
        thing.put(rotated(wire([(0, height - 0.3, 0), (0, height + 0.5 * up, 0.6 * out), tip], 0.03, 5), turn), bark)
        for _ in range(16):
            blade = rotated(leaf(0.34, 0.2, dice.uniform(-0.2, 0.8), dice.uniform(0.3, 0.9), 3), dice.uniform(0, 360))
            at = (tip[0] + dice.uniform(-0.5, 0.5), tip[1] + dice.uniform(-0.5, 0.4), tip[2] + dice.uniform(-0.5, 0.4))
            thing.put(rotated(moved(blade, at), turn), green)
    return thing


def bench(dice, finishes):
    thing = Thing("bench")
    wood, metal = finishes.get("wood", "bench"), finishes.get("satin_paint", "bench_leg")
    for k in range(4):
        thing.box(wood, 1.6, 0.035, 0.09, (0, 0.44, -0.17 + 0.11 * k), bevel=0.008)
    for k in range(3):
        thing.box(wood, 1.6, 0.09, 0.03, (0, 0.54 + 0.12 * k, -0.25), bevel=0.008)
    for x in (-0.65, 0.65):
        for z in (-0.24, 0.16):
            thing.box(metal, 0.05, 0.44 if z > 0 else 0.88, 0.04, (x, 0, z))
        thing.box(metal, 0.05, 0.04, 0.4, (x, 0.4, -0.04))
    return thing


def bollard(dice, finishes):
    thing = Thing("bollard")
    metal = finishes.get("chrome" if dice.chance(0.4) else "brushed_metal", "bollard")
    thing.put(turned([(0, 0), (0.06, 0), (0.055, 0.85), (0.06, 0.86), (0.06, 0.92), (0.03, 0.96), (0, 0.96)], 20),
              metal)
    return thing


def bin_(dice, finishes):
    thing = Thing("bin")
    thing.pole(finishes.get("brushed_metal", "bin"), 0.2, 0.8, (0, 0.05, 0), sides=24, bevel=0.015)
    thing.pole(finishes.get("plastic", "bin"), 0.21, 0.05, (0, 0.85, 0), sides=24, bevel=0.015)
    thing.pole(finishes.get("plastic", "bin"), 0.15, 0.06, sides=16)
    return thing


def sign(dice, finishes):
    """A round or square sign on a thin pole."""
    thing = Thing("sign")
    thing.pole(finishes.get("chrome", "sign"), 0.025, 2.6)
    plate = finishes.get("satin_paint", f"sign{dice.whole(0, 2)}")
    if dice.chance(0.5):
        thing.put(moved(rotated(turned([(0, 0), (0.3, 0), (0.3, 0.01), (0, 0.01)], 28), 90, 0), (0, 2.3, 0.03)), plate)
    else:
        thing.box(plate, 0.55, 0.55, 0.015, (0, 2.02, 0.035), bevel=0.006)
    return thing
