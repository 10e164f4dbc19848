"""What several scenes stand on: the mirror floor, boxes of their own hue, the black and white wall."""
import colorsys

from .shapes import checker_wall, floor, unit_box

BOX = unit_box()


def hue(fraction, value=1.0):
    return colorsys.hsv_to_rgb(fraction, 0.85, value)


def add_box(model, name, color, center, half_size):
    model.add(name, BOX, model.flat(name, color), at=center, scale=half_size)


def add_mirror_floor(model):
    """40 x 40 m around (0, 0, -10)."""
    model.add("floor", floor(-20, 20, -30, 10), model.mirror())


def reflector(model, roughness):
    """A mirror, or above roughness 0 (perceptual) the same metal, roughened."""
    if roughness == 0:
        return model.mirror()
    return model.surface(f"metal_r{round(100 * roughness):02}", (0.95, 0.95, 0.95), 1.0, roughness)


def add_checker_wall(model, width, height, z, cell, light=(0.8, 0.8, 0.8), dark=(0.08, 0.08, 0.1)):
    wall = checker_wall(width, height, z, cell)
    model.add("wall", wall, model.flat("wall_light", light), model.flat("wall_dark", dark))
