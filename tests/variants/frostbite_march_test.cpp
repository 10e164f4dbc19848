#include "tests/variants/frostbite_technique.h"
#include "tests/variants/pixel_march.h"
#include "tests/variants/technique_fixture.h"

#include <random>

// The two tracers against marches on the CPU, ray by ray.

namespace {

struct Found {
    bool is_hit;
    glm::ivec2 pixel;
    float distance;
};

struct FrostbiteMarch : TechniqueTest {
    glm::uvec2 extent{193, 131};  // odd on three levels
    CameraPose pose{.vertical_fov = 1.0f, .near = 0.1f, .far = 100.0f};
    FrameView view;
    CameraData camera{};
    HostImage depth, normal;
    ParameterSet params;
    FrostbiteRayParameters parameters{params};

    /// The marches on the CPU know no front of a surface.
    void SetUp() override { params.assign({{"frostbite.front_faces_only", false}}); }

    template <class T>
    T value(const char* parameter) const {
        return params.values().at(parameter).get<T>();
    }

    float device_depth(float distance) const {
        const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -distance, 1);
        return clip.z / clip.w;
    }

    /// Hills with boxes before them, posts one pixel wide and holes of background.
    void make_depth() {
        view.extent = extent;
        camera = camera_data(pose, nullptr, view);
        depth = HostImage(extent, 1, camera.depth.z);
        normal = HostImage(extent, 4);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                float distance =
                    6.0f + 1.5f * std::sin(0.13f * float(x)) * std::cos(0.21f * float(y)) - 0.02f * float(y);
                if ((x / 12 + y / 16) % 5 == 0) distance = 2.0f + 0.01f * float(x);
                if (x % 37 == 3) distance = 1.5f;
                if ((x / 9 + y / 7) % 7 != 0) *depth.pixel(x, y) = device_depth(distance);
            }
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
        for (size_t i = 0; i < normal.pixel_count(); ++i)
            normal.set_rgb(i, glm::normalize(glm::vec3(uniform(random), uniform(random), 1.2f)));
    }

    /// A wall that faces the camera.
    void make_wall(float distance) {
        make_depth();
        depth = HostImage(extent, 1, device_depth(distance));
        for (size_t i = 0; i < normal.pixel_count(); ++i) normal.set_rgb(i, {0, 0, 1});
    }

    glm::vec3 position(glm::uvec2 pixel) const {
        const glm::vec2 screen = (glm::vec2(pixel) + 0.5f + glm::vec2(camera.jitter)) / glm::vec2(extent);
        const glm::vec4 v = camera.view_from_clip * glm::vec4(screen * 2.0f - 1.0f, *depth.pixel(pixel.x, pixel.y), 1);
        return glm::vec3(v) / v.w;
    }

    PixelRay ray_from(glm::uvec2 pixel, glm::vec3 direction) const {
        return {glm::ivec2(pixel), position(pixel), glm::normalize(direction),
                normal.rgb(size_t(pixel.y) * extent.x + pixel.x)};
    }

    /// From all over the image, to all sides of the surface but the inner.
    std::vector<PixelRay> random_rays(size_t count) const {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
        std::vector<PixelRay> rays;
        while (rays.size() < count) {
            const glm::uvec2 pixel(random() % extent.x, random() % extent.y);
            const glm::vec3 d(uniform(random), uniform(random), uniform(random));
            if (*depth.pixel(pixel.x, pixel.y) == camera.depth.z || dot(d, d) > 1 || dot(d, d) < 1e-2f) continue;
            PixelRay ray = ray_from(pixel, d);
            ray.jitter = 0.5f + 0.5f * uniform(random);
            if (dot(ray.direction, ray.normal) > 0 && ray.jitter < 1) rays.push_back(ray);
        }
        return rays;
    }

    std::vector<Found> march(const std::vector<PixelRay>& rays, bool is_linear) {
        PassList pass_list(device(), extent);
        const glm::uvec2 line(unsigned(rays.size()), 1);
        HostImage starts(line, 2), directions(line, 4);
        for (unsigned i = 0; i < line.x; ++i) {
            const PixelRay& ray = rays[i];
            *reinterpret_cast<glm::vec2*>(starts.pixel(i, 0)) = glm::vec2(ray.pixel);
            *reinterpret_cast<glm::vec4*>(directions.pixel(i, 0)) = glm::vec4(ray.direction, ray.jitter);
        }
        const auto upload = [&](const char* name, Format format, const HostImage& pixels) {
            const Image image = pass_list.image_of(name, format, pixels.extent);
            pass_list.upload(image, pixels);
            return image;
        };
        const std::vector<Image> inputs{upload("depth", Format::r32f, depth),
                                        upload("geometric_normal", Format::rgba32f, normal)};
        pass_list.begin_frame(camera, params, inputs);
        const Image found = pass_list.image_of("found", Format::rgba32f, line);
        const Tracers::Images depths = parameters.tracers.images(pass_list, inputs[0]);
        pass_list.compute("frostbite_rays.comp")
            .read(depths.nearest)
            .read(depths.farthest)
            .read(upload("ray_start", Format::rg32f, starts))
            .read(upload("ray_direction", Format::rgba32f, directions))
            .write(found)
            .set("is_linear", unsigned(is_linear))
            .run();
        const HostImage pixels = pass_list.download(found);
        std::vector<Found> result;
        for (unsigned i = 0; i < line.x; ++i) {
            const float* p = pixels.pixel(i, 0);
            result.push_back({p[3] > 0, glm::ivec2(int(p[0]), int(p[1])), p[2]});
        }
        return result;
    }

    Found march(const PixelRay& ray) { return march(std::vector{ray}, false).front(); }

    PixelMarchResult truth(const PixelRay& ray) const {
        return march_every_pixel(depth, camera, ray, value<float>("frostbite.relative_thickness"));
    }

    /// Over 1920x1080: a fence of poles three pixels wide, with two wires and a board of 300 pixels, 2 m away before a
    /// wall of waves. A ray that leaves the wall goes behind poles for most of its way.
    void make_fence() {
        extent = {1920, 1080};
        make_wall(6);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const bool is_pole = x % 23 < 3, is_wire = y % 311 < 2, is_board = x / 300 == 3;
                const float wall = 6.0f + 1.5f * std::sin(0.011f * float(x)) * std::cos(0.017f * float(y));
                const bool is_gap = x / 700 == 1 && y > 700;
                if (is_pole || is_wire || is_board)
                    *depth.pixel(x, y) = device_depth(2 + 2e-4f * float(x));
                else if (is_gap)
                    *depth.pixel(x, y) = camera.depth.z;
                else
                    *depth.pixel(x, y) = device_depth(wall);
            }
    }

    /// Of the rays whose truth is a hit, the share that misses.
    double lost_share(const std::vector<PixelRay>& rays, const std::vector<PixelMarchResult>& expected) {
        const std::vector<Found> found = march(rays, false);
        double hits = 0, lost = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            hits += expected[i].is_hit;
            lost += expected[i].is_hit && !found[i].is_hit;
        }
        return lost / hits;
    }

    /// No ray may differ but where float cannot decide, and that must be rare.
    void expect_agreement(bool is_linear, size_t count = 6000) {
        const std::vector<PixelRay> rays = random_rays(count);
        const std::vector<Found> found = march(rays, is_linear);
        size_t hits = 0, close_calls = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const PixelMarchResult expected =
                is_linear ? march_equal_steps(depth, camera, rays[i], value<float>("frostbite.relative_thickness"),
                                              value<unsigned>("frostbite.linear_steps"),
                                              value<unsigned>("frostbite.linear_refinements"))
                          : truth(rays[i]);
            hits += expected.is_hit;
            // Depth is affine on the screen to a few 1e-7 of its range, and a ray's length is found from its place
            // there.
            const bool agrees = found[i].is_hit == expected.is_hit &&
                                (!expected.is_hit ||
                                 (found[i].pixel == expected.pixel &&
                                  std::abs(found[i].distance - expected.distance) < 2e-3 * expected.distance + 1e-3));
            if (agrees) continue;
            ++close_calls;
            EXPECT_TRUE(expected.is_close_call)
                << "ray " << i << " from " << rays[i].pixel.x << ", " << rays[i].pixel.y << ": hit " << found[i].is_hit
                << " at " << found[i].pixel.x << ", " << found[i].pixel.y << ", " << found[i].distance << " m; truth "
                << expected.is_hit << " at " << expected.pixel.x << ", " << expected.pixel.y << ", "
                << expected.distance << " m";
        }
        EXPECT_LE(double(close_calls), 0.002 * double(rays.size()));
        EXPECT_GT(double(hits), 0.1 * double(rays.size()));
    }
};

