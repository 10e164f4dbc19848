#include "tests/variants/denoiser_tolerance.h"
#include "tests/variants/reconstruction_bench.h"
#include "tests/variants/technique_fixture.h"

#include <Imath/half.h>
#include <regex>

// Spatial reconstruction of recorded rays against what DiligentFX's shaders of 2026 ("head") and 2024 ("seed") wrote.

namespace {

/// A file "SET/spatial_SETTING[_rthrTHRESHOLD]_TECHNIQUE.exr".
struct Recorded {
    std::string file, set, setting, threshold, technique;
};
void PrintTo(const Recorded& recorded, std::ostream* out) { *out << recorded.file; }

std::vector<Recorded> recorded_reconstructions() {
    const std::regex form("(.*)/spatial_(p[0-9]+)(?:_rthr([0-9.]+))?_(head|seed)\\.exr");
    std::vector<Recorded> all;
    for (const std::string& file : golden_files("diligent/"))
        if (std::smatch part; std::regex_match(file, part, form))
            all.push_back({file, part[1], part[2], part[3], part[4]});
    return all;
}

/// As lavapipe stores halves.
float truncated(float value) {
    const half nearest(value);
    return std::abs(float(nearest)) > std::abs(value) ? half(half::FromBits, uint16_t(nearest.bits() - 1)) : nearest;
}

std::string mask_file(const Recorded& recorded) {
    const nlohmann::json threshold =
        recorded.threshold.empty() ? diligent_golden_parameters(recorded.set, recorded.setting)["roughness_threshold"]
                                   : nlohmann::json::parse(recorded.threshold);
    return recorded.set + "/mask_rthr" + threshold.dump() + ".exr";
}

/// The recorded rays, in copies with less of them a file of their own.
LayeredImage recorded_rays(const Recorded& recorded) {
    const std::string part = recorded.set + "/rays_" + recorded.setting + ".exr";
    return read_golden(is_golden(part) ? part : recorded.set + "/hit_" + recorded.setting + ".exr");
}

/// As intersection would have left them: radiance is the lit colour where a ray hit; black outside the mask.
void read_rays(const Recorded& recorded, const HostImage& lit, ReconstructionInputs& inputs) {
    const LayeredImage rays = recorded_rays(recorded);
    const HostImage &hit = golden_layer(rays, "hit"), &confidence = golden_layer(rays, "conf"),
                    &direction = golden_layer(rays, "dir"), &density = golden_layer(rays, "pdf"),
                    &seed_density = golden_layer(rays, "pdfseed");
    inputs.ray_radiance = HostImage(hit.extent, 4);
    inputs.ray_direction = HostImage(hit.extent, 4);
    for (size_t i = 0; i < hit.pixel_count(); ++i) {
        if (inputs.mask.values[i] == 0) continue;
        if (hit.values[2 * i] >= 0) {
            const size_t at = size_t(hit.values[2 * i + 1]) * hit.extent.x + size_t(hit.values[2 * i]);
            inputs.ray_radiance.set_rgb(i, lit.rgb(at));
        }
        inputs.ray_radiance.values[4 * i + 3] = truncated(confidence.values[i]);
        inputs.ray_direction.set_rgb(i, direction.rgb(i));
        const bool is_seed = recorded.technique == "seed" && seed_density.values[i] > 0;
        inputs.ray_direction.values[4 * i + 3] = is_seed ? seed_density.values[i] : density.values[i];
    }
}

ReconstructionInputs read_inputs(const Recorded& recorded) {
    const HostGBuffer gbuffer = diligent_golden_gbuffer(recorded.set);
    const LayeredImage mask = read_golden(mask_file(recorded));
    ReconstructionInputs inputs{.camera = gbuffer.camera,
                                .depth = gbuffer.depth,
                                .normal = gbuffer.normal,
                                .mask = golden_layer(mask, "mask"),
                                .roughness = golden_layer(mask, "rough"),
                                .ray_radiance = {},
                                .ray_direction = {}};
    read_rays(recorded, gbuffer.lit, inputs);
    return inputs;
}

class DiligentReconstructionOf : public testing::TestWithParam<Recorded> {
    void TearDown() override { EXPECT_EQ(TechniqueTest::device().validation_messages(), std::vector<std::string>()); }
};

}  // namespace

TEST_P(DiligentReconstructionOf, RecordedRays) {
    const Recorded& recorded = GetParam();
    const ReconstructionInputs inputs = read_inputs(recorded);
    const LayeredImage golden = read_golden(recorded.file);
    nlohmann::json overrides = diligent_preset(recorded.technique);
    overrides.update(diligent_golden_parameters(recorded.set, recorded.setting));
    ReconstructionBench bench(TechniqueTest::device(), inputs.depth.extent, overrides);
    const Reconstruction ours = bench.run(inputs);

    // Rays that are not a number may be anything; files without a mask of their own have none.
    const Layer* compared = golden.find("mask");
    const HostImage& mask = compared ? compared->image : inputs.mask;
    const auto is_compared = [&](unsigned x, unsigned y) { return *mask.pixel(x, y) == 1; };
    expect_near("radiance", ours.radiance, golden_layer(golden, "rad"), is_compared, one_half);
    expect_near("variance", ours.variance, golden_layer(golden, "var"), is_compared, one_half);
    expect_near("hit depth", ours.hit_depth, golden_layer(golden, "hitdepth"), is_compared, one_half);
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_spatial, DiligentReconstructionOf,
                         testing::ValuesIn(recorded_reconstructions()),
                         [](const auto& info) { return golden_test_name(info.param.file); });
