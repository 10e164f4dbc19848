"""How metrics agree with each other and with people, and errors over the limit of one frame: against numbers by hand."""

import math
import os
import sys
import tempfile
import types
import unittest


from ssrlab import statistics
from ssrlab.csv_files import number
from ssrlab.mistakes import ResultsError
from ssrlab.tables import agreement, documents, formats, limits, means, summary_file
from ssrlab.tables.cell import Cell


def rows(metric, values, shot="s"):
    return [{"shot": shot, "technique": "v", "point": p, "metric": metric, "value": str(v)} for p, v in values.items()]


class Directions:
    """What a results folder says of its metrics (ssrlab/results.py)."""

    def shortfall(self, metric, value):
        return -value if metric == "ssim" else value


class Agreement(unittest.TestCase):
    def test_kendalls_tau_counts_pairs(self):
        self.assertEqual(agreement.kendall_tau([1, 2, 3, 4], [1, 2, 3, 4]), 1)
        self.assertEqual(agreement.kendall_tau([1, 2, 3, 4], [4, 3, 2, 1]), -1)
        self.assertAlmostEqual(agreement.kendall_tau([1, 2, 3, 4], [1, 2, 4, 3]), 4 / 6)
        self.assertAlmostEqual(agreement.kendall_tau([1, 2, 3], [5, 5, 6]), 1)  # ties say nothing
        self.assertIsNone(agreement.kendall_tau([1, 2], [3, 3]))

    def test_more_is_better_by_ssim(self):
        both = rows("mse", {"a": 1, "b": 2, "c": 3}) + rows("ssim", {"a": 0.9, "b": 0.8, "c": 0.7})
        taus = {(r["metric"], r["against"]): float(r["value"]) for r in agreement.agreement_rows(Directions(), both)}
        self.assertEqual(taus[("mse", "ssim")], 1)
        self.assertEqual(len(taus), 4)
        for row in agreement.agreement_rows(Directions(), both):  # as tables read all rows
            self.assertEqual([number(row, column) for column in ("low", "high")], [None, None])

    def test_tables_take_scenes_as_the_sample(self):
        """Logs 0, 1, 1, 2 of four assets, one of which has two shots, with hardly any noise of their own."""
        logs = {"a": [-1, 1], "b": [1], "c": [1], "d": [2]}
        parts = [(Cell("t", "r", "c", math.exp(v), 0.99 * math.exp(v), 1.01 * math.exp(v), interval="seeds"), a) for a, of in logs.items() for v in of]
        table = types.SimpleNamespace(of="effects", over="shot")
        found = means.mean(table, [c for c, _ in parts], [a for _, a in parts])
        half = 4.30265 * math.sqrt(2 / 3) / 2  # Student's t(0.975, 2) times the standard error
        self.assertAlmostEqual(found.value, math.e, places=5)
        self.assertAlmostEqual(math.log(found.high), 1 + half, places=4)
        self.assertEqual(found.interval, means.OVER_SCENES)
        few = means.mean(table, [c for c, _ in parts[:4]], [a for _, a in parts[:4]])
        self.assertLess(math.log(few.high), math.log(few.value) + 0.01)
        self.assertIn(means.THESE_ALONE, few.interval)
        over_parameter = means.mean(types.SimpleNamespace(of="effects", over="taps"), [c for c, _ in parts], [a for _, a in parts])
        self.assertEqual(over_parameter.interval, "seeds")

    def test_only_shares_end_at_one(self):
        """Tables of rays have shares, and counts of fetches, which may be any."""
        table, assets = types.SimpleNamespace(of="hits", over="shot"), ["a", "b", "c", "d"]
        shares = means.mean(table, [Cell("t", "r", "c", v, is_share=True, may_be_zero=True) for v in (0.5, 0.9, 1, 1)], assets)
        self.assertEqual(shares.high, 1)
        few = means.mean(table, [Cell("t", "r", "c", v, may_be_zero=True) for v in (0.5, 0.9, 1, 1)], assets)
        self.assertGreater(few.high, 1)
        fetches = means.mean(table, [Cell("t", "r", "c", v, may_be_zero=True) for v in (20, 30, 40, 50)], assets)
        self.assertTrue(20 < fetches.value < fetches.high, fetches)

    def test_notes_say_what_intervals_are_of(self):
        cell = Cell("t", "r", "c", 1.0, 0.9, 1.1)

        def note(**table):
            return formats.notes({"over_count": 4, "clocks": [], **table}, [cell])

        self.assertIn("scenes of one asset averaged first", note(over="shot", sample=means.ASSETS))
        self.assertIn("of the mean over shots like these", note(over="shot", sample="shots"))
        self.assertIn("of these scenes as they are", note(over="shot"))  # kept before scenes were the sample
        for over in (None, "taps"):
            self.assertEqual(note(over=over, sample=None), "In brackets 95 % intervals.")

    def test_shares_have_wilsons_interval(self):
        share, low, high = statistics.share([1.0] * 8 + [0.0] * 2)
        self.assertEqual(share, 0.8)
        self.assertAlmostEqual(low, 0.4902, places=4)  # Wilson 1927 for 8 of 10
        self.assertAlmostEqual(high, 0.9433, places=4)

    def test_judgements_are_compared_with_each_metric(self):
        both = rows("mse", {"a": 1, "b": 2}) + rows("ssim", {"a": 0.7, "b": 0.8})
        judged = {"shot": "s", "first": "v", "first_point": "a", "second": "v", "second_point": "b"}
        swapped = judged | {"first_point": "b", "second_point": "a"}  # judges differ: undecided
        found = list(agreement.eye_rows(Directions(), both, [judged | {"nearer": "second"}] * 2 + [swapped | {"nearer": n} for n in ("first", "second")]))
        self.assertEqual({r["metric"]: r["value"] for r in found}, {"mse": "0.0", "ssim": "1.0"})
        with self.assertRaises(ResultsError):
            list(agreement.eye_rows(Directions(), both, [judged | {"shot": "another", "nearer": "first"}]))