TEST_F(FrostbiteMarch, ThroughTheHierarchyFindsWhatEveryPixelHolds) {
    make_depth();
    expect_agreement(false);
}

TEST_F(FrostbiteMarch, ThroughTheHierarchyWorksForReversedDepthAndJitter) {
    view.depth_direction = DepthDirection::reversed;
    view.jitter = {0.3f, -0.4f};
    make_depth();
    expect_agreement(false);
}

TEST_F(FrostbiteMarch, ThroughTheHierarchyWorksForOrthographicCameras) {
    pose.is_orthographic = true;
    pose.orthographic_height = 8.0f;
    make_depth();
    expect_agreement(false);
}

/// With the default limit, where behind the fence no coarser cell is passed.
TEST_F(FrostbiteMarch, ThroughTheHierarchyLosesNothingAtFullSize) {
    make_fence();
    expect_agreement(false, 2000);
}

/// What is wide is passed in coarse cells from behind, too: a board of 300 pixels, without the poles, costs no more
/// cells than free air. A march that goes from pixel to pixel there loses a fifth of these hits with as many cells.
TEST_F(FrostbiteMarch, ClimbsAgainBehindThings) {
    make_fence();
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            if (x / 300 % 2 == 0 && y > 200)
                *depth.pixel(x, y) = device_depth(2);
            else
                *depth.pixel(x, y) =
                    device_depth(6.0f + 1.5f * std::sin(0.011f * float(x)) * std::cos(0.017f * float(y)));
    const std::vector<PixelRay> rays = random_rays(2000);
    std::vector<PixelMarchResult> expected;
    for (const PixelRay& ray : rays) expected.push_back(truth(ray));
    EXPECT_EQ(lost_share(rays, expected), 0);
    params.assign({{"frostbite.max_hierarchical_steps", 128}});
    EXPECT_LT(lost_share(rays, expected), 0.01);
}

