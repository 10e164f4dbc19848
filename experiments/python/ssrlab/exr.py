"""Reads the OpenEXR files that ssrlab writes: single-part scan lines, ZIP-compressed or not, half or float.

Debian 12 has no Python binding of OpenEXR. Format: "OpenEXR File Layout", openexr.com.
"""

import struct
import zlib

import numpy as np

ROWS_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # no compression, ZIPS, ZIP
LONG_NAMES = 0x400  # of layers and attributes: changes nothing of the layout
TYPES = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}


class ExrError(Exception):
    """The file is missing or not what is read here: one sentence."""


def read_exr_rgb(path, layer=""):
    """The channels R, G, B, of `layer` if one is named, as float32 of shape (height, width, 3)."""
    planes = read_exr_planes(path)
    try:
        return np.stack([planes[f"{layer}.{c}" if layer else c] for c in "RGB"], axis=-1)
    except KeyError as e:
        raise ExrError(f"{path} lacks the channel {e}") from e


def read_exr_planes(path):
    """All channels by name, each float32 of shape (height, width)."""
    try:
        with open(path, "rb") as file:
            return _decode(file.read())
    except OSError as e:
        raise ExrError(f"cannot read {path}: {e.strerror}") from e
    except (struct.error, zlib.error, KeyError, IndexError, ValueError) as e:
        raise ExrError(f"cannot read {path} as OpenEXR: it is truncated or of another kind ({e})") from e


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
    data = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    data[1:] -= 128
    data = np.cumsum(data).astype(np.uint8)
    out = np.empty(size, np.uint8)
    out[0::2], out[1::2] = data[: (size + 1) // 2], data[(size + 1) // 2 :]
    return out.tobytes()


def _decode(data):
    attributes, at = _header(data)
    channels = _channels(attributes["channels"])
    rows_per_block = ROWS_PER_BLOCK[attributes["compression"][0]]
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    row_bytes = sum(kind.itemsize for _, kind in channels) * width
    planes = {name: np.empty((height, width), np.float32) for name, _ in channels}
    blocks = -(-height // rows_per_block)
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        first, size = struct.unpack_from("<ii", data, offset)
        rows = min(rows_per_block, bottom + 1 - first)
        raw, position = _unpacked(data[offset + 8 : offset + 8 + size], rows * row_bytes), 0
        for y in range(first - top, first - top + rows):
            for name, kind in channels:
                planes[name][y] = np.frombuffer(raw, kind, width, position)
                position += width * kind.itemsize
    return planes
