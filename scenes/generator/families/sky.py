"""Sun and sky: scene.json's environment, of an image in OpenEXR where one is drawn."""
import struct

from ..shapes import cosine, normalized, sine
from . import densities as of
from .noise import noise

WIDTH, HEIGHT = 128, 64


def exr(width, height, pixels):
    """OpenEXR 2 of three channels of half floats, not compressed. `pixels`: rows of (r, g, b)."""
    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(data)) + data

    channels = b"".join(name + b"\0" + struct.pack("<IIII", 1, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = (struct.pack("<II", 20000630, 2) + attribute("channels", "chlist", channels) +
              attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", window) +
              attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0") +
              attribute("pixelAspectRatio", "float", struct.pack("<f", 1)) +
              attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)) +
              attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    size = 8 + 6 * width
    offsets = b"".join(struct.pack("<Q", len(header) + 8 * height + size * j) for j in range(height))
    lines = []
    for j, row in enumerate(pixels):
        values = [struct.pack(f"<{width}e", *(colour[c] for colour in row)) for c in (2, 1, 0)]
        lines.append(struct.pack("<iI", j, 6 * width) + b"".join(values))
    return header + offsets + b"".join(lines)


class Sky:
    """`azimuth`: of the sun, in degrees from +x towards +z."""

    def __init__(self, dice, azimuth):
        self.weather, self.kind = dice.draw(of.DAYLIGHT), dice.draw(of.SKY_KIND)
        self.radiance = dice.draw(of.SKY[self.weather]) * 1000 / of.CANDELA  # mean of the upper half
        self.azimuth, self.elevation = azimuth, dice.draw(of.SUN_ELEVATION)
        c = cosine(self.elevation)
        self.to_sun = (c * cosine(azimuth), sine(self.elevation), c * sine(azimuth))
        self.sun = dice.draw(of.SUN) * 1000 / of.CANDELA if self.weather == "sun" else 0.0
        self.seed = int(dice.uniform(0, 1 << 30))
        blue = {"sun": (0.62, 0.95, 1.55), "overcast": (0.95, 1.0, 1.06), "dusk": (0.75, 0.85, 1.4)}[self.weather]
        self.colour = tuple(self.radiance * c for c in blue)

    def image(self):
        """Brighter at the horizon where it is clear, at the zenith where overcast; clouds; the sun's glow."""
        clouds = noise(self.seed, WIDTH, (4, 8), 4)
        rows = []
        for j in range(HEIGHT):
            theta = 180 * (j + 0.5) / HEIGHT
            y, r = cosine(theta), sine(theta)
            row = []
            for i in range(WIDTH):
                phi = 360 * ((i + 0.5) / WIDTH - 0.5)
                d = (r * cosine(phi), y, r * sine(phi))
                if y < 0:
                    row.append(tuple(0.25 * c for c in self.colour))
                    continue
                up = 0.7 + 0.6 * y if self.weather == "overcast" else 1.25 - 0.6 * y
                cloud = min(1.0, max(0.0, 4 * (clouds[j][i] - 0.5))) * min(1.0, 6 * y)
                near = 1 - sum(a * b for a, b in zip(d, self.to_sun))
                glow = (0.08 / (0.02 + near)) if self.weather != "overcast" else 0.0
                white = 1.6 * self.radiance if self.weather != "dusk" else 0.5 * self.radiance
                row.append(tuple(c * up * (1 - cloud) + white * cloud + glow * self.radiance * w
                                 for c, w in zip(self.colour, (1.2, 1.0, 0.7))))
            rows.append(row)
        return exr(WIDTH, HEIGHT, rows)

    def description(self):
        """(scene.json's environment, its lights, files to write beside it)."""
        lights = []
        if self.sun:
            warm = min(1.0, 0.45 + self.elevation / 60)
            lights = [{"type": "directional", "direction": [round(-c, 6) for c in normalized(self.to_sun)],
                       "irradiance": round(self.sun, 3), "color": [1.0, round(0.6 + 0.35 * warm, 4),
                                                                   round(0.3 + 0.6 * warm, 4)]}]
        colour = [round(c, 5) for c in self.colour]
        if self.kind == "image":
            return {"image": "sky.exr"}, lights, {"sky.exr": self.image()}
        if self.kind == "gradient":
            slope = [round(-0.45 * c if self.weather != "overcast" else 0.5 * c, 5) for c in self.colour]
            return {"gradient": {"color": colour, "slope": slope, "axis": [0, 1, 0]}}, lights, {}
        return {"constant": colour}, lights, {}
