"""What rooms and streets are drawn from, all of it: scenes/rooms.md's tables are made of this file (generate.py --fill).

"ours": no statistic was found; chosen by looking at rooms, and corrected where ray statistics said so.
"""
from .dice import quartiles, rate, shares

OURS = "ours"
BOTH, ROOMS, STREETS = "both", "rooms", "streets"

# The plan

KIND = shares(ROOMS, "kind of room", {"living": 0.3, "dining": 0.17, "kitchen": 0.17, "bedroom": 0.1, "office": 0.16,
                                      "bathroom": 0.1}, OURS)
AREA_SIDE = quartiles(ROOMS, "longer side", "m", (3.6, 4.8, 5.6, 6.8, 10), OURS)
SIDE_RATIO = quartiles(ROOMS, "shorter side / longer side", "1", (0.55, 0.68, 0.76, 0.86, 1), OURS)
IS_L = rate(ROOMS, "plan is an L, not a rectangle", 0.2, OURS)
NOTCH = quartiles(ROOMS, "side cut from an L / whole side", "1", (0.25, 0.32, 0.38, 0.44, 0.5), OURS)
HEIGHT = quartiles(ROOMS, "height", "m", (2.4, 2.5, 2.6, 2.8, 3.8),
                   "at least 2.4 m in German building codes; old buildings above 3 m")
WINDOW_SHARE = quartiles(ROOMS, "windows / floor area", "1", (0.09, 0.125, 0.16, 0.22, 0.4),
                         "at least 1/8 in the German Musterbauordnung, section 47")
FLOOR_WINDOW = rate(ROOMS, "a wall's windows reach the floor", 0.25, OURS)
DOORS = shares(ROOMS, "doors", {"1": 0.6, "2": 0.4}, OURS)
STOREY = shares(ROOMS, "floor above the ground", {"0.3 m": 0.4, "3.2 m": 0.35, "9 m": 0.25}, OURS)
CURTAINS = rate(ROOMS, "curtains beside a wall's windows", 0.45, OURS)

# Light. Radiance 1 stands for 100 cd/m^2.

CANDELA = 100.0  # cd/m^2 of a radiance of 1
DAYLIGHT = shares(BOTH, "light outside", {"sun": 0.42, "overcast": 0.28, "dusk": 0.3}, OURS)
SUN = quartiles(BOTH, "illuminance of the sun across its rays", "klx", (25, 50, 70, 85, 100),
                "100 klx at noon, below 30 near the horizon")
SUN_ELEVATION = quartiles(BOTH, "elevation of the sun", "degrees", (8, 20, 30, 42, 58), OURS)
SKY = {"sun": quartiles(BOTH, "luminance of a clear sky", "kcd/m^2", (2, 3, 4, 5.5, 8), OURS),
       "overcast": quartiles(BOTH, "luminance of an overcast sky", "kcd/m^2", (1, 2, 3.5, 5, 8),
                             OURS),
       "dusk": quartiles(BOTH, "luminance of the sky at dusk", "kcd/m^2", (0.002, 0.005, 0.015, 0.04, 0.1), OURS)}
SKY_KIND = shares(BOTH, "sky as scene.json has it", {"image": 0.5, "gradient": 0.3, "constant": 0.2}, OURS)
LAMPS_BY_DAY = rate(ROOMS, "lamps are lit by day", 0.35, OURS)
ILLUMINANCE = quartiles(ROOMS, "lamps' light / floor area", "lm/m^2", (80, 150, 230, 350, 600),
                        "EN 12464-1 asks for 100 to 500 lx on what is looked at")
CEILING_LIGHT = shares(ROOMS, "light from the ceiling", {"pendants": 0.42, "downlights": 0.26, "panels": 0.14,
                                                         "none": 0.18},
                       OURS)
DOWNLIGHT_SPACING = quartiles(ROOMS, "distance of downlights and panels", "m", (1.1, 1.4, 1.6, 1.9, 2.4), OURS)
IS_BARE = rate(ROOMS, "bulbs without a shade", 0.3, OURS)
IS_PUNCTUAL = rate(ROOMS, "downlights are spot lights, not emitting triangles", 0.5, OURS)
LAMP_WARMTH = quartiles(BOTH, "colour temperature of lamps", "K", (2400, 2700, 3000, 3600, 5000),
                        "lamps for homes have 2700 and 3000 K")

# Surfaces

FLOORS = {
    "living": shares(ROOMS, "floor of living and dining rooms",
                     {"parquet": 0.5, "polished_stone": 0.18, "tiles": 0.16, "concrete": 0.06, "carpet": 0.1}, OURS),
    "kitchen": shares(ROOMS, "floor of kitchens and bathrooms",
                      {"parquet": 0.18, "polished_stone": 0.22, "tiles": 0.54, "concrete": 0.06}, OURS),
    "office": shares(ROOMS, "floor of offices and bedrooms",
                     {"parquet": 0.48, "polished_stone": 0.08, "tiles": 0.08, "concrete": 0.12, "carpet": 0.24}, OURS)}
