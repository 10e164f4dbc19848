"""Tables, seats, beds and cupboards."""
from . import decoration
from . import densities as of
from .solids import ball, bevelled_box, moved, rotated, scaled, smooth_grid, wire
from .thing import Thing


def table(dice, finishes, use, length, width, height):
    """Along x."""
    thing = Thing(f"{use}_table")
    top, leg = finishes.get(dice.draw(of.TOPS), f"{use}_top"), finishes.get(dice.draw(of.LEGS), f"{use}_leg")
    thick = dice.uniform(0.018, 0.045)
    thing.box(top, length, thick, width, (0, height - thick, 0), bevel=dice.uniform(0.002, 0.012))
    under, kind = height - thick, dice.draw(of.TABLE_LEGS)
    inset = dice.uniform(0.03, 0.09)
    corners = [(x * (length / 2 - inset), z * (width / 2 - inset)) for x in (-1, 1) for z in (-1, 1)]
    if kind == "pedestal" and length < 1.3:
        thing.pole(leg, 0.04, under - 0.03, (0, 0.03, 0))
        thing.pole(leg, min(0.28, 0.35 * width), 0.03, sides=32, bevel=0.008)
    elif kind == "frame":
        bar = dice.uniform(0.02, 0.05)
        for x in (-1, 1):
            middle = x * (length / 2 - inset)
            for z in (-1, 1):
                thing.box(leg, bar, under, bar, (middle, 0, z * (width / 2 - inset)))
            thing.box(leg, bar, bar, width - 2 * inset - bar, (middle, 0, 0))
            thing.box(leg, bar, bar, width - 2 * inset - bar, (middle, under - bar, 0))
        thing.box(leg, length - 2 * inset - bar, bar, bar, (0, under - bar, 0))
    elif kind == "round":
        for x, z in corners:
            thing.pole(leg, dice.about("leg").uniform(0.012, 0.03), under, (x, 0, z))
    else:
        side = dice.uniform(0.03, 0.08)
        for x, z in corners:
            thing.box(leg, side, under, side, (x, 0, z))
        for z in (-1, 1):
            thing.box(leg, length - 2 * inset - side, 0.07, 0.02, (0, under - 0.07, z * (width / 2 - inset)))
        for x in (-1, 1):
            thing.box(leg, 0.02, 0.07, width - 2 * inset - side, (x * (length / 2 - inset), under - 0.07, 0))
    thing.tops.append((-length / 2 + 0.08, length / 2 - 0.08, -width / 2 + 0.08, width / 2 - 0.08, height))
    return thing


def chair(dice, finishes, use):
    """0.45 x 0.5 m."""
    thing = Thing(f"{use}_chair")
    leg, seat = finishes.get(dice.draw(of.LEGS), f"{use}_leg"), finishes.get(dice.draw(of.SEATS), f"{use}_seat")
    height, kind = dice.draw(of.SEAT_HEIGHT), dice.draw(of.CHAIR_KIND)
    if kind == "wire":  # a cantilever of bent tube
        for x in (-0.19, 0.19):
            thing.put(wire([(x, 0.85, -0.26), (x, height, -0.2), (x, height - 0.02, 0.18), (x, height - 0.05, 0.2),
                            (x, 0.05, 0.2), (x, 0.012, 0.17), (x, 0.012, -0.22)], 0.011, 8), leg)
        thing.put(wire([(-0.19, 0.012, -0.22), (0.19, 0.012, -0.22)], 0.011, 8), leg)
        thing.box(seat, 0.4, 0.04, 0.4, (0, height, 0), bevel=0.015)
        thing.put(moved(rotated(bevelled_box(0.4, 0.3, 0.025, 0.01), -9, 0), (0, height + 0.13, -0.22)), seat)
    else:
        for x in (-1, 1):
            for z in (-1, 1):
                if kind == "shell":
                    thing.put(wire([(x * 0.13, height, z * 0.13), (x * 0.21, 0, z * 0.22)], 0.01, 8), leg)
                else:
                    thing.box(leg, 0.032, height if z > 0 else 0.88, 0.032, (x * 0.195, 0, z * 0.2))
        if kind == "shell":
            rows = []
            for k in range(9):
                t = k / 8
                z, y = (0.22 - 0.4 * t / 0.55, 0.03 * (1 - t)) if t < 0.55 else (-0.18 - 0.1 * (t - 0.55) / 0.45,
                                                                                  0.42 * (t - 0.55) / 0.45 + 0.01)
                rows.append([(x, height + y + 0.9 * x * x, z + (0.7 * x * x if t > 0.55 else 0))
                             for x in (-0.22, -0.13, 0, 0.13, 0.22)])
            thing.put(smooth_grid(rows), seat)
        else:
            thing.box(seat, 0.42, 0.05, 0.42, (0, height - 0.02, 0), bevel=0.015)
            for k in range(3):
                thing.box(leg, 0.36, 0.05, 0.015, (0, height + 0.14 + 0.11 * k, -0.2))
    return thing


