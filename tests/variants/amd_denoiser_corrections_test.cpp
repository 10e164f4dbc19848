#include "tests/variants/denoiser_scene.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <limits>

// What each correction of the denoiser fixes, with the correction off and on, in both forms.

namespace {

/// In the faithful form, which compiles faster; amd_denoiser_forms_test.cpp holds the fast one to it.
struct AmdDenoiserCorrections : TechniqueTest {};

nlohmann::json with(const char* correction, bool is_on, const char* form = "faithful") {
    return {{"denoiser_form", form}, {"barrier_before_average", true}, {correction, is_on}};
}

void resolve(AmdDenoiserBench& bench) {
    amd_resolve_temporal(bench.pass_list, bench.work, bench.histories, bench.denoiser);
}
void reproject(AmdDenoiserBench& bench) {
    amd_reproject(bench.pass_list, bench.gbuffer, bench.work, bench.histories, bench.denoiser);
}
void denoise(AmdDenoiserBench& bench) {
    amd_denoise(bench.pass_list, bench.gbuffer, bench.work, bench.histories, bench.denoiser);
}

/// Fills what the temporal resolve reads: a checkered signal around its average, and history.
void fill_resolve_inputs(AmdDenoiserBench& bench, float history, float samples_before, float samples_now) {
    const AmdHistories& h = bench.histories;
    HostImage pixels(bench.pass_list.extent(), 4);
    for (unsigned y = 0; y < pixels.extent.y; ++y)
        for (unsigned x = 0; x < pixels.extent.x; ++x) pixels.pixel(x, y)[0] = checkered(x, y).x;
    for (size_t i = 0; i < pixels.pixel_count(); ++i) pixels.set_rgb(i, glm::vec3(pixels.values[4 * i]));
    bench.upload(h.radiance.previous, pixels);
    bench.fill(h.variance.previous, glm::vec4(0.1f));
    bench.fill(bench.reprojected(), glm::vec4(history));
    bench.fill(h.sample_count.previous, glm::vec4(samples_before));
    bench.fill(h.sample_count.current, glm::vec4(samples_now));
    for (const Image& average : {h.average_radiance.previous, h.average_radiance.current})
        bench.fill(average, glm::vec4(0.5f));
}

/// The red value at the centre of an image.
float at_center(AmdDenoiserBench& bench, const Image& image) {
    return bench.pass_list.download(image).pixel(image.extent.x / 2, image.extent.y / 2)[0];
}

constexpr float half_error = 1e-3f;  // of values up to 1, truncated to halves a few times over

}  // namespace

/// A pixel of 0.75 with history 0.6 of four frames: between its colour pulled to the average of 0.5 by a fifth (0.7),
/// and history by three quarters. One without history becomes the average.
TEST_F(AmdDenoiserCorrections, CurrentSampleCount) {
    for (const bool is_on : {false, true}) {
        const DenoiserInputs inputs = facing_wall({.color = checkered});
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("current_sample_count", is_on));
        bench.begin_frame(inputs, nullptr);
        fill_resolve_inputs(bench, 0.6f, 0.0f, 4.0f);
        resolve(bench);
        EXPECT_NEAR(at_center(bench, bench.histories.radiance.current), is_on ? 0.25 * 0.7 + 0.75 * 0.6 : 0.5,
                    half_error);
    }
}

/// A dark pixel among bright ones keeps its history, or is black at once.
TEST_F(AmdDenoiserCorrections, NoDarkExit) {
    for (const bool is_on : {false, true}) {
        const DenoiserInputs inputs = facing_wall({.color = checkered});
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("no_dark_exit", is_on));
        bench.begin_frame(inputs, nullptr);
        fill_resolve_inputs(bench, 0.6f, 4.0f, 4.0f);
        HostImage pixels = bench.pass_list.download(bench.histories.radiance.previous);
        pixels.set_rgb(32 * 64 + 32, glm::vec3(1e-5f));
        bench.upload(bench.histories.radiance.previous, pixels);
        resolve(bench);
        const float found = at_center(bench, bench.histories.radiance.current);
        if (is_on) {
            EXPECT_GT(found, 0.4f);
        } else {
            EXPECT_EQ(found, 0.0f);
        }
    }
}

