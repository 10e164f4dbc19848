"""The share of exact rays that achieves half of the effect of exact rays on the error (exact_rays, exact_share)."""

import math

from ssrlab import statistics


def _falls_to_zero(shares, values):
    """Where the line through these points first falls to 0; 0 if it begins there, 1 if it never does."""
    if values[0] <= 0:
        return 0.0
    for (k0, v0), (k1, v1) in zip(zip(shares, values), zip(shares[1:], values[1:])):
        if v0 > 0 >= v1:
            return k0 + (k1 - k0) * v0 / (v0 - v1)
    return 1.0


def halving_share(curves):
    """(share, low, high) over scenes. `curves`: for each scene (asset, {share: error}), including the errors at 0 and at 1.

    Half of the way is the geometric mean of the errors at 0 and at 1, like errors over scenes: single scenes with ten times the error
    without reflections would decide an arithmetic mean. The mean over scenes of ln error(k) - (ln error(0) + ln error(1)) / 2 falls with
    k, and is 0 half of the way. It has an interval at each k; the interval of the share holds the k at which it includes 0 (inversion of
    a test; Fieller 1954 for ratios). It begins at 0 if exact rays have no significant effect, and ends at 1 if no share certainly
    achieves half. No interval below four scenes.
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
