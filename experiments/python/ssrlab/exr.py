"""Reads the OpenEXR files that ssrlab writes: single-part scan lines, ZIP-compressed or not, half or float.

Debian 12 has no Python binding of OpenEXR. Format: "OpenEXR File Layout", openexr.com.
"""

import os
import stat
import struct
import zlib

import numpy as np

from ssrlab import memory
from ssrlab.mistakes import counted

ROWS_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # no compression, ZIPS, ZIP
LONG_NAMES = 0x400  # of layers and attributes: changes nothing of the layout
TYPES = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}


class ExrError(Exception):
    """A file is missing or cannot be read here: one sentence."""


def read_exr_rgb(path, layer=""):
    """The channels R, G, B, of `layer` if one is named, as float32 of shape (height, width, 3)."""
    planes = read_exr_planes(path)
    try:
        return np.stack([planes[f"{layer}.{c}" if layer else c] for c in "RGB"], axis=-1)
    except KeyError as e:
        raise ExrError(f"{path} lacks the channel {e}") from e


def read_exr_planes(path):
    """All channels by name, each float32 of shape (height, width). Fails with ExrError if they exceed the limit of memory."""
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise ExrError(f"cannot read {path}: it is not a regular file")
        _need(os.path.getsize(path), path)
        with open(path, "rb") as file:
            return _decode(file.read(), path)
    except OSError as e:
        raise ExrError(f"cannot read {path}: {e.strerror}") from e
    except (struct.error, zlib.error, KeyError, IndexError, ValueError) as e:
        raise ExrError(f"cannot read {path} as OpenEXR: it is truncated or of another kind ({e})") from e


def _need(size, path):
    """Fails before a file takes more memory than the limit."""
    if size > memory.limit():
        raise ExrError(f"{path} needs {size:.3g} bytes of memory, but files may take {memory.limit():.3g}; if it is what you expect, allow more with --max-memory")


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("latin-1"), end + 1


def _header(data):
    magic, version = struct.unpack_from("<II", data, 0)
    if magic != 20000630 or version & ~(0xFF | LONG_NAMES):
        raise ValueError("not a single-part scan-line file")
    attributes, at = {}, 8
    while data[at] != 0:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channels(attribute):
    """Name and number type of each channel, in the order of the file."""
    channels, at = [], 0
    while attribute[at] != 0:
        name, at = _text(attribute, at)
        (kind,) = struct.unpack_from("<i", attribute, at)
        channels.append((name, TYPES[kind]))
        at += 16
    return channels


def _unpacked(block, size):
    """Undoes ZIP compression: deflate, differences of neighbouring bytes, even and odd bytes apart."""
    if len(block) == size:
        return block
    inflated = zlib.decompressobj().decompress(block, size + 1)  # at most what is announced: a few bytes can hold gigabytes
    if len(inflated) != size:
        raise ValueError(f"a block has {counted(len(inflated), 'byte')} and not {size}")
    data = np.frombuffer(inflated, np.uint8).copy()
    data[1:] -= 128
    data = np.add.accumulate(data, dtype=np.uint8)  # modulo 256
    out = np.empty(size, np.uint8)
    out[0::2], out[1::2] = data[: (size + 1) // 2], data[(size + 1) // 2 :]
    return out.tobytes()


def _decode(data, path):
    attributes, at = _header(data)
    channels = _channels(attributes["channels"])
    rows_per_block = ROWS_PER_BLOCK[attributes["compression"][0]]
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    if width < 1 or height < 1:
        raise ValueError("its image is empty")
    row_bytes = sum(kind.itemsize for _, kind in channels) * width
    copies_of_block = 4  # as it is inflated, summed up, put in order, and as bytes
    _need(len(data) + 4 * width * height * len(channels) + copies_of_block * rows_per_block * row_bytes, path)
    blocks = -(-height // rows_per_block)
    offsets = struct.unpack_from(f"<{blocks}Q", data, at)
    if len(set(offsets)) != blocks:
        raise ValueError("blocks share their bytes")
    planes = {name: np.empty((height, width), np.float32) for name, _ in channels}
    row = np.dtype([(f"{i}", kind, (width,)) for i, (_, kind) in enumerate(channels)])
    for offset in offsets:
        first, size = struct.unpack_from("<ii", data, offset)
        count = min(rows_per_block, bottom + 1 - first)
        if first < top or count < 1 or size < 0:
            raise ValueError("a block lies outside of the image")
        rows = np.frombuffer(_unpacked(data[offset + 8 : offset + 8 + size], count * row_bytes), row, count)
        for i, (name, _) in enumerate(channels):
            planes[name][first - top : first - top + count] = rows[f"{i}"]
    return planes
