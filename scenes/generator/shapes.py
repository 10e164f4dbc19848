"""Triangle meshes as plain lists: positions, unit normals, and one list of indices per material.

Front faces run counter-clockwise, as glTF wants. Sines and cosines are rounded to 1e-9, which hides the last bits in
which the math libraries of two machines differ; all else is +, -, *, / and sqrt, which IEEE 754 fixes.
"""
import math
import random
from dataclasses import dataclass, field
from functools import lru_cache


@dataclass
class Shape:
    positions: list  # (x, y, z) in metres
    normals: list
    parts: list  # one list of triangle indices per material
    uvs: list = field(default_factory=list)
    tangents: list = field(default_factory=list)  # (x, y, z, w)


@lru_cache(4096)
def cosine(degrees):
    return round(math.cos(math.radians(degrees)), 9)


@lru_cache(4096)
def sine(degrees):
    return round(math.sin(math.radians(degrees)), 9)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(v):
    length = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return (v[0] / length, v[1] / length, v[2] / length)


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def along(origin, *steps):
    """origin plus the sum of factor * vector over `steps`."""
    return tuple(origin[i] + sum(factor * vector[i] for factor, vector in steps) for i in range(3))


def rectangle(center, half_u, half_v):
    """Faces cross(half_u, half_v)."""
    corners = [along(center, (s, half_u), (t, half_v)) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return Shape(corners, [normalized(cross(half_u, half_v))] * 4, [[0, 1, 2, 0, 2, 3]])


def floor(x_min, x_max, z_min, z_max, y=0.0):
    center = ((x_min + x_max) / 2, y, (z_min + z_max) / 2)
    return rectangle(center, (0, 0, (z_max - z_min) / 2), ((x_max - x_min) / 2, 0, 0))


def checker(corner, step_u, step_v, columns, rows):
    """Cells of step_u x step_v, alternately of the first and the second material; they share their vertices, so no ray
    slips between them. Faces cross(step_u, step_v)."""
    positions = [along(corner, (i, step_u), (j, step_v)) for j in range(rows + 1) for i in range(columns + 1)]
    parts = [[], []]
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            d = a + columns + 1
            parts[(i + j) % 2] += [a, a + 1, d + 1, a, d + 1, d]
    return Shape(positions, [normalized(cross(step_u, step_v))] * len(positions), parts)


def random_cells(corner, step_u, step_v, columns, rows, kinds):
    """Cells as those of checker(), each of a material drawn from so many `kinds`; the same draw each time."""
    shape = checker(corner, step_u, step_v, columns, rows)
    cells = sorted((part[i:i + 6] for part in shape.parts for i in range(0, len(part), 6)), key=lambda cell: cell[0])
    # Only random.random() is the same in all versions of Python.
    dice = random.Random(7)
    shape.parts = [[] for _ in range(kinds)]
    for cell in cells:
        shape.parts[int(kinds * dice.random())] += cell
    return shape


def checker_wall(width, height, z, cell, y=0.0):
    """Upright, centred on x = 0, facing +z."""
    return checker((-width / 2, y, z), (cell, 0, 0), (0, cell, 0), round(width / cell), round(height / cell))


def unit_box():
    """From -1 to 1 along each axis."""
    shape = Shape([], [], [[]])
    for axis in range(3):
        for sign in (-1.0, 1.0):
            normal, half_u, half_v = [0.0] * 3, [0.0] * 3, [0.0] * 3
            normal[axis], half_u[(axis + 1) % 3], half_v[(axis + 2) % 3] = sign, sign, 1.0
            face = rectangle(normal, half_u, half_v)
            first = len(shape.positions)
            shape.positions += face.positions
            shape.normals += face.normals
            shape.parts[0] += [first + i for i in face.parts[0]]
    return shape


def tilted_disc(degrees, sides=64):
    """Radius 1 about the origin, flat, facing up but leaning towards +x by `degrees`."""
    c, s = cosine(degrees), sine(degrees)
    rim = [(c * cosine(360 * i / sides), -s * cosine(360 * i / sides), -sine(360 * i / sides)) for i in range(sides)]
    indices = [index for i in range(sides) for index in (0, 1 + i, 1 + (i + 1) % sides)]
    return Shape([(0.0, 0.0, 0.0)] + rim, [normalized((s, c, 0.0))] * (sides + 1), [indices])


def unit_pole(sides=16):
    """Radius 1 about +y, from y = 0 to 1; open at the foot, which stands on a floor."""
    ring = [(cosine(360 * i / sides), sine(360 * i / sides)) for i in range(sides)]
    positions = [(x, y, z) for y in (0.0, 1.0) for x, z in ring]
    normals = [(x, 0.0, z) for x, z in ring] * 2
    indices = []
    for a in range(sides):
        b = (a + 1) % sides
        indices += [a, a + sides, b + sides, a, b + sides, b]
    for i in range(1, sides - 1):
        indices += [2 * sides, 2 * sides + i + 1, 2 * sides + i]
    return Shape(positions + [(x, 1.0, z) for x, z in ring], normals + [(0.0, 1.0, 0.0)] * sides, [indices])


def unit_arc(degrees, sides, inward):
    """A wall along an arc of radius 1 about +y, its middle towards +z, from y = 0 to 1; it faces the axis where
    `inward`, else away from it."""
    angles = [degrees * (i / sides - 0.5) for i in range(sides + 1)]
    rim = [(sine(angle), cosine(angle)) for angle in angles]
    sign = -1.0 if inward else 1.0
    indices = []
    for a in range(sides):
        b, c, d = a + 1, a + sides + 2, a + sides + 1
        indices += [a, c, b, a, d, c] if inward else [a, b, c, a, c, d]
    positions = [(x, y, z) for y in (0.0, 1.0) for x, z in rim]
    return Shape(positions, [(sign * x, 0.0, sign * z) for x, z in rim] * 2, [indices])


def unit_disc(sides, up):
    """Radius 1 in the plane y = 0, facing +y where `up`, else -y."""
    rim = [(cosine(360 * i / sides), 0.0, -sine(360 * i / sides)) for i in range(sides)]
    turn = 1 if up else -1
    indices = [k for i in range(sides) for k in (0, *(1 + i, 1 + (i + 1) % sides)[::turn])]
    return Shape([(0.0, 0.0, 0.0)] + rim, [(0.0, float(turn), 0.0)] * (sides + 1), [indices])


def unit_sphere(rings, segments):
    """Radius 1, smooth normals: 2 * segments * (rings - 1) triangles."""
    positions = [(0.0, 1.0, 0.0)]
    for ring in range(1, rings):
        y, radius = cosine(180 * ring / rings), sine(180 * ring / rings)
        for segment in range(segments):
            angle = 360 * segment / segments
            positions.append((radius * cosine(angle), y, -radius * sine(angle)))
    positions.append((0.0, -1.0, 0.0))

    def vertex(ring, segment):
        return 1 + (ring - 1) * segments + segment % segments

    indices, bottom = [], len(positions) - 1
    for s in range(segments):
        indices += [0, vertex(1, s), vertex(1, s + 1)]
        for ring in range(1, rings - 1):
            a, b, c, d = vertex(ring, s), vertex(ring + 1, s), vertex(ring + 1, s + 1), vertex(ring, s + 1)
            indices += [a, b, c, a, c, d]
        indices += [vertex(rings - 1, s), bottom, vertex(rings - 1, s + 1)]
    return Shape(positions, positions, [indices])
