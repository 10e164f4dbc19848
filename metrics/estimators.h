#pragma once

/// Names how numbers are made of images: raised by one with every change of a metric, a mask, a correction or an
/// interval after which the same images would give other numbers. Results carry it, and summaries that are kept must
/// have been made by today's.
///
/// 2: relative errors weighted by a guide, intervals by pixels and not by tiles
/// 3: intervals of rungs by the variance of what tells them from the truth; of frame differences and ghosts by the
///    variances of both references and their squares; the noise of the lit colour in effects and splits
///
/// Not raised where an interval holds noise that it did not before, and says so by another word in its column `interval`
/// (those of FLIP and SSIM, and of effects on FLIP: metrics/extrapolation.h).
inline constexpr int estimator_version = 3;
