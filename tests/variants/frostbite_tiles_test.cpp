#include "core/gbuffer/split_sum_image.h"
#include "tests/variants/frostbite_passes.h"
#include "tests/variants/pixel_march.h"

#include <set>

// Which pixels are probed, how many rays the probes earn their tile, and what a thin object loses by it.

namespace {

constexpr float none = 0, missed = 1, hit = 2;  // second channel of a probe

struct FrostbiteTilesTest : TechniqueTest {
    static constexpr glm::uvec2 extent{200, 160};  // the last tile of a row has one column of blocks
    PassList pass_list{device(), extent};
    FrostbiteParameters parameters;
    HostImage probes{{25, 20}, 2};
    CameraData camera{};

    void fill(glm::uvec2 tile, float state, float luminance) {
        for (unsigned i = 0; i < 16; ++i) set_probe(tile, i, state, luminance);
    }
    void set_probe(glm::uvec2 tile, unsigned i, float state, float luminance) {
        const glm::uvec2 block = 4u * tile + glm::uvec2(i % 4, i / 4);
        if (block.x >= probes.extent.x || block.y >= probes.extent.y) return;
        probes.pixel(block.x, block.y)[0] = luminance;
        probes.pixel(block.x, block.y)[1] = state;
    }

    /// Rays per tile of the next frame with these probes.
    HostImage count() {
        const glm::uvec2 tiles(7, 5);
        const Image image = pass_list.image_of("probes", Format::rg32f, probes.extent);
        pass_list.upload(image, probes);
        pass_list.begin_frame(camera, parameters.params, {});
        const PassList::History ray_count = pass_list.history("ray_count", Format::r32f, tiles),
                                frames_left = pass_list.history("frames_left", Format::r32f, tiles);
        pass_list.compute("frostbite_sssr/count_rays.comp")
            .read(image)
            .read(ray_count.previous)
            .read(frames_left.previous)
            .write(ray_count.current)
            .write(frames_left.current)
            .run();
        return pass_list.download(ray_count.current);
    }
};

TEST_F(FrostbiteTilesTest, GetNoRaysWithoutAnyHit) {
    parameters.params.assign({{"min_rays", 2}, {"max_rays", 4}});
    for (unsigned tile = 0; tile < 35; ++tile) fill({tile % 7, tile / 7}, missed, 0.1f * float(tile % 3));
    for (const float rays : count().values) EXPECT_EQ(rays, 0);
}

TEST_F(FrostbiteTilesTest, GetTheLeastNumberWhereProbesAgreeAndTheLargestWhereTheyDiffer) {
    parameters.params.assign({{"min_rays", 2}, {"max_rays", 4}, {"dilate_tiles", false}});
    // 0.3 is no sum of few powers of two, and the sum of its copies rounds; tile 6 has 4 probes only.
    for (unsigned tile = 0; tile < 35; ++tile) fill({tile % 7, tile / 7}, hit, 0.3f);
    for (unsigned i = 0; i < 16; ++i) set_probe({1, 1}, i, i % 2 ? hit : missed, i % 2 ? 0.8f : 0.0f);
    // Deviation 0.1 of the mean 0.35, scale 0.5: half-way between 2 and 4.
    for (unsigned i = 0; i < 16; ++i) set_probe({3, 1}, i, hit, i % 2 ? 0.45f : 0.25f);
    set_probe({5, 1}, 3, none, 100);  // is not there
    const HostImage found = count();
    for (unsigned tile = 0; tile < 35; ++tile) {
        const glm::uvec2 at(tile % 7, tile / 7);
        const float expected = at == glm::uvec2(1, 1) ? 4.0f : at == glm::uvec2(3, 1) ? 3.0f : 2.0f;
        EXPECT_EQ(*found.pixel(at.x, at.y), expected) << at.x << ", " << at.y;
    }
}

/// Three tiles: all probes hit and agree, half of them hit and they differ, a quarter hits and they agree.
TEST_F(FrostbiteTilesTest, GetRaysByTheShareOfProbesThatHit) {
    for (unsigned i = 0; i < 16; ++i) {
        set_probe({1, 1}, i, hit, 0.3f);
        set_probe({3, 1}, i, i % 2 ? hit : missed, i % 2 ? 0.8f : 0.0f);
        set_probe({5, 1}, i, i % 4 ? missed : hit, 0.3f);
    }
    struct Rule {
        const char* rays_by;
        std::array<float, 3> rays;
    };
    for (const auto& [rays_by, rays] :
         {Rule{"deviation", {1, 4, 1}}, Rule{"hit_ratio", {4, 3, 2}}, Rule{"product", {1, 3, 1}}}) {
        parameters.params.assign(
            {{"min_rays", 1}, {"max_rays", 4}, {"dilate_tiles", false}, {"hysteresis", 0}, {"rays_by", rays_by}});
        const HostImage found = count();
        for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(*found.pixel(1 + 2 * i, 1), rays[i]) << rays_by << " " << i;
    }
}

TEST_F(FrostbiteTilesTest, NeverGetFewerThanOneOrMoreThanTheLargestNumber) {
    parameters.params.assign({{"min_rays", 4}, {"max_rays", 2}});
    fill({2, 2}, hit, 0.3f);
    EXPECT_EQ(*count().pixel(2, 2), 2);
}

TEST_F(FrostbiteTilesTest, GetRaysForTheirNeighboursHits) {
    for (const bool dilates : {true, false}) {
        parameters.params.assign({{"dilate_tiles", dilates}, {"hysteresis", 0}});
        for (unsigned tile = 0; tile < 35; ++tile) fill({tile % 7, tile / 7}, missed, 0);
        fill({2, 0}, none, 0);  // nothing there reflects
        set_probe({3, 1}, 5, hit, 0.5f);
        set_probe({6, 4}, 0, hit, 0.5f);
        const HostImage found = count();
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 7; ++x) {
                const int reach = dilates ? 1 : 0;
                const bool is_near = (std::abs(x - 3) <= reach && std::abs(y - 1) <= reach) ||
                                     (std::abs(x - 6) <= reach && std::abs(y - 4) <= reach);
                EXPECT_EQ(*found.pixel(unsigned(x), unsigned(y)), is_near && glm::ivec2(x, y) != glm::ivec2(2, 0))
                    << x << ", " << y;
            }
    }
}