TEST_F(FrostbiteMarch, TakesTheStepsThatItSays) {
    make_depth();
    expect_agreement(true);
}

TEST_F(FrostbiteMarch, TakesTheStepsThatItSaysForReversedDepthAndJitter) {
    view.depth_direction = DepthDirection::reversed;
    view.jitter = {0.3f, -0.4f};
    make_depth();
    expect_agreement(true);
}

TEST_F(FrostbiteMarch, TakesTheStepsThatItSaysForOrthographicCameras) {
    pose.is_orthographic = true;
    pose.orthographic_height = 8.0f;
    make_depth();
    expect_agreement(true);
}

TEST_F(FrostbiteMarch, EndsWithItsSteps) {
    make_depth();
    params.assign({{"frostbite.max_hierarchical_steps", 1}});
    const std::vector<PixelRay> rays = random_rays(500);
    const std::vector<Found> found = march(rays, false);
    for (size_t i = 0; i < rays.size(); ++i)  // the first is the pixel beside its own
        EXPECT_TRUE(!found[i].is_hit || glm::distance(glm::vec2(found[i].pixel), glm::vec2(rays[i].pixel)) == 1);
}

/// Shares of 6000 rays.
struct Wrong {
    double end = 0;    ///< hit or miss
    double pixel = 0;  ///< two pixels or more from the right one
};

