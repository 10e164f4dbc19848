"""At which share of exact rays half of what exact rays do to the error is done (exact_rays, exact_share)."""

import math

from ssrlab import statistics


def _falls_to_zero(shares, values):
    """Where the line through these points first falls to 0: 0 if it begins there, 1 if it never does."""
    if values[0] <= 0:
        return 0.0
    for (k0, v0), (k1, v1) in zip(zip(shares, values), zip(shares[1:], values[1:])):
        if v0 > 0 >= v1:
            return k0 + (k1 - k0) * v0 / (v0 - v1)
    return 1.0


def halving_share(curves):
    """(share, low, high) over scenes. `curves`: for each scene (asset, {share: error}), with the errors at 0 and at 1 among them.

    Half way is the geometric mean of the errors at 0 and at 1, as errors are averaged over scenes: single ones of ten times the error
    of no reflections would decide an arithmetic one. The mean over scenes of ln error(k) - (ln error(0) + ln error(1)) / 2 falls with
    k, and is 0 half way. It has an interval at each k; the shares at which that holds 0 are those of the share (inversion of a test;
    Fieller 1954 for ratios). They begin at 0 where exact rays have no significant effect, and end at 1 where half of it is not certain
    at any share. No ends below four scenes.
    """
    shares = sorted(curves[0][1])
    ends = []
    for k in shares:
        left = [(asset, math.log(errors[k]) - (math.log(errors[0]) + math.log(errors[1])) / 2) for asset, errors in curves]
        ends.append(statistics.mean_over_scenes(left)[:3])
    middle, low, high = zip(*ends)
    if None in low:
        return _falls_to_zero(shares, middle), None, None
    return _falls_to_zero(shares, middle), _falls_to_zero(shares, low), _falls_to_zero(shares, high)
