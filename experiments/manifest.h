#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/composite.h"
#include "core/left_out.h"
#include "core/variant.h"
#include "experiments/measure.h"
#include "experiments/shot.h"

#include <nlohmann/json.hpp>

// The parts of manifest.json and the image files it lists, as experiments/RESULTS.md describes them.

/// What holds for the whole study; proves the clock.
nlohmann::json study_entry(const Config& config, Device& device);

nlohmann::json shot_entry(const Shot& shot, unsigned frame, const Reference& reference, const FrameTruth& truth, const Config& config);
nlohmann::json gbuffer_shot_entry(const Shot& shot);  ///< of a G-buffer without a reference
nlohmann::json fact_entry(const SceneFact& fact);
nlohmann::json left_out_entry(const LeftOut& part);

/// The variant's output on the CPU. `incident` mixes fallback and radiance as the compositor does, and is
/// 0 where `reflectance` (of the G-buffer; may be empty) is 0, as in the truth.
CompositedImages download_results(PassGraph& graph, const GBuffer& gbuffer, const Reflections& reflections, const Composite& composite, const HostImage& reflectance);

/// Writes images/<shot>/...; returns the manifest's entries for them.
std::vector<nlohmann::json> save_reference_images(const std::filesystem::path& out, const std::string& shot, const Reference& reference, float exposure_ev);
std::vector<nlohmann::json> save_result_images(const std::filesystem::path& out, const ResultRow& row, const FrameTruth& truth, const CompositedImages& images, float exposure_ev);
