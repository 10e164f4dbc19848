"""Normal maps in PNG: the ripples of normal_mapped, the bumps of rails."""
import math
import random
import struct
import zlib

from .shapes import normalized

TEXEL = 0.025  # m: 15 texels per shortest wave


def slopes(x, z, steepness):
    """Of the ripples at x, z (metres): the normal is along (-b, 1, -a)."""
    a = steepness * math.sin(2 * math.pi * z / 0.5 + 1.3 * math.sin(2 * math.pi * x / 1.7))
    b = 0.5 * steepness * math.sin(2 * math.pi * x / 0.37 + 3 * z)
    return a, b


def normal_texture(steepness):
    """Covers x from -4.5 to 4.5 (u) and z from -10 to 4 (v). Its tangent is +x, its bitangent -z."""
    width, height = round(9 / TEXEL), round(14 / TEXEL)
    rows = bytearray()
    for j in range(height):
        rows.append(0)  # PNG: this row is not filtered
        for i in range(width):
            a, b = slopes(-4.5 + (i + 0.5) * TEXEL, -10 + (j + 0.5) * TEXEL, steepness)
            rows += texel((-b, a, 1.0))
    return png(width, height, bytes(rows))


def bumps_texture(size, steepness):
    """`size` x `size` texels, each with slopes of its own of up to `steepness`; the same each time."""
    dice = random.Random(7)  # only random.random() is the same in all versions of Python
    rows = bytearray()
    for _ in range(size):
        rows.append(0)
        for _ in range(size):
            rows += texel((steepness * (2 * dice.random() - 1), steepness * (2 * dice.random() - 1), 1.0))
    return png(size, size, bytes(rows))


def texel(direction):
    """Its unit vector in 8 bits."""
    # Rounding to 1e-9 first keeps the last bits of the machine's sine out of the rounding to 8 bits.
    return bytes(math.floor(round(127.5 + 127.5 * c, 9) + 0.5) for c in normalized(direction))


def png(width, height, rows, channels=3):
    """8-bit RGB, or grey of one channel. Stored without compression, whose output would depend on the version of zlib."""
    blocks = [rows[i:i + 65535] for i in range(0, len(rows), 65535)]
    stream = b"\x78\x01"
    for i, block in enumerate(blocks):
        stream += struct.pack("<BHH", i == len(blocks) - 1, len(block), 65535 - len(block)) + block
    stream += struct.pack(">I", zlib.adler32(rows))
    header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", stream) + chunk(b"IEND", b"")


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
