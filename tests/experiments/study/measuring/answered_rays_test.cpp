#include "experiments/study/measuring/rays/answered_rays.h"
#include "variants/tracers/outcome.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <set>

namespace {

constexpr glm::uvec2 extent(32, 16);
constexpr size_t pixels = 32 * 16;

/// Rays of rough surfaces, each of which ends in its own pixel, as they truly do. The colour is 1 in the columns left
/// of 16 and 3 in the others; the fallback is 0.
struct ChosenRays : testing::Test {
    AnsweredRays::Frame frame{.lit = HostImage(extent, 4),
                              .fallback = HostImage(extent, 4),
                              .normal = HostImage(extent, 4, 0.4f),
                              .reflectance = {},
                              .true_specular = {}};
    RecordedRays marched{.stage = "a pass", .rays_per_pixel = 1, .rays = std::vector<RayRecord>(pixels)};
    std::vector<ExactHit> exact{pixels};

    ChosenRays() {
        for (size_t i = 0; i < pixels; ++i) {
            frame.lit.set_rgb(i, glm::vec3(i % extent.x < 16 ? 1 : 3));
            marched.rays[i] = {.is_traced = 1, .confidence = 1, .pixel = {i % extent.x, i / extent.x}};
            exact[i] = {.position = glm::vec2(i % extent.x, i / extent.x) + 0.5f, .outcome = outcome_hit};
        }
    }

