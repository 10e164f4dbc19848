"""Points of a study by their parameter values: points that differ in one parameter form a line, in two a map."""

import itertools
import json
from dataclasses import replace

from ssrlab.figures import numbers
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


def _swept(results):
    """{technique: ([points of a sweep], [parameters of which it has several values])}, without single changes."""
    points = {}
    for key in results.points():
        if results.techniques.get(key, {}).get("swept"):
            points.setdefault(key[0], []).append(key)

    def names_of(keys):
        values = [(name, json.dumps(value)) for key in keys for name, value in results.techniques[key]["swept"].items()]
        several = {name for (name, value), (other, another) in itertools.product(set(values), repeat=2) if name == other and value != another}
        return [name for name in dict.fromkeys(name for name, _ in values) if name in several]

    return {technique: (keys, names_of(keys)) for technique, keys in points.items()}


def unasked(results, template):
    """The figures of what a study sweeps, as requests like `template`: a `response` for each parameter with points that differ in it alone,
    and of a sweep over two parameters a `map`, for each combination of what else differs. Points drawn at random make no map."""
    requests = []

    def found(options, points, axes):
        chosen = replace(template, points=points, options=options)
        try:
            return chosen, families(results.narrowed(template.shots, points), chosen, axes)
        except ResultsError:
            return chosen, {}  # no two points differ in these alone

    for technique, (points, names) in _swept(results.narrowed(template.shots, template.points)).items():
        for name in names:
            chosen, lines = found({"parameter": name}, points, [name])
            requests += [replace(chosen, kind="response", name=f"response_{technique}_{name}")] if lines else []
        if len(names) != 2:
            continue
        options = dict(zip(("x", "y"), names))
        maps = found(options, points, names)[1]
        for family, cells in maps.items():
            if len(cells) > max(len(set(values)) for values in zip(*cells)):
                name = "_".join(["map", technique, *names, *([family] if len(maps) > 1 else [])])
                requests.append(replace(template, kind="map", name=name, points=list(cells.values()), options=options))
    return requests


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
