"""A config's keys: what the JSON Schema of `ssrlab describe --schema` refuses, ssrlab refuses, and every key that it declares is read.

usage: config_schema_test.py SSRLAB FUZZ_EXPERIMENTS    the second reads hundreds of configs in one process (tests/fuzz/main.cpp)"""

import copy
import json
import os
import subprocess
import sys
import tempfile
import unittest

import jsonschema

SSRLAB, READER = sys.argv.pop(1), sys.argv.pop(1)
SCHEMA = json.loads(subprocess.run([SSRLAB, "describe", "--schema"], stdout=subprocess.PIPE, check=True).stdout)
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
TECHNIQUE = "mcguire_dda"
AXES = {"dda.stride": [1, 2], "dda.thickness": {"log": [0.01, 1, 3]}}
SAMPLE = {"count": 2, "seed": 1, "axes": {"dda.thickness": {"lin": [0.01, 1]}}}
SETTINGS = {"lit": "path_traced", "lit_specular": "environment", "fallback": "environment", "depth_format": ["d32f", "d16"], "depth_direction": "standard", "normal_encoding": "float", "gbuffer_formats": "packed"}
PLAYED = {"warm_up": 1, "repeat": 9, "change": 1, "measure": "all", "measure_from": 0, "label": "{scene} {settings}", "group": "g", **SETTINGS}
SCENE = {"scene": ["fence"], "camera": "main", "resolution": [[64, 36]], "frames": [{"from": 0, "to": 1}], **PLAYED}
ROOMS = {"scene": ["room:*"], "count": 2, "first": 3}
MEASURED = {"metrics": ["mse"], "masks": ["all", "roughness_0.1_0.2"], "targets": "image", "frame_metrics": "mse", "frame_masks": "all"}
BASE = {
    "$schema": "x", "title": "t", "shots": [SCENE, ROOMS, {"gbuffer": "capture", "reference": "truth.exr", "frames": [0, 1], **PLAYED}],
    "seeds": [0, 1], "reference": {"samples": 16, "lit_samples": 16, "adaptive_share": 0.0, "adaptive_image": False, "lit_noise": True, "lit_filter": True, "guide_samples": 16, "seconds": 1.5, "target_relative_error": 0.5, "max_depth": 4, "seed": 1},
    "primary": {"metric": "mse", "mask": "all", "target": "image", "margin": 0.1}, "composite": "split_sum", "resolution": [64, 36],
    "hits": {"every": 4, "seeds": 1}, "costs": True, "gpu_compilers": ["navi21"], "images": "all", "timing": {"frames": 15, "warm_up": 1, "copies": False, "most_share": 0.5},
    **MEASURED, **SETTINGS, "reflective_max_roughness": 0.5, "reflective_min_reflectance": 0.1,
    "tables": [{"name": "a", "caption": "c", "of": "results", "where": {"metric": "mse"}, "rows": "point", "columns": ["shot"], "sort": "s", "best": "row", "labels": {"a": "b"}},
               {"name": "b", "caption": "c", "of": "results", "rows": "point", "columns": "metric", "over": "shot"}],
}  # fmt: skip
STUDY = BASE | {
    "techniques": [
        {"technique": TECHNIQUE, "preset": ["coarse"], "parameters": {"dda.refine": True}, "label": "l", "group": "g", "seeds": 2, "baseline": True, "timing": True},
        {"technique": TECHNIQUE, "sweep": AXES, "only_if": {"dda.stride": 2}, "skip_if": {"shot.height": 1}},
        {"technique": TECHNIQUE, "zip": {"dda.stride": [1, 2]}, "label": "zip {dda.stride}", "parameters": {"dda.refine": True}, "against": {"dda.refine": True}, "preset": "coarse"},
        {"technique": TECHNIQUE, "each": {"dda.stride": [4]}},
        *({"technique": TECHNIQUE, kind: SAMPLE | {"seed": seed}} for seed, kind in enumerate(("random", "latin_hypercube", "sobol"))),
        {"external": "frames", "point": "p", "label": "another program", "group": "g", "baseline": False},
    ]
}  # fmt: skip
TUNE = BASE | {
    "techniques": [{"technique": TECHNIQUE}],
    "frozen": [{"cost": 5, "points": {TECHNIQUE: "default"}}],
    "tune": {
        "axes": {"dda.stride": [1, 2], "max_roughness": {"lin": [0.1, 0.6]}, "dda.thickness": {"log": [0.01, 1], "only_if": {"dda.stride": 2}},
                 "dda.refine": {"values": [True], "skip_if": {"dda.stride": 2}}},
        "start": "default", "time": "operations", "budgets": [0.5], "metrics": "mse", "target": "image", "mask": "all",
        "judge": {"shots": [SCENE | {"scene": "grazing"}], "seeds": 2}, "most_runs": 10, "most_minutes": 1, "batch": 2, "seed": 1,
    },
}  # fmt: skip
OVER_PROGRAM = BASE | {"techniques": [{"technique": TECHNIQUE}], "tune": {"program": ["./render", "quickly"], "axes": {"steps": [1, 2]}}}
EXTENDING = {"extends": "study.json", "techniques": [{"technique": TECHNIQUE, "preset": "best", "remove": False}, {"external": "frames", "remove": False}]}
OF_PARAMETERS = ("parameters", "against", "sweep", "zip", "each", "axes")  # objects that name them