WALLS = shares(ROOMS, "walls", {"plaster": 0.72, "satin_paint": 0.28}, OURS)
WET_WALLS = shares(ROOMS, "walls of kitchens and bathrooms", {"plaster": 0.3, "satin_paint": 0.2, "tiles": 0.5}, OURS)
TOPS = shares(ROOMS, "table tops and worktops", {"wood": 0.4, "lacquer": 0.28, "polished_stone": 0.24,
                                                 "brushed_metal": 0.08},
              OURS)
FRONTS = shares(ROOMS, "fronts of cupboards", {"wood": 0.36, "lacquer": 0.5, "satin_paint": 0.14}, OURS)
LEGS = shares(ROOMS, "legs and handles", {"wood": 0.4, "chrome": 0.25, "brushed_metal": 0.15, "satin_paint": 0.2}, OURS)
SEATS = shares(ROOMS, "seats", {"cloth": 0.62, "leather": 0.22, "plastic": 0.16}, OURS)
ROUGHNESS = {name: quartiles(BOTH, f"roughness of {name.replace('_', ' ')}", "1", values, source)
             for name, values, source in (  # perceptual
    ("polished_stone", (0.03, 0.07, 0.11, 0.17, 0.3), OURS), ("lacquer", (0.04, 0.08, 0.13, 0.22, 0.4), OURS),
    ("parquet", (0.12, 0.22, 0.32, 0.43, 0.65), OURS), ("tiles", (0.05, 0.1, 0.17, 0.28, 0.55), OURS),
    ("concrete", (0.15, 0.25, 0.35, 0.5, 0.8), OURS), ("carpet", (0.9, 0.94, 0.96, 0.98, 1), OURS),
    ("plaster", (0.75, 0.85, 0.9, 0.95, 1), OURS), ("satin_paint", (0.25, 0.35, 0.42, 0.5, 0.65), OURS),
    ("wood", (0.15, 0.28, 0.38, 0.48, 0.7), OURS), ("brushed_metal", (0.15, 0.22, 0.28, 0.35, 0.5), OURS),
    ("chrome", (0.01, 0.03, 0.06, 0.1, 0.18), OURS), ("cloth", (0.8, 0.88, 0.92, 0.96, 1), OURS),
    ("leather", (0.28, 0.36, 0.42, 0.5, 0.6), OURS), ("plastic", (0.15, 0.25, 0.35, 0.45, 0.6), OURS),
    ("leaf", (0.3, 0.4, 0.5, 0.6, 0.75), OURS), ("ceramic", (0.03, 0.06, 0.09, 0.14, 0.3), OURS),
                                          ("screen", (0.05, 0.08, 0.12, 0.2, 0.35), OURS),
    ("mirror", (0, 0, 0.005, 0.01, 0.03), OURS), ("puddles", (0.03, 0.06, 0.12, 0.2, 0.32), OURS),
                                          ("bricks", (0.7, 0.8, 0.86, 0.92, 1), OURS),
    ("bark", (0.85, 0.9, 0.93, 0.96, 1), OURS), ("wet_asphalt", (0.03, 0.06, 0.12, 0.2, 0.32), OURS),
                                          ("paving", (0.4, 0.55, 0.65, 0.75, 0.9), OURS),
    ("car_paint", (0.03, 0.06, 0.1, 0.16, 0.3), OURS))}
LIGHTNESS = {name: quartiles(BOTH, f"reflectance of {name}", "1", values, source) for name, values, source in (
    ("ceilings", (0.7, 0.76, 0.8, 0.84, 0.88), "EN 12464-1: 0.7 to 0.9"),
    ("walls", (0.3, 0.5, 0.62, 0.73, 0.82), "EN 12464-1: 0.5 to 0.8; some are dark"),
    ("floors", (0.06, 0.14, 0.22, 0.34, 0.6), "EN 12464-1: 0.2 to 0.4; some are dark or light"),
    ("furniture", (0.03, 0.14, 0.28, 0.5, 0.8), "EN 12464-1: 0.2 to 0.7; some is black"))}

# What stands in rooms