TEST_F(FrostbiteTilesTest, KeepTheirRaysForSomeFramesAfterTheLastHit) {
    for (const unsigned hysteresis : {0u, 3u}) {
        parameters.params.assign(
            {{"min_rays", 1}, {"max_rays", 4}, {"hysteresis", hysteresis}, {"dilate_tiles", false}});
        for (unsigned i = 0; i < 16; ++i) set_probe({1, 1}, i, hit, i % 2 ? 0.8f : 0.0f);
        EXPECT_EQ(*count().pixel(1, 1), 4);
        fill({1, 1}, missed, 0);
        for (unsigned frame = 1; frame < 6; ++frame)
            EXPECT_EQ(*count().pixel(1, 1), frame <= hysteresis ? 4 : 0) << "frame " << frame << " of " << hysteresis;
    }
}

// --- Probes ---

/// A whole screen of surface that reflects but shows nothing: rays go past the camera.
SyntheticHit frontal_plane(const CameraRay& ray) {
    return {.distance = -5.0f / ray.direction.z, .normal = {0, 0, 1}, .roughness = 0.1f, .metalness = 1, .specular = 1};
}

struct FrostbiteProbes : FrostbiteTilesTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = extent};

    GBuffer begin(const SyntheticScene& scene, unsigned frame) {
        camera = camera_data(pose, nullptr, view);
        camera.frame.x = frame;
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        pass_list.begin_frame(camera, parameters.params, gbuffer.images());
        return gbuffer;
    }

    FrostbiteTiles classify(const GBuffer& gbuffer) {
        return frostbite_classify(pass_list, gbuffer, parameters.ray.tracers.images(pass_list, gbuffer.depth),
                                  gbuffer.lit, parameters.ray);
    }

    HostImage probes_of(const GBuffer& gbuffer) {
        classify(gbuffer);
        return pass_list.download(pass_list.image_of("probes", Format::rg32f, probes.extent));
    }
};

TEST_F(FrostbiteProbes, ComeToEveryPixelOfTheirBlockAndAreSpreadOverRowsAndColumns) {
    HostImage numbers(extent, 4);  // of each pixel in its block, as the luminance that misses see
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            numbers.set_rgb(y * extent.x + x, glm::vec3(float(x % 8 + 8 * (y % 8))));
    std::vector<std::set<int>> seen(probes.pixel_count());
    for (unsigned frame = 0; frame < 64; ++frame) {
        const GBuffer gbuffer = begin(frontal_plane, frame);
        pass_list.upload(gbuffer.fallback, numbers);
        const HostImage found = probes_of(gbuffer);
        std::vector<std::set<int>> rows(8), columns(8);  // of the first eight blocks in each column and row
        for (unsigned block = 0; block < found.pixel_count(); ++block) {
            const float y = found.values[2 * block];
            ASSERT_EQ(found.values[2 * block + 1], missed);
            const int pixel = int(std::lround(y / (1 - y)));
            seen[block].insert(pixel);
            const glm::uvec2 at(block % 25, block / 25);
            if (at.x >= 8 || at.y >= 8) continue;
            columns[at.x].insert(pixel % 8);
            rows[at.y].insert(pixel / 8);
        }
        for (int i = 0; i < 8; ++i) {
            EXPECT_EQ(columns[size_t(i)].size(), 8u);
            EXPECT_EQ(rows[size_t(i)].size(), 8u);
        }
    }
    for (const auto& pixels : seen) EXPECT_EQ(pixels.size(), 64u);
}

