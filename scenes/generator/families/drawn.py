"""What rooms and streets share once their things stand: the choice of a camera, and their files."""
from ..description import scene_json
from . import camera
from .estimate import glance
from .refusals import Refused, judge_glance


def first_seen(candidates, place):
    """(view, its path, its glance) of the first of the (view, path) whose picture no rule refuses."""
    refused = Refused("camera")
    for view, path in candidates:
        seen = glance(view, place.cast, place.light, place.sees_sun)
        try:
            judge_glance(seen)
        except Refused as why:
            refused = why
            continue
        return view, path, seen
    raise refused


def described(place, lights):
    """(model, scene.json, files beside them) of a place whose model is complete but for its textures."""
    place.finishes.write_maps()
    environment, of_sky, files = place.sky.description()
    cameras = camera.described(place.view, place.path, place.glance.exposure())
    text = scene_json(cameras, lights=of_sky + lights, frame_count=camera.FRAMES, frame_rate=camera.RATE)
    text["environment"] = environment
    return place.model, text, files
