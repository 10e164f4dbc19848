"""Turns Blender's passes and cameras into ssrlab's layers. Without Blender's modules, so that tests need no Blender."""

import numpy as np

from capture_files import pixel_uv, sky_motion, vulkan_clip

# Blender's world has +Z up, ssrlab's +Y; both are right-handed, and both cameras look along -z with y up.
OURS_FROM_BLENDER = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


# Passes by the names of Blender 5, and of those before.
OLDER_NAMES = {
    "Diffuse Direct": "DiffDir",
    "Diffuse Indirect": "DiffInd",
    "Diffuse Color": "DiffCol",
    "Emission": "Emit",
    "Environment": "Env",
    "Material Index": "IndexMA",
}


def camera_of(matrix_world, projection, extent, near, far, is_orthographic, frame):
    """camera.json of a Blender camera; `matrix_world` and `projection` (calc_matrix_camera()): arrays (4, 4)."""
    world_from_view = OURS_FROM_BLENDER @ np.asarray(matrix_world, float)
    world_from_view[:3, :3] /= np.linalg.norm(world_from_view[:3, :3], axis=0)  # cameras' scale changes nothing
    return {
        "extent": list(extent),
        "depth_direction": "standard",
        "depth_format": "d32f",
        "near": near,
        "far": far,
        "is_orthographic": is_orthographic,
        "frame": frame,
        "clip_from_view": vulkan_clip(np.asarray(projection, float)),
        "view_from_world": np.linalg.inv(world_from_view),
    }


def _turned(vectors):
    return vectors @ OURS_FROM_BLENDER[:3, :3].T


def _towards_camera(normals, positions, camera):
    world_from_view = np.linalg.inv(camera["view_from_world"])
    away = -world_from_view[:3, 2] if camera["is_orthographic"] else positions - world_from_view[:3, 3]
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    normals = normals / np.where(length > 0, length, 1)
    return np.where(np.sum(normals * away, axis=-1, keepdims=True) > 0, -normals, normals)


def layers_of(passes, camera, previous, lit=None):
    """The layers of one frame.

    `passes`: arrays (height, width, channels) by Blender's name: Depth, Position, Normal, Vector, IndexMA, and the AOVs
    that blender_export.py adds: base_color, true_normal, emission, roughness, metallic, specular. Rendered with one
    sample in the middle of each pixel. `camera`, `previous`: camera.json of this and of the frame before. `lit`: passes
    DiffDir, DiffInd, DiffCol, Emit and Env of another render of many samples; None: no such layer.
    """
    surface = passes["Depth"] < 1e9  # Cycles writes 1e10 where it meets nothing
    position = _turned(passes["Position"])
    height, width = position.shape[:2]
    clip_from_world = camera["clip_from_view"] @ camera["view_from_world"]
    clip = np.concatenate([position, np.ones((height, width, 1))], axis=-1) @ clip_from_world.T
    far_depth = 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = np.where(surface, clip[..., 2:3] / clip[..., 3:], far_depth)
    # The first two components of Vector point from here to where the pixel was, in pixels with y up.
    motion = passes["Vector"][..., :2] * np.array([-1 / width, 1 / height])

    def on_surface(values, elsewhere=0.0):
        return np.where(surface, values, elsewhere)

    layers = {
        "depth": np.clip(depth, 0, far_depth),
        "normal": on_surface(_towards_camera(_turned(passes["Normal"]), position, camera)),
        "geometric_normal": on_surface(_towards_camera(_turned(passes["true_normal"]), position, camera)),
        "roughness": on_surface(np.clip(passes["roughness"], 0, 1), 1.0),
        "base_color": on_surface(np.clip(passes["base_color"], 0, 1)),
        "metalness": on_surface(np.clip(passes["metallic"], 0, 1)),
        "emission": on_surface(passes["emission"]),
        # Blender's 0.5 is the reflectance 0.04, which is 1 here.
        "specular": on_surface(2 * passes["specular"]),
        "motion": np.where(surface, motion, sky_motion(camera, previous)),
        "material_id": on_surface(passes["IndexMA"]),
    }
    if lit is not None:
        layers["lit"] = (lit["DiffDir"] + lit["DiffInd"]) * lit["DiffCol"] + lit["Emit"] + lit["Env"]
    return layers


def with_previous(camera, previous):
    """camera.json with the camera of the frame before."""
    return {
        **camera,
        "previous_clip_from_view": previous["clip_from_view"],
        "previous_view_from_world": previous["view_from_world"],
    }


# An equirectangular camera has its forward direction (-z) in the middle of the image, and its right (x) a quarter to
# the right. Ours has +X in the middle and +Z a quarter to the right; Blender's names of these are +X and -Y.
PANORAMA_CAMERA = np.array([[0.0, 0, -1, 0], [-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
