"""Turns the bytes of an engine's textures into ssrlab's layers, as a mapping says. Without RenderDoc's module, so that
tests need none."""

import numpy as np

from capture_files import CHANNELS, vulkan_clip
from ssrlab.mistakes import ResultsError, counted

FLOATS = {2: "<f2", 4: "<f4", 8: "<f8"}
WHOLES = {1: "u1", 2: "<u2", 4: "<u4"}


def _small_floats(bits, mantissa):
    """Unsigned floats of 5 bits of exponent, of R11G11B10."""
    exponent, fraction = bits >> mantissa, (bits & ((1 << mantissa) - 1)) / (1 << mantissa)
    return np.where(exponent == 0, fraction * 2.0**-14, (1 + fraction) * 2.0 ** (exponent.astype(float) - 15))


def _regular(data, kind, width, count):
    if kind == "float" or (kind == "depth" and width == 4):
        return np.frombuffer(data, FLOATS[width]).astype(float)
    whole = np.frombuffer(data, WHOLES[width])
    most = float(2 ** (8 * width) - 1)
    if kind in ("unorm", "depth"):
        return whole / most
    if kind == "srgb":  # GetTextureData gives bytes as they are stored; alpha is linear
        values = (whole / most).reshape(-1, count)
        values[:, :3] = srgb_to_linear(values[:, :3])
        return values.ravel()
    if kind == "snorm":
        return np.maximum(whole.view(WHOLES[width].replace("u", "i")) / ((most - 1) / 2), -1.0)
    if kind == "uint":
        return whole.astype(float)
    raise ResultsError(f"textures of the kind '{kind}' are not read")


def decoded(data, extent, texture_format):
    """Texels as float of shape (height, width, channels), in the order RGBA. `texture_format`: (layout, kind, bytes of a
    channel, channels), with the layouts "regular", "bgra", "r10g10b10a2", "r11g11b10", "d24s8" and "d32s8"."""
    layout, kind, width, count = texture_format
    shape = (extent[1], extent[0], -1)
    if layout in ("regular", "bgra"):
        values = _regular(data, kind, width, count).reshape(extent[1], extent[0], count)
        return values[..., [2, 1, 0, 3][:count]] if layout == "bgra" else values
    bits = np.frombuffer(data, "<u4").astype(np.uint64)
    if layout == "r10g10b10a2":
        parts = [(bits >> shift & 1023) / 1023 for shift in (0, 10, 20)] + [(bits >> 30) / 3]
    elif layout == "r11g11b10":
        parts = [_small_floats(bits & 2047, 6), _small_floats(bits >> 11 & 2047, 6), _small_floats(bits >> 22, 5)]
    elif layout == "d24s8":
        parts = [(bits & 0xFFFFFF) / 0xFFFFFF]
    elif layout == "d32s8":
        parts = [np.frombuffer(data, "<f4")[0::2].astype(float)]
    else:
        raise ResultsError(f"textures of the layout '{layout}' are not read")
    return np.stack(parts, axis=-1).reshape(shape)


def from_the_top(texels, api, origin_is_lower_left):
    """Texels with the highest row first. `api`: "OpenGL", which stores images from the lowest row on (OpenGL 4.6, 8.4.4 and 18.2)
    unless glClipControl moves the origin; or another, which stores the highest first."""
    return texels[::-1] if api == "OpenGL" and origin_is_lower_left else texels


def srgb_to_linear(v):
    """IEC 61966-2-1."""
    return np.where(v <= 0.04045, v / 12.92, ((np.maximum(v, 0) + 0.055) / 1.055) ** 2.4)


def _unit(v):
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return v / np.where(length > 0, length, 1)


def _octahedral(v):
    """Unit vectors of two numbers in [-1, 1] on the octahedron, whose fold is at z = 0."""
    z = 1 - np.abs(v).sum(axis=-1, keepdims=True)
    fold = np.maximum(-z, 0)
    return _unit(np.concatenate([v - np.where(v >= 0, fold, -fold), z], axis=-1))


