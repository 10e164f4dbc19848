#include "core/png.h"
#include "core/error.h"
#include "core/files.h"
#include "tests/error_message.h"
#include "tests/png_writer.h"

#include <gtest/gtest.h>
#include <lcms2.h>
#include <zlib.h>
#include <cmath>
#include <cstring>
#include <memory>

namespace fs = std::filesystem;

namespace {

DecodedImage decode(const std::string& file, unsigned longest_side = 1000) {
    return decode_png(
        {{reinterpret_cast<const uint8_t*>(file.data()), file.size()}, "a.glb: image 0 ('t.png')", "t.png"},
        longest_side);
}

unsigned code_at(const DecodedImage& image, size_t texel, unsigned channel) {
    const size_t at = texel * 4 + channel;
    if (image.channel_bytes == 1) return image.rgba[at];
    uint16_t code;
    std::memcpy(&code, &image.rgba[2 * at], sizeof code);
    return code;
}

struct PngFiles : testing::Test {
    fs::path folder = fs::temp_directory_path() / "png_test";
    std::vector<std::string> notes;

    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    HostImage read(const PngWriter& png) {
        write_text(folder / "a.png", png.file());
        notes.clear();
        return read_png_codes(folder / "a.png", notes);
    }
    /// Linear light of one pixel, with the chunks.
    glm::vec3 light(std::vector<std::pair<std::string, std::string>> chunks, glm::uvec3 codes, unsigned depth = 8) {
        PngWriter png{.depth = depth, .chunks = std::move(chunks)};
        png.sample = [&](unsigned, unsigned, unsigned c) { return codes[int(c)]; };
        const glm::vec3 code = read(png).rgb(0);
        return {linear_from_srgb(code.x), linear_from_srgb(code.y), linear_from_srgb(code.z)};
    }
};

std::string integers(std::initializer_list<uint32_t> values) {
    std::string bytes;
    for (const uint32_t value : values) bytes += PngWriter::integer(value);
    return bytes;
}

std::string cicp(unsigned char primaries, unsigned char curve, char matrix = 0, char is_full = 1) {
    return {char(primaries), char(curve), matrix, is_full};
}

/// Chunk iCCP of a profile with the primaries and the exponent; 0: sRGB's own.
std::string iccp(const cmsCIExyYTRIPLE& primaries, double exponent) {
    const cmsCIExyY d65{0.3127, 0.3290, 1};
    const std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)> curve(cmsBuildGamma(nullptr, exponent),
                                                                       cmsFreeToneCurve);
    cmsToneCurve* const curves[] = {curve.get(), curve.get(), curve.get()};
    const cmsHPROFILE profile = exponent > 0 ? cmsCreateRGBProfile(&d65, &primaries, curves) : cmsCreate_sRGBProfile();
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::string bytes(size, '\0');
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    uLongf packed_size = compressBound(uLong(bytes.size()));
    std::string packed(packed_size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &packed_size, reinterpret_cast<const Bytef*>(bytes.data()),
             uLong(bytes.size()));
    packed.resize(packed_size);
    return std::string("of a test\0", 10) + '\0' + packed;
}

constexpr cmsCIExyYTRIPLE display_p3{{0.680, 0.320, 1}, {0.265, 0.690, 1}, {0.150, 0.060, 1}};

void expect_light(glm::vec3 seen, glm::vec3 expected, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], tolerance) << c;
}

/// Of P3 with D65 and of Rec. 2020: linear Rec. 709 of their red (SMPTE EG 432-1; ITU-R BT.2407, 2.2).
constexpr glm::vec3 red_of_p3(1.22494f, -0.04206f, -0.01964f), red_of_2020(1.66049f, -0.12455f, -0.01815f);

}  // namespace

