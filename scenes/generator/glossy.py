"""Rough reflectors and none at all: roughness_gradient to furnace_sphere."""
from .description import camera, moving, scene_json, shifted
from .gltf import Model
from .normal_texture import bumps_texture, normal_texture
from .parts import BOX, add_box, add_checker_wall, hue, reflector
from .shapes import (along, checker, floor, minus, normalized, random_cells, rectangle, unit_arc, unit_pole,
                     unit_sphere)

SILVER = (0.9, 0.9, 0.9)
DIM_LIGHT, DIM_DARK = (0.05, 0.05, 0.05), (0.02, 0.02, 0.02)


def roughness_gradient():
    model = Model()
    for i in range(12):
        x, roughness = -6 + i, 0.05 * i
        metal = model.surface(f"metal_r{5 * i:02}", SILVER, 1.0, roughness)
        dielectric = model.surface(f"dielectric_r{5 * i:02}", (0.05, 0.05, 0.05), 0.0, roughness)
        model.add(f"metal{i:02}", floor(x, x + 1, -3, 0), metal)
        model.add(f"dielectric{i:02}", floor(x, x + 1, 0, 3), dielectric)
    bars = [model.flat(f"bar{i}", hue(i / 6)) for i in range(6)]
    for i in range(25):
        model.add(f"bar{i:02}", BOX, bars[i % 6], at=(-6 + 0.5 * i, 1, -4), scale=(0.05, 1, 0.05))
    add_checker_wall(model, 16, 4, z=-6, cell=1, light=(0.3, 0.3, 0.3), dark=DIM_DARK)
    return model, scene_json([camera("main", (0, 1.5, 5), (0, 0.6, -4), 55)])


def metal_strips(model, roughnesses, width, z_min, z_max):
    """Side by side, centred on x = 0; returns the x of their middles."""
    left = -width * len(roughnesses) / 2
    for i, roughness in enumerate(roughnesses):
        material = model.surface(f"floor_r{round(100 * roughness)}", SILVER, 1.0, roughness)
        model.add(f"floor{i}", floor(left + i * width, left + (i + 1) * width, z_min, z_max), material)
    return [left + (i + 0.5) * width for i in range(len(roughnesses))]


def add_sparks(model):
    """The floors and the wall of the firefly scenes, and three squares of 2 x 2 cm; returns (x, node) of each."""
    middles = metal_strips(model, (0.15, 0.3, 0.5), 3, -9, 3)
    square, light = rectangle((0, 0, 0), (0.01, 0, 0), (0, 0.01, 0)), model.flat("spark", (5000, 4000, 2500))
    sparks = [(x, model.add(f"spark{i}", square, light, at=(x, 1, -3))) for i, x in enumerate(middles)]
    add_checker_wall(model, 16, 4, z=-9, cell=1, light=DIM_LIGHT, dark=DIM_DARK)
    return sparks


FIREFLY_CAMERA = camera("main", (0, 1.5, 4), (0, 0.4, -3), 50)


def firefly():
    model = Model()
    add_sparks(model)
    return model, scene_json([FIREFLY_CAMERA])


def firefly_moving():
    model = Model()
    for x, node in add_sparks(model):
        # 120 frames: from the middle to the right, to the left and back, at one speed.
        model.animate(node, "translation", (0, 1, 3, 4), [(x + offset, 1, -3) for offset in (0, 1, -1, 0)])
    return model, scene_json([FIREFLY_CAMERA | {"frames": 120}], frame_count=120, frame_rate=30)


def contact_hardening():
    model = Model()
    black, white = model.flat("stripe_dark", (0.02, 0.02, 0.02)), model.flat("stripe_light", (0.9, 0.9, 0.9))
    for i, middle in enumerate(metal_strips(model, (0.1, 0.2, 0.35), 2, -6, 4)):
        for stripe in range(4):
            model.add(f"board{i}_{stripe}", BOX, white if stripe % 2 else black,
                      at=(middle - 0.525 + 0.35 * stripe, 1, -3), scale=(0.175, 1, 0.1))
    return model, scene_json([camera("main", (0, 1.3, 3), (0, 0.3, -2.2), 45)])


