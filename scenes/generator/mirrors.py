"""Perfect mirrors, to find out where rays end: mirror_pillars to facing_mirrors."""
from .description import camera, orbiting, scene_json, shifted
from .gltf import Model
from .parts import add_box, add_checker_wall, add_mirror_floor, hue
from .shapes import checker, cosine, floor, rectangle, sine, unit_box, unit_pole, unit_sphere


def mirror_pillars():
    model = Model()
    add_mirror_floor(model)
    columns, rows = (-6, -3, 0, 3, 6), (-2, -5, -8, -11, -14)
    for i, (x, z) in enumerate((x, z) for x in columns for z in rows):
        add_box(model, f"pillar{i:02}", hue(i / 25), (x, 1.5, z), (0.2, 1.5, 0.2))
    add_checker_wall(model, 40, 8, z=-20, cell=1)
    main = camera("main", (0, 1.6, 6), (0, 1, -8), 50)
    return model, scene_json([main, shifted(main, "dolly", (0, 0, -4), frames=120)])


def grazing():
    model = Model()
    model.add("floor", floor(-120, 120, -220, 20), model.mirror())
    for i in range(8):
        d = 2.0**i
        side = 1 if i % 2 == 0 else -1
        add_box(model, f"box{i}", hue(i / 8), (side * (0.12 * d + 0.15), 0.09 * d, -d), (0.05 * d, 0.09 * d, 0.02 * d))
    add_checker_wall(model, 400, 40, z=-210, cell=5)
    return model, scene_json([camera("y5cm", (0, 0.05, 0), (0, 0.04, -10), 40, near=0.05, far=500),
                              camera("y5mm", (0, 0.005, 0), (0, 0.0045, -10), 40, near=0.005, far=500)])


def fence():
    model = Model()
    add_mirror_floor(model)
    pole, orange, blue = unit_pole(), model.flat("pole", (0.9, 0.25, 0.05)), model.flat("wire", (0.05, 0.6, 0.9))
    for i in range(41):
        model.add(f"pole{i:02}", pole, orange, at=(-2 + i / 10, 0, -3), scale=(0.01, 1.5, 0.01))
    for i in range(41):
        model.add(f"wire{i:02}", pole, blue, at=(-1.95 + i / 10, 0, -2), scale=(0.002, 0.8, 0.002))
    add_checker_wall(model, 12, 3, z=-6, cell=0.5)
    main = camera("main", (0, 1.2, 2), (0, 0.5, -4), 40)
    return model, scene_json([main, shifted(main, "lateral", (0.2, 0, 0), frames=60)])


def floating_holes():
    model = Model()
    add_mirror_floor(model)
    model.add("ball", unit_sphere(48, 96), model.flat("ball", (0.9, 0.1, 0.1)), at=(-1, 1.5, -3), scale=(0.7, 0.7, 0.7))
    model.add("cube", unit_box(), model.flat("cube", (0.1, 0.7, 0.2)), at=(1.4, 1.3, -3.6), scale=(0.5, 0.5, 0.5),
              rotation=(0, sine(15), 0, cosine(15)))
    add_checker_wall(model, 16, 5, z=-8, cell=1, light=(0.2, 0.4, 0.9), dark=(0.9, 0.8, 0.2))
    main = camera("main", (0, 2.2, 2.5), (0, 0.9, -3), 45)
    return model, scene_json([main, orbiting(main, "orbit", 20, frames=120)])


def offscreen_mirror():
    model = Model()
    model.add("wall_mirror", rectangle((0, 1.5, -4), (3, 0, 0), (0, 1.5, 0)), model.mirror())
    model.add("ground", floor(-12, 12, -12, 12), model.flat("ground", (0.12, 0.12, 0.12)))
    for i in range(7):
        add_box(model, f"behind{i}", hue(i / 7), (-4.5 + 1.5 * i, 0.75, 5), (0.4, 0.75, 0.4))
    for i in range(4):
        add_box(model, f"left{i}", hue(0.5 + i / 9), (-6, 0.6, -3 + 2 * i), (0.3, 0.6, 0.3))
    add_box(model, "in_front", (0.9, 0.9, 0.9), (1, 0.5, -2), (0.5, 0.5, 0.5))
    # Stands 2 cm off the far side of the white box: the camera sees the white front, the mirror the red label.
    add_box(model, "label", (0.9, 0.05, 0.05), (1, 0.5, -2.51), (0.4, 0.4, 0.01))
    return model, scene_json([camera("main", (0, 1.5, 2), (0, 1.4, -4), 45)])


