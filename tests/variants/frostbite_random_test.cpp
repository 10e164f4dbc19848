#include "tests/variants/frostbite_passes.h"
#include "variants/common/halton.h"
#include "variants/denoisers/first_turn.h"

#include <map>
#include <numbers>
#include <set>

// What directions and marches are drawn from, read back from the rays of a wall that faces an orthographic camera.

namespace {

constexpr float roughness = 0.6f;
constexpr double importance_bias = 0.7, alpha = 0.36;

SyntheticHit wall(const CameraRay&) {
    return {.distance = 10, .normal = {0, 0, 1}, .roughness = roughness, .metalness = 1, .specular = 1};
}

/// The numbers that a direction of the lobe of normals comes from: its half vector has tan^2 = alpha^2 s / (1 - s) with
/// s = (1 - bias) x (Walter et al. 2007, eq. 35) and the azimuth 2 pi y. With alpha 0.36 and a bias of 0.7 all are
/// within 27 degrees of the wall's normal, so that none is drawn again.
glm::dvec2 drawn_from(glm::dvec3 direction) {
    const glm::dvec3 half = glm::normalize(direction + glm::dvec3(0, 0, 1));
    const double tan2 = (half.x * half.x + half.y * half.y) / (half.z * half.z);
    const double turns = std::atan2(half.y, half.x) / (2 * std::numbers::pi);
    return {tan2 / (alpha * alpha + tan2) / (1 - importance_bias), turns - std::floor(turns)};
}

double distance_on_torus(glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 way = a - b;
    return glm::length(way - glm::round(way));
}

/// Whether 72 points of a rotated sequence, of which the first has this index, put one into every box of 1/8 by 1/9.
bool fills_all_boxes(const std::vector<glm::dvec2>& points, unsigned first_index) {
    const glm::dvec2 first(radical_inverse(first_index, 2), radical_inverse(first_index, 3));
    // Among the first 74 points coordinates are multiples of 1/128 and 1/81: half-way between them rounding does
    // nothing.
    const glm::dvec2 shift = first - points.at(0) + 0.5 / glm::dvec2(128, 81);
    std::set<std::pair<int, int>> boxes;
    for (size_t turn = 0; turn < 72; ++turn) {
        const glm::dvec2 point = glm::fract(points.at(turn) + shift);
        boxes.insert({int(point.x * 8), int(point.y * 9)});
    }
    return boxes.size() == 72;
}

struct FrostbiteRandom : TechniqueTest {
    FrostbiteParameters parameters;
    CameraPose pose{.is_orthographic = true, .orthographic_height = 4, .near = 0.1f, .far = 100};

    /// The rays of frames in a row, by index. `rays_of_tile`: of tile number and frame.
    template <class RaysOfTile, class See>
    void trace(glm::uvec2 extent, unsigned frames, unsigned seed, RaysOfTile rays_of_tile, See see) {
        PassList pass_list(device(), extent);
        CameraData camera = camera_data(pose, nullptr, {.extent = extent});
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, wall);
        camera.frame.y = seed;
        HostImage ray_count((extent + frostbite_tile - 1u) / frostbite_tile, 1);
        for (unsigned frame = 0; frame < frames; ++frame) {
            for (unsigned tile = 0; tile < ray_count.values.size(); ++tile)
                ray_count.values[tile] = float(rays_of_tile(tile, frame));
            const Image counts = pass_list.image_of("ray_count", Format::r32f, ray_count.extent);
            pass_list.upload(counts, ray_count);
            camera.frame.x = frame;
            pass_list.begin_frame(camera, parameters.params, gbuffer.images());
            const Tracers::Images depths = parameters.ray.tracers.images(pass_list, gbuffer.depth);
            const FrostbiteWork work = frostbite_allocate(pass_list, gbuffer, {counts}, parameters.ray);
            const Image horizon = HorizonImage().on(pass_list, parameters.params);
            const std::vector<std::byte> bytes =
                pass_list.download(frostbite_trace(pass_list, depths, work, horizon, parameters.ray).directions);
            std::vector<glm::vec4> directions(bytes.size() / sizeof(glm::vec4));
            std::memcpy(directions.data(), bytes.data(), bytes.size());
            see(frame, work.extent, directions);
        }
    }

    /// Points that the rays of one pixel come from, turn by turn.
    struct Drawn {
        unsigned first_frame = 0;
        std::vector<glm::dvec2> points;
    };

