#include "core/gpu/pipelines/shader.h"
#include "tests/variants/technique_fixture.h"
#include "tests/variants/tracer_bench.h"

// What holds of every tracer.

namespace {

/// Those that know of a scene what the first layer of its G-buffer shows.
std::vector<std::string> screen_tracers() {
    std::vector<std::string> names;
    for (const TracerEntry& entry : tracer_table())
        if (!entry.exact_hits) names.push_back(entry.name);
    return names;
}

/// Parameters for closed forms: steps that are short enough, of tracers that may step over things by default; and one
/// layer of depth.
nlohmann::json fine_steps(const std::string& tracer) {
    if (tracer == "view_space") return {{"view_space.steps", 8192}};             // 5 mm
    if (tracer == "frostbite_linear") return {{"frostbite.linear_steps", 512}};  // single pixels
    if (tracer == "secant") return {{"secant.linear_steps", 4096}};              // no more than pixels
    if (tracer == "exact_layer") return {{"exact_layer.thickness_from", "parameter"}};
    return nlohmann::json::object();
}

/// A floor before a back wall that ends below the horizon, with a wall on the right and a ball: surfaces that face the
/// camera, that lean and that are round. Above the back wall there is nothing.
SyntheticHit room(const CameraRay& ray) {
    SyntheticHit nearest;
    const auto plane = [&](glm::vec3 point, glm::vec3 normal, auto&& exists) {
        const float t = glm::dot(point - ray.origin, normal) / glm::dot(ray.direction, normal);
        if (t > 1e-3f && t < nearest.distance && exists(ray.origin + t * ray.direction))
            nearest = {.distance = t, .normal = normal};
    };
    const float back = -6, top = -0.1f, right = 2;
    plane({0, -1, 0}, {0, 1, 0}, [&](glm::vec3 p) { return p.z > back && p.x < right; });
    plane({0, 0, back}, {0, 0, 1}, [&](glm::vec3 p) { return p.y > -1 && p.y < top && p.x < right; });
    plane({right, 0, 0}, {-1, 0, 0}, [&](glm::vec3 p) { return p.y > -1 && p.y < top && p.z > back; });
    const glm::vec3 center(-0.7f, -0.4f, -4.2f), to_center = center - ray.origin;
    const float radius = 0.6f, along = glm::dot(to_center, ray.direction);
    const float half_chord = std::sqrt(radius * radius - glm::dot(to_center, to_center) + along * along);
    if (const float t = along - half_chord; t > 1e-3f && t < nearest.distance)  // not if it is no number
        nearest = {.distance = t, .normal = (ray.origin + t * ray.direction - center) / radius};
    return nearest;
}

struct TracersInRoom : TechniqueTest {
    TracerBench bench{device(), {160, 120}};

    /// By an angle (rad), from half a metre above the origin.
    void look_down(float angle) {
        const float c = std::cos(angle), s = std::sin(angle);
        bench.pose.world_from_view = glm::mat4(1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0.5f, 0, 1);
    }
    void SetUp() override { look_down(0.3f); }

    glm::vec3 world(glm::vec3 vs_position) const {
        return glm::vec3(bench.pose.world_from_view * glm::vec4(vs_position, 1));
    }
    glm::vec3 world_direction(glm::vec3 vs_direction) const {
        return glm::mat3(bench.pose.world_from_view) * vs_direction;
    }
    glm::vec3 view_of(glm::vec3 ws_position) const {
        return glm::vec3(bench.camera.view_from_world * glm::vec4(ws_position, 1));
    }
    glm::vec3 view_direction_of(glm::vec3 ws_direction) const {
        return glm::mat3(bench.camera.view_from_world) * ws_direction;
    }

    /// What the camera sees at a place of the screen (pixels): point and normal, world space.
    std::pair<glm::vec3, glm::vec3> seen(glm::vec2 screen) const {
        const CameraRay from_eye = camera_ray(bench.pose, bench.view.extent, screen);
        const SyntheticHit visible = room(from_eye);
        const float distance = std::min(visible.distance, 1e4f);  // the sky
        return {from_eye.origin + distance * from_eye.direction, visible.normal};
    }

