#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"

namespace {

struct MirrorFloor : TechniqueTest {
    static constexpr glm::uvec2 extent{320, 240};
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = extent};
    PassList pass_list{device(), extent};
    std::unique_ptr<Technique> technique = make_technique("mcguire_dda");
    SyntheticScene scene = mirror_floor;
    HostImage radiance, confidence, hit;
    HostImage geometric_normal;  ///< empty: the scene's

    void render() {
        const CameraData camera = camera_data(pose, nullptr, view);
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        if (!geometric_normal.values.empty()) pass_list.upload(gbuffer.geometric_normal, geometric_normal);
        pass_list.begin_frame(camera, technique->params, gbuffer.images());
        const Reflections reflections = technique->render(pass_list, gbuffer);
        radiance = pass_list.download(reflections.radiance);
        confidence = download_confidence(pass_list, reflections);
        hit = pass_list.download(pass_list.image("hit", Format::rgba32f));
    }

    /// Where the mirror ray of a floor pixel meets the wall: pixels; the height of the wall and the ray's length in m.
    struct Mirrored {
        bool is_floor;
        glm::vec2 pixel;
        float height, distance;
    };
    Mirrored mirrored(unsigned x, unsigned y) const {
        const CameraData camera = camera_data(pose, nullptr, view);
        const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f + view.jitter);
        const SyntheticHit first = mirror_floor(ray);
        if (first.metalness == 0) return {.is_floor = false};
        const glm::vec3 p = first.distance * ray.direction, d = ray.direction * glm::vec3(1, -1, 1);
        const float t = (-6.0f - p.z) / d.z;
        const glm::vec4 clip = camera.clip_from_world * glm::vec4(p + t * d, 1);
        return {true, (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(extent), p.y + t * d.y, t};
    }

    /// Every floor pixel whose mirrored point is on the screen finds it, within `slack` pixels; returns how many those
    /// are.
    unsigned expect_true_hits(float slack) {
        unsigned count = 0;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const Mirrored m = mirrored(x, y);
                if (!m.is_floor) continue;
                const bool is_inside =
                    m.pixel.x > 2 && m.pixel.y > 2 && m.pixel.x < extent.x - 2 && m.pixel.y < extent.y - 2;
                const bool is_outside =
                    m.pixel.x < -1 || m.pixel.y < -1 || m.pixel.x > extent.x + 1 || m.pixel.y > extent.y + 1;
                const float* h = hit.pixel(x, y);
                EXPECT_FALSE(is_inside && h[3] == 0) << x << ", " << y;
                EXPECT_FALSE(is_outside && h[3] != 0) << x << ", " << y;
                if (!is_inside || h[3] == 0) continue;
                ++count;
                EXPECT_LE(distance(glm::vec2(h[0], h[1]) * glm::vec2(extent), m.pixel), slack) << x << ", " << y;
                // The hit is found up to a step too early or too late, and at the wall's foot a pixel is 0.1 m of
                // floor.
                EXPECT_NEAR(h[2], m.distance, 0.1f * m.distance + 0.1f) << x << ", " << y;
                const bool is_near_edge = std::abs(m.height - 1.0f) < 0.1f;
                const float expected = is_near_edge ? *radiance.pixel(x, y) : m.height > 1.0f ? 1.0f : 0.25f;
                EXPECT_EQ(*radiance.pixel(x, y), expected) << x << ", " << y;
                EXPECT_EQ(*confidence.pixel(x, y), 1.0f);
            }
        return count;
    }
};

// The ray meets the wall between two tested pixels, of which the march takes the first whose voxel (half a pixel to
// both sides) it reaches.
constexpr float one_step = 1.5f;

TEST_F(MirrorFloor, ReflectsTheWall) {
    render();
    EXPECT_GT(expect_true_hits(one_step), 10000u);
    EXPECT_EQ(*confidence.pixel(160, 60), 0.0f);  // the wall itself is rough and not metallic
}

TEST_F(MirrorFloor, ReflectsTheSameInReversedDepth) {
    render();
    const HostImage standard = hit;
    view.depth_direction = DepthDirection::reversed;
    render();
    EXPECT_GT(expect_true_hits(one_step), 10000u);
    size_t different = 0;
    for (size_t i = 0; i < hit.values.size(); i += 4)
        different += std::abs(hit.values[i] - standard.values[i]) > 1.0f / extent.x ||
                     hit.values[i + 3] != standard.values[i + 3];
    EXPECT_LT(different, hit.pixel_count() / 1000);  // the two depths round differently
}

