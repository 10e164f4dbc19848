"""The tables of a results folder as pandas DataFrames, with the types, units and meanings of its schema.json."""

import io
import re

import pandas

from ssrlab import csv_files
from ssrlab.mistakes import ResultsError
from ssrlab.results import read_manifest, read_schema
from ssrlab.text_files import exists, path_inside, read_text

PANDAS_TYPES = {"integer": "Int64", "number": "float64", "boolean": "boolean", "string": "string"}


def read(folder):
    """Reads a results folder. Fails with ResultsError, a sentence, if it is none."""
    return Tables(folder)


class Tables:
    """`tables["summary"]` is summary.csv; `in` says whether the folder has a table."""

    def __init__(self, folder):
        self.folder = folder
        self.manifest = read_manifest(folder)
        self._fields = read_schema(folder)
        if not self._fields:
            raise ResultsError(f"{folder} has no schema.json; `ssrlab run` or `ssrlab merge` writes it")
        self._read = {}

    def names(self):
        return [name for name in self._fields if name in self]

    def __contains__(self, name):
        return name in self._fields and exists(path_inside(self.folder, name + ".csv"))

    def __getitem__(self, name):
        if name not in self:
            raise ResultsError(f"{self.folder} has no table '{name}'; it has {', '.join(self.names())}")
        if name not in self._read:
            types = {f["name"]: PANDAS_TYPES.get(f["type"], "string") for f in self._fields[name]}
            booleans = [c for c, t in types.items() if t == "boolean"]
            own = types | dict.fromkeys(booleans, "Int64")  # which files write as 1 and 0
            file = path_inside(self.folder, name + ".csv")
            try:
                table = pandas.read_csv(io.StringIO(read_text(file)), dtype=own, keep_default_na=False, na_values=[""]).astype(dict.fromkeys(booleans, "boolean"))
            except (ValueError, TypeError, pandas.errors.ParserError) as e:
                raise ResultsError(f"cannot read {file} as schema.json describes it: {e}") from e
            lacking = [c for c in types if c not in table]
            if lacking:
                raise ResultsError(f"{file} has no column '{lacking[0]}', which schema.json names; `ssrlab merge` makes both anew")
            texts = [c for c in table if types.get(c) == "string"]
            table[texts] = table[texts].replace(csv_files.GUARDED, r"\1", regex=True)
            self._read[name] = table.rename(columns=lambda c: re.sub(csv_files.GUARDED, r"\1", c))
        return self._read[name]

    def units(self, name):
        """Units by column; columns without a unit are left out."""
        return {f["name"]: f["unit"] for f in self._fields[name] if "unit" in f}

    def meanings(self, name):
        """Meanings by column."""
        return {f["name"]: f["description"] for f in self._fields[name]}

    def primary_errors(self):
        """Rows of summary.csv with the study's main error, for the frames that represent their shot."""
        summary, primary = self["summary"], self.manifest["primary"]
        is_primary = (summary["metric"] == primary["metric"]) & (summary["mask"] == primary["mask"]) & (summary["target"] == primary["target"])
        return summary[is_primary & summary["represents_shot"]]
