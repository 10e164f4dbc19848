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
    heights, plates = [], []
    for j in range(size):
        row = j * rows // size
        shift = size // columns // 2 if is_staggered and row % 2 else 0
        from_row = min(j - row * size / rows + 0.5, (row + 1) * size / rows - j - 0.5)
        line, numbers = [], []
        for i in range(size):
            k = (i + shift) % size
            column = k * columns // size
            from_column = min(k - column * size / columns + 0.5, (column + 1) * size / columns - k - 0.5)
            line.append(min(1.0, min(from_row, from_column) / width))
            numbers.append(row * columns + column)
        heights.append(line)
        plates.append(numbers)
    return heights, plates


def byte(value):
    return 0 if value <= 0 else 255 if value >= 1 else int(255 * value + 0.5)


def grey_png(image):
    """Of values in [0, 1]."""
    return png(len(image[0]), len(image), b"".join(b"\0" + bytes(map(byte, row)) for row in image), channels=1)


def metal_png(image):
    """Roughness in green, metalness 1 in blue, as glTF has them."""
    rows = (b"\0" + b"".join(bytes((0, byte(value), 255)) for value in row) for row in image)
    return png(len(image[0]), len(image), b"".join(rows))


def colour_png(image):
    """Of linear colours, written as sRGB (a square root is within 2 % of its curve, and exact everywhere)."""
    rows = (b"\0" + bytes(byte(math.sqrt(c)) for colour in row for c in colour) for row in image)
    return png(len(image[0]), len(image), b"".join(rows))


def normal_png(heights, slope):
    """Of heights in [0, 1]; `slope`: that of a step of 1 between neighbouring texels."""
    size = len(heights)
    rows = bytearray()
    for j, row in enumerate(heights):
        above, below = heights[j - 1], heights[(j + 1) % size]
        rows.append(0)
        for i in range(size):
            x = 0.5 * slope * (row[i - 1] - row[(i + 1) % size])
            y = 0.5 * slope * (below[i] - above[i])  # v points down, +Y of a normal map up
            scale = 127.5 / math.sqrt(x * x + y * y + 1)
            rows += bytes((int(127.5 + x * scale + 0.5), int(127.5 + y * scale + 0.5), int(127.5 + scale + 0.5)))
    return png(size, size, bytes(rows))


def mixed(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))