/// History of the same colour and of eight frames with variance 0.5: a running mean keeps seven eighths of it.
TEST_F(AmdDenoiserCorrections, RunningVariance) {
    for (const bool is_on : {false, true}) {
        const DenoiserInputs inputs = facing_wall({});
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("running_variance", is_on));
        bench.begin_frame(inputs, &inputs);
        bench.upload(bench.histories.radiance.previous, inputs.radiance);
        bench.fill(bench.histories.variance.previous, glm::vec4(0.5f));
        bench.fill(bench.histories.sample_count.previous, glm::vec4(7.0f));
        reproject(bench);
        EXPECT_NEAR(at_center(bench, bench.histories.variance.current), is_on ? 0.5 * 7 / 8 : 0.5 / 8, half_error);
    }
}

/// Averages that rise by 1/16 from tile to tile, in an image 11.5 tiles wide; a pixel without history takes them over.
TEST_F(AmdDenoiserCorrections, RoundUpTiles) {
    for (const bool is_on : {false, true}) {
        const DenoiserInputs inputs = facing_wall({.extent = {92, 64}, .color = checkered});
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("round_up_tiles", is_on));
        bench.begin_frame(inputs, nullptr);
        fill_resolve_inputs(bench, 0.0f, 0.0f, 0.0f);
        HostImage averages({12, 8}, 3);
        for (size_t i = 0; i < averages.pixel_count(); ++i) averages.set_rgb(i, glm::vec3(float(i % 12 + 1) / 16));
        bench.upload(bench.histories.average_radiance.current, averages);
        resolve(bench);
        const HostImage found = bench.pass_list.download(bench.histories.radiance.current);
        for (const unsigned x : {20u, 44u, 68u}) {
            const double right = (x + 0.5) / 8, wrong = (x + 0.5) / (92 + 8) * 12;  // tiles
            EXPECT_NEAR(found.pixel(x, 32)[0], ((is_on ? right : wrong) + 0.5) / 16, half_error) << x;
        }
    }
}

/// A slanted neighbourhood filters alike whether lengths are metres or tenths of them.
TEST_F(AmdDenoiserCorrections, RelativeDepthWeight) {
    for (const bool is_on : {false, true}) {
        float found[2];
        for (const float scale : {1.0f, 0.1f}) {
            DenoiserInputs inputs = facing_wall({.color = checkered});
            CameraPose pose;
            pose.near = 0.1f * scale;
            pose.far = 100.0f * scale;
            inputs.camera = camera_data(pose, nullptr, {.extent = {64, 64}});
            for (unsigned y = 0; y < 64; ++y)
                for (unsigned x = 0; x < 64; ++x) {
                    const float distance = scale * (2 + 0.05f * float(x));
                    const glm::vec4 clip = inputs.camera.clip_from_view * glm::vec4(0, 0, -distance, 1);
                    *inputs.depth.pixel(x, y) = clip.z / clip.w;
                }
            AmdDenoiserBench bench(device(), inputs.depth.extent, with("relative_depth_weight", is_on));
            bench.begin_frame(inputs, nullptr);
            bench.fill(bench.histories.variance.current, glm::vec4(1.0f));
            bench.fill(bench.histories.average_radiance.current, glm::vec4(0.5f));
            amd_prefilter(bench.pass_list, bench.work, bench.histories, bench.denoiser);
            found[scale < 1] = at_center(bench, bench.histories.radiance.previous);
        }
        if (is_on) {
            EXPECT_NEAR(found[0], found[1], half_error);
        } else {
            EXPECT_GT(std::abs(found[0] - found[1]), 5 * half_error);
        }
    }
}

/// A camera that comes nearer by a fifth in one frame: the wall is still the same.
TEST_F(AmdDenoiserCorrections, ReprojectHistoryDepth) {
    for (const bool is_on : {false, true}) {
        const DenoiserInputs before = facing_wall({.distance = 4, .distance_before = 4, .color = checkered});
        const DenoiserInputs now = facing_wall({.distance = 3.2f, .distance_before = 4, .color = checkered});
        AmdDenoiserBench bench(device(), now.depth.extent, with("reproject_history_depth", is_on));
        bench.begin_frame(now, &before);
        bench.fill(bench.histories.radiance.previous, glm::vec4(0.5f));
        bench.fill(bench.histories.sample_count.previous, glm::vec4(7.0f));
        reproject(bench);
        const float samples = at_center(bench, bench.histories.sample_count.current);
        if (is_on) {
            EXPECT_GT(samples, 7.5f);
        } else {
            EXPECT_EQ(samples, 1.0f);
        }
    }
}