    /// By pixel (x, y) and k.
    template <class RaysOfTile>
    std::map<std::array<unsigned, 3>, Drawn> draw(glm::uvec2 extent, unsigned frames, unsigned seed,
                                                  RaysOfTile rays_of_tile) {
        const glm::uvec2 order[] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
        std::map<std::array<unsigned, 3>, Drawn> drawn;
        trace(extent, frames, seed, rays_of_tile,
              [&](unsigned frame, glm::uvec2 traced, const std::vector<glm::vec4>& directions) {
                  for (unsigned i = 0; i < directions.size(); ++i) {
                      if (directions[i].w == 0) continue;
                      glm::uvec2 pixel(i / 4 % traced.x, i / 4 / traced.x);
                      if (parameters.ray.half_resolution)
                          pixel = glm::min(2u * pixel + order[(frame + first_turn(seed)) % 4], extent - 1u);
                      Drawn& ray = drawn[{pixel.x, pixel.y, i % 4}];
                      if (ray.points.empty()) ray.first_frame = frame;
                      ray.points.push_back(drawn_from(directions[i]));
                  }
              });
        return drawn;
    }

    void assign(bool half_resolution) {
        parameters.params.assign({{"half_resolution", half_resolution},
                                  {"max_rays", 4},
                                  {"max_roughness", 1.0},
                                  {"importance_bias", importance_bias}});
    }
};

/// Each ray of a pixel has a full sequence for itself, whatever its tile's number of rays.
TEST_F(FrostbiteRandom, FillsTheLobeOverTheFramesForEveryRay) {
    assign(false);
    const auto drawn = draw({128, 5}, 72, 7, [](unsigned tile, unsigned) { return tile + 1; });
    EXPECT_EQ(drawn.size(), 32u * 5 * (1 + 2 + 3 + 4));
    for (const auto& [ray, found] : drawn)
        EXPECT_TRUE(fills_all_boxes(found.points, 0)) << ray[0] << ", " << ray[1] << ", ray " << ray[2];
}

/// The first ray of a pixel does so where the number of rays changes from frame to frame.
TEST_F(FrostbiteRandom, FillsTheLobeOverTheFramesWhileNumbersOfRaysChange) {
    assign(false);
    const auto drawn = draw({128, 5}, 72, 7, [](unsigned tile, unsigned frame) {
        return tile == 0 ? 1 + frame % 2 : tile == 1 ? 4 - 3 * (frame % 2) : 1 + (tile + frame * frame / 3) % 4;
    });
    for (const auto& [ray, found] : drawn)
        if (ray[2] == 0) {
            EXPECT_TRUE(fills_all_boxes(found.points, 0)) << ray[0] << ", " << ray[1];
        }
}

/// Else bias and variance, which are estimated from the scatter over seeds, would be wrong: seeds that take turns share
/// what differs between the four pixels evenly. Chi-square of pairs of successive seeds with 15 degrees of freedom,
/// which exceeds 56.5 once in a million.
TEST(FrostbiteSeeds, StartAtTurnsThatDoNotHangOnEachOther) {
    const unsigned pairs = 16384;
    std::map<std::pair<unsigned, unsigned>, unsigned> counts;
    for (unsigned i = 0; i < pairs; ++i) ++counts[{first_turn(2 * i) % 4, first_turn(2 * i + 1) % 4}];
    double chi_square = 0;
    for (unsigned a = 0; a < 4; ++a)
        for (unsigned b = 0; b < 4; ++b) chi_square += std::pow(counts[{a, b}] - pairs / 16.0, 2) / (pairs / 16.0);
    EXPECT_LT(chi_square, 56.5);
}

/// At half resolution a pixel has every fourth frame for a turn, and more in blocks that the border cuts: two pixels of
/// the last column or row have a turn every other frame, the pixel of the corner has all.
TEST_F(FrostbiteRandom, FillsTheLobeOverTheTurnsOfEachPixelAtHalfResolution) {
    assign(true);
    const glm::uvec2 extent(33, 7);
    for (unsigned start = 0; start < 4; ++start) {
        unsigned seed = 0;
        while (first_turn(seed) % 4 != start) ++seed;
        const auto drawn = draw(extent, 288, seed, [](unsigned tile, unsigned) { return 1 + 2 * tile; });
        EXPECT_EQ(drawn.size(), 32u * 7 + 3 * 7);
        for (const auto& [ray, found] : drawn) {
            SCOPED_TRACE(testing::Message() << ray[0] << ", " << ray[1] << ", ray " << ray[2] << ", seed " << seed);
            const unsigned pixels = (ray[0] == 32 ? 1 : 2) * (ray[1] == 6 ? 1 : 2);
            ASSERT_EQ(found.points.size(), 288 / pixels);
            EXPECT_TRUE(fills_all_boxes(found.points, (found.first_frame + start) / pixels));
        }
    }
}

