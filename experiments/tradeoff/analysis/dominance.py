"""Which points of a shot are on the front of error against cost, which are not, and which cannot be told."""

from analysis.uncertainty import median_interval


def error_ratio(shot, a, b):
    """(low, high) of error of a / of b: as the study paired them where it did; 1 where they agree in every seed; else by the ends
    of both intervals, as the report tells points apart, which is wider than pairs would be."""
    if (a.key, b.key) in shot.error_effects:
        return shot.error_effects[a.key, b.key][1:]
    if a.seeds and a.seeds == b.seeds:
        return 1.0, 1.0
    low = max(a.error_low, 0.0) / b.error_high if b.error_high > 0 else 0.0
    return low, a.error_high / b.error_low if b.error_low > 0 else float("inf")


def cost_ratio(a, b):
    """(ratio, low, high) of cost of a / of b: of times the median over the rounds that both took part in."""
    if not a.rounds or not b.rounds:
        return (a.cost / b.cost,) * 3
    rounds = [r for r in sorted(a.rounds) if r in b.rounds and b.rounds[r] > 0]
    if not rounds:
        return a.cost / b.cost, 0.0, float("inf")
    return median_interval([a.rounds[r] / b.rounds[r] for r in rounds])


class Pair:
    """What is certain of two points a and b of a shot."""

    def __init__(self, shot, a, b):
        low, high = error_ratio(shot, a, b)
        self.errs_less, self.errs_more, self.errs_no_more, self.errs_no_less = high < 1, low > 1, high <= 1, low >= 1
        ratio, low, high = cost_ratio(a, b)
        beyond = 1 + shot.floor
        # A difference that two copies of one point may have is none.
        self.is_cheaper = high < 1 and ratio * beyond < 1
        self.is_dearer = low > 1 and ratio > beyond
        self.is_no_dearer = ratio <= 1 and high <= beyond
        self.is_no_cheaper = ratio >= 1 and low * beyond >= 1

    def a_dominates(self):
        return (self.is_no_dearer and self.errs_less) or (self.is_cheaper and self.errs_no_more)

    def b_dominates(self):
        return (self.is_no_cheaper and self.errs_more) or (self.is_dearer and self.errs_no_less)

    def a_may_dominate(self):
        return not self.is_dearer and not self.errs_more

    def b_may_dominate(self):
        return not self.is_cheaper and not self.errs_less


def judge(shot):
    """Key to (verdict, dominated by, undecided with) of the shot's judged points."""
    points = shot.judged()
    by = {p.key: [] for p in points}
    rivals = {p.key: [] for p in points}
    for i, a in enumerate(points):
        for b in points[:i]:
            pair = Pair(shot, a, b)
            if pair.a_dominates():
                by[b.key].append(a)
            elif pair.a_may_dominate():
                rivals[b.key].append(a)
            if pair.b_dominates():
                by[a.key].append(b)
            elif pair.b_may_dominate():
                rivals[a.key].append(b)
    return {
        p.key: ("dominated" if by[p.key] else "undecided" if rivals[p.key] else "front", by[p.key], rivals[p.key])
        for p in points
    }


def nominal_front(points):
    """Keys of the points than which none has both less cost and less error, as the report draws the front."""
    ordered = sorted(points, key=lambda p: (p.cost, p.error))
    front = []
    for p in ordered:
        if not front or p.error < front[-1].error:
            front.append(p)
    return {p.key for p in front}
