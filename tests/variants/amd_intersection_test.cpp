#include "tests/variants/amd_golden.h"
#include "tests/variants/variant_fixture.h"

#include <cmath>

namespace {

/// Where the rays of the recorded passes ended, beside ours.
struct Agreement {
    size_t rays = 0, same_pixel = 0, same_confidence = 0, same_length = 0;
    size_t flips = 0, other_pixel = 0;  ///< hit against miss; hits in two pixels
};

struct AmdIntersectionOf : VariantTest, testing::WithParamInterface<std::string> {
    const HostGBuffer hit_gbuffer = amd_golden_hit_gbuffer(GetParam());
    const HostImage noise = golden_layer(read_golden(GetParam() + "/noise.exr"), "U");

    Agreement compare(const std::string& name, float mask) {
        const AmdTraced found = amd_trace_frame(device(), hit_gbuffer, amd_golden_parameters(GetParam(), name), noise);
        const LayeredImage golden = read_golden(GetParam() + "/hit_" + name + ".exr");
        Agreement a;
        for (size_t i = 0; i < found.radiance.pixel_count(); ++i) {
            if (golden_layer(golden, "mask").values[i] != mask) continue;
            const float* ours = &found.radiance.values[4 * i];
            const float confidence = golden_layer(golden, "conf").values[i],
                        length = golden_layer(golden, "len").values[i];
            const glm::vec2 pixel =
                glm::floor(glm::vec2(ours[0], ours[1]) / ours[2] * glm::vec2(found.radiance.extent));
            const float* hit = &golden_layer(golden, "hit").values[2 * i];
            const bool is_hit = ours[2] > 0, is_golden_hit = confidence > 0;
            const bool is_same = is_hit == is_golden_hit && (!is_hit || pixel == glm::vec2(hit[0], hit[1]));
            ++a.rays;
            a.same_pixel += is_same;
            a.flips += is_hit != is_golden_hit;
            a.other_pixel += is_hit && is_golden_hit && !is_same;
            a.same_confidence += std::abs(ours[2] - confidence) <= 1.0f / 255;
            a.same_length += std::abs(ours[3] - length) <= 0.01f * length;
        }
        std::printf("%s: %zu of %zu hit pixels differ (%zu flips, %zu elsewhere), %zu confidences, %zu lengths\n",
                    name.c_str(), a.rays - a.same_pixel, a.rays, a.flips, a.other_pixel, a.rays - a.same_confidence,
                    a.rays - a.same_length);
        return a;
    }
};

TEST_P(AmdIntersectionOf, EndsRaysWhereTheOriginalDoes) {
    for (const char* name : {"p1", "p2", "p3", "p4"}) {
        SCOPED_TRACE(name);
        const Agreement stable = compare(name, 1.0f);
        compare(name, 0.5f);
        EXPECT_GT(double(stable.same_pixel), 0.995 * double(stable.rays));
        EXPECT_GT(double(stable.same_confidence), 0.995 * double(stable.rays));
    }
}

INSTANTIATE_TEST_SUITE_P(golden_amd_intersection, AmdIntersectionOf, testing::ValuesIn(amd_tracer_sets()),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
