#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace {

struct PackedGBuffer : testing::Test {
    Device device;
    Config config;

    HostGBuffer frame(GBufferFormats formats, size_t kept_bytes) {
        const Shot shot = load_shot({.scene = "rotating_mirror",
                                     .extent = {64, 36},
                                     .frames = {3, 4},
                                     .direct_lit = true,
                                     .gbuffer_formats = formats},
                                    scene_search_path({}));
        const std::unique_ptr<FrameSource> source = scene_source(device, shot, config, false);
        FrameStore store(*source, shot.config, kept_bytes);
        HostGBuffer result;
        for (const FrameStep& step : shot.steps) {
            const FrameStore::Frame frame = store.frame(step, {});
            PassList pass_list(device, shot.config.extent);
            result = download_gbuffer(pass_list, frame.gbuffer, frame.camera, shot.config.depth_format);
        }
        return result;
    }
};

/// The largest difference of a channel, over the larger of 1 and the value.
double largest_change(const HostImage& a, const HostImage& b) {
    double largest = 0;
    for (size_t i = 0; i < a.values.size(); ++i)
        largest = std::max(largest,
                           std::abs(double(a.values[i]) - b.values[i]) / std::max(1.0, std::abs(double(a.values[i]))));
    return largest;
}

}  // namespace

/// Halves have 11 bits, so that rounding changes values up to 1 by 2^-12 at most; bytes change them by half of 1/255.
/// llvmpipe rounds halves towards zero, by twice as much.
TEST_F(PackedGBuffer, DiffersByTheRoundingOfItsFormats) {
    const HostGBuffer exact = frame(GBufferFormats::exact, 0);
    for (const size_t kept_bytes : {size_t(0), size_t(1) << 28}) {
        const HostGBuffer packed = frame(GBufferFormats::packed, kept_bytes);
        EXPECT_EQ(packed.depth.values, exact.depth.values);
        EXPECT_EQ(packed.material_id.values, exact.material_id.values);
        for (const auto& [name, a, b, most] :
             {std::tuple("normal", &exact.normal, &packed.normal, 0x1p-11),
              {"previous_normal", &exact.previous_normal, &packed.previous_normal, 0x1p-11},
              {"emission", &exact.emission, &packed.emission, 0x1p-10},
              {"lit", &exact.lit, &packed.lit, 0x1p-10},
              {"motion", &exact.motion, &packed.motion, 0x1p-11},
              {"base_color", &exact.base_color, &packed.base_color, 0.51 / 255}}) {
            EXPECT_LE(largest_change(*a, *b), most) << name;
            EXPECT_GT(largest_change(*a, *b), 0) << name << ": nothing was packed";
        }
    }
}
