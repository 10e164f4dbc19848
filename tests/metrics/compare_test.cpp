#include "metrics/compare.h"
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/png.h"
#include "tests/error_message.h"
#include "tests/png_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <random>
#include <sstream>

namespace {

/// A folder of its own for each test, removed afterwards.
class Compare : public testing::Test {
protected:
    void SetUp() override {
        folder = std::filesystem::temp_directory_path() / "compare";
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path exr(const std::string& name, const HostImage& image) const {
        write_exr(folder / name, image);
        return folder / name;
    }
    std::filesystem::path folder;
};

HostImage noise(glm::uvec2 extent, unsigned seed) {
    std::minstd_rand random(seed);
    HostImage image(extent, 3);
    for (float& v : image.values) v = std::generate_canonical<float, 24>(random);
    return image;
}

std::string message(const CompareOptions& options) {
    return error_message([&] { compare(options); });
}

double value(const Comparison& comparison, const std::string& name) {
    for (const CompareResult& r : comparison.results)
        if (r.metric->name == name) return r.value;
    return NAN;
}

}  // namespace

TEST_F(Compare, PrintsOneNumberPerLineThatReadsBack) {
    const auto a = exr("a.exr", noise({20, 20}, 1)), b = exr("b.exr", noise({20, 20}, 2));
    const Comparison c = compare({.reference = a, .test = b, .metrics = {"mse", "flip"}});
    std::ostringstream out, warnings;
    print(c, out, warnings);
    std::istringstream in(out.str());
    std::string first, second;
    double mse, flip;
    in >> first >> mse >> second >> flip;
    EXPECT_EQ(first + second, "mseflip");
    EXPECT_EQ(mse, value(c, "mse"));
    EXPECT_EQ(flip, value(c, "flip"));
    EXPECT_EQ(warnings.str(), "");
    EXPECT_NEAR(mse, measure(metric_named("mse"), image_pair(noise({20, 20}, 1), noise({20, 20}, 2), {})), 0);
}

TEST_F(Compare, DefaultsFitTheImages) {
    const auto small = exr("small.exr", noise({9, 9}, 1)), large = exr("large.exr", noise({180, 180}, 1));
    const Comparison of_small = compare({.reference = small, .test = small}),
                     of_large = compare({.reference = large, .test = large});
    EXPECT_TRUE(std::isnan(value(of_small, "ssim")));
    EXPECT_EQ(value(of_small, "hdr_flip"), 0);
    EXPECT_NEAR(value(of_large, "ssim"), 1, 1e-12);
    EXPECT_TRUE(to_json(of_large)["metrics"].size() > 10);
    EXPECT_EQ(to_json(of_large)["metrics"][8]["value"], "inf");  // PSNR
}

TEST_F(Compare, PngCodesAreDecodedForLinearMetricsOnly) {
    write_png(folder / "a.png", HostImage({16, 16}, 3, 0.2f));
    write_png(folder / "b.png", HostImage({16, 16}, 3, 0.6f));
    const double a = std::lround(255 * srgb_from_linear(0.2f)) / 255.0,
                 b = std::lround(255 * srgb_from_linear(0.6f)) / 255.0;
    const Comparison c =
        compare({.reference = folder / "a.png", .test = folder / "b.png", .metrics = {"bias", "psnr"}});
    EXPECT_NEAR(value(c, "bias"), linear_from_srgb(float(b)) - linear_from_srgb(float(a)), 1e-6);  // float32 codes
    EXPECT_NEAR(value(c, "psnr"), -20 * std::log10(b - a), 1e-5);
}

/// The colours that a PNG holds, whatever lies beside or between them: straight alpha (PNG, third edition,
/// section 6.2), 16 bits with the codes of 8 (section 13.12), rows in the order of Adam7 (section 8.2).
TEST_F(Compare, PngsOfOneColorAreEqual) {
    const auto code = [](unsigned x, unsigned y, unsigned c) {
        return c == 0 ? 200 - x : c == 1 ? 100 + y : 60 + 2 * x;
    };
    const auto png = [&](const std::string& name, PngWriter writer) {
        writer.width = writer.height = 32;
        write_text(folder / name, writer.file());
        return folder / name;
    };
    const auto with_alpha = [&](unsigned alpha) {
        return [&code, alpha](unsigned x, unsigned y, unsigned c) {
            return c == 3 ? (x < 16 ? alpha : 255u) : code(x, y, c);
        };
    };
    const auto wide = [&](unsigned x, unsigned y, unsigned c) { return 257 * code(x, y, c); };
    const auto opaque = png("opaque.png", {.sample = code});
    const std::pair<std::filesystem::path, bool> others[] = {
        {png("alpha_0.png", {.color = 6, .sample = with_alpha(0)}), true},
        {png("alpha_half.png", {.color = 6, .sample = with_alpha(128)}), true},
        {png("alpha_255.png", {.color = 6, .sample = with_alpha(255)}), false},
        {png("bits_16.png", {.depth = 16, .sample = wide}), false},
        {png("interlaced_16.png", {.depth = 16, .is_interlaced = true, .sample = wide}), false},
        {png("gamma.hdr", {.chunks = {{"gAMA", PngWriter::integer(45455)}}, .sample = code}), false}};
    for (const auto& [other, has_alpha] : others) {
        const Comparison c = compare({.reference = opaque, .test = other, .metrics = {"mse", "flip"}});
        EXPECT_EQ(value(c, "mse"), 0) << other;
        EXPECT_EQ(value(c, "flip"), 0) << other;
        ASSERT_EQ(c.warnings.size(), has_alpha ? 1u : 0u) << other;
        if (has_alpha) {
            EXPECT_NE(c.warnings[0].find("has an alpha channel that is not opaque"), std::string::npos);
        }
    }
    // Grey with alpha and its twin without; the alpha of black says nothing of light.
    const auto grey = [](unsigned x, unsigned y, unsigned c) { return c == 1 ? 0u : (x * 7 + y) & 255; };
    const Comparison c = compare({.reference = png("grey.png", {.color = 0, .sample = grey}),
                                  .test = png("grey_alpha.png", {.color = 4, .sample = grey}),
                                  .metrics = {"mse"}});
    EXPECT_EQ(value(c, "mse"), 0);
    EXPECT_EQ(c.warnings.size(), 1u);
}

/// A PNG that says its codes are linear light is the OpenEXR image of that light.
TEST_F(Compare, ColorSpacesOfPngsCount) {
    const auto sample = [](unsigned x, unsigned y, unsigned) { return x * 4000 + y * 17; };
    PngWriter linear{
        .width = 16, .height = 16, .depth = 16, .chunks = {{"gAMA", PngWriter::integer(100000)}}, .sample = sample};
    write_text(folder / "linear.png", linear.file());
    HostImage light({16, 16}, 3);
    for (unsigned y = 0; y < 16; ++y)
        for (unsigned x = 0; x < 16; ++x) light.set_rgb(y * 16 + x, glm::vec3(float(sample(x, y, 0)) / 65535.0f));
    const Comparison c =
        compare({.reference = exr("light.exr", light), .test = folder / "linear.png", .metrics = {"mae", "flip"}});
    EXPECT_NEAR(value(c, "mae"), 0, 1e-7);  // through sRGB codes and back, in float32
    EXPECT_NEAR(value(c, "flip"), 0, 1e-5);
    ASSERT_EQ(c.warnings.size(), 1u);
    EXPECT_NE(c.warnings[0].find("linear.png: its colours were converted from gAMA 1 (linear) to sRGB"),
              std::string::npos);
}

TEST_F(Compare, RadiancePicturesAreRadiance) {
    write_text(
        folder / "a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 11 +X 1\n") + [] {
            std::string texels;
            for (int i = 0; i < 11; ++i) texels += "\x80\x40\x20\x83";  // 4, 2, 1
            return texels;
        }());
    HostImage same({1, 11}, 3);
    for (size_t i = 0; i < 11; ++i) same.set_rgb(i, {4, 2, 1});
    const Comparison c = compare({.reference = folder / "a.hdr", .test = exr("a.exr", same)});
    EXPECT_EQ(value(c, "mse"), 0);
    EXPECT_EQ(value(c, "hdr_flip"), 0);
}

