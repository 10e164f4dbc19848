#pragma once
#include <zlib.h>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// Writes PNGs of every kind (ISO/IEC 15948) for tests, by zlib alone.
struct PngWriter {
    unsigned width = 1, height = 1, depth = 8;
    unsigned color = 2;  ///< 0 grey, 2 RGB, 3 palette, 4 grey with alpha, 6 RGB with alpha
    bool is_interlaced = false;
    std::vector<std::pair<std::string, std::string>> chunks = {};  ///< types and data, between IHDR and IDAT
    std::function<unsigned(unsigned x, unsigned y, unsigned channel)> sample = [](unsigned, unsigned, unsigned) {
        return 0u;
    };

    unsigned channels() const { return color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1; }

    std::string file() const {
        std::string bytes = "\x89PNG\r\n\x1A\n";
        bytes += chunk("IHDR", integer(width) + integer(height) + char(depth) + char(color) + std::string(2, '\0') +
                                   char(is_interlaced));
        for (const auto& [type, data] : chunks) bytes += chunk(type, data);
        std::string rows, packed;
        if (is_interlaced)  // section 8.2, Adam7: the first column and row of each pass, and the steps between them
            for (const auto& [x, y, dx, dy] : std::vector<std::array<unsigned, 4>>{
                     {0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}})
                add_rows(rows, x, y, dx, dy);
        else
            add_rows(rows, 0, 0, 1, 1);
        uLongf size = compressBound(uLong(rows.size()));
        packed.resize(size);
        compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                 uLong(rows.size()));
        packed.resize(size);
        return bytes + chunk("IDAT", packed) + chunk("IEND", "");
    }

    static std::string integer(uint32_t value) {
        return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
    }
    static std::string chunk(const std::string& type, const std::string& data) {
        const std::string typed = type + data;
        const auto sum = crc32(0, reinterpret_cast<const Bytef*>(typed.data()), uInt(typed.size()));
        return integer(uint32_t(data.size())) + typed + integer(uint32_t(sum));
    }

private:
    /// Samples lie in bits from the highest of each byte on; each row begins with a filter's number, here 0.
    void add_rows(std::string& rows, unsigned x0, unsigned y0, unsigned dx, unsigned dy) const {
        for (unsigned y = y0; y < height && x0 < width; y += dy) {
            rows += '\0';
            unsigned bits = 0, filled = 0;
            for (unsigned x = x0; x < width; x += dx)
                for (unsigned c = 0; c < channels(); ++c) {
                    bits = bits << depth | sample(x, y, c), filled += depth;
                    for (; filled >= 8; filled -= 8) rows += char(bits >> (filled - 8));
                }
            if (filled > 0) rows += char(bits << (8 - filled));
        }
    }
};
