"""What is put onto tables, walls and windows, and plants."""
from . import densities as of
from .solids import ball, bevelled_box, leaf, moved, rotated, scaled, sheet, turned, wire
from .thing import Thing


def vase_shape(dice, radius, height):
    neck = dice.uniform(0.3, 0.7)
    return turned([(0, 0), (0.6 * radius, 0), (radius, 0.35 * height), (radius * 0.9, 0.55 * height),
                   (radius * neck, 0.85 * height), (radius * (neck + 0.12), height), (radius * (neck - 0.06), height),
                   (radius * (neck - 0.1), 0.8 * height), (0, 0.78 * height)], 20)


def desk_things(dice, finishes, height):
    """Screen, keyboard and mouse, to stand on a desk 0.7 m deep; facing +z."""
    thing = Thing("computer")
    body, glass = finishes.get("plastic", "computer"), screen_finish(dice, finishes, "monitor")
    width = dice.uniform(0.5, 0.8)
    thing.box(body, 0.24, 0.012, 0.18, (0, height, -0.12), bevel=0.004)
    thing.box(body, 0.04, 0.2, 0.02, (0, height + 0.01, -0.16))
    thing.box(body, width, width * 0.58, 0.03, (0, height + 0.12, -0.14))
    thing.box(glass, width - 0.02, width * 0.58 - 0.02, 0.004, (0, height + 0.13, -0.1235), bevel=0.001)
    thing.box(body, 0.44, 0.018, 0.13, (0, height, 0.14), bevel=0.005)
    thing.put(moved(scaled(ball(1, 12), 0.03, 0.02, 0.05), (0.32, height + 0.018, 0.15)), body)
    thing.put(wire([(0.1, height + 0.2, -0.16), (0.12, height + 0.05, -0.22), (0.15, height + 0.004, -0.25)], 0.004),
              body)
    return thing


def screen_finish(dice, finishes, use):
    """Off: glossy and black; on: of an even light."""
    if dice.chance(of.SCREEN_IS_ON):
        luminance = dice.uniform(80, 350)
        tint = [dice.uniform(0.5, 1.2) for _ in range(3)]
        return finishes.lamp(use, [luminance / of.CANDELA * t for t in tint])
    return finishes.get("screen", use)


def television(dice, finishes, width):
    """Stands on its foot at y = 0."""
    thing = Thing("television")
    body, glass = finishes.get("plastic", "television"), screen_finish(dice, finishes, "television")
    height = width * 0.57
    thing.box(body, width * 0.4, 0.015, 0.22, bevel=0.005)
    thing.box(body, 0.08, 0.08, 0.03, (0, 0.01, 0))
    thing.box(body, width, height, 0.035, (0, 0.06, 0))
    thing.box(glass, width - 0.02, height - 0.02, 0.004, (0, 0.07, 0.017), bevel=0.001)
    return thing


def plant(dice, finishes, height):
    """Pot, stems and leaves."""
    thing = Thing("plant")
    pot = finishes.get("ceramic", f"pot{dice.whole(0, 3)}")
    green = finishes.get("leaf", f"plant{dice.whole(0, 1)}")
    radius = 0.09 + 0.07 * height
    rim = 0.9 * radius * 2 * 0.9
    thing.put(turned([(0, 0), (0.7 * radius, 0), (radius, rim), (0.92 * radius, rim), (0.85 * radius, 0.8 * rim),
                      (0, 0.78 * rim)], 24), pot)
    for k in range(dice.whole(7, 14)):
        turn, up = dice.uniform(0, 360), dice.uniform(0.15, 1)
        stem = (height - rim) * up * 0.75
        lean = dice.uniform(0.02, 0.12)
        foot, bend = (0, 0.75 * rim, 0), (0, rim + stem * 0.6, 0.4 * lean)
        tip = (0, rim + stem, lean)
        thing.put(rotated(wire([foot, bend, tip], 0.004, 5), turn), green)
        length = dice.uniform(0.25, 0.5) * max(0.35, min(height, 1.2)) * 0.8
        blade = leaf(length, length * dice.uniform(0.22, 0.5), dice.uniform(0.3, 0.9), dice.uniform(0.4, 1.1))
        thing.put(rotated(moved(blade, tip), turn), green)
    return thing


def rug(dice, finishes, width, depth):
    thing = Thing("rug")
    thing.box(finishes.get("carpet", "rug"), width, 0.012, depth, bevel=0.005)
    return thing


def wall_mirror(dice, finishes, width, height):
    """Hangs at y = 0; its back at z = 0."""
    thing = Thing("mirror")
    frame = finishes.get(dice.draw(of.LEGS), "mirror_frame")
    bar = dice.uniform(0.012, 0.06)
    for x in (-1, 1):
        thing.box(frame, bar, height, 0.03, (x * (width - bar) / 2, 0, 0.015))
    for y in (0, height - bar):
        thing.box(frame, width - 2 * bar, bar, 0.03, (0, y, 0.015))
    thing.box(finishes.get("mirror", "wall"), width - 2 * bar, height - 2 * bar, 0.012, (0, bar, 0.008), bevel=0.0005)
    return thing


