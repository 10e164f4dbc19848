#include "core/gpu/device.h"
#include "experiments/study/shots/result_images.h"

#include <gtest/gtest.h>

/// Of three pixels the last reflects nothing. Wherever the confidence is stored, `incident` mixes by it.
TEST(DownloadResults, ReadTheConfidenceFromItsChannel) {
    Device device;
    const glm::uvec2 extent(3, 1);
    PassList pass_list(device, extent);
    const auto uploaded = [&](const char* name, Format format, unsigned channels, std::vector<float> values) {
        HostImage image(extent, channels);
        image.values = std::move(values);
        const Image target = pass_list.image(name, format);
        pass_list.upload(target, image);
        return target;
    };
    GBuffer gbuffer;
    gbuffer.fallback = uploaded("fallback", Format::rgba32f, 4, {8, 16, 32, 1, 8, 16, 32, 1, 8, 16, 32, 1});
    const Image radiance = uploaded("radiance", Format::rgba32f, 4, {1, 2, 4, 0.25f, 1, 2, 4, 1, 1, 2, 4, 0.5f});
    const Image alone = uploaded("alone", Format::r32f, 1, {0.25f, 1, 0.5f});
    const Composite composite{
        .specular = uploaded("specular", Format::rgba32f, 4, {1, 2, 3, 9, 4, 5, 6, 9, 0, 0, 0, 9}), .image = {}};
    HostImage reflectance(extent, 3, 0.5f);
    reflectance.set_rgb(2, glm::vec3(0));
    for (const Reflections& reflections : {Reflections{radiance, alone, 0}, Reflections{radiance, radiance, 3}}) {
        const CompositedImages found = download_results(pass_list, gbuffer, reflections, composite, reflectance);
        EXPECT_EQ(found.confidence.values, (std::vector<float>{0.25f, 1, 0.5f}));
        EXPECT_EQ(found.incident.values, (std::vector<float>{6.25f, 12.5f, 25, 1, 2, 4, 0, 0, 0}));
        EXPECT_EQ(found.specular.values, (std::vector<float>{1, 2, 3, 4, 5, 6, 0, 0, 0}));
    }
}
