#include "tests/variants/amd_golden.h"

#include "core/error.h"

#include <map>

HostGBuffer amd_golden_gbuffer(const std::string& set) {
    const nlohmann::json meta = golden_meta(set);
    const LayeredImage inputs = read_golden(set + "/gbuffer.exr");
    const HostImage &normal = golden_layer(inputs, "normal"), &color = golden_layer(inputs, "color");
    HostGBuffer gbuffer;
    gbuffer.camera = golden_camera(meta, meta["camera"], 0);
    gbuffer.depth = golden_layer(inputs, "depth");
    gbuffer.motion = golden_layer(inputs, "motion");
    for (float& value : gbuffer.motion.values) value = -value;  // recorded from now to before
    const glm::uvec2 extent = gbuffer.depth.extent;
    const std::vector<float> constant = meta["env"]["color_encoding"];
    for (HostImage* image : {&gbuffer.geometric_normal, &gbuffer.normal, &gbuffer.base_color, &gbuffer.emission,
                             &gbuffer.lit, &gbuffer.fallback})
        *image = HostImage(extent, 4, 1.0f);
    gbuffer.material_id = HostImage(extent, 1, 1.0f);
    for (size_t i = 0; i < color.pixel_count(); ++i) {
        gbuffer.normal.set_rgb(i, normal.rgb(i));
        gbuffer.geometric_normal.set_rgb(i, normal.rgb(i));
        gbuffer.normal.values[4 * i + 3] = golden_layer(inputs, "roughness").values[i];
        gbuffer.lit.set_rgb(i, color.rgb(i));
        gbuffer.fallback.set_rgb(i, {constant[0], constant[1], constant[2]});
    }
    gbuffer.previous_depth = gbuffer.depth;
    gbuffer.previous_normal = gbuffer.normal;
    return gbuffer;
}

HostGBuffer amd_golden_hit_gbuffer(const std::string& set) {
    HostGBuffer gbuffer = amd_golden_gbuffer(set);
    const glm::uvec2 extent = gbuffer.extent();
    gbuffer.fallback = HostImage(extent, 4);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            gbuffer.lit.set_rgb(size_t(y) * extent.x + x,
                                {(float(x) + 0.5f) / float(extent.x), (float(y) + 0.5f) / float(extent.y), 1.0f});
    return gbuffer;
}

std::vector<std::string> amd_tracer_sets() {
    std::vector<std::string> sets;
    for (const std::string& set : golden_sets("amd/"))
        if (is_golden(set + "/classify.exr")) sets.push_back(set);
    return sets;
}

nlohmann::json amd_golden_parameters(const std::string& set, const std::string& name) {
    static const std::map<std::string, std::string> ours = {
        {"samplesPerQuad", "samples_per_quad"},
        {"temporalVarianceGuidedTracingEnabled", "guided_tracing"},
        {"minTraversalOccupancy", "min_traversal_occupancy"},
        {"depthBufferThickness", "depth_buffer_thickness"},
        {"mostDetailedMip", "most_detailed_mip"},
        {"maxTraversalIntersections", "max_traversal_intersections"},
        {"roughnessThreshold (alpha)", "roughness_threshold_alpha"}};
    nlohmann::json parameters;
    for (const auto& [key, value] : golden_meta(set)["parameter_sets"][name]["parameters"].items()) {
        if (!ours.contains(key)) fail(set, "/meta.json: unknown parameter '", key, "'");
        parameters[ours.at(key)] = key == "temporalVarianceGuidedTracingEnabled" ? nlohmann::json(value != 0) : value;
    }
    return parameters;
}