TABLE_HEIGHT = quartiles(ROOMS, "height of tables", "m", (0.71, 0.73, 0.74, 0.75, 0.77), "EN 527: 0.74 m")
TABLE_LENGTH = quartiles(ROOMS, "length of dining tables", "m", (0.9, 1.4, 1.7, 2, 2.8), OURS)
TABLE_LEGS = shares(ROOMS, "legs of tables", {"square": 0.4, "round": 0.25, "frame": 0.2, "pedestal": 0.15}, OURS)
SEAT_HEIGHT = quartiles(ROOMS, "height of seats", "m", (0.42, 0.44, 0.45, 0.46, 0.48), "EN 1335, EN 1729: 0.4 to 0.5 m")
CHAIR_KIND = shares(ROOMS, "chairs", {"legs": 0.5, "wire": 0.25, "shell": 0.25}, OURS)
WORKTOP_HEIGHT = quartiles(ROOMS, "height of worktops", "m", (0.85, 0.88, 0.9, 0.92, 0.95), "EN 1116: 0.85 and 0.9 m")
FILLERS = quartiles(ROOMS, "further things along the walls / m of wall", "1/m", (0.1, 0.25, 0.35, 0.45, 0.7), OURS)
CLUTTER = quartiles(ROOMS, "small things on tops", "1/m^2", (0, 2, 4, 7, 14),
                    "SUN RGB-D has 14.2 objects a picture (Song et al. 2015)")
HAS_RUG = rate(ROOMS, "rug under seats or a bed", 0.4, OURS)
HAS_WALL_MIRROR = rate(ROOMS, "mirror on a wall (bathrooms: always)", 0.4, OURS)
HAS_SCREEN = rate(ROOMS, "television in a living room", 0.7, OURS)
SCREEN_IS_ON = rate(ROOMS, "a screen is on", 0.4, OURS)
PICTURES = quartiles(ROOMS, "pictures / m of free wall", "1/m", (0, 0.1, 0.2, 0.35, 0.7), OURS)
CABLES = rate(ROOMS, "a cable from a lamp or screen to the wall", 0.6, OURS)
MOVES = rate(ROOMS, "something moves", 0.5, OURS)
OBJECTS = (10, 80)  # least and most in a room; others are refused

# The camera

EYE = quartiles(BOTH, "height of the eye", "m", (1.0, 1.2, 1.4, 1.55, 1.72),
                "standing eyes 1.43 to 1.75 m (DIN 33402-2); interiors are photographed from 1 to 1.5 m")
LOOK_AT = quartiles(ROOMS, "height of what is looked at", "m", (0.35, 0.55, 0.7, 0.85, 1.2), OURS)
VFOV = quartiles(BOTH, "vertical field of view", "degrees", (34, 42, 48, 54, 64),
                 "lenses of 39 to 19 mm on 36 x 24 mm film")
PATH = shares(BOTH, "path of the camera", {"forward": 0.3, "sideways": 0.3, "turn": 0.2, "arc": 0.2}, OURS)
PATH_LENGTH = quartiles(BOTH, "length of the path", "m", (0.2, 0.4, 0.6, 0.9, 1.6), "walking at 1.2 m/s takes 1.6 m")
PATH_TURN = quartiles(BOTH, "turn of the camera", "degrees", (4, 8, 12, 20, 36), OURS)

# Streets

STREET_WIDTH = quartiles(STREETS, "between the facades", "m", (9, 13, 16, 20, 30), OURS)
STREET_LENGTH = quartiles(STREETS, "length", "m", (50, 70, 90, 110, 150), OURS)
GAP = rate(STREETS, "a gap in place of a house", 0.12, OURS)
PAVEMENT = quartiles(STREETS, "width of pavements", "m", (1.6, 2.2, 2.6, 3.2, 4.5), OURS)
HOUSE_WIDTH = quartiles(STREETS, "width of a house", "m", (6, 9, 12, 16, 26), OURS)
HOUSE_STOREYS = quartiles(STREETS, "storeys", "1", (1, 2.5, 3.5, 4.5, 7), OURS)
STOREY_HEIGHT = quartiles(STREETS, "height of a storey", "m", (2.8, 3, 3.2, 3.5, 4.2), OURS)
FACADES = shares(STREETS, "facades", {"plaster": 0.5, "bricks": 0.3, "concrete": 0.2}, OURS)
SHOP = rate(STREETS, "a house has a shop", 0.35, OURS)
LIT_WINDOW = rate(STREETS, "a window is lit at dusk", 0.3, OURS)
GROUND = shares(STREETS, "ground", {"wet_asphalt": 0.6, "puddles": 0.25, "polished_stone": 0.15},
                "wet: dry streets reflect nothing, and are refused")
CARS = quartiles(STREETS, "cars / 10 m of kerb", "1", (0, 0.4, 0.7, 1, 1.4), OURS)
STREET_LAMPS = quartiles(STREETS, "distance of lamps", "m", (14, 18, 22, 26, 34), OURS)
LAMP_FLUX = quartiles(STREETS, "light of a street lamp", "klm", (2, 4, 6, 9, 15), OURS)
TREES = rate(STREETS, "trees", 0.45, OURS)
CABLE = rate(STREETS, "wires across the street", 0.5, OURS)
FURNITURE = quartiles(STREETS, "benches, bins, bollards, signs / 10 m of kerb", "1", (0, 0.5, 0.9, 1.4, 2.5), OURS)
STREET_MOVES = rate(STREETS, "a car drives", 0.6, OURS)
