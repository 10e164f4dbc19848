#pragma once
#include "core/gpu/format.h"

#include <string>

/// "VK_FORMAT_R16G16B16A16_SFLOAT".
std::string vulkan_name(Format format);
