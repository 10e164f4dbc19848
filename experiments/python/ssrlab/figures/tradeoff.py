"""What `ssrlab tradeoff` wrote of these results, if it used the same errors (experiments/results/tradeoff/README.md)."""

import math

from ssrlab.csv_files import number
from ssrlab.mistakes import ResultsError
from ssrlab.results import representative_rows

FRONT, FITS, ACROSS, CHANGES = (f"tradeoff/{name}.csv" for name in ("front", "fits", "across", "stages"))


def judged(results, shot, errors):
    """{(technique, point): row of front.csv} of the shot; {} if a point of `errors` ({(technique, point): Measured}) is missing or has
    another error there."""
    rows = {(r["technique"], r["point"]): r for r in results.read_csv(FRONT, is_optional=True) if r["shot"] == shot}
    is_same = all(k in rows and (error := number(rows[k], "error")) and math.isclose(error, e.value, rel_tol=1e-6) for k, e in errors.items())
    return rows if is_same else {}


def require_primary(results, file):
    """Fails unless answers of `ssrlab tradeoff` exist for the study's primary error with these results' values."""
    run, primary = f"run `ssrlab tradeoff {results.folder}`", results.manifest.get("primary", {})
    front = results.read_csv(FRONT, is_optional=True)
    if not front or not results.read_csv(file, is_optional=True):
        raise ResultsError(f"{file} is missing: {run}")
    rows = representative_rows(results.read_csv("summary.csv"))
    errors = {(r["shot"], r["technique"], r["point"]): number(r, "value") for r in rows if all(r[k] == primary.get(k) for k in ("metric", "mask", "target"))}
    for row in front:
        error, judged_error = errors.get((row["shot"], row["technique"], row["point"])), number(row, "error")
        if judged_error and (not error or not math.isclose(judged_error, error, rel_tol=1e-6)):
            raise ResultsError(f"{FRONT} is not of the study's primary error, {primary.get('metric')} of {primary.get('target')}, as these results have it: {run}")
