#include "tests/variants/frostbite_bench.h"
#include "tests/variants/technique_fixture.h"

#include <set>

// Which rays each pixel resolves: on a wall seen from straight ahead all rays weigh the same, and a ray that alone is
// bright shows in all pixels that resolve it, with the same share as each of their others.

namespace {

struct FrostbiteTaps : TechniqueTest {
    static constexpr glm::uvec2 extent{17, 12};

    static SyntheticHit wall(const CameraRay&) {
        return {.distance = 5, .normal = {0, 0, 1}, .roughness = 0.5f, .metalness = 1, .specular = 1};
    }

    /// Per pixel the indices of the traced pixels whose rays it resolves.
    std::vector<std::set<unsigned>> tap_sets(const nlohmann::json& overrides, unsigned frame = 0, unsigned seed = 0) {
        nlohmann::json parameters = {
            {"filtered_sampling", false}, {"previous_frame", false}, {"neighbor_ray", "direction"}};
        parameters.update(overrides);
        const CameraPose pose{.is_orthographic = true, .orthographic_height = 4};
        FrostbiteBench bench(device(), pose, {.extent = extent}, wall, parameters);
        bench.set_frame(frame, seed);
        HostImage color(extent, 4);
        for (unsigned channel = 0; channel < 3; ++channel) color.pixel(channel, 0)[channel] = 1;
        const unsigned dark = 3, traced_count = bench.traced_extent().x * bench.traced_extent().y;
        std::vector<std::set<unsigned>> sets(size_t(extent.x) * extent.y);
        std::vector<double> share(sets.size(), 0.0);
        const StoredRay ray{.direction = {0, 0, 1}, .inverse_density = 1, .target = dark, .length = 1};
        for (unsigned first = 0; first < traced_count; first += 3) {
            std::vector<StoredRay> rays(traced_count, ray);
            for (unsigned channel = 0; channel < 3 && first + channel < traced_count; ++channel)
                rays[first + channel].target = channel;
            const HostImage found = bench.resolve(rays, color).radiance;
            for (size_t pixel = 0; pixel < sets.size(); ++pixel)
                for (unsigned channel = 0; channel < 3; ++channel) {
                    const float bright = found.values[4 * pixel + channel];
                    if (bright == 0) continue;
                    sets[pixel].insert(first + channel);
                    EXPECT_TRUE(share[pixel] == 0 || std::abs(bright - share[pixel]) < 1e-5) << "counted twice";
                    share[pixel] = bright;
                }
        }
        for (size_t pixel = 0; pixel < sets.size(); ++pixel)
            EXPECT_NEAR(share[pixel] * double(sets[pixel].size()), 1, 1e-5) << "at pixel " << pixel;
        return sets;
    }

    static void expect_own(const std::vector<std::set<unsigned>>& sets, bool is_half) {
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const unsigned own = is_half ? y / 2 * ((extent.x + 1) / 2) + x / 2 : y * extent.x + x;
                EXPECT_TRUE(sets[y * extent.x + x].contains(own)) << x << ", " << y;
            }
    }

    /// Away from the border, where taps come together and count once.
    static bool is_inside(unsigned x, unsigned y) { return x >= 4 && y >= 4 && x + 5 < extent.x && y + 5 < extent.y; }
};

TEST_F(FrostbiteTaps, HoldThePixelsOwnRay) {
    for (const bool is_half : {false, true})
        for (const char* pattern : {"rotated", "quad_shared", "interleaved"})
            for (const char* taps : {"1", "4", "16"}) {
                if (taps == std::string("1") && pattern != std::string("interleaved"))
                    continue;  // the pattern has no say
                const auto sets = tap_sets({{"half_resolution", is_half}, {"pattern", pattern}, {"taps", taps}}, 3, 2);
                expect_own(sets, is_half);
                const size_t count = std::stoul(taps);
                for (unsigned y = 0; y < extent.y; ++y)
                    for (unsigned x = 0; x < extent.x; ++x) {
                        const size_t found = sets[y * extent.x + x].size();
                        EXPECT_LE(found, count);
                        // Offsets that are turned and rounded may meet.
                        const bool may_meet = std::string(pattern) == "rotated" && count == 16;
                        const bool is_far_inside = !is_half && is_inside(x, y);
                        if (is_far_inside) {
                            EXPECT_GE(found, may_meet ? 13 : count) << pattern << " at " << x << ", " << y;
                        }
                    }
            }
}

