#include "groundtruth/reference/sample_allocation.h"

#include "groundtruth/reference/reference_error.h"
#include "groundtruth/reference/reference_stopping.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace {

constexpr unsigned coarsest = 4;        ///< log2 of the widest spacing of a lattice (pixels)
constexpr size_t enough_informers = 4;  ///< of one material; fewer know too little

/// Variance falls as samples^-exponent: 1 for independent samples, 3 for smooth integrands and scrambled Sobol' points
/// (Owen 1997, "Scrambled net variance for integrals of smooth functions"), 1.2 to 1.4 with light from everywhere. What
/// is estimated is bounded, since an exponent too large would promise too much.
constexpr double least_exponent = 1.0, largest_exponent = 1.6;

/// The errors that are stated scatter by a fifth (14 degrees of freedom): this much more than is needed on average
/// brings most of the pixels below the target.
constexpr double safety = 1.3;

constexpr double missed_share = 0.005;         ///< of the pixels may miss the target while time is left
constexpr size_t enough_judges = 200;          ///< fewer cannot show so small a share
constexpr float factor_without_judges = 4.0f;  ///< far in the tail of what errors scatter

/// The place of a pixel in the nested lattices x, y = 0 modulo 2^k and their halves, where x + y is even.
struct Lattice {
    unsigned log_spacing;
    bool is_diagonal;  ///< of the coarser half: both coordinates are odd multiples of the spacing

    unsigned coarseness() const { return 2 * log_spacing + is_diagonal; }
};

Lattice lattice(unsigned x, unsigned y) {
    const unsigned log_spacing = std::min(unsigned(std::countr_zero(x | y | 1u << coarsest)), coarsest);
    const unsigned both = (x & y) >> log_spacing & 1u;
    return {log_spacing, log_spacing == coarsest || both != 0};
}

bool ranks_below(glm::uvec2 a, glm::uvec2 b) {
    const unsigned ca = lattice(a.x, a.y).coarseness(), cb = lattice(b.x, b.y).coarseness();
    return ca != cb ? ca > cb : a.y != b.y ? a.y < b.y : a.x < b.x;
}

/// Those of lower rank in a window of (2 radius + 1)^2 points of the pixel's lattice, of the given material, or of any.
void search(const HostImage& material_id, glm::uvec2 pixel, int radius, float material, bool any_material,
            std::vector<size_t>& found) {
    const int spacing = 1 << lattice(pixel.x, pixel.y).log_spacing;
    const glm::ivec2 extent(material_id.extent), center(pixel);
    found.clear();
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) {
            const glm::ivec2 other = center + spacing * glm::ivec2(i, j);
            if (other.x < 0 || other.y < 0 || other.x >= extent.x || other.y >= extent.y) continue;
            const float its_material = *material_id.pixel(unsigned(other.x), unsigned(other.y));
            if (any_material ? its_material == 0.0f : its_material != material) continue;
            if (ranks_below(glm::uvec2(other), pixel))
                found.push_back(size_t(other.y) * size_t(extent.x) + size_t(other.x));
        }
}

double rgb_mean(const HostImage& image, size_t pixel) {
    const glm::dvec3 v = image.rgb(pixel);
    return (v.x + v.y + v.z) / 3;
}

/// The information of one pixel for others.
struct Knowledge {
    double samples = 0;
    double excess = 0;  ///< variance of its mean over the variance that is the target
    // Of its last pass and of what was before it, in the same unit; 0 without such a pass.
    double variance_before = 0, variance_of_pass = 0, log_growth = 0;
};

Knowledge knowledge(const ReferenceState& state, size_t pixel, double floor) {
    const Reference& reference = state.reference;
    const double radiance = std::max(rgb_mean(reference.specular.mean, pixel), floor);
    if (radiance <= 0) return {};
    const double unit = std::pow(state.settings.target_relative_error * radiance, 2);
    const double samples = reference.sample_count.values[pixel];
    Knowledge result{.samples = samples, .excess = rgb_mean(reference.specular.variance, pixel) / unit};
    if (state.earlier.values.empty()) return result;
    const double before = state.earlier.values[2 * pixel], added = samples - before;
    if (before <= 0 || added < 2 * before) return result;  // the exponent would be the ratio of two like numbers
    result.variance_before = state.earlier.values[2 * pixel + 1] / unit;
    // merge(): variance = (before / samples)^2 variance_before + (added / samples)^2 variance_of_pass.
    const double rest = result.excess * samples * samples - result.variance_before * before * before;
    result.variance_of_pass = std::max(rest, 0.0) / (added * added);
    result.log_growth = std::log(added / before);
    return result;
}

