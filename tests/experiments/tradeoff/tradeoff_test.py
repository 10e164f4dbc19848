"""Error against run time: draws, curves and fits, by closed forms.
"""

import math
import re
import sys
import unittest


import numpy as np
from ssrlab.tradeoff import curves, fits, points, uncertainty
from ssrlab.tradeoff.answers import Answers

FRAMES = 15


def point(name, error, half_width=0.0, cost=10.0, spread=0.0, seeds=None):
    """`spread`: of the times, relative; all points are slow in the same frames."""
    variant, _, rest = name.partition(":")
    made = points.Point(variant, rest or "default", name, error, error - half_width, error + half_width, seeds or {"0": error})
    made.rounds = {(0, f): cost * (1 + spread * ((7 * f) % FRAMES - 7) / 7) for f in range(FRAMES)}
    ordered = sorted(made.rounds.values())
    low, high = ordered[2], ordered[12]  # of 15 rounds in turn
    made.cost, made.cost_low, made.cost_high = cost, low, high
    return made


class Draws(unittest.TestCase):
    def test_a_mean_is_drawn_from_students_t(self):
        seeds = {"0": 0.98, "1": 1.01, "2": 0.99, "3": 1.02}
        half = 3.18245 * np.std(list(seeds.values()), ddof=1) / 2  # t(0.975, 3)
        draws = uncertainty.ShotDraws([point("a", 1, half, seeds=seeds)], 40000)
        low, high = uncertainty.interval(draws.errors[0])
        # 40000 draws give the ends to 3 % of the half-width; the exponential moves them by half^2 / 2 = 2 %.
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
        self.assertIsNone(low)  # 20 is past the end
        self.assertLess(curve.error_at(10)[1], np.quantile(alone[0], 0.025))  # as the least of four falls
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


    def test_beyond_the_ends_only_an_upper_bound_is_known(self):
        """error = 10 / cost at costs 4, 8 and 16, within 2 % of 4 seeds: what 2 or 20 would do was not measured."""
        seeds = lambda e: {str(s): e * (1 + 0.01 * v) for s, v in enumerate((-1, 1, -1, 1))}  # noqa: E731
        made = [point(f"v:{c}", 10 / c, 0.02 * 10 / c, c, 0.05, seeds(10 / c)) for c in (4, 8, 16)]
        curve = curves.Curve(made, uncertainty.ShotDraws(made), [0, 1, 2])
        cost, low, high, share = curve.cost_to(5)  # of 2, by the law
        self.assertEqual((cost, low, share), (4, None, 1))
        self.assertTrue(4 < high < 4.3)
        self.assertIsNone(curve.cost_to(2.5)[1])  # half of the draws err less from the start on
        self.assertIsNone(curve.cost_to(2.48)[1])  # and so may this one, by chance
        cost, low, high, _ = curve.cost_to(2)
        self.assertTrue(4 < low < 5 < high, (low, high))
        error, low, high, _ = curve.error_at(20)
        self.assertEqual((error, low), (0.625, None))
        self.assertTrue(0.625 < high < 0.65)
        self.assertTrue(curve.error_at(16)[1] < 0.625)  # of a point that ran


class Texts(unittest.TestCase):
    def test_what_stands_beyond_the_ends(self):
        shown = Answers.__new__(Answers)
        ends = {"start": 4.0, "end": 16.0, "fits": "surely", "share_that_reach": 1.0}
        of_cost = lambda **row: shown._cost_text(ends | row)  # noqa: E731
        self.assertEqual(of_cost(status="before start", cost=4.0, low=None, high=4.2), "at most 4.2, its cheapest")
        self.assertEqual(of_cost(status="before start", cost=4.0, low=None, high=None), "about 4, its cheapest")
        self.assertEqual(of_cost(status="between", cost=4.1, low=None, high=4.3), "at most 4.3")
        self.assertEqual(of_cost(status="between", cost=5.0, low=4.5, high=5.5), "5 [4.5, 5.5]")
        self.assertEqual(of_cost(status="between", cost=5.0, low=4.5, high=None), "5 [4.5, ...]")
        self.assertEqual(of_cost(status="not reached", share_that_reach=0.0), "not reached by 16")
        self.assertEqual(of_cost(status="not reached", share_that_reach=0.3), "perhaps not reached by 16")
        self.assertEqual(shown._error_text(ends | {"status": "past end", "error": 0.62, "low": None, "high": 0.65}), "at most 0.65, reached at 16")
        self.assertEqual(shown._error_text(ends | {"status": "at", "error": 0.62, "low": 0.6, "high": 0.65}), "0.62 [0.6, 0.65]")


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

    def test_no_floor_is_above_0_where_there_is_none(self):
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

    def test_refuses_what_cannot_be_determined(self):
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


if __name__ == "__main__":
    unittest.main()