    /// Whether a point (world space) is in front of all that is seen there and a pixel around it.
    bool is_in_view(glm::vec3 point) const {
        const glm::vec3 vs_point = view_of(point);
        for (const glm::vec2 beside : {glm::vec2(0, 0), {1, 1}, {-1, 1}, {1, -1}, {-1, -1}})
            if (vs_point.z < view_of(seen(bench.screen(vs_point) + beside).first).z) return false;
        return true;
    }

    struct Expected {
        glm::vec2 position;  ///< un-jittered screen (pixels)
        float distance;      ///< m
        float pixels;        ///< how far off a march over samples may end
        float meters;        ///< the same along the ray
    };

    /// The closed form, if nothing about it hangs on less than a pixel: the point and what is around it are in view,
    /// and so is the ray on its whole way.
    std::optional<Expected> expected(const BenchRay& ray) const {
        const glm::vec3 vs_origin = bench.position(ray.pixel), vs_direction = glm::normalize(ray.direction);
        const CameraRay traced{world(vs_origin), world_direction(vs_direction)};
        const SyntheticHit hit = room(traced);
        if (std::isinf(hit.distance) || dot(traced.direction, hit.normal) > -0.3f) return std::nullopt;

        const glm::vec3 point = traced.origin + hit.distance * traced.direction;
        const glm::vec2 place = bench.screen(view_of(point)), extent(bench.view.extent);
        const float margin = 9;  // 8 %: hits in the outermost 5 % lose confidence in `hierarchy`
        if (any(lessThan(place, glm::vec2(margin))) || any(greaterThan(place, extent - margin))) return std::nullopt;
        for (const glm::vec2 beside : {glm::vec2(0, 0), {3, 0}, {-3, 0}, {0, 3}, {0, -3}}) {
            const auto [there, normal] = seen(place + beside);
            if (distance(there, point) > 1 || dot(normal, hit.normal) < 0.9f) return std::nullopt;
        }
        if (distance(seen(place).first, point) > 1e-2f) return std::nullopt;
        const float length = distance(place, bench.screen(vs_origin));
        if (length < 8) return std::nullopt;
        for (float share = 0.1f; share < 0.97f; share += 0.01f)  // the last part is where it comes to the surface
            if (!is_in_view(traced.origin + share * hit.distance * traced.direction)) return std::nullopt;

        // Depth is sampled at pixel centres, up to half a pixel off on both axes. A ray meets a sample that is so much
        // farther or nearer as many pixels later or sooner as it takes to come closer by that. One pixel more, since
        // some name the centre of the pixel, and marches with refinements stop at one.
        const auto device_depth = [&](glm::vec3 ws_position) {
            const glm::vec4 clip = bench.camera.clip_from_world * glm::vec4(ws_position, 1);
            return clip.z / clip.w;
        };
        const float d = 0.5f;
        const glm::vec2 slope(
            (device_depth(seen(place + glm::vec2(d, 0)).first) - device_depth(seen(place - glm::vec2(d, 0)).first)) /
                (2 * d),
            (device_depth(seen(place + glm::vec2(0, d)).first) - device_depth(seen(place - glm::vec2(0, d)).first)) /
                (2 * d));
        const glm::vec3 before = traced.origin + (hit.distance - 0.02f) * traced.direction;
        const glm::vec2 way = place - bench.screen(view_of(before));
        const float pixels = glm::length(way);
        const float closing = std::abs(device_depth(point) - device_depth(before) - dot(slope, way)) / pixels;
        const float tolerance = 1.5f + 0.5f * (std::abs(slope.x) + std::abs(slope.y)) / closing;
        if (!(tolerance < 4)) return std::nullopt;  // the ball's rim
        return Expected{place, hit.distance, tolerance, 1.2f * tolerance * 0.02f / pixels + 1e-3f * hit.distance};
    }

    std::vector<BenchRay> rays_from_floor() const {
        std::vector<BenchRay> rays;
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(-1, 1);
        for (unsigned y = 1; y < bench.view.extent.y; y += 2)
            for (unsigned x = 1; x < bench.view.extent.x; x += 2) {
                const glm::vec3 normal = bench.normal.rgb(size_t(y) * bench.view.extent.x + x);
                if (normal.y < 0.99f) continue;
                const glm::vec3 to_point = bench.pose.is_orthographic ? glm::vec3(0, 0, -1) : bench.position({x, y});
                const glm::vec3 mirrored = reflect(glm::normalize(world_direction(to_point)), glm::vec3(0, 1, 0));
                const glm::vec3 other =
                    glm::normalize(mirrored + 0.5f * glm::vec3(uniform(random), 0.7f, uniform(random)));
                rays.push_back({{x, y}, view_direction_of(mirrored)});
                rays.push_back({{x, y}, view_direction_of(other)});
            }
        return rays;
    }

