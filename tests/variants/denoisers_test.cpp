// Any denoiser behind any march: with a technique's own draw and march its denoiser has that technique's bits; all stay
// finite, keep constant light constant, and say which stages they have.
#include "variants/denoisers/denoisers.h"
#include "core/error.h"
#include "tests/variants/amd_scenes.h"
#include "tests/variants/mirror_scenes.h"
#include "tests/variants/rough_floor.h"
#include "tests/variants/technique_fixture.h"
#include "tests/variants/technique_passes.h"

#include <optional>
#include <set>

namespace {

glm::vec4 rgba(const HostImage& image, size_t i) {
    return {image.values[4 * i], image.values[4 * i + 1], image.values[4 * i + 2], image.values[4 * i + 3]};
}

/// A glossy floor before a wall whose light no two pixels have in common, and which half of the rays miss.
SyntheticHit floor_before_waves(const CameraRay& ray) {
    SyntheticHit hit = mirror_floor(ray);
    const glm::vec3 p = ray.origin + hit.distance * ray.direction;
    if (hit.metalness > 0)
        hit.roughness = 0.3f;
    else if (p.x > 0)
        return {};
    else
        hit.lit = glm::vec3(1.0f + std::sin(3 * p.x + 2 * p.y), 1.0f + std::sin(5 * p.y), 1.0f);
    return hit;
}

/// What is compared here: a mean of rays of every pixel, whose misses are not known, but for what is `given`.
nlohmann::json plain(const nlohmann::json& given) {
    return changed({{"denoiser", "mean"},
                    {"tracer", "cells"},
                    {"dda.thickness", 0.1},
                    {"dda.relative_thickness", 0.0},
                    {"misses", "weight"},
                    {"half_resolution", false},
                    {"importance_bias", 0.3}},
                   given);
}

struct DenoisersTest : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};

    /// Channels: radiance, confidence.
    struct Frames {
        std::vector<HostImage> images;
        std::vector<std::string> stages;  ///< of the last frame
    };

    /// `step`: of the camera from frame to frame. `fallback`: what misses see, everywhere; none: another value in each
    /// pixel. `tilt`: of geometric normals to shading ones.
    Frames render(Technique& technique, const SyntheticScene& scene, glm::uvec2 extent, unsigned count = 1,
                  glm::vec3 step = glm::vec3(0), std::optional<float> fallback = std::nullopt,
                  glm::vec3 tilt = glm::vec3(0)) {
        PassList pass_list(device(), extent);
        Frames frames;
        CameraPose before = pose;
        HostImage previous_depth, previous_normal;
        for (unsigned frame = 0; frame < count; ++frame) {
            CameraPose now = pose;
            now.world_from_view[3] += glm::vec4(float(frame) * step, 0.0f);
            const CameraData camera =
                camera_data(now, frame > 0 ? &before : nullptr, {.extent = extent, .frame = frame});
            GBuffer gbuffer = upload_gbuffer(pass_list, now, camera, scene);
            pass_list.upload(gbuffer.motion, motion_of(now, camera, scene));
            HostImage fallbacks(extent, 4, fallback.value_or(0)), flat = pass_list.download(gbuffer.geometric_normal);
            for (size_t i = 0; i < fallbacks.pixel_count(); ++i) {
                if (!fallback) fallbacks.set_rgb(i, glm::vec3(0.1f * float(i % 7)));
                if (flat.rgb(i) != glm::vec3(0)) flat.set_rgb(i, glm::normalize(flat.rgb(i) + tilt));
            }
            pass_list.upload(gbuffer.fallback, fallbacks);
            pass_list.upload(gbuffer.geometric_normal, flat);
            // Of the frame before, in images of their own.
            const auto keep = [&](Image& input, const char* name, const Image& current, HostImage& kept) {
                const HostImage pixels = pass_list.download(current);
                input = pass_list.image(std::string("kept_") + name, current.format).as(name);
                pass_list.upload(input, kept.pixel_count() > 0 ? kept : pixels);
                kept = pixels;
            };
            keep(gbuffer.previous_depth, "previous_depth", gbuffer.depth, previous_depth);
            keep(gbuffer.previous_normal, "previous_normal", gbuffer.normal, previous_normal);
            pass_list.begin_frame(camera, technique.params, gbuffer.images());
            const Reflections reflections = technique.render(pass_list, gbuffer);
            const HostImage radiance = pass_list.download(reflections.radiance),
                            confidence = download_confidence(pass_list, reflections);
            HostImage image(extent, 4);
            for (size_t i = 0; i < image.pixel_count(); ++i) {
                for (size_t c = 0; c < 3; ++c) image.values[4 * i + c] = radiance.values[radiance.channels * i + c];
                image.values[4 * i + 3] = confidence.values[i];
            }
            frames.images.push_back(image);
            frames.stages.clear();
            for (const PassTime& time : pass_list.times()) frames.stages.push_back(time.stage);
            before = now;
        }
        return frames;
    }

    void expect_equal(const nlohmann::json& composed, const std::string& technique, const nlohmann::json& parameters,
                      const SyntheticScene& scene, glm::vec3 tilt = glm::vec3(0)) {
        const auto parts = make_technique("composed_ssr", plain(composed)),
                   whole = make_technique(technique, parameters);
        const glm::uvec2 extent(67, 45);
        const glm::vec3 step(0.02f, 0.01f, -0.03f);
        const Frames of_parts = render(*parts, scene, extent, 4, step, {}, tilt),
                     of_whole = render(*whole, scene, extent, 4, step, {}, tilt);
        for (size_t frame = 0; frame < 4; ++frame) {
            size_t reflecting = 0, different = 0;
            for (size_t i = 0; i < of_whole.images[frame].pixel_count(); ++i) {
                const glm::vec4 a = rgba(of_parts.images[frame], i), b = rgba(of_whole.images[frame], i);
                reflecting += b.a > 0;
                different += a != b;
            }
            EXPECT_GT(reflecting, 300u);
            EXPECT_EQ(different, 0u) << "frame " << frame;
        }
    }
};

