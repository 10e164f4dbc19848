"""What moves in a room, for 40 frames: a fan, a hanging lamp, a chair that turns, a cleaner or a ball on the floor."""
from ..gltf import tidy
from ..shapes import cosine, sine
from .camera import FRAMES, RATE
from .solids import ball, bevelled_box, moved, rotated, turned, wire
from .thing import Place, Thing

LAST = tidy((FRAMES - 1) / RATE)  # seconds


def add_motion(dice, room):
    """The first of a random order that finds its place."""
    for start in dice.shuffled([fan, swing, swivel, cleaner, rolling_ball]):
        if start(dice.about(start.__name__), room):
            return


def turns(model, place, axis, degrees):
    """Keys at equal distances in time; none turns by more than 170 degrees from the one before."""
    base = place.yaw / 2
    values = []
    for angle in degrees:
        s, c = sine(angle / 2), cosine(angle / 2)
        if axis == 1:
            values.append((0.0, sine(base + angle / 2), 0.0, cosine(base + angle / 2)))
        else:  # about the thing's own z, then about the vertical
            values.append((sine(base) * s, sine(base) * c, cosine(base) * s, cosine(base) * c))
    model.animate(place.node, "rotation", [tidy(LAST * k / (len(degrees) - 1)) for k in range(len(degrees))], values)


def fan(dice, room):
    """Of the ceiling; 60 to 150 turns a minute."""
    x, z, top = room.plan.width / 2, room.plan.depth / 2, room.plan.height
    if not room.layout.is_free((x - 0.65, top - 0.4, z - 0.65), (x + 0.65, top, z + 0.65), wall_margin=0.3):
        return False
    metal, wood = room.finishes.get("chrome", "fan"), room.finishes.get("wood", "fan")
    rod, rotor = Thing("fan_rod"), Thing("fan")
    rod.pole(metal, 0.015, 0.28, (0, -0.28, 0))
    rod.pole(metal, 0.06, 0.03, (0, -0.03, 0), sides=24)
    rotor.put(turned([(0, -0.06), (0.06, -0.05), (0.09, 0), (0.06, 0.05), (0, 0.06)], 24), metal)
    count = dice.whole(3, 5)
    for k in range(count):
        blade = rotated(bevelled_box(0.12, 0.008, 0.5, 0.003), 10, 2)
        rotor.put(rotated(moved(blade, (0, 0, 0.34)), 360 * k / count), wood)
    Place(rod, x, z, 0, top).add_to(room.model)
    place = Place(rotor, x, z, 0, top - 0.3)
    place.add_to(room.model)
    turn = dice.uniform(360, 900) * LAST * dice.one_of((-1, 1))
    turns(room.model, place, 1, [turn * k / 12 for k in range(13)])
    return True


def swing(dice, room):
    """A hanging lamp, once to and fro."""
    hanging = [place for place in room.layout.places if place.thing.name == "pendant"]
    if not hanging:
        return False
    angle = dice.uniform(3, 9)
    turns(room.model, dice.one_of(hanging), 2, [round(angle * sine(45 * k), 6) for k in range(9)])
    return True


def swivel(dice, room):
    """An office chair turns."""
    chairs = [place for place in room.layout.places if place.thing.name == "office_chair"]
    if not chairs:
        return False
    angle = dice.uniform(20, 90) * dice.one_of((-1, 1))
    turns(room.model, dice.one_of(chairs), 1, [0, angle])
    return True


def free_way(dice, room, half, height, length):
    """(start, end) on the floor, for something `half` wide to either side, that the camera sees or nearly so."""
    for _ in range(60):
        x, z = dice.uniform(0, room.plan.width), dice.uniform(0, room.plan.depth)
        dx, dz = (length, 0.0) if dice.chance(0.5) else (0.0, length)
        low = (min(x, x + dx) - half, 0.015, min(z, z + dz) - half)
        high = (max(x, x + dx) + half, height, max(z, z + dz) + half)
        ahead = [t - e for t, e in zip(room.view.target, room.view.eye)]
        before = (x + dx / 2 - room.view.eye[0]) * ahead[0] + (z + dz / 2 - room.view.eye[2]) * ahead[2]
        if before > 0 and room.layout.is_free(low, high) and not any(
                place.thing.name == "rug" and place.low[0] < high[0] and low[0] < place.high[0] and
                place.low[2] < high[2] and low[2] < place.high[2] for place in room.layout.flats):
            return ((x, z), (x + dx, z + dz)) if dice.chance(0.5) else ((x + dx, z + dz), (x, z))
    return None


def cleaner(dice, room):
    """A robot that cleans the floor at 0.3 m/s."""
    way = free_way(dice, room, 0.18, 0.1, 0.3 * LAST)
    if not way:
        return False
    thing = Thing("cleaner")
    thing.pole(room.finishes.get("plastic", "cleaner"), 0.17, 0.085, (0, 0.006, 0), sides=36, bevel=0.012)
    thing.pole(room.finishes.get("chrome", "cleaner"), 0.05, 0.012, (0, 0.091, 0), sides=28, bevel=0.004)
    slide(room, thing, way, 0.0)
    return True


def rolling_ball(dice, room):
    """At 0.6 m/s; it turns as it rolls."""
    radius = dice.uniform(0.06, 0.14)
    way = free_way(dice, room, radius, 2 * radius, 0.6 * LAST)
    if not way:
        return False
    thing = Thing("ball")
    thing.put(ball(radius, 28), room.finishes.get("plastic", "ball"))
    thing.put(wire([(1.001 * radius * cosine(15 * k), 1.001 * radius * sine(15 * k), 0) for k in range(25)],
                   0.006 * radius / 0.1),
              room.finishes.get("lacquer", "ball_stripe"))
    place = slide(room, thing, way, radius)
    (x0, z0), (x1, z1) = way
    degrees = 57.29578 * (abs(x1 - x0) + abs(z1 - z0)) / radius
    values = []
    for k in range(9):
        c, s = cosine(degrees * k / 16), sine(degrees * k / 16)
        values.append((s if z1 > z0 else -s if z1 < z0 else 0.0, 0.0, -s if x1 > x0 else s if x1 < x0 else 0.0, c))
    room.model.animate(place.node, "rotation", [tidy(LAST * k / 8) for k in range(9)], values)
    return True


def slide(room, thing, way, y):
    """Along a straight way on the floor, evenly; returns the place where it starts."""
    (x0, z0), (x1, z1) = way
    place = Place(thing, x0, z0, 0, y)
    place.add_to(room.model)
    room.model.animate(place.node, "translation", [0, LAST], [(x0, y, z0), (x1, y, z1)])
    return place
