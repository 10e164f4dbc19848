#include "experiments/study/measuring/frames/lit_filter.h"
#include "core/scene/load_scene.h"
#include "experiments/study/config/shots/shot.h"

#include <gtest/gtest.h>
#include <random>

// The lit colour without its noise: by closed forms, and by a path tracer's light beside that of 16 times the samples.

namespace {

constexpr glm::uvec2 extent{96, 64};

/// A wall that faces the camera from 2 m, a third of it with an albedo of its own.
LitSurfaces wall() {
    LitSurfaces s{.albedo = HostImage(extent, 3, 0.8f),
                  .emitted = HostImage(extent, 3),
                  .normal = HostImage(extent, 3),
                  .position = HostImage(extent, 3),
                  .distance = HostImage(extent, 1, 2.0f)};
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t i = size_t(y) * extent.x + x;
            if (x % 3 == 0) s.albedo.set_rgb(i, {0.1f, 0.3f, 0.05f});
            s.normal.set_rgb(i, {0, 0, 1}), s.position.set_rgb(i, {0.01f * float(x), 0.01f * float(y), -2});
        }
    return s;
}

/// Two halves whose samples are gamma distributed about `light` times albedo: skewed, as light is.
ReferenceOutput noisy(const LitSurfaces& surfaces, const std::function<float(unsigned x, unsigned y)>& light,
                      float relative_deviation, unsigned seed) {
    std::mt19937 random(seed);
    ReferenceOutput lit{.mean = HostImage(extent, 3),
                        .half_a = HostImage(extent, 3),
                        .half_b = HostImage(extent, 3),
                        .variance = HostImage(extent, 3)};
    const float shape = relative_deviation > 0 ? 1 / (relative_deviation * relative_deviation) : 0;
    std::gamma_distribution<float> gamma(shape > 0 ? shape : 1, shape > 0 ? 1 / shape : 1);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t i = size_t(y) * extent.x + x;
            const glm::vec3 mean = light(x, y) * surfaces.albedo.rgb(i), emitted = surfaces.emitted.rgb(i);
            const auto draw = [&] { return relative_deviation > 0 ? gamma(random) : 1.0f; };
            lit.half_a.set_rgb(i, mean * draw() + emitted), lit.half_b.set_rgb(i, mean * draw() + emitted);
            lit.mean.set_rgb(i, 0.5f * (lit.half_a.rgb(i) + lit.half_b.rgb(i)));
            lit.variance.set_rgb(i, 0.5f * relative_deviation * relative_deviation * mean * mean);
        }
    return lit;
}

double squared_error(const HostImage& image, const LitSurfaces& surfaces,
                     const std::function<float(unsigned x, unsigned y)>& light) {
    double sum = 0;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t i = size_t(y) * extent.x + x;
            const glm::vec3 off = image.rgb(i) - light(x, y) * surfaces.albedo.rgb(i) - surfaces.emitted.rgb(i);
            sum += glm::dot(off, off);
        }
    return sum / double(image.pixel_count());
}

double mean_of(const HostImage& image) {
    double sum = 0;
    for (const float value : image.values) sum += value;
    return sum / double(image.values.size());
}

}  // namespace

/// 225 pixels of one light: a mean over them would have 1/225 of the variance; weights that follow noise leave more.
TEST(LitFilter, LeavesLittleOfTheNoiseOfAnEvenlyLitTexture) {
    const LitSurfaces surfaces = wall();
    const auto even = [](unsigned, unsigned) { return 3.0f; };
    const ReferenceOutput lit = noisy(surfaces, even, 0.5f, 1);
    const FilteredLit filtered = filter_lit(lit, surfaces);
    EXPECT_LT(squared_error(filtered.mean, surfaces, even), squared_error(lit.mean, surfaces, even) / 25);
    EXPECT_LT(squared_error(filtered.half_a, surfaces, even), squared_error(lit.half_a, surfaces, even) / 25);
    // The mean of 6144 pixels has a relative deviation of 0.5 / sqrt(2 * 6144) = 0.45 %; five of them.
    const LitSurfaces& s = surfaces;
    EXPECT_NEAR(mean_of(filtered.mean) / (3 * mean_of(s.albedo)), 1, 5 * 0.0045);
}

