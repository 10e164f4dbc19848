"""Error against run time: dominance, draws, curves, fits and means over scenes, by closed forms.

usage: tradeoff_test.py TRADEOFF_FOLDER
"""

import math
import re
import sys
import types
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv.pop(1))

import numpy as np  # noqa: E402
from analysis import curves, dominance, fits, points, rows, scenes, stages, uncertainty  # noqa: E402  (before what it finds)
from ssrlab import over_scenes  # noqa: E402

FRAMES = 15


def point(name, error, half_width=0.0, cost=10.0, spread=0.0, seeds=None):
    """`spread`: of the times, relative; all points are slow in the same frames."""
    variant, _, rest = name.partition(":")
    made = points.Point(variant, rest or "default", name, error, error - half_width, error + half_width, seeds or {"0": error}, True)
    made.rounds = {(0, f): cost * (1 + spread * ((7 * f) % FRAMES - 7) / 7) for f in range(FRAMES)}
    ordered = sorted(made.rounds.values())
    low, high = ordered[2], ordered[12]  # of 15 rounds in turn
    made.set_cost(cost, low, high, high, low, 0.0)
    return made


def shot(*of_points, floor=0.0):
    return points.Shot("s", "s", "scene", "asset", "machine", floor, True, list(of_points), {})


class Dominance(unittest.TestCase):
    def test_points_are_as_their_pairs_say(self):
        made = shot(point("a", 1, cost=10), point("b", 2, cost=20), point("c", 0.9, cost=30))
        for one, other, dominates, is_dominated in (("a", "b", "yes", "no"), ("a", "c", "maybe", "no"), ("b", "c", "no", "no")):
            keys = (one, "default"), (other, "default")
            made.pairs[keys] = points.Pair(False, dominates, is_dominated)
            made.pairs[keys[::-1]] = points.Pair(False, is_dominated, dominates)
        found = {key[0]: (verdict, [p.variant for p in by], [p.variant for p in rivals]) for key, (verdict, by, rivals) in dominance.judge(made).items()}
        self.assertEqual(found, {"a": ("front", [], []), "b": ("dominated", ["a"], []), "c": ("undecided", [], ["a"])})

    def test_the_nominal_front_has_no_point_that_is_beaten(self):
        front = dominance.nominal_front([point("a", 2, 0, 1), point("b", 1, 0, 2), point("c", 1.5, 0, 3), point("d", 0.5, 0, 4)])
        self.assertEqual({v for v, _ in front}, {"a", "b", "d"})


class Medians(unittest.TestCase):
    def test_slow_halves_scatter_more_than_rounds_in_turn(self):
        self.assertEqual(uncertainty.sign_factor([float(v) for v in (8, 1, 15, 4, 11, 2, 14, 6, 9, 3, 13, 5, 12, 7, 10)]), 2)
        self.assertGreater(uncertainty.sign_factor([float(v) for v in range(15)]), 4)


class Draws(unittest.TestCase):
    def test_a_mean_is_drawn_from_students_t(self):
        seeds = {"0": 0.98, "1": 1.01, "2": 0.99, "3": 1.02}
        half = 3.18245 * np.std(list(seeds.values()), ddof=1) / 2  # t(0.975, 3)
        draws = uncertainty.ShotDraws([point("a", 1, half, seeds=seeds)], 40000)
        low, high = uncertainty.interval(draws.errors[0])
        # 40000 draws tell the ends to 3 % of the half-width; the exponential moves them by half^2 / 2 = 2 %.
        self.assertAlmostEqual(low, 1 - half, delta=0.06 * half)
        self.assertAlmostEqual(high, 1 + half, delta=0.06 * half)

    def test_what_is_beyond_the_seeds_is_kept(self):
        low, high = uncertainty.interval(uncertainty.ShotDraws([point("a", 1, 0.04)], 40000).errors[0])
        self.assertAlmostEqual(high - low, 0.08, delta=0.003)

    def test_points_share_seeds_and_slow_frames(self):
        seeds = {"0": 0.9, "1": 1.3, "2": 0.8, "3": 1.0}
        draws = uncertainty.ShotDraws([point(n, 1, 0.4, 10, 0.3, seeds) for n in ("a:x", "a:y")], 500)
        self.assertGreater(np.corrcoef(draws.errors)[0, 1], 0.99)
        self.assertGreater(np.corrcoef(draws.costs)[0, 1], 0.99)


