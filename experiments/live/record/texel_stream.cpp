#include "experiments/live/record/texel_stream.h"

#include "experiments/report/image_encoding.h"
#include "experiments/report/median_edge.h"

#include <bit>
#include <cstdint>

TexelStream encode_floats(const HostImage& image) {
    const size_t pixels = image.pixel_count(), channels = image.channels;
    TexelStream stream{.shifts = {}, .bytes = std::vector<unsigned char>(pixels * channels * 4)};
    std::vector<int32_t> plane(pixels);
    for (size_t c = 0; c < channels; ++c) {
        uint32_t used = 0;
        for (size_t i = 0; i < pixels; ++i) used |= std::bit_cast<uint32_t>(image.values[i * channels + c]);
        const int shift = used ? std::countr_zero(used) : 0;
        stream.shifts.push_back(unsigned(shift));
        for (size_t i = 0; i < pixels; ++i) {
            const int32_t bits = std::bit_cast<int32_t>(image.values[i * channels + c]) >> shift;
            plane[i] = bits < 0 ? bits ^ (INT32_MAX >> shift) : bits;
        }
        for (size_t i = 0; i < pixels; ++i) {
            const uint32_t rest = uint32_t(plane[i]) - uint32_t(median_edge(plane, image.extent.x, i));
            const uint32_t code = rest << 1 ^ uint32_t(int32_t(rest) >> 31);
            for (size_t byte = 0; byte < 4; ++byte)
                stream.bytes[(c * 4 + byte) * pixels + i] = uint8_t(code >> 8 * byte);
        }
    }
    stream.bytes = compressed(stream.bytes, Redundancy::of_predictions);
    return stream;
}
