#pragma once
#include "core/gbuffer/composite.h"
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/reflections.h"
#include "experiments/study/measuring/measure.h"

#include <filesystem>
#include <nlohmann/json.hpp>

// The image files of a results folder, and the manifest's entries for them.

/// The technique's output on the CPU. `incident` mixes fallback and radiance as the compositor does. As in the truth,
/// it is 0 where `reflectance` (the G-buffer's; may be empty) is 0.
CompositedImages download_results(PassList& pass_list, const GBuffer& gbuffer, const Reflections& reflections,
                                  const Composite& composite, const HostImage& reflectance);

/// Writes the picture of map_of_verdicts() (judged_hits.h) into images/<shot>/ and returns its manifest entry. `stage`:
/// the rays' stage.
nlohmann::json save_verdict_image(const std::filesystem::path& out, const ResultRow& row, const std::string& suffix,
                                  const std::string& stage, const HostImage& map);

/// The content of error images: (test - reference) / (|reference| + 1 % of the reference's mean), for each channel.
HostImage relative_error(const HostImage& test, const HostImage& reference);

/// Writes images/<shot>/... and returns their manifest entries. File names contain `suffix` and the reference's key, as
/// other configs may fill the same folder.
std::vector<nlohmann::json> save_reference_images(const std::filesystem::path& out, const std::string& shot,
                                                  unsigned frame, const Reference& reference, float exposure_ev);
/// The `specular` reflections of a frame for a viewer that plays them: the truth's, or those of a point's run.
nlohmann::json save_played_reference(const std::filesystem::path& out, const std::string& shot, unsigned frame,
                                     const Reference& reference, float exposure_ev);
nlohmann::json save_played_image(const std::filesystem::path& out, const ResultRow& row, const std::string& suffix,
                                 const HostImage& specular, float exposure_ev);
/// Writes the perceptual `roughness` of the surfaces (one channel); a file's name is the hash of its content.
nlohmann::json save_roughness_image(const std::filesystem::path& out, const std::string& shot, unsigned frame,
                                    const HostImage& roughness);
std::vector<nlohmann::json> save_result_images(const std::filesystem::path& out, const ResultRow& row,
                                               const std::string& suffix, const PoseTruth& truth,
                                               const CompositedImages& images, float exposure_ev);
