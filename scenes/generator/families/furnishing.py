"""Fills a room by its kind: groups of things that are used together, then what stands and hangs along the walls."""
from . import decoration, fittings, furniture, lamps
from . import densities as of
from .thing import Place


class Furnishing:
    def __init__(self, dice, kind, plan, finishes, layout):
        self.dice, self.kind, self.plan, self.finishes, self.layout = dice, kind, plan, finishes, layout
        self.looked_at = []  # (x, z) of the groups that a photograph would show
        self.lamps = []  # (lamp, place or None, x, y, z, yaw)
        self.hung_over = []  # (x, z) of tables that want a lamp above

    def furnish(self):
        getattr(self, f"furnish_{self.kind}")()
        self.add_windows_things()
        self.add_fillers()
        self.add_ceiling_lamps()
        self.add_wall_things()
        limit = max(0, of.OBJECTS[1] - 4 - len(self.layout.places))
        self.layout.on_tops(lambda dice, space: decoration.clutter(dice, self.finishes, space),
                            self.dice.about("clutter").draw(of.CLUTTER), limit)

    # Groups

    def around(self, use, table, length, width, dice):
        """Chairs along both long sides of a table, and at its ends where it is long."""
        seats = max(1, int((length - 0.1) / 0.62))
        chair = furniture.chair(self.dice.about(f"{use} chairs"), self.finishes, use)
        x, z, yaw = table.x, table.z, table.yaw
        for side in (-1, 1):
            for k in range(seats):
                if dice.chance(0.12):
                    continue
                along = (k - (seats - 1) / 2) * (length - 0.1) / seats
                out = width / 2 + dice.uniform(0.0, 0.22)
                dx, _, dz = table.direction((along, 0, side * out))
                turn = yaw + (180 if side > 0 else 0) + (dice.uniform(-14, 14) if dice.chance(0.5) else 0)
                self.layout.try_at(chair, x + dx, z + dz, round(turn, 1), ignored=[table])
        if length > 1.5 and dice.chance(0.6):
            for side in (-1, 1):
                dx, _, dz = table.direction((side * (length / 2 + 0.1), 0, 0))
                self.layout.try_at(chair, x + dx, z + dz, yaw + (270 if side > 0 else 90), ignored=[table])

    def dining_group(self, use="dining", margin=0.75):
        dice = self.dice.about(use)
        length, height = dice.draw(of.TABLE_LENGTH), dice.draw(of.TABLE_HEIGHT)
        for _ in range(3):
            width = min(length, dice.uniform(0.75, 1.0))
            spot = self.layout.in_the_middle(length + margin, width + 2 * margin, height + 0.2)
            if spot:
                break
            length = max(0.8, 0.75 * length)
        if not spot:
            return False
        x, z, yaw = spot
        if dice.chance(of.HAS_RUG):
            self.layout.flats.append(Place(decoration.rug(dice, self.finishes, length + 0.5, width + 0.9), x, z, yaw))
        table = furniture.table(dice, self.finishes, use, length, width, height)
        self.around(use, self.layout.add(Place(table, x, z, yaw)), length, width, dice)
        self.looked_at.append((x, z))
        self.hung_over.append((x, z, yaw, length))
        return True

    def seating_group(self):
        """Sofa, coffee table before it, armchair, rug; a television opposite where there is room for one."""
        dice = self.dice.about("seating")
        seats = dice.whole(2, 3)
        sofa, width = furniture.sofa(dice, self.finishes, seats)
        found = self.layout.against_wall(sofa, front=1.3)
        if not found:
            sofa, width = furniture.sofa(dice, self.finishes, 1)
            found = self.layout.against_wall(sofa, front=0.9)
        if not found:
            return False
        place, wall, along = found
        n = wall.inward
        depth = place.thing.bounds()[1][2] - place.thing.bounds()[0][2]
        x, z = wall.point(along, depth + 0.38 + 0.3)
        if dice.chance(of.HAS_RUG):
            rug = Place(decoration.rug(dice, self.finishes, min(width + 0.6, wall.length - 0.4), 1.9),
                        *wall.point(along, depth + 0.9),
                        wall.yaw)
            if self.plan.contains(rug.low[0], rug.high[0], rug.low[2], rug.high[2], 0.03):
                self.layout.flats.append(rug)
        round_or_long = dice.uniform(0.8, 1.25)
        coffee = furniture.table(dice, self.finishes, "coffee", round_or_long, 0.58, dice.uniform(0.34, 0.45))
        self.layout.try_at(coffee, x, z, wall.yaw)
        for side in dice.shuffled([-1, 1])[:dice.whole(0, 2)]:
            chair, _ = furniture.sofa(dice.about("armchair"), self.finishes, 1, "armchair")
            ax, az = wall.point(along + side * (width / 2 + 0.55), depth + 0.75)
            self.layout.try_at(chair, ax, az, wall.yaw - side * 90)
        lamp = lamps.standing_lamp(dice.about("lamp"), self.finishes, dice.uniform(1.3, 1.75), "floor_lamp")
        side = dice.one_of((-1, 1))
        stood = self.layout.beside(wall, along, lamp.thing, side, width / 2 + 0.28)
        if stood:
            self.lamps.append((lamp, stood))
            self.add_cable(stood, wall)
        self.looked_at.append((x, z))
        if dice.chance(of.HAS_SCREEN):
            self.media_wall(dice.about("media"), (-n[0], -n[1]))
        return True

    def media_wall(self, dice, inward):
        opposite = [wall for wall in self.plan.walls if wall.inward == inward]
        board = furniture.cupboard(dice, self.finishes, "media", dice.uniform(1.3, 2.0), dice.uniform(0.42, 0.6), 0.42,
                                   foot=dice.uniform(0.06, 0.16))
        found = self.layout.against_wall(board, front=0.5, walls=opposite) or self.layout.against_wall(board, front=0.5)
        if not found:
            return
        place, wall, along = found
        television = decoration.television(dice, self.finishes, dice.uniform(0.9, 1.35))
        x, z = wall.point(along, 0.2)
        self.layout.try_at(television, x, z, wall.yaw, board.tops[0][4] + 0.001)
        self.looked_at.append(wall.point(along, 0.6))

    def add_cable(self, place, wall):
        """From the foot of a lamp to a socket."""
        dice = self.dice.about(f"cable/{place.x}")
        if not dice.chance(of.CABLES):
            return
        low, _ = place.thing.bounds()
        side, back = dice.one_of((-1, 1)) * dice.uniform(0.15, 0.3), low[2] + 0.006
        points = [(0.03, 0.008, -0.02), (side / 2, 0.006, back / 2), (side, 0.008, back + 0.012),
                  (side, 0.14, back + 0.005),
                  (side, 0.3, back)]
        thing = lamps.cable(self.finishes, points)
        self.layout.flats.append(Place(thing, place.x, place.z, place.yaw))

    def desk(self, number):
        dice = self.dice.about(f"desk{number}")
        height = dice.draw(of.TABLE_HEIGHT)
        length = self.dice.about("desks").uniform(1.2, 1.8)
        desk = furniture.table(self.dice.about("desks"), self.finishes, "desk", length, 0.72, height)
        found = self.layout.against_wall(desk, front=0.85)
        if not found:
            return False
        place, wall, along = found
        height = desk.tops[0][4]
        computer = decoration.desk_things(dice, self.finishes, height + 0.001)
        self.layout.places.append(Place(computer, place.x, place.z, place.yaw))
        x, z = wall.point(along + dice.uniform(-0.1, 0.1), 0.72 + dice.uniform(0.05, 0.3))
        chair = furniture.office_chair(self.dice.about("office chairs"), self.finishes)
        self.layout.try_at(chair, x, z, round(wall.yaw + 180 + dice.uniform(-35, 35), 1), ignored=[place])
        if dice.chance(0.6):
            lamp = lamps.standing_lamp(dice.about("lamp"), self.finishes, dice.uniform(0.38, 0.5), "desk_lamp")
            x, z = wall.point(along + dice.one_of((-1, 1)) * (length / 2 - 0.2), 0.22)
            at = Place(lamp.thing, x, z, wall.yaw, height)
            self.layout.add(at)
            self.lamps.append((lamp, at))
        self.looked_at.append((place.x, place.z))
        return True

    # Kinds of rooms

    def furnish_living(self):
        self.seating_group()
        if self.plan.area > 22 and self.dice.about("living").chance(0.6):
            self.dining_group()

    def furnish_dining(self):
        self.dining_group()
        dice = self.dice.about("sideboard")
        board = furniture.cupboard(dice, self.finishes, "side", dice.uniform(1.2, 2.2), dice.uniform(0.7, 0.95), 0.44,
                                   foot=dice.uniform(0.08, 0.2))
        self.layout.against_wall(board)
        if self.plan.area > 24:
            self.seating_group()

    def furnish_kitchen(self):
        dice = self.dice.about("kitchen")
        walls = sorted((w for w in self.plan.walls if not w.doors), key=lambda w: (bool(w.windows), -w.length))
        for wall in walls:
            width = min(wall.length - 1.0, dice.uniform(2.2, 4.2))
            if width < 1.6:
                continue
            row = fittings.kitchen_row(dice, self.finishes, width, not wall.windows)
            found = self.layout.against_wall(row, front=0.9, walls=[wall])
            if found:
                place, _, along = found
                for side in dice.shuffled([-1, 1]):
                    if self.layout.beside(wall, along, fittings.fridge(dice, self.finishes), side, width / 2 + 0.31):
                        break
                self.looked_at.append(wall.point(along, 0.7))
                break
        if dice.chance(0.35):
            length = dice.uniform(1.4, 2.4)
            spot = self.layout.in_the_middle(length + 0.3, 2.2, 0.95)
            if spot:
                island = furniture.cupboard(dice, self.finishes, "island", length, 0.92, 0.9, foot=0.08)
                self.layout.add(Place(island, spot[0], spot[1], spot[2]))
                self.looked_at.append(spot[:2])
                self.hung_over.append((*spot, length))
                return
        self.dining_group("kitchen", margin=0.6)

    def furnish_bedroom(self):
        dice = self.dice.about("bed")
        width = dice.one_of((0.9, 1.4, 1.6, 1.8))
        found = self.layout.against_wall(furniture.bed(dice, self.finishes, width), front=0.4)
        if found:
            place, wall, along = found
            if dice.chance(of.HAS_RUG):
                rug = Place(decoration.rug(dice, self.finishes, width + 1.0, 1.6), *wall.point(along, 1.7), wall.yaw)
                if self.plan.contains(rug.low[0], rug.high[0], rug.low[2], rug.high[2], 0.03):
                    self.layout.flats.append(rug)
            for side in (-1, 1):
                stand = furniture.cupboard(dice.about("night"), self.finishes, "night", 0.45, 0.5, 0.38)
                stood = self.layout.beside(wall, along, stand, side, width / 2 + 0.04 + 0.27)
                if stood:
                    lamp = lamps.standing_lamp(dice.about("lamp"), self.finishes, 0.42, "bedside_lamp")
                    at = self.layout.add(Place(lamp.thing, stood.x, stood.z, stood.yaw, 0.5))
                    self.lamps.append((lamp, at))
            self.looked_at.append((place.x, place.z))
        wardrobe = furniture.cupboard(dice, self.finishes, "wardrobe", dice.uniform(1.0, 2.2), dice.uniform(1.9, 2.2),
                                      0.6)
        self.layout.against_wall(wardrobe, front=0.6)
        if dice.chance(0.5):
            self.desk(0)

    def furnish_office(self):
        made = [self.desk(k) for k in range(self.dice.about("office").whole(1, 4))]
        if self.plan.area > 18 or not any(made):
            self.dining_group("meeting")

    def furnish_bathroom(self):
        dice = self.dice.about("bath")
        width = dice.uniform(0.7, 1.3)
        found = self.layout.against_wall(fittings.washbasin(dice, self.finishes, width), front=0.6)
        if found:
            place, wall, along = found
            mirror = decoration.wall_mirror(dice, self.finishes, width * dice.uniform(0.8, 1.1),
                                            dice.uniform(0.7, 0.95))
            x, z = wall.point(along)
            self.layout.try_at(mirror, x, z, wall.yaw, 1.05)
            self.looked_at.append((place.x, place.z))
        tub = fittings.bathtub(dice, self.finishes)
        found = self.layout.against_wall(tub, front=0.5, covers_windows=True)
        if found:
            self.looked_at.append((found[0].x, found[0].z))
        self.layout.against_wall(fittings.toilet(dice, self.finishes), front=0.5)
        if dice.chance(0.5):
            cupboard = furniture.cupboard(dice, self.finishes, "towels", 0.45, dice.uniform(1.5, 1.9), 0.36)
            self.layout.against_wall(cupboard, front=0.4)

    # Along walls

    def add_windows_things(self):
        dice = self.dice.about("windows")
        for k, wall in enumerate(self.plan.walls):
            has_curtains = dice.about(f"curtains{k}").chance(of.CURTAINS) and self.kind not in ("kitchen", "bathroom")
            for w in wall.windows:
                if w.sill > 0.75 and dice.chance(0.6):
                    heater = fittings.radiator(dice, self.finishes, min(w.right - w.left, 1.6) * 0.85)
                    x, z = wall.point((w.left + w.right) / 2, 0.055)
                    self.layout.try_at(heater, x, z, wall.yaw)
                if not has_curtains:
                    continue
                for side in (-1, 1):
                    wide = min(0.5, 0.22 * (w.right - w.left) + 0.1)
                    edge = w.left - 0.02 if side < 0 else w.right + 0.02
                    cloth = decoration.curtain(dice.about(f"cloth{k}"), self.finishes, wide, w.head + 0.12 - 0.015)
                    x, z = wall.point(edge, 0.1)
                    self.layout.try_at(cloth, x, z, wall.yaw, 0.015)

    def add_fillers(self):
        dice = self.dice.about("fillers")
        length = sum(wall.length for wall in self.plan.walls)
        for k in range(int(length * dice.draw(of.FILLERS))):
            own = dice.about(f"filler{k}")
            kinds = {"bathroom": ["plant", "chair"], "kitchen": ["plant", "shelf", "cupboard", "chair"]}
            kind = own.one_of(kinds.get(self.kind, ["plant", "plant", "shelf", "shelf", "cupboard", "lamp", "armchair",
                                                    "chair",
                                                    "standing_mirror"]))
            if kind == "plant":
                self.layout.against_wall(decoration.plant(own, self.finishes, own.uniform(0.5, 1.7)), gap=0.03, front=0)
            elif kind == "shelf":
                self.layout.against_wall(furniture.shelf(own, self.finishes, own.uniform(0.6, 1.6),
                                                         own.uniform(1.1, 2.2)))
            elif kind == "cupboard":
                self.layout.against_wall(furniture.cupboard(own, self.finishes, "spare", own.uniform(0.7, 1.4),
                                                            own.uniform(0.7, 1.1), 0.42))
            elif kind == "lamp":
                lamp = lamps.standing_lamp(own, self.finishes, own.uniform(1.3, 1.8), "floor_lamp")
                found = self.layout.against_wall(lamp.thing, gap=0.04, front=0)
                if found:
                    self.lamps.append((lamp, found[0]))
                    self.add_cable(found[0], found[1])
            elif kind == "armchair":
                self.layout.against_wall(furniture.sofa(own, self.finishes, 1, "armchair")[0], gap=0.1)
            elif kind == "standing_mirror":
                mirror = decoration.wall_mirror(own, self.finishes, own.uniform(0.4, 0.7), own.uniform(1.5, 1.9))
                self.layout.against_wall(mirror, y=0.001, front=0.4)
            else:
                self.layout.against_wall(furniture.chair(own, self.finishes, "spare"), gap=0.05, front=0.2)

    def add_wall_things(self):
        dice = self.dice.about("wall things")
        if self.kind != "bathroom" and dice.chance(of.HAS_WALL_MIRROR):
            own = dice.about("mirror")
            mirror = decoration.wall_mirror(own, self.finishes, own.uniform(0.5, 1.3), own.uniform(0.6, 1.1))
            self.layout.against_wall(mirror, y=own.uniform(1.0, 1.15), front=0)
        length = sum(wall.length for wall in self.plan.walls if not wall.windows)
        for k in range(int(length * dice.draw(of.PICTURES) + 0.5)):
            own = dice.about(f"picture{k}")
            width, height = own.uniform(0.25, 1.1), own.uniform(0.3, 0.8)
            hung = decoration.picture(own, self.finishes, width, height)
            self.layout.against_wall(hung, y=1.6 - height / 2, front=0)

    # From the ceiling

    def add_ceiling_lamps(self):
        dice = self.dice.about("ceiling")
        kind, height = dice.draw(of.CEILING_LIGHT), self.plan.height
        if kind == "pendants" or self.hung_over and dice.chance(0.5):
            if not self.hung_over:
                self.hung_over.append((self.plan.width / 2, self.plan.depth / 2, 0, 0))
            for x, z, yaw, length in self.hung_over:
                over_table = length > 0
                drop = min(height - (1.45 if over_table else 2.1), height - 1.4)
                count = max(1, min(4, round(length / 0.8))) if over_table and dice.chance(0.55) else 1
                for k in range(count):
                    lamp = lamps.pendant(dice.about("pendant"), self.finishes, drop)
                    step = (k - (count - 1) / 2) * 0.62
                    dx, _, dz = Place(lamp.thing, 0, 0, yaw).direction((step, 0, 0))
                    if not self.plan.contains(x + dx, x + dx, z + dz, z + dz, 0.35):
                        continue
                    at = Place(lamp.thing, x + dx, z + dz, yaw, height)
                    self.layout.add(at)
                    self.lamps.append((lamp, at))
        if kind in ("downlights", "panels"):
            spacing = dice.draw(of.DOWNLIGHT_SPACING) * (1.5 if kind == "panels" else 1)
            columns, rows = max(1, round(self.plan.width / spacing)), max(1, round(self.plan.depth / spacing))
            for i in range(columns):
                for j in range(rows):
                    x, z = (i + 0.5) * self.plan.width / columns, (j + 0.5) * self.plan.depth / rows
                    make = lamps.downlight if kind == "downlights" else lamps.panel
                    lamp = make(self.dice.about("ceiling lamps"), self.finishes)
                    at = Place(lamp.thing, x, z, 0, height)
                    if self.layout.is_free(at.low, at.high, 0.0, 0.05):
                        self.layout.add(at)
                        self.lamps.append((lamp, at))