TEST_F(FrostbiteTaps, AreTheSameInAQuad) {
    for (const bool is_half : {false, true})
        for (const char* taps : {"4", "16"}) {
            const auto sets = tap_sets({{"half_resolution", is_half}, {"pattern", "quad_shared"}, {"taps", taps}});
            for (unsigned y = 0; y + 1 < extent.y; y += 2)
                for (unsigned x = 0; x + 1 < extent.x; x += 2)
                    for (const unsigned other : {1u, extent.x, extent.x + 1})
                        EXPECT_EQ(sets[y * extent.x + x], sets[y * extent.x + x + other]) << x << ", " << y;
        }
}

TEST_F(FrostbiteTaps, AreInterleavedAmongNeighbours) {
    for (const bool is_half : {false, true})
        for (unsigned frame = 0; frame < 4; ++frame) {
            const auto sets = tap_sets({{"half_resolution", is_half}, {"pattern", "interleaved"}}, frame);
            const auto next = tap_sets({{"half_resolution", is_half}, {"pattern", "interleaved"}}, frame + 1);
            unsigned shared = 0, inside = 0, changed = 0;
            for (unsigned y = 2; y + 3 < extent.y; ++y)
                for (unsigned x = 2; x + 3 < extent.x; ++x) {
                    const auto& own = sets[y * extent.x + x];
                    EXPECT_NE(own, sets[y * extent.x + x + 1]) << x << ", " << y;
                    EXPECT_NE(own, sets[(y + 1) * extent.x + x]) << x << ", " << y;
                    ++inside;
                    shared += own == sets[y * extent.x + x + 2] || own == sets[y * extent.x + x - 2];
                    changed += own != next[y * extent.x + x];
                }
            EXPECT_EQ(shared, inside);
            EXPECT_EQ(changed, inside);  // the groups of a block move apart, each every frame
        }
}

/// At half resolution, too, they turn in every frame, not when the pixel has its turn.
TEST_F(FrostbiteTaps, AreTurnedInEveryFrame) {
    for (const bool is_half : {false, true})
        for (unsigned frame = 0; frame < 4; ++frame) {
            const auto now = tap_sets({{"half_resolution", is_half}}, frame),
                       next = tap_sets({{"half_resolution", is_half}}, frame + 1);
            size_t equal = 0;
            for (size_t pixel = 0; pixel < now.size(); ++pixel) equal += now[pixel] == next[pixel];
            EXPECT_LT(equal, now.size() / 4) << frame;
        }
}

TEST_F(FrostbiteTaps, AreTurnedByPixelFrameAndSeed) {
    const nlohmann::json parameters = {{"half_resolution", false}};
    const auto sets = tap_sets(parameters), later = tap_sets(parameters, 1), other = tap_sets(parameters, 0, 1);
    std::set<std::set<int>> shapes;
    unsigned as_later = 0, as_other = 0;
    for (size_t pixel = 0; pixel < sets.size(); ++pixel) {
        std::set<int> offsets;
        for (const unsigned tap : sets[pixel]) offsets.insert(int(tap) - int(pixel));
        shapes.insert(offsets);
        as_later += sets[pixel] == later[pixel];
        as_other += sets[pixel] == other[pixel];
    }
    EXPECT_GT(shapes.size(), 12u);  // of the about 25 that rounding leaves
    EXPECT_LT(as_later, sets.size() / 4);
    EXPECT_LT(as_other, sets.size() / 4);
}

}  // namespace
