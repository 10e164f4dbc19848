"""Tileable value noise, and PNG textures made of it. Arithmetic only, so that all bytes are the same everywhere."""
import math

from ..normal_texture import png


def lattice(seed, columns, rows):
    """Numbers in [0, 1), hashed from their place (the finaliser of splitmix64)."""
    def number(i):
        z = (seed * 0x9E3779B97F4A7C15 + i * 0xD1B54A32D192ED03) & 0xFFFFFFFFFFFFFFFF
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & 0xFFFFFFFFFFFFFFFF
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & 0xFFFFFFFFFFFFFFFF
        return (z ^ (z >> 31)) / 2.0 ** 64

    return [[number(j * columns + i) for i in range(columns)] for j in range(rows)]


def octave(seed, size, columns, rows):
    """size x size values in [0, 1) of a grid of columns x rows that repeats."""
    grid = lattice(seed, columns, rows)

    def places(count):
        found = []
        for k in range(size):
            position = (k + 0.5) * count / size
            cell = int(position)
            t = position - cell
            found.append((cell % count, (cell + 1) % count, t * t * (3 - 2 * t)))
        return found

    across = places(columns)
    image = []
    for a, b, t in places(rows):
        row = [p + (q - p) * t for p, q in zip(grid[a], grid[b])]
        image.append([row[i] + (row[j] - row[i]) * s for i, j, s in across])
    return image


def noise(seed, size, waves, octaves=3):
    """Octaves of half the amplitude each, from `waves` cells per side, or (along u, along v); values in [0, 1)."""
    across, down = waves if isinstance(waves, tuple) else (waves, waves)
    total, weight = None, 0.0
    for k in range(octaves):
        layer, amplitude = octave(seed + k, size, min(across << k, size), min(down << k, size)), 0.5 ** k
        weight += amplitude
        if total is None:
            total = layer
        else:
            total = [[p + amplitude * q for p, q in zip(a, b)] for a, b in zip(total, layer)]
    return [[value / weight for value in row] for row in total]


def grooves(size, columns, rows, width, is_staggered=False):
    """Height of joints of `width` texels between columns x rows plates, 0 at their bottom and 1 on plates, and the
    number of each texel's plate. Staggered: odd rows are shifted by half a plate."""
    def joints(count, shift):
        heights, plates = [], []
        for i in range(size):
            k = (i + shift) % size
            plate = k * count // size
            edge = min(k - plate * size / count + 0.5, (plate + 1) * size / count - k - 0.5)
            heights.append(min(1.0, edge / width))
            plates.append(plate)
        return heights, plates

    lines = [joints(columns, 0), joints(columns, size // columns // 2 if is_staggered else 0)]
    heights, plates = [], []
    for low, row in zip(*joints(rows, 0)):
        line, numbers = lines[row % 2]
        heights.append([h if h < low else low for h in line] if low < 1 else line)
        plates.append([row * columns + k for k in numbers])
    return heights, plates


def byte(value):
    return 0 if value <= 0 else 255 if value >= 1 else int(255 * value + 0.5)


LEVELS = 1024  # of a ramp of colours


def bytes_of(image, level):
    """Each value's `level`, one of LEVELS + 1 byte strings."""
    rows = []
    for row in image:
        rows += [b"\0", *[level[int(LEVELS * v) if 0 <= v <= 1 else LEVELS if v > 1 else 0] for v in row]]
    return png(len(image[0]), len(image), b"".join(rows), channels=len(level[0]))


def grey_png(image):
    """Of values in [0, 1]."""
    return bytes_of(image, [bytes((byte(k / LEVELS),)) for k in range(LEVELS + 1)])


def metal_png(image):
    """Roughness in green, metalness 1 in blue, as glTF has them."""
    return bytes_of(image, [bytes((0, byte(k / LEVELS), 255)) for k in range(LEVELS + 1)])


def ramp(stops, value):
    """The colour at `value` in [0, 1] between equally distant stops."""
    position = min(max(value, 0.0), 1.0) * (len(stops) - 1)
    k = min(int(position), len(stops) - 2)
    return mixed(stops[k], stops[k + 1], position - k)


def ramp_png(image, stops):
    """Linear colours of a ramp, written as sRGB (a square root is within 2 % of its curve, and exact everywhere)."""
    return bytes_of(image, [bytes(byte(math.sqrt(max(0.0, c))) for c in ramp(stops, k / LEVELS))
                            for k in range(LEVELS + 1)])


def normal_png(heights, slope):
    """Of heights in [0, 1]; `slope`: that of a step of 1 between neighbouring texels."""
    size = len(heights)
    rows = []
    for j, row in enumerate(heights):
        above, below = heights[j - 1], heights[(j + 1) % size]
        rows.append(b"\0")
        for left, right, up, down in zip(row[-1:] + row[:-1], row[1:] + row[:1], above, below):
            x = 0.5 * slope * (left - right)
            y = 0.5 * slope * (down - up)  # v points down, +Y of a normal map up
            scale = 127.5 / math.sqrt(x * x + y * y + 1)
            rows.append(bytes((int(128 + x * scale), int(128 + y * scale), int(128 + scale))))
    return png(size, size, b"".join(rows))


def mixed(a, b, t):
    return (a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t)
