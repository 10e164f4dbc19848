#pragma once
#include "experiments/study/measuring/measure.h"

#include <nlohmann/json.hpp>
#include <span>

/// Errors of the rungs of the truth ladder themselves, against the truth: PoseTruth::rungs x targets that are none of
/// them x metrics x masks, as manifest.json lists them. That of `on_screen` is the information limit of
/// one frame (metrics/README.md, "Glossary").
///
/// Metrics are those without the reference's noise: means of weighted squares and their roots, and `bias`. A rung
/// shares its samples with the truth; of the differences a, b of their halves the product is without noise on average,
/// and with the noise that both share. Intervals (95 %) are of noise_half_width(), null where it gives none. Masks
/// without any pixel, and those of a technique's own confidence, have no entry.
nlohmann::json rung_entries(const PoseTruth& truth, std::span<const Mask> masks);
