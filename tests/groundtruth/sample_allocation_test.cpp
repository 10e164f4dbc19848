// Renders with a target over integrands with known moments: who decides a pixel's samples, and that no bias comes of
// it. And what time limits do.
#include "groundtruth/reference/sample_allocation.h"

#include "groundtruth/reference/reference_guide.h"
#include "groundtruth/reference/reference_stopping.h"
#include "groundtruth/sampling/sobol.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace {

constexpr glm::uvec2 extent(32, 16);
constexpr double bright_share = 1.0 / 3;  ///< of the radiance, which is 1

struct Random {  // a generator as the standard library wants it, cheap to seed
    using result_type = uint64_t;
    uint64_t state;
    static constexpr uint64_t min() { return 0; }
    static constexpr uint64_t max() { return ~uint64_t(0); }
    uint64_t operator()() { return hash_bits_64(state += 0x9e3779b97f4a7c15u); }
};

/// Every sample is 2/3 and, with mean rate `p`, meets bright paths of radiance 1 / (3 p). `seed_of` changes what pixels
/// draw; a sample costs one ray, and so does a first hit.
PixelTracer rare_bright_paths(double p, std::function<uint64_t(unsigned x, unsigned y)> seed_of) {
    return {.first_hit = [](unsigned, unsigned) { return FirstHit{.is_hit = true}; },
            .trace =
                [p, seed_of](unsigned x, unsigned y, const FirstHit&, unsigned, unsigned count,
                             std::span<SampleBatch> batches, Directions) {
                    for (auto& [seed, estimate] : batches) {
                        Random random{hash_bits_64(seed ^ seed_of(x, y)) ^ hash_bits_64(uint64_t(y) << 32 | x)};
                        std::poisson_distribution<uint64_t> met(p * count);
                        const double sum = (1 - bright_share) * count + bright_share / p * double(met(random));
                        estimate.specular += glm::dvec3(sum);
                        estimate.incident += glm::dvec3(sum);
                        estimate.samples += count, estimate.lobe_samples += count, estimate.rays += count;
                    }
                }};
}

/// `seconds_before`: of earlier runs.
Reference render(const PixelTracer& tracer, const ReferenceSettings& settings, double seconds_before,
                 const PixelTracer& guide_tracer) {
    const ReferenceRun run;
    ReferenceState state = empty_state(extent, settings);
    RenderedGuide guide = render_guide(guide_tracer, extent, ReferenceSettings().guide_samples, run);
    state.reference.guide = std::move(guide.means);
    state.guide_variance = std::move(guide.specular_variance);
    RenderClock clock{.run = run, .seconds_before = seconds_before};
    render_until_limits(state, tracer, clock);
    return std::move(state.reference);
}

Reference render(const PixelTracer& tracer, const ReferenceSettings& settings, double seconds_before = 0) {
    return render(tracer, settings, seconds_before, tracer);
}

/// Earlier runs stand for the clock: beside 10^9 s those of a test are nothing, however slow the machine is.
constexpr double long_limit = 1e9;

double sum_of(const HostImage& image) { return std::accumulate(image.values.begin(), image.values.end(), 0.0); }

}  // namespace

TEST(SampleAllocation, InformsOneWay) {
    HostImage materials(extent, 1, 1.0f);
    for (size_t i = 0; i < materials.values.size(); ++i)
        materials.values[i] = float(1 + hash_bits(uint32_t(i / 7)) % 3);
    // Whoever is informed comes later in an order that all agree on: lattices, coarse ones first, then rows.
    std::vector<std::vector<size_t>> informers(materials.values.size());
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) find_informers(materials, x, y, informers[y * extent.x + x]);
    std::vector<int> depth(informers.size(), -1);  // -2: being visited
    const std::function<int(size_t)> depth_of = [&](size_t pixel) {
        if (depth[pixel] != -1) return depth[pixel];
        depth[pixel] = -2;
        int deepest = 0;
        for (const size_t i : informers[pixel]) {
            const int its = depth_of(i);
            EXPECT_NE(its, -2) << "pixels " << pixel << " and " << i << " inform each other";
            deepest = std::max(deepest, its + 1);
        }
        return depth[pixel] = deepest;
    };
    size_t alone = 0, surrounded = 0;
    for (size_t i = 0; i < informers.size(); ++i) {
        depth_of(i);
        alone += informers[i].empty();
        EXPECT_EQ(std::ranges::count(informers[i], i), 0);
        const auto has = [&](long offset) { return std::ranges::count(informers[i], size_t(long(i) + offset)) > 0; };
        const long row = extent.x;
        surrounded += (has(-1) && has(1)) || (has(-row - 1) && has(row + 1)) || (has(-row) && has(row));
    }
    EXPECT_EQ(alone, 1u);
    EXPECT_GT(surrounded, informers.size() / 8);  // with these materials, of which each pixel's neighbours have others
}