TEST_F(Compare, NonFinitePixelsAreReportedFirst) {
    HostImage broken = noise({16, 16}, 2);
    broken.set_rgb(3, {NAN, 0, 0});
    broken.set_rgb(4, {-1, 0, 0});
    CompareOptions options{
        .reference = exr("a.exr", noise({16, 16}, 1)), .test = exr("b.exr", broken), .metrics = {"mse"}};
    const Comparison c = compare(options);
    EXPECT_EQ(c.pixels, 255u);
    ASSERT_EQ(c.warnings.size(), 1u);
    EXPECT_NE(c.warnings[0].find("b.exr: 1 pixels with NaN, 0 with Inf, 1 negative"), std::string::npos)
        << c.warnings[0];
    EXPECT_TRUE(std::isfinite(value(c, "mse")));
    options.fail_on_non_finite = true;
    EXPECT_NE(message(options).find("b.exr: 1 pixels with NaN"), std::string::npos);
    options.fail_on_non_finite = false;
    options.test = exr("c.exr", HostImage({16, 16}, 3, NAN));
    EXPECT_NE(message(options).find("no pixel that is finite in both"), std::string::npos);
}

TEST_F(Compare, WritesMapsAsLayersOrFalseColour) {
    CompareOptions options{.reference = exr("a.exr", noise({20, 16}, 1)),
                           .test = exr("b.exr", noise({20, 16}, 2)),
                           .metrics = {"mse", "flip"},
                           .map = folder / "map.exr"};
    const Comparison c = compare(options);
    const LayeredImage maps = read_exr(folder / "map.exr");
    ASSERT_NE(maps.find("flip"), nullptr);
    EXPECT_EQ(maps.find("flip")->image.values[7], float(c.results[1].map.values[7]));
    EXPECT_EQ(maps.attributes.at("ssrlab.mse"), "mse");
    options.map = folder / "map.png";
    EXPECT_NE(message(options).find("name one with --metric"), std::string::npos);
    options.metrics = {"flip"};
    compare(options);
    EXPECT_EQ(read_png_codes(folder / "map.png").extent, glm::uvec2(20, 16));
}

