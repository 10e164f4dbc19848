"""The figures.json that the viewer's test collects, and that the figures' test draws."""

SHOT = "mirror_pillars.front.160x90"


def _crop(box, exposure, tone_curve, points):
    return {
        "shot": SHOT,
        "frame": 0,
        "target": "image",
        "box": box,
        "exposure": exposure,
        "tone_curve": tone_curve,
        "points": [{"technique": technique, "point": point} for technique, point in points],
    }


TRACED = [("mcguire_dda", "stride=1"), ("mcguire_dda", "stride=4")]
FIGURES_JSON = {
    "crops": [
        _crop([21, 50, 40, 31], 0.5, "none", [("none", "default"), *TRACED]),
        _crop([120, 50, 40, 31], 1.25, "reinhard", TRACED),
    ]
}
