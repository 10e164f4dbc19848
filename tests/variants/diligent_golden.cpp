#include "tests/variants/diligent_golden.h"

#include "core/error.h"
#include "variants/registry.h"

#include <algorithm>
#include <map>

namespace {

const glm::vec2 uv_from_ndc_motion{0.5f, -0.5f};

nlohmann::json our_names(const nlohmann::json& recorded, const std::string& set) {
    static const std::map<std::string, std::string> ours = {
        {"DepthBufferThickness", "hierarchy.relative_depth_buffer_thickness"},
        {"GGXImportanceSampleBias", "ggx_importance_sample_bias"},
        {"MostDetailedMip", "hierarchy.most_detailed_mip"},
        {"MaxTraversalIntersections", "hierarchy.max_traversal_intersections"},
        {"RoughnessThreshold (perceptual)", "roughness_threshold"}};
    nlohmann::json parameters = nlohmann::json::object();
    for (const auto& [key, value] : recorded.items()) {
        if (!ours.contains(key)) fail(set, "/meta.json: unknown parameter '", key, "'");
        parameters[ours.at(key)] = value;
    }
    return parameters;
}

}  // namespace

DiligentParameters::DiligentParameters() = default;

std::vector<std::string> diligent_sets_with(const std::string& file) {
    std::vector<std::string> sets = golden_sets("diligent/");
    std::erase_if(sets, [&](const std::string& set) { return !is_golden(set + "/" + file); });
    return sets;
}

std::vector<std::string> diligent_still_sets() { return diligent_sets_with("gbuffer.exr"); }
std::vector<std::string> diligent_sequences() { return diligent_sets_with("f0/gbuffer.exr"); }

unsigned diligent_frame_count(const std::string& sequence) { return unsigned(golden_meta(sequence)["frames"].size()); }

std::string diligent_frame_folder(const std::string& sequence, unsigned frame) {
    return sequence + "/f" + std::to_string(frame) + "/";
}

HostGBuffer diligent_golden_gbuffer(const std::string& set) {
    const nlohmann::json meta = golden_meta(set);
    return golden_gbuffer(read_golden(set + "/gbuffer.exr"), golden_camera(meta, meta["camera"], meta["frame_index"]),
                          uv_from_ndc_motion);
}

HostGBuffer diligent_golden_frame(const std::string& sequence, unsigned frame) {
    const nlohmann::json meta = golden_meta(sequence), recorded = meta["frames"][frame];
    const auto gbuffer_of = [&](unsigned index) {
        return golden_gbuffer(read_golden(diligent_frame_folder(sequence, index) + "gbuffer.exr"),
                              golden_camera(meta, recorded["camera"], recorded["frame_index"]), uv_from_ndc_motion);
    };
    HostGBuffer gbuffer = gbuffer_of(frame);
    if (frame > 0) {
        HostGBuffer before = gbuffer_of(frame - 1);
        gbuffer.previous_depth = std::move(before.depth);
        gbuffer.previous_normal = std::move(before.normal);
    }
    return gbuffer;
}

nlohmann::json diligent_golden_parameters(const std::string& set, const std::string& name) {
    return our_names(golden_meta(set)["parameter_sets"][name]["parameters"], set);
}

nlohmann::json diligent_sequence_parameters(const std::string& sequence) {
    const nlohmann::json meta = golden_meta(sequence);
    nlohmann::json parameters = our_names(meta["parameters"], sequence);
    parameters["start_from_black"] = true;
    parameters["temporal_variance_stability_factor"] = meta["TemporalVarianceStabilityFactor"];
    parameters["spatial_reconstruction_radius"] = meta["SpatialReconstructionRadius"];
    parameters["bilateral_cleanup_spatial_sigma_factor"] = meta["BilateralCleanupSpatialSigmaFactor"];
    return parameters;
}

nlohmann::json diligent_preset(const std::string& recorded_technique) {
    const std::string name = recorded_technique == "seed" ? "april_2024" : "current";
    const std::vector<Preset>& presets = find_technique("diligent_ssr").presets;
    return std::ranges::find(presets, name, &Preset::name)->parameters;
}