/// Section 11.2.2, table 11.1: each type of colour in each depth that it has, in both orders of rows, with and without
/// tRNS. Extents that no pass of the interlaced ones fills, and those that leave passes empty.
TEST_F(PngFiles, OfEveryKindAreTheSamplesThatTheyHold) {
    const std::vector<std::pair<unsigned, unsigned>> kinds = {{0, 1}, {0, 2},  {0, 4},  {0, 8}, {0, 16},
                                                              {2, 8}, {2, 16}, {3, 1},  {3, 2}, {3, 4},
                                                              {3, 8}, {4, 8},  {4, 16}, {6, 8}, {6, 16}};
    for (const auto& [color, depth] : kinds)
        for (const bool is_interlaced : {false, true})
            for (const bool has_trns : {false, true})
                for (const glm::uvec2 extent : {glm::uvec2(1, 1), {3, 2}, {13, 9}}) {
                    if (has_trns && color >= 4) continue;
                    const unsigned most = (1u << depth) - 1;
                    PngWriter png{.width = extent.x,
                                  .height = extent.y,
                                  .depth = depth,
                                  .color = color,
                                  .is_interlaced = is_interlaced};
                    png.sample = [&](unsigned x, unsigned y, unsigned c) {
                        return (x * 2531 + y * 517 + c * 40503) & most;
                    };
                    const auto paletted = [](unsigned index, unsigned c) { return (index * 37 + c * 91) & 255; };
                    std::string palette, transparent;
                    for (unsigned i = 0; i <= most && color == 3; ++i)
                        for (unsigned c = 0; c < 3; ++c) palette += char(paletted(i, c));
                    if (color == 3) png.chunks.emplace_back("PLTE", palette);
                    // Alpha of the first entries; or the colour of the first pixel, which is transparent.
                    const auto short_of = [](unsigned v) { return std::string{char(v >> 8), char(v)}; };
                    if (color == 3) transparent = std::string{'\0', '\x80'};
                    if (color == 0) transparent = short_of(png.sample(0, 0, 0));
                    if (color == 2)
                        transparent = short_of(png.sample(0, 0, 0)) + short_of(png.sample(0, 0, 1)) +
                                      short_of(png.sample(0, 0, 2));
                    if (has_trns) png.chunks.emplace_back("tRNS", transparent);

                    const HostImage codes = read(png);
                    const DecodedImage texels = decode(png.file());
                    ASSERT_EQ(texels.extent, extent);
                    ASSERT_EQ(codes.extent, extent);
                    ASSERT_EQ(texels.channel_bytes, depth == 16 ? 2u : 1u);
                    const unsigned opaque = depth == 16 ? 65535 : 255;
                    bool is_opaque = true;
                    for (unsigned y = 0; y < extent.y; ++y)
                        for (unsigned x = 0; x < extent.x; ++x) {
                            unsigned expected[4] = {0, 0, 0, opaque};
                            const auto sample = [&](unsigned c) { return png.sample(x, y, c); };
                            for (unsigned c = 0; c < 3; ++c)
                                expected[c] = color == 3 ? paletted(sample(0), c)
                                                         : sample(color == 0 || color == 4 ? 0 : c) * (opaque / most);
                            if (color == 4) expected[3] = sample(1);
                            if (color == 6) expected[3] = sample(3);
                            if (has_trns && color == 3)
                                expected[3] = sample(0) < 2 ? uint8_t(transparent[sample(0)]) : 255u;
                            if (has_trns && color == 0 && sample(0) == png.sample(0, 0, 0)) expected[3] = 0;
                            if (has_trns && color == 2 && sample(0) == png.sample(0, 0, 0) &&
                                sample(1) == png.sample(0, 0, 1) && sample(2) == png.sample(0, 0, 2))
                                expected[3] = 0;
                            is_opaque = is_opaque && expected[3] == opaque;
                            for (unsigned c = 0; c < 4; ++c)
                                ASSERT_EQ(code_at(texels, y * extent.x + x, c), expected[c])
                                    << color << ' ' << depth << ' ' << is_interlaced << has_trns << ' ' << x << ' ' << y
                                    << ' ' << c;
                            for (unsigned c = 0; c < 3; ++c)
                                ASSERT_EQ(codes.pixel(x, y)[c], float(expected[c]) / float(opaque));
                        }
                    ASSERT_EQ(notes.size(), is_opaque ? 0u : 1u);
                    if (!is_opaque) {
                        EXPECT_NE(notes[0].find("a.png: it has an alpha channel that is not opaque"),
                                  std::string::npos);
                    }
                }
}