/// The rotations of ray 0 to 3 are at least 0.39 apart; less what direction and back takes.
TEST_F(FrostbiteRandom, SpreadsTheRaysOfAFrame) {
    assign(false);
    const auto drawn = draw({32, 32}, 2, 0, [](unsigned, unsigned) { return 4u; });
    for (const auto& [ray, found] : drawn)
        for (unsigned k = 0; k < ray[2]; ++k)
            for (unsigned frame = 0; frame < 2; ++frame)
                EXPECT_GT(distance_on_torus(found.points[frame], drawn.at({ray[0], ray[1], k}).points[frame]), 0.38);
}

/// Mirrors 10 m away, one in 8x8 pixels, amid panels 1 m away, behind whose 10 m of thickness all rays start: with one
/// linear step they hit where their jitter says.
SyntheticHit sunken_mirrors(const CameraRay& ray) {
    const glm::ivec2 pixel(glm::floor(glm::vec2(ray.origin) * 40.0f + 80.0f));
    const bool is_mirror = pixel.x % 8 == 4 && pixel.y % 8 == 4;
    return is_mirror ? wall(ray) : SyntheticHit{.distance = 1, .normal = {0, 0, 1}};
}

TEST_F(FrostbiteRandom, DrawsTheMarchApartFromTheDirection) {
    assign(false);
    parameters.params.assign({{"classification", false},
                              {"frostbite.linear_steps", 1},
                              {"frostbite.linear_refinements", 0},
                              {"frostbite.relative_thickness", 10.0},
                              {"frostbite.front_faces_only", false}});
    PassList pass_list(device(), {160, 160});  // 4 m
    const CameraData camera = camera_data(pose, nullptr, {.extent = pass_list.extent()});
    const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, sunken_mirrors);
    pass_list.begin_frame(camera, parameters.params, gbuffer.images());
    const FrostbiteTraced found = trace_frostbite(pass_list, gbuffer, parameters);
    double correlation = 0, mean = 0;
    size_t rays = 0;
    for (size_t i = 0; i < found.directions.size(); ++i) {
        if (!found.is_hit(i)) continue;
        const glm::dvec2 pixel(i / 4 % 160, i / 4 / 160), hit(found.hit_pixel(i));
        const glm::dvec3 direction(found.directions[i]);
        const glm::dvec2 per_metre(40 * direction.x, -40 * direction.y);
        const glm::dvec2 border = glm::mix(glm::dvec2(0), glm::dvec2(160), glm::greaterThan(per_metre, glm::dvec2(0)));
        const glm::dvec2 to_border = (border - pixel - 0.5) / per_metre;
        const double length = std::min({to_border.x, to_border.y, 9.9 / direction.z}) * glm::length(per_metre);
        const double jitter = glm::distance(hit, pixel) / length;
        if (length < 20 || jitter > 0.9) continue;  // the last step, or too few pixels
        correlation += (jitter - 0.45) / 0.26 * (drawn_from(direction).x - 0.5) / 0.29;
        mean += jitter;
        ++rays;
    }
    EXPECT_GT(rays, 800u);
    // 5 standard errors of independent rays, one false alarm in a million; ends are rounded to pixels, of 20 and more a
    // 40th. The same number for both would make the correlation 1.
    EXPECT_NEAR(mean / double(rays), 0.45, 5 * 0.26 / std::sqrt(double(rays)) + 1.0 / 40);
    EXPECT_NEAR(correlation / double(rays), 0, 5 / std::sqrt(double(rays)));
}

// --- Independence ---

struct FrostbiteIndependence : FrostbiteRandom {
    static constexpr glm::uvec2 extent{256, 128};
    static constexpr size_t pixels = size_t(extent.x) * extent.y;
    PassList pass_list{device(), extent};

    struct Number {
        unsigned k = 0, dimension = 0, frame = 0, seed = 0;  // dimension: as in frostbite_random.comp
    };

