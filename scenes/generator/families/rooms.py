"""room:N, furnished rooms."""
from ..gltf import Model
from . import camera, furnishing, shell
from . import densities as of
from .dice import Dice
from .drawn import described, first_seen
from .estimate import Light, View
from .finishes import Finishes, grey
from .lamps import PI
from .layout import Layout
from .moving import add_motion
from .rays import hit_places, hit_shell
from .refusals import Refused, judge_objects
from .sky import Sky
from .thing import Place


class Room:
    def __init__(self, name):
        self.dice = dice = Dice(name)
        self.model = Model()
        self.kind = dice.about("kind").draw(of.KIND)
        self.plan = shell.Plan(dice.about("plan"), 0.6 if self.kind == "bathroom" else 1.0)
        shell.add_openings(dice.about("openings"), self.plan)
        self.finishes = Finishes(self.model, dice.about("finishes"))
        self.surfaces = self.draw_surfaces(dice.about("surfaces"))
        self.joinery = shell.joinery(dice.about("joinery"), self.plan, self.finishes)
        self.layout = Layout(dice.about("layout"), self.plan)
        self.furnishing = furnishing.Furnishing(dice.about("furnishing"), self.kind, self.plan, self.finishes,
                                                self.layout)
        self.furnishing.furnish()
        self.things = self.layout.flats + self.layout.places
        judge_objects(len(self.things))
        self.sky = self.draw_sky(dice.about("sky"))
        self.lights = []
        self.light = self.lit(dice.about("light"))
        self.all_places = self.things + self.joinery
        self.view, self.path, self.glance = self.choose_camera(dice.about("camera"))

    def draw_surfaces(self, dice):
        """Finishes of floor, ceiling and each wall."""
        wet = self.kind in ("kitchen", "bathroom")
        group = {"living": "living", "dining": "living", "kitchen": "kitchen", "bathroom": "kitchen"}.get(self.kind,
                                                                                                          "office")
        get = self.finishes.get
        floor = get(dice.draw(of.FLOORS[group]), "floor", "floors")
        ceiling = get("plaster", "ceiling", "ceilings")
        wall = get(dice.draw(of.WET_WALLS if wet else of.WALLS), "wall", "walls")
        accent = get(dice.draw(of.WALLS), "accent", "walls") if dice.chance(0.3) else wall
        one = dice.whole(0, len(self.plan.walls) - 1)
        return floor, ceiling, [accent if k == one else wall for k in range(len(self.plan.walls))]

    def draw_sky(self, dice):
        """The sun shines into the room's largest windows, from at most 60 degrees beside their normal."""
        windowed = [wall for wall in self.plan.walls if wall.windows]
        if not windowed:
            raise Refused("black")
        out = dice.one_of(windowed).inward
        azimuth = {(-1, 0): 0, (0, -1): 90, (1, 0): 180, (0, 1): 270}[out] + dice.uniform(-60, 60)
        return Sky(dice, round(azimuth, 2))

    def lit(self, dice):
        """Puts the lamps' light, and estimates the room's even light: flux times reflectance / absorption."""
        plan, sky = self.plan, self.sky
        is_lit = sky.weather == "dusk" or dice.chance(of.LAMPS_BY_DAY)
        kelvin, flux = dice.draw(of.LAMP_WARMTH), dice.draw(of.ILLUMINANCE) * plan.area
        total = sum(lamp.weight for lamp, _ in self.furnishing.lamps)
        lamps = []
        for lamp, place in self.furnishing.lamps:
            lumens = flux * lamp.weight / total
            spot = lamp.finish(self.finishes, kelvin, lumens, is_lit)
            place.measure()
            at = place.point(lamp.light)
            if spot:
                self.lights.append(spot | {"position": [round(c, 5) for c in at]})
            if is_lit:
                lamps.append((at, lumens / of.CANDELA))
        windows = [(wall, w, (w.right - w.left) * (w.head - w.sill)) for wall in plan.walls for w in wall.windows]
        area = sum(a for _, _, a in windows)
        walls = sum(wall.length for wall in plan.walls) * plan.height
        floor, ceiling, wall_finishes = self.surfaces
        reflectance = (plan.area * (grey(floor.colour) + grey(ceiling.colour)) +
                       walls * grey(wall_finishes[0].colour)) / (2 * plan.area + walls)
        absorbed = (1 - 0.85 * reflectance) * (2 * plan.area + walls) + area
        sun = sum(a * max(0.0, -wall.inward[0] * sky.to_sun[0] - wall.inward[1] * sky.to_sun[2])
                  for wall, _, a in windows) * sky.sun
        entering = sum(strength for _, strength in lamps) + 0.4 * PI * sky.radiance * area
        reflected = 0.85 * reflectance * entering + 0.7 * grey(floor.colour) * sun  # the sun falls on the floor first
        return Light(lamps, sky.to_sun, sky.sun, reflected / (PI * absorbed), sky.radiance)

    # The camera

    def cast(self, origin, direction):
        wall = hit_shell(self.plan, self.surfaces, origin, direction)
        farthest = wall.distance if wall else 1e30
        return hit_places(self.all_places, origin, direction, farthest) or wall

    def sees_sun(self, point):
        direction = self.sky.to_sun
        start = tuple(p + 0.01 * d for p, d in zip(point, direction))
        wall = hit_shell(self.plan, self.surfaces, start, direction)
        if not wall or wall.finish.material >= 0:
            return False
        return hit_places(self.all_places, start, direction, wall.distance) is None

    def is_clear(self, point, margin=0.35):
        x, y, z = point
        if not self.plan.contains(x, x, z, z, margin) or not margin < y < self.plan.height - margin:
            return False
        return not any(all(place.low[k] - margin < point[k] < place.high[k] + margin for k in range(3))
                       for place in self.things)

    def choose_camera(self, dice):
        """The widest free view of what the room is for, of some tries."""
        if not self.furnishing.looked_at:
            raise Refused("camera")
        tries = []
        for _ in range(60):
            x, z = dice.one_of(self.furnishing.looked_at)
            target = (x + dice.uniform(-0.3, 0.3), dice.draw(of.LOOK_AT), z + dice.uniform(-0.3, 0.3))
            # People stand back: near a wall, often in a corner.
            u, v = (dice.uniform(0.0, 0.3) if dice.chance(0.5) else dice.uniform(0.7, 1.0)), dice.uniform()
            if dice.chance(0.5):
                u, v = v, u
            eye = (0.4 + u * (self.plan.width - 0.8), min(dice.draw(of.EYE), self.plan.height - 0.6),
                   0.4 + v * (self.plan.depth - 0.8))
            way = tuple(t - e for t, e in zip(target, eye))
            distance = sum(c * c for c in way) ** 0.5
            if distance < 1.6 or not self.is_clear(eye):
                continue
            hit = self.cast(eye, tuple(c / distance for c in way))
            if hit and hit.distance > 0.55 * distance:
                tries.append((hit.distance, eye, target))
        tries.sort(reverse=True)
        return first_seen(self.views(dice, tries[:6]), self)

    def views(self, dice, tries):
        """(view, path) of those that have a path that is clear."""
        for _, eye, target in tries:
            view = View(eye, target, dice.draw(of.VFOV))
            for _ in range(4):
                keys = camera.path_of(dice, view)
                if all(self.is_clear(point, 0.25) for point in camera.points_between(keys)):
                    yield view, keys
                    break

    # The scene

    def scene(self):
        """(model, scene.json, files beside them)."""
        surfaces = shell.surfaces(self.plan, *self.surfaces)
        storey = float(self.dice.about("outside").draw(of.STOREY).split()[0])
        surfaces.append(shell.outside(self.dice.about("outside"), self.plan, self.finishes, storey))
        places = [Place(thing, 0.0, 0.0) for thing in surfaces] + self.joinery + self.things
        for place in places:
            place.add_to(self.model)
        moves = self.dice.about("moves")
        if moves.chance(of.MOVES):
            add_motion(moves, self)
        return described(self, self.lights)