TEST(SampleAllocation, IsNotMovedByAPixelsOwnSamples) {
    // Exactly, over any number of passes: another seed at one pixel leaves its own count as it was, but not all
    // others'.
    const ReferenceSettings settings{.max_samples = 1 << 20, .target_relative_error = 0.03f};
    const double p = 1e-2;
    const PixelTracer guide = rare_bright_paths(p, [](unsigned, unsigned) { return 1; });
    const Reference base = render(guide, settings);
    EXPECT_NE(base.passes.find(", to 2048, to 16384"), std::string::npos)
        << base.passes;  // decisions over several passes
    size_t others_moved = 0;
    for (const glm::uvec2 pixel : {glm::uvec2(0, 0), {16, 0}, {8, 8}, {12, 4}, {5, 5}, {6, 2}, {7, 4}, {23, 15}}) {
        const auto seed_of = [&](unsigned x, unsigned y) { return uint64_t(x == pixel.x && y == pixel.y ? 2 : 1); };
        const Reference moved = render(rare_bright_paths(p, seed_of), settings, 0, guide);
        const size_t i = size_t(pixel.y) * extent.x + pixel.x;
        EXPECT_EQ(moved.sample_count.values[i], base.sample_count.values[i]) << pixel.x << ", " << pixel.y;
        others_moved += moved.sample_count.values != base.sample_count.values;
    }
    EXPECT_GE(others_moved, 5u);
}

TEST(SampleAllocation, GivesMoreToAPixelThatIsNoisyAlone) {
    // Like the inside of a mirror beside its edge: its informers have no noise. 2/9 of variance a sample need 560.
    const glm::uvec2 noisy(7, 4);
    const PixelTracer all = rare_bright_paths(0.5, [](unsigned, unsigned) { return 6; });
    PixelTracer one = all;
    one.trace = [&](unsigned x, unsigned y, const FirstHit& hit, unsigned first, unsigned count,
                    std::span<SampleBatch> batches, Directions directions) {
        if (glm::uvec2(x, y) == noisy) return all.trace(x, y, hit, first, count, batches, directions);
        for (SampleBatch& batch : batches) batch.estimate.specular += glm::dvec3(count);
    };
    const Reference r = render(one, {.max_samples = 1 << 16, .target_relative_error = 0.02f});
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const float samples = *r.sample_count.pixel(x, y);
            if (glm::uvec2(x, y) == noisy)
                EXPECT_GE(samples, 400);
            else
                EXPECT_EQ(samples, 256);
        }
}

TEST(SampleAllocation, SpendsTheTimeThatIsLeftWhereTargetsAreMissed) {
    const PixelTracer tracer = rare_bright_paths(1e-2, [](unsigned, unsigned) { return 7; });
    const ReferenceSettings untimed{.max_samples = 1 << 20, .target_relative_error = 0.05f};
    ReferenceSettings timed = untimed;
    timed.max_seconds = long_limit;
    const Reference before = render(tracer, untimed), after = render(tracer, timed);
    EXPECT_LT(before.reached_share, 0.95f);
    EXPECT_GT(after.reached_share, 0.985f);                                  // 0.998 with this seed
    EXPECT_LT(sum_of(after.sample_count), 8 * sum_of(before.sample_count));  // it ends before its limit
}

TEST(SampleAllocation, KeepsAllThatIsTraced) {
    for (const double seconds : {0.0, 0.02}) {
        const Reference r = render(rare_bright_paths(1e-2, [](unsigned, unsigned) { return 3; }),
                                   {.max_seconds = seconds, .target_relative_error = 0.05f});
        const double samples = sum_of(r.sample_count);
        const double passes = 1 + double(std::ranges::count(r.passes, ',') + std::ranges::count(r.passes, '+'));
        EXPECT_GE(r.rays, samples);
        EXPECT_LE(r.rays, samples + passes * double(r.sample_count.values.size()));  // and first hits
        EXPECT_EQ(sum_of(r.lobe_samples), samples);
    }
}

TEST(SampleAllocation, GivesEveryPixelItsFirstSamplesHoweverLateItIs) {
    for (const float target : {0.0f, 0.05f}) {
        const Reference r = render(rare_bright_paths(1e-2, [](unsigned, unsigned) { return 4; }),
                                   {.max_seconds = long_limit, .target_relative_error = target}, 2 * long_limit);
        EXPECT_EQ(r.passes, "16");
        EXPECT_TRUE(std::ranges::all_of(r.sample_count.values, [](float n) { return n == 16; })) << target;
    }
}

