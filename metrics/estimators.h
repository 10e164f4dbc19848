#pragma once

/// Version of all estimators: raised by one with every change of a metric, a mask, a correction or an interval that
/// changes the numbers of the same images. Results hold it, and kept summaries must have the current one.
///
/// 2: relative errors weighted by a guide, intervals by pixels and not by tiles
/// 3: intervals of rungs by the variance of their difference from the truth; of frame differences and ghosts by the
///    variances of both references and their squares; the noise of the lit colour in effects and splits
///
/// Not raised where an interval holds noise that it did not before, or is given or withheld where it was not, and says
/// so by another word in its column `interval` (those of FLIP, and of effects on FLIP: metrics/extrapolation.h; those
/// that few paths decide: metrics/noise.h; those of SSIM and of absolute differences).
inline constexpr int estimator_version = 3;