def glossy_stretch():
    model = Model()
    ball, lamp = unit_sphere(24, 48), model.flat("lamp", (20, 16, 10))
    for i, middle in enumerate(metal_strips(model, (0.1, 0.2, 0.3, 0.4), 3, -24, 4)):
        for z in (-8, -16):
            model.add(f"lamp{i}_{-z}", ball, lamp, at=(middle, 1, z), scale=(0.15, 0.15, 0.15))
    add_checker_wall(model, 24, 4, z=-24, cell=1, light=DIM_LIGHT, dark=DIM_DARK)
    return model, scene_json([camera("pitch3", (0, 0.9, 3), (0, 0.45, -6), 40),
                              camera("pitch10", (0, 2, 3), (0, 0.4, -6), 40),
                              camera("pitch30", (0, 6, 2), (0, 0, -8), 40)])


def metal_corner():
    """Floor and side wall meet along the view; each changes its roughness at the same depths, never to that of the
    other, so that neighbouring pixels differ in normal, in roughness, or in both."""
    model = Model()
    copper, silver = (0.95, 0.64, 0.54), SILVER
    z_ends = (2, -1, -3, -6, -11)
    for i, (floor_roughness, wall_roughness) in enumerate(((0.05, 0.3), (0.4, 0.1), (0.1, 0.4), (0.3, 0.05))):
        z_max, z_min = z_ends[i], z_ends[i + 1]
        half = (z_max - z_min) / 2
        metal = model.surface(f"floor_r{round(100 * floor_roughness):02}", copper, 1.0, floor_roughness)
        model.add(f"floor{i}", floor(-8, 2, z_min, z_max), metal)
        metal = model.surface(f"wall_r{round(100 * wall_roughness):02}", silver, 1.0, wall_roughness)
        model.add(f"wall{i}", rectangle((2, 1.2, z_min + half), (0, 0, half), (0, 1.2, 0)), metal)
    posts = ((1.3, -1.8), (-0.2, -2.4), (1.1, -4.2), (-0.9, -4.8), (0.4, -6.5), (1.4, -8), (-1.4, -8.5))
    for i, (x, z) in enumerate(posts):
        add_box(model, f"post{i}", hue(i / 7, value=2.0), (x, 0.5, z), (0.1, 0.5, 0.1))
    add_checker_wall(model, 24, 4, z=-11, cell=1, light=(0.6, 0.6, 0.6), dark=DIM_DARK)
    return model, scene_json([camera("main", (0, 1.5, 3), (1.2, 0.5, -3), 50)])


def normal_mapped():
    model = Model()
    steepest = 0.3
    texture = normal_texture(steepest)
    for i, slope in enumerate((0.02, 0.1, 0.3)):
        material = model.surface(f"wavy_{slope}", (0.02, 0.03, 0.04), 0.0, 0.02)
        model.normal_map(material, texture, slope / steepest)
        x = -4.5 + 3 * i
        strip = floor(x, x + 3, -10, 4)
        # u runs along x, v along z; so the bitangent cross(normal, tangent) runs along -z.
        strip.uvs = [((px + 4.5) / 9, (pz + 10) / 14) for px, _, pz in strip.positions]
        strip.tangents = [(1.0, 0.0, 0.0, 1.0)] * 4
        model.add(f"strip{i}", strip, material)
    for i in range(7):
        add_box(model, f"pillar{i}", hue(i / 7, value=2.0), (-4.2 + 1.4 * i, 1.2, -6), (0.2, 1.2, 0.2))
    add_checker_wall(model, 20, 6, z=-11, cell=1, light=(1.6, 1.6, 1.6), dark=(0.1, 0.1, 0.15))
    main = camera("main", (0, 1.4, 5), (0, 0.6, -5), 45)
    return model, scene_json([main, shifted(main, "dolly", (0, 0, -4), frames=120)])


def curved_metal():
    """Half-pipes (concave) behind columns (convex) of the same roughness, and a mirror ball of few facets."""
    model = Model()
    ground = checker((-6, 0, 3), (0.5, 0, 0), (0, 0, -0.5), 24, 20)
    light, dark = model.flat("ground_light", (0.5, 0.5, 0.5)), model.flat("ground_dark", (0.1, 0.1, 0.12))
    model.add("ground", ground, light, dark)
    column, pipe = unit_pole(48), unit_arc(160, 48, inward=True)
    for i, roughness in enumerate((0.05, 0.15, 0.3)):
        metal = reflector(model, roughness)
        x = -1.3 + 1.8 * i
        model.add(f"column{i}", column, metal, at=(x, 0, -1.5), scale=(0.3, 1, 0.3))
        # An arc's middle is towards +z, and its hollow side there towards -z: it is turned about.
        model.add(f"pipe{i}", pipe, metal, at=(x, 0, -3), scale=(0.8, 1.8, 0.8), rotation=(0, 1, 0, 0))
    model.add("coarse_ball", unit_sphere(8, 12), model.mirror(), at=(-2.9, 0.8, -2.2), scale=(0.8, 0.8, 0.8))
    for i in range(7):
        place = (-3.5 + 1.2 * i, 0.35, -0.6 + 0.4 * (i % 2))
        add_box(model, f"post{i}", hue(i / 7, value=1.5), place, (0.06, 0.35, 0.06))
    add_checker_wall(model, 12, 4, z=-7, cell=1, light=(0.6, 0.6, 0.6), dark=DIM_DARK)
    main = camera("main", (0, 1.7, 3.4), (-0.3, 0.7, -2.5), 48)
    start = camera("start", (-1.2, 1.7, 3.4), (-1.5, 0.7, -2.5), 48)
    return model, scene_json([main, shifted(start, "lateral", (2.4, 0, 0), frames=60)], environment=(0.1, 0.15, 0.25))