    void expect_closed_forms() {
        bench.show(room);
        std::vector<BenchRay> rays;
        std::vector<Expected> truth;
        for (const BenchRay& ray : rays_from_floor())
            if (const auto expectation = expected(ray)) {
                rays.push_back(ray);
                truth.push_back(*expectation);
            }
        ASSERT_GT(rays.size(), 100u);
        for (const std::string& tracer : screen_tracers()) {
            const std::vector<BenchEnd> ends = bench.trace(tracer, rays, fine_steps(tracer));
            // A wall that rounding has put into the pixel before; frostbite_linear looks at the end of a step, a pixel
            // long here, and says where on it the ray was deep enough.
            const float slack = tracer == "frostbite_linear" ? 1.01f : 0.01f;
            unsigned wrong = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                const BenchEnd& end = ends[i];
                const glm::vec2 in_pixel = end.position - glm::vec2(bench.camera.jitter) - glm::vec2(end.pixel);
                const bool is_right = end.is_hit() && end.confidence > 0 && end.confidence <= 1 &&
                                      distance(end.position, truth[i].position) <= truth[i].pixels &&
                                      std::abs(end.distance - truth[i].distance) <= truth[i].meters &&
                                      all(greaterThan(in_pixel, glm::vec2(-slack))) &&
                                      all(lessThan(in_pixel, glm::vec2(1 + slack)));
                wrong += !is_right;
                if (!is_right && wrong <= 3)
                    ADD_FAILURE() << tracer << ", from " << rays[i].pixel.x << ", " << rays[i].pixel.y << ": " << end
                                  << "; truth " << truth[i].position.x << ", " << truth[i].position.y << ", "
                                  << truth[i].distance << " m, within " << truth[i].pixels << " pixels, "
                                  << truth[i].meters << " m";
            }
            EXPECT_EQ(wrong, 0u) << tracer << ", of " << rays.size();
        }
    }
};

TEST_F(TracersInRoom, FindWhatRaysMeet) { expect_closed_forms(); }

TEST_F(TracersInRoom, FindWhatRaysMeetWithReversedDepthAndJitter) {
    bench.view.depth_direction = DepthDirection::reversed;
    bench.view.jitter = {0.3f, -0.4f};
    expect_closed_forms();
}

TEST_F(TracersInRoom, FindWhatRaysMeetInOrthographicViews) {
    bench.pose.is_orthographic = true;
    bench.pose.orthographic_height = 5;
    bench.pose.world_from_view[3] = glm::vec4(0, 0.5f, 0, 1);
    expect_closed_forms();
}

TEST_F(TracersInRoom, FindWhatRaysMeetOnOddSizes) {
    bench.view.extent = {155, 109};  // odd on three levels and on two
    bench.view.depth_direction = DepthDirection::reversed;
    expect_closed_forms();
}

// --- Misses ---

/// How a ray ends that meets nothing, and whose whole way is in view; no jitter.
std::optional<unsigned> way_to_miss(const TracersInRoom& test, const BenchRay& ray) {
    const TracerBench& bench = test.bench;
    const glm::vec3 vs_origin = bench.position(ray.pixel), vs_direction = glm::normalize(ray.direction);
    const CameraRay traced{test.world(vs_origin), test.world_direction(vs_direction)};
    if (!std::isinf(room(traced).distance)) return std::nullopt;
    const glm::vec2 start = bench.screen(vs_origin), extent(bench.view.extent);
    for (float way = 1e-3f; way < 2000; way *= 1.03f) {
        const glm::vec3 vs_point = vs_origin + way * vs_direction;
        const glm::vec2 place = bench.screen(vs_point);
        if (vs_point.z > -bench.pose.near) {
            // Near the border of the screen, rounding decides which of both it comes to.
            const glm::vec2 from_border = min(place, extent - place);
            return std::min(from_border.x, from_border.y) > 3 ? std::optional(outcome_behind_camera) : std::nullopt;
        }
        if (any(lessThan(place, glm::vec2(0))) || any(greaterThan(place, extent))) return outcome_off_screen;
        const float pixels = distance(start, place);
        if (pixels > 4 && !test.is_in_view(test.world(vs_point))) return std::nullopt;
        // Nearer, its own surface is too close for that: it must be in front of the pixels that it crosses, by more
        // than rounding.
        const glm::vec2 sample = floor(place) + 0.5f;
        if (sample != start && vs_point.z < 0.999f * test.view_of(test.seen(sample).first).z) return std::nullopt;
    }
    return outcome_background;
}