/// An edge that is one pixel too soft leaves more than an eighth of the error. If the pixels beside it took half of the
/// other side's light, they would be off by 1.75: a squared error of 2 * 1.75^2 = 6.1 in each row, beside
/// 44 * 0.3^2 / 2 * 4^2 = 32 of the noise of its lit pixels, 44 on average: 0.19. What the filter leaves is 1/32; with
/// six other seeds it was 1/59 to 1/37.
TEST(LitFilter, KeepsTheEdgesOfShadows) {
    const LitSurfaces surfaces = wall();
    const auto shadow = [](unsigned x, unsigned y) { return x + y / 2 < 60 ? 4.0f : 0.5f; };
    const ReferenceOutput lit = noisy(surfaces, shadow, 0.3f, 2);
    const FilteredLit filtered = filter_lit(lit, surfaces);
    EXPECT_LT(squared_error(filtered.mean, surfaces, shadow), squared_error(lit.mean, surfaces, shadow) / 8);
}

TEST(LitFilter, KeepsLightWithoutNoiseAndEmission) {
    LitSurfaces surfaces = wall();
    for (size_t i = 0; i < 40; ++i) surfaces.emitted.set_rgb(i * 7, glm::vec3(float(i)));
    const auto waves = [](unsigned x, unsigned y) {
        return 1.5f + std::sin(0.7f * float(x)) * std::cos(0.4f * float(y));
    };
    const ReferenceOutput lit = noisy(surfaces, waves, 0, 3);
    const FilteredLit filtered = filter_lit(lit, surfaces);
    for (size_t i = 0; i < lit.mean.values.size(); ++i)
        ASSERT_NEAR(filtered.mean.values[i], lit.mean.values[i], 1e-5f * (1 + lit.mean.values[i])) << i;
}

/// Light that differs by less than its noise is not exchanged between a floor and a wall, nor between parallel planes.
TEST(LitFilter, DoesNotMixSurfaces) {
    for (const bool are_parallel : {false, true}) {
        LitSurfaces surfaces = wall();
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = extent.x / 2; x < extent.x; ++x) {
                const size_t i = size_t(y) * extent.x + x;
                if (are_parallel)
                    surfaces.position.set_rgb(i, surfaces.position.rgb(i) - glm::vec3(0, 0, 0.2f));
                else
                    surfaces.normal.set_rgb(i, {0, 1, 0});
            }
        const auto two = [](unsigned x, unsigned) { return x < extent.x / 2 ? 1.0f : 1.4f; };
        const ReferenceOutput lit = noisy(surfaces, two, 1.0f, 4);
        const FilteredLit filtered = filter_lit(lit, surfaces);
        double near_edge[2] = {0, 0}, expected[2] = {0, 0};
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = extent.x / 2 - 4; x < extent.x / 2 + 4; ++x) {
                const size_t i = size_t(y) * extent.x + x;
                near_edge[x >= extent.x / 2] += filtered.mean.rgb(i).x;
                expected[x >= extent.x / 2] += two(x, y) * surfaces.albedo.rgb(i).x;
            }
        // 256 pixels a side, whose means hold those of about 12 columns more: a deviation of 2 to 3 %.
        EXPECT_NEAR(near_edge[0] / expected[0], 1, 0.1) << are_parallel;
        EXPECT_NEAR(near_edge[1] / expected[1], 1, 0.1) << are_parallel;
    }
}

/// What it is for. A room and a street, 16 samples a pixel: 0.27 and 0.54 of the error are left, a sixteenth of it the
/// noise of what stands for the truth. At this size a street's details are smaller than the window.
TEST(LitFilter, LeavesLittleOfAPathTracersError) {
    for (const auto& [name, most] : {std::pair("room:3", 0.4), std::pair("street:2", 0.7)}) {
        const Shot shot = load_shot({.scene = name, .extent = {96, 54}, .frames = {0}}, scene_search_path({}));
        const ShotFrame now = shot_frame(shot, 0);
        const auto render = [&](unsigned samples, unsigned seed) {
            ReferenceSettings settings{.max_samples = samples, .seed = seed, .lit_only = true};
            return render_reference(shot.scene, now.scene, now.camera, shot.config.extent, settings).diffuse;
        };
        const ReferenceOutput few = render(16, 1), truth = render(256, 2);
        const FilteredLit filtered =
            filter_lit(few, lit_surfaces(shot.scene, now.scene, now.camera, shot.config.extent));
        // As a display shows it: a single bright path would decide the squared error of radiances.
        const auto error = [&](const HostImage& image) {
            double sum = 0;
            for (size_t i = 0; i < image.pixel_count(); ++i) {
                const glm::vec3 a = image.rgb(i), b = truth.mean.rgb(i), off = a / (1.0f + a) - b / (1.0f + b);
                sum += glm::dot(off, off);
            }
            return sum;
        };
        EXPECT_LT(error(filtered.mean), most * error(few.mean)) << name;
    }
}
