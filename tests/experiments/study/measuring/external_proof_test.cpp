// Whether images of another program are recognised as showing the scene, and what is said of those that do not: a scene
// of lamps before a sky, which is a function of the plane, sampled as cameras would that are right or wrong.
#include "experiments/study/measuring/frames/external_proof.h"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <limits>

namespace {

const glm::uvec2 extent(160, 90);

/// Emission of three lamps, in pixels from the left top corner; 0 elsewhere.
float lamps(float x, float y) {
    if (std::hypot(x - 40, y - 25) < 14) return 8;
    if (x > 80.3f && x < 120.7f && y > 20.2f && y < 26.6f) return 3;
    if (std::hypot(x - 110, y - 60) < 9) return 0.5f;
    return 0;
}
bool is_floor(float x, float y) { return y > 72 + 0.05f * x; }
glm::vec3 sky(float, float y) { return glm::vec3(0.2f + 0.002f * y, 0.25f, 0.4f); }

/// What a camera sees whose samples lie at `offset` within pixels.
HostImage photo(glm::vec2 offset, float floor = 0.3f) {
    HostImage image(extent, 3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const float px = float(x) + offset.x, py = float(y) + offset.y, lamp = lamps(px, py);
            image.set_rgb(size_t(y) * extent.x + x, lamp > 0           ? glm::vec3(lamp, lamp, lamp * 0.8f)
                                                    : is_floor(px, py) ? glm::vec3(floor)
                                                                       : sky(px, py));
        }
    return image;
}

const glm::vec2 middle(0.5f);

ProofPixels proof() {
    HostImage emission(extent, 3), is_background(extent, 1), noise(extent, 1);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const float px = float(x) + 0.5f, py = float(y) + 0.5f, lamp = lamps(px, py);
            emission.set_rgb(size_t(y) * extent.x + x, glm::vec3(lamp));
            *is_background.pixel(x, y) = lamp == 0 && !is_floor(px, py);
        }
    return proof_pixels(photo(middle), noise, {}, emission, is_background);
}

HostImage mapped(const HostImage& image, const std::function<float(float)>& map) {
    HostImage changed = image;
    for (float& v : changed.values) v = map(v);
    return changed;
}

