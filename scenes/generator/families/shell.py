"""The room itself: plan, walls with windows, floor, ceiling, doors, and what is outside.

Closed but for the windows: walls reach 5 cm beyond floor, ceiling and outer corners, and have reveals 0.25 m deep.
"""
from dataclasses import dataclass, field

from ..shapes import Shape
from . import densities as of
from .solids import wire
from .thing import Place, Thing

BEYOND = 0.05  # m by which surfaces overlap, so that no ray slips through where they meet
REVEAL = 0.25  # m


@dataclass
class Window:
    left: float  # m along the wall
    right: float
    sill: float
    head: float


@dataclass
class Wall:
    """From `start`, `length` metres to the right as seen from inside; `inward`: (x, z)."""
    start: tuple
    length: float
    inward: tuple
    is_outer: bool
    before_convex: bool = True  # its left corner
    after_convex: bool = True
    windows: list = field(default_factory=list)
    doors: list = field(default_factory=list)  # (left, right)

    @property
    def yaw(self):
        return {(0, 1): 0, (1, 0): 90, (0, -1): 180, (-1, 0): 270}[self.inward]

    def point(self, along, out=0.0):
        """(x, z); `out`: metres from the wall into the room."""
        n = self.inward
        return (self.start[0] + n[1] * along + n[0] * out, self.start[1] - n[0] * along + n[1] * out)


def exact(metres):
    return round(64 * metres) / 64


class Plan:
    """x from 0 to `width`, z from 0 to `depth`, less `notch` (x_min, x_max, z_min, z_max) in a corner, or None."""

    def __init__(self, dice, scale=1.0):
        # Multiples of 1/64 m add up exactly, so that walls share their corners.
        side = exact(scale * dice.draw(of.AREA_SIDE))
        other = exact(side * dice.draw(of.SIDE_RATIO))
        self.width, self.depth = (side, other) if dice.chance(0.5) else (other, side)
        self.height = exact(dice.draw(of.HEIGHT))
        self.notch = None
        w, d = self.width, self.depth
        corners = [(0.0, 0.0), (w, 0.0), (w, d), (0.0, d)]
        if scale == 1 and dice.chance(of.IS_L):
            a, b, corner = exact(w * dice.draw(of.NOTCH)), exact(d * dice.draw(of.NOTCH)), dice.whole(0, 3)
            corners[corner:corner + 1] = [[(0.0, b), (a, b), (a, 0.0)], [(w - a, 0.0), (w - a, b), (w, b)],
                                          [(w, d - b), (w - a, d - b), (w - a, d)],
                                          [(a, d), (a, d - b), (0.0, d - b)]][corner]
            right, far = corner in (1, 2), corner in (2, 3)
            self.notch = (w - a if right else 0.0, w if right else a, d - b if far else 0.0, d if far else b)
        self.walls = self.walls_of(corners)
        self.area = w * d - (self.notch_area() if self.notch else 0.0)

    def notch_area(self):
        return (self.notch[1] - self.notch[0]) * (self.notch[3] - self.notch[2])

    def walls_of(self, corners):
        walls, count = [], len(corners)
        for k in range(count):
            (x0, z0), (x1, z1) = corners[k], corners[(k + 1) % count]
            length = abs(x1 - x0) + abs(z1 - z0)
            step = ((x1 - x0) / length, (z1 - z0) / length)
            inward = (int(round(-step[1])), int(round(step[0])))
            on_rim = (x0 == x1 and x0 in (0.0, self.width)) or (z0 == z1 and z0 in (0.0, self.depth))
            walls.append(Wall((x0, z0), length, inward, on_rim))
        for k, wall in enumerate(walls):
            # A corner is convex where the next wall faces back.
            after, step = walls[(k + 1) % count], (wall.inward[1], -wall.inward[0])
            wall.after_convex = after.inward[0] * step[0] + after.inward[1] * step[1] < 0
            walls[(k + 1) % count].before_convex = wall.after_convex
        return walls

    def contains(self, x0, x1, z0, z1, margin=0.0):
        """Whether the rectangle lies inside, `margin` from all walls."""
        if x0 < margin or z0 < margin or x1 > self.width - margin or z1 > self.depth - margin:
            return False
        return not self.notch or not (x1 > self.notch[0] - margin and x0 < self.notch[1] + margin and
                                      z1 > self.notch[2] - margin and z0 < self.notch[3] + margin)

    def floors(self):
        """Rectangles (x_min, x_max, z_min, z_max) that cover the plan and reach below its walls."""
        low, right, far = -BEYOND, self.width + BEYOND, self.depth + BEYOND
        if not self.notch:
            return [(low, right, low, far)]
        x0, x1, z0, z1 = self.notch
        at_left, at_front = x0 == 0.0, z0 == 0.0
        cut = x1 if at_left else x0
        deep = (cut, right) if at_left else (low, cut)
        short = (low, cut) if at_left else (cut, right)
        rest = (z1 - BEYOND, far) if at_front else (low, z0 + BEYOND)
        # The full rectangle ends 5 cm below the notch's wall; the other begins there.
        shift = -BEYOND if at_left else BEYOND
        deep = (deep[0] + shift, deep[1]) if at_left else (deep[0], deep[1] + shift)
        short = (short[0], short[1] + shift) if at_left else (short[0] + shift, short[1])
        return [(*deep, low, far), (*short, *rest)]


