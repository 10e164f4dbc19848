#include "variants/common/repaired_inputs.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <limits>

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

struct RepairedInputsTest : TechniqueTest {
    glm::uvec2 extent{4, 1};
    ParameterSet no_parameters;

    HostGBuffer plain() const {
        HostGBuffer g{.depth = HostImage(extent, 1, 0.5f),
                      .geometric_normal = HostImage(extent, 4, 0.0f),
                      .normal = HostImage(extent, 4, 0.0f),
                      .base_color = HostImage(extent, 4, 0.3f),
                      .emission = HostImage(extent, 4, 0.2f),
                      .motion = HostImage(extent, 2, 0.01f),
                      .material_id = HostImage(extent, 1, 1.0f),
                      .previous_depth = HostImage(extent, 1, 0.5f),
                      .previous_normal = HostImage(extent, 4, 0.0f),
                      .lit = HostImage(extent, 4, 2.0f),
                      .fallback = HostImage(extent, 4, 1.0f)};
        for (HostImage* image : {&g.geometric_normal, &g.normal, &g.previous_normal})
            for (size_t i = 0; i < image->pixel_count(); ++i) image->set_rgb(i, {0, 0.6f, 0.8f});
        g.camera.depth.z = 1.0f;
        g.camera.world_from_view = glm::mat4(1.0f);
        return g;
    }
    HostGBuffer repaired(const HostGBuffer& given) {
        PassList pass_list(device(), extent);
        const GBuffer gbuffer = upload_gbuffer(pass_list, given);
        pass_list.begin_frame(given.camera, no_parameters, gbuffer.images());
        const RepairedInputs inputs(pass_list, gbuffer, true);
        return download_gbuffer(pass_list, inputs.gbuffer(), given.camera, DepthFormat::d32f);
    }
};

TEST_F(RepairedInputsTest, SoundValuesKeepTheirBits) {
    HostGBuffer given = plain();
    given.depth.values[2] = 1.0f, given.normal.set_rgb(2, glm::vec3(0));  // background
    given.lit.values[0] = 1e6f, given.lit.values[1] = 1e-40f, given.motion.values[0] = -2.0f;
    const HostGBuffer result = repaired(given);
    EXPECT_EQ(result.depth.values, given.depth.values);
    EXPECT_EQ(result.normal.values, given.normal.values);
    EXPECT_EQ(result.lit.values, given.lit.values);
    EXPECT_EQ(result.motion.values, given.motion.values);
    EXPECT_EQ(result.emission.values, given.emission.values);
}

TEST_F(RepairedInputsTest, FaultsBecomeWhatNoTechniqueMinds) {
    HostGBuffer given = plain();
    given.depth.values = {nan, 0.2f, inf, -0.1f};
    given.normal.set_rgb(0, {nan, 0, 1});
    given.normal.set_rgb(1, {0, 0, 0});
    given.normal.set_rgb(2, {0, 0, 2});
    given.normal.values[15] = nan;  // roughness
    given.lit.values[5] = inf;
    given.motion.values[1] = nan;
    const HostGBuffer result = repaired(given);
    EXPECT_EQ(result.depth.values, (std::vector<float>{1, 0.2f, 1, 1}));
    EXPECT_EQ(result.normal.rgb(0), glm::vec3(0, 0, 1)) << "towards the viewer";
    EXPECT_EQ(result.normal.rgb(1), glm::vec3(0, 0, 1));
    EXPECT_EQ(result.normal.rgb(2), glm::vec3(0, 0, 1)) << "of unit length";
    EXPECT_EQ(result.normal.values[15], 1.0f);
    EXPECT_EQ(result.lit.rgb(1), glm::vec3(0));
    EXPECT_EQ(result.lit.rgb(0), glm::vec3(2));
    EXPECT_EQ(result.motion.values[0], 0.0f);
}

TEST_F(RepairedInputsTest, OthersSeeTheGivenInputsAgain) {
    const HostGBuffer given = plain();
    PassList pass_list(device(), extent);
    const GBuffer gbuffer = upload_gbuffer(pass_list, given);
    pass_list.begin_frame(given.camera, no_parameters, gbuffer.images());
    { const RepairedInputs inputs(pass_list, gbuffer, true); }
    EXPECT_EQ(pass_list.times().size(), 1u);
    EXPECT_EQ(pass_list.times().front().stage, RepairedInputs::stage);
    { const RepairedInputs inputs(pass_list, gbuffer, false); }
    EXPECT_EQ(pass_list.times().size(), 1u) << "nothing runs where it is not wanted";
}

TEST_F(RepairedInputsTest, AreLeftOutWhereInputsAreSound) {
    for (const bool is_faulty : {false, true}) {
        const auto technique = make_technique("simple_ssr", {}, "corrected");
        SceneFacts facts;
        facts.has_geometry = facts.has_reflective = true, facts.min_roughness = 0;
        facts.has_faulty_inputs = is_faulty;
        const std::vector<LeftOut> left_out = technique->leave_out(facts);
        ASSERT_EQ(left_out.size(), is_faulty ? 0u : 1u);
        if (!is_faulty) {
            EXPECT_EQ(left_out.front().what, RepairedInputs::stage);
        }
    }
}

}  // namespace
