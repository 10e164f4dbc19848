#include "experiments/study/stability/precision/double_shader.h"
#include "tests/variants/brute_force_march.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"

#include <random>

namespace {

struct TestRay {
    glm::vec3 origin, direction;  ///< view space
};

struct Found {
    glm::vec2 position;
    float distance;
    bool is_hit;
};

struct McGuireMarch : TechniqueTest {
    static constexpr glm::uvec2 extent{96, 64};
    CameraPose pose{.vertical_fov = 1.0f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = extent};
    PassList pass_list{device(), extent};
    std::unique_ptr<Technique> technique = make_technique("mcguire_dda", {{"dda.max_distance", 50.0}});
    CameraData camera{};
    HostImage depth{extent, 1};

    /// Sinusoidal hills with boxes before them and holes of background, given as view distances.
    void make_depth() {
        camera = camera_data(pose, nullptr, view);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                float distance =
                    6.0f + 1.5f * std::sin(0.13f * float(x)) * std::cos(0.21f * float(y)) - 0.05f * float(y);
                if ((x / 12 + y / 16) % 3 == 0) distance = 2.0f + 0.02f * float(x);
                const bool is_hole = (x / 9 + y / 7) % 5 == 0;
                const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -distance, 1);
                *depth.pixel(x, y) = is_hole ? camera.depth.z : clip.z / clip.w;
            }
    }

    glm::vec3 unproject(glm::vec2 screen, float device_depth) const {
        const glm::vec4 v =
            camera.view_from_clip * glm::vec4(screen / glm::vec2(extent) * 2.0f - 1.0f, device_depth, 1.0f);
        return glm::vec3(v) / v.w;
    }
    glm::vec3 position_at(unsigned x, unsigned y) const {
        return unproject(glm::vec2(x, y) + 0.5f, *depth.pixel(x, y));
    }

    std::vector<Found> march(const std::vector<TestRay>& rays) {
        const glm::uvec2 line(unsigned(rays.size()), 1);
        HostImage origins(line, 4), directions(line, 4);
        for (size_t i = 0; i < rays.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                origins.values[4 * i + size_t(c)] = rays[i].origin[c];
                directions.values[4 * i + size_t(c)] = rays[i].direction[c];
            }
        const Image depth_image = pass_list.image("depth", Format::r32f);
        pass_list.upload(depth_image, depth);
        pass_list.begin_frame(camera, technique->params, std::array{depth_image});
        const auto rays_image = [&](const char* name, const HostImage& pixels) {
            const Image image = pass_list.image_of(name, Format::rgba32f, line);
            pass_list.upload(image, pixels);
            return image;
        };
        const Image found = pass_list.image_of("found", Format::rgba32f, line);
        pass_list.compute("dda_rays.comp")
            .read(rays_image("ray_origin", origins))
            .read(rays_image("ray_direction", directions))
            .write(found)
            .run();
        const HostImage pixels = pass_list.download(found);
        std::vector<Found> result;
        for (unsigned i = 0; i < line.x; ++i) {
            const float* p = pixels.pixel(i, 0);
            result.push_back({{p[0], p[1]}, p[2], p[3] > 0});
        }
        return result;
    }

    Found march(TestRay ray) { return march(std::vector{ray}).front(); }

    /// From anywhere on the visible surfaces, in all directions. From pixel centres, lines clipped half a pixel inside
    /// of the screen would all end on a tie.
    std::vector<TestRay> random_rays(size_t count) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(-1.0f, 1.0f), inside(0.02f, 0.98f);
        std::vector<TestRay> rays;
        while (rays.size() < count) {
            const glm::vec2 screen = glm::vec2(inside(random), inside(random)) * glm::vec2(extent);
            const glm::uvec2 pixel(floor(screen - glm::vec2(camera.jitter)));
            const glm::vec3 d(uniform(random), uniform(random), uniform(random));
            if (*depth.pixel(pixel.x, pixel.y) == camera.depth.z || dot(d, d) > 1 || dot(d, d) < 1e-2f) continue;
            rays.push_back({unproject(screen, *depth.pixel(pixel.x, pixel.y)), normalize(d)});
        }
        return rays;
    }

    /// `relative`, `absolute`: by how much distances may differ (1, m). By default: float carries 1/w, a difference of
    /// two projections, to about 1e-5 of the distance over a hundred pixels.
    void expect_agreement(const std::vector<TestRay>& rays, const MarchSettings& settings, double least_hits,
                          double relative = 1e-3, double absolute = 1e-4) {
        const std::vector<Found> found = march(rays);
        size_t hits = 0, close_calls = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const MarchResult truth = brute_force_march(depth, camera, rays[i].origin, rays[i].direction, settings);
            hits += truth.is_hit;
            const glm::vec2 cell = floor(found[i].position - glm::vec2(camera.jitter));
            const bool agrees =
                found[i].is_hit == truth.is_hit &&
                (!truth.is_hit || (glm::ivec2(cell) == truth.pixel && std::abs(found[i].distance - truth.distance) <
                                                                          relative * truth.distance + absolute));
            if (agrees) continue;
            ++close_calls;
            EXPECT_TRUE(truth.is_close_call)
                << "ray " << i << ": hit " << found[i].is_hit << " at " << found[i].position.x << ", "
                << found[i].position.y << ", " << found[i].distance << " m; truth " << truth.is_hit << " at "
                << truth.pixel.x << ", " << truth.pixel.y << ", " << truth.distance << " m";
        }
        EXPECT_LT(double(close_calls), 0.002 * double(rays.size()));  // the excuse must stay rare
        EXPECT_GT(double(hits), least_hits * double(rays.size()));    // and the test must not be empty
    }
};