    std::vector<glm::vec2> numbers(const Number& number) {
        CameraData camera = camera_data(pose, nullptr, {.extent = extent});
        camera.frame.x = number.frame;
        camera.frame.y = number.seed;
        pass_list.begin_frame(camera, parameters.params, {});
        const Image found = pass_list.image("found", Format::rg32f);
        pass_list.compute("frostbite_random.comp")
            .write(found)
            .set("k", number.k)
            .set("dimension", number.dimension)
            .run();
        const HostImage image = pass_list.download(found);
        std::vector<glm::vec2> points(pixels);
        std::memcpy(points.data(), image.values.data(), pixels * sizeof(glm::vec2));
        return points;
    }

    /// Chi-square of pairs in 16 x 16 cells has 255 degrees of freedom and a standard deviation of 22.6. Above 6 of
    /// them are less than 1e-6 of independent pairs.
    template <class X, class Y>
    static void expect_independent(X x, Y y) {
        std::vector<double> count(256, 0.0);
        for (size_t pixel = 0; pixel < pixels; ++pixel) {
            ASSERT_TRUE(x(pixel) >= 0 && x(pixel) < 1 && y(pixel) >= 0 && y(pixel) < 1);
            count[size_t(x(pixel) * 16) * 16 + size_t(y(pixel) * 16)] += 1;
        }
        const double expected = double(pixels) / 256;
        double chi_square = 0;
        for (const double found : count) chi_square += (found - expected) * (found - expected) / expected;
        EXPECT_LT(chi_square, 255 + 6 * 22.6);
    }
};

TEST_F(FrostbiteIndependence, HoldsBetweenDrawsMarchProbesTapsSeedsAndPixels) {
    const Number used[] = {{},
                           {.dimension = 1},
                           {.dimension = 2},
                           {.dimension = 3},
                           {.dimension = 4},
                           {.dimension = 5},
                           {.dimension = 6},
                           {.k = 1, .dimension = 1},
                           {.seed = 1},
                           {.seed = 2},
                           {.frame = 9, .seed = 1}};
    for (const bool half_resolution : {false, true}) {
        assign(half_resolution);
        std::vector<std::vector<glm::vec2>> points;
        for (const Number& number : used) points.push_back(numbers(number));
        for (size_t n = 0; n < points.size(); ++n) {
            SCOPED_TRACE(testing::Message() << "number " << n);
            const auto& own = points[n];
            expect_independent([&](size_t i) { return own[i].x; }, [&](size_t i) { return own[i].y; });
            expect_independent([&](size_t i) { return own[i].x; }, [&](size_t i) { return own[(i + 1) % pixels].x; });
            expect_independent([&](size_t i) { return own[i].y; },
                               [&](size_t i) { return own[(i + extent.x) % pixels].y; });
            // Seed 1 in frames 0 and 9 has one sequence, of which each pixel takes two points.
            for (size_t m = 0; m < (n == 10 ? 8 : n); ++m) {
                SCOPED_TRACE(testing::Message() << "with number " << m);
                const auto& other = points[m];
                expect_independent([&](size_t i) { return own[i].x; }, [&](size_t i) { return other[i].x; });
                expect_independent([&](size_t i) { return own[i].y; }, [&](size_t i) { return other[i].y; });
            }
        }
    }
}

/// Two numbers that are rotations of one sequence are independent over pixels in each frame, and yet move from frame to
/// frame by the same step.
TEST_F(FrostbiteIndependence, HoldsBetweenTheStepsFromFrameToFrame) {
    assign(false);
    const auto steps = [&](unsigned k, unsigned dimension) {
        const auto now = numbers({.k = k, .dimension = dimension, .frame = 5}),
                   next = numbers({.k = k, .dimension = dimension, .frame = 6});
        std::vector<glm::vec2> steps(pixels);
        for (size_t i = 0; i < pixels; ++i) steps[i] = glm::fract(next[i] - now[i]);
        return steps;
    };
    for (const unsigned k : {0u, 3u}) {
        const auto redrawn = steps(k, 1);
        for (const unsigned dimension : {1u, 2u, 3u, 4u, 5u, 6u}) {
            SCOPED_TRACE(testing::Message() << "dimension " << dimension << ", ray " << k);
            const auto other = steps(k, dimension);
            // A uniform step, whatever that of the direction is, which is the same for all pixels.
            expect_independent([&](size_t i) { return other[i].x; }, [&](size_t i) { return other[i].y; });
            if (dimension == 1) continue;
            expect_independent([&](size_t i) { return redrawn[i].x; }, [&](size_t i) { return other[i].x; });
        }
    }
}

}  // namespace