/// Frostbite's pixels whose rays are not decided by tiles, all marched by one tracer.
TEST_F(DenoisersTest, FrostbitesReuseHasTheBitsOfItsTechnique) {
    for (const bool half : {false, true}) {
        const nlohmann::json draw = {{"half_resolution", half},  {"lobe", "normals"},     {"importance_bias", 0.5},
                                     {"max_rays", half ? 1 : 2}, {"max_roughness", 0.35}, {"tracer", "dda"}};
        expect_equal(
            changed(draw, {{"denoiser", "frostbite_reuse"}, {"frostbite_reuse.clamp_scale", 1.5}}), "frostbite_sssr",
            changed(
                draw,
                {{"classification", false}, {"rough_tracer", "dda"}, {"previous_frame", false}, {"clamp_scale", 1.5}}),
            glossy_floor);
    }
}

TEST_F(DenoisersTest, MeanAndBlurOfMirrorRaysHaveTheBitsOfTheSimpleTechnique) {
    const nlohmann::json draw = {{"draw_directions", false}, {"tracer", "cells"}, {"max_roughness", 0.35}};
    const nlohmann::json march = {{"cells.relative_thickness", 0.01}, {"cells.thickness", 0.0}};
    const nlohmann::json simple = changed(march, {{"draw", "mirror"}, {"tracer", "cells"}, {"max_roughness", 0.35}});
    expect_equal(draw, "simple_ssr", simple, glossy_floor);
    expect_equal(changed(draw, {{"denoiser", "blur"}, {"blur.blur_width", 0.2}}), "simple_ssr",
                 changed(simple, {{"blur_width", 0.2}}), glossy_floor);
}

