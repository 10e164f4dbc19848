#include "variants/common/blue_noise.h"

#include "core/error.h"
#include "core/own_files.h"
#include "core/png.h"

#include <cmath>

namespace {

constexpr glm::uvec2 table_extent{128, 128};

/// What one frame adds to the two numbers, in units of 2^-32: the golden ratio with the digits of SSSR 1.5, and the
/// first two powers of 1 / 1.3247179572447460, the real root of x^3 = x + 1; both modulo 1.
glm::uvec2 shift_per_frame(NoiseShift shift) {
    switch (shift) {
        case NoiseShift::golden_diagonal:
        case NoiseShift::golden_diagonal_from_half:
            return glm::uvec2(0.61803398875 * 0x1p32);
        case NoiseShift::r2:
            return {0.7548776662466928 * 0x1p32, 0.5698402909980533 * 0x1p32};
        case NoiseShift::white:
            return {0, 0};
    }
    fail("no shift for NoiseShift ", int(shift));
}

/// Red and green of a file beside this one, of that extent.
HostImage two_channels(const std::string& name, glm::uvec2 extent) {
    const std::string file = (own_files() / "variants/common" / name).string();
    const HostImage rgb = read_png_codes(file);
    if (rgb.extent != extent)
        fail(file, " is ", rgb.extent.x, "x", rgb.extent.y, ", not ", extent.x, "x", extent.y, " as ssrlab's own");
    HostImage codes(extent, 2);
    for (size_t i = 0; i < codes.values.size(); ++i) codes.values[i] = rgb.values[i / 2 * 3 + i % 2];
    return codes;
}

}  // namespace

HostImage blue_noise_table() { return two_channels("blue_noise_table.png", table_extent); }

std::vector<uint8_t> blue_noise_texture() {
    const unsigned width = blue_noise_texture_width;
    const HostImage halves = two_channels("blue_noise_texture.png", {width, 2 * width});
    std::vector<uint8_t> texels(size_t(4) * width * width);
    for (size_t i = 0; i < texels.size(); ++i)
        texels[i] = uint8_t(std::lround(halves.values[(i % 4 / 2 * width * width + i / 4) * 2 + i % 2] * 255));
    return texels;
}

Image BlueNoise::uploaded(PassList& pass_list) {
    const Image table = pass_list.image_of("blue_noise_table", Format::rg8, table_extent);
    if (uploaded_table_.lock() != table.storage) {
        pass_list.upload(table, blue_noise_table());
        uploaded_table_ = table.storage;
    }
    return table;
}

Image BlueNoise::render(PassList& pass_list, NoiseShift shift, NoisePrecision precision, NoiseStage stage) {
    const Image table = uploaded(pass_list);
    const bool is_8_bit = precision == NoisePrecision::bits_8;
    const Image noise = pass_list.image_of("blue_noise", is_8_bit ? Format::rg8 : Format::rg32f, table_extent);
    const glm::uvec2 per_frame = shift_per_frame(shift);
    const bool is_drawn = stage == NoiseStage::fragment;
    PassList::Pass pass =
        is_drawn ? pass_list.fragment("common/blue_noise.frag") : pass_list.compute("common/blue_noise.comp");
    pass.read(table)
        .write(noise)
        .set("start", shift == NoiseShift::golden_diagonal_from_half ? 1u << 31 : 0u)
        .set("shift_x", per_frame.x)
        .set("shift_y", per_frame.y)
        .set("is_8_bit", unsigned(is_8_bit))
        .set("is_white", unsigned(shift == NoiseShift::white))
        .run();
    return noise;
}
