"""Perfect mirrors, to find out where rays end: mirror_pillars to dark_room."""
from .description import camera, orbiting, scene_json, shifted
from .gltf import Model
from .parts import BOX, add_box, add_checker_wall, add_mirror_floor, hue, reflector
from .shapes import (checker, checker_wall, cosine, floor, rectangle, sine, unit_arc, unit_box, unit_disc, unit_pole,
                     unit_sphere)


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


def hidden_faces():
    """Left a mirror floor below a table and a ball; right a wall mirror behind things that face away from it."""
    model = Model()
    model.add("floor", floor(-4, 0, -5, 2), model.mirror())
    add_box(model, "table_top", (0.7, 0.7, 0.6), (-1.5, 0.77, -2.6), (0.8, 0.02, 0.5))
    add_box(model, "table_underside", (0.9, 0.3, 0.05), (-1.5, 0.74, -2.6), (0.8, 0.01, 0.5))
    leg = model.flat("leg", (0.1, 0.3, 0.8))
    for i, (x, z) in enumerate(((-2.2, -3), (-0.8, -3), (-2.2, -2.2), (-0.8, -2.2))):
        model.add(f"leg{i}", BOX, leg, at=(x, 0.365, z), scale=(0.03, 0.365, 0.03))
    ball = model.flat("ball", (0.1, 0.7, 0.2))
    model.add("ball", unit_sphere(24, 48), ball, at=(-2.4, 0.35, -1), scale=(0.35, 0.35, 0.35))
    wall = checker((-4, 0, -5), (0.5, 0, 0), (0, 0.5, 0), 8, 5)
    model.add("wall", wall, model.flat("wall_light", (0.8, 0.8, 0.8)), model.flat("wall_dark", (0.08, 0.08, 0.1)))

    model.add("ground", floor(0, 4, -5, 2), model.flat("ground", (0.15, 0.13, 0.1)))
    model.add("wall_mirror", rectangle((2, 1.25, -4.5), (2, 0, 0), (0, 1.25, 0)), model.mirror())
    # A cup that lies with its opening towards the wall mirror: the camera sees its bottom, the mirror its inside.
    lying = (sine(-45), 0, 0, cosine(-45))
    outside, inside = model.flat("cup_outside", (0.1, 0.3, 0.9)), model.flat("cup_inside", (0.9, 0.6, 0.05))
    for name, shape, material, radius in (("outside", unit_arc(360, 32, inward=False), outside, 0.4),
                                          ("inside", unit_arc(360, 32, inward=True), inside, 0.37),
                                          ("bottom_outside", unit_disc(32, up=False), outside, 0.4),
                                          ("bottom_inside", unit_disc(32, up=True), inside, 0.37)):
        z = -2.42 if name == "bottom_inside" else -2.4
        model.add(f"cup_{name}", shape, material, at=(0.8, 0.45, z), scale=(radius, 0.8, radius), rotation=lying)
    # A box without its near side, which faces inwards alone: black from without, and so in the mirror.
    lit = model.flat("inside_out", (0.8, 0.1, 0.6))
    for name, center, half_u, half_v in (("back", (2, 0.5, -2.9), (0.4, 0, 0), (0, 0.4, 0)),
                                         ("left", (1.6, 0.5, -2.5), (0, 0, -0.4), (0, 0.4, 0)),
                                         ("right", (2.4, 0.5, -2.5), (0, 0, 0.4), (0, 0.4, 0)),
                                         ("bottom", (2, 0.1, -2.5), (0, 0, 0.4), (0.4, 0, 0)),
                                         ("top", (2, 0.9, -2.5), (0.4, 0, 0), (0, 0, 0.4))):
        model.add(f"inside_out_{name}", rectangle(center, half_u, half_v), lit)
    # Shines towards the camera alone.
    model.add("panel", rectangle((3.2, 0.7, -2.6), (0.35, 0, 0), (0, 0.5, 0)), model.flat("panel", (2, 2, 1.6)))
    return model, scene_json([camera("main", (0, 2.6, 3), (0, 0.5, -3), 48)])


def corridor():
    """`wide` has the floor 0.2 m below it, and passes it to behind the camera at the lower border."""
    model = Model()
    model.add("floor", floor(-1.5, 1.5, -24, 8), model.mirror())
    light, dark = model.flat("wall_light", (0.5, 0.45, 0.4)), model.flat("wall_dark", (0.06, 0.06, 0.08))
    model.add("left", checker((-1.5, 0, 8), (0, 0, -1), (0, 1, 0), 32, 3), light, dark)
    model.add("right", checker((1.5, 0, -24), (0, 0, 1), (0, 1, 0), 32, 3), light, dark)
    end_light, end_dark = model.flat("end_light", (2, 1.6, 0.4)), model.flat("end_dark", (0.1, 0.2, 0.6))
    model.add("end", checker_wall(3, 3, -24, 0.5), end_light, end_dark)
    pole = unit_pole()
    for i in range(8):
        lean = 50 if i % 2 else -50  # degrees to either side
        material = model.flat(f"pole{i}", hue(i / 8, value=1.5))
        # Their feet end 2 cm below the floor, whose mirror image would show a gap.
        model.add(f"pole{i}", pole, material, at=(1.2 if i % 2 else -1.2, -0.02, -3 - 1.5 * i),
                  scale=(0.015, 2.8, 0.015), rotation=(0, 0, sine(lean / 2), cosine(lean / 2)))
    main = camera("main", (0, 1.4, 2), (0, 0.8, -6), 45)
    wide = camera("wide", (0, 0.2, 0), (0, -0.9, -1.2), 100, near=0.02)
    return model, scene_json([main, shifted(main, "dolly", (0, 0, -8), frames=60), wide])


def dark_room():
    """Closed but for a window, through which the sky is seen that the fallback shows everywhere."""
    model = Model()
    for i, roughness in enumerate((0, 0.1, 0.3)):
        material = reflector(model, roughness)
        model.add(f"floor{i}", floor(-3 + 2 * i, -1 + 2 * i, -7, 3), material)
    paint = model.flat("paint", (0.02, 0.018, 0.015))
    for name, center, half_u, half_v in (("left", (-3, 1.5, -2), (0, 0, -5), (0, 1.5, 0)),
                                         ("right", (3, 1.5, -2), (0, 0, 5), (0, 1.5, 0)),
                                         ("behind", (0, 1.5, 3), (-3, 0, 0), (0, 1.5, 0)),
                                         ("ceiling", (0, 3, -2), (3, 0, 0), (0, 0, 5)),
                                         ("end_left", (-2, 1.5, -7), (1, 0, 0), (0, 1.5, 0)),
                                         ("end_right", (2, 1.5, -7), (1, 0, 0), (0, 1.5, 0)),
                                         ("end_below", (0, 0.4, -7), (1, 0, 0), (0, 0.4, 0)),
                                         ("end_above", (0, 2.6, -7), (1, 0, 0), (0, 0.4, 0))):
        model.add(name, rectangle(center, half_u, half_v), paint)
    for i, (x, z) in enumerate(((-2.2, -4), (-0.5, -4.6), (1, -3.6), (2.3, -4.4))):
        add_box(model, f"box{i}", hue(i / 4, value=0.3), (x, 0.4, z), (0.25, 0.4, 0.25))
    main = camera("main", (0, 1.6, 2.5), (0, 0.5, -4), 50, exposure_ev=1)
    return model, scene_json([main], environment=(2, 2.4, 3))
