#include "experiments/study/measuring/frames/external_proof.h"

#include "core/number_text.h"
#include "core/png.h"
#include "metrics/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace {

/// Emission and background are stored, not computed: engines differ in them by rounding to half floats and by what a
/// texture's filter does. The second is of the image's brightest proof pixel: below that nothing can be told.
constexpr float relative_tolerance = 0.02f, absolute_share = 1e-4f;
/// Of proof pixels that reflections may change where they must not. More than that is no leak at edges.
constexpr double largest_leak = 0.5;
/// Standard errors of the truth's own light on surfaces that emit and are lit: one pixel in 16,000 lies beyond.
constexpr float noise_deviations = 4;

bool differs_at(const HostImage& image, const ProofPixels& proof, size_t pixel, size_t shown) {
    const float tolerance = proof.tolerance.values[pixel];
    if (tolerance < 0) return false;
    const glm::vec3 apart = glm::abs(image.rgb(shown) - proof.radiance.rgb(pixel));
    return !(std::max({apart.x, apart.y, apart.z}) <= tolerance);
}

size_t count_differing(const HostImage& image, const ProofPixels& proof) {
    size_t count = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i) count += differs_at(image, proof, i, i);
    return count;
}

HostImage mapped(const HostImage& image, const std::function<glm::vec3(glm::vec3)>& map) {
    HostImage changed(image.extent, 3);
    for (size_t i = 0; i < image.pixel_count(); ++i) changed.set_rgb(i, map(image.rgb(i)));
    return changed;
}

HostImage turned(const HostImage& image, bool columns, bool rows) {
    HostImage changed(image.extent, 3);
    const unsigned width = image.extent.x, height = image.extent.y;
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width; ++x) {
            const size_t from = size_t(rows ? height - 1 - y : y) * width + (columns ? width - 1 - x : x);
            changed.set_rgb(size_t(y) * width + x, image.rgb(from));
        }
    return changed;
}

/// The factor by which most proof pixels are brighter than they should be.
std::optional<float> common_factor(const HostImage& image, const ProofPixels& proof) {
    std::vector<float> factors;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        if (proof.tolerance.values[i] < 0) continue;
        const glm::vec3 expected = proof.radiance.rgb(i), seen = image.rgb(i);
        const float sum = expected.x + expected.y + expected.z;
        if (sum > 3 * proof.tolerance.values[i]) factors.push_back((seen.x + seen.y + seen.z) / sum);
    }
    if (factors.empty()) return {};
    const auto middle = factors.begin() + long(factors.size() / 2);
    std::nth_element(factors.begin(), middle, factors.end());
    return *middle > 0 ? std::optional(*middle) : std::nullopt;
}

/// Whether all proof pixels that should be brighter than 1 are at most so bright.
bool is_cut_at_one(const HostImage& image, const ProofPixels& proof) {
    size_t above = 0;
    float brightest = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        const glm::vec3 expected = proof.radiance.rgb(i), seen = image.rgb(i);
        if (proof.tolerance.values[i] < 0 || std::max({expected.x, expected.y, expected.z}) <= 1.05f) continue;
        ++above, brightest = std::max({brightest, seen.x, seen.y, seen.z});
    }
    constexpr float dimmest = 0.5f;  // a curve takes 1 to at least that, and what is brighter beyond
    return above > 0 && brightest <= 1.0f && brightest >= dimmest;
}

struct Step {
    int x, y;
    const char* words;
};
constexpr std::array<Step, 8> steps = {{{1, 0, "left"},
                                        {-1, 0, "right"},
                                        {0, 1, "up"},
                                        {0, -1, "down"},
                                        {1, 1, "left and up"},
                                        {-1, 1, "right and up"},
                                        {1, -1, "left and down"},
                                        {-1, -1, "right and down"}}};

/// The share of the differing pixels that show what the pixel a step away should.
double share_moved(const HostImage& image, const ProofPixels& proof, const Differences& found, Step step) {
    const int width = int(image.extent.x), height = int(image.extent.y);
    size_t moved = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t pixel = size_t(y) * size_t(width) + size_t(x);
            const int from_x = x + step.x, from_y = y + step.y;
            if (!found.differs[pixel] || from_x < 0 || from_y < 0 || from_x >= width || from_y >= height) continue;
            const size_t from = size_t(from_y) * size_t(width) + size_t(from_x);
            // A neighbour that proves nothing may show anything.
            moved += !differs_at(image, proof, from, pixel);
        }
    return double(moved) / double(found.count);
}

/// Where all that differs lies along edges, each of which moved the same way.
std::string shift_of(const HostImage& image, const ProofPixels& proof, const Differences& found) {
    double largest = 0, opposite = 0;
    const Step* best = nullptr;
    for (const Step& step : steps) {
        const double share = share_moved(image, proof, found, step);
        if (best && share <= largest) continue;
        largest = share, best = &step;
        opposite = share_moved(image, proof, found, {-step.x, -step.y, ""});
    }
    constexpr double most = 0.9, few = 0.6;  // thin things show through on both sides
    if (largest < most || opposite > few) return "";
    return std::string("edges lie up to a pixel too far ") + best->words +
           ": rays and samples must go through the centres of pixels, and the projection must have no jitter";
}

