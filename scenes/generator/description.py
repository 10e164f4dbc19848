"""scene.json: cameras, their paths, and the text of the file."""
import json

from .gltf import tidy, tidy_all
from .shapes import cosine, sine

DIM = (0.02, 0.02, 0.02)  # radiance of the environment where a scene does not say otherwise


def camera(name, position, target, vfov_deg, near=0.1, far=100.0, **more):
    """near, far in metres; `more`: path, exposure_ev."""
    place = {"name": name, "position": list(position), "target": list(target)}
    return place | {"vfov_deg": vfov_deg, "near": near, "far": far} | more


def moving(still, name, keys, frames):
    """The camera `still` along `keys`: (position, target) at equal distances in time, from frame 0 to the last."""
    step = (frames - 1) / (len(keys) - 1)
    path = [{"frame": tidy(i * step), "position": tidy_all(position), "target": tidy_all(target)}
            for i, (position, target) in enumerate(keys)]
    lens = {key: still[key] for key in ("vfov_deg", "near", "far", "exposure_ev") if key in still}
    return {"name": name, **lens, "frames": frames, "path": path}


def shifted(still, name, offset, frames, shift_target=True):
    """Along a straight line by `offset`; with `shift_target` the view direction stays."""
    def plus(point, amount):
        return [a + b for a, b in zip(point, amount)]

    end = plus(still["target"], offset) if shift_target else still["target"]
    return moving(still, name, [(still["position"], still["target"]), (plus(still["position"], offset), end)], frames)


def orbiting(still, name, degrees, frames):
    """About the vertical through the target. A key each 2 degrees: the chords cut the arc by 1.5e-4 of its radius."""
    x, y, z = [a - b for a, b in zip(still["position"], still["target"])]
    keys = []
    for angle in range(0, degrees + 1, 2):
        c, s = cosine(angle), sine(angle)
        offset = (c * x + s * z, y, c * z - s * x)
        keys.append(([a + b for a, b in zip(still["target"], offset)], still["target"]))
    return moving(still, name, keys, frames)


def pitching(still, name, degrees, frames):
    """Turns by `degrees` (even) about its own place: up, down, and back. The camera must look along x = 0."""
    _, y, z = [b - a for a, b in zip(still["position"], still["target"])]
    angles = [*range(0, degrees, 2), *range(degrees, -degrees, -2), *range(-degrees, 1, 2)]
    keys = []
    for angle in angles:
        c, s = cosine(angle), sine(angle)
        direction = (0, c * y - s * z, c * z + s * y)
        keys.append((still["position"], [a + b for a, b in zip(still["position"], direction)]))
    return moving(still, name, keys, frames)


def yawing(still, name, degrees, frames):
    """Turns right by `degrees` about its own place, the view of `still` in the middle. A key each 2 degrees, of which
    `degrees` must be a multiple. The camera must look along x = 0."""
    _, y, z = [b - a for a, b in zip(still["position"], still["target"])]
    keys = []
    for i in range(degrees // 2 + 1):
        c, s = cosine(2 * i - degrees / 2), sine(2 * i - degrees / 2)
        keys.append((still["position"], [a + b for a, b in zip(still["position"], (-s * z, y, c * z))]))
    return moving(still, name, keys, frames)


def scene_json(cameras, environment=DIM, **more):
    """`more`: lights, frame_count, frame_rate."""
    return {"gltf": "scene.glb", "environment": {"constant": list(environment)}, "back_faces": "drawn", **more,
            "cameras": cameras}


def plain(value):
    """Writes 2.0 as 2."""
    if isinstance(value, dict):
        return {key: plain(v) for key, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def to_text(value, indent=""):
    """JSON with objects on lines of their own, but lists of numbers, and objects that fit, on one."""
    one_line = json.dumps(plain(value))
    nests = any(isinstance(v, (dict, list)) for v in (value.values() if isinstance(value, dict) else []))
    if not isinstance(value, (dict, list)) or (len(one_line) + len(indent) < 110 and (indent or not nests)):
        return one_line
    inner = indent + "  "
    if isinstance(value, dict):
        lines = [f"{inner}{json.dumps(key)}: {to_text(v, inner)}" for key, v in value.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    return "[\n" + ",\n".join(inner + to_text(v, inner) for v in value) + f"\n{indent}]"