class Curves(unittest.TestCase):
    def setUp(self):
        # error = 10 / cost, a straight line of slope -1; the fourth point is none of the front.
        self.costs, self.errors = curves.column_of([1, 4, 16, 8]), curves.column_of([10, 2.5, 0.625, 5])

    def test_interpolates_on_the_front(self):
        for cost in (1, 2, 3, 8, 16):
            self.assertAlmostEqual(curves.error_at(self.costs, self.errors, cost)[0], 10 / cost)
            self.assertAlmostEqual(curves.cost_to(self.costs, self.errors, 10 / cost)[0], cost)

    def test_never_beyond_it(self):
        self.assertTrue(math.isnan(curves.error_at(self.costs, self.errors, 0.9)[0]))
        self.assertEqual(curves.error_at(self.costs, self.errors, 100)[0], 0.625)  # it can be had, with time to spare
        self.assertTrue(math.isnan(curves.cost_to(self.costs, self.errors, 0.6)[0]))
        self.assertEqual(curves.cost_to(self.costs, self.errors, 20)[0], 1)


    def test_a_front_chosen_by_chance_is_not_believed(self):
        noise = ([-3, 1, 1, 1], [1, -3, 1, 1], [1, 1, -3, 1], [1, 1, 1, -3])
        seeds = [{str(s): 1 + 0.05 * v for s, v in enumerate(values)} for values in noise]
        half = 3.18245 * 0.1 / 2  # t(0.975, 3), deviation 0.1
        near = [point(f"v:{i}", 1 + 1e-3 * i, half, 10 - i, seeds=of) for i, of in enumerate(seeds)]
        curve = curves.Curve(near, uncertainty.ShotDraws(near, 20000), [0, 1, 2, 3])
        error, low, high, share = curve.error_at(20)
        self.assertEqual((error, share, curve.upper), (1, 1, 1 - 0.025 / 4))  # any of the four may be the least
        alone = uncertainty.ShotDraws(near, 20000).errors
        self.assertLess(low, np.quantile(alone[0], 0.025))  # as the least of four falls
        self.assertAlmostEqual(high, np.quantile(alone[0], 1 - 0.025 / 4), places=2)  # not as low as that

    def test_where_the_measured_front_may_not_fit_another_point_counts(self):
        made = [point("v:a", 1, 0, 10, 0.3), point("v:b", 2, 0, 10.5)]
        curve = curves.Curve(made, uncertainty.ShotDraws(made), [0, 1])
        error, low, high, share = curve.error_at(10.6)
        self.assertEqual((error, share), (1, 1))
        self.assertTrue(1.5 < high <= 2)  # between b and where a was drawn to be

    def test_upper_ends_are_left_out_where_draws_do_not_reach(self):
        made = [point("v:a", 2, 0.01, 10), point("v:b", 1, 0.2, 20)]
        curve = curves.Curve(made, uncertainty.ShotDraws(made), [0, 1])
        cost, low, high, share = curve.cost_to(1.05)
        self.assertTrue(low < cost < 20 and 0.5 < share < 0.9)
        self.assertIsNone(high)