TEST(SampleAllocation, IsCutWithinFivePercentOfTheTimeLimit) {
    for (const double share_of_limit : {0.5, 1.04, 1.06})
        for (const bool can_be_cut : {false, true}) {
            const ReferenceRun run;
            ReferenceState state = empty_state(extent, {});
            state.sample_goal = HostImage(extent, 1, 32.0f);
            RenderClock clock{.run = run,
                              .seconds_before = share_of_limit * long_limit,
                              .time_limit = long_limit,
                              .cuts_pass = can_be_cut};
            const PixelTracer tracer = rare_bright_paths(1e-2, [](unsigned, unsigned) { return 5; });
            tbb::task_arena(1).execute([&] { render_pass(state, tracer, clock); });
            // A single thread looks at the clock after each pixel, which is traced whole or not at all.
            const bool is_cut = can_be_cut && share_of_limit > 1.05;
            const std::vector<float>& counts = state.reference.sample_count.values;
            const auto pixels_of = [&](float samples) { return size_t(std::ranges::count(counts, samples)); };
            EXPECT_EQ(pixels_of(32), is_cut ? 1 : counts.size()) << share_of_limit;
            EXPECT_EQ(pixels_of(0), is_cut ? counts.size() - 1 : 0) << share_of_limit;
            EXPECT_EQ(state.sample_goal.values, counts) << share_of_limit;
        }
}

TEST(SampleAllocation, IsWithoutBiasWhereBrightPathsAreRare) {
    // 16 to 256 paths meet a bright one where p = 1e-2, and one of 390 first passes does where p = 1e-5: from pixels
    // that are known at once to pixels that stop before they have seen what they are to measure. Stopping by a pixel's
    // own error makes the mean 10 to 33 % too small there (p = 1e-3, 1e-4). Errors of a pixel given its count have mean
    // 0 whatever other pixels have found, so that they add up as if they were independent, and Z is normal with over
    // 10^4 pixels but where hardly any event is met: there its tails are those of a Poisson count of 20 or more. 5
    // standard errors and 11 comparisons: 1 in 10^5 seeds fails a sound rule.
    constexpr double limit = 5, pixels = extent.x * extent.y;
    for (const auto& [p, seconds] :
         {std::pair(1e-2, 0.0), {1e-3, 0.0}, {1e-4, 0.0}, {1e-5, 0.0}, {1e-3, long_limit}, {1e-4, long_limit}}) {
        double error = 0, squares = 0, product = 0, product_squares = 0, sum_z_squared = 0;
        constexpr int images = 40;
        for (int image = 0; image < images; ++image) {
            const Reference r = render(rare_bright_paths(p, [&](unsigned, unsigned) { return 100u + unsigned(image); }),
                                       {.max_samples = 1 << 16, .max_seconds = seconds, .target_relative_error = 0.1f});
            double of_image = 0, variance = 0;
            for (size_t i = 0; i < r.sample_count.values.size(); ++i) {
                const double a = r.specular.half_a.values[3 * i] - 1.0, b = r.specular.half_b.values[3 * i] - 1.0;
                const double its_variance = bright_share * bright_share / p / r.sample_count.values[i];
                of_image += 0.5 * (a + b), variance += its_variance;
                product += a * b, product_squares += 4 * its_variance * its_variance;  // a half has twice the variance
            }
            error += of_image, squares += variance;
            sum_z_squared += of_image * of_image / variance;
        }
        SCOPED_TRACE(p);
        EXPECT_LT(std::abs(error), limit * std::sqrt(squares));
        // An image meets about one bright path in its first pass where p = 1e-5: neither products nor squares of so few
        // events are near a normal distribution.
        if (p >= 1e-3) {
            EXPECT_LT(std::abs(product), limit * std::sqrt(product_squares));
            // The scatter of sums over the image is that of independent pixels with these counts.
            EXPECT_LT(std::abs(sum_z_squared / images - 1), limit * std::sqrt(2.0 / images));
        }
        std::printf("p = %g, %s time left: mean %+.3f %% +- %.3f, product of halves %+.2g +- %.2g, z^2 of sums %.2f\n",
                    p, seconds > 0 ? "with" : "without", 100 * error / (images * pixels),
                    100 * std::sqrt(squares) / (images * pixels), product / (images * pixels),
                    std::sqrt(product_squares) / (images * pixels), sum_z_squared / images);
    }
}