def declared(schema, key):
    """The schema of a member."""
    return schema.get("properties", {}).get(key) or schema.get("additionalProperties") or {}


def alternatives(schema):
    """The schemas, however deep in "anyOf"."""
    return [leaf for one in schema["anyOf"] for leaf in alternatives(one)] if "anyOf" in schema and "properties" not in schema else [schema]


def objects(value, schema, path=()):
    """(path, object, schema) of each object that keys are declared for."""
    for one in alternatives(schema):
        if isinstance(value, dict) and one.get("type") == "object" and jsonschema.Draft202012Validator(one).is_valid(value):
            yield path, value, one
            for key, member in value.items():
                yield from objects(member, declared(one, key), (*path, key))
        if isinstance(value, list) and one.get("type") == "array":
            for i, item in enumerate(value):
                yield from objects(item, one["items"], (*path, i))


def wrong_values(schema):
    """Values that none of the alternatives holds."""
    yield {"wrong": None}
    for one in alternatives(schema):
        if one.get("type") in ("number", "integer"):
            yield "a text"
            yield from (one[limit] + step for limit, step in (("minimum", -1), ("maximum", 1)) if limit in one)
        if one.get("type") == "array":
            yield [[[None]]]
        if "enum" in one:
            yield "no_such_name"


class Keys(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for frame in (0, 1):
            os.makedirs(os.path.join(self.folder, "capture", f"frame_{frame}"))
        os.makedirs(os.path.join(self.folder, "frames"))
        self.write("frames/external.json", {"name": "other", "engine": "another program", "version": "1"})
        self.write("study.json", STUDY)

    def write(self, name, config):
        file = os.path.join(self.folder, name)
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(json.dumps(config))  # in one piece and on one line: some 400 times, five times as fast as json.dump
        return file

    def refusals(self, configs):
        """What ssrlab says of each config that it does not read; "" of one that it does."""
        files = [self.write(f"config{i}.json", config) for i, config in enumerate(configs)]
        said = subprocess.run([READER, "say", "config", *files], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
        self.assertEqual(len(said), len(files))
        return said

    def check_refused(self, tried):
        """`tried`: (config, what was changed in it, what is said beside its place)."""
        for (_, what, says), said in zip(tried, self.refusals([config for config, _, _ in tried])):
            self.assertRegex(said, rf"config\d+\.json:\d+:\d+: .*{says}", what)

    def test_all_that_are_declared_are_read(self):
        self.assertEqual(self.refusals([STUDY, TUNE, OVER_PROGRAM, EXTENDING]), [""] * 4)
        unused = {}  # schema of an object to the keys that no config here has
        for config in (STUDY, TUNE, OVER_PROGRAM, EXTENDING):
            VALIDATOR.validate(config)
            for path, value, schema in objects(config, SCHEMA):
                if not path or path[-1] not in OF_PARAMETERS:
                    unused.setdefault(json.dumps(schema), set(schema.get("properties", {}))).difference_update(value)
        self.assertGreater(len(unused), 15)
        self.assertEqual(set().union(*unused.values()), set())

    def changed(self, config, path, key, value):
        changed = copy.deepcopy(config)
        at = changed
        for step in path:
            at = at[step]
        at[key] = value
        return changed

    def test_what_the_schema_refuses_the_reader_refuses(self):
        seen, refused = set(), []  # once for each declaration
        for config in (STUDY, TUNE):
            for path, value, schema in objects(config, SCHEMA):
                for key in value:
                    for wrong in wrong_values(declared(schema, key)):
                        what = json.dumps([schema, key, wrong])
                        if what not in seen and not VALIDATOR.is_valid(changed := self.changed(config, path, key, wrong)):
                            seen.add(what)
                            refused.append((changed, f"{path} {key} = {wrong}", ""))
        self.assertGreater(len(refused), 150)
        self.check_refused(refused)

    def test_what_is_not_declared_is_refused_by_both(self):
        refused = []
        for config in (STUDY, TUNE):
            for path, _, schema in objects(config, SCHEMA):
                changed = self.changed(config, path, "no_such_key", 1)
                if schema.get("additionalProperties") is False:
                    self.assertFalse(VALIDATOR.is_valid(changed), path)
                    refused.append((changed, path, "no_such_key"))
        self.check_refused(refused)


if __name__ == "__main__":
    unittest.main()