class Fits(unittest.TestCase):
    costs = np.array([2.0, 4, 8, 16, 32, 64])

    def fit(self, errors, deviation=0.01):
        return fits.fit_law(self.costs, errors, [deviation] * 6, [0.001] * 6)

    def test_finds_a_law(self):
        fit = self.fit(0.2 + 3 * self.costs**-1.25)
        self.assertEqual(fit.status, "fitted")
        # The exponents' grid has steps of 1.8 %.
        self.assertAlmostEqual(fit.floor, 0.2, delta=0.004)
        self.assertAlmostEqual(fit.b, 1.25, delta=0.02)
        self.assertAlmostEqual(fit.a, 3, delta=0.1)
        self.assertTrue(0 < fit.floor_low < 0.2 < fit.floor_high < 0.25)
        self.assertTrue(1 < fit.b_low < 1.25 < fit.b_high < 1.5)

    def test_no_floor_is_told_from_0_where_there_is_none(self):
        fit = self.fit(3 / self.costs)
        self.assertEqual(fit.floor_low, 0)
        self.assertAlmostEqual(fit.b, 1, delta=0.05)

    def test_floors_are_not_below_0(self):
        fit = self.fit(2 * self.costs**-0.5 - 0.1)
        self.assertEqual((fit.floor, fit.floor_low), (0, 0))

    def test_intervals_grow_with_noise_and_with_misfit(self):
        law = 0.2 + 3 * self.costs**-1.25
        narrow, wide = self.fit(law), self.fit(law, 0.05)
        self.assertGreater(wide.floor_high - wide.floor_low, 3 * (narrow.floor_high - narrow.floor_low))
        bent = self.fit(law * [1, 1.1, 1, 1.1, 1, 1.1], 0.001)
        self.assertGreater(bent.misfit, 10)
        self.assertGreater(bent.floor_high - bent.floor_low, 3 * (narrow.floor_high - narrow.floor_low))

    def test_refuses_what_cannot_be_told(self):
        self.assertIn("does not surely fall", self.fit(np.array([1, 1.01, 0.99, 1, 1.01, 0.99])).status)
        self.assertIn("does not surely fall", self.fit(0.2 + 0.01 * self.costs).status)
        step = self.fit(np.array([1, 0.2, 0.2, 0.2, 0.2, 0.2]))
        self.assertIn("one step", step.status)
        self.assertTrue(step.floor_low < 0.2 < step.floor_high)
        self.assertIsNone(step.b_high)

    def test_axes_differ_in_one_number_alone(self):
        made = [point(f"v:rays={r} wide={w}", 1) for w, counts in ((1, (1, 2, 4)), (0, (1, 2, 4, 8))) for r in counts]
        parameters = {p.key: dict(zip(("rays", "wide"), map(int, re.findall(r"=(\d)", p.point)))) | {"mode": "a"} for p in made}
        made.append(point("v", 1))
        parameters[made[-1].key] = {"rays": 16, "wide": 0, "mode": "a"}
        (axis,) = fits.axes_of(made, parameters)
        self.assertEqual((axis.parameter, axis.fixed), ("rays", "wide=0"))
        self.assertEqual([parameters[p.key] for p in axis.points], [{"rays": r, "wide": 0, "mode": "a"} for r in (1, 2, 4, 8, 16)])


class Scenes(unittest.TestCase):
    def test_shots_of_a_scene_count_once(self):
        logs = [("a", 0.0), ("a", 2.0), ("b", 1.0), ("c", 3.0), ("d", 3.0)]
        ratio, low, high, count, shots = over_scenes.geometric_mean(logs)
        self.assertEqual((count, shots), (4, 5))
        self.assertAlmostEqual(math.log(ratio), 2)
        # Standard error 1.1547 / 2; t(0.975, 2) = 4.30265: one degree fewer than of normal values.
        self.assertAlmostEqual(math.log(high) - 2, 4.30265 * 1.1547005 / 2, places=4)
        self.assertAlmostEqual(2 - math.log(low), 4.30265 * 1.1547005 / 2, places=4)
        self.assertEqual(over_scenes.geometric_mean(logs[:4])[1:3], (None, None))

    def test_holm(self):
        for found, by_hand in zip(scenes.holm([0.01, None, 0.04, 0.03]), (0.03, None, 0.06, 0.06)):
            self.assertEqual(found, by_hand) if by_hand is None else self.assertAlmostEqual(found, by_hand)

    def test_ranks_without_any_one_scene(self):
        table = {"a": {"s": 0.0, "t": 0.0, "u": 0.0}, "b": {"s": -3.0, "t": 1.0, "u": 1.0}, "c": {"s": 9.0, "t": 9.0, "u": 9.0}}
        self.assertEqual(scenes.rank_stability(table), {"a": (2, 1, 2), "b": (1, 1, 2), "c": (3, 3, 3)})

    def test_wins_are_certain_or_shared(self):
        table = {m: {f"s{i}": (v, v * 0.9, v * 1.1) for i, v in enumerate(values)} for m, values in {"a": [1, 1, 1, 1], "b": [2, 2, 1.1, 3]}.items()}
        less = lambda m, n, s: table[m][s][2] < table[n][s][1]  # noqa: E731
        rows = scenes.Comparison(table, {f"s{i}": f"s{i}" for i in range(4)}, {f"s{i}": 4.0 for i in range(4)}, less).rows()
        self.assertEqual([(r["method"], r["rank"], r["wins"], r["shared"]) for r in rows], [("a", 1, 3, 1), ("b", 2, 0, 1)])
        self.assertAlmostEqual(rows[0]["ratio"], 0.25)
        self.assertAlmostEqual(rows[1]["against_best"], (2 * 2 * 1.1 * 3) ** 0.25)

    def test_what_lacks_shots_is_not_ranked(self):
        table = {"a": {s: (2, 2, 2) for s in "stuv"}, "b": {s: (1, 1, 1) for s in "stu"}}
        for lacking, ranks in ((0.1, {"a": 1, "b": None}), (0.25, {"a": 2, "b": 1})):
            compared = scenes.Comparison(table, {s: s for s in "stuv"}, dict.fromkeys("stuv", 4.0), lambda m, n, s: True, lacking)
            self.assertEqual({r["method"]: r["rank"] for r in compared.rows()}, ranks)


