#pragma once
#include "core/gbuffer/composite.h"
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/reflections.h"
#include "experiments/study/measuring/measure.h"

#include <filesystem>
#include <nlohmann/json.hpp>

// The image files of a results folder, and the manifest's entries for them.

/// The technique's output on the CPU. `incident` mixes fallback and radiance as the compositor does, and is
/// 0 where `reflectance` (of the G-buffer; may be empty) is 0, as in the truth.
CompositedImages download_results(PassList& pass_list, const GBuffer& gbuffer, const Reflections& reflections,
                                  const Composite& composite, const HostImage& reflectance);

/// Writes the verdicts of map_of_verdicts() (judged_hits.h) into images/<shot>/; returns the manifest's entry. `stage`:
/// of the rays.
nlohmann::json save_verdict_image(const std::filesystem::path& out, const ResultRow& row, const std::string& suffix,
                                  const std::string& stage, const HostImage& map);

/// (test - reference) / (|reference| + 1 % of the reference's mean), each channel by itself: what error images hold.
HostImage relative_error(const HostImage& test, const HostImage& reference);

/// Writes images/<shot>/...; returns the manifest's entries for them. `suffix` becomes a part of the files' names,
/// and so does the key of the reference: other configs may fill the same folder.
std::vector<nlohmann::json> save_reference_images(const std::filesystem::path& out, const std::string& shot,
                                                  unsigned frame, const Reference& reference, float exposure_ev);
/// The `specular` reflections of a frame that a viewer plays: of the truth, or of a point's run.
nlohmann::json save_played_reference(const std::filesystem::path& out, const std::string& shot, unsigned frame,
                                     const Reference& reference, float exposure_ev);
nlohmann::json save_played_image(const std::filesystem::path& out, const ResultRow& row, const std::string& suffix,
                                 const HostImage& specular, float exposure_ev);
/// Perceptual `roughness` of the surfaces (one channel); its files are named by its content.
nlohmann::json save_roughness_image(const std::filesystem::path& out, const std::string& shot, unsigned frame,
                                    const HostImage& roughness);
std::vector<nlohmann::json> save_result_images(const std::filesystem::path& out, const ResultRow& row,
                                               const std::string& suffix, const PoseTruth& truth,
                                               const CompositedImages& images, float exposure_ev);