/// A near plane that moves from 0.5 to 0.1 m: what depth was stored for the wall changes, the wall does not.
TEST_F(AmdDenoiserCorrections, ReprojectHistoryDepthKnowsTheLastProjection) {
    for (const bool is_on : {false, true}) {
        const DenoiserInputs first = facing_wall({.color = checkered});
        DenoiserInputs now = first, before = first;
        CameraPose pose;
        pose.world_from_view[3].z = 4;
        CameraPose pose_before = pose;
        pose_before.near = 0.5f;
        now.camera = camera_data(pose, &pose_before, {.extent = {64, 64}, .frame = 1});
        const glm::vec4 clip = clip_from_view(pose_before, 1, DepthDirection::standard) * glm::vec4(0, 0, -4, 1);
        before.depth = HostImage({64, 64}, 1, clip.z / clip.w);
        AmdDenoiserBench bench(device(), now.depth.extent, with("reproject_history_depth", is_on));
        bench.begin_frame(now, &before);
        bench.fill(bench.histories.radiance.previous, glm::vec4(0.5f));
        bench.fill(bench.histories.sample_count.previous, glm::vec4(7.0f));
        reproject(bench);
        EXPECT_NEAR(at_center(bench, bench.histories.sample_count.current), is_on ? 8 : 1, 0.01f);  // halves
    }
}

/// One infinite ray blackens its pixel and the 15 that filter it in, or at most its own.
TEST_F(AmdDenoiserCorrections, FiniteNeighborhood) {
    for (const bool is_on : {false, true}) {
        DenoiserInputs inputs = facing_wall({.color = checkered});
        inputs.radiance.set_rgb(32 * 64 + 32, glm::vec3(std::numeric_limits<float>::infinity()));
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("finite_neighborhood", is_on));
        bench.begin_frame(inputs, nullptr);
        denoise(bench);
        const HostImage found = bench.pass_list.download(bench.histories.radiance.current);
        unsigned black = 0;
        for (size_t i = 0; i < found.pixel_count(); ++i) {
            ASSERT_TRUE(std::isfinite(found.rgb(i).x));
            black += found.rgb(i).x == 0.0f;
        }
        if (is_on) {
            EXPECT_LE(black, 1u);
        } else {
            EXPECT_EQ(black, 16u);
        }
    }
}

/// A million is to the temporal resolve what the largest half is, in either form; so is what has no square in a float.
TEST_F(AmdDenoiserCorrections, FiniteNeighborhoodTakesNothingForMoreThanTheLargestHalf) {
    const DenoiserInputs inputs = facing_wall({.color = checkered});
    for (const char* form : {"faithful", "fast"}) {
        nlohmann::json parameters = with("finite_neighborhood", true, form);
        parameters["float_histories"] = true;
        AmdDenoiserBench bench(device(), inputs.depth.extent, parameters);
        HostImage found[3];
        for (int i = 0; i < 3; ++i) {
            const float brightest[] = {65504, 1e6f, 1e30f};
            bench.begin_frame(inputs, nullptr);
            fill_resolve_inputs(bench, 0.6f, 4.0f, 4.0f);
            HostImage pixels = bench.pass_list.download(bench.histories.radiance.previous);
            pixels.set_rgb(32 * 64 + 32, glm::vec3(brightest[i]));
            bench.upload(bench.histories.radiance.previous, pixels);
            resolve(bench);
            found[i] = bench.pass_list.download(bench.histories.radiance.current);
        }
        EXPECT_GT(found[0].pixel(34, 32)[0], 0.1f);
        for (int i = 1; i < 3; ++i) EXPECT_TRUE(found[i].values == found[0].values) << form;
    }
}