/// What the defaults cost, against a look at every pixel, in a scene of posts that are one pixel wide: rays through the
/// hierarchy lose nothing; of those with 8, 32 and 512 linear steps 31, 11 and 5 % end
/// otherwise (a step may pass over a post, and rays towards the camera must be behind a surface at a step's end), and
/// 12, 11 and 6 % elsewhere. The bounds leave room for devices that round otherwise.
TEST_F(FrostbiteMarch, LosesWhatItsLimitsSay) {
    make_depth();
    const std::vector<PixelRay> rays = random_rays(6000);
    std::vector<PixelMarchResult> expected;
    for (const PixelRay& ray : rays) expected.push_back(truth(ray));
    const auto wrong = [&](bool is_linear) {
        const std::vector<Found> found = march(rays, is_linear);
        Wrong wrong;
        for (size_t i = 0; i < rays.size(); ++i) {
            const glm::ivec2 off = glm::abs(found[i].pixel - expected[i].pixel);
            if (found[i].is_hit != expected[i].is_hit)
                wrong.end += 1.0 / double(rays.size());
            else if (found[i].is_hit && std::max(off.x, off.y) >= 2)
                wrong.pixel += 1.0 / double(rays.size());
        }
        return wrong;
    };
    const Wrong hierarchical = wrong(false);
    EXPECT_LT(hierarchical.end, 0.001);
    EXPECT_EQ(hierarchical.pixel, 0);
    struct Case {
        unsigned steps;
        double end, pixel;
    };
    for (const Case& c : {Case{8, 0.314, 0.121}, Case{32, 0.110, 0.113}, Case{512, 0.046, 0.058}}) {
        params.assign({{"frostbite.linear_steps", c.steps}});
        const Wrong linear = wrong(true);
        EXPECT_NEAR(linear.end, c.end, 0.01) << c.steps;
        EXPECT_NEAR(linear.pixel, c.pixel, 0.01) << c.steps;
    }
}

/// A wall before a floor of pixels in front of it: without refinement a hit is seen up to a step too late.
TEST_F(FrostbiteMarch, FindsTheHitWithinItsStep) {
    make_wall(10);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 100; x < extent.x; ++x) *depth.pixel(x, y) = device_depth(5);
    *depth.pixel(20, 60) = device_depth(5.02f);
    params.assign({{"frostbite.linear_steps", 8}, {"frostbite.relative_thickness", 0.05}});
    for (const float jitter : {0.1f, 0.5f, 0.9f}) {
        PixelRay ray = ray_from({20, 60}, {1, 0, 0});
        ray.jitter = jitter;
        // 21.6 pixels per step, halved to 0.7.
        const int pixel = march(std::vector{ray}, true).front().pixel.x;
        EXPECT_TRUE(pixel >= 100 && pixel <= 102) << pixel;
        params.assign({{"frostbite.linear_refinements", 0}});
        const double stride = (193 - 20.5) / 8, unrefined = std::ceil((79.5 - jitter * stride) / stride) + jitter;
        EXPECT_EQ(march(std::vector{ray}, true).front().pixel.x, int(20.5 + unrefined * stride));
        params.assign({{"frostbite.linear_refinements", 8}});
    }
}

