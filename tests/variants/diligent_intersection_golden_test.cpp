#include "tests/variants/diligent_trace.h"

#include <algorithm>
#include <cmath>

namespace {

/// How many rays end as the recorded ones.
struct Agreement {
    size_t rays = 0, same_pixel = 0, same_confidence = 0;
    size_t directions = 0, same_direction = 0, same_density = 0;
};

struct DiligentIntersectionOf : TechniqueTest, testing::WithParamInterface<std::string> {
    HostGBuffer gbuffer = diligent_golden_gbuffer(GetParam());

    std::string file(const std::string& kind, const std::string& set) const {
        return GetParam() + "/" + kind + "_" + set + ".exr";
    }

    /// Mirrors take no notice of the random numbers, so that copies without any hold mirrors only.
    HostImage noise() const {
        const std::string name = GetParam() + "/noise.exr";
        return is_golden(name) ? golden_layer(read_golden(name), "U") : HostImage({128, 128}, 2, 0.5f);
    }

    DiligentTraced trace(const std::string& set, const std::string& recorded_technique, bool float_rays) {
        nlohmann::json parameters = diligent_preset(recorded_technique);
        parameters.update(diligent_golden_parameters(GetParam(), set));
        parameters["float_rays"] = float_rays;
        return diligent_trace_frame(device(), gbuffer, parameters, noise());
    }
};

const float largest_half = 65504;

/// Directions and densities were recorded in halves, where large densities saturate.
Agreement compare(const DiligentTraced& found, const LayeredImage& golden, const std::string& recorded_technique) {
    const HostImage &mask = golden_layer(golden, "mask"), &hit = golden_layer(golden, "hit"),
                    &confidence = golden_layer(golden, "conf");
    const Layer *direction = golden.find("dir"), *density = golden.find("pdf"), *of_seed = golden.find("pdfseed");
    Agreement agreement;
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask.values[i] != 1) continue;
        const float* ours = &found.radiance.values[4 * i];  // u, v, 1, confidence
        const glm::vec2 pixel = glm::floor(glm::vec2(ours[0], ours[1]) * glm::vec2(mask.extent));
        const glm::vec2 expected(hit.values[2 * i], hit.values[2 * i + 1]);
        ++agreement.rays;
        agreement.same_pixel += confidence.values[i] > 0 ? ours[3] > 0 && pixel == expected : ours[3] == 0;
        agreement.same_confidence += std::abs(ours[3] - confidence.values[i]) <= 1.0f / 255;
        if (!direction) continue;
        ++agreement.directions;
        agreement.same_direction += glm::distance(found.direction.rgb(i), direction->image.rgb(i)) <=
                                    0.01f * glm::length(direction->image.rgb(i));
        const bool differs = recorded_technique == "seed" && of_seed->image.values[i] != 0;
        const float p = differs ? of_seed->image.values[i] : density->image.values[i];
        agreement.same_density += std::abs(std::min(found.direction.values[4 * i + 3], largest_half) - p) <= 0.01f * p;
    }
    return agreement;
}

/// Recorded rays that do not change when depth moves by two units in the last place. Of the 710 443 of the full data
/// 126 end in a neighbouring pixel, where the surface and the border of a pixel are met at once, and 4 have another
/// confidence. No direction or length differs by 1 %; 186 densities of 473 559 do, all of a roughness of 0.05, whose
/// distribution is the rounding of a cosine near 1. The bounds leave room for devices that round otherwise.
TEST_P(DiligentIntersectionOf, EndsRaysWhereTheOriginalDoes) {
    encode_hits(gbuffer);
    for (const std::string set : {"p1", "p2", "p3"})
        for (const std::string recorded_technique : {"head", "seed"}) {
            SCOPED_TRACE(set + " " + recorded_technique);
            const Agreement found =
                compare(trace(set, recorded_technique, true), read_golden(file("hit", set)), recorded_technique);
            EXPECT_GT(found.rays, 5000u);
            EXPECT_GE(double(found.same_pixel), 0.9990 * double(found.rays));
            EXPECT_GE(double(found.same_confidence), 0.9990 * double(found.rays));
            EXPECT_GE(double(found.same_direction), 0.9990 * double(found.directions));
            EXPECT_GE(double(found.same_density), 0.9950 * double(found.directions));
        }
}

TEST_P(DiligentIntersectionOf, ShowsTheOriginalsColours) {
    const HostImage found = trace("p1", "head", false).radiance;
    const HostImage golden = golden_layer(read_golden(file("color", "p1")), "rad");
    const HostImage hit_mask = golden_layer(read_golden(file("hit", "p1")), "mask");
    const HostImage mask = golden_layer(read_golden(file("mask", "rthr0.65")), "mask");
    size_t rays = 0, differing = 0;
    for (size_t i = 0; i < golden.values.size(); ++i) {
        // Recorded in halves that were truncated: one unit in the last place is 2^-10 of the value at most.
        const bool differs = std::abs(found.values[i] - golden.values[i]) > golden.values[i] * 0x1p-10f;
        EXPECT_FALSE(differs && mask.values[i / 4] == 0) << "without a ray, at " << i;
        rays += hit_mask.values[i / 4] == 1;
        differing += hit_mask.values[i / 4] == 1 && differs;
    }
    EXPECT_GT(rays, 20000u);
    EXPECT_LT(double(differing), 0.001 * double(rays));
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_intersection, DiligentIntersectionOf, testing::ValuesIn(diligent_still_sets()),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
