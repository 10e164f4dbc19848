// What writers of shaders are told of the G-buffer's images is what the rasteriser draws.
#include "core/gbuffer/gbuffer_images.h"
#include "core/gbuffer/gbuffer_formats.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>

TEST(gbuffer_images, have_the_formats_in_which_they_are_drawn) {
    const Scene scene = dielectric_scene();
    const FrameView view = view_of({16, 9});
    for (const GBufferFormats formats : {GBufferFormats::exact, GBufferFormats::packed}) {
        Rasterizer rasterizer(test_device(), scene, {.extent = view.extent, .has_depth_layers = true});
        rasterizer.pass_list().set_changes(gbuffer_changes(formats));
        const GBuffer g = rasterizer.render(scene.camera("main"), view);
        for (const GBufferImage& image : gbuffer_images()) {
            EXPECT_EQ((g.*image.image).name, image.name);
            EXPECT_EQ((g.*image.image).format, formats == GBufferFormats::exact ? image.exact : image.packed)
                << image.name;
        }
    }
}

TEST(gbuffer_images, hold_the_stated_values_where_there_is_no_surface) {
    Scene scene = dielectric_scene();
    scene.instances.clear();
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
        const FrameView view = view_of({16, 9}, 1, direction);
        Rasterizer rasterizer(test_device(), scene, {.extent = view.extent, .has_depth_layers = true});
        const GBuffer g = rasterizer.render(scene.camera("main"), view);
        const float far_depth = direction == DepthDirection::reversed ? 0.0f : 1.0f;
        for (const GBufferImage& image : gbuffer_images()) {
            const std::string stated = image.background;
            if (stated.starts_with("motion") || stated.starts_with("the ")) continue;  // other tests compare these
            const HostImage pixels = rasterizer.pass_list().download(g.*image.image);
            if (pixels.extent != view.extent) continue;  // one texel of `dielectric_f0`
            const bool is_depth = stated == "`camera.depth.z`", has_roughness = stated == "0; roughness 1";
            ASSERT_TRUE(is_depth || has_roughness || stated == "0") << stated;
            for (size_t i = 0; i < pixels.values.size(); ++i)
                ASSERT_EQ(pixels.values[i], is_depth                      ? far_depth
                                            : has_roughness && i % 4 == 3 ? 1.0f
                                                                          : 0.0f)
                    << image.name;
        }
    }
}
