"""Points of a study by their parameter values: points that differ in one parameter form a line, in two a map."""

import json

from ssrlab.figures import numbers, style
from ssrlab.figures.request import near
from ssrlab.mistakes import ResultsError


def _listed(value):
    return value if isinstance(value, list) else [value]


def is_inside(technique, parameters, where):
    """`where`: parameter (or "technique") to the value, or array of values, that count."""
    return all((technique if k == "technique" else parameters.get(k)) in _listed(wanted) for k, wanted in where.items())


def _words(parameters):
    return frozenset((name, json.dumps(value)) for name, value in parameters.items())


def families(results, chosen, axes):
    """{name: {values of the parameters `axes`: (technique, point)}} of the points that differ in these alone, with two values or more of
    each. The name says what distinguishes the families."""
    where = chosen.option("where", {})
    if not isinstance(where, dict):
        raise ResultsError(f"{chosen.where}: 'where' must be an object, not {json.dumps(where)}")
    known = {name for entry in results.techniques.values() for name in entry.get("parameters", {})}
    for name in [*axes, *(k for k in where if k != "technique")]:
        if name not in known:
            raise ResultsError(f"{chosen.where}: no point has the parameter '{name}'{near(name, known)}")
    measured = {(r["technique"], r["point"]) for r in results.errors or results.times}
    found = {}
    for (technique, point), entry in results.techniques.items():
        parameters = entry.get("parameters", {})
        if (technique, point) not in measured or not all(a in parameters for a in axes) or not is_inside(technique, parameters, where):
            continue
        rest = (technique, _words({k: v for k, v in parameters.items() if k not in axes}))
        found.setdefault(rest, {}).setdefault(tuple(parameters[a] for a in axes), (technique, point))
    found = {rest: points for rest, points in found.items() if all(len({v[i] for v in points}) > 1 for i in range(len(axes)))}
    if not found:
        raise ResultsError(f"{chosen.where}: no two points differ in {' and '.join(axes)} alone{' where ' + json.dumps(where) if where else ''}")
    return {_name(results, rest, list(found)): points for rest, points in found.items()}


def _name(results, rest, every):
    """technique, and the parameters whose values differ among the families of that technique."""
    technique, words = rest
    own = [w for v, w in every if v == technique]
    common = frozenset.intersection(*own)
    values = [f"{name} = {value_text(json.loads(value))}" for name, value in sorted(words - common)]
    techniques = {v for v, _ in every}
    name = results.labels.get(technique, technique)
    return ", ".join(([name] if len(techniques) > 1 or not values else []) + values)


def axis_values(families_found, index):
    """All values of the index-th parameter: in their order, if they are numbers."""
    values = dict.fromkeys(v[index] for points in families_found.values() for v in points)
    is_numeric = all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values)
    return sorted(values) if is_numeric else list(values), is_numeric


def value_text(value):
    return numbers.short(value) if isinstance(value, float) else str(value).lower() if isinstance(value, bool) else str(value)


def axis_text(results, parameter):
    """dda.thickness (m)"""
    unit = results.unit_of(parameter)
    return f"{parameter} ({unit})" if unit else parameter
