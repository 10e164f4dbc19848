// Targets of 16 bits get no number that they cannot hold: what devices make of those differs. To see what shaders hand
// on, their targets here have 32 bits, which the shaders do not know.
#include "tests/variants/diligent_frames.h"
#include "tests/variants/diligent_hits.h"
#include "tests/variants/reconstruction_bench.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr float largest_half = 65504;

const DiligentParameters& wide() {
    static DiligentParameters parameters;
    static const bool is_set = (parameters.params.assign({{"float_rays", true}, {"float_histories", true}}), true);
    (void)is_set;
    return parameters;
}

float largest_of(const HostImage& image) {
    float largest = 0;
    for (const float value : image.values) {
        EXPECT_FALSE(std::isnan(value));
        largest = std::max(largest, std::abs(value));
    }
    return largest;
}

using DiligentHalves = DiligentHits;

/// A mirror's density without the floor is 1 / (4 pi alpha^2) for the least alpha, 1e-3, and a grazing view: 8e4 and
/// more. Scenes may be long, and lights bright.
TEST_F(DiligentHalves, OfRaysHoldWhatTheyAreGiven) {
    const float scale = 65536;
    enlarge(scale);
    HostGBuffer gbuffer = gbuffer_of(scaled(scale));
    for (float& value : gbuffer.lit.values) value *= 1e6f;
    for (const bool float_rays : {false, true}) {
        DiligentFrames frame(
            device(), gbuffer.extent(),
            {{"distribution_floor", false}, {"hierarchy.relative_ray_step", true}, {"float_rays", float_rays}});
        frame.begin(gbuffer);
        PassList& pass_list = frame.pass_list;
        const Image numbers = pass_list.image_of("blue_noise", Format::rg32f, noise.extent);
        pass_list.upload(numbers, noise);
        const Tracers::Images hierarchies = diligent_depth_hierarchies(pass_list, frame.gbuffer, wide().tracing);
        const DiligentRays rays = diligent_trace(pass_list, frame.gbuffer, hierarchies, numbers, frame.gbuffer.lit,
                                                 frame.mask(), wide().tracing);
        const HostImage radiance = pass_list.download(rays.radiance), direction = pass_list.download(rays.direction);
        HostImage density(direction.extent, 1);
        for (size_t i = 0; i < density.pixel_count(); ++i) density.values[i] = direction.values[4 * i + 3];
        for (const HostImage* image : std::initializer_list<const HostImage*>{&radiance, &direction, &density}) {
            if (float_rays) {
                EXPECT_GT(largest_of(*image), 1.2f * largest_half);
            } else {
                EXPECT_EQ(largest_of(*image), largest_half);
            }
        }
    }
}

/// Black rays and such of 6e4: their luminances vary by up to 9e8.
TEST_F(DiligentHalves, OfVariancesHoldWhatTheyAreGiven) {
    const ReconstructionInputs inputs = reflecting_wall(
        {.ray = [](unsigned x, unsigned) { return TexelRay{.radiance = glm::vec3(x % 2 > 0 ? 6e4f : 0.0f)}; }});
    for (const bool float_histories : {false, true}) {
        ReconstructionBench bench(device(), inputs.depth.extent, {{"float_histories", float_histories}});
        const Reconstruction found = bench.run(inputs, &wide().filter);
        EXPECT_GT(largest_of(found.radiance), 3e4f);
        if (float_histories) {
            EXPECT_GT(largest_of(found.variance), 1e8f);
        } else {
            EXPECT_EQ(largest_of(found.variance), largest_half);
        }
    }
}

}  // namespace