std::string seen(const Differences& found, const ProofPixels& proof) {
    return std::to_string(found.count) + " of " + std::to_string(proof.count()) +
           " pixels that no technique may change differ from the truth: ";
}

/// "" if nothing that was tried does.
std::string what_undoes(const HostImage& image, const ProofPixels& proof) {
    const auto agrees = [&](const HostImage& other) {
        return count_differing(other, proof) <= most_differing(proof.count());
    };
    if (agrees(turned(image, false, true))) return "the image is upside down; its first row must be the top";
    if (agrees(turned(image, true, false))) return "left and right are exchanged";
    if (agrees(turned(image, true, true))) return "the image is turned by half a turn; its first row must be the top";
    if (agrees(mapped(image, [](glm::vec3 c) {
            return glm::vec3(linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z));
        })))
        return "it holds sRGB values; write linear ones";
    if (const std::optional<float> factor = common_factor(image, proof);
        factor && agrees(mapped(image, [&](glm::vec3 c) { return c / *factor; })))
        return "all are " + number_text(*factor) +
               " times as bright as they should be; exposure must be 1, and units those of the scene";
    if (is_cut_at_one(image, proof))
        return "nothing is brighter than 1, where the scene is; switch tone mapping off, and write floats";
    return "";
}

}  // namespace

size_t ProofPixels::count() const {
    return size_t(std::ranges::count_if(tolerance.values, [](float t) { return t >= 0; }));
}

ProofPixels proof_pixels(const HostImage& direct, const HostImage& direct_noise, const HostImage& reflection,
                         const HostImage& emission, const HostImage& is_background) {
    ProofPixels proof{.radiance = direct, .tolerance = HostImage(direct.extent, 1, -1.0f)};
    float brightest = 0;
    const auto largest = [](glm::vec3 v) { return std::max({v.x, v.y, v.z}); };
    const auto is_proof = [&](size_t i) { return is_background.values[i] > 0 || largest(emission.rgb(i)) > 0; };
    for (size_t i = 0; i < direct.pixel_count(); ++i)
        if (is_proof(i)) brightest = std::max(brightest, largest(direct.rgb(i)));
    for (size_t i = 0; i < direct.pixel_count(); ++i) {
        if (!is_proof(i)) continue;
        const bool is_surface = is_background.values[i] == 0;
        const glm::vec3 added = is_surface && !reflection.values.empty() ? reflection.rgb(i) : glm::vec3(0.0f);
        // Surfaces that emit and reflect: what is added may be missing, or be there twice.
        const float allowed = relative_tolerance * largest(direct.rgb(i)) + absolute_share * brightest +
                              (is_surface ? noise_deviations * direct_noise.values[i] : 0.0f) + largest(added);
        proof.radiance.set_rgb(i, direct.rgb(i) + added);
        proof.tolerance.values[i] = allowed;
    }
    return proof;
}

size_t most_differing(size_t proof_pixels) { return 8 + proof_pixels / 2000; }

Differences differences(const HostImage& image, const ProofPixels& proof) {
    Differences found{.differs = std::vector<uint8_t>(image.pixel_count())};
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        found.differs[i] = differs_at(image, proof, i, i);
        found.count += found.differs[i];
    }
    return found;
}

std::string why_refused(const HostImage& image, const ProofPixels& proof) {
    const Differences found = differences(image, proof);
    if (found.count <= most_differing(proof.count())) return "";
    std::string why = what_undoes(image, proof);
    if (why.empty()) why = shift_of(image, proof, found);
    return seen(found, proof) +
           (why.empty() ? "camera, materials or units are others; compare the picture of where with the scene" : why);
}

std::string why_refused_with_reflections(const HostImage& image, const ProofPixels& proof, bool may_change_all) {
    const Differences found = differences(image, proof);
    if (found.count <= most_differing(proof.count())) return "";
    if (const std::string why = what_undoes(image, proof); !why.empty()) return seen(found, proof) + why;
    if (may_change_all || double(found.count) <= largest_leak * double(proof.count())) return "";
    return seen(found, proof) +
           "reflections change most of what they must not change, or the image is of another view "
           "than the one without them";
}

HostImage difference_picture(const HostImage& image, const ProofPixels& proof) {
    const Differences found = differences(image, proof);
    HostImage picture(image.extent, 3);
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        const glm::vec3 c = image.rgb(i);
        const float y = std::isfinite(c.x + c.y + c.z) ? std::max(float(luminance(c.x, c.y, c.z)), 0.0f) : 0.0f,
                    grey = y / (1.0f + y);
        picture.set_rgb(i, found.differs[i]                 ? glm::vec3(1, 0, 0)
                           : proof.tolerance.values[i] >= 0 ? glm::vec3(0.2f * grey, 0.3f + 0.7f * grey, 0.2f * grey)
                                                            : glm::vec3(grey));
    }
    return picture;
}