HostImage turned(const HostImage& image, bool columns, bool rows) {
    HostImage changed(extent, 3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (int c = 0; c < 3; ++c)
                changed.pixel(x, y)[c] = image.pixel(columns ? extent.x - 1 - x : x, rows ? extent.y - 1 - y : y)[c];
    return changed;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

}  // namespace

TEST(ExternalProof, TakesTheSceneWhateverSurfacesReflect) {
    EXPECT_EQ(why_refused(photo(middle), proof()), "");
    EXPECT_EQ(why_refused(photo(middle, 5.0f), proof()), "") << "a floor that reflects is what is compared";
    // Rounding to half floats, and a rasteriser that decides otherwise at a few pixels of edges.
    HostImage image = mapped(photo(middle), [](float v) { return v * (1 + 1.0f / 2048); });
    for (unsigned x = 40; x < 46; ++x) image.pixel(x, 25)[0] = 100;
    EXPECT_EQ(why_refused(image, proof()), "");
}

TEST(ExternalProof, SaysWhatUndoesTheDifference) {
    const HostImage right = photo(middle);
    const ProofPixels all = proof();
    EXPECT_TRUE(says(why_refused(turned(right, false, true), all), "upside down"));
    EXPECT_TRUE(says(why_refused(turned(right, true, false), all), "left and right"));
    EXPECT_TRUE(says(why_refused(turned(right, true, true), all), "half a turn"));
    EXPECT_TRUE(says(why_refused(mapped(right, [](float v) { return v * 1.7f; }), all), "1.7 times as bright"));
    EXPECT_TRUE(says(why_refused(mapped(right, [](float v) { return std::min(v, 1.0f); }), all), "tone mapping"));
    EXPECT_TRUE(says(why_refused(mapped(right, [](float v) { return v / (1 + v); }), all), "tone mapping"));
    EXPECT_TRUE(
        says(why_refused(
                 mapped(right,
                        [](float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }),
                 all),
             "sRGB"));
    EXPECT_TRUE(says(why_refused(photo(middle, 0.3f), all), ""));
    EXPECT_TRUE(says(why_refused(HostImage(extent, 3, 0.1f), all), "camera, materials or units"));
    EXPECT_TRUE(says(why_refused(HostImage(extent, 3, std::numeric_limits<float>::quiet_NaN()), all), "differ"));
}

/// As a blur that reaches over the edges of what reflects: an error of the technique's, not of its camera.
TEST(ExternalProof, LeavesWhatReflectionsLeakToTheirError) {
    HostImage leaking = photo(middle);
    for (unsigned x = 0; x < extent.x; ++x)
        for (unsigned y = 50; y < 70; ++y) leaking.set_rgb(size_t(y) * extent.x + x, glm::vec3(0.1f * float(x % 7)));
    EXPECT_NE(why_refused(leaking, proof()), "");
    EXPECT_EQ(why_refused_with_reflections(leaking, proof(), false), "");
    const HostImage wide = photo({1.0f, 0.5f});  // as if each edge leaked by half a pixel: no proof of another camera
    EXPECT_NE(why_refused(wide, proof()), "");
    EXPECT_EQ(why_refused_with_reflections(wide, proof(), false), "");
    const HostImage other(extent, 3, 0.1f);
    EXPECT_TRUE(says(why_refused_with_reflections(other, proof(), false), "change most of what"));
    EXPECT_EQ(why_refused_with_reflections(other, proof(), true), "");
    for (const bool may_change_all : {false, true})
        EXPECT_TRUE(says(why_refused_with_reflections(turned(photo(middle), false, true), proof(), may_change_all),
                         "upside down"));
}

TEST(ExternalProof, SaysWhereToAnImageIsShifted) {
    const struct {
        glm::vec2 offset;  // a sample right of its pixel's centre sees what lies right of it: edges move left
        const char* words;
    } cases[] = {{{1.0f, 0.5f}, "too far left:"},        {{0.0f, 0.5f}, "too far right:"},
                 {{0.5f, 1.0f}, "too far up:"},          {{0.5f, 0.0f}, "too far down:"},
                 {{1.0f, 1.0f}, "too far left and up:"}, {{0.0f, 0.0f}, "too far right and down:"}};
    for (const auto& c : cases) {
        const std::string why = why_refused(photo(c.offset), proof());
        EXPECT_TRUE(says(why, c.words)) << c.words << " is not in: " << why;
    }
}

TEST(ExternalProof, AllowsWhatNoiseAndReflectionsMayAdd) {
    // One lamp that emits 1, reflects and is lit: its light without reflections is known to 0.05.
    const HostImage direct(extent, 3, 1.0f), noise(extent, 1, 0.05f), emission(extent, 3, 0.8f), background(extent, 1),
        reflection(extent, 3, 0.3f);
    const ProofPixels off = proof_pixels(direct, noise, {}, emission, background),
                      on = proof_pixels(direct, noise, reflection, emission, background);
    EXPECT_EQ(why_refused(HostImage(extent, 3, 1.15f), off), "");
    EXPECT_NE(why_refused(HostImage(extent, 3, 1.3f), off), "");
    EXPECT_EQ(why_refused(HostImage(extent, 3, 1.3f), on), "");
    EXPECT_NE(why_refused(HostImage(extent, 3, 2.0f), on), "");
    EXPECT_EQ(on.count(), size_t(extent.x) * extent.y);
    EXPECT_EQ(proof_pixels(direct, noise, {}, HostImage(extent, 3), background).count(), 0u)
        << "surfaces that only reflect prove nothing";
}

TEST(ExternalProof, PictureShowsWhere) {
    HostImage image = photo(middle);
    for (unsigned x = 20; x < 60; ++x) image.pixel(x, 25)[1] = 50;
    const HostImage picture = difference_picture(image, proof());
    EXPECT_EQ(picture.rgb(25 * extent.x + 30), glm::vec3(1, 0, 0));
    EXPECT_GT(picture.rgb(10 * extent.x + 100).y, 2 * picture.rgb(10 * extent.x + 100).x) << "compared, and agrees";
    const glm::vec3 floor = picture.rgb(85 * extent.x + 10);
    EXPECT_EQ(floor.x, floor.y) << "not compared";
}
