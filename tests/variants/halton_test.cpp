#include "variants/common/halton.h"
#include "core/gpu/passes/pass_list.h"
#include "tests/variants/technique_fixture.h"
#include "variants/common/ggx_lobe.h"

#include <cstring>
#include <random>
#include <set>

namespace {

struct Halton : TechniqueTest {};

TEST_F(Halton, FillsEveryElementaryInterval) {
    // Each 2^a 3^b points in a row put one into every box of 2^-a by 3^-b.
    for (const unsigned first : {0u, 72u, 1440u}) {
        std::set<std::pair<int, int>> boxes;
        for (unsigned i = first; i < first + 72; ++i)
            boxes.insert({int(radical_inverse(i, 2) * 8 + 1e-4f), int(radical_inverse(i, 3) * 9 + 1e-4f)});
        EXPECT_EQ(boxes.size(), 72u);
    }
}

TEST_F(Halton, StaysBelowOne) {
    // All digits of these are the largest there are: their sums round to 1.
    for (const auto& [index, base] : {std::pair{0xffffffffu, 2u}, {0x1ffffffu, 2u}, {3486784400u, 3u}})
        EXPECT_EQ(radical_inverse(index, base), std::nextafter(1.0f, 0.0f)) << index;
}

/// Root mean square, over random boxes of the torus, of the difference between a box's area and its share of the first
/// 64 points of all sequences.
double unevenness(unsigned sequences) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    double squares = 0;
    const unsigned boxes = 2000;
    for (unsigned box = 0; box < boxes; ++box) {
        const glm::vec2 low(uniform(random), uniform(random)), size(uniform(random), uniform(random));
        unsigned inside = 0;
        for (unsigned n = 0; n < 64 * sequences; ++n) {
            const glm::vec2 p = rotated_halton(n / sequences, n % sequences, {1, 2, 3, 4});
            inside += glm::all(glm::lessThan(glm::fract(p - low), size));
        }
        const double off = double(inside) / (64.0 * sequences) - double(size.x) * double(size.y);
        squares += off * off / boxes;
    }
    return std::sqrt(squares);
}

TEST_F(Halton, FillsTheSquareTheMoreEvenlyTheMoreSequences) {
    // As fast as for independent sequences: equal ones would stay at 1, steps of radical inverses at 0.83, 0.77 and
    // 0.71 of the first; the bounds are 0.78, 0.64 and 0.55.
    for (const unsigned sequences : {2u, 3u, 4u})
        EXPECT_LT(unevenness(sequences), 1.1 * unevenness(1) / std::sqrt(sequences)) << sequences;
}

TEST_F(Halton, RotatesEachPixelSeedAndDimensionByItself) {
    // First points over pixels, seeds or dimensions are uniform: chi-square over 16 x 16 cells has 255 degrees of
    // freedom and a standard deviation of 22.6; 5 of them: a false alarm in 2 * 10^5, of the correlation in 10^6.
    for (int varied = 0; varied < 3; ++varied) {
        std::vector<double> count(256, 0.0);
        const unsigned points = 1 << 14;
        double correlation = 0;
        glm::vec2 last(0);
        for (unsigned n = 0; n < points; ++n) {
            glm::uvec4 key(5 | 9 << 16, 2, 0, 0);
            key[varied] = varied == 0 ? n % 128 | n / 128 << 16 : n;
            const glm::vec2 p = rotated_halton(3, 0, key);
            ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
            count[size_t(p.x * 16) * 16 + size_t(p.y * 16)] += 1;
            if (n > 0) correlation += (p.x - 0.5) * (last.x - 0.5) * 12 / points;
            last = p;
        }
        double chi_square = 0;
        for (const double found : count) chi_square += (found - points / 256.0) * (found - points / 256.0) / 64;
        EXPECT_NEAR(chi_square, 255, 5 * 22.6) << varied;
        EXPECT_NEAR(correlation, 0, 5 / std::sqrt(points)) << varied;
    }
}

struct LobeInput {
    glm::vec4 values;
    glm::uvec4 choice;
};

std::array<float, 7> on_the_cpu(const LobeInput& in) {
    const float alpha = ggx_alpha(in.values.w);
    const glm::vec3 o(std::sqrt(1 - in.values.z * in.values.z), 0, in.values.z);
    const LobeSample drawn = sample_lobe(in.choice.x, o, alpha, float(in.choice.y) / 256, in.values);
    const glm::vec2 point = rotated_halton(in.choice.z, in.choice.y & 3, in.choice);
    return {drawn.direction.x,
            drawn.direction.y,
            drawn.direction.z,
            drawn.inverse_density,
            lobe_density(in.choice.x, o, drawn.direction, alpha),
            point.x,
            point.y};
}

TEST_F(Halton, AndLobesAreTheSameOnTheDevice) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<LobeInput> inputs(10000);
    for (LobeInput& in : inputs)
        in = {{0.999f * uniform(random), uniform(random), 0.05f + 0.95f * uniform(random), uniform(random)},
              {random() % 2, random() % 250, uint32_t(random()) >> random() % 32, random()}};
    PassList pass_list(device(), {1, 1});
    const ParameterSet none;
    pass_list.begin_frame({}, none, {});
    const Buffer in = pass_list.buffer("Inputs", inputs.size() * sizeof inputs[0]),
                 out = pass_list.buffer("Values", inputs.size() * 8 * sizeof(float));
    pass_list.upload(in, std::as_bytes(std::span(inputs)));
    pass_list.compute("lobe_values.comp").use(in).use(out).dispatch_groups({(inputs.size() + 63) / 64, 1, 1});
    const std::vector<std::byte> bytes = pass_list.download(out);
    std::vector<float> values(inputs.size() * 8);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    for (size_t n = 0; n < inputs.size(); ++n) {
        const std::array<float, 7> expected = on_the_cpu(inputs[n]);
        for (size_t k = 0; k < expected.size(); ++k) {
            const double found = values[8 * n + k];
            double error = std::abs(found - expected[k]) / std::max(1e-3, std::abs(double(expected[k])));
            const bool is_direction = k<3, is_point = k> 4;
            if (is_direction) error = std::abs(found - expected[k]);
            if (is_point) {
                ASSERT_TRUE(found >= 0 && found < 1) << "input " << n;
            }
            if (is_point) error = std::abs(found - expected[k] - std::round(found - expected[k]));  // 0 and 1 are one
            // Vulkan asks for square roots and divisions to a few units in the last place. Densities take the square of
            // how far a normal of 1e-3 is from the pole, in float32: 1e-4 of it. Directions and points: 1e-6.
            ASSERT_LT(error, is_direction || is_point ? 1e-5 : 2e-2) << "number " << k << " of input " << n;
        }
    }
}

}  // namespace