TEST_F(Compare, AMostlyBlackReferenceLeavesHdrFlipOut) {
    HostImage dark({16, 16}, 3);
    dark.set_rgb(0, glm::vec3(1));
    CompareOptions options{.reference = exr("a.exr", dark), .test = exr("b.exr", noise({16, 16}, 2))};
    const Comparison c = compare(options);
    EXPECT_TRUE(std::isnan(value(c, "hdr_flip")));
    ASSERT_EQ(c.warnings.size(), 1u);
    EXPECT_NE(c.warnings[0].find("hdr_flip is left out"), std::string::npos);
    options.metrics = {"hdr_flip"};
    EXPECT_NE(message(options).find("median luminance"), std::string::npos);
    options.settings.flip_exposures = FlipExposures{-2, 2, 3};
    EXPECT_GT(value(compare(options), "hdr_flip"), 0);
}

TEST_F(Compare, MistakesAreNamed) {
    const auto a = exr("a.exr", noise({20, 16}, 1)), b = exr("b.exr", noise({20, 15}, 2));
    EXPECT_NE(message({.reference = a, .test = b}).find("has 20x16 pixels, but"), std::string::npos);
    EXPECT_NE(message({.reference = a, .test = folder / "none.exr"}).find("no such file"), std::string::npos);
    EXPECT_NE(message({.reference = a, .test = folder / "a.jpg"}).find("no such file"), std::string::npos);
    write_text(folder / "a.tif", "II*" + std::string(9, '\0'));
    EXPECT_NE(message({.reference = a, .test = folder / "a.tif"}).find("a.tif: it is a TIFF; convert it: oiiotool "),
              std::string::npos);
    EXPECT_NE(message({.reference = a, .test = a, .metrics = {"ssmi"}}).find("did you mean 'ssim'?"),
              std::string::npos);
    EXPECT_NE(message({.reference = a, .test = a, .map = "map.txt"}).find("must end in .exr or .png"),
              std::string::npos);
}