/// The denoiser behind rays of the mirror's direction, which are drawn alike in both, and show the pixel's fallback
/// where they miss.
TEST_F(DenoisersTest, AmdsDenoiserHasTheBitsOfItsTechnique) {
    const nlohmann::json march = {{"tracer", "dda"}, {"draw_directions", false}};
    expect_equal(
        changed(march, {{"denoiser", "amd_denoiser"}, {"max_roughness", 0.35}, {"amd_denoiser.float_histories", true}}),
        "amd_sssr",
        changed(march, {{"samples_per_quad", 4},
                        {"misses", "weight"},
                        {"far_misses", true},
                        {"inward_rays", "black"},
                        {"rate_stored_roughness", true},
                        {"float_roughness", true},
                        {"float_histories", true},
                        {"roughness_threshold_alpha", std::nextafter(0.35f * 0.35f, 1.0f)}}),
        floor_before_waves, {0, 0, 0.4f});
}

TEST_F(DenoisersTest, MeanIsThatOfTheLobe) {
    const glm::uvec2 extent(64, 48);
    for (const char* lobe : {"normals", "visible_normals"}) {
        SCOPED_TRACE(lobe);
        const RoughFloor floor{.roughness = 0.7f, .pose = pose, .extent = extent};
        const RoughFloor::Mean expected = floor.of_lobe();
        const auto technique = make_technique(
            "composed_ssr",
            plain(changed(RoughFloor::march(),
                          {{"lobe", lobe}, {"max_rays", 4}, {"importance_bias", 0.0}, {"max_roughness", 1}})));
        const Frames frames = render(*technique, floor.scene(), extent, 60);
        const RoughFloor::Mean mean = floor.mean([&](unsigned frame) { return frames.images[frame]; }, 60);
        // Five standard errors: one false alarm in a million. A ratio of four rays is biased by about a quarter of the
        // covariance of its sums over their means; cells of quadrature and edges of pixels: 1 %.
        EXPECT_NEAR(mean.shown, expected.shown, 5 * mean.error + 0.05 * expected.shown);
        EXPECT_NEAR(mean.confidence, expected.confidence, 5 * mean.confidence_error + 0.05);
    }
}

TEST_F(DenoisersTest, AreBelievable) {
    for (const DenoiserEntry& entry : denoiser_table())
        for (const glm::uvec2 extent : {glm::uvec2(67, 45), glm::uvec2(1, 1)}) {
            SCOPED_TRACE(entry.name + ", " + std::to_string(extent.x));
            const auto technique = make_technique(
                "composed_ssr", {{"denoiser", entry.name}, {"misses", entry.takes_probe ? "probe" : "fallback"}});
            const Frames frames = render(*technique, glossy_floor, extent, 3, {0.02f, 0.01f, -0.03f});
            for (const HostImage& image : frames.images) {
                size_t bad = 0;
                for (size_t i = 0; i < image.pixel_count(); ++i) {
                    const glm::vec4 p = rgba(image, i);
                    for (int c = 0; c < 3; ++c) bad += !(std::isfinite(p[c]) && p[c] >= 0);
                    bad += !(p.a >= 0 && p.a <= 1);
                }
                EXPECT_EQ(bad, 0u);
            }
        }
}