def curved_mirror():
    model = Model()
    model.add("ball", unit_sphere(96, 192), model.mirror(), at=(0, 1, -4))
    ground = checker((-8, 0, 4), (1, 0, 0), (0, 0, -1), 16, 16)
    light, dark = model.flat("ground_light", (0.5, 0.5, 0.5)), model.flat("ground_dark", (0.1, 0.1, 0.12))
    model.add("ground", ground, light, dark)
    for i in range(10):
        place = (3 * cosine(36 * i), 0.6, -4 + 3 * sine(36 * i))
        add_box(model, f"ring{i}", hue(i / 10), place, (0.25, 0.6, 0.25))
    main = camera("main", (0, 1.6, 1.5), (0, 0.9, -4), 40)
    return model, scene_json([main, orbiting(main, "orbit", 20, frames=120)], environment=(0.1, 0.15, 0.25))


def facing_mirrors():
    model = Model()
    mirror = model.mirror()
    model.add("left", rectangle((-2, 1.5, -3), (0, 0, -4), (0, 1.5, 0)), mirror)
    model.add("right", rectangle((2, 1.5, -3), (0, 0, 4), (0, 1.5, 0)), mirror)
    model.add("end", rectangle((0, 1.5, -7), (2, 0, 0), (0, 1.5, 0)), mirror)
    model.add("ground", floor(-4, 4, -8, 4), model.flat("ground", (0.15, 0.13, 0.1)))
    for i, (x, z) in enumerate(((0.9, -1.5), (-0.9, -3), (0.9, -4.5))):
        add_box(model, f"box{i}", hue(i / 3), (x, 0.8, z), (0.15, 0.8, 0.15))
    yellow = model.flat("ball", (0.9, 0.9, 0.2))
    model.add("ball", unit_sphere(48, 96), yellow, at=(0, 1.2, -5.5), scale=(0.3, 0.3, 0.3))
    return model, scene_json([camera("yaw15", (0, 1.5, 1), (-1.6, 1.3, -5), 60),
                              camera("frontal", (0, 1.5, 1), (0, 1.5, -7), 60)])


def axis_parallel():
    model = Model()
    mirror = model.mirror()
    model.add("mirror_to_x", rectangle((-1.2, 1, -5), (0.7, 0, -0.7), (0, 0.8, 0)), mirror)
    model.add("mirror_back", rectangle((3, 1, -6), (0.8, 0, 0), (0, 0.8, 0)), mirror)
    model.add("mirror_down", rectangle((-1.2, 2.6, -5), (0.7, 0, 0), (0, 0.4, 0.4)), mirror)
    model.add("floor", floor(-4, 4, -8, -2, y=-0.2), mirror)
    panel = checker((0.75, 0.3, -5.45), (0.15, 0, 0.15), (0, 1.4 / 6, 0), 6, 6)
    model.add("panel", panel, model.flat("panel_red", (0.9, 0.2, 0.1)), model.flat("panel_blue", (0.1, 0.3, 0.9)))
    wall = checker((-6, -0.5, -9), (0.5, 0, 0), (0, 0.5, 0), 24, 8)
    model.add("wall", wall, model.flat("wall_light", (0.8, 0.8, 0.8)), model.flat("wall_dark", (0.08, 0.08, 0.1)))
    orthographic = {"name": "orthographic", "position": [0, 1, 2], "target": [0, 1, -5], "orthographic_height": 4.4,
                    "near": 0.1, "far": 100}
    return model, scene_json([camera("tele", (0, 1, 60), (0, 1, -5), 3.8, near=50),
                              camera("persp", (0, 1, 2), (0, 1, -5), 45), orthographic])


def depth_range():
    model = Model()
    mirror = model.mirror()
    for k, d in enumerate((0.002, 0.1, 1, 100, 1e4, 5e5)):
        x = (k - 2.5) * 0.2 * d
        model.add(f"plate{k}", rectangle((x, -0.25 * d, -d), (0, 0, 0.35 * d), (0.085 * d, 0, 0)), mirror)
        add_box(model, f"box{k}", hue(k / 6), (x, -0.13 * d, -1.1 * d), (0.05 * d, 0.12 * d, 0.01 * d))
    main = camera("main", (0, 0, 0), (0, -0.2, -1), 40, near=1e-3, far=1e6)
    return model, scene_json([main], environment=(0.05, 0.05, 0.08))
