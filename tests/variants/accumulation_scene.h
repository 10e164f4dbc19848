#pragma once
#include "core/scene/camera.h"
#include "tests/variants/accumulation_bench.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <functional>

/// What DiligentFX's temporal accumulation sees in its tests. Histories of the variance are ramps, so that the variance
/// that a pixel takes over shows where it was taken from.
namespace accumulation_scene {

using Overrides = nlohmann::json;

constexpr glm::uvec2 extent{48, 32};
constexpr float surface_distance = 5, point_distance = 10;  // m
constexpr glm::uvec2 middle{24, 16};

inline HostImage image_of(unsigned channels, const std::function<glm::vec4(unsigned x, unsigned y)>& value) {
    HostImage image(extent, channels);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (unsigned c = 0; c < channels; ++c) image.pixel(x, y)[c] = value(x, y)[int(c)];
    return image;
}

inline float device_depth(const CameraData& camera, float distance) {
    const glm::vec4 clip = camera.clip_from_view * glm::vec4(0, 0, -distance, 1);
    return clip.z / clip.w;
}

inline float ramp(float position, unsigned size) { return position / float(size); }
inline float ramp_x(float x) { return ramp(x, extent.x); }

/// Both candidates are the pixel itself, before a surface that fills the screen; a grey image without noise.
struct StillScene {
    CameraPose pose, before;
    FrameView view{.extent = extent, .frame = 1};
    AccumulationInputs inputs;

    StillScene() { update(); }

    void update() {
        inputs.camera = camera_data(pose, &before, view);
        inputs.motion = HostImage(extent, 2);
        inputs.previous_depth = inputs.reprojected_depth =
            HostImage(extent, 1, device_depth(inputs.camera, surface_distance));
        inputs.hit_depth = HostImage(extent, 1, device_depth(inputs.camera, point_distance));
        inputs.mask = HostImage(extent, 1, 1.0f);
        inputs.resolved = {.radiance = HostImage(extent, 4, 0.5f), .variance = HostImage(extent, 1, 0.25f)};
        inputs.history = inputs.resolved;
    }

    /// Previous depth by distance (m).
    void was_at(const std::function<float(unsigned x, unsigned y)>& distance) {
        inputs.previous_depth =
            image_of(1, [&](unsigned x, unsigned y) { return glm::vec4(device_depth(inputs.camera, distance(x, y))); });
    }
};

struct DiligentAccumulation : TechniqueTest {
    StillScene scene;

    Filtered run(Overrides overrides) {
        overrides.emplace("float_histories", true);
        return AccumulationBench(device(), extent, overrides).accumulate(scene.inputs);
    }

    /// Where each pixel takes its history from, x and y; NaN: it has none.
    HostImage positions_before(Overrides overrides) {
        overrides["temporal_variance_stability_factor"] = 1.0;
        HostImage found(extent, 2);
        for (unsigned axis : {0u, 1u}) {
            scene.inputs.history.variance = image_of(1, [&](unsigned x, unsigned y) {
                return glm::vec4(ramp(float(axis == 0 ? x : y) + 0.5f, 2 * extent[axis]));
            });
            const HostImage variance = run(overrides).variance;
            for (size_t i = 0; i < variance.pixel_count(); ++i)
                found.values[2 * i + axis] =
                    variance.values[i] == 1 ? NAN : variance.values[i] * float(2 * extent[axis]);
        }
        return found;
    }
    glm::vec2 position_before(const Overrides& overrides, glm::uvec2 pixel) {
        const HostImage found = positions_before(overrides);
        return {found.pixel(pixel.x, pixel.y)[0], found.pixel(pixel.x, pixel.y)[1]};
    }

    void expect_position(const Overrides& overrides, glm::uvec2 pixel, glm::vec2 expected, float tolerance = 1e-3f) {
        const glm::vec2 found = position_before(overrides, pixel);
        EXPECT_NEAR(found.x, expected.x, tolerance) << overrides;
        EXPECT_NEAR(found.y, expected.y, tolerance) << overrides;
    }
};

inline glm::vec2 centre(glm::uvec2 pixel) { return glm::vec2(pixel) + 0.5f; }

/// Float32 of colours up to 1, a handful of operations.
constexpr float rounding = 1e-6f;

}  // namespace accumulation_scene
