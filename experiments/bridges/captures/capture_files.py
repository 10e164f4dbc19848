"""Writes captures as ssrlab reads them: gbuffer.exr, camera.json and environment.json (README.md beside this file).

Only numpy is needed, so that Blender's and RenderDoc's Python can use it. What is wrong with the files or the request is a ResultsError.
"""

import json
import struct
import zlib
from pathlib import Path

import numpy as np

from ssrlab.mistakes import ResultsError, counted
from ssrlab.text_files import path_inside, whole_file, write_text

# Layers and their channels: core/gbuffer/gbuffer_file.h.
CHANNELS = {
    "depth": "Z", "normal": "XYZ", "roughness": "Y", "base_color": "RGB", "metalness": "Y", "lit": "RGB",
    "geometric_normal": "XYZ", "emission": "RGB", "specular": "Y", "dielectric_f0": "RGB", "motion": "XY", "material_id": "Y",
    "previous_depth": "Z", "previous_normal": "XYZ", "previous_roughness": "Y", "fallback": "RGB",
}  # fmt: skip
REQUIRED = ("depth", "normal", "roughness", "base_color", "metalness")


def _attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def _zipped(row):
    """EXR's ZIPS compression of one row: even and odd bytes apart, differences of neighbours, deflate."""
    data = np.frombuffer(row, np.uint8)
    data = np.concatenate([data[0::2], data[1::2]]).astype(np.int16)
    data[1:] = (data[1:] - data[:-1] + 128) & 0xFF
    packed = zlib.compress(data.astype(np.uint8).tobytes(), 4)
    return packed if len(packed) < len(row) else row


def write_exr(path, planes):
    """`planes`: float32 arrays of one shape (height, width), first row at the top, by channel name ("depth.Z").

    Format: "OpenEXR File Layout", openexr.com. A killed run leaves no half file.
    """
    path = Path(path)
    names = sorted(planes)
    height, width = planes[names[0]].shape
    for name in names:
        if planes[name].shape != (height, width):
            raise ResultsError(f"{path}: '{name}' is {planes[name].shape}, but '{names[0]}' {(height, width)}")
    float32 = struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1)
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 2 | (0x400 if max(map(len, names)) > 31 else 0))
    header += _attribute("channels", "chlist", b"".join(n.encode() + b"\0" + float32 for n in names) + b"\0")
    header += _attribute("compression", "compression", b"\2")
    header += _attribute("dataWindow", "box2i", window) + _attribute("displayWindow", "box2i", window)
    header += _attribute("lineOrder", "lineOrder", b"\0")
    header += _attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += _attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"

    rows = np.stack([np.asarray(planes[n], "<f4") for n in names], axis=1)  # (height, channels, width)
    blocks = []
    for y in range(height):
        data = _zipped(rows[y].tobytes())
        blocks.append(struct.pack("<ii", y, len(data)) + data)
    at = len(header) + 8 * height + np.concatenate([[0], np.cumsum([len(b) for b in blocks])[:-1]])
    with whole_file(path) as unfinished:
        Path(unfinished).write_bytes(header + np.asarray(at, "<u8").tobytes() + b"".join(blocks))


def frame_folder(out, frame):
    """Of a frame of a sequence."""
    return Path(path_inside(out, f"frame_{frame:04}"))


def write_frame(folder, layers, camera):
    """One frame. `layers`: arrays of shape (height, width) or (height, width, channels) by the names above; `camera`:
    what camera.json holds, with matrices as arrays of shape (4, 4)."""
    folder = Path(folder)
    missing = [name for name in REQUIRED if name not in layers]
    unknown = [name for name in layers if name not in CHANNELS]
    if missing or unknown:
        raise ResultsError(f"{folder}: lacks the layers {missing}; does not know {unknown}")
    planes = {}
    for name, values in layers.items():
        values = np.asarray(values, np.float32)
        values = values if values.ndim == 3 else values[..., None]
        if values.shape[2] != len(CHANNELS[name]):
            raise ResultsError(f"{folder}: '{name}' has {counted(values.shape[2], 'channel')} and needs {len(CHANNELS[name])}")
        for i, channel in enumerate(CHANNELS[name]):
            planes[f"{name}.{channel}"] = values[..., i]
    height, width = planes["depth.Z"].shape
    folder.mkdir(parents=True, exist_ok=True)
    write_exr(folder / "gbuffer.exr", planes)
    text = {"extent": [width, height], **camera}
    text = {key: value.tolist() if isinstance(value, np.ndarray) else value for key, value in text.items()}
    write_text(folder / "camera.json", json.dumps(text, indent=2) + "\n")


def write_environment(folder, environment):
    """The environment, for rays that hit nothing: an RGB radiance for all directions, or an image of shape (height, width, 3) as
    core/shared/environment.h maps it: +Y at the top, +X in the middle, -Z in the middle of the left half."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    environment = np.asarray(environment, np.float32)
    if environment.ndim == 1:
        entry = {"constant": environment.tolist()}
    else:
        write_exr(folder / "environment.exr", {c: environment[..., i] for i, c in enumerate("RGB")})
        entry = {"image": "environment.exr"}
    write_text(folder / "environment.json", json.dumps(entry, indent=2) + "\n")


def vulkan_clip(clip_from_view):
    """From OpenGL's clip space (y up, z from -1 to 1), which Blender and many engines' projections have."""
    return np.array([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0.5, 0.5], [0, 0, 0, 1]]) @ clip_from_view


def pixel_uv(height, width):
    """uv of pixel centres, y down, of shape (height, width, 2)."""
    y, x = np.mgrid[0:height, 0:width] + 0.5
    return np.stack([x / width, y / height], axis=-1)


def sky_motion(camera, previous):
    """Motion vectors of a sky at infinity between two cameras (dicts as camera.json), of shape (height, width, 2)."""
    if np.array_equal(camera["clip_from_view"], previous["clip_from_view"]) and np.array_equal(
        camera["view_from_world"], previous["view_from_world"]
    ):
        return np.zeros((camera["extent"][1], camera["extent"][0], 2))
    uv = pixel_uv(camera["extent"][1], camera["extent"][0])
    clip = np.concatenate([uv * 2 - 1, np.full_like(uv[..., :1], 0.5), np.ones_like(uv[..., :1])], axis=-1)
    view = clip @ np.linalg.inv(camera["clip_from_view"]).T
    direction = (view[..., :3] / view[..., 3:]) @ np.linalg.inv(camera["view_from_world"])[:3, :3].T
    before = direction @ (previous["clip_from_view"] @ previous["view_from_world"])[:, :3].T
    w = before[..., 3:]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(w > 0, uv - (before[..., :2] / w * 0.5 + 0.5), 0)