/// A cut or damaged file is never a picture with black rows: each prefix, and each file with a bit that flipped, fails.
TEST_F(PngFiles, CutOrDamagedOnesFail) {
    for (const bool is_interlaced : {false, true}) {
        PngWriter png{
            .width = 9, .height = 7, .is_interlaced = is_interlaced, .chunks = {{"tEXt", std::string("Title\0a", 7)}}};
        png.sample = [](unsigned x, unsigned y, unsigned c) { return (x * 61 + y * 31 + c * 7) & 255; };
        const std::string whole = png.file();
        EXPECT_EQ(error_message([&] { decode(whole); }), "no error");
        for (size_t size = 0; size < whole.size(); ++size)
            ASSERT_NE(error_message([&] { decode(whole.substr(0, size)); }).find("cannot be decoded"),
                      std::string::npos)
                << size;
        for (size_t bit = 0; bit < 8 * whole.size(); ++bit) {
            std::string damaged = whole;
            damaged[bit / 8] ^= char(1 << bit % 8);
            ASSERT_NE(error_message([&] { decode(damaged); }).find("cannot be decoded"), std::string::npos) << bit;
        }
    }
    EXPECT_EQ(error_message([] { decode(PngWriter{.width = 20, .height = 3}.file(), 19); }),
              "a.glb: image 0 ('t.png') has 20 x 3 pixels; allowed are sides of 19");
}

/// A stream of pixels that ends early, in chunks that are whole.
TEST_F(PngFiles, WithoutAllTheirRowsFail) {
    const std::string short_one = PngWriter{.width = 5, .height = 4}.file();
    std::string longer = short_one;
    longer.replace(
        8, 25,
        PngWriter::chunk("IHDR", PngWriter::integer(5) + PngWriter::integer(5) + std::string("\x08\x02\0\0\0", 5)));
    EXPECT_NE(error_message([&] { decode(longer); }).find("Not enough image data"), std::string::npos);
}

/// PNG (third edition), section 4.3, and what each chunk says.
TEST_F(PngFiles, HaveTheColorsThatTheirChunksSay) {
    const std::string srgb_primaries = integers({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000}),
                      primaries_of_2020 = integers({31270, 32900, 70800, 29200, 17000, 79700, 13100, 4600});
    const auto own_light = light({}, {255, 128, 10});
    for (const auto& chunks : std::vector<std::vector<std::pair<std::string, std::string>>>{
             {{"sRGB", std::string(1, '\0')}},
             {{"gAMA", integers({45455})}},
             {{"gAMA", integers({45100})}},
             {{"gAMA", integers({45455})}, {"cHRM", srgb_primaries}},
             {{"cICP", cicp(1, 13)}},
             {{"iCCP", iccp(display_p3, 0)}},
             {{"sRGB", std::string(1, '\0')}, {"gAMA", integers({100000})}},  // sRGB counts more than gAMA,
             {{"iCCP", iccp(display_p3, 0)}, {"gAMA", integers({100000})}},   // and so does iCCP,
             {{"cICP", cicp(1, 13)}, {"iCCP", iccp(display_p3, 1.8)}},        // and cICP more than all
             {{"cICP", cicp(2, 2)}, {"sRGB", std::string(1, '\0')}}}) {
        EXPECT_EQ(light(chunks, {255, 128, 10}), own_light) << chunks[0].first;
        EXPECT_TRUE(notes.empty()) << notes[0];
    }
    const auto expect_note = [&](const std::string& part) {
        ASSERT_EQ(notes.size(), 1u);
        EXPECT_NE(notes[0].find("a.png: its colours were converted from " + part), std::string::npos) << notes[0];
    };
    // 16 bits: codes of linear light go through sRGB's curve and back, in float32.
    expect_light(light({{"gAMA", integers({100000})}}, {65535, 13107, 655}, 16), {1, 0.2f, 655 / 65535.0f}, 1e-6f);
    expect_note("gAMA 1 (linear) to sRGB");
    expect_light(light({{"gAMA", integers({55556})}}, {255, 128, 0}), {1, std::pow(128 / 255.0f, 1 / 0.55556f), 0},
                 1e-6f);
    expect_note("gAMA 0.55556 to sRGB");
    expect_light(light({{"cHRM", primaries_of_2020}, {"gAMA", integers({100000})}}, {255, 0, 0}), red_of_2020, 1e-4f);
    expect_note("gAMA 1 (linear) and the primaries of cHRM");
    expect_light(light({{"cHRM", primaries_of_2020}}, {255, 255, 255}), glm::vec3(1), 1e-6f);
    expect_light(light({{"cICP", cicp(9, 8)}}, {255, 0, 0}), red_of_2020, 1e-4f);
    expect_note("BT.2020 (linear), which its chunk cICP names");
    expect_light(light({{"cICP", cicp(12, 13)}}, {255, 0, 0}), red_of_p3, 1e-4f);
    expect_note("Display P3, which its chunk cICP names");
    expect_light(light({{"cICP", cicp(1, 1)}}, {255, 128, 10}),
                 {1, std::pow((128 / 255.0f + 0.099f) / 1.099f, 1 / 0.45f), 10 / 255.0f / 4.5f}, 1e-6f);
    // A profile holds matrices in steps of 2^-16, and D50.
    expect_light(light({{"iCCP", iccp(display_p3, 1.0)}}, {255, 0, 0}), red_of_p3, 5e-4f);
    expect_light(light({{"iCCP", iccp(display_p3, 1.8)}}, {128, 128, 128}), glm::vec3(std::pow(128 / 255.0f, 1.8f)),
                 5e-4f);
    expect_note("its ICC profile '");
    light({{"iCCP", std::string("broken\0\0", 8) + "no stream"}}, {1, 2, 3});
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("its ICC profile cannot be read and is left aside; its codes are taken for sRGB"),
              std::string::npos);

    const auto refused = [&](const std::string& chunk) {
        return error_message([&] { light({{"cICP", chunk}}, {1, 2, 3}); });
    };
    EXPECT_NE(refused(cicp(9, 16)).find("a.png: its chunk cICP (9 16 0 1) says that its codes are PQ"),
              std::string::npos);
    EXPECT_NE(refused(cicp(9, 18)).find("says that its codes are HLG"), std::string::npos);
    EXPECT_NE(refused(cicp(77, 13)).find("a colour space that ssrlab does not know"), std::string::npos);
    EXPECT_NE(refused(cicp(1, 13, 1)).find("are not RGB"), std::string::npos);
    EXPECT_NE(refused(cicp(1, 13, 0, 0)).find("do not use the full range"), std::string::npos);
}