def roughness_steps():
    """From left to right: almost mirrors; a checker and random cells of two roughnesses; a ramp across the cut-offs."""
    model = Model()
    for i, roughness in enumerate((0, 0.01, 0.02, 0.04, 0.08)):
        model.add(f"near_mirror{i}", floor(-4 + 0.5 * i, -3.5 + 0.5 * i, -4, 2),
                  model.surface(f"metal_r{round(100 * roughness):02}", SILVER, 1.0, roughness))
    smooth, rough = model.surface("checker_r05", SILVER, 1.0, 0.05), model.surface("checker_r50", SILVER, 1.0, 0.5)
    model.add("checker", checker((-1.5, 0, 2), (0.25, 0, 0), (0, 0, -0.25), 6, 24), smooth, rough)
    # 1 to 2 pixels across and below 1 high where the image is 320 x 180.
    model.add("noise", random_cells((0, 0, -0.8), (0.025, 0, 0), (0, 0, -0.05), 60, 64, 2), smooth, rough)
    model.add("below_noise", floor(0, 1.5, -0.8, 2), rough)
    for i in range(24):
        roughness = 0.4 + 0.02 * i
        model.add(f"ramp{i:02}", floor(1.5 + 0.1 * i, 1.6 + 0.1 * i, -4, 2),
                  model.surface(f"ramp_r{round(100 * roughness)}", SILVER, 1.0, roughness))
    bars = [model.flat(f"bar{i}", hue(i / 6, value=1.5)) for i in range(6)]
    for i in range(21):
        model.add(f"bar{i:02}", BOX, bars[i % 6], at=(-4 + 0.4 * i, 0.9, -4.3), scale=(0.06, 0.9, 0.06))
    add_checker_wall(model, 16, 4, z=-6, cell=1, light=(0.3, 0.3, 0.3), dark=DIM_DARK)
    return model, scene_json([camera("main", (0, 1.5, 4), (0, 0.3, -3), 50)])


# Halton (2, 3) less 1/2: where temporal anti-aliasing samples a pixel, in pixels.
SUB_PIXEL_PLACES = [(0, -1 / 6), (-1 / 4, 1 / 6), (1 / 4, -7 / 18), (-3 / 8, -1 / 18), (1 / 8, 5 / 18),
                    (-1 / 8, -5 / 18), (3 / 8, 1 / 18), (-7 / 16, 7 / 18)]


def rails():
    """Chrome rails over rough ground, and a wire fence behind a bumpy plate. Camera `sub_pixel` stands still but for
    turns of less than a pixel of a 320 x 180 image."""
    model = Model()
    model.add("ground", floor(-5, 5, -6, 2), model.surface("ground", (0.3, 0.25, 0.2), 0.0, 0.9))
    chrome = model.surface("chrome", SILVER, 1.0, 0.05)
    for i in range(6):
        model.add(f"rail{i}", BOX, chrome, at=(-3 + 0.45 * i, 0.1, -1), scale=(0.02, 0.02, 2.5))
    for i in range(4):
        model.add(f"cross_rail{i}", BOX, chrome, at=(-1.9, 0.2, -2.6 + i), scale=(1.4, 0.02, 0.02))
    plate = model.surface("plate", (0.9, 0.9, 0.9), 1.0, 0.02)
    model.normal_map(plate, bumps_texture(128, 0.04), 1)
    bumpy = floor(0.2, 3.4, -3.2, 0, y=0.02)
    bumpy.uvs = [((x - 0.2) / 3.2, (z + 3.2) / 3.2) for x, _, z in bumpy.positions]
    bumpy.tangents = [(1.0, 0.0, 0.0, 1.0)] * 4  # the bitangent cross(normal, tangent) runs along -z
    model.add("plate", bumpy, plate)
    pole, wire = unit_pole(8), model.flat("wire", (3, 2.4, 1))
    for i in range(34):
        model.add(f"wire{i:02}", pole, wire, at=(0.1 + 0.1 * i, 0, -3.4), scale=(0.004, 1.2, 0.004))
    for i in range(6):
        model.add(f"cross_wire{i}", BOX, wire, at=(1.8, 0.2 + 0.2 * i, -3.4), scale=(1.7, 0.004, 0.004))
    add_checker_wall(model, 12, 4, z=-6, cell=0.5, light=(0.8, 0.8, 0.8), dark=(0.05, 0.05, 0.08))
    main = camera("main", (0, 1.3, 2.5), (0, 0.3, -2.5), 45)
    forward = normalized(minus(main["target"], main["position"]))
    right, up = (1, 0, 0), (0, -forward[2], forward[1])
    pixel = 2 * 0.41421356 / 180  # of tan(45 / 2 degrees)
    keys = [(main["position"], along(main["position"], (10, forward), (10 * x * pixel, right), (10 * y * pixel, up)))
            for x, y in SUB_PIXEL_PLACES]
    return model, scene_json([main, moving(main, "sub_pixel", keys, frames=len(keys))], environment=(0.3, 0.35, 0.45))