def picture(dice, finishes, width, height):
    thing = Thing("picture")
    frame = finishes.get(dice.draw(of.LEGS), f"picture_frame{dice.whole(0, 1)}")
    bar = dice.uniform(0.012, 0.035)
    for x in (-1, 1):
        thing.box(frame, bar, height, 0.025, (x * (width - bar) / 2, 0, 0.013))
    for y in (0, height - bar):
        thing.box(frame, width - 2 * bar, bar, 0.025, (0, y, 0.013))
    thing.box(finishes.get("satin_paint", "mat", "ceilings"), width - 2 * bar, height - 2 * bar, 0.01, (0, bar, 0.006))
    for k in range(dice.whole(1, 4)):
        paint = finishes.get("satin_paint", f"painting{dice.whole(0, 5)}")
        wide, tall = (width - 2 * bar) * dice.uniform(0.2, 0.6), (height - 2 * bar) * dice.uniform(0.2, 0.6)
        x = dice.uniform(-0.5, 0.5) * (width - 2 * bar - wide) * 0.9
        y = bar + dice.uniform(0.05, 0.95) * (height - 2 * bar - tall)
        thing.box(paint, wide, tall, 0.002, (x, y, 0.0115 + 0.0006 * k), bevel=0.0002)
    return thing


def curtain(dice, finishes, width, height):
    thing = Thing("curtain")
    thing.put(sheet(width, height, max(3, round(width / 0.09)), 0.035), finishes.get("cloth", "curtain"))
    return thing


def clutter(dice, finishes, space):
    """A small thing of at most `space` across: vase, cup, bowl, books, bottle, candle, box, plant."""
    kind = dice.one_of(["vase", "cup", "bowl", "books", "bottle", "can", "box", "plant", "fruit"])
    thing = Thing(kind)
    ceramic = finishes.get("ceramic", f"small{dice.whole(0, 4)}")
    if kind == "vase":
        thing.put(vase_shape(dice, min(0.45 * space, dice.uniform(0.04, 0.09)), dice.uniform(0.14, 0.34)), ceramic)
    elif kind == "cup":
        thing.put(turned([(0, 0), (0.03, 0), (0.04, 0.09), (0.036, 0.09), (0.028, 0.01), (0, 0.01)], 20), ceramic)
        thing.put(wire([(0.036, 0.02, 0), (0.06, 0.03, 0), (0.062, 0.06, 0), (0.039, 0.075, 0)], 0.004), ceramic)
    elif kind in ("bowl", "fruit"):
        r = min(0.45 * space, dice.uniform(0.07, 0.15))
        thing.put(turned([(0, 0), (0.4 * r, 0), (0.8 * r, 0.25 * r), (r, 0.55 * r), (0.95 * r, 0.55 * r),
                          (0.7 * r, 0.25 * r), (0, 0.08 * r)], 28),
                  finishes.get("chrome", "bowl") if dice.chance(0.35) else ceramic)
        if kind == "fruit":
            for k in range(dice.whole(2, 4)):
                fruit = rotated(moved(ball(0.36 * r, 14), (0.42 * r, 0.5 * r, 0)), 360 * k / 4)
                thing.put(fruit, finishes.get("plastic", f"fruit{dice.whole(0, 2)}"))
    elif kind == "books":
        y = 0.0
        for k in range(dice.whole(1, 4)):
            thick = dice.uniform(0.012, 0.04)
            book = rotated(bevelled_box(min(space, dice.uniform(0.16, 0.24)), thick,
                                        min(space, dice.uniform(0.12, 0.17)),
                                        0.002), dice.uniform(-12, 12))
            thing.put(book, finishes.get("satin_paint", f"book{dice.whole(0, 5)}"), (0, y, 0))
            y += thick
    elif kind == "bottle":
        thing.put(turned([(0, 0), (0.036, 0), (0.038, 0.01), (0.038, 0.17), (0.015, 0.23), (0.014, 0.3), (0, 0.3)], 20),
                  finishes.get("lacquer", f"bottle{dice.whole(0, 2)}"))
    elif kind == "can":
        thing.pole(finishes.get("chrome" if dice.chance(0.5) else "brushed_metal", "can"), dice.uniform(0.03, 0.06),
                   dice.uniform(0.08, 0.2), sides=24, bevel=0.003)
    elif kind == "box":
        thing.box(finishes.get("lacquer", f"box{dice.whole(0, 3)}"), min(space, dice.uniform(0.06, 0.25)),
                  dice.uniform(0.04, 0.15), min(space, dice.uniform(0.05, 0.16)), bevel=0.004)
    else:
        return plant(dice, finishes, dice.uniform(0.25, 0.45))
    return thing