/// One pixel of a block is enough to be probed in every frame.
TEST_F(FrostbiteProbes, FindTheOnlyPixelThatReflects) {
    for (unsigned frame = 0; frame < 64; frame += 7) {
        const GBuffer gbuffer = begin(
            [&](const CameraRay& ray) {
                SyntheticHit surface = frontal_plane(ray);
                const CameraRay only = camera_ray(pose, extent, glm::vec2(77, 50) + 0.5f);
                if (ray.direction != only.direction) surface.metalness = surface.specular = 0;
                return surface;
            },
            frame);
        const HostImage found = probes_of(gbuffer);
        for (unsigned y = 0; y < found.extent.y; ++y)
            for (unsigned x = 0; x < found.extent.x; ++x)
                EXPECT_EQ(found.pixel(x, y)[1], x == 9 && y == 6 ? missed : none) << x << ", " << y;
    }
}

// --- A thin object, reflected ---

/// A smooth floor below nothing but a post, `width` wide, that stands on it 6 m away at `x`.
SyntheticHit floor_and_post(const CameraRay& ray, float x, float width) {
    const float to_post = -6.0f / ray.direction.z, side = ray.origin.x + to_post * ray.direction.x;
    const float height = ray.origin.y + to_post * ray.direction.y;
    if (std::abs(side - x) < 0.5f * width && height > -1.0f && height < 2.0f)
        return {.distance = to_post, .normal = {0, 0, 1}, .lit = glm::vec3(1)};
    SyntheticHit hit = mirror_floor(ray);
    if (hit.metalness == 0) return SyntheticHit{};
    hit.roughness = 0.05f;
    return hit;
}

struct FrostbiteThinObject : FrostbiteProbes {
    static constexpr unsigned frames = 25;

    /// The post crosses the screen, 2.5 pixels per frame.
    GBuffer begin_crossing(unsigned frame) {
        const float x = -1.8f + 0.13f * float(frame);
        return begin([&](const CameraRay& ray) { return floor_and_post(ray, x, 0.06f); }, frame);
    }

    /// Tiles in which some pixel's mirror ray meets the post.
    std::set<unsigned> tiles_that_hit(const GBuffer& gbuffer) {
        const HostImage depth = pass_list.download(gbuffer.depth), normal = pass_list.download(gbuffer.normal);
        const float thickness = parameters.params.values().at("frostbite.relative_thickness");
        std::set<unsigned> tiles;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const unsigned tile = y / frostbite_tile * 7 + x / frostbite_tile;
                const bool is_floor = *depth.pixel(x, y) != 1 && normal.pixel(x, y)[3] < 0.5f;
                if (!is_floor || tiles.contains(tile)) continue;
                const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(extent) * 2.0f - 1.0f;
                const glm::vec4 v = camera.view_from_clip * glm::vec4(ndc, *depth.pixel(x, y), 1);
                const glm::vec3 origin = glm::vec3(v) / v.w, up(0, 1, 0);
                const PixelRay ray{{x, y}, origin, glm::reflect(glm::normalize(origin), up), up};
                if (march_every_pixel(depth, camera, ray, thickness).is_hit) tiles.insert(tile);
            }
        return tiles;
    }
};

/// Counts tiles that get no rays although some pixel in them reflects the post: 20 of 50 with probes alone, 1 with
/// hysteresis, 2 with dilation, none with both.
TEST_F(FrostbiteThinObject, MakesNoTilePopWithDilationAndHysteresis) {
    std::vector<std::set<unsigned>> truth;
    size_t tiles = 0;
    for (unsigned frame = 0; frame < frames; ++frame)
        tiles += truth.emplace_back(tiles_that_hit(begin_crossing(frame))).size();
    EXPECT_GT(tiles, 40u);
    for (const bool dilates : {false, true})
        for (const unsigned hysteresis : {0u, 4u}) {
            parameters.params.assign({{"dilate_tiles", dilates}, {"hysteresis", hysteresis}});
            for (const PassList::History& history : {pass_list.history("ray_count", Format::r32f, {7, 5}),
                                                     pass_list.history("frames_left", Format::r32f, {7, 5})})
                for (const Image& image : {history.current, history.previous}) pass_list.clear(image, {});
            size_t popped = 0;
            for (unsigned frame = 0; frame < frames; ++frame) {
                const HostImage rays = pass_list.download(classify(begin_crossing(frame)).ray_count);
                for (const unsigned tile : truth[frame]) popped += rays.values[tile] == 0;
            }
            SCOPED_TRACE(testing::Message() << popped << " of " << tiles << " tiles, dilation " << dilates
                                            << ", hysteresis " << hysteresis);
            EXPECT_EQ(popped == 0, dilates && hysteresis > 0);
            if (!dilates && hysteresis == 0) {
                EXPECT_GT(popped, 10u);
            }
        }
}