TEST_F(Compare, VisibilityNamesItsDisplay) {
    const HostImage reference = noise({40, 30}, 1), test = noise({40, 30}, 2);
    const auto a = exr("a.exr", reference), b = exr("b.exr", test);
    const Comparison c = compare({.reference = a, .test = b, .metrics = {"cvvdp_0_5_6"}, .nits_per_unit = 100.0});
    const Viewing viewing{.display = display_named("standard_hdr_linear"), .nits_per_unit = 100};
    EXPECT_EQ(value(c, "cvvdp_0_5_6"), CvvdpStills({40, 30}, viewing).score(reference, test).jod);
    std::ostringstream out, warnings;
    print(c, out, warnings);
    EXPECT_NE(out.str().find(" (standard_hdr_linear, 100 nits per unit, 75.4024 pixels per degree, version 0.5.6)\n"),
              std::string::npos)
        << out.str();
    const nlohmann::json json = to_json(c)["settings"]["viewing"];
    EXPECT_EQ(json["display"], "standard_hdr_linear");
    EXPECT_EQ(json["nits_per_unit"], 100);
    EXPECT_FALSE(to_json(compare({.reference = a, .test = b, .metrics = {"mse"}}))["settings"].contains("viewing"));

    // Codes as they are, on the display for codes.
    write_png(folder / "a.png", reference), write_png(folder / "b.png", test);
    const Comparison coded =
        compare({.reference = folder / "a.png", .test = folder / "b.png", .metrics = {"cvvdp_0_5_6"}});
    EXPECT_EQ(coded.options.settings.viewing.display.name, "standard_4k");
    EXPECT_EQ(value(coded, "cvvdp_0_5_6"),
              CvvdpStills({40, 30}, {.display = display_named("standard_4k")})
                  .score(read_png_codes(folder / "a.png"), read_png_codes(folder / "b.png"))
                  .jod);
}

TEST_F(Compare, VisibilityWarnsOfWhatADisplayCannotShow) {
    HostImage bright = noise({40, 30}, 1);
    bright.set_rgb(3, {7.5f, 0, 0});  // 1500 cd/m2 are 7.389 at 203 per unit
    bright.set_rgb(4, {1, 1, 7.3f});
    const auto a = exr("a.exr", bright);
    const auto warnings = [&](const CompareOptions& options) { return compare(options).warnings; };
    const CompareOptions options{.reference = a, .test = a, .metrics = {"cvvdp_0_5_6"}};
    ASSERT_EQ(warnings(options).size(), 2u);
    EXPECT_NE(warnings(options)[0].find("a.exr: 1 pixel brighter than the 1500 cd/m2 of standard_hdr_linear;"),
              std::string::npos)
        << warnings(options)[0];
    CompareOptions others = options;
    others.metrics = {"mse"};
    EXPECT_TRUE(warnings(others).empty());
    others = options, others.display = "standard_4k";
    EXPECT_TRUE(warnings(others).empty());
}