TEST_F(MirrorFloor, ReflectsTheWallUnderJitter) {
    view.jitter = {0.4f, -0.3f};
    render();
    EXPECT_GT(expect_true_hits(one_step), 10000u);
}

TEST_F(MirrorFloor, RefinesLongStrides) {
    technique = make_technique("mcguire_dda", {{"dda.stride", 8}, {"dda.thickness", 10.0}});
    render();
    const auto mean_error = [&] {
        double sum = 0;
        size_t count = 0;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x)
                if (const float* h = hit.pixel(x, y); h[3] != 0) {
                    sum += distance(glm::vec2(h[0], h[1]) * glm::vec2(extent), mirrored(x, y).pixel);
                    ++count;
                }
        return sum / double(count);
    };
    const double coarse = mean_error();
    EXPECT_LT(coarse, 12.0);  // a stride and a half
    technique->params.assign({{"dda.refine", true}});
    render();
    EXPECT_LT(mean_error(), 0.5 * coarse);
}

TEST_F(MirrorFloor, StartsEveryOtherRayHalfAStrideLaterIfAsked) {
    // The camera looks level over a level floor, so that rays run along columns, those of the border too: 8, 16, 24...
    // pixels from their own are tested, of every other ray 12, 20, 28...
    technique = make_technique("mcguire_dda", {{"dda.stride", 8}, {"dda.checkerboard", true}, {"dda.thickness", 10.0}});
    render();
    unsigned count = 0;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const Mirrored m = mirrored(x, y);
            if (!m.is_floor) continue;
            ++count;
            // The first tested pixel whose voxel, half a stride to both sides, reaches the wall: no voxel of these ends
            // within half a pixel of it.
            const float first = (x + y) % 2 == 0 ? 8 : 12, to_wall = std::abs(m.pixel.y - (float(y) + 0.5f));
            const float strides = std::max(0.0f, std::ceil((to_wall - 4 - first) / 8));
            const float* h = hit.pixel(x, y);
            ASSERT_NE(h[3], 0) << x << ", " << y;
            const glm::vec2 way = glm::vec2(h[0], h[1]) * glm::vec2(extent) - (glm::vec2(x, y) + 0.5f);
            ASSERT_NEAR(way.x, 0, 0.01f) << x << ", " << y;  // rounding of float32
            ASSERT_NEAR(std::abs(way.y), first + 8 * strides, 0.01f) << x << ", " << y;
        }
    EXPECT_GT(count, 10000u);
}

TEST_F(MirrorFloor, FiltersTheColorAtTheHitIfAsked) {
    // The lit colour is its own place on the screen, so that filtering returns the hit's place and the tested pixel its
    // centre.
    scene = [this](const CameraRay& ray) {
        SyntheticHit first = mirror_floor(ray);
        const glm::vec4 clip = camera_data(pose, nullptr, view).clip_from_world * glm::vec4(ray.direction, 1.0f);
        first.lit = glm::vec3((glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(extent), 0.0f);
        return first;
    };
    const auto worst_error = [&](bool is_bilinear) {
        technique = make_technique("mcguire_dda", {{"bilinear_color", is_bilinear}});
        render();
        float worst = 0;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const glm::vec2 screen = glm::vec2(hit.pixel(x, y)[0], hit.pixel(x, y)[1]) * glm::vec2(extent);
                const glm::vec2 place = screen - view.jitter;  // on the image, whose samples are off the centres
                const glm::vec2 centre = floor(place) + 0.5f + view.jitter;
                const glm::vec2 inside = clamp(place, glm::vec2(0.5f), glm::vec2(extent) - 0.5f) + view.jitter;
                const glm::vec2 seen(radiance.pixel(x, y)[0], radiance.pixel(x, y)[1]);
                if (hit.pixel(x, y)[3] > 0) worst = std::max(worst, distance(seen, is_bilinear ? inside : centre));
            }
        return worst;
    };
    for (const glm::vec2 jitter : {glm::vec2(0), glm::vec2(0.4f, -0.3f)}) {
        view.jitter = jitter;
        EXPECT_LT(worst_error(true), 0.01f);  // filters have 8 fractional bits: 1 / 256 of a pixel to each side
        EXPECT_LT(worst_error(false), 0.001f);
    }
}

