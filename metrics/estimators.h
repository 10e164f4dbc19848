#pragma once

/// Version of all estimators. Raise it by one with every change of a metric, mask, correction or interval that changes
/// the numbers of the same images. Results store the version, and summaries in use must have the current one.
///
/// Do not raise it if an interval only gains noise, or appears or disappears, and the column `interval` has a new word
/// for that. Examples: intervals of FLIP (metrics/extrapolation.h), intervals that few paths decide (metrics/noise.h).
/// Nor if an interval only gains noise that no kept summary holds. Example: effects on JOD (metrics/jod_interval.h).
inline constexpr int estimator_version = 3;