TEST_F(McGuireMarch, AgreesWithBruteForce) {
    make_depth();
    expect_agreement(random_rays(4000), {.max_distance = 50}, 0.1);
}

TEST_F(McGuireMarch, AgreesWithBruteForceForStrideAndThickness) {
    make_depth();
    technique->params.assign(
        {{"dda.stride", 3}, {"dda.jitter", 1.25}, {"dda.thickness", 0.02}, {"dda.relative_thickness", 0.1}});
    expect_agreement(random_rays(4000),
                     {.stride = 3, .jitter = 1.25, .thickness = 0.02, .relative_thickness = 0.1, .max_distance = 50},
                     0.1);
}

TEST_F(McGuireMarch, AgreesWithBruteForceAsPublished) {
    make_depth();
    // Rays start in front of the surface: on a wall that faces the camera the published first interval begins with a
    // tie.
    technique->params.assign({{"dda.interval_from_origin", true}, {"dda.thickness", 0.5}});
    std::vector<TestRay> rays = random_rays(4000);
    for (TestRay& ray : rays) ray.origin *= 0.98f;
    expect_agreement(rays, {.thickness = 0.5, .max_distance = 50, .interval_from_origin = true}, 0.1);
}

TEST_F(McGuireMarch, AgreesWithBruteForceForReversedDepthAndJitter) {
    view.depth_direction = DepthDirection::reversed;
    view.jitter = {0.3f, -0.4f};
    make_depth();
    expect_agreement(random_rays(4000), {.max_distance = 50}, 0.1);
}

TEST_F(McGuireMarch, AgreesWithBruteForceForOrthographicCameras) {
    pose.is_orthographic = true;
    pose.orthographic_height = 8.0f;
    make_depth();
    expect_agreement(random_rays(4000), {.max_distance = 50}, 0.1);
}

/// All options at once, where depth is reversed and the samples lie beside the pixel centres.
TEST_F(McGuireMarch, AgreesWithBruteForceForStrideAndThicknessWithReversedDepthAndJitter) {
    view.depth_direction = DepthDirection::reversed;
    view.jitter = {-0.45f, 0.2f};
    make_depth();
    technique->params.assign(
        {{"dda.stride", 3}, {"dda.jitter", 1.25}, {"dda.thickness", 0.02}, {"dda.relative_thickness", 0.1}});
    expect_agreement(random_rays(4000),
                     {.stride = 3, .jitter = 1.25, .thickness = 0.02, .relative_thickness = 0.1, .max_distance = 50},
                     0.1);
}

/// The shader's own text, calculated in double, is the exact march but for the rounding of the distance to the float
/// that it is written as (6e-8), and the length of directions, which float makes unit to 1.8e-7.
TEST_F(McGuireMarch, InDoubleItIsExact) {
    make_depth();
    pass_list.set_changes({.format_of = {}, .glsl_of = double_where([](const std::string&) { return true; })});
    expect_agreement(random_rays(4000), {.max_distance = 50}, 0.1, 2.4e-7, 0.0);
}

TEST_F(McGuireMarch, IsTheSameAtEveryScale) {
    // A world 1e6 times larger: the thickness is relative, so each pixel must do what it did. Powers of two round
    // alike.
    make_depth();
    technique->params.assign({{"dda.thickness", 0.0}, {"dda.relative_thickness", 0.05}, {"dda.max_distance", 0.0}});
    std::vector<TestRay> rays = random_rays(1000);
    const std::vector<Found> small = march(rays);
    const float scale = 1048576.0f;
    pose.near *= scale;
    pose.far *= scale;
    camera = camera_data(pose, nullptr, view);
    for (TestRay& ray : rays) ray.origin *= scale;
    const std::vector<Found> large = march(rays);
    size_t different = 0, hits = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        hits += small[i].is_hit;
        different += small[i].is_hit != large[i].is_hit || distance(small[i].position, large[i].position) > 0.5f;
    }
    EXPECT_GT(hits, 100u);
    EXPECT_LT(different, 5u);  // rounding of near and far in the projection
}

