#!/usr/bin/python3
"""Reads a results folder: of each shot, the point of least error whose frame takes no longer than a budget.

usage: read_results.py DIR [MILLISECONDS]"""

import json
import sys

import pandas

PANDAS_TYPES = {"integer": "Int64", "number": "float64", "boolean": "Int64", "string": "string"}


def read(folder, name):
    """A CSV file of the folder with the types that its schema.json states."""
    with open(f"{folder}/schema.json", encoding="utf-8") as text:
        files = {r["name"]: r["schema"]["fields"] for r in json.load(text)["resources"]}
    types = {field["name"]: PANDAS_TYPES[field["type"]] for field in files[name]}
    return pandas.read_csv(f"{folder}/{name}.csv", dtype=types)


def best_within(folder, milliseconds):
    with open(f"{folder}/manifest.json", encoding="utf-8") as text:
        primary = json.load(text)["primary"]  # the error that the study is made to compare
    errors = read(folder, "summary").query("metric == @primary['metric'] and mask == @primary['mask'] and target == @primary['target'] and speaks == 1")
    times = read(folder, "time_summary").query("stage == 'total' and median_ms <= @milliseconds")
    how = "inner" if milliseconds < float("inf") else "left"  # without a budget, points that were not timed count, too
    parameters = read(folder, "parameters").set_index(["variant", "point"])
    table = errors.merge(times[["shot", "variant", "point", "median_ms"]], on=["shot", "variant", "point"], how=how)
    best = table.loc[table.groupby("shot")["value"].idxmin()]
    best = best[["shot", "variant", "point", "value", "low", "high", "median_ms"]]
    return best.join(parameters.dropna(axis="columns", how="all"), on=["variant", "point"])


if __name__ == "__main__":
    found = best_within(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else float("inf"))
    print(found.to_string(index=False, columns=["shot", "variant", "point", "value", "low", "high", "median_ms"]))
