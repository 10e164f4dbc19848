#include "experiments/bridges/shader_export/vulkan_names.h"

#include <cctype>
#include <vulkan/vulkan.hpp>

std::string vulkan_name(Format format) {
    const std::string words = vk::to_string(facts_of(format).vulkan);  // "R16G16B16A16Sfloat"
    const auto is_lower = [&](size_t i) {
        return i < words.size() && std::islower(static_cast<unsigned char>(words[i]));
    };
    std::string name = "VK_FORMAT_";
    for (size_t i = 0; i < words.size(); ++i) {
        if (i > 0 && std::isupper(static_cast<unsigned char>(words[i])) && (is_lower(i - 1) || is_lower(i + 1)))
            name += '_';
        name += char(std::toupper(static_cast<unsigned char>(words[i])));
    }
    return name;
}
