"""Where things stand: against walls, in the free middle, on tops; none in another."""
from .thing import Place


def overlaps(a, b, margin=0.0):
    return all(a[0][k] < b[1][k] + margin and b[0][k] < a[1][k] + margin for k in range(3))


class Layout:
    def __init__(self, dice, plan):
        self.dice, self.plan = dice, plan
        self.places = []
        self.flats = []  # rugs, on which other things stand
        self.kept_free = []  # boxes (low, high): before doors
        for wall in plan.walls:
            for left, right in wall.doors:
                self.kept_free.append(self.zone(wall, left, right, 0.9, 2.05))

    def zone(self, wall, left, right, deep, high, low=0.0):
        (x0, z0), (x1, z1) = wall.point(left, 0.0), wall.point(right, deep)
        return (min(x0, x1), low, min(z0, z1)), (max(x0, x1), high, max(z0, z1))

    def is_free(self, low, high, margin=0.02, wall_margin=-0.001, ignored=()):
        if low[1] < -0.01 or high[1] > self.plan.height + 0.001:
            return False
        if not self.plan.contains(low[0], high[0], low[2], high[2], wall_margin):
            return False
        box = (low, high)
        return not any(overlaps(box, zone) for zone in self.kept_free) and not any(
            overlaps(box, (place.low, place.high), margin) for place in self.places if place not in ignored)

    def add(self, place):
        self.places.append(place)
        return place

    def try_at(self, thing, x, z, yaw=0.0, y=0.0, ignored=()):
        """The place, or None where it is not free of others than the `ignored`."""
        place = Place(thing, x, z, yaw, y)
        return self.add(place) if self.is_free(place.low, place.high, ignored=ignored) else None

    def against_wall(self, thing, y=0.0, gap=0.005, front=0.5, walls=None, tries=30, covers_windows=False):
        """Its back to a wall, with `front` metres before it that are free now; (place, wall, along) or None. It does
        not stand before a window that it would cover, nor on the swing of a door."""
        low, high = thing.bounds()
        width, middle = high[0] - low[0], (high[0] + low[0]) / 2
        dice = self.dice.about(f"wall/{len(self.places)}/{thing.name}")
        walls = [wall for wall in walls or self.plan.walls if wall.length > width + 0.1]
        if not walls:
            return None
        for _ in range(tries):
            wall = dice.one_of([w for w in walls for _ in range(1 + int(w.length))])
            room = wall.length - width - 0.1
            # People line things up: a third stand in a corner, a third in the middle of the wall.
            where = dice.uniform()
            along = 0.05 + room * (0.0 if where < 0.16 else 1.0 if where < 0.33 else 0.5
                                   if where < 0.66 else dice.uniform())
            left, right = along, along + width
            if not covers_windows and any(w.left < right and left < w.right and w.sill < y + high[1]
                                          and y + low[1] < w.head
                                          for w in wall.windows):
                continue
            if any(a - 0.05 < right and left < b + 0.05 for a, b in wall.doors) and y + low[1] < 2.1:
                continue
            x, z = wall.point(along + width / 2 - middle, gap - low[2])
            place = Place(thing, x, z, wall.yaw, y)
            if not self.is_free(place.low, place.high):
                continue
            before = self.zone(wall, left, right, gap + high[2] - low[2] + front, min(y + high[1], 1.0), y + 0.05)
            if front and any(overlaps(before, (other.low, other.high)) for other in self.places):
                continue
            return self.add(place), wall, along + width / 2
        return None

    def beside(self, wall, along, thing, side, distance, y=0.0, gap=0.005):
        """Against the same wall, its middle `distance` to the right (side 1) or left (-1)."""
        low, _ = thing.bounds()
        if not 0 < along + side * distance < wall.length:
            return None
        x, z = wall.point(along + side * distance, gap - low[2])
        place = Place(thing, x, z, wall.yaw, y)
        if any(w.left < along + side * distance < w.right and w.sill < place.high[1] for w in wall.windows):
            return None
        return self.add(place) if self.is_free(place.low, place.high) else None

    def in_the_middle(self, width, depth, height, tries=40):
        """(x, z, yaw) of a free rectangle, nearer to the middle the earlier it is tried; or None."""
        dice = self.dice.about(f"middle/{len(self.places)}")
        for k in range(tries):
            spread = 0.15 + 0.85 * k / tries
            yaw = 0 if (self.plan.width > self.plan.depth) != (dice.uniform() < 0.15 + 0.5 * k / tries) else 90
            w, d = (width, depth) if yaw == 0 else (depth, width)
            x = self.plan.width * (0.5 + spread * dice.uniform(-0.5, 0.5))
            z = self.plan.depth * (0.5 + spread * dice.uniform(-0.5, 0.5))
            low, high = (x - w / 2, 0.02, z - d / 2), (x + w / 2, height, z + d / 2)
            if self.is_free(low, high, 0.1, 0.25):
                return x, z, yaw
        return None

    def on_tops(self, make, density, limit):
        """Puts make(dice, space) on the tops of all places, about `density` per m^2."""
        count = 0
        for number, place in enumerate(list(self.places)):
            for k, (x0, x1, z0, z1, y) in enumerate(place.thing.tops):
                dice = self.dice.about(f"top/{number}/{k}")
                wanted = density * (x1 - x0) * (z1 - z0)
                for _ in range(int(wanted) + dice.chance(wanted - int(wanted))):
                    if count >= limit:
                        return
                    thing = make(dice, min(x1 - x0, z1 - z0, 0.3))
                    low, high = thing.bounds()
                    if x1 - x0 < high[0] - low[0] or z1 - z0 < high[2] - low[2]:
                        continue
                    for _ in range(6):
                        x, _, z = place.direction((dice.uniform(x0 - low[0], x1 - high[0]), 0,
                                                   dice.uniform(z0 - low[2], z1 - high[2])))
                        at = Place(thing, place.x + x, place.z + z, place.yaw, place.y + y)
                        top = (at.low[0], at.low[1] + 0.002, at.low[2])
                        others = [other for other in self.places if other is not place]
                        if not any(overlaps((top, at.high), (o.low, o.high), 0.005) for o in others):
                            if not any(overlaps((top, at.high), (box.low, box.high)) for box in place.boxes):
                                self.add(at)
                                count += 1
                                break
