#include "core/error.h"
#include "core/png.h"
#include "variants/common/blue_noise_generator.h"

#include <cstdio>

/// Writes the table of blue noise: blue_noise_tool FILE.png.
int main(int argument_count, char** arguments) try {
    if (argument_count != 2)
        fail("blue_noise_tool takes the name of a PNG file, not ", argument_count - 1, " arguments");
    const HostImage table = make_blue_noise_table();
    HostImage rgb(table.extent, 3);
    for (size_t i = 0; i < table.values.size(); ++i)
        rgb.values[i / 2 * 3 + i % 2] = linear_from_srgb(table.values[i]);  // write_png() turns it into the code again
    write_png(arguments[1], rgb);
    return 0;
} catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