/// Colours that textures hold are not converted, and grey of 16 bits has what its twin of 8 bits has.
TEST_F(PngFiles, AsTexturesAreTheirCodes) {
    PngWriter png{.depth = 16, .color = 0, .chunks = {{"gAMA", integers({100000})}}};
    png.sample = [](unsigned, unsigned, unsigned) { return 6808u; };
    EXPECT_EQ(code_at(decode(png.file()), 0, 1), 6808u);
    for (unsigned code = 0; code < 256; ++code) {
        PngWriter of_8{.sample = [&](unsigned, unsigned, unsigned) { return code; }}, of_16 = of_8;
        of_16.depth = 16, of_16.sample = [&](unsigned, unsigned, unsigned) { return 257 * code; };
        EXPECT_EQ(read(of_16).values, read(of_8).values);
    }
}

TEST_F(PngFiles, AreEncodedAsTheyAreDecoded) {
    for (const unsigned channel_bytes : {1u, 2u})
        for (const unsigned channels : {3u, 4u}) {
            std::vector<uint8_t> codes(5 * 3 * channels * channel_bytes);
            for (size_t i = 0; i < codes.size(); ++i) codes[i] = uint8_t(i * 83);
            const std::vector<std::byte> file = encode_png({5, 3}, channels, channel_bytes, codes);
            const DecodedImage back = decode({reinterpret_cast<const char*>(file.data()), file.size()});
            ASSERT_EQ(back.channel_bytes, channel_bytes);
            for (size_t texel = 0; texel < 15; ++texel)
                for (size_t i = 0; i < channels * channel_bytes; ++i)
                    ASSERT_EQ(back.rgba[texel * 4 * channel_bytes + i], codes[texel * channels * channel_bytes + i]);
        }
}

TEST_F(PngFiles, OfOtherFormatsAreNamed) {
    const auto message = [&](const std::string& bytes) {
        write_text(folder / "a.png", bytes);
        return error_message([&] { read_png_codes(folder / "a.png"); });
    };
    EXPECT_NE(message("<!DOCTYPE html><title>404</title>").find("a.png as PNG: it is an HTML page"), std::string::npos);
    EXPECT_NE(message("abc").find("it does not begin as one"), std::string::npos);
    EXPECT_NE(message("").find("it is empty"), std::string::npos);
}
