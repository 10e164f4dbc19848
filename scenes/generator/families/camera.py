"""A camera that a person would choose, and the path that it takes."""
from ..description import camera, moving
from ..gltf import tidy_all
from ..shapes import cosine, normalized, sine
from . import densities as of

FRAMES, RATE = 40, 30


def turned_about(centre, point, degrees):
    """In the horizontal plane."""
    c, s = cosine(degrees), sine(degrees)
    x, z = point[0] - centre[0], point[2] - centre[2]
    return (centre[0] + c * x + s * z, point[1], centre[2] + c * z - s * x)


def path_of(dice, view):
    """Keys (eye, target) at equal distances in time, around the view."""
    kind = dice.draw(of.PATH)
    length, turn = dice.draw(of.PATH_LENGTH), dice.draw(of.PATH_TURN) * dice.one_of((-1, 1))
    ahead = normalized((view.target[0] - view.eye[0], 0.0, view.target[2] - view.eye[2]))
    if kind in ("forward", "sideways"):
        way = ahead if kind == "forward" else (-ahead[2], 0.0, ahead[0])
        sign = dice.one_of((-1, 1)) * length
        offset = tuple(sign * c for c in way)
        target = view.target if kind == "sideways" and dice.chance(0.5) else tuple(
            a + b for a, b in zip(view.target, offset))
        return [(view.eye, view.target), (tuple(a + b for a, b in zip(view.eye, offset)), target)]
    steps = [turn * k / 8 for k in range(9)]
    if kind == "turn":
        return [(view.eye, turned_about(view.eye, view.target, degrees)) for degrees in steps]
    return [(turned_about(view.target, view.eye, degrees), view.target) for degrees in steps]


def described(view, keys, exposure):
    """scene.json's cameras: main stands still, path is moved."""
    rounded = [tidy_all(round(c, 5) for c in point) for point in (view.eye, view.target)]
    still = camera("main", *rounded, round(view.vfov, 2))
    for plane in ("near", "far"):  # derived from the scene when it is loaded
        del still[plane]
    still |= {"exposure_ev": exposure, "frames": FRAMES}
    keys = [tuple(tidy_all(round(c, 5) for c in point) for point in key) for key in keys]
    return [still, moving(still, "path", keys, FRAMES)]


def points_between(keys):
    for (a, _), (b, _) in zip(keys, keys[1:]):
        for t in (0.0, 0.25, 0.5, 0.75, 1.0):
            yield tuple(p + (q - p) * t for p, q in zip(a, b))
