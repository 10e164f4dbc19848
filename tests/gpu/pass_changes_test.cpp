#include "core/gpu/passes/pass_list.h"

#include "core/gpu/device.h"

#include <Imath/half.h>
#include <gtest/gtest.h>
#include <cmath>

namespace {

struct PassChangesTest : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    ParameterSet no_parameters;
    CameraData camera{};
    PassList pass_list{device(), {64, 1}};

    void SetUp() override { pass_list.begin_frame(camera, no_parameters, {}); }
    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }

    Image stored(const std::string& name, Format format, glm::vec4 value) {
        const Image image = pass_list.image(name, format);
        pass_list.compute("store_value.comp").write(image.as("target")).set("value", value).run();
        return image;
    }
};

}  // namespace

/// The known error of known values: 1 + 2^-12 is 1 in half, 0.3 lies between two halves. Vulkan leaves it to the device
/// whether it rounds or, as lavapipe, cuts off.
TEST_F(PassChangesTest, ImagesAreMadeInTheFormatsThatThePolicyNames) {
    pass_list.set_changes({.format_of = [](const std::string& image,
                                           Format asked) { return image == "kept" ? asked : as_float16(asked); },
                           .glsl_of = {}});
    const glm::vec4 value(1.0f + 1.0f / 4096.0f, 0.3f, 1e5f, 1e-8f);
    const Image kept = stored("kept", Format::rgba32f, value), rounded = stored("rounded", Format::rgba32f, value);
    EXPECT_EQ(kept.format, Format::rgba32f);
    EXPECT_EQ(rounded.format, Format::rgba16f);
    const HostImage a = pass_list.download(kept), b = pass_list.download(rounded);
    EXPECT_EQ(std::vector(a.values.begin(), a.values.begin() + 4), (std::vector{value.x, value.y, value.z, value.w}));
    EXPECT_EQ(b.values[0], 1.0f);
    const float nearest = half(0.3f), below = nearest - std::exp2(-12.0f);  // halves are 2^-12 apart there
    EXPECT_TRUE(b.values[1] == nearest || b.values[1] == below) << b.values[1];
    EXPECT_GE(b.values[2], 65504.0f);  // devices store the largest half, or infinity
    EXPECT_EQ(b.values[3], 0.0f);

    pass_list.set_changes({});
    EXPECT_EQ(pass_list.image("rounded", Format::rgba32f).format, Format::rgba32f);
}

TEST_F(PassChangesTest, HistoriesHaveOneNameAndTwoSides) {
    std::vector<std::string> asked;
    pass_list.set_changes({.format_of =
                               [&](const std::string& image, Format format) {
                                   asked.push_back(image);
                                   return as_float32(format);
                               },
                           .glsl_of = {}});
    const PassList::History history = pass_list.history("kept", Format::r8);
    EXPECT_EQ(asked, (std::vector<std::string>{"kept", "kept"}));
    EXPECT_EQ(history.previous.format, Format::r32f);
    EXPECT_EQ(pass_list.asked_name(history.previous), "kept");
    EXPECT_EQ(pass_list.asked_name(pass_list.image("other", Format::r8).as("kept")), "other");
    EXPECT_EQ(pass_list.asked_name(Image{}), "");
}

TEST_F(PassChangesTest, EveryFormatHasItsNameAndItsKin) {
    for (const Format format : {Format::r8, Format::rg8, Format::rgba8, Format::r16f, Format::rg16f, Format::rgba16f,
                                Format::r32f, Format::rg32f, Format::rgba32f, Format::r11g11b10f}) {
        const std::string name = name_of(format), wide = name_of(as_float32(format)),
                          narrow = name_of(as_float16(format));
        const std::string channels =
            format == Format::r11g11b10f ? "rgba" : name.substr(0, name.find_first_of("0123456789"));
        EXPECT_EQ(wide, channels + "32f") << name;
        EXPECT_EQ(narrow, channels + "16f") << name;
    }
    for (const Format format : {Format::r32ui, Format::d32f, Format::d24, Format::d16, Format::d32f_s8})
        EXPECT_TRUE(as_float32(format) == format && as_float16(format) == format) << name_of(format);
}

TEST(PassChanges, DeclaredFormatsFollowTheImages) {
    const std::string shader =
        "layout(r32f) uniform coherent image2D kept, other;\nlayout(rgba32f) uniform writeonly image2D third;\n";
    EXPECT_EQ(with_image_formats(shader, {{"other", Format::r16f}}),
              "layout(r16f) uniform coherent image2D kept, other;\nlayout(rgba32f) uniform writeonly image2D third;\n");
    EXPECT_EQ(with_image_formats(shader, {{"image2D_", Format::r16f}}), shader);
}