def add_openings(dice, plan):
    """Windows of the stated share of the floor, and doors, to the plan's walls."""
    outer = [wall for wall in dice.shuffled(plan.walls) if wall.is_outer and wall.length > 1.8]
    wanted = plan.area * dice.draw(of.WINDOW_SHARE)
    outer = outer[:1 if dice.chance(0.55) else 2]
    for wall in outer:
        head = min(plan.height - 0.2, dice.uniform(2.1, 2.5))
        sill = 0.06 if dice.chance(of.FLOOR_WINDOW) else dice.uniform(0.8, 1.0)
        total = min(wanted / len(outer) / (head - sill), wall.length - 0.9)
        if total < 0.5:
            continue
        count = max(1, round(total / dice.uniform(1.0, 2.0)))
        width, gap = total / count, (wall.length - total) / (count + 1)
        for k in range(count):
            left = gap + k * (width + gap)
            wall.windows.append(Window(left, left + width, sill, head))
    inner = [wall for wall in dice.shuffled(plan.walls) if not wall.windows and wall.length > 1.5]
    for wall in inner[:int(dice.draw(of.DOORS))]:
        left = 0.25 if dice.chance(0.5) else wall.length - 0.25 - 0.9
        wall.doors.append((left, left + 0.9))


def panel(corners, uvs):
    """A quadrilateral; seen from where its corners run counter-clockwise."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners[:3]
    u, v = (bx - ax, by - ay, bz - az), (cx - ax, cy - ay, cz - az)
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = max(map(abs, n))  # all are along an axis
    return Shape(list(corners), [tuple(c / length for c in n)] * 4, [[0, 1, 2, 0, 2, 3]], list(uvs))


def wall_panels(plan, wall):
    """What of the wall is not window, and the reveals."""
    left, right = -BEYOND * wall.before_convex, wall.length + BEYOND * wall.after_convex
    along = sorted({left, right, *(w.left for w in wall.windows), *(w.right for w in wall.windows)})
    up = sorted({-BEYOND, plan.height + BEYOND, *(w.sill for w in wall.windows), *(w.head for w in wall.windows)})

    def at(t, y, out=0.0):
        x, z = wall.point(t, out)
        return (x, y, z)

    for a, b in zip(along, along[1:]):
        for low, high in zip(up, up[1:]):
            if any(w.left <= a and b <= w.right and w.sill <= low and high <= w.head for w in wall.windows):
                continue
            yield panel([at(a, low), at(b, low), at(b, high), at(a, high)], [(a, low), (b, low), (b, high), (a, high)])
    for w in wall.windows:
        rim = [(w.left, w.sill), (w.right, w.sill), (w.right, w.head), (w.left, w.head)]
        for k in range(4):
            (t0, y0), (t1, y1) = rim[k], rim[(k + 1) % 4]
            length = abs(t1 - t0) + abs(y1 - y0)
            yield panel([at(t0, y0), at(t0, y0, -REVEAL), at(t1, y1, -REVEAL), at(t1, y1)][::-1],
                        [(0, 0), (REVEAL, 0), (REVEAL, length), (0, length)][::-1])


def surfaces(plan, floor, ceiling, wall_finishes):
    """Floor, ceiling and one thing per wall, in world coordinates."""
    ground, roof = Thing("floor"), Thing("ceiling")
    for x0, x1, z0, z1 in plan.floors():
        corners = [(x0, z1), (x1, z1), (x1, z0), (x0, z0)]
        ground.put(panel([(x, 0.0, z) for x, z in corners], corners), floor)
        corners = corners[::-1]
        roof.put(panel([(x, plan.height, z) for x, z in corners], corners), ceiling)
    walls = []
    for k, (wall, finish) in enumerate(zip(plan.walls, wall_finishes)):
        thing = Thing(f"wall{k}")
        for piece in wall_panels(plan, wall):
            thing.put(piece, finish)
        walls.append(thing)
    return [ground, roof, *walls]


def joinery(dice, plan, finishes):
    """Places of window frames, sills, doors and skirting."""
    frame, sill = finishes.get("satin_paint", "joinery", "ceilings"), finishes.get(dice.draw(of.TOPS), "sills")
    metal, places = finishes.get("chrome", "handles"), []
    leaf = finishes.get("lacquer" if dice.chance(0.5) else "wood", "doors")
    skirt, tall = finishes.get("satin_paint", "skirting", "ceilings"), dice.uniform(0.05, 0.11)
    mullion = dice.uniform(0.6, 1.1)
    has_bar = dice.chance(0.35)
    for wall in plan.walls:
        for w in wall.windows:
            width, height = w.right - w.left, w.head - w.sill
            thing = Thing("window")
            for x in (-1, 1):
                thing.box(frame, 0.06, height, 0.05, (x * (width / 2 - 0.03), w.sill, -0.17))
            for y in (w.sill, w.head - 0.06):
                thing.box(frame, width - 0.12, 0.06, 0.05, (0, y, -0.17))
            leaves = max(1, round(width / mullion))
            for k in range(1, leaves):
                thing.box(frame, 0.07, height - 0.12, 0.045, (k * width / leaves - width / 2, w.sill + 0.06, -0.17))
            if has_bar:
                thing.box(frame, width - 0.12, 0.03, 0.03, (0, w.sill + 0.62 * height, -0.17))
            if w.sill > 0.3:
                thing.box(sill, width + 0.1, 0.025, 0.16, (0, w.sill - 0.012, -0.04), bevel=0.006)
            x, z = wall.point((w.left + w.right) / 2)
            places.append(Place(thing, x, z, wall.yaw))
        for left, right in wall.doors:
            thing = Thing("door")
            width = right - left
            thing.box(leaf, width - 0.1, 1.99, 0.03, (0, 0.006, 0.015))
            for x in (-1, 1):
                thing.box(frame, 0.07, 2.0, 0.05, (x * (width - 0.07) / 2, 0, 0.025))
            thing.box(frame, width, 0.07, 0.05, (0, 2.0, 0.025))
            for y in (0.25, 1.15):
                thing.box(leaf, width - 0.42, 0.62, 0.012, (0, y, 0.035), bevel=0.006)
            side = width / 2 - 0.13
            thing.put(wire([(side, 1.03, 0.03), (side, 1.03, 0.075), (side - 0.02, 1.03, 0.085),
                            (side - 0.12, 1.03, 0.085)],
                           0.008, 8), metal)
            thing.box(metal, 0.035, 0.2, 0.006, (side, 0.93, 0.032), bevel=0.002)
            x, z = wall.point((left + right) / 2)
            places.append(Place(thing, x, z, wall.yaw))
        gaps = sorted([(w.left, w.right) for w in wall.windows if w.sill < tall + 0.02] + wall.doors)
        start = 0.0
        for left, right in [*gaps, (wall.length, wall.length)]:
            if left - start > 0.05:
                thing = Thing("skirting")
                thing.box(skirt, left - start, tall, 0.014, (0, 0, 0.007), bevel=0.003)
                x, z = wall.point((start + left) / 2)
                places.append(Place(thing, x, z, wall.yaw))
            start = right
    return places


def outside(dice, plan, finishes, storey):
    """Ground below, and houses opposite."""
    thing = Thing("outside")
    ground = finishes.plain("outside_ground", (0.16, 0.19, 0.1), 0.95)
    far, y = 90.0, -storey
    corners = [(-far, far), (far, far), (far, -far), (-far, -far)]
    thing.put(panel([(x, y, z) for x, z in corners], corners), ground)
    for wall in plan.walls:
        if not wall.windows:
            continue
        for k in range(dice.whole(1, 4)):
            house = finishes.plain(f"outside_house{k}", tuple(dice.uniform(0.15, 0.6) for _ in range(3)), 0.9)
            x, z = wall.point(wall.length / 2 + dice.uniform(-18, 18), -dice.uniform(14, 40))
            thing.box(house, dice.uniform(6, 14), dice.uniform(3, 11), dice.uniform(6, 12), (x, y, z), bevel=0.05)
    return thing
