#include "experiments/report/image_encoding.h"

#include "core/error.h"
#include "experiments/report/median_edge.h"
#include "experiments/results/files/verdict_map.h"

#include <half.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace {

/// Integers in the order of the half floats that the bits stand for; no two are equal.
int16_t ordered(uint16_t bits) { return int16_t(bits < 0x8000 ? bits : 0x7fff - bits); }

}  // namespace

std::vector<unsigned char> encode_halves(const HostImage& rgb, size_t& clamped, unsigned significand_bits) {
    const size_t pixels = rgb.pixel_count(), count = pixels * 3;
    std::array<std::vector<int16_t>, 3> planes;
    for (std::vector<int16_t>& plane : planes) plane.resize(pixels);
    clamped = 0;
    for (size_t i = 0; i < pixels; ++i) {
        bool is_beyond = false;
        std::array<int16_t, 3> channels;
        for (size_t c = 0; c < 3; ++c) {
            float value = rgb.values[i * 3 + c];
            if (std::isfinite(value) && std::abs(value) > 65504.0f) {
                is_beyond = true;
                value = std::copysign(65504.0f, value);
            }
            channels[c] = int16_t(ordered(half(value).round(significand_bits).bits()) >> (10 - significand_bits));
        }
        planes[0][i] = channels[1];
        planes[1][i] = int16_t(channels[0] - channels[1]), planes[2][i] = int16_t(channels[2] - channels[1]);
        clamped += is_beyond;
    }
    std::vector<unsigned char> bytes(2 * count);
    for (size_t p = 0; p < 3; ++p)
        for (size_t i = 0; i < pixels; ++i) {
            const int16_t left = int16_t(planes[p][i] - median_edge(planes[p], rgb.extent.x, i));
            const uint16_t code = uint16_t(left << 1 ^ left >> 15);
            bytes[p * pixels + i] = code & 255;
            bytes[count + p * pixels + i] = code >> 8;
        }
    return compressed(bytes, Redundancy::of_predictions);
}

std::vector<unsigned char> encode_bytes(const HostImage& image) {
    std::vector<unsigned char> bytes(image.pixel_count());
    for (size_t i = 0; i < bytes.size(); ++i) {
        const float value = image.values[i * image.channels];
        bytes[i] =
            std::isfinite(value) ? static_cast<unsigned char>(std::lround(254 * std::clamp(value, 0.0f, 1.0f))) : 255;
    }
    return compressed(bytes);
}

std::vector<unsigned char> encode_palette(const HostImage& rgb, json& palette) {
    std::map<std::array<int, 3>, size_t> places;
    palette = json::array();
    std::vector<unsigned char> bytes(rgb.pixel_count());
    for (size_t i = 0; i < bytes.size(); ++i) {
        std::array<int, 3> color;
        for (size_t c = 0; c < 3; ++c)
            color[c] =
                int(std::lround(255 * std::pow(std::clamp(rgb.values[i * 3 + c], 0.0f, 1.0f), 1 / verdict_map_gamma)));
        const auto [place, is_new] = places.emplace(color, places.size());
        if (is_new) palette.push_back(color);
        if (places.size() > 256) fail("a map of verdicts has more than 256 colours");
        bytes[i] = static_cast<unsigned char>(place->second);
    }
    return compressed(bytes);
}

std::vector<unsigned char> compressed(const std::vector<unsigned char>& bytes, Redundancy redundancy) {
    // Of what is left of predictions runs repeat and nothing else: Z_RLE is four times as fast, and the result smaller.
    const int strategy = redundancy == Redundancy::of_predictions ? Z_RLE : Z_DEFAULT_STRATEGY;
    z_stream stream{};
    constexpr int level = 6, window_bits = 15, memory_level = 8;
    if (deflateInit2(&stream, level, Z_DEFLATED, window_bits, memory_level, strategy) != Z_OK)
        fail_machine("not enough memory to compress a part of a page");
    std::vector<unsigned char> packed(deflateBound(&stream, bytes.size()));
    stream.next_in = const_cast<unsigned char*>(bytes.data()), stream.avail_in = uInt(bytes.size());
    stream.next_out = packed.data(), stream.avail_out = uInt(packed.size());
    const int result = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) fail_machine("a part of a page could not be compressed");
    return packed;
}

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](size_t k) { return i + k < bytes.size() ? unsigned(bytes[i + k]) : 0u; };
        const unsigned group = at(0) << 16 | at(1) << 8 | at(2);
        for (int shift = 18; shift >= 0; shift -= 6) text += digits[group >> shift & 63];
    }
    for (size_t pad = 0; pad < (3 - bytes.size() % 3) % 3; ++pad) text[text.size() - 1 - pad] = '=';
    return text;
}
