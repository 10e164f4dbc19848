"""street:N, a street along -z between two rows of houses."""
from ..gltf import Model, tidy
from . import camera
from . import densities as of
from . import street_parts as parts
from .dice import Dice
from .drawn import described, first_seen
from .estimate import Light, View
from .finishes import Finishes
from .lamps import PI
from .layout import overlaps
from .moving import LAST
from .rays import SKY, Hit, hit_places
from .shell import panel
from .sky import Sky
from .solids import wire
from .thing import Place, Thing

KERB = 0.12  # m


class Street:
    def __init__(self, name):
        self.dice = dice = Dice(name)
        self.model = Model()
        self.finishes = Finishes(self.model, dice.about("finishes"))
        self.width, self.length = dice.about("width").draw(of.STREET_WIDTH), dice.about("length").draw(of.STREET_LENGTH)
        self.pavement = min(dice.about("pavement").draw(of.PAVEMENT), self.width / 2 - 3)
        self.road = self.width / 2 - self.pavement  # half of its width
        self.sky = Sky(dice.about("sky"), round(dice.about("sun").uniform(0, 360), 2))
        self.is_dusk = self.sky.weather == "dusk"
        self.ground = self.finishes.get(dice.about("ground").draw(of.GROUND), "road", "floors")
        self.kelvin = dice.about("lamps").draw(of.LAMP_WARMTH)
        self.lamps, self.things = [], []
        self.add_houses(dice.about("houses"))
        self.add_lamps(dice.about("lamps"))
        self.cars = self.add_cars(dice.about("cars"))
        self.add_furniture(dice.about("furniture"))
        self.driving = self.add_driving_car(dice.about("driving"))
        self.light = self.lit()
        self.view, self.path, self.glance = self.choose_camera(dice.about("camera"))

    def try_at(self, thing, x, z, yaw, y=KERB):
        place = Place(thing, x, z, yaw, y)
        if any(overlaps((place.low, place.high), (other.low, other.high), 0.05) for other in self.things):
            return None
        self.things.append(place)
        return place

    def add_houses(self, dice):
        """Rows on both sides from behind the camera on, and a house across both ends."""
        for side in (-1, 1):
            z, k = 30.0, 0
            while z > -self.length:
                own = dice.about(f"{side}/{k}")
                width = own.draw(of.HOUSE_WIDTH)
                if not own.chance(of.GAP):
                    thing, _ = parts.house(own, self.finishes, f"house{k % 4}{'l' if side < 0 else 'r'}", width, 9.0,
                                           self.is_dusk, self.kelvin)
                    self.things.append(Place(thing, side * self.width / 2, z - width / 2, 90 if side < 0 else 270, 0.0))
                z, k = z - width, k + 1
        for z, yaw in ((-self.length - 4, 0), (34.0, 180)):
            thing, _ = parts.house(dice.about(f"end{yaw}"), self.finishes, f"end{yaw}", self.width + 14, 9.0,
                                   self.is_dusk,
                                   self.kelvin)
            self.things.append(Place(thing, 0.0, z, yaw, 0.0))

    def add_lamps(self, dice):
        distance, height, lumens = dice.draw(of.STREET_LAMPS), dice.uniform(4.0, 7.0), 1000 * dice.draw(of.LAMP_FLUX)
        z, side = 18.0 - dice.uniform(0, 8), dice.one_of((-1, 1))
        while z > -self.length:
            lamp = parts.street_lamp(dice.about("lamp"), self.finishes, height)
            lamp.finish(self.finishes, self.kelvin, lumens, self.is_dusk)
            place = Place(lamp.thing, side * (self.road + 0.35), z, 90 if side < 0 else 270, KERB)
            self.things.append(place)
            if self.is_dusk:  # below a lamp that shines down, three times what one to all sides would give
                self.lamps.append((place.point(lamp.light), 3 * lumens / of.CANDELA))
            z, side = z - distance, -side
        if dice.chance(of.CABLE):
            for k in range(dice.whole(1, 4)):
                z, y = 4.0 - 14 * k - dice.uniform(0, 6), dice.uniform(5.5, 7.5)
                points = [(self.width * (t / 10 - 0.5), y - 0.6 * (1 - (t / 5 - 1) ** 2), z) for t in range(11)]
                thing = Thing("cable")
                thing.put(wire(points, 0.012), self.finishes.get("plastic", "flex"))
                self.things.append(Place(thing, 0.0, 0.0))

    def add_cars(self, dice):
        cars = []
        for side in (-1, 1):
            own = dice.about(f"kerb{side}")
            density, z = own.draw(of.CARS), 14.0
            while z > -self.length + 6 and density > 0.03:
                z -= max(5.2, own.uniform(0.5, 1.5) * 10 / density)
                thing = parts.car(own.about(f"{z}"), self.finishes, f"car{own.whole(0, 5)}", False)
                place = self.try_at(thing, side * (self.road - 1.1), z, 0 if own.chance(0.2) else 180 * (side > 0), 0.0)
                if place:
                    cars.append(place)
        return cars

    def add_furniture(self, dice):
        has_trees = dice.chance(of.TREES)
        density = dice.draw(of.FURNITURE)
        for k in range(int(density * (self.length + 10) / 5)):
            own = dice.about(f"thing{k}")
            side, z = own.one_of((-1, 1)), own.uniform(-self.length, 10)
            make = own.one_of([parts.bench, parts.bin_, parts.bollard, parts.bollard, parts.sign] +
                              [parts.tree] * 3 * has_trees)
            thing = make(own, self.finishes)
            self.try_at(thing, side * (self.road + (0.45 if make is not parts.bench else 0.6)), z, 90
                        if side < 0 else 270)

    def add_driving_car(self, dice):
        """(place, metres that it drives along z), or None."""
        if not dice.chance(of.STREET_MOVES):
            return None
        side = dice.one_of((-1, 1))
        way = side * dice.uniform(5, 13) * LAST
        thing = parts.car(dice.about("car"), self.finishes, "driving", self.is_dusk)
        place = Place(thing, -side * min(1.6, self.road - 3.2) if self.road > 4 else 0.0, dice.uniform(-22, -9), 0
                      if way > 0 else 180,
                      0.0)
        swept = ((place.low[0], place.low[1], min(place.low[2], place.low[2] + way)),
                 (place.high[0], place.high[1], max(place.high[2], place.high[2] + way)))
        if any(overlaps(swept, (other.low, other.high), 0.1) for other in self.things):
            return None
        return place, way, swept

    def lit(self):
        """The sky is seen from half of the facades and the ground; at dusk lit windows and lamps add to it."""
        sky = self.sky
        lamps = sum(strength for _, strength in self.lamps) * 0.1 / (PI * self.width * self.length)
        ambient = 0.5 * sky.radiance + 0.05 * sky.sun / PI + lamps + (0.05 if self.is_dusk else 0.0)
        return Light(self.lamps, sky.to_sun, sky.sun, ambient, sky.radiance)

    def moving_places(self):
        return [self.driving[0]] if self.driving else []

    def cast(self, origin, direction):
        ground = Hit(-origin[1] / direction[1], self.ground, 1) if direction[1] < -1e-6 else None
        return hit_places(self.things + self.moving_places(), origin, direction, ground.distance
                          if ground else 1e30) or \
            ground or Hit(1000.0, SKY, 1)

    def sees_sun(self, point):
        start = tuple(p + 0.02 * d for p, d in zip(point, self.sky.to_sun))
        return hit_places(self.things, start, self.sky.to_sun) is None

    def is_clear(self, point, margin=0.5):
        boxes = [(place.low, place.high) for place in self.things] + ([self.driving[2]] if self.driving else [])
        return not any(all(low[k] - margin < point[k] < high[k] + margin for k in range(3)) for low, high in boxes)

    def choose_camera(self, dice):
        return first_seen(self.views(dice), self)

    def views(self, dice):
        """(view, path) of those that are clear of things."""
        for _ in range(12):
            x = dice.uniform(-1, 1) * (self.width / 2 - 1)
            base = KERB if abs(x) > self.road else 0.0
            eye = (x, base + dice.draw(of.EYE), dice.uniform(-4, 8))
            target = (dice.uniform(-0.9, 0.9) * self.road, dice.uniform(0.2, 2.4), eye[2] - dice.uniform(7, 22))
            view = View(eye, target, dice.draw(of.VFOV))
            keys = camera.path_of(dice, view)
            if all(self.is_clear(point) for point in camera.points_between(keys)):
                yield view, keys

    def surfaces(self):
        """Ground to the far, and pavements on it."""
        thing = Thing("ground")
        far = 160.0
        corners = [(-far, far), (far, far), (far, -far), (-far, -far)]
        thing.put(panel([(x, 0.0, z) for x, z in corners], corners), self.ground)
        places = [Place(thing, 0.0, 0.0)]
        paving = self.finishes.get("paving", "pavement", "floors")
        for side in (-1, 1):
            walk = Thing("pavement")
            middle = side * (self.width / 2 + self.road) / 2
            walk.box(paving, self.pavement, KERB, self.length + 40, (middle, 0, 15 - self.length / 2), bevel=0.02)
            places.append(Place(walk, 0.0, 0.0))
        return places

    def scene(self):
        """(model, scene.json, files beside them)."""
        for place in self.surfaces() + self.things + self.moving_places():
            place.add_to(self.model)
        if self.driving:
            place, way, _ = self.driving
            at = (place.x, place.y, place.z)
            self.model.animate(place.node, "translation", [0, LAST], [at, (at[0], at[1], tidy(at[2] + way))])
        return described(self, [])
