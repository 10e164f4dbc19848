#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

enum class Format {
    r8,
    rg8,
    rgba8,
    rgba8_srgb,
    r16f,
    rg16f,
    rgba16f,
    r32f,
    rg32f,
    rgba32f,
    r11g11b10f,
    r32ui,
    d32f,
    d24,
    d16,
    d32f_s8
};

/// A named 2D image of the pass_list, or one mip level of it. Copies refer to the same pixels.
struct Image {
    std::string name;  ///< also the name of the sampler, image or output variable in the shaders
    Format format{};
    glm::uvec2 extent{0, 0};
    unsigned mips = 1, first_mip = 0;
    std::shared_ptr<struct ImageStorage> storage;

    Image mip(unsigned level) const;          ///< counted from first_mip; half the extent for each, at least 1
    Image as(std::string shader_name) const;  ///< the same image, bound to another variable
};

/// Bytes of all mips of the view, without padding.
uint64_t bytes_of(const Image& image);

/// The whole image that a mip belongs to.
struct WholeImage {
    glm::uvec2 extent;
    unsigned mips;
};
WholeImage whole_of(const Image& image);

/// A named storage buffer: ray lists, counters, indirect arguments. Copies refer to the same bytes.
struct Buffer {
    std::string name;  ///< also the block name in the shaders
    size_t size = 0;   ///< bytes
    std::shared_ptr<struct BufferStorage> storage;

    Buffer as(std::string shader_name) const;  ///< the same bytes, bound to another block
};
