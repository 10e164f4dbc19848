"""The statistics over scenes of tables and documents: against closed forms, and constants of the C++ against its headers."""

import os
import sys
import tempfile
import unittest

import numpy as np
from ssrlab.figures.numbers import in_prose
from ssrlab.tables import documents, summary_file
from ssrlab.tables.cell import Cell
from scipy import stats
from ssrlab import statistics
from ssrlab.repository import ROOT

QUANTILES = 2e-8  # so far off are scipy's of Student's t: of 2 degrees of freedom over_scenes_test.cpp has the closed form


class Statistics(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(1)

    def test_means_over_scenes_are_students_with_one_degree_fewer(self):
        for count in (4, 5, 8, 38):
            values = self.random.normal(1, 2, count)
            mean, low, high, scenes = statistics.mean_over_scenes((str(i), v) for i, v in enumerate(values))
            half = stats.t.ppf(0.975, count - 2) * stats.sem(values)
            np.testing.assert_allclose((mean, low, high), (values.mean(), values.mean() - half, values.mean() + half), rtol=QUANTILES)
            self.assertEqual(scenes, count)

    def test_assets_count_once_and_four_are_needed(self):
        alike = statistics.mean_over_scenes([("a", 1), ("b", 2), ("c", 3), ("d", 4)])
        self.assertEqual(statistics.mean_over_scenes([("a", 0), ("a", 2), ("b", 2), ("c", 3), ("d", 4)]), alike)
        self.assertEqual(statistics.mean_over_scenes([("a", 1), ("a", 2), ("b", 3), ("c", 3)])[1:], (None, None, 3))
        ratio, low, high, _ = statistics.geometric_mean_over_scenes([(n, np.log(v)) for n, v in zip("abcd", (1, 2, 4, 8))])
        np.testing.assert_allclose((ratio, low * high), (8**0.5, 8), rtol=1e-12)

    def test_prose_has_ratios_of_columns_over_assets(self):
        """Six shots of five assets, one of which is no row of the other table, and one without a value."""
        shots, ratios = list("abcdefg"), [1.1, 0.7, 0.5, 0.9, 1.3, 0.2]
        about = {"name": "errors", "caption": "", "shots": shots, "resolutions": [], "over": None, "over_count": None, "clocks": []}
        tables = [about | {"assets": dict(zip(shots, "AABCDEF"))}, about | {"name": "others", "shots": shots[:5] + ["g"]}]
        cells = [Cell("errors", s, "base", 2.0) for s in shots] + [Cell("errors", s, "new", 2 * r) for s, r in zip(shots, ratios)]
        with tempfile.TemporaryDirectory() as folder:
            summary_file.write(os.path.join(folder, "study.csv"), {"study": "study.json"}, tables, cells)
            text = documents.Numbers(folder, "a.md").text('over_scenes("study", "errors", "new", "base", as_in="others")')
        logs = np.log([np.sqrt(1.1 * 0.7), 0.5, 0.9, 1.3])
        low, high = np.exp(logs.mean() + stats.sem(logs) * stats.t.ppf([0.025, 0.975], len(logs) - 2))
        self.assertEqual(text, in_prose(np.exp(logs.mean()), low, high))

    def test_means_are_students(self):
        values = self.random.normal(1, 2, 6)
        low, high = stats.t.interval(0.95, 5, values.mean(), stats.sem(values))
        np.testing.assert_allclose(statistics.mean(values), (values.mean(), low, high), rtol=QUANTILES)

    def test_constants_are_those_of_the_program(self):
        model, counts = ((ROOT / file).read_text() for file in ("experiments/gpu_costs/chips/model_range.h", "experiments/results/files/counts_spread.h"))
        self.assertIn("model_range{{{:g}, {:g}}}".format(*statistics.MODEL_RANGE), model)
        self.assertIn(f'"{statistics.MODEL_RANGE_TEXT}"', model)
        self.assertIn(f"counts_spread = {statistics.COUNTS_SPREAD:g};", counts)

    def test_p_values_are_adjusted_together(self):
        half = stats.t.ppf(0.975, 4)  # of a mean whose standard error is 1
        alone = [2 * stats.t.sf(t, 4) for t in (5, 3, 1)]
        np.testing.assert_allclose(statistics.p_holm([(3, half), (5, half), (-1, half)], 4), [2 * alone[1], 3 * alone[0], alone[2]])


if __name__ == "__main__":
    unittest.main()