# What a mapping may do to a layer, one after the other; `camera` is that of camera.json.
DECODERS = {
    "snorm": lambda v, camera: v * 2 - 1,
    "octahedral": lambda v, camera: _octahedral(v),
    "unit": lambda v, camera: _unit(v),
    "view_to_world": lambda v, camera: v @ np.linalg.inv(np.asarray(camera["view_from_world"], float))[:3, :3].T,
    "z_up": lambda v, camera: np.stack([v[..., 0], v[..., 2], -v[..., 1]], axis=-1),
    "srgb": lambda v, camera: srgb_to_linear(v),
    "one_minus": lambda v, camera: 1 - v,
    "square": lambda v, camera: v * v,
    "square_root": lambda v, camera: np.sqrt(np.maximum(v, 0)),
    "negate": lambda v, camera: -v,
    "y_up": lambda v, camera: v * (1, -1),
    "clip_to_uv": lambda v, camera: v * 0.5,
    "turn_rows": lambda v, camera: v[::-1],
    "pixels_to_uv": lambda v, camera: v / np.asarray(camera["extent"], float),
}


def layer_of(name, texels, entry, camera):
    """One layer. `entry` of the mapping: "channels" (letters of RGBA; default: the first, as many as the layer has) and
    "decode" (names of DECODERS, or numbers to multiply with)."""
    where = f"layer '{name}'"
    steps = entry.get("decode", [])
    channels = entry.get("channels", "RGBA"[: 2 if "octahedral" in steps else len(CHANNELS[name])])
    missing = [c for c in channels if c not in "RGBA"[: texels.shape[2]]]
    if missing:
        raise ResultsError(f"{where}: the texture has no channel {missing[0]}, only {'RGBA'[: texels.shape[2]]}")
    values = texels[..., ["RGBA".index(c) for c in channels]]
    for step in steps:
        if isinstance(step, (int, float)):
            values = values * step
        elif step in DECODERS:
            values = DECODERS[step](values, camera)
        else:
            raise ResultsError(f"{where}: there is no decoder '{step}'; known are: {', '.join(DECODERS)}")
    if values.shape[2] != len(CHANNELS[name]):
        raise ResultsError(f"{where} has {counted(values.shape[2], 'channel')} after decoding and needs {len(CHANNELS[name])}")
    return values


# What a mapping may do to a matrix of the engine. Ours are named target_from_source and multiply columns from the left.
OURS_FROM_Z_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
MATRIX_DECODERS = {
    "transpose": lambda m: m.T,
    "inverse": np.linalg.inv,
    "opengl_clip": vulkan_clip,
    "clip_y_up": lambda m: np.diag([1.0, -1, 1, 1]) @ m,
    "z_into_the_image": lambda m: m @ np.diag([1.0, 1, -1, 1]),  # of clip_from_view, whose view looks along +z
    "view_z_into_the_image": lambda m: np.diag([1.0, 1, -1, 1]) @ m,  # of view_from_world
    "z_up": lambda m: m @ np.linalg.inv(OURS_FROM_Z_UP),  # of view_from_world
}


def camera_value(name, values, entry):
    """A number or a matrix of camera.json. `values`: of a shader's variable, of shape (rows, columns); `entry` of the
    mapping: "component" (which of the numbers) or "decode" (names of MATRIX_DECODERS)."""
    if "component" in entry:
        return float(values.ravel()[entry["component"]])
    if values.shape != (4, 4):
        raise ResultsError(f"camera: '{name}' is of shape {values.shape} and needs 4 x 4, or a 'component'")
    for step in entry.get("decode", []):
        if step not in MATRIX_DECODERS:
            known = ", ".join(MATRIX_DECODERS)
            raise ResultsError(f"camera: '{name}': there is no decoder '{step}'; known are: {known}")
        values = MATRIX_DECODERS[step](values)
    return values
