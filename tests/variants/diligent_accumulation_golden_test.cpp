#include "tests/variants/accumulation_bench.h"
#include "tests/variants/denoiser_tolerance.h"
#include "tests/variants/technique_fixture.h"

#include <regex>

// Temporal accumulation and bilateral cleanup, each fed what DiligentFX's shaders of 2026 ("head") and 2024 ("seed")
// read, against what they wrote.

namespace {

/// A file "SEQUENCE/fFRAME/STAGE_TECHNIQUE_FACTOR.exr".
struct Recorded {
    std::string file, sequence, technique, factor;
    unsigned frame = 0;

    std::string folder(unsigned of_frame) const { return diligent_frame_folder(sequence, of_frame); }
    nlohmann::json parameters() const {
        nlohmann::json all = diligent_preset(technique);
        all.update(diligent_sequence_parameters(sequence));
        all["temporal_radiance_stability_factor"] = nlohmann::json::parse(factor);
        return all;
    }
    /// What temporal accumulation wrote in that frame.
    Filtered accumulated(unsigned of_frame) const {
        const LayeredImage image = read_golden(folder(of_frame) + "temporal_" + technique + "_" + factor + ".exr");
        return {.radiance = golden_layer(image, "rad"), .variance = golden_layer(image, "var")};
    }
};
void PrintTo(const Recorded& recorded, std::ostream* out) { *out << recorded.file; }

/// Those whose frame holds what the stage before wrote, too.
std::vector<Recorded> recorded_outputs(const std::string& stage, const std::string& stage_before) {
    const std::regex form("(.*)/f([0-9]+)/" + stage + "_(head|seed)_([0-9.]+)\\.exr");
    std::vector<Recorded> all;
    for (const std::string& file : golden_files("diligent/")) {
        std::smatch part;
        if (!std::regex_match(file, part, form)) continue;
        const Recorded recorded{file, part[1], part[3], part[4], unsigned(std::stoul(part[2]))};
        const std::string read = recorded.folder(recorded.frame) + stage_before + "_" + recorded.technique;
        if (is_golden(read + ".exr") || is_golden(read + "_" + recorded.factor + ".exr")) all.push_back(recorded);
    }
    return all;
}

struct DiligentAccumulationOf : TechniqueTest, testing::WithParamInterface<Recorded> {};
struct DiligentCleanupOf : TechniqueTest, testing::WithParamInterface<Recorded> {};

AccumulationInputs accumulation_inputs(const Recorded& recorded) {
    const HostGBuffer gbuffer = diligent_golden_frame(recorded.sequence, recorded.frame);
    const LayeredImage aux = read_golden(recorded.folder(recorded.frame) + "aux.exr");
    const LayeredImage spatial =
        read_golden(recorded.folder(recorded.frame) + "spatial_" + recorded.technique + ".exr");
    const glm::uvec2 extent = gbuffer.extent();
    return {.camera = gbuffer.camera,
            .motion = gbuffer.motion,
            .previous_depth = gbuffer.previous_depth,
            .reprojected_depth = golden_layer(aux, "rpdepth"),
            .mask = golden_layer(aux, "mask"),
            .resolved = {golden_layer(spatial, "rad"), golden_layer(spatial, "var")},
            .hit_depth = golden_layer(spatial, "hitdepth"),
            .history = recorded.frame > 0 ? recorded.accumulated(recorded.frame - 1)
                                          : Filtered{HostImage(extent, 4), HostImage(extent, 1)}};
}

IsCompared where_one(const HostImage& mask) {
    return [&mask](unsigned x, unsigned y) { return *mask.pixel(x, y) == 1; };
}

TEST_P(DiligentAccumulationOf, RecordedFrame) {
    const Recorded& recorded = GetParam();
    const AccumulationInputs inputs = accumulation_inputs(recorded);
    AccumulationBench bench(device(), inputs.mask.extent, recorded.parameters());
    const Filtered ours = bench.accumulate(inputs), golden = recorded.accumulated(recorded.frame);
    expect_near("radiance", ours.radiance, golden.radiance, where_one(inputs.mask), one_half);
    expect_near("variance", ours.variance, golden.variance, where_one(inputs.mask), one_half);
}

TEST_P(DiligentCleanupOf, RecordedFrame) {
    const Recorded& recorded = GetParam();
    const HostGBuffer gbuffer = diligent_golden_frame(recorded.sequence, recorded.frame);
    const LayeredImage aux = read_golden(recorded.folder(recorded.frame) + "aux.exr");
    const CleanupInputs inputs{.camera = gbuffer.camera,
                               .depth = gbuffer.depth,
                               .normal = gbuffer.normal,
                               .mask = golden_layer(aux, "mask"),
                               .roughness = golden_layer(aux, "rough"),
                               .accumulated = recorded.accumulated(recorded.frame)};
    AccumulationBench bench(device(), gbuffer.extent(), recorded.parameters());
    expect_near("reflections", bench.clean_up(inputs), golden_layer(read_golden(recorded.file), "rad"),
                where_one(inputs.mask), one_half);
}

std::string name_of(const testing::TestParamInfo<Recorded>& info) { return golden_test_name(info.param.file); }

INSTANTIATE_TEST_SUITE_P(golden_diligent_temporal, DiligentAccumulationOf,
                         testing::ValuesIn(recorded_outputs("temporal", "spatial")), name_of);
INSTANTIATE_TEST_SUITE_P(golden_diligent_bilateral, DiligentCleanupOf,
                         testing::ValuesIn(recorded_outputs("bilateral", "temporal")), name_of);

}  // namespace
