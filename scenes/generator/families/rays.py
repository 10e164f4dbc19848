"""Rays among the bounds of parts: enough to see what a camera looks at, and cheap."""
from .finishes import Finish


def slab(low, high, origin, inverse):
    """(distance, axis) where a ray enters a box, or None; (0, axis) from inside."""
    near, far, axis = 0.0, 1e30, 1
    for k in range(3):
        a, b = (low[k] - origin[k]) * inverse[k], (high[k] - origin[k]) * inverse[k]
        if a > b:
            a, b = b, a
        if a > near:
            near, axis = a, k
        if b < far:
            far = b
        if near > far:
            return None
    return near, axis


def inverse_of(direction):
    return tuple(1 / c if abs(c) > 1e-9 else 1e9 for c in direction)


class Hit:
    __slots__ = ("distance", "finish", "axis", "place")

    def __init__(self, distance, finish, axis, place=None):
        self.distance, self.finish, self.axis, self.place = distance, finish, axis, place


SKY = Finish(-1, (0.0, 0.0, 0.0), 1.0)


def hit_places(places, origin, direction, farthest=1e30):
    inverse, best = inverse_of(direction), None
    for place in places:
        bound = slab(place.low, place.high, origin, inverse)
        if bound is None or bound[0] >= farthest:
            continue
        for box in place.boxes:
            found = slab(box.low, box.high, origin, inverse)
            if found and 0 < found[0] < farthest:
                farthest = found[0]
                best = Hit(found[0], box.finish, found[1], place)
    return best


def hit_shell(plan, finishes, origin, direction):
    """Of a ray from inside the plan: floor, ceiling, a wall or, through a window, the sky. `finishes`: (floor, ceiling,
    walls)."""
    inverse = inverse_of(direction)
    bounds = (plan.width, plan.height, plan.depth)
    distances = [((bounds[k] if direction[k] > 0 else 0.0) - origin[k]) * inverse[k]
                 if abs(direction[k]) > 1e-9 else 1e30
                 for k in range(3)]
    distance = min(distances)
    axis = distances.index(distance)
    if plan.notch:
        x0, x1, z0, z1 = plan.notch
        corner = slab((x0, -1.0, z0), (x1, plan.height + 1, z1), origin, inverse)
        if corner and 0 < corner[0] < distance:
            distance, axis = corner
    floor, ceiling, walls = finishes
    if axis == 1:
        return Hit(distance, floor if direction[1] < 0 else ceiling, 1)
    x, y, z = (origin[k] + distance * direction[k] for k in range(3))
    for wall, finish in zip(plan.walls, walls):
        n = wall.inward
        if (axis == 0) != (n[0] != 0) or n[0] * direction[0] + n[1] * direction[2] >= 0:
            continue
        out = (x - wall.start[0]) * n[0] + (z - wall.start[1]) * n[1]
        along = (x - wall.start[0]) * n[1] - (z - wall.start[1]) * n[0]
        if abs(out) > 1e-6 or not -1e-6 <= along <= wall.length + 1e-6:
            continue
        if any(w.left < along < w.right and w.sill < y < w.head for w in wall.windows):
            return Hit(distance, SKY, axis)
        return Hit(distance, finish, axis)
    return None