// --- Degenerate rays ---

TEST_F(McGuireMarch, MissesAlongTheView) {
    make_depth();
    const glm::vec3 origin = position_at(40, 30);
    EXPECT_FALSE(march({origin, normalize(origin)}).is_hit);   // all behind its own pixel is hidden by it
    EXPECT_FALSE(march({origin, -normalize(origin)}).is_hit);  // towards the eye there is nothing in front
    EXPECT_FALSE(march({position_at(48, 32), {0, 0, 1}}).is_hit);
}

TEST_F(McGuireMarch, MissesWithinItsOwnPixel) {
    make_depth();
    technique->params.assign({{"dda.max_distance", 1e-3}});
    EXPECT_FALSE(march({position_at(40, 30), {1, 0, 0}}).is_hit);
    EXPECT_FALSE(march({position_at(40, 30), {0, 1, 0}}).is_hit);
}

TEST_F(McGuireMarch, WalksRowsAndColumns) {
    // A wall at 10 m; one column and one row of it stand at 5 m. Rays at 5 m parallel to the image must stop exactly
    // there.
    camera = camera_data(pose, nullptr, view);
    const auto device_depth = [&](float distance) {
        const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -distance, 1);
        return clip.z / clip.w;
    };
    depth = HostImage(extent, 1, device_depth(10));
    for (unsigned y = 0; y < extent.y; ++y) *depth.pixel(70, y) = device_depth(5);
    for (unsigned x = 0; x < extent.x; ++x) *depth.pixel(x, 10) = device_depth(5);
    const auto at = [&](float x, float y) {
        const glm::vec4 v =
            camera.view_from_clip *
            glm::vec4((glm::vec2(x, y) + 0.5f) / glm::vec2(extent) * 2.0f - 1.0f, device_depth(5.02f), 1);
        return glm::vec3(v) / v.w;
    };
    const Found right = march({at(20, 40), {1, 0, 0}}), up = march({at(20, 40), {0, 1, 0}});
    EXPECT_TRUE(right.is_hit && up.is_hit);
    EXPECT_NEAR(right.position.x, 70.5f, 1e-2);  // start and end are pixel centres
    EXPECT_NEAR(right.position.y, 40.5f, 1e-2);
    EXPECT_NEAR(right.distance, distance(at(20, 40), at(70, 40)), 1e-3);
    EXPECT_NEAR(up.position.y, 10.5f, 1e-2);
    EXPECT_NEAR(up.position.x, 20.5f, 1e-2);
    const Found diagonal = march({at(20, 40), normalize(at(50, 10) - at(20, 40))});
    EXPECT_TRUE(diagonal.is_hit);
    EXPECT_NEAR(diagonal.position.y, 10.5f, 1e-2);
    EXPECT_FALSE(march({at(20, 40), {-1, 0, 0}}).is_hit);
    EXPECT_FALSE(march({at(20, 40), {0, -1, 0}}).is_hit);
}

TEST_F(McGuireMarch, EndsAtTheNearPlane) {
    // A wall far away; the ray comes back past the eye. What lies behind the near plane projects to the wrong side of
    // the screen, where a box would be hit if the ray were not clipped.
    camera = camera_data(pose, nullptr, view);
    const glm::vec4 far_clip = camera.clip_from_view * glm::vec4(0, 0, -20, 1),
                    box_clip = camera.clip_from_view * glm::vec4(0, 0, -0.2f, 1);
    depth = HostImage(extent, 1, far_clip.z / far_clip.w);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < 30; ++x) *depth.pixel(x, y) = box_clip.z / box_clip.w;
    technique->params.assign({{"dda.thickness", 1e6}});
    const Found found = march({{0.0f, 0.0f, -19.0f}, normalize(glm::vec3(0.02f, 0.001f, 1.0f))});
    EXPECT_FALSE(found.is_hit);
}

TEST_F(McGuireMarch, LeavesTheScreenAtItsBorder) {
    make_depth();
    technique->params.assign({{"dda.thickness", 1e6}, {"dda.clip_to_viewport", false}});
    // Just outside the first column there is nothing, whatever a truncating conversion to int would find.
    depth = HostImage(extent, 1, camera.depth.z);
    for (unsigned y = 0; y < extent.y; ++y) *depth.pixel(0, y) = 0.0f;
    const glm::vec4 v =
        camera.view_from_clip * glm::vec4(glm::vec2(0.5f, 20.5f) / glm::vec2(extent) * 2.0f - 1.0f, 0.9f, 1);
    EXPECT_FALSE(march({glm::vec3(v) / v.w, {-1, 0, 0}}).is_hit);
}

}  // namespace