TEST_F(Compare, NumberedFramesAreAVideo) {
    std::vector<HostImage> reference, test;
    for (unsigned f = 0; f < 4; ++f) {
        reference.push_back(noise({30, 20}, f)), test.push_back(noise({30, 20}, 10 + f));
        exr("r_" + std::to_string(98 + f) + ".exr", reference[f]);
        exr("t_0" + std::to_string(f) + ".exr", test[f]);
    }
    CompareOptions options{.reference = folder / "r_##.exr",
                           .test = folder / "t_##.exr",
                           .metrics = {"cvvdp_0_5_6"},
                           .map = folder / "map.exr",
                           .video = VideoOptions{.frames_per_second = 24}};
    const Comparison c = compare(options);
    CvvdpVideo video({30, 20}, {.display = display_named("standard_hdr_linear")}, 24, TemporalPadding::replicate, true);
    for (unsigned f = 0; f < 4; ++f) video.add(reference[f], test[f]);
    const CvvdpScore expected = video.score();
    EXPECT_EQ(value(c, "cvvdp_0_5_6"), expected.jod);
    EXPECT_EQ(c.results[0].map.values, expected.map.values);
    EXPECT_EQ(read_exr_rgb(folder / "map.exr").extent, glm::uvec2(30, 20));
    EXPECT_EQ(c.pooled_frames, 4u);
    std::ostringstream out, warnings;
    print(c, out, warnings);
    EXPECT_NE(out.str().find("24 frames per second, padding replicate, 4 frames pooled, version 0.5.6)"),
              std::string::npos)
        << out.str();
    EXPECT_EQ(to_json(c)["settings"]["viewing"]["padding"], "replicate");

    const auto says = [&](const std::string& text) {
        EXPECT_NE(message(options).find(text), std::string::npos) << message(options);
    };
    options.video->padding = TemporalPadding::warm_up;
    says("need 7 frames before one can be scored, but there are 4");
    options.video->padding = TemporalPadding::symmetric;
    options.video->frames_per_second = 1000;
    says("frames per second = 1000 is outside [1, 240]");
    options.video->frames_per_second = 24;
    options.metrics = {"mse"};
    says("videos are compared by cvvdp_0_5_6 alone");
    options.metrics = {"cvvdp_0_5_6"};
    exr("t_02.exr", noise({30, 21}, 1));
    says("all frames must be of one size");
    std::filesystem::remove(folder / "t_03.exr");
    says("r_##.exr has 4 frames, but ");
    options.reference = options.test = folder / "t_#3.exr";
    exr("t_03.exr", test[0]);
    says("as stills");
}

TEST_F(Compare, BadPixelsOfVideosAreCountedOnAllDisplays) {
    for (unsigned f = 0; f < 2; ++f) {
        HostImage image = noise({30, 20}, f);
        exr("a_" + std::to_string(f) + ".exr", image);
        image.set_rgb(7, {1, NAN, 1});
        exr("b_" + std::to_string(f) + ".exr", image);
    }
    for (const char* display : {"standard_4k", "standard_hdr_linear"}) {
        CompareOptions options{.reference = folder / "a_#.exr",
                               .test = folder / "b_#.exr",
                               .metrics = {"cvvdp_0_5_6"},
                               .display = display,
                               .video = VideoOptions{.frames_per_second = 30}};
        const Comparison c = compare(options);
        EXPECT_EQ(c.test_counts.nan, 2u);
        EXPECT_EQ(c.pixels, 2u * 600 - 2);
        EXPECT_EQ(value(c, "cvvdp_0_5_6"), 10) << display;  // black in both
        options.fail_on_non_finite = true;
        EXPECT_NE(message(options).find("NaN and Inf must not occur"), std::string::npos);
    }
}

TEST_F(Compare, OptionsOfVisibilityMustBeOfUse) {
    const auto a = exr("a.exr", noise({40, 30}, 1)), small = exr("small.exr", noise({40, 3}, 1));
    CompareOptions options{.reference = a, .test = a, .metrics = {"flip"}, .display = "standard_4k"};
    EXPECT_NE(message(options).find("add --metric cvvdp_0_5_6"), std::string::npos);
    options.metrics = {"cvvdp_0_5_6"}, options.nits_per_unit = 100;
    EXPECT_NE(message(options).find("standard_4k shows codes"), std::string::npos);
    options.display = "standard_hdr_linea";
    EXPECT_NE(message(options).find("did you mean 'standard_hdr_linear'?"), std::string::npos);
    EXPECT_NE(message({.reference = small, .test = small, .metrics = {"cvvdp_0_5_6"}}).find("at least 4x4 pixels"),
              std::string::npos);
}