TEST_F(MirrorFloor, NeverMeetsItself) {
    // A mirror that faces the camera, tilted: nothing else is in view, so no ray may hit.
    scene = [](const CameraRay& ray) {
        const glm::vec3 normal = normalize(glm::vec3(0.5f, 0.2f, 1.0f));
        const float t = dot(glm::vec3(0, 0, -5) - ray.origin, normal) / dot(ray.direction, normal);
        return SyntheticHit{.distance = t > 0 ? t : std::numeric_limits<float>::infinity(),
                            .normal = normal,
                            .roughness = 0,
                            .metalness = 1,
                            .specular = 1};
    };
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
        view.depth_direction = direction;
        render();
        EXPECT_EQ(std::ranges::count_if(confidence.values, [](float c) { return c != 0; }), 0);
    }
}

TEST_F(MirrorFloor, TracesRaysIntoTheSurfaceUnlessToldNotTo) {
    // In the right half the geometric floor leans towards the camera so much that every mirror ray, which goes away
    // from it, is below.
    render();
    const HostImage all = hit;
    geometric_normal = HostImage(extent, 4);
    for (size_t i = 0; i < all.pixel_count(); ++i)
        geometric_normal.set_rgb(i, i % extent.x < extent.x / 2 ? glm::vec3(0, 1, 0) : normalize(glm::vec3(0, 1, 3)));
    render();
    EXPECT_EQ(hit.values, all.values);
    technique->params.assign({{"trace_inward_rays", false}});
    render();
    unsigned kept = 0, left_out = 0;
    for (size_t i = 0; i < all.pixel_count(); ++i) {
        const bool is_left = i % extent.x < extent.x / 2;
        for (size_t c = 4 * i; c < 4 * i + 4; ++c) ASSERT_EQ(hit.values[c], is_left ? all.values[c] : 0.0f) << i;
        if (all.values[4 * i + 3] != 0) ++(is_left ? kept : left_out);
    }
    EXPECT_GT(kept, 5000u);
    EXPECT_GT(left_out, 5000u);
}

TEST_F(MirrorFloor, LeavesRoughAndMatteSurfacesToTheFallback) {
    const auto hits_with = [&](float roughness, float metalness, float specular) {
        scene = [=](const CameraRay& ray) {
            SyntheticHit first = mirror_floor(ray);
            if (first.metalness > 0)
                first.roughness = roughness, first.metalness = metalness, first.specular = specular;
            return first;
        };
        render();
        return std::ranges::count_if(confidence.values, [](float c) { return c != 0; });
    };
    EXPECT_GT(hits_with(0.6f, 1, 0), 10000);
    EXPECT_GT(hits_with(0.0f, 0, 1), 10000);
    EXPECT_EQ(hits_with(0.61f, 1, 1), 0);  // max_roughness is 0.6
    EXPECT_EQ(hits_with(0.0f, 0, 0), 0);
}

TEST_F(MirrorFloor, LeavesOutNothingThatWouldHaveCounted) {
    scene = [](const CameraRay& ray) {
        SyntheticHit first = mirror_floor(ray);
        first.roughness = 0.8f;
        return first;
    };
    render();
    const HostImage all = radiance, all_confidence = confidence;
    SceneFacts facts{.has_geometry = true, .has_reflective = true, .min_roughness = 0.8f, .max_roughness = 0.8f};
    EXPECT_EQ(technique->leave_out(facts).size(), 2u);
    render();
    EXPECT_EQ(pass_list.times().size(), 1u);
    EXPECT_EQ(confidence.values, all_confidence.values);
    for (size_t i = 0; i < radiance.pixel_count(); ++i) EXPECT_EQ(radiance.rgb(i), all.rgb(i));
    facts.min_roughness = 0.6f;
    EXPECT_TRUE(technique->leave_out(facts).empty());
}

TEST_F(MirrorFloor, GivesNothingWithoutReflections) {
    technique = make_technique("none");
    const CameraData camera = camera_data(pose, nullptr, view);
    const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
    pass_list.begin_frame(camera, technique->params, gbuffer.images());
    const Reflections reflections = technique->render(pass_list, gbuffer);
    EXPECT_EQ(std::ranges::count(pass_list.download(reflections.confidence).values, 0.0f), 320 * 240);
}

}  // namespace
