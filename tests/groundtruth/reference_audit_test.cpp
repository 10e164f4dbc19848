// What a reference says of its own errors: its halves against its variance, and light beyond the longest path.
#include "groundtruth/reference/reference_audit.h"
#include "groundtruth/reference/reference_error.h"

#include "core/scene/load_scene.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace {

/// An output of independent pixels whose 16 batches are drawn from `batch`; the variance is stated `understated` times
/// too small, and half B has `shared` of half A's error.
ReferenceOutput output(unsigned size, const std::function<double()>& batch, double understated = 1, double shared = 0) {
    ReferenceOutput result;
    for (HostImage* image : {&result.mean, &result.half_a, &result.half_b, &result.variance})
        *image = HostImage({size, size}, 3);
    for (size_t i = 0; i < size_t(size) * size; ++i) {
        double half[2], variance = 0;
        for (double& h : half) {
            double values[8], sum = 0;
            for (double& v : values) sum += v = batch();
            h = sum / 8;
            for (const double v : values) variance += 0.25 * (v - h) * (v - h) / (7 * 8);
        }
        half[1] = shared * half[0] + (1 - shared) * half[1];
        result.half_a.set_rgb(i, glm::vec3(half[0])), result.half_b.set_rgb(i, glm::vec3(half[1]));
        result.mean.set_rgb(i, glm::vec3(0.5 * (half[0] + half[1])));
        result.variance.set_rgb(i, glm::vec3(variance / understated));
    }
    return result;
}

struct Audits : testing::Test {
    std::mt19937 random{7};
    std::normal_distribution<double> normal;
    std::exponential_distribution<double> exponential;
    const std::function<double()> normal_batch = [this] { return normal(random); },
                                  // Few batches meet a bright path, and those that do are hundreds of times brighter.
        rare_batch = [this] {
            const double u = double(random()) / 4294967296.0;
            return 0.01 * normal(random) + (u < 0.02 ? std::pow(u / 0.02, -0.6) : 0.0);
        };
};

}  // namespace

TEST_F(Audits, PassSoundOutputsOfAnyDistribution) {
    // Once in 10^6 per output is promised; here are 600, so that 1 in 1600 seeds would fail a correct audit.
    for (int i = 0; i < 300; ++i) {
        EXPECT_TRUE(audit_halves(output(12, normal_batch)).is_passed());
        EXPECT_TRUE(audit_halves(output(12, rare_batch)).is_passed());
    }
    // The mean is 14/12 for normal batches, and between 1 and that with rare bright paths. 4096 pixels know it to 3 %.
    EXPECT_NEAR(audit_halves(output(64, normal_batch)).mean_z_squared, 14.0 / 12, 0.15);
    EXPECT_NEAR(audit_halves(output(64, rare_batch)).mean_z_squared, 13.0 / 12, 0.2);
}

TEST_F(Audits, FindWrongVariancesAndDependence) {
    EXPECT_FALSE(audit_halves(output(64, normal_batch, 1.4)).is_passed());
    EXPECT_FALSE(audit_halves(output(64, normal_batch, 0.6)).is_passed());
    EXPECT_FALSE(audit_halves(output(64, normal_batch, 1, 0.4)).is_passed());
    EXPECT_FALSE(audit_halves(output(64, rare_batch, 1.5)).is_passed());
    ReferenceOutput smeared = output(64, normal_batch);  // neighbours share a third of their errors
    for (HostImage* half : {&smeared.half_a, &smeared.half_b})
        for (size_t i = 1; i < half->pixel_count(); ++i)
            half->set_rgb(i, 0.7f * half->rgb(i) + 0.3f * half->rgb(i - 1));
    const HalfAudit audit = audit_halves(smeared);
    EXPECT_GT(audit.correlation, audit.most_correlation);
}

TEST_F(Audits, OfReferencesPassAndKnowWhatTheDepthCuts) {
    const auto audit = [&](const std::string& name, const ReferenceSettings& settings) {
        const Scene scene = load_scene(name, {std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes"});
        const ScenePose pose = pose_scene(scene, 0);
        const CameraPose camera = pose_camera(scene.cameras.front(), pose, 0);
        return audit_reference(render_reference(scene, pose, camera, {32, 18}, settings));
    };
    for (const unsigned samples : {16u, 128u}) {
        const ReferenceAudit sound = audit("roughness_gradient", {.max_samples = samples, .ladder = true});
        EXPECT_EQ(sound.outputs.size(), 6u);
        EXPECT_TRUE(sound.warnings.empty()) << sound.warnings.front();
        EXPECT_LT(sound.light_cut, 1e-4);
    }
    const ReferenceAudit cut = audit("facing_mirrors", {.max_samples = 64, .max_depth = 2});
    EXPECT_GT(cut.light_cut, largest_light_cut);
    ASSERT_EQ(cut.warnings.size(), 1u);
    EXPECT_NE(cut.warnings.front().find("max_depth"), std::string::npos);
}

TEST(ReferenceError, OfDarkPixelsIsRelativeToTheImage) {
    // Means 2, 0.5 and 0 beside the background's 7: darker than 1 % of 2.5 / 3 is only the last.
    Reference reference;
    reference.material_id = HostImage({4, 1}, 1, 1.0f);
    reference.material_id.values[3] = 0;
    ReferenceOutput output;
    output.mean = HostImage({4, 1}, 3), output.variance = HostImage({4, 1}, 3, 0.01f);
    for (size_t i = 0; i < 4; ++i) output.mean.set_rgb(i, glm::vec3(std::array{2.0f, 0.5f, 0.0f, 7.0f}[i]));
    const HostImage error = relative_error(reference, output);
    // Rounding of float32 in the variance, its root and the result: 3 x 6e-8 of 0.2 at most, and of 12.
    EXPECT_NEAR(error.values[0], 0.1 / 2, 1e-6);
    EXPECT_NEAR(error.values[1], 0.1 / 0.5, 1e-6);
    EXPECT_NEAR(error.values[2], 0.1 / (0.01 * 2.5 / 3), 1e-4);
}
