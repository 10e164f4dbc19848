"""Which points of a shot are on the front of error against cost, which are not, and which are not distinguishable from it: as the
pairs of points say that ssrlab judged."""


def judge(shot):
    """Key to (verdict, dominated by, undecided with) of the shot's judged points."""
    points = shot.judged()
    by = {p.key: [] for p in points}
    rivals = {p.key: [] for p in points}
    for p in points:
        for other in points:
            pair = shot.pairs.get((p.key, other.key))
            if pair and pair.is_dominated == "yes":
                by[p.key].append(other)
            elif pair and pair.is_dominated == "maybe":
                rivals[p.key].append(other)
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