def office_chair(dice, finishes):
    thing = Thing("office_chair")
    leg, seat = finishes.get("chrome", "office_chair"), finishes.get(dice.draw(of.SEATS), "office_chair")
    for k in range(5):
        foot = rotated(moved(bevelled_box(0.04, 0.03, 0.28, 0.01), (0, 0.06, 0.15)), 72 * k)
        thing.put(foot, leg)
        thing.put(rotated(moved(ball(0.03, 10), (0, 0.03, 0.28)), 72 * k), finishes.get("plastic", "caster"))
    thing.pole(leg, 0.028, 0.36, (0, 0.08, 0))
    thing.box(seat, 0.48, 0.09, 0.48, (0, 0.43, 0), bevel=0.035)
    thing.box(leg, 0.06, 0.3, 0.02, (0, 0.4, -0.25))
    thing.put(moved(rotated(bevelled_box(0.44, 0.52, 0.06, 0.025), -8, 0), (0, 0.6, -0.24)), seat)
    return thing


def sofa(dice, finishes, seats, use="sofa"):
    """0.75 m a seat, 0.9 m deep."""
    thing = Thing(use)
    cover = finishes.get("leather" if dice.chance(0.3) else "cloth", use)
    leg = finishes.get(dice.draw(of.LEGS), "sofa_leg")
    arm, foot = dice.uniform(0.1, 0.2), dice.uniform(0.06, 0.16)
    inside = 0.65 * seats + 0.1
    width = inside + 2 * arm
    thing.box(cover, width, 0.16, 0.82, (0, foot, 0), bevel=0.03)
    for k in range(seats):
        x = (k - (seats - 1) / 2) * inside / seats
        thing.box(cover, inside / seats - 0.01, 0.18, 0.62, (x, foot + 0.15, 0.08), bevel=0.05)
        back = moved(rotated(bevelled_box(inside / seats - 0.02, 0.44, 0.17, 0.06), -10, 0), (x, foot + 0.28, -0.24))
        thing.put(back, cover)
    for s in (-1, 1):
        thing.box(cover, arm, 0.56 - foot / 2, 0.86, (s * (width - arm) / 2, foot, 0), bevel=0.045)
    thing.box(cover, width - 0.02, 0.66, 0.16, (0, foot, -0.37), bevel=0.05)
    for x in (-1, 1):
        for z in (-1, 1):
            thing.pole(leg, 0.02, foot, (x * (width / 2 - 0.08), 0, z * 0.34))
    for _ in range(dice.whole(0, seats)):
        x, pillow = dice.uniform(-inside / 2 + 0.2, inside / 2 - 0.2), finishes.get("cloth",
                                                                                    f"pillow{dice.whole(0, 2)}")
        cushion = scaled(ball(1, 16), 0.22, 0.2, 0.07)
        thing.put(moved(rotated(cushion, -22, 0), (x, foot + 0.5, -0.06)), pillow)
    return thing, width


def bed(dice, finishes, width):
    """2.1 m long; its head is at -z."""
    thing = Thing("bed")
    frame, sheetc = finishes.get(dice.draw(of.FRONTS), "bed"), finishes.get("cloth", "mattress", "ceilings")
    blanket = finishes.get("cloth", "blanket")
    thing.box(frame, width + 0.08, 0.24, 2.08, (0, 0.1, 0), bevel=0.01)
    thing.box(frame, width + 0.08, dice.uniform(0.8, 1.15), 0.06, (0, 0, -1.05), bevel=0.015)
    for x in (-1, 1):
        thing.box(frame, 0.06, 0.1, 0.06, (x * width / 2, 0, 0.98))
    thing.box(sheetc, width - 0.02, 0.2, 2.0, (0, 0.32, 0), bevel=0.05)
    thing.box(blanket, width + 0.04, 0.17, 1.35, (0, 0.38, 0.33), bevel=0.05)
    for k in range(1 if width < 1.2 else 2):
        x = 0 if width < 1.2 else (k - 0.5) * width / 2
        thing.put(moved(scaled(ball(1, 18), 0.33, 0.09, 0.22), (x, 0.58, -0.72)), sheetc)
    return thing