/// Nor does a tile's average.
TEST_F(AmdDenoiserCorrections, FiniteNeighborhoodClampsAverages) {
    for (const char* form : {"faithful", "fast"}) {
        nlohmann::json parameters = with("finite_neighborhood", true, form);
        parameters["float_histories"] = true;
        HostImage found[2];
        for (int i = 0; i < 2; ++i) {
            DenoiserInputs inputs = facing_wall({.color = checkered});
            inputs.radiance.set_rgb(32 * 64 + 32, glm::vec3(i == 0 ? 65504.0f : 1e9f));
            AmdDenoiserBench bench(device(), inputs.depth.extent, parameters);
            bench.begin_frame(inputs, nullptr);
            reproject(bench);
            found[i] = bench.pass_list.download(bench.histories.average_radiance.current);
        }
        EXPECT_GT(found[0].pixel(4, 4)[0], 1.0f);
        EXPECT_TRUE(found[1].values == found[0].values) << form;
    }
}

/// Whatever tiles that are not listed hold from earlier frames: listed ones next to them come out the same.
TEST_F(AmdDenoiserCorrections, FreshNeighborhood) {
    for (const bool is_on : {false, true}) {
        HostImage found[2];
        for (const float stale : {0.0f, 8.0f}) {
            DenoiserInputs inputs = facing_wall({.color = checkered});
            for (unsigned y = 0; y < 64; ++y)
                for (unsigned x = 32; x < 64; ++x)
                    *inputs.roughness.pixel(x, y) = 0.5f, *inputs.tiles.pixel(x / 8, y / 8) = 0;
            AmdDenoiserBench bench(device(), inputs.depth.extent, with("fresh_neighborhood", is_on));
            bench.begin_frame(inputs, nullptr);
            const AmdHistories& h = bench.histories;
            for (const Image& image : {h.radiance.previous, h.variance.current, h.average_radiance.current})
                bench.fill(image, glm::vec4(stale));
            denoise(bench);
            found[stale > 0] = bench.pass_list.download(h.radiance.current);
        }
        double greatest = 0;
        for (unsigned y = 0; y < 64; ++y)
            for (unsigned x = 0; x < 32; ++x)
                greatest = std::max(greatest, double(std::abs(found[0].pixel(x, y)[0] - found[1].pixel(x, y)[0])));
        if (is_on) {
            EXPECT_EQ(greatest, 0.0);
        } else {
            EXPECT_GT(greatest, 0.01);
        }
    }
}

/// A steady colour, accumulated: in halves that truncate each frame takes up to a 2^-11 off, in floats nothing.
TEST_F(AmdDenoiserCorrections, FloatHistories) {
    const float color = 0.3f;  // no half
    const DenoiserInputs inputs = facing_wall({.color = [&](unsigned, unsigned) { return glm::vec3(color); }});
    double error[2];
    for (const bool is_on : {false, true}) {
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("float_histories", is_on, "fast"));
        for (unsigned frame = 0; frame < 16; ++frame) {
            bench.begin_frame(inputs, &inputs);
            denoise(bench);
        }
        error[is_on] = std::abs(at_center(bench, bench.histories.radiance.current) - color);
    }
    EXPECT_LT(error[1], 0.5 * error[0]);
}

/// A variance of 1e-9 is 0 among halves, and a pixel without variance is not filtered: the checkered wall stays as it
/// is.
TEST_F(AmdDenoiserCorrections, FloatHistoriesFilterWhatHalvesTakeForNothing) {
    for (const bool is_on : {false, true}) {
        const DenoiserInputs inputs = facing_wall({.color = checkered});
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("float_histories", is_on, "fast"));
        bench.begin_frame(inputs, nullptr);
        bench.fill(bench.histories.variance.current, glm::vec4(1e-9f));
        bench.fill(bench.histories.average_radiance.current, glm::vec4(0.5f));
        amd_prefilter(bench.pass_list, bench.work, bench.histories, bench.denoiser);
        const float change = std::abs(at_center(bench, bench.histories.radiance.previous) -
                                      at_center(bench, bench.histories.radiance.current));
        if (is_on) {
            EXPECT_GT(change, 0.05f);
        } else {
            EXPECT_EQ(change, 0);
        }
    }
}

/// The averages of the frame before the first are black.
TEST_F(AmdDenoiserCorrections, WithoutStaleAverage) {
    for (const bool is_stale : {true, false}) {
        const DenoiserInputs inputs = facing_wall({});
        AmdDenoiserBench bench(device(), inputs.depth.extent, with("stale_average", is_stale));
        bench.begin_frame(inputs, nullptr);
        denoise(bench);
        EXPECT_NEAR(at_center(bench, bench.histories.radiance.current), is_stale ? 0.0 : 0.5, 0.01);
    }
}
