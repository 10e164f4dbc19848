"""Things that move, and a camera that turns: what temporal reuse gets wrong."""
from .description import camera, pitching, scene_json, shifted, yawing
from .gltf import Model
from .parts import BOX, add_box, add_checker_wall, add_mirror_floor, hue, reflector
from .shapes import cosine, floor, random_cells, rectangle, sine, tilted_disc, unit_sphere


def add_disocclusion(model):
    """Returns the node of the column."""
    add_mirror_floor(model)
    column = model.add("column", BOX, model.flat("column", (0.9, 0.9, 0.9)), at=(0, 1.5, -2.5), scale=(0.3, 1.5, 0.3))
    hues = [model.flat(f"cell{i:02}", hue(i / 12, value=0.8)) for i in range(12)]
    wall = random_cells((-10, 0, -7), (0.5, 0, 0), (0, 0.5, 0), 40, 10, len(hues))
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


def passing_pillars():
    """Each path has the view of `main` in its middle."""
    model = Model()
    for roughness, x_min, x_max in ((0.1, -100, -0.8), (0, -0.8, 0.8), (0.3, 0.8, 100)):
        material = reflector(model, roughness)
        model.add(f"floor_r{round(100 * roughness):02}", floor(x_min, x_max, -60, 2), material)
    # Distance, number, spacing, half width and height in metres: seen from 0.5 m above the floor all are about as tall.
    rows = ((2, 7, 1.2, 0.06, 1.2), (10, 13, 2.5, 0.3, 3), (50, 21, 8, 1.5, 12))
    for row, (distance, count, spacing, half_width, height) in enumerate(rows):
        shine = model.flat(f"pillar_{distance}m", [2 * c for c in hue(row / 3)])
        for i in range(count):
            place = ((i - (count - 1) / 2) * spacing, height / 2, -distance)
            model.add(f"pillar_{distance}m_{i:02}", BOX, shine, at=place, scale=(half_width, height / 2, half_width))
    add_checker_wall(model, 200, 24, z=-60, cell=4, light=(0.15, 0.15, 0.15), dark=(0.04, 0.04, 0.05))
    main = camera("main", (0, 0.5, 0), (0, -0.4, -10), 55)
    # Pixels per frame where the image is 320 x 180: 3.5 at 2 m, 0.7 at 10 m, 0.14 at 50 m; the turn 1.5 at all of them.
    start = camera("start", (-1.2, 0.5, 0), (-1.2, -0.4, -10), 55)
    lateral, yaw = shifted(start, "lateral", (2.4, 0, 0), frames=60), yawing(main, "yaw", 30, frames=60)
    return model, scene_json([main, lateral, yaw])


ROUGHNESSES = (0, 0.1, 0.3)


def add_emitters(model):
    """Three strips of floor, a wall, and a lamp that hovers over each strip; returns (x, node) of each lamp."""
    lamp, lamps = model.flat("lamp", (4, 3, 1.5)), []
    for i, roughness in enumerate(ROUGHNESSES):
        x = 3 * (i - 1)
        model.add(f"floor_r{round(100 * roughness):02}", floor(x - 1.5, x + 1.5, -7, 2), reflector(model, roughness))
        lamps.append((x, model.add(f"lamp{i}", BOX, lamp, at=(x, 0.7, -4), scale=(0.2, 0.2, 0.2))))
    add_checker_wall(model, 16, 3.5, z=-7, cell=0.5, light=(0.3, 0.3, 0.3), dark=(0.05, 0.05, 0.06))
    return lamps


EMITTER_CAMERA = camera("main", (0, 1.4, 2.5), (0, 0.2, -4), 45)


def moving_emitter():
    model = Model()
    for x, node in add_emitters(model):
        # 60 frames: to the right and back, twice; 2.7 pixels per frame where the image is 320 x 180.
        places = [(x + offset, 0.7, -4) for offset in (-0.6, 0.6, -0.6, 0.6, -0.6)]
        model.animate(node, "translation", (0, 0.5, 1, 1.5, 2), places)
    return model, scene_json([EMITTER_CAMERA | {"frames": 60}], frame_count=60, frame_rate=30)


def stepping_emitter():
    model = Model()
    for x, node in add_emitters(model):
        # Frame 30 is the first after the step; twice the longest history of usual techniques follows.
        model.animate(node, "translation", (0, 1), [(x - 0.6, 0.7, -4), (x + 0.6, 0.7, -4)], interpolation="STEP")
    return model, scene_json([EMITTER_CAMERA | {"frames": 94}], frame_count=94, frame_rate=30)


def thin_pole():
    """Where the image is 320 x 180 the poles are 1.6 pixels wide and move by 0.7 pixels per frame."""
    model = Model()
    pole = model.flat("pole", (12, 9, 5))
    for i, roughness in enumerate((0.05, 0.15, 0.3)):
        x = 2 * (i - 1)
        model.add(f"floor_r{round(100 * roughness):02}", floor(x - 1, x + 1, -7, 2), reflector(model, roughness))
        node = model.add(f"pole{i}", BOX, pole, at=(x - 0.5, 0.6, -3), scale=(0.02, 0.6, 0.02))
        model.animate(node, "translation", (0, 59 / 30), [(x - 0.5, 0.6, -3), (x + 0.5, 0.6, -3)])
    add_checker_wall(model, 16, 4, z=-7, cell=1, light=(0.05, 0.05, 0.05), dark=(0.03, 0.03, 0.03))
    main = camera("main", (0, 1.4, 2.5), (0, 0.2, -3), 45, frames=60)
    return model, scene_json([main], frame_count=60, frame_rate=30)


def rotating_mirror():
    model = Model()
    model.add("ground", floor(-6, 6, -7, 2, y=-0.15), model.flat("ground", (0.06, 0.06, 0.06)))
    disc = tilted_disc(5)
    # 90 degrees per second for 2 s; keys each 90, since a slerp takes the shorter way.
    turns = [(0, sine(turn / 2), 0, cosine(turn / 2)) for turn in (0, 90, 180)]
    for i, roughness in enumerate(ROUGHNESSES):
        node = model.add(f"disc_r{round(100 * roughness):02}", disc, reflector(model, roughness),
                         at=(2.4 * (i - 1), 0, -1), scale=(1.15, 1.15, 1.15))
        model.animate(node, "rotation", (0, 1, 2), turns)
    for i in range(9):
        color = [1.5 * c for c in hue(i / 9)]
        add_box(model, f"pillar{i}", color, (-4 + i, 1, -4), (0.15, 1.15, 0.15))
    add_checker_wall(model, 16, 4, z=-7, cell=0.5, light=(0.3, 0.3, 0.3), dark=(0.05, 0.05, 0.06))
    main = camera("main", (0, 2.2, 3.6), (0, 1, -1.6), 45, frames=60)
    return model, scene_json([main], frame_count=60, frame_rate=30)
