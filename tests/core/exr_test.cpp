#include "core/exr/exr.h"
#include "core/error.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <random>

namespace {

std::filesystem::path temporary(const std::string& name) {
    return std::filesystem::temp_directory_path() / ("ssrlab_exr_test_" + name);
}

HostImage noise(glm::uvec2 extent, unsigned channels) {
    std::mt19937 random(7);
    HostImage image(extent, channels);
    for (float& v : image.values) v = std::generate_canonical<float, 24>(random) * 100.0f - 20.0f;
    return image;
}

}  // namespace

TEST(Exr, KeepsLayersTypesAttributesAndOddSizesExactly) {
    HostImage ids({7, 5}, 1);
    for (size_t i = 0; i < ids.values.size(); ++i) ids.values[i] = float(i * 1000);
    LayeredImage image;
    image.layers = {{.name = "", .channel_names = "RGB", .image = noise({7, 5}, 3)},
                    {.name = "normal", .channel_names = "XYZ", .image = noise({7, 5}, 3)},
                    {.name = "material_id", .channel_names = "Y", .image = ids, .type = PixelType::uint32}};
    image.attributes = {{"ssrlab.seed", "17"}};
    const auto file = temporary("layers.exr");
    write_exr(file, image);
    const LayeredImage back = read_exr(file);
    EXPECT_EQ(back.attributes.at("ssrlab.seed"), "17");
    ASSERT_EQ(back.layers.size(), 3u);
    for (const Layer& layer : image.layers) {
        const Layer* read = back.find(layer.name);
        ASSERT_NE(read, nullptr) << layer.name;
        EXPECT_EQ(read->channel_names, layer.channel_names);
        EXPECT_EQ(read->type, layer.type);
        EXPECT_EQ(read->image.values, layer.image.values);
    }
    std::filesystem::remove(file);
}

TEST(Exr, RoundsHalvesToTheNearest) {
    HostImage image({1, 1}, 3);
    image.values = {1.0f + 1.0f / 1024, 1.0f + 0.75f / 1024, 65504.0f};  // half has 10 bits after the leading one
    const auto file = temporary("half.exr");
    write_exr(file, image, PixelType::half);
    EXPECT_EQ(read_exr_rgb(file).values, (std::vector<float>{1.0f + 1.0f / 1024, 1.0f + 1.0f / 1024, 65504.0f}));
    std::filesystem::remove(file);
}

TEST(Exr, RefusesTruncatedMissingAndEmptyFiles) {
    const auto file = temporary("cut.exr");
    write_exr(file, noise({64, 64}, 3));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_THROW(read_exr(file), Error);
    std::ofstream(file, std::ios::trunc) << "no EXR";
    EXPECT_THROW(read_exr(file), Error);
    std::ofstream(file, std::ios::trunc) << "<html><title>404 Not Found</title>";
    EXPECT_NE(error_message([&] { read_exr(file); }).find("cut.exr as OpenEXR: it is an HTML page"), std::string::npos);
    std::ofstream(file, std::ios::trunc) << "#?RADIANCE";
    EXPECT_NE(error_message([&] { read_exr(file); }).find("it is a Radiance picture; convert it: oiiotool "),
              std::string::npos);
    std::filesystem::remove(file);
    EXPECT_THROW(read_exr(file), Error);
    EXPECT_THROW(write_exr(file, HostImage({0, 0}, 3)), Error);
    EXPECT_FALSE(std::filesystem::exists(file));
}