class Stages(unittest.TestCase):
    def change(self, error, costs, is_told=True):
        return stages.Change("s", "s", "m", ("v", "a"), ("v", "b"), "x", error, costs, is_told)

    def test_verdicts(self):
        less, more, same = (0.5, 0.4, 0.6), (2, 1.8, 2.2), (1.1, 0.9, 1.3)
        dearer, cheaper = (2.0, 1, 3), (-2.0, -3, -1)
        told = {(less, dearer): "buys error", (more, cheaper): "saves cost", (less, cheaper): "better in both", (more, dearer): "worse in both"}
        told |= {(same, dearer): "dearer, no error told", (same, cheaper): "cheaper, no error told"}
        for (error, costs), verdict in told.items():
            self.assertEqual(self.change(error, costs).verdict(), verdict)
        self.assertEqual(self.change(less, dearer, False).verdict(), "less error, no cost told")
        self.assertEqual(self.change(same, dearer, False).verdict(), "nothing told")

    def test_one_parameter_alone(self):
        self.assertEqual(stages.change_between({"a": True, "b": 1}, {"a": False, "b": 1}), "a: true -> false")
        self.assertEqual(stages.change_between({"a": 1, "b": 1}, {"a": 2, "b": 2}), "")


class ChosenPoints(unittest.TestCase):
    """Within a cost a technique is the point that errs least elsewhere, not the one that chance favours in the scene itself."""

    def test_no_scene_chooses_for_itself(self):
        random, shots = np.random.default_rng(4), []
        points_of = 8  # of equal true error: in its own scene the least of eight is 30 % below the mean
        for i in range(20):
            own = [point(f"v:{k}", float(np.exp(random.normal(-0.02, 0.2))), 0.01) for k in range(points_of)]
            own.append(point("none", 2.0, 0.01, cost=1.0))
            made = shot(*own)
            made.name = made.scene = made.asset = f"s{i}"
            shots.append(made)
        study = types.SimpleNamespace(
            shots=shots, unit="ms", label_of=lambda key: ":".join(key), parameters_of=lambda key: {}, has_noise_of_times=True
        )
        analysis = rows.Analysis(study, ("none", "default"), [20.0], [])
        chosen = [r for r in analysis.error_at_cost if r["variant"] == "v"]
        self.assertEqual({r["chosen_on"] for r in chosen}, {"other scenes"})
        for r in chosen:
            ran = study.shots[int(r["shot"][1:])].point_of(("v", r["point"]))
            self.assertEqual((r["point_error"], r["point_low"]), (ran.error, ran.error_low))
        mean = float(np.exp(np.mean([math.log(r["point_error"]) for r in chosen])))
        best = float(np.exp(np.mean([math.log(min(p.error for p in s.points if p.variant == "v")) for s in shots])))
        # The true geometric mean is 0.98, and the mean over 20 scenes scatters by 0.045 of it; the least of eight is 0.74.
        self.assertAlmostEqual(mean, 0.98, delta=4 * 0.045)
        self.assertLess(best, 0.8)
        (across,) = [r for r in analysis.across if r["variant"] == "v" and r.get("cost")]
        self.assertAlmostEqual(across["ratio"], mean / 2, places=6)

if __name__ == "__main__":
    unittest.main()
