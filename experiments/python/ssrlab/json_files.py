"""Reads JSON of unknown authors, as core/json.h does: mistakes are ResultsErrors with file and place."""

import json
import math
import re

from ssrlab.mistakes import ResultsError
from ssrlab.text_files import read_text

MOST_LEVELS = 100  # core/json.h: max_json_depth
LONGEST = 300  # letters of a value in a message


class Object(dict):
    """A JSON object that states its place if a member is missing."""

    where = ""

    def __missing__(self, key):
        raise ResultsError(f"{self.where} lacks '{key}'")


def read_json(file, shape=dict, has_comments=False):
    """The document in a file; `shape` as in require()."""
    text = read_text(file)
    return parse_json(without_comments(text) if has_comments else text, file, shape)


def parse_json(text, name, shape=dict):
    """`name`: what messages call the document."""

    def no_duplicates(pairs):
        found = Object(pairs)
        if len(found) < len(pairs):
            keys = [key for key, _ in pairs]
            twice = next(key for key in keys if keys.count(key) > 1)
            raise ResultsError(f"{name}: the key '{shortened(twice)}' comes twice in one object")
        return found

    def finite(number):
        if not math.isfinite(value := float(number)):
            raise ResultsError(f"{name}: the number {shortened(number)} is beyond what float64 can hold")
        return value

    def whole(number):
        return int(number) if len(number) < 20 else finite(number)  # beyond 64 bits as core/json.h reads it

    def no_constant(word):
        raise ResultsError(f"{name}: {word} is no number of JSON; write null where there is none")

    try:
        content = json.loads(text, object_pairs_hook=no_duplicates, parse_float=finite, parse_int=whole, parse_constant=no_constant)
    except json.JSONDecodeError as e:
        raise ResultsError(f"{name}:{e.lineno}:{e.colno}: not valid JSON: {e.msg}") from e
    except RecursionError as e:
        raise ResultsError(f"{name}: its JSON nests more than {MOST_LEVELS} levels") from e
    _place(content, name, 0)
    require(content, shape, name)
    return content


def without_comments(text):
    """JSON without the // comments that configs may have; line numbers stay."""
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*', lambda m: m.group(1) or "", text)


def shortened(value):
    """A value for a message: JSON, cut if it is long; texts unchanged."""
    text = value if isinstance(value, str) else json.dumps(value)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 80]} ... {text[-80:]}"


def _place(value, where, level):
    """Gives all objects their places. Refuses what ssrlab refuses: deep nesting, and texts that are not Unicode."""
    if level > MOST_LEVELS:
        raise ResultsError(f"{where.split(': ')[0]}: its JSON nests more than {MOST_LEVELS} levels")
    if isinstance(value, Object):
        value.where = where
        for key, member in value.items():
            _place(key, f"{where}: a key", level)
            _place(member, f"{where}: {key}" if level == 0 else f"{where}.{key}", level + 1)
    elif isinstance(value, list):
        for index, element in enumerate(value):
            _place(element, f"{where}[{index}]", level + 1)
    elif isinstance(value, str) and re.search("[\ud800-\udfff]", value):
        raise ResultsError(f"{where}: a text has half of a surrogate pair, which is no letter")


KINDS = {str: "a text", bool: "true or false", int: "a whole number", float: "a number", dict: "an object", list: "an array", None: "null"}


def _is_of(value, kind):
    if kind is float:
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    if kind is int:
        return isinstance(value, int) and not isinstance(value, bool)
    return value is None if kind is None else isinstance(value, kind)


def require(value, shape, where):
    """Fails unless a value has a shape: a type (float: any number; None: null), several types in a tuple, [shape] for an array, or {key:
    shape} for an object. Keys that may be missing end with "?"; "*" stands for all other keys, which may always be there."""
    alternatives = shape if isinstance(shape, tuple) else (shape,)
    for one in alternatives:
        if _is_of(value, type(one) if isinstance(one, (dict, list)) else one):
            return _require_inside(value, one, where)
    wanted = " or ".join(KINDS[type(one) if isinstance(one, (dict, list)) else one] for one in alternatives)
    raise ResultsError(f"{where} must be {wanted}, not {shortened(json.dumps(value))}")


def _require_inside(value, shape, where):
    if isinstance(shape, list):
        for index, element in enumerate(value):
            require(element, shape[0], f"{where}[{index}]")
    elif isinstance(shape, dict):
        for key, member in shape.items():
            name = key.removesuffix("?")
            if key == "*":
                for other in value.keys() - {k.removesuffix("?") for k in shape}:
                    require(value[other], member, f"{where}: {other}")
            elif name in value:
                require(value[name], member, f"{where}: {name}")
            elif name == key:
                raise ResultsError(f"{where} lacks '{key}'")