// --- Pixels of tiles without rays ---

/// Confidence of the pixels of tiles without rays, as resolved from the rays around them and with rays in all tiles.
struct Edge {
    double pixels = 0, found = 0, with_rays = 0;
};

struct FrostbiteTileEdges : FrostbiteProbes {
    static SyntheticHit rough_floor(const CameraRay& ray) {
        SyntheticHit hit = floor_and_post(ray, 0.7f, 0.5f);
        if (hit.metalness > 0) hit.roughness = 0.4f;
        return hit;
    }

    HostImage confidence(bool classification, unsigned seed, HostImage& ray_count) {
        parameters.params.assign({{"classification", classification}});
        camera = camera_data(pose, nullptr, view);
        camera.frame.y = seed;
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, rough_floor);
        pass_list.begin_frame(camera, parameters.params, gbuffer.images());
        const Tracers::Images depths = parameters.ray.tracers.images(pass_list, gbuffer.depth);
        const FrostbiteTiles tiles = frostbite_classify(pass_list, gbuffer, depths, gbuffer.lit, parameters.ray);
        const FrostbiteWork work = frostbite_allocate(pass_list, gbuffer, tiles, parameters.ray);
        const Image horizon = HorizonImage().on(pass_list, parameters.params);
        const TracedRays rays = frostbite_trace(pass_list, depths, work, horizon, parameters.ray);
        ray_count = pass_list.download(tiles.ray_count);
        return pass_list.download(frostbite_resolve(pass_list, gbuffer, gbuffer.lit, split_sum.on(pass_list), horizon,
                                                    rays, parameters.resolve)
                                      .radiance);
    }

    /// Of those that see some rays of other tiles, and of the others.
    std::array<Edge, 2> measure() {
        std::array<Edge, 2> edges;
        for (unsigned seed = 0; seed < 4; ++seed) {
            HostImage ray_count, all;
            const HostImage found = confidence(true, seed, ray_count), with_rays = confidence(false, seed, all);
            for (unsigned y = 0; y < extent.y; ++y)
                for (unsigned x = 0; x < extent.x; ++x) {
                    const SyntheticHit hit = rough_floor(camera_ray(pose, extent, glm::vec2(x, y) + 0.5f));
                    if (hit.specular == 0 || *ray_count.pixel(x / 32, y / 32) > 0) continue;
                    const auto has_rays = [&](int dx, int dy) {
                        const glm::ivec2 tile =
                            glm::clamp(glm::ivec2(x, y) + glm::ivec2(dx, dy), {0, 0}, glm::ivec2(extent) - 1) / 32;
                        return *ray_count.pixel(unsigned(tile.x), unsigned(tile.y)) > 0;
                    };
                    const bool is_near = has_rays(-4, 0) || has_rays(4, 0) || has_rays(0, -4) || has_rays(0, 4);
                    Edge& edge = edges[is_near ? 0 : 1];
                    ++edge.pixels;
                    edge.found += found.pixel(x, y)[3];
                    edge.with_rays += with_rays.pixel(x, y)[3];
                }
        }
        return edges;
    }

    SplitSumImage split_sum;
};

/// A tile without rays has nothing to say of how often they would have missed, so that its outer pixels trust hits
/// across its border too much: without dilation 0.015 in place of 0.005. With it these tiles are a tile away from any
/// hit, and both are 0. Beyond the taps' reach there is nothing.
TEST_F(FrostbiteTileEdges, AreResolvedFromTheRaysAcross) {
    for (const bool dilates : {true, false}) {
        parameters.params.assign({{"dilate_tiles", dilates}, {"hysteresis", 0}, {"filtered_sampling", false}});
        const auto [near, far] = measure();
        EXPECT_GT(near.pixels, 1000);
        EXPECT_GT(far.pixels, 10000);
        EXPECT_EQ(near.found > 0, !dilates);
        EXPECT_NEAR(near.found / near.pixels, near.with_rays / near.pixels, dilates ? 0 : 0.02);
        EXPECT_EQ(far.found, 0);
        EXPECT_LT(far.with_rays / far.pixels, 1e-4);
    }
}

}  // namespace