/// In all directions from all surfaces. What leaves the screen, comes to the near plane or goes on to where nothing is
/// drawn says so.
TEST_F(TracersInRoom, SayHowRaysMiss) {
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
        bench.view.depth_direction = direction;
        look_down(0.1f);  // so that there is sky above the wall
        bench.show(room);
        std::vector<BenchRay> rays;
        std::vector<unsigned> truth;
        std::map<unsigned, unsigned> counts;
        std::mt19937 random(2);
        std::uniform_real_distribution<float> uniform(-1, 1);
        for (unsigned i = 0; i < 40000; ++i) {
            const glm::uvec2 pixel(random() % bench.view.extent.x, random() % bench.view.extent.y);
            if (*bench.depth.pixel(pixel.x, pixel.y) == bench.camera.depth.z) continue;
            glm::vec3 to(uniform(random), uniform(random), uniform(random));
            if (i % 3 == 0) to = glm::vec3(0.3f, 0.2f, 1.0f) * to - bench.position(pixel);   // to the camera
            if (i % 3 == 1) to = view_direction_of({0.3f * to.x, 0.3f + 0.05f * to.y, -1});  // to the sky
            const BenchRay ray{pixel, to};
            if (dot(world_direction(to), bench.normal.rgb(size_t(pixel.y) * bench.view.extent.x + pixel.x)) <
                0.1f * length(to))
                continue;
            if (const auto outcome = way_to_miss(*this, ray); outcome && ++counts[*outcome] <= 200) {
                rays.push_back(ray);
                truth.push_back(*outcome);
            }
        }
        for (const unsigned outcome : {outcome_off_screen, outcome_behind_camera, outcome_background})
            EXPECT_GE(counts[outcome], 50u) << outcome;
        for (const std::string& tracer : screen_tracers()) {
            // hierarchy goes on behind the near plane, and says no more than that it did not finish in the sky;
            // view_space ends after 40 m.
            const auto is_right = [&](unsigned outcome, unsigned expected) {
                if (outcome == expected) return true;
                if (tracer == "hierarchy")
                    return expected == outcome_behind_camera ? outcome == outcome_off_screen
                                                             : outcome == outcome_unfinished;
                return tracer == "view_space" && expected == outcome_background && outcome == outcome_unfinished;
            };
            const std::vector<BenchEnd> ends = bench.trace(tracer, rays, fine_steps(tracer));
            unsigned wrong = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                EXPECT_TRUE(ends[i].is_hit() || ends[i].confidence == 0) << tracer;
                EXPECT_GE(ends[i].distance, 0) << tracer;
                if (!is_right(ends[i].outcome, truth[i]) && ++wrong <= 3)
                    ADD_FAILURE() << tracer << ": " << ends[i] << ", expected " << truth[i];
            }
            EXPECT_EQ(wrong, 0u) << tracer << ", of " << rays.size();
        }
    }
}

