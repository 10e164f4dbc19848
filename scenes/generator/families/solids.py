"""Parts of furniture, in metres: bevelled boxes, turned and bent parts, leaves, sheets. All have texture coordinates in
metres; front faces run counter-clockwise."""
from ..shapes import Shape, cosine, cross, minus, normalized, sine


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _box_corners():
    """Of a bevelled box: (axis, signs) of each vertex, which lies on the face of that axis; the triangles."""
    corners = [(axis, tuple(1 if corner >> k & 1 else -1 for k in range(3))) for axis in range(3)
               for corner in range(8)]
    index = {key: i for i, key in enumerate(corners)}
    triangles = []

    def add(*keys):
        points = [[s * (1.0 if k == axis else 0.8) for k, s in enumerate(signs)] for axis, signs in keys]
        for k in range(1, len(keys) - 1):
            side = cross(minus(points[k], points[0]), minus(points[k + 1], points[0]))
            order = (0, k, k + 1) if dot(side, points[0]) > 0 else (0, k + 1, k)
            triangles.extend(index[keys[i]] for i in order)

    def signs_of(known):
        return tuple(known[k] for k in range(3))

    for axis in range(3):
        p, q = (axis + 1) % 3, (axis + 2) % 3
        for s in (-1, 1):
            add(*((axis, signs_of({axis: s, p: a, q: b})) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))))
            for t in (-1, 1):  # the edge between faces `axis` and p, along q
                ends = [signs_of({axis: s, p: t, q: end}) for end in (-1, 1)]
                add((axis, ends[0]), (axis, ends[1]), (p, ends[1]), (p, ends[0]))
    for corner in range(8):
        signs = tuple(1 if corner >> k & 1 else -1 for k in range(3))
        add(*((axis, signs) for axis in range(3)))
    return corners, triangles


BOX_CORNERS, BOX_TRIANGLES = _box_corners()
BOX_NORMALS = [tuple(float(signs[axis]) if k == axis else 0.0 for k in range(3)) for axis, signs in BOX_CORNERS]


def bevelled_box(width, height, depth, bevel):
    """Stands on y = 0, centred on x = z = 0. Faces are flat; the normals of bevels turn from one to the next."""
    x, y, z = width / 2, height / 2, depth / 2
    bevel = min(bevel, 0.45 * min(x, y, z))
    positions, uvs = [], []
    for axis, (a, b, c) in BOX_CORNERS:
        point = (a * (x if axis == 0 else x - bevel), y + b * (y if axis == 1 else y - bevel),
                 c * (z if axis == 2 else z - bevel))
        positions.append(point)
        uvs.append((point[2], point[1]) if axis == 0 else (point[0], point[2]) if axis == 1 else (point[0], point[1]))
    return Shape(positions, BOX_NORMALS, [BOX_TRIANGLES], uvs)


def turned(profile, sides=16):
    """The profile (radius, y) about +y, from its foot up with the outside to the right. Corners below 45 degrees are
    smooth."""
    slopes = []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        slopes.append(normalized((y1 - y0, r0 - r1, 0)))
    positions, normals, uvs, indices = [], [], [], []
    along = 0.0
    for k, ((r0, y0), (r1, y1)) in enumerate(zip(profile, profile[1:])):
        def smooth(other):
            if not 0 <= other < len(slopes) or dot(slopes[k], slopes[other]) < 0.7:
                return slopes[k]
            return normalized([a + b for a, b in zip(slopes[k], slopes[other])])

        ends = ((r0, y0, smooth(k - 1), along), (r1, y1, smooth(k + 1), along + abs(y1 - y0) + abs(r1 - r0)))
        along = ends[1][3]
        first = len(positions)
        for r, y, n, v in ends:
            for i in range(sides + 1):
                c, s = cosine(360 * i / sides), sine(360 * i / sides)
                positions.append((r * c, y, -r * s))
                normals.append((n[0] * c, n[1], -n[0] * s))
                uvs.append((6.28 * max(r0, r1) * i / sides, v))
        for i in range(sides):
            a, b, c, d = first + i, first + i + 1, first + sides + 2 + i, first + sides + 1 + i
            if r0 > 0:
                indices += [a, b, c]
            if r1 > 0:
                indices += [a, c, d]
    return Shape(positions, normals, [indices], uvs)


