#pragma once
#include "experiments/study/measuring/measure.h"

#include <nlohmann/json.hpp>
#include <span>

/// Errors of the rungs of the truth ladder against the truth, as manifest.json lists them: PoseTruth::rungs x targets
/// that are not rungs x metrics x masks. The error of `on_screen` is the information limit of one frame
/// (experiments/docs/glossary.md).
///
/// Only metrics without the reference's noise are used: means of weighted squares, their roots, and `bias`. A rung
/// shares its samples with the truth. The product of the differences a, b of their halves has no noise on average, and
/// is free of the noise that both share. 95 % intervals are of noise_half_width(), null where it gives none. Masks
/// without any pixel, and masks of a technique's own confidence, have no entry.
nlohmann::json rung_entries(const PoseTruth& truth, std::span<const Mask> masks);
