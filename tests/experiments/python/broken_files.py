"""A file broken in every way that is tried: what scripts read must then be refused in a sentence, or do no harm."""

import copy
import csv
import io
import json
import random

WRONG = (None, True, -1, 2.5, 10**400, "x", "", [], {}, [1], {"a": 1})


def of_any_file(data):
    """(name, bytes)"""
    yield "empty", b""
    yield "cut in half", data[: len(data) // 2]
    yield "cut at its end", data[:-3]
    yield "random bytes", random.Random(1).randbytes(300)
    middle = len(data) // 2
    yield "a byte that is no UTF-8", data[:middle] + b"\xe9" + data[middle:]
    yield "a NUL", data[:middle] + b"\0" + data[middle:]
    yield "an executable", b"\x7fELF\x02\x01\x01" + data


def _places(value, place=()):
    """Of a JSON document all members, and of arrays the first element."""
    if place:
        yield place
    members = value.items() if isinstance(value, dict) else enumerate(value[:1]) if isinstance(value, list) else ()
    for key, member in members:
        yield from _places(member, (*place, key))


def of_json(data):
    text = data.decode()
    yield from of_any_file(data)
    yield "nested lists", b"[" * 100_000 + b"]" * 100_000
    yield "nested objects", b'{"a":' * 100_000 + b"1" + b"}" * 100_000
    yield "a list", b"[]"
    yield "no object", b"7"
    document = json.loads(text)
    for place in _places(document):
        for value in (*WRONG, "delete", "twice", "NaN"):
            made = copy.deepcopy(document)
            inside = made
            for key in place[:-1]:
                inside = inside[key]
            old = inside[place[-1]]
            if value == "delete":
                del inside[place[-1]]
            elif value == "twice":
                if not isinstance(place[-1], str):
                    continue
                inside[place[-1] + "\ue000"] = old
            else:
                if value == old and isinstance(value, type(old)):
                    continue
                inside[place[-1]] = float("nan") if value == "NaN" else value
            yield f"{'.'.join(map(str, place))}: {str(value)[:20]}", json.dumps(made, ensure_ascii=False).replace("\ue000", "").encode()


def of_csv(data):
    yield from of_any_file(data)
    rows = list(csv.reader(io.StringIO(data.decode(), newline="")))

    def written(rows):
        out = io.StringIO()
        csv.writer(out, lineterminator="\n").writerows(rows)
        return out.getvalue().encode()

    yield "an open quote", data + b'"a'
    yield "too few fields", written([*rows, rows[-1][:-1]])
    yield "too many fields", written([*rows, [*rows[-1], "x"]])
    yield "no rows", written(rows[:1])
    for index, name in enumerate(rows[0]):
        yield f"{name}: none", written([row[:index] + row[index + 1 :] for row in rows])
        yield f"{name}: huge", written([row[:index] + ["y" * 200_000] + row[index + 1 :] if i == 1 else row for i, row in enumerate(rows)])
        yield f"{name}: twice", written([[*row, row[index]] for row in rows])
        for value in ("", "x", "nan", "-1", "1e999", "2.5", "0", "9" * 400, "1_0", "\N{ARABIC-INDIC DIGIT THREE}", "a\nb"):
            yield f"{name}: {value[:12]}", written([row[:index] + [value] + row[index + 1 :] if i else row for i, row in enumerate(rows)])
