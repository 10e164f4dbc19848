#include "tests/variants/blue_noise_generator.h"
#include "variants/common/blue_noise.h"
#include "variants/common/halton.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr int texture_width = blue_noise_texture_width, texture_texels = texture_width * texture_width;

/// Texels of a pattern that wraps around, and how crowded each place is: the sum over the texels that are set of a
/// Gaussian of 1.5 texels, Ulichney's, in units of 2^-20.
class Pattern {
public:
    Pattern() {
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x)
                weights_.push_back(int(std::lround(0x1p20 * std::exp((x * x + y * y) / -4.5))));
    }
    void set(int texel, bool is_set) {
        is_set_[texel] = is_set;
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                const int row = (texel / texture_width + y) & (texture_width - 1),
                          column = (texel + x) & (texture_width - 1);
                const int weight = weights_[(y + radius) * (2 * radius + 1) + x + radius];
                crowding_[row * texture_width + column] += is_set ? weight : -weight;
            }
    }
    bool is_set(int texel) const { return is_set_[texel]; }
    int tightest_cluster() const { return extreme(true); }
    int largest_void() const { return extreme(false); }

private:
    /// Where the Gaussian is 2^-16.
    static constexpr int radius = 7;

    /// The most crowded of the texels that are set, or the least crowded of the others.
    int extreme(bool of_set) const {
        int found = -1;
        for (int texel = 0; texel < texture_texels; ++texel) {
            if (is_set_[texel] != of_set) continue;
            if (found < 0 || (of_set ? crowding_[texel] > crowding_[found] : crowding_[texel] < crowding_[found]))
                found = texel;
        }
        return found;
    }

    std::vector<int> weights_;
    std::vector<bool> is_set_ = std::vector<bool>(texture_texels);
    std::vector<int> crowding_ = std::vector<int>(texture_texels);
};

/// A tenth of the texels at random, each moved from the tightest cluster to the largest void until these are one place.
Pattern initial_pattern(unsigned channel) {
    Pattern pattern;
    for (unsigned i = 0, count = 0; count < texture_texels / 10; ++i) {
        const int texel = int(pcg4d({i, channel, 0, 0}).x % texture_texels);
        if (pattern.is_set(texel)) continue;
        pattern.set(texel, true);
        ++count;
    }
    for (;;) {
        const int moved = pattern.tightest_cluster();
        pattern.set(moved, false);
        const int place = pattern.largest_void();
        pattern.set(place, true);
        if (place == moved) return pattern;
    }
}

/// The order in which texels are set: those of the initial pattern from its sparsest arrangement on, then always the
/// largest void. Beyond the half Ulichney looks for the tightest cluster of what is not set, which is the same texel.
std::vector<int> ranks(unsigned channel) {
    Pattern pattern = initial_pattern(channel), removed = pattern;
    std::vector<int> rank(texture_texels);
    const int initial_count = texture_texels / 10;
    for (int i = initial_count - 1; i >= 0; --i) {
        const int texel = removed.tightest_cluster();
        removed.set(texel, false);
        rank[texel] = i;
    }
    for (int i = initial_count; i < texture_texels; ++i) {
        const int texel = pattern.largest_void();
        pattern.set(texel, true);
        rank[texel] = i;
    }
    return rank;
}

}  // namespace

std::vector<uint8_t> make_blue_noise_texture() {
    std::vector<uint8_t> texels(4 * texture_texels);
    for (unsigned channel = 0; channel < 4; ++channel) {
        const std::vector<int> rank = ranks(channel);
        for (int i = 0; i < texture_texels; ++i) texels[4 * i + channel] = uint8_t(rank[i] * 256 / texture_texels);
    }
    return texels;
}