def pole(radius, height, sides=10, bevel=0.0):
    """From y = 0; closed."""
    bevel = min(bevel, radius / 2)
    rim = [(radius, bevel), (radius, height - bevel)] if bevel else [(radius, 0), (radius, height)]
    feet = [(0, 0), (radius - bevel, 0)] if bevel else [(0, 0)]
    tops = [(radius - bevel, height), (0, height)] if bevel else [(0, height)]
    return turned(feet + rim + tops, sides)


def ball(radius, sides=16):
    """Centred on the origin."""
    return turned([(radius * cosine(a), radius * sine(a)) for a in
                   (-90 + 180 * i / (sides // 2) for i in range(sides // 2 + 1))], sides)


def smooth_grid(rows, closed=False):
    """A surface through rows of points, seen from where columns run to the right and rows up; normals of the average of
    the facets. `closed`: the last column meets the first."""
    count = len(rows[0])
    columns = count if closed else count - 1
    sums = [[0.0, 0.0, 0.0] for _ in range(len(rows) * count)]
    flat = [point for row in rows for point in row]
    indices = []
    for j in range(len(rows) - 1):
        for i in range(columns):
            a, b = j * count + i, j * count + (i + 1) % count
            c, d = b + count, a + count
            for triangle in ((a, b, c), (a, c, d)):
                p, q, r = (flat[k] for k in triangle)
                facet = cross(minus(q, p), minus(r, p))
                if dot(facet, facet) < 1e-18:
                    continue
                indices += triangle
                for k in triangle:
                    sums[k] = [s + f for s, f in zip(sums[k], facet)]
    normals = [normalized(s) if dot(s, s) > 0 else (0.0, 1.0, 0.0) for s in sums]
    uvs = [(flat[k][0] + flat[k][2], flat[k][1]) for k in range(len(flat))]
    return Shape(flat, normals, [indices], uvs)


def wire(points, radius, sides=6):
    """A tube through the points; its ends are open."""
    rows = []
    for k, point in enumerate(points):
        ahead = minus(points[min(k + 1, len(points) - 1)], points[max(k - 1, 0)])
        axis = normalized(ahead)
        helper = (0.0, 1.0, 0.0) if abs(axis[1]) < 0.8 else (1.0, 0.0, 0.0)
        u = normalized(cross(helper, axis))
        v = cross(axis, u)
        rows.append([tuple(point[m] + radius * (cosine(360 * i / sides) * u[m] + sine(360 * i / sides) * v[m])
                           for m in range(3)) for i in range(sides)])
    return smooth_grid(rows, closed=True)


def leaf(length, width, rise, droop, steps=5):
    """From the origin along +z: it rises by `rise` of its length and droops by `droop`."""
    rows = []
    for k in range(steps + 1):
        t = k / steps
        half = width * (0.12 + 3.2 * t * (1 - t) * (1 - 0.45 * t)) / 2 if k < steps else 0.002
        y = length * (rise * t - droop * t * t)
        rows.append([(half * s, y + 0.25 * half * abs(s), -length * t * (1 - 0.15 * droop * t)) for s in (-1, 0, 1)])
    return rotated(smooth_grid(rows), 180)


def sheet(width, height, waves, depth):
    """A hanging cloth from y = 0 up, centred on x = 0, with so many folds of `depth`."""
    steps = 8 * waves
    rows = []
    for y in (0.0, height / 2, height):
        rows.append([(width * (i / steps - 0.5), y, depth * sine(45 * i)) for i in range(steps + 1)])
    return smooth_grid(rows)


def moved(shape, by):
    return Shape([(x + by[0], y + by[1], z + by[2]) for x, y, z in shape.positions], shape.normals, shape.parts,
                 shape.uvs)


def rotated(shape, degrees, axis=1):
    """About x, y or z (axis 0, 1, 2), counter-clockwise seen from its tip."""
    c, s = cosine(degrees), sine(degrees)
    p, q = (axis + 1) % 3, (axis + 2) % 3

    def turn(v):
        w = list(v)
        w[p], w[q] = c * v[p] - s * v[q], s * v[p] + c * v[q]
        return tuple(w)

    return Shape([turn(v) for v in shape.positions], [turn(v) for v in shape.normals], shape.parts, shape.uvs)


def scaled(shape, x, y, z):
    """Normals as of a surface that is stretched."""
    return Shape([(a * x, b * y, c * z) for a, b, c in shape.positions],
                 [normalized((a / x, b / y, c / z)) for a, b, c in shape.normals], shape.parts, shape.uvs)