/// A floor alone, from above and from a low angle: its mirror rays meet nothing, and least of all the floor.
TEST_F(TracersInRoom, MissTheirOwnPlane) {
    for (const float height : {0.5f, 0.05f})
        for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
            bench.view.depth_direction = direction;
            bench.view.jitter = {0.2f, 0.4f};
            bench.pose.world_from_view[3].y = height;
            // Leaning a little, so that the floor's rows are not the image's.
            bench.pose.world_from_view = bench.pose.world_from_view * glm::mat4(0.995f, 0.0998f, 0, 0, -0.0998f, 0.995f,
                                                                                0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
            bench.show([](const CameraRay& ray) -> SyntheticHit {
                const float t = -ray.origin.y / ray.direction.y;
                return t > 0 && t < 90 ? SyntheticHit{.distance = t, .normal = {0, 1, 0}} : SyntheticHit{};
            });
            std::vector<BenchRay> rays;
            for (unsigned y = 0; y < bench.view.extent.y; y += 2)
                for (unsigned x = 0; x < bench.view.extent.x; x += 7) {
                    if (*bench.depth.pixel(x, y) == bench.camera.depth.z) continue;
                    const glm::vec3 towards = glm::normalize(world_direction(bench.position({x, y})));
                    rays.push_back({{x, y}, view_direction_of(reflect(towards, glm::vec3(0, 1, 0)))});
                }
            ASSERT_GT(rays.size(), 500u);
            for (const std::string& tracer : screen_tracers()) {
                unsigned hits = 0;
                for (const BenchEnd& end : bench.trace(tracer, rays, fine_steps(tracer))) hits += end.is_hit();
                EXPECT_EQ(hits, 0u) << tracer << ", from a height of " << height << " m";
            }
        }
}

// --- Where they run ---

/// DiligentFX's technique, which WebGL 2 is to run with each of them.
TEST(TracersInWebgl2, CompileAsGlslEs) {
    for (const TracerEntry& entry : tracer_table()) {
        if (!entry.fits_webgl2) continue;
        const auto technique = make_technique("diligent_ssr", {{"tracer", entry.name}});
        EXPECT_NO_THROW(compile("diligent_ssr/intersection.frag", "",
                                shader_prelude(technique->params, ShaderLanguage::webgl2), technique->shader_includes(),
                                ShaderLanguage::webgl2))
            << entry.name;
    }
}

}  // namespace

/// Fragments come in quads: at borders of odd sizes GPUs run shaders for pixels beyond them, too.
TEST_F(TracersInRoom, EndBeyondTheScreen) {
    bench.view.extent = {67, 45};
    bench.show(room);
    std::vector<BenchRay> rays;
    for (const glm::uvec2 beyond : {glm::uvec2(67, 20), {30, 45}, {67, 45}})
        for (const glm::vec3 direction :
             {glm::vec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, 1, -1}, {-1, -1, 1}})
            rays.push_back({beyond, direction});
    for (const std::string& tracer : screen_tracers())
        for (const BenchEnd& end : bench.trace(tracer, rays, fine_steps(tracer)))
            EXPECT_LT(end.fetches, 10000u) << tracer;
}

/// Of a screen of 67 x 45 level 1 has 33 x 22 cells, level 2 16 x 11, level 3 8 x 5.
TEST_F(TracersInRoom, LevelsExistDownToTheFinest) {
    struct Case {
        glm::ivec2 pixel;
        int level, existing;
    };
    const std::vector<Case> cases{{{0, 0}, 3, 3},  {{63, 39}, 3, 3}, {{64, 0}, 3, 1},  {{0, 44}, 3, 0},
                                  {{66, 0}, 3, 0}, {{67, 20}, 3, 0}, {{30, 45}, 2, 0}, {{67, 45}, 0, 0}};
    bench.view.extent = {67, 45};
    bench.show(room);
    const ParameterSet no_parameters;
    PassList pass_list(device(), bench.view.extent);
    HostImage asked({unsigned(cases.size()), 1}, 4);
    for (unsigned i = 0; i < cases.size(); ++i)
        for (int c = 0; c < 3; ++c) asked.pixel(i, 0)[c] = float(c < 2 ? cases[i].pixel[c] : cases[i].level);
    const Image input = pass_list.image_of("asked", Format::rgba32f, asked.extent),
                output = pass_list.image_of("existing", Format::r32f, asked.extent);
    pass_list.upload(input, asked);
    pass_list.begin_frame(bench.camera, no_parameters, {});
    pass_list.compute("existing_levels.comp").read(input).write(output).run();
    const HostImage found = pass_list.download(output);
    for (unsigned i = 0; i < cases.size(); ++i)
        EXPECT_EQ(found.values[i], float(cases[i].existing)) << cases[i].pixel.x << ", " << cases[i].pixel.y;
}