/// Samples^exponent that a pixel needs as far as its guide knows.
double need_of_guide(const ReferenceState& state, size_t pixel, double floor, double exponent) {
    if (state.guide_variance.values.empty()) return 0;
    const double radiance = std::max(rgb_mean(state.reference.guide.specular, pixel), floor);
    if (radiance <= 0) return 0;
    const double unit = std::pow(state.settings.target_relative_error * radiance, 2);
    return rgb_mean(state.guide_variance, pixel) / unit *
           std::pow(double(rounded_samples(state.settings.guide_samples)), exponent);
}

double decay_exponent(const std::vector<Knowledge>& knowledge, const std::vector<size_t>& informers) {
    double before = 0, after = 0, log_growth = 0, count = 0;
    for (const size_t i : informers) {
        if (knowledge[i].log_growth == 0) continue;
        before += knowledge[i].variance_before, after += knowledge[i].variance_of_pass;
        log_growth += knowledge[i].log_growth, ++count;
    }
    if (before <= 0 || after <= 0) return least_exponent;
    return std::clamp(std::log(before / after) * count / log_growth, least_exponent, largest_exponent);
}

}  // namespace

void find_informers(const HostImage& material_id, unsigned x, unsigned y, std::vector<size_t>& found) {
    const float material = *material_id.pixel(x, y);
    for (const int radius : {2, 4, 8}) {
        search(material_id, {x, y}, radius, material, false, found);
        if (found.size() >= enough_informers) return;
    }
    for (const int radius : {2, 4, 8, 16}) {
        search(material_id, {x, y}, radius, material, true, found);
        if (found.size() >= enough_informers) return;
    }
}

/// Needs are pooled as a root mean square: between their mean, which gives too little where few informers met a rare
/// bright path or noise differs from one pixel to the next, and the largest, which gives too much everywhere.
HostImage needed_samples(const ReferenceState& state) {
    const Reference& reference = state.reference;
    const double floor = radiance_floor(reference, reference.specular);
    std::vector<Knowledge> known(reference.sample_count.pixel_count());
    for (size_t i = 0; i < known.size(); ++i) known[i] = knowledge(state, i, floor);

    HostImage needed(reference.extent, 1);
    std::vector<size_t> informers;
    for (unsigned y = 0; y < reference.extent.y; ++y)
        for (unsigned x = 0; x < reference.extent.x; ++x) {
            if (*reference.material_id.pixel(x, y) == 0.0f) continue;
            find_informers(reference.material_id, x, y, informers);
            const double exponent = decay_exponent(known, informers);
            double squares = 0;
            for (const size_t i : informers)
                squares += std::pow(known[i].excess * std::pow(known[i].samples, exponent), 2);
            const double others = informers.empty() ? 0 : std::sqrt(squares / double(informers.size()));
            const double typical = std::max(others, need_of_guide(state, reference.extent.x * y + x, floor, exponent));
            if (typical <= 0) continue;
            *needed.pixel(x, y) = float(std::min(std::pow(safety * typical, 1 / exponent), double(max_sample_limit)));
        }
    return needed;
}

HostImage largest_factors(const ReferenceState& state) {
    const Reference& reference = state.reference;
    const HostImage error = relative_error(reference, reference.specular);
    const auto class_of = [&](size_t pixel) {
        return lattice(unsigned(pixel % reference.extent.x), unsigned(pixel / reference.extent.x)).coarseness();
    };
    constexpr size_t class_count = 2 * coarsest + 2;
    std::array<size_t, class_count> pixels{}, missed{};
    for (size_t i = 0; i < error.values.size(); ++i) {
        if (reference.material_id.values[i] == 0) continue;
        ++pixels[class_of(i)];
        missed[class_of(i)] += error.values[i] > state.settings.target_relative_error;
    }
    std::array<float, class_count> factors{};
    size_t coarser = 0, coarser_missed = 0;
    for (size_t c = class_count; c-- > 0;) {
        const bool is_missed = double(coarser_missed) > missed_share * double(coarser);
        factors[c] = coarser < enough_judges ? factor_without_judges : is_missed ? float(max_sample_limit) : 1.0f;
        coarser += pixels[c], coarser_missed += missed[c];
    }
    HostImage result(reference.extent, 1, 1.0f);
    for (size_t i = 0; i < result.values.size(); ++i)
        if (reference.material_id.values[i] != 0) result.values[i] = factors[class_of(i)];
    return result;
}
