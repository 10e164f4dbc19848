"""Things that move, and a camera that turns: what temporal reuse gets wrong."""
import random

from .description import camera, pitching, scene_json, shifted
from .gltf import Model
from .parts import BOX, add_box, add_checker_wall, add_mirror_floor, hue
from .shapes import Shape, cosine, rectangle, sine, unit_sphere


def add_disocclusion(model):
    """Returns the node of the column."""
    add_mirror_floor(model)
    column = model.add("column", BOX, model.flat("column", (0.9, 0.9, 0.9)), at=(0, 1.5, -2.5), scale=(0.3, 1.5, 0.3))
    hues = [model.flat(f"cell{i:02}", hue(i / 12, value=0.8)) for i in range(12)]
    columns, rows = 40, 10
    wall = Shape([(-10 + 0.5 * i, 0.5 * j, -7.0) for j in range(rows + 1) for i in range(columns + 1)],
                 [(0.0, 0.0, 1.0)] * ((columns + 1) * (rows + 1)), [[] for _ in hues])
    # Only random.random() is the same in all versions of Python.
    dice = random.Random(7)
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            d = a + columns + 1
            wall.parts[int(12 * dice.random())] += [a, a + 1, d + 1, a, d + 1, d]
    model.add("wall", wall, *hues)
    return column


DISOCCLUSION_CAMERA = camera("main", (-1, 1.5, 2), (0, 0.8, -4), 45)


def disocclusion():
    model = Model()
    add_disocclusion(model)
    lateral = shifted(DISOCCLUSION_CAMERA, "lateral", (2, 0, 0), frames=60, shift_target=False)
    return model, scene_json([DISOCCLUSION_CAMERA, lateral])


def disocclusion_moving_column():
    model = Model()
    column = add_disocclusion(model)
    model.animate(column, "translation", (0, 59 / 30), [(-1.5, 1.5, -2.5), (1.5, 1.5, -2.5)])
    return model, scene_json([DISOCCLUSION_CAMERA | {"frames": 60}], frame_count=60, frame_rate=30)


def moving_objects():
    model = Model()
    add_mirror_floor(model)
    # 180 degrees per second for 2 s, from 25 degrees; keys each 90, since a slerp takes the shorter way.
    turns = [(25 + 90 * i) / 2 for i in range(5)]
    rotor = model.add("rotor", BOX, model.flat("rotor", (0.9, 0.3, 0.05)), at=(0, 1, -3), scale=(1.2, 0.08, 0.08))
    model.animate(rotor, "rotation", [0.5 * i for i in range(5)], [(0, sine(turn), 0, cosine(turn)) for turn in turns])
    ball = model.add("ball", unit_sphere(48, 96), 0, at=(-2, 0.6, -4), scale=(0.6, 0.6, 0.6))
    model.animate(ball, "translation", (0, 59 / 30), [(-2, 0.6, -4), (-0.5, 0.6, -4)])
    add_box(model, "static", (0.1, 0.4, 0.9), (2.2, 0.7, -4), (0.3, 0.7, 0.3))
    add_checker_wall(model, 16, 4, z=-8, cell=0.5)
    main = camera("main", (0, 1.6, 2.5), (0, 0.6, -3.5), 45, frames=60)
    return model, scene_json([main], frame_count=60, frame_rate=30)


def border_crossing():
    model = Model()
    add_mirror_floor(model)
    for i in range(9):
        color = [1.5 * c for c in hue(i / 9)]
        add_box(model, f"pillar{i}", color, (-6 + 1.5 * i, 1.3, -4), (0.3, 1.3, 0.3))
    model.add("sign", rectangle((0, 3.2, -4), (7, 0, 0), (0, 0.3, 0)), model.flat("sign", (3, 3, 3)))
    main = camera("main", (0, 1.2, 2), (0, -0.3, -3), 40)
    return model, scene_json([main, pitching(main, "pitch", 10, frames=120)])
