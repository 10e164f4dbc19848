"""The rules by which a draw is refused, and the next of the same number taken."""
from collections import Counter

from . import densities as of
from .estimate import REFLECTIVE

RULES = {
    "objects": f"not {of.OBJECTS[0]} to {of.OBJECTS[1]} objects",
    "camera": "no place for a camera, off walls and things along all of its path, with a view of what it looks at",
    "near": "a thing nearer than 0.5 m, or one thing over more than 40 % of the picture",
    "open": "a ray leaves the scene other than through a window",
    "rough": "less than 5 % of the picture have a roughness of at most 0.35",
    "black": "more than 60 % of the picture 5 stops below its middle, or no light at all",
    "blown": "more than 25 % of the picture 4.5 stops above its middle",
}


class Refused(Exception):
    """`rule`: a key of RULES."""

    def __init__(self, rule):
        super().__init__(rule)
        self.rule = rule


def judge_objects(count):
    if not of.OBJECTS[0] <= count <= of.OBJECTS[1]:
        raise Refused("objects")


def judge_glance(glance):
    """`glance`: of the camera; None: a ray escaped."""
    if glance is None:
        raise Refused("open")
    if min(hit.distance for hit in glance.hits) < 0.5:
        raise Refused("near")
    seen = Counter(id(hit.place) for hit in glance.hits if hit.place)
    if seen and max(seen.values()) > 0.4 * len(glance.hits):
        raise Refused("near")
    if glance.share(lambda hit: hit.finish.roughness <= REFLECTIVE and not any(hit.finish.radiance)) < 0.05:
        raise Refused("rough")
    middle = sorted(glance.radiances)[len(glance.radiances) // 2]
    count = len(glance.radiances)
    if middle < 1e-4 or sum(r < middle / 32 for r in glance.radiances) > 0.6 * count:
        raise Refused("black")
    if sum(r > 22.6 * middle for r in glance.radiances) > 0.25 * count:
        raise Refused("blown")


def first_accepted(name, draw, most=200):
    """draw(dice name) of `name`/0, `name`/1, ... until one is not refused; (what it returns, rules that refused)."""
    refused = []
    for attempt in range(most):
        try:
            return draw(f"{name}/{attempt}"), refused
        except Refused as why:
            refused.append(why.rule)
    raise RuntimeError(f"{name}: {most} draws were refused: {Counter(refused)}")