/// All that rays may see is one, and so is the fallback of those that see nothing.
TEST_F(DenoisersTest, KeepConstantLightConstant) {
    const SyntheticScene white = [](const CameraRay& ray) {
        SyntheticHit hit = glossy_floor(ray);
        hit.lit = glm::vec3(1);
        return hit;
    };
    for (const DenoiserEntry& entry : denoiser_table()) {
        SCOPED_TRACE(entry.name);
        // With its preset, if it has one: the original of AMD's denoiser also averages what was never written.
        const bool has_preset =
            std::ranges::count(find_technique("composed_ssr").presets, entry.name, &Preset::name) > 0;
        const auto technique = make_technique(
            "composed_ssr", plain({{"cells.edge_fade", true}, {"denoiser", entry.name}}), has_preset ? entry.name : "");
        const Frames frames = render(*technique, white, {67, 45}, 4, {0.02f, 0.01f, -0.03f}, 1.0f);
        // Its weights are densities, not divided by their sum: one holds in the mean over pixels only.
        const bool is_normalized = entry.name != "reservoirs";
        for (const HostImage& image : frames.images) {
            size_t known = 0;
            double sum = 0;
            for (size_t i = 0; i < image.pixel_count(); ++i) {
                const glm::vec4 p = rgba(image, i);
                if (p.a < 0.01f) continue;
                ++known;
                sum += p.r;
                // Halves of AMD's and DiligentFX's histories: 2^-11 in each of three filters and four frames.
                for (int c = 0; c < 3 && is_normalized; ++c) ASSERT_NEAR(p[c], 1, 0.006) << i << ", confidence " << p.a;
            }
            EXPECT_NEAR(sum / double(known), 1, is_normalized ? 0.002 : 0.05);
            EXPECT_GT(known, 300u);
        }
    }
}

/// `needs` and reports name work that is left out by these.
TEST_F(DenoisersTest, SayWhichStagesTheyHave) {
    for (const DenoiserEntry& entry : denoiser_table()) {
        SCOPED_TRACE(entry.name);
        const auto technique = make_technique("composed_ssr", plain({{"denoiser", entry.name}, {"tracer", "dda"}}));
        std::vector<std::string> said = {"composed_ssr/trace"}, run;
        ParameterSet params;
        add_block(params, "denoisers/rays.json");
        params.assign({{"misses", "weight"}});
        Denoisers denoisers(params, entry.name);
        for (const std::string& stage : denoisers.chosen().stages()) said.push_back(stage);
        for (const char* constant : {"scene_is_still", "scene_has_matte", "scene_has_environment"})
            for (const std::string& stage : denoisers.chosen().readers_of(constant))
                EXPECT_TRUE(std::ranges::count(said, stage)) << stage;
        for (const std::string& stage : render(*technique, glossy_floor, {67, 45}).stages)
            if (stage != "clear") run.push_back(stage);
        EXPECT_EQ(run, said);
    }
}

TEST_F(DenoisersTest, TakeTheProbeOrRefuseIt) {
    for (const DenoiserEntry& entry : denoiser_table()) {
        SCOPED_TRACE(entry.name);
        const auto technique = make_technique("composed_ssr", plain({{"denoiser", entry.name}, {"misses", "probe"}}));
        if (entry.takes_probe) {
            const std::vector<std::string> stages = render(*technique, glossy_floor, {16, 16}).stages;
            for (const std::string& stage : screen_probe_stages())
                EXPECT_TRUE(std::ranges::count(stages, stage)) << stage;
            continue;
        }
        try {
            render(*technique, glossy_floor, {16, 16});
            ADD_FAILURE() << "was run";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("take fallback or weight"), std::string::npos) << error.what();
        }
    }
}

TEST_F(DenoisersTest, RefuseRaysWithoutTheDensitiesThatTheyNeed) {
    size_t refused = 0;
    for (const DenoiserEntry& entry : denoiser_table()) {
        const auto technique =
            make_technique("composed_ssr", plain({{"denoiser", entry.name}, {"draw_directions", false}}));
        if (!entry.needs_density) {
            EXPECT_NO_THROW(render(*technique, glossy_floor, {16, 16}));
            continue;
        }
        ++refused;
        try {
            render(*technique, glossy_floor, {16, 16});
            ADD_FAILURE() << entry.name << " was run";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("draw_directions must be true"), std::string::npos)
                << error.what();
        }
    }
    EXPECT_GE(refused, 2u);
}

TEST_F(DenoisersTest, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (const DenoiserEntry& entry : denoiser_table()) EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_THROW(find_denoiser("recurent_blur"), Error);
    try {
        find_denoiser("recurent_blur");
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("recurrent_blur"), std::string::npos) << error.what();
    }
}

}  // namespace
