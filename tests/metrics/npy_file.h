#pragma once
#include "core/error.h"
#include "core/files.h"

#include <cstring>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <regex>

/// An array of a .npy file, version 1.0, in C order: uint8, float16 or float32, as float32.
struct NpyArray {
    std::vector<size_t> shape;
    std::vector<float> values;
};

inline NpyArray read_npy(const std::filesystem::path& file) {
    const std::string bytes = read_text(file);
    if (!bytes.starts_with(std::string("\x93NUMPY\x01\x00", 8))) fail(file.string(), " is no .npy file of version 1.0");
    const size_t header_size = uint8_t(bytes.at(8)) + 256 * size_t(uint8_t(bytes.at(9)));
    const std::string header = bytes.substr(10, header_size);
    static const std::regex form(R"(\{'descr': '(.*)', 'fortran_order': False, 'shape': \(([0-9, ]*)\), \}\s*)");
    std::smatch parts;
    if (!std::regex_match(header, parts, form)) fail(file.string(), " has the header ", header);
    NpyArray array;
    std::istringstream sizes(parts.str(2));
    for (std::string size; std::getline(sizes, size, ',');)
        if (size.find_first_not_of(' ') != std::string::npos) array.shape.push_back(std::stoul(size));
    const size_t count = std::accumulate(array.shape.begin(), array.shape.end(), size_t(1), std::multiplies<>());
    const size_t width = parts.str(1) == "|u1" ? 1 : parts.str(1) == "<f2" ? 2 : parts.str(1) == "<f4" ? 4 : 0;
    if (width == 0 || bytes.size() != 10 + header_size + count * width)
        fail(file.string(), " has another type or length than expected: ", header);
    const char* data = bytes.data() + 10 + header_size;
    array.values.resize(count);
    for (size_t i = 0; i < count; ++i) {
        if (width == 1) array.values[i] = float(uint8_t(data[i]));
        if (width == 4) std::memcpy(&array.values[i], data + 4 * i, 4);
        uint16_t half = 0;
        if (width == 2) std::memcpy(&half, data + 2 * i, 2), array.values[i] = glm::unpackHalf1x16(half);
    }
    return array;
}