SUN = {"type": "directional", "direction": [-0.4, -1, -0.3], "irradiance": 3}
ALL_ROUGH = {"environment": (0.6, 0.7, 0.9), "lights": [SUN]}
ALL_ROUGH_CAMERA = camera("main", (0, 1.6, 4), (0, 0.8, -5), 50)


def add_rough_boxes(model):
    model.add("floor", floor(-20, 20, -30, 10), model.surface("floor", (0.5, 0.5, 0.5), 0.0, 0.9))
    for k in range(12):
        material = model.surface(f"box{k:02}", hue(k / 12, value=0.7), 0.0, 1.0 if k % 2 else 0.8)
        half_height = 0.5 + 0.1 * k
        model.add(f"box{k:02}", BOX, material, at=(-5.5 + k, half_height, -5 - k % 3), scale=(0.35, half_height, 0.35))


def all_rough():
    model = Model()
    add_rough_boxes(model)
    return model, scene_json([ALL_ROUGH_CAMERA], **ALL_ROUGH)


def all_rough_mirror_tile():
    """The tile hangs 3 m before the camera, upright, and covers 32 x 32 of 1920 x 1080 pixels."""
    model = Model()
    add_rough_boxes(model)
    pixel = 2 * 3 * 0.46630766 / 1080  # of 2 * 3 m * tan(50 / 2 degrees), the height of the view there
    model.add("tile", rectangle((0, 1.6, 1), (16 * pixel, 0, 0), (0, 16 * pixel, 0)), model.mirror("tile"))
    # Of which it covers 1, 10 and 56 % of an image of 16 : 9: what work shrinks with the reflective part.
    near = [camera(name, (0, 1.6, 4), (0, 1.6, 1), vfov)
            for name, vfov in (("share1", 11.9), ("share10", 3.77), ("share56", 1.583))]
    return model, scene_json([ALL_ROUGH_CAMERA, *near], **ALL_ROUGH)


def sky_only():
    return Model(), scene_json([camera("main", (0, 1.6, 0), (0, 1.6, -1), 50)], environment=(0.3, 0.5, 0.9))


WHITE = (1.0, 1.0, 1.0)
FURNACE_CAMERA = camera("main", (0, 1.7, 3), (0, 1.3, -5), 50, exposure_ev=-1)


def furnace():
    model = Model()
    ball = unit_sphere(32, 64)
    for metalness, y in ((0.0, 0.8), (1.0, 2.3)):
        for k in range(6):
            name = f"{'metal' if metalness else 'dielectric'}_r{20 * k}"
            material = model.surface(name, WHITE, metalness, 0.2 * k)
            model.add(name, ball, material, at=(-3.75 + 1.5 * k, y, -5), scale=(0.6, 0.6, 0.6))
    model.add("floor", floor(-8, 8, -12, 0), model.surface("floor", WHITE, 1.0, 0.1))
    return model, scene_json([FURNACE_CAMERA], environment=WHITE)


def furnace_sphere():
    model = Model()
    metal = model.surface("metal_r20", WHITE, 1.0, 0.2)
    model.add("ball", unit_sphere(32, 64), metal, at=(0, 1.3, -5), scale=(0.6, 0.6, 0.6))
    return model, scene_json([FURNACE_CAMERA], environment=WHITE)
