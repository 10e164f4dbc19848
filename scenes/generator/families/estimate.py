"""What a camera would see, estimated by one ray a pixel of a small grid among the bounds of parts: first surfaces,
lamps without shadows, the sun with them, and an even light of all reflections, as in an integrating sphere."""
from dataclasses import dataclass

from ..shapes import cosine, cross, minus, normalized, sine
from .finishes import grey
from .lamps import PI

COLUMNS, ROWS = 24, 14
REFLECTIVE = 0.35  # perceptual roughness, as in the README's column of ray shares


@dataclass
class View:
    """A camera in the scene."""
    eye: tuple
    target: tuple
    vfov: float

    def rays(self, aspect=16 / 9):
        back = normalized(minus(self.eye, self.target))
        right = normalized(cross((0.0, 1.0, 0.0), back))
        up = cross(back, right)
        tall = sine(self.vfov / 2) / cosine(self.vfov / 2)
        for j in range(ROWS):
            for i in range(COLUMNS):
                x, y = aspect * tall * (2 * (i + 0.5) / COLUMNS - 1), tall * (1 - 2 * (j + 0.5) / ROWS)
                yield normalized(tuple(x * r + y * u - b for r, u, b in zip(right, up, back)))


@dataclass
class Light:
    """What lights the scene: lamps (place, lumens / CANDELA), the sun, and the mean radiance of reflected light."""
    lamps: list
    to_sun: tuple
    sun: float  # irradiance
    ambient: float
    sky: float  # radiance


def radiance(hit, eye, direction, light, sees_sun):
    """Of the surface that was hit."""
    if hit.finish.material < 0:
        return light.sky
    if any(hit.finish.radiance):
        return grey(hit.finish.radiance)
    point = tuple(e + hit.distance * d for e, d in zip(eye, direction))
    sign = -1.0 if direction[hit.axis] > 0 else 1.0
    irradiance = PI * light.ambient
    for place, strength in light.lamps:
        way = minus(place, point)
        square = sum(c * c for c in way) + 0.01
        facing = sign * way[hit.axis]
        if facing > 0:
            irradiance += strength * facing / (4 * PI * square ** 0.5 * square)
    facing = sign * light.to_sun[hit.axis]
    if light.sun and facing > 0 and sees_sun(point):
        irradiance += light.sun * facing
    # A metal shows what it mirrors, a dielectric a twentieth of it.
    diffuse = grey(hit.finish.colour) * (1 - hit.finish.metalness) * irradiance / PI
    return diffuse + (grey(hit.finish.colour) * hit.finish.metalness + 0.05) * light.ambient


@dataclass
class Glance:
    """One estimate: per ray the radiance, and what was hit."""
    radiances: list
    hits: list

    def share(self, is_so):
        return sum(map(is_so, self.hits)) / len(self.hits)

    def exposure(self):
        """ev by which the median becomes a quarter."""
        middle, ev = sorted(self.radiances)[len(self.radiances) // 2], 0.0
        while middle * 2.0 ** ev < 0.21 and ev < 12:
            ev += 0.25
        while middle * 2.0 ** ev > 0.25 and ev > -12:
            ev -= 0.25
        return ev


def glance(view, cast, light, sees_sun):
    """`cast(origin, direction)`: a Hit, or None where a ray leaves the scene unseen."""
    radiances, hits = [], []
    for direction in view.rays():
        hit = cast(view.eye, direction)
        if hit is None:
            return None
        hits.append(hit)
        radiances.append(radiance(hit, view.eye, direction, light, sees_sun))
    return Glance(radiances, hits)
