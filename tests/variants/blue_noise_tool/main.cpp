#include "core/error.h"
#include "core/png.h"
#include "tests/variants/blue_noise_generator.h"

#include <cstdio>

/// Two channels of codes, as v / 255.
static void write_codes(const char* file, const HostImage& codes) {
    HostImage rgb(codes.extent, 3);
    for (size_t i = 0; i < codes.values.size(); ++i)
        rgb.values[i / 2 * 3 + i % 2] = linear_from_srgb(codes.values[i]);  // write_png() turns it into the code again
    write_png(file, rgb);
}

/// Writes what variants/common has of blue noise: blue_noise_tool TABLE.png TEXTURE.png.
int main(int argument_count, char** arguments) try {
    if (argument_count != 3)
        fail("blue_noise_tool takes the names of two PNG files, not ", argument_count - 1, " arguments");
    write_codes(arguments[1], make_blue_noise_table());
    const std::vector<uint8_t> texels = make_blue_noise_texture();
    HostImage halves({64, 128}, 2);  // red and green above, blue and alpha below
    for (size_t i = 0; i < texels.size(); ++i)
        halves.values[(i % 4 / 2 * 64 * 64 + i / 4) * 2 + i % 2] = float(texels[i]) / 255;
    write_codes(arguments[2], halves);
    return 0;
} catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