def handle(thing, finish, width, at, upright=False):
    x, y, z = at
    a, b = ((x, y - width / 2, z), (x, y + width / 2, z)) if upright else ((x - width / 2, y, z), (x + width / 2, y, z))
    out = [(p[0], p[1], p[2] + 0.028) for p in (a, b)]
    thing.put(wire([a, out[0], out[1], b], 0.005), finish)


def cupboard(dice, finishes, use, width, height, depth, foot=0.08, top_kind=None):
    """With doors or drawers in front; its top is a top where it is below 1.2 m."""
    thing = Thing(f"{use}_cupboard")
    front, metal = finishes.get(dice.draw(of.FRONTS), f"{use}_front"), finishes.get("chrome", "handles")
    top = finishes.get(top_kind or dice.draw(of.TOPS), f"{use}_top") if height < 1.2 else front
    thick = 0.03
    thing.box(front, width - 0.01, height - foot - thick, depth - 0.03, (0, foot, -0.01))
    thing.box(top, width, thick, depth, (0, height - thick, 0))
    if foot > 0:
        base = finishes.get("plastic", "plinth")
        thing.box(base, width - 0.06, foot, depth - 0.1, (0, 0, -0.02))
    columns = max(1, round(width / dice.uniform(0.42, 0.62)))
    rows = dice.whole(1, 3) if height < 1.2 else 1
    cell, rise = width / columns, (height - foot - thick) / rows
    for i in range(columns):
        for j in range(rows):
            x, y = (i + 0.5) * cell - width / 2, foot + j * rise
            thing.box(front, cell - 0.006, rise - 0.006, 0.02, (x, y + 0.003, depth / 2 - 0.018), bevel=0.003)
            if rows > 1:
                handle(thing, metal, min(0.14, cell / 2), (x, y + rise - 0.05, depth / 2 - 0.004))
            else:
                side = cell / 2 - 0.05
                handle(thing, metal, 0.14, (x + (side if i % 2 == 0 else -side), min(y + rise * 0.7, 1.1),
                                            depth / 2 - 0.004),
                       upright=True)
    if height < 1.2:
        thing.tops.append((-width / 2 + 0.08, width / 2 - 0.08, -depth / 2 + 0.07, depth / 2 - 0.07, height))
    return thing


def shelf(dice, finishes, width, height):
    """Boards with books and vases."""
    thing = Thing("shelf")
    board = finishes.get(dice.draw(of.FRONTS), "shelf")
    depth, thick = 0.3, 0.022
    for x in (-1, 1):
        thing.box(board, thick, height, depth, (x * (width - thick) / 2, 0, 0))
    if dice.chance(0.6):
        thing.box(board, width - 2 * thick, height - 0.06, 0.008, (0, 0.05, -depth / 2 + 0.006), bevel=0.001)
    count = max(2, round(height / dice.uniform(0.3, 0.42)))
    step = (height - thick - 0.05) / count
    books = [finishes.get("satin_paint", f"book{k}") for k in range(6)]
    for level in range(count + 1):
        y = 0.05 + level * step
        thing.box(board, width - 2 * thick, thick, depth - 0.01, (0, y, 0))
        if level == count or dice.chance(0.15):
            continue
        x = -width / 2 + thick + 0.02
        while x < width / 2 - 0.12:
            if dice.chance(0.12):
                x += dice.uniform(0.05, 0.3)
                continue
            if dice.chance(0.06):
                radius = dice.uniform(0.04, 0.07)
                thing.put(decoration.vase_shape(dice, radius, min(0.22, step - 0.06)),
                          finishes.get("ceramic", f"vase{dice.whole(0, 2)}"),
                          (x + radius, y + thick, 0))
                x += 2 * radius + 0.03
                continue
            thickness, tall = dice.uniform(0.015, 0.05), min(step - 0.04, dice.uniform(0.18, 0.3))
            thing.box(dice.one_of(books), thickness, tall, dice.uniform(0.14, 0.22),
                      (x + thickness / 2, y + thick, 0.02),
                      bevel=0.002)
            x += thickness + 0.001
    return thing
