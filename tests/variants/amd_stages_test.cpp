// Stages of AMD's technique switched off one by one, and what its march reads.
#include "tests/variants/amd_golden.h"
#include "tests/variants/denoiser_scene.h"
#include "tests/variants/mirror_scenes.h"
#include "tests/variants/technique_fixture.h"
#include "variants/tracers/outcome.h"

#include <cmath>

namespace {

struct AmdStages : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    FrameView view{.extent = {96, 120}};
    HostImage noise{{128, 128}, 2, 0.9f};

    HostGBuffer floor_of(float roughness) {
        HostGBuffer gbuffer = host_gbuffer(device(), pose, view, [=](const CameraRay& ray) {
            SyntheticHit hit = floor_before_white(ray);
            if (hit.metalness > 0) hit.roughness = roughness;
            return hit;
        });
        gbuffer.fallback = HostImage(gbuffer.extent(), 4, 0.5f);
        return gbuffer;
    }
    AmdTraced trace(const HostGBuffer& gbuffer, nlohmann::json parameters, RayProbe* probe = nullptr) {
        parameters["hierarchy.min_traversal_occupancy"] = 0;
        parameters["samples_per_quad"] = 4;
        return amd_trace_frame(device(), gbuffer, parameters, noise, probe);
    }
};

TEST_F(AmdStages, RaysThatAreNotDrawnAreTheMirrors) {
    const HostImage mirror = trace(floor_of(0), {{"guard_mirror_normal", true}}).radiance;
    const HostGBuffer rough = floor_of(0.4f);
    EXPECT_EQ(trace(rough, {{"draw_directions", false}}).radiance.values, mirror.values);
    EXPECT_NE(trace(rough, {{"draw_directions", true}}).radiance.values, mirror.values);
}

TEST_F(AmdStages, RaysThatAreNotMarchedSeeTheEnvironment) {
    const HostGBuffer gbuffer = floor_of(0.2f);
    const HostImage found = trace(gbuffer, {{"hierarchy.march", "none"}}).radiance;
    unsigned rays = 0;
    for (size_t i = 0; i < found.pixel_count(); ++i) {
        if (gbuffer.base_color.values[4 * i + 3] == 0) continue;
        ++rays;
        EXPECT_EQ(found.rgb(i), glm::vec3(0.5f));
        EXPECT_NEAR(found.values[4 * i + 3], 0, 1e-4f);  // m; positions are rounded
    }
    EXPECT_GT(rays, 1000u);
}

/// Three steps are used up by all rays here, which read a texel in each. Another is the origin's; the few that end with
/// the last step read one more, by which their end is judged.
TEST_F(AmdStages, CountsWhatEachRayReads) {
    const HostGBuffer gbuffer = floor_of(0.2f);
    nlohmann::json parameters = {{"hierarchy.max_traversal_intersections", 3}, {"hierarchy.reject_unfinished", true}};
    RayProbe probe;
    probe.is_recording = true;
    const AmdTraced found = trace(gbuffer, parameters, &probe);
    EXPECT_EQ(found.radiance.values, trace(gbuffer, parameters).radiance.values);
    ASSERT_EQ(probe.recorded.size(), 1u);
    EXPECT_EQ(probe.recorded[0].stage, "amd_sssr/intersect");
    ASSERT_EQ(probe.recorded[0].rays.size(), found.radiance.pixel_count());
    size_t judged = 0;
    for (size_t i = 0; i < found.radiance.pixel_count(); ++i) {
        const RayRecord& ray = probe.recorded[0].rays[i];
        const bool is_traced = gbuffer.base_color.values[4 * i + 3] > 0;
        EXPECT_EQ(ray.is_traced, is_traced);
        // Of places off the screen and next to the origin none is.
        const bool is_judged = is_traced && ray.outcome != outcome_unfinished && ray.outcome != outcome_own_surface &&
                               ray.outcome != outcome_off_screen;
        judged += is_judged;
        EXPECT_EQ(ray.fetches, !is_traced ? 0u : is_judged ? 1u + 3u + 1u : 1u + 3u);
    }
    EXPECT_LT(judged, found.radiance.pixel_count() / 50);
    parameters["hierarchy.max_traversal_intersections"] = 128;
    probe.recorded.clear();
    trace(gbuffer, parameters, &probe);
    double least = 0, most = 0;  // steps per pixel, if each ray's end was judged and if none was
    for (const RayRecord& ray : probe.recorded.at(0).rays)
        if (ray.is_traced > 0) least += ray.fetches - 2, most += ray.fetches - 1;
    EXPECT_GT(least, 3.0 * double(found.radiance.pixel_count()));
    EXPECT_LT(most, 64.0 * double(found.radiance.pixel_count()));
}

/// What each pass of the denoiser leaves when it is off, after frames in which it had history to work with. Both forms
/// share the lines that leave it.
TEST_F(AmdStages, OfTheDenoiserLeaveWhatTheyWereGiven) {
    const DenoiserInputs inputs = facing_wall({.color = checkered});
    const auto run = [&](const char* stage) {
        nlohmann::json parameters = {{"float_histories", true}};
        if (*stage) parameters[stage] = false;
        struct Passes {
            HostImage samples, traced, prefiltered, resolved;
        };
        AmdDenoiserBench bench(device(), inputs.depth.extent, parameters);
        Passes passes;
        for (unsigned frame = 0; frame < 3; ++frame) {
            DenoiserInputs now = inputs;
            now.camera.frame.w = frame > 0;
            bench.begin_frame(now, &inputs);
            const AmdHistories& h = bench.histories;
            amd_reproject(bench.pass_list, bench.gbuffer, bench.work, h, bench.denoiser);
            passes.samples = bench.pass_list.download(h.sample_count.current);
            passes.traced = bench.pass_list.download(h.radiance.current);
            amd_prefilter(bench.pass_list, bench.work, h, bench.denoiser);
            passes.prefiltered = bench.pass_list.download(h.radiance.previous);
            amd_resolve_temporal(bench.pass_list, bench.work, h, bench.denoiser);
            passes.resolved = bench.pass_list.download(h.radiance.current);
        }
        return passes;
    };
    const auto samples_of = [](const HostImage& image) { return *image.pixel(32, 32); };
    const auto same_colors = [](const HostImage& a, const HostImage& b) {
        for (size_t i = 0; i < a.pixel_count(); ++i)
            if (a.rgb(i) != b.rgb(i)) return false;
        return true;
    };
    const auto all = run("");
    EXPECT_GT(samples_of(all.samples), 2);
    EXPECT_FALSE(same_colors(all.prefiltered, all.traced));
    EXPECT_FALSE(same_colors(all.resolved, all.prefiltered));
    EXPECT_EQ(samples_of(run("reprojection").samples), 1);
    const auto unfiltered = run("prefilter");
    EXPECT_TRUE(same_colors(unfiltered.prefiltered, unfiltered.traced));
    const auto unresolved = run("temporal_resolve");
    EXPECT_TRUE(same_colors(unresolved.resolved, unresolved.prefiltered));
}

}  // namespace
