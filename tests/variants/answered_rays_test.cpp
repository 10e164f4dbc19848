#include "variants/tracers/answered_rays.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/variant_fixture.h"
#include "variants/tracers/outcome.h"

#include <set>

namespace {

constexpr glm::uvec2 extent(32, 16);
constexpr size_t pixels = 32 * 16;

/// A rough floor whose colour is 1 in the columns left of 16 and 3 in the others; the fallback is 0.
struct ChosenRays : VariantTest {
    PassGraph graph{device(), extent};
    ParameterSet params;
    AnsweredRays answered{params};
    RayProbe probe;
    RecordedRays marched{.stage = "a pass", .rays_per_pixel = 1, .rays = std::vector<RayRecord>(pixels)};
    std::vector<ExactHit> exact{pixels};

    ChosenRays() {
        const CameraPose pose;
        const CameraData camera = camera_data(pose, nullptr, {.extent = extent});
        HostGBuffer host = host_gbuffer(device(), pose, {.extent = extent}, mirror_floor);
        for (size_t i = 0; i < pixels; ++i) {
            host.lit.set_rgb(i, glm::vec3(i % extent.x < 16 ? 1 : 3));
            host.fallback.set_rgb(i, glm::vec3(0));
            host.normal.values[4 * i + 3] = 0.4f;
            marched.rays[i] = {.is_traced = 1, .confidence = 1, .pixel = {i % extent.x, i / extent.x}};
            exact[i] = {.position = glm::vec2(i % extent.x, i / extent.x) + 0.5f, .outcome = outcome_hit};
        }
        graph.begin_frame(camera, params, upload_gbuffer(graph, host).images());
    }

    /// Which rays the scene answers.
    std::vector<bool> choose(const std::string& selector, double share) {
        params.assign({{"exact_rays", selector}, {"exact_share", share}});
        std::vector<bool> chosen;
        for (const ExactHit& hit : answered.choose(graph, marched, exact, probe))
            chosen.push_back(hit.outcome != outcome_unanswered);
        return chosen;
    }
    static size_t count(const std::vector<bool>& chosen) { return size_t(std::ranges::count(chosen, true)); }
};

TEST_F(ChosenRays, AreTheShareOfThoseThatAreTraced) {
    for (size_t i = 0; i < pixels; i += 2) marched.rays[i].is_traced = 0;
    for (const char* selector : {"oracle", "confidence", "variance", "random"})
        for (const auto& [share, expected] : {std::pair(0.0, 0), {0.1, 26}, {0.5, 128}, {1.0, 256}}) {
            const std::vector<bool> chosen = choose(selector, share);
            size_t traced = 0;
            for (size_t i = 1; i < pixels; i += 2) traced += chosen[i];
            EXPECT_EQ(traced, size_t(expected)) << selector << ' ' << share;
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

/// The march takes 20 rays for misses (their colour is the fallback), and ends 40 others one column off: of those only
/// the ones before the edge see another colour, and a smaller change than the misses.
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
    probe.true_specular = &specular, probe.reflectance = &reflectance;
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
    probe.true_specular = &specular, probe.reflectance = &reflectance;
    EXPECT_TRUE(choose("oracle", 0.5)[20]) << "a rough surface's rays are not compared with the mean of its lobe";
    HostImage normal = graph.download(graph.input("normal"));
    for (size_t i = 0; i < pixels; ++i) normal.values[4 * i + 3] = 0;
    graph.upload(graph.input("normal"), normal);
    const std::vector<bool> chosen = choose("oracle", 0.5);
    for (size_t i = 0; i < pixels; ++i) EXPECT_EQ(chosen[i], i % extent.x < 16) << i;
}

/// A tenth at random in 200 frames: the count of each half of the image is that of a hypergeometric draw, whose mean
/// over 200 frames is 25.6 (deviation 3.4 / sqrt(200) = 0.24 of 256 of 512 with 51 drawn): five deviations, one false
/// alarm in 1.7 million.
TEST_F(ChosenRays, AtRandomFavourNoPartOfTheImageAndNoFrame) {
    double left = 0;
    std::vector<unsigned> times(pixels);
    for (probe.frame = 0; probe.frame < 200; ++probe.frame) {
        const std::vector<bool> chosen = choose("random", 0.1);
        for (size_t i = 0; i < pixels; ++i) times[i] += chosen[i], left += chosen[i] && i % extent.x < 16;
    }
    EXPECT_NEAR(left / 200, 25.5, 5 * 0.24);
    // Of 512 pixels, each chosen Binomial(200, 0.1) times, deviation 4.2: beyond 6 deviations one in 5e8 times.
    for (const unsigned t : times) EXPECT_NEAR(t, 20, 6 * 4.25);
    const std::vector<bool> a = choose("random", 0.1);
    probe.seed = 1;
    EXPECT_NE(choose("random", 0.1), a);
}

}  // namespace