class Limits(unittest.TestCase):
    def test_are_worst_at_each_end(self):
        ladder = {"rung": "on_screen", "target": "specular", "metric": "mse", "mask": "all", "value": 2.0, "low": 1.0, "high": 4.0}
        shots = [{"shot": "s", "truth_ladder": [ladder, ladder | {"rung": "camera_radiance", "value": 9.0}]}]
        row = {"shot": "s", "target": "specular", "metric": "mse", "mask": "all", "value": "8", "low": "6", "high": "10"}
        found = list(limits.limit_rows([row, row | {"mask": "edge"}, row | {"low": "", "high": ""}], shots))
        self.assertEqual([(r["value"], r["low"], r["high"]) for r in found], [("4.0", "1.5", "10.0"), ("4.0", "", "")])


class Excerpts(unittest.TestCase):
    def test_show_the_named_rows_and_columns_in_their_order(self):
        table = {"name": "t", "caption": "All", "shots": ["s"], "resolutions": [], "over": None, "over_count": None, "clocks": []}
        cells = [Cell("t", row, column, 1.0, 0.9, 1.1) for row in ("a", "b", "c") for column in ("x", "y")]
        origin = {"study": "s.json", "title": "", "commit": "c", "code": "", "estimators": 3, "finished": "", "device": "d"}
        with tempfile.TemporaryDirectory() as folder:
            summary_file.write(os.path.join(folder, "s.csv"), origin | {"shots": 1, "is_complete": True}, [table], cells)

            def shown(excerpt):
                text = f"<!-- table s t {excerpt} -->\n<!-- end of table -->"
                return documents.filled(text, folder, "f.md").splitlines()

            lines = shown('{"rows": ["c", "a"], "columns": ["y"], "caption": "Some"}')
            self.assertEqual(lines[1], "Some")
            self.assertEqual([line.split(" | ")[0] for line in lines[5:7]], ["| c", "| a"])
            self.assertEqual(lines[3], "| | y |")
            for bad in ('{"rows": ["d"]}', '{"row": ["a"]}', '{"rows": }'):
                with self.assertRaises(ResultsError):
                    shown(bad)


if __name__ == "__main__":
    unittest.main()