    /// Which rays the scene answers.
    std::vector<bool> choose(const std::string& selector, double share) {
        std::vector<bool> chosen;
        for (const ExactHit& hit : AnsweredRays(frame).choose(marched, exact, {selector, share}))
            chosen.push_back(hit.outcome != outcome_unanswered);
        return chosen;
    }
};

TEST_F(ChosenRays, AreTheShareOfThoseThatAreTraced) {
    for (size_t i = 0; i < pixels; i += 2) marched.rays[i].is_traced = 0;
    for (const char* selector : {"oracle", "confidence", "variance", "random"})
        for (const auto& [share, expected] : {std::pair(0.0, 0), {0.1, 26}, {0.5, 128}, {1.0, 256}}) {
            const std::vector<bool> chosen = choose(selector, share);
            size_t traced = 0;
            for (size_t i = 1; i < pixels; i += 2) traced += chosen[i];
            EXPECT_EQ(traced, size_t(expected)) << selector << ' ' << share;
            EXPECT_EQ(std::ranges::count(chosen, true), expected) << "those that are not traced are not answered";
        }
}

TEST_F(ChosenRays, ByConfidenceAreTheLeastSure) {
    for (size_t i = 0; i < pixels; ++i) marched.rays[i].confidence = float((i * 7) % pixels) / float(pixels);
    const std::vector<bool> chosen = choose("confidence", 0.25);
    for (size_t i = 0; i < pixels; ++i) EXPECT_EQ(chosen[i], marched.rays[i].confidence < 0.25f) << i;
}

TEST_F(ChosenRays, ByVarianceSeeTheEdgeOfTheColours) {
    const std::vector<bool> chosen = choose("variance", 2.0 / extent.x);  // two columns
    for (size_t i = 0; i < pixels; ++i) EXPECT_EQ(chosen[i], i % extent.x == 15 || i % extent.x == 16) << i;
}

/// The march takes the rays of two columns for misses (their colour is the fallback), and ends those of two others one
/// column off: of these only the ones before the edge see another colour, and a smaller change than the misses.
TEST_F(ChosenRays, ByTheOracleAreThoseWhoseColourChangesMost) {
    for (size_t i = 5; i < pixels; i += extent.x) marched.rays[i].confidence = 0;   // 1 in place of 0
    for (size_t i = 20; i < pixels; i += extent.x) marched.rays[i].confidence = 0;  // 3 in place of 0
    for (size_t i = 15; i < pixels; i += extent.x) marched.rays[i].pixel.x = 16;    // 1 in place of 3
    for (size_t i = 25; i < pixels; i += extent.x) marched.rays[i].pixel.x = 24;    // the same
    const auto columns = [&](double share) {
        std::set<size_t> found;
        const std::vector<bool> chosen = choose("oracle", share);
        for (size_t i = 0; i < pixels; ++i)
            if (chosen[i]) found.insert(i % extent.x);
        return found;
    };
    EXPECT_EQ(columns(1.0 / extent.x), (std::set<size_t>{20}));
    EXPECT_EQ(columns(2.0 / extent.x), (std::set<size_t>{15, 20}));
    EXPECT_EQ(columns(3.0 / extent.x), (std::set<size_t>{5, 15, 20}));
}

/// What the screen does not show is answered by the fallback: worth it only where that is nearer to the pixel's truth
/// than what the march found.
TEST_F(ChosenRays, ByTheOracleLeaveFalseHitsThatAreNearerToTheTruth) {
    for (size_t i = 0; i < pixels; ++i) exact[i].outcome = outcome_hidden;
    HostImage specular(extent, 3), reflectance(extent, 3, 0.5f);
    for (size_t i = 0; i < pixels; ++i) specular.set_rgb(i, glm::vec3(i % extent.x < 16 ? 0.45f : 0.1f));
    frame.true_specular = specular, frame.reflectance = reflectance;
    const std::vector<bool> chosen = choose("oracle", 0.5);
    for (size_t i = 0; i < pixels; ++i) EXPECT_EQ(chosen[i], i % extent.x >= 16) << i;
}

/// A mirror shows one point, whose radiance is the pixel's truth: an answer that the screen shows counts for as much as
/// it is nearer to it than the march.
TEST_F(ChosenRays, ByTheOracleAreJudgedByTheTruthInMirrors) {
    HostImage specular(extent, 3), reflectance(extent, 3, 1.0f);
    for (size_t i = 0; i < pixels; ++i) {
        marched.rays[i].confidence = 0;
        specular.set_rgb(i, glm::vec3(i % extent.x < 16 ? 1 : 0));  // of the right half the march is right
    }
    frame.true_specular = specular, frame.reflectance = reflectance;
    EXPECT_TRUE(choose("oracle", 0.5)[20]) << "a rough surface's rays are not compared with the mean of its lobe";
    frame.normal = HostImage(extent, 4, 0.0f);
    const std::vector<bool> chosen = choose("oracle", 0.5);
    for (size_t i = 0; i < pixels; ++i) EXPECT_EQ(chosen[i], i % extent.x < 16) << i;
}

/// Where one pixel in 2x2, or one in a tile of 8x8, traces, the nearest rays are farther away.
TEST_F(ChosenRays, ByVarianceFindTheEdgeBetweenRaysThatAreFarApart) {
    for (const unsigned spacing : {2u, 8u}) {
        for (size_t i = 0; i < pixels; ++i)
            marched.rays[i].is_traced = i % extent.x % spacing == 0 && i / extent.x % spacing == 0;
        const std::vector<bool> chosen = choose("variance", 2.0 * spacing / extent.x);
        for (size_t i = 0; i < pixels; ++i)
            EXPECT_EQ(chosen[i], marched.rays[i].is_traced > 0 && (i % extent.x == 16 || i % extent.x == 16 - spacing))
                << spacing << ": " << i % extent.x << ", " << i / extent.x;
    }
}

/// A tenth at random in 200 frames: 51 of 512 rays, of which each half of the image has 25.5 in the mean. A
/// hypergeometric draw deviates by 3.4, its mean over 200 frames by 0.24: five deviations, one false alarm in 1.7
/// million.
TEST_F(ChosenRays, AtRandomFavourNoPartOfTheImageNoFrameAndNoPass) {
    double left = 0;
    std::vector<unsigned> times(pixels);
    for (frame.index = 0; frame.index < 200; ++frame.index) {
        const std::vector<bool> chosen = choose("random", 0.1);
        for (size_t i = 0; i < pixels; ++i) times[i] += chosen[i], left += chosen[i] && i % extent.x < 16;
    }
    EXPECT_NEAR(left / 200, 25.5, 5 * 0.24);
    // Of 512 pixels, each chosen Binomial(200, 0.1) times, deviation 4.2: beyond 6 deviations one in 5e8 times.
    for (const unsigned t : times) EXPECT_NEAR(t, 20, 6 * 4.25);
    const std::vector<bool> a = choose("random", 0.1);
    EXPECT_EQ(choose("random", 0.1), a);
    marched.stage = "another pass";
    EXPECT_NE(choose("random", 0.1), a);
    marched.stage = "a pass";
    frame.seed = 1;
    EXPECT_NE(choose("random", 0.1), a);
}

}  // namespace
