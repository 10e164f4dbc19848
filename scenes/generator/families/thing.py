"""Things: parts in coordinates of their own, drawn as one node. A thing stands on y = 0; its back is at -z."""
from dataclasses import dataclass, field

from ..shapes import Shape, cosine, sine
from .solids import bevelled_box, moved, pole


@dataclass(frozen=True)
class Box:
    """The bounds of a part in the world, and its finish: what rules and estimates look at."""
    low: tuple
    high: tuple
    finish: object


@dataclass
class Thing:
    name: str
    pieces: dict = field(default_factory=dict)  # of each finish, the shapes
    tops: list = field(default_factory=list)  # (x_min, x_max, z_min, z_max, y): where small things stand

    def put(self, shape, finish, at=(0, 0, 0)):
        """Texture coordinates become those of the finish's maps."""
        uvs = [(u / finish.period, v / finish.period) for u, v in shape.uvs]
        placed = moved(shape, at)
        placed.uvs = uvs
        self.pieces.setdefault(finish, []).append(placed)

    def box(self, finish, width, height, depth, at=(0, 0, 0), bevel=0.004):
        """`at`: the middle of its underside."""
        self.put(bevelled_box(width, height, depth, bevel), finish, at)

    def pole(self, finish, radius, height, at=(0, 0, 0), sides=10, bevel=0.002):
        self.put(pole(radius, height, sides, bevel), finish, at)

    def bounds(self):
        """(low, high) of all parts."""
        points = [p for shapes in self.pieces.values() for shape in shapes for p in shape.positions]
        return tuple(map(min, zip(*points))), tuple(map(max, zip(*points)))

    def merged(self):
        """One shape, and the material of each of its parts."""
        positions, normals, uvs, parts = [], [], [], []
        for shapes in self.pieces.values():
            part = []
            for shape in shapes:
                part += [len(positions) + i for i in shape.parts[0]]
                positions += shape.positions
                normals += shape.normals
                uvs += shape.uvs
            parts.append(part)
        return Shape(positions, normals, parts, uvs), [finish.material for finish in self.pieces]


class Place:
    """Where a thing stands in the scene; `yaw` in degrees, counter-clockwise from above: 0 looks along +z."""

    def __init__(self, thing, x, z, yaw=0.0, y=0.0):
        self.thing, self.x, self.y, self.z, self.yaw = thing, x, y, z, yaw
        self.c, self.s = cosine(yaw), sine(yaw)
        self.node = None
        self.measure()

    def measure(self):
        """Again after the thing has got parts."""
        thing = self.thing
        self.boxes = [Box(*self.bounds_of(shape.positions), finish)
                      for finish, shapes in thing.pieces.items() for shape in shapes]
        self.low = tuple(min(box.low[k] for box in self.boxes) for k in range(3))
        self.high = tuple(max(box.high[k] for box in self.boxes) for k in range(3))

    def direction(self, v):
        return (self.c * v[0] + self.s * v[2], v[1], self.c * v[2] - self.s * v[0])

    def point(self, p):
        x, y, z = self.direction(p)
        return (x + self.x, y + self.y, z + self.z)

    def bounds_of(self, positions):
        low, high = tuple(map(min, zip(*positions))), tuple(map(max, zip(*positions)))
        corners = [self.point((x, y, z)) for x in (low[0], high[0]) for y in (low[1], high[1])
                   for z in (low[2], high[2])]
        return tuple(map(min, zip(*corners))), tuple(map(max, zip(*corners)))

    def add_to(self, model):
        shape, materials = self.thing.merged()
        turn = (0, sine(self.yaw / 2), 0, cosine(self.yaw / 2)) if self.yaw % 360 else None
        self.node = model.add(self.thing.name, shape, *materials, at=(self.x, self.y, self.z), rotation=turn)
