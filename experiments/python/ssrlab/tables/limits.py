"""Errors as multiples of the information limit of one frame: rows for tables, in the form of a study's files."""

RUNG = "on_screen"  # groundtruth/reference/truth_ladder.h


def _limits(shots):
    """{(shot, target, metric, mask): entry of manifest.json's `truth_ladder`}."""
    return {
        (shot["shot"], rung["target"], rung["metric"], rung["mask"]): rung
        for shot in shots
        for rung in shot.get("truth_ladder", [])
        if rung["rung"] == RUNG and rung.get("value")
    }


def _quotient(numerator, denominator):
    return repr(float(numerator) / denominator) if numerator and denominator and denominator > 0 else ""


def limit_rows(rows, shots):
    """The rows of summary.csv whose limit is known and above 0, divided by it. Interval ends combine the worst ends of both, and so are
    conservative; none if either has none."""
    limits = _limits(shots)
    for row in rows:
        limit = limits.get((row["shot"], row["target"], row["metric"], row["mask"]))
        if limit is None or not row["value"] or limit["value"] <= 0:
            continue
        yield row | {
            "value": _quotient(row["value"], limit["value"]),
            "low": _quotient(row["low"], limit.get("high")),
            "high": _quotient(row["high"], limit.get("low")),
        }
