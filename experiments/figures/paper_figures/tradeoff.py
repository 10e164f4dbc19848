"""What `ssrlab tradeoff` wrote of these results, as far as it is of the same errors (experiments/tradeoff/README.md)."""

import math

FRONT, FITS = "tradeoff/front.csv", "tradeoff/fits.csv"


def judged(results, shot, errors):
    """{(variant, point): row of front.csv} of the shot; {} where a point of `errors` ({(variant, point): Measured}) is not in it, or has
    another error there."""
    rows = {(r["variant"], r["point"]): r for r in results.read_csv(FRONT, is_optional=True) if r["shot"] == shot}
    is_same = all(k in rows and rows[k]["error"] and math.isclose(float(rows[k]["error"]), e.value, rel_tol=1e-6) for k, e in errors.items())
    return rows if is_same else {}