/// Steps of 21.6 pixels, whatever the first one's length, leave up to one of them before the border.
TEST_F(FrostbiteMarch, StepsUpToTheBorder) {
    make_wall(10);
    for (unsigned y = 0; y < extent.y; ++y) *depth.pixel(192, y) = device_depth(5);
    *depth.pixel(20, 60) = device_depth(5.02f);
    for (const unsigned steps : {1u, 8u, 512u})
        for (const float jitter : {0.0f, 0.1f, 0.9f}) {
            params.assign({{"frostbite.linear_steps", steps}});
            PixelRay ray = ray_from({20, 60}, {1, 0, 0});
            ray.jitter = jitter;
            const Found found = march(std::vector{ray}, true).front();
            EXPECT_TRUE(found.is_hit && found.pixel == glm::ivec2(192, 60)) << steps << " steps, jitter " << jitter;
        }
}

// --- Degenerate rays ---

TEST_F(FrostbiteMarch, MissesAlongTheView) {
    make_depth();
    for (const glm::uvec2 pixel : {glm::uvec2(40, 30), glm::uvec2(96, 65), glm::uvec2(150, 100)}) {
        const glm::vec3 towards = glm::normalize(position(pixel));
        EXPECT_FALSE(march(ray_from(pixel, towards)).is_hit);   // all behind its own pixel is hidden by it
        EXPECT_FALSE(march(ray_from(pixel, -towards)).is_hit);  // towards the eye there is nothing in front
    }
    EXPECT_FALSE(march(ray_from({96, 65}, {0, 0, 1})).is_hit);
}

/// A wall at 10 m, of which one row and one column stand at 5 m, as does the pixel that the rays start from.
TEST_F(FrostbiteMarch, WalksRowsAndColumns) {
    make_wall(10);
    for (unsigned y = 0; y < extent.y; ++y) *depth.pixel(170, y) = device_depth(5);
    for (unsigned x = 0; x < extent.x; ++x) *depth.pixel(x, 10) = device_depth(5);
    *depth.pixel(20, 100) = device_depth(5.02f);
    const Found right = march(ray_from({20, 100}, {1, 0, 0})), up = march(ray_from({20, 100}, {0, 1, 0}));
    EXPECT_TRUE(right.is_hit && up.is_hit);
    EXPECT_EQ(right.pixel, glm::ivec2(170, 100));
    EXPECT_EQ(up.pixel, glm::ivec2(20, 10));
    EXPECT_FALSE(march(ray_from({20, 100}, {-1, 0, 0})).is_hit);
    EXPECT_FALSE(march(ray_from({20, 100}, {0, -1, 0})).is_hit);
}

/// Behind the near plane all is projected to the opposite side of the screen, where this wall would be met.
TEST_F(FrostbiteMarch, EndsAtTheNearPlane) {
    make_wall(20);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < 60; ++x) *depth.pixel(x, y) = device_depth(0.2f);
    params.assign({{"frostbite.relative_thickness", 10.0}});
    EXPECT_FALSE(march(ray_from({97, 65}, {0.02f, 0.001f, 1.0f})).is_hit);
}

/// Levels of odd size have no texel for their last column: what stands there is met all the same.
TEST_F(FrostbiteMarch, MeetsTheLastColumnAndRowOfOddSizes) {
    for (const glm::uvec2 size : {glm::uvec2(193, 131), glm::uvec2(127, 95), glm::uvec2(5, 3), glm::uvec2(66, 70)}) {
        extent = size;
        make_wall(10);
        for (unsigned y = 0; y < extent.y; ++y) *depth.pixel(extent.x - 1, y) = device_depth(5);
        for (unsigned x = 0; x < extent.x; ++x) *depth.pixel(x, extent.y - 1) = device_depth(5);
        *depth.pixel(0, 0) = device_depth(5.02f);
        EXPECT_EQ(march(ray_from({0, 0}, {1, 0, 0})).pixel, glm::ivec2(extent.x - 1, 0));
        EXPECT_EQ(march(ray_from({0, 0}, {0, -1, 0})).pixel, glm::ivec2(0, extent.y - 1));
    }
}

}  // namespace
