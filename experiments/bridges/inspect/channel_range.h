#pragma once
#include "core/host_image.h"

#include <cstddef>
#include <nlohmann/json.hpp>

/// Statistics of one channel of an image.
struct ChannelRange {
    float least = 0.0f, largest = 0.0f;  ///< of finite values; 0 if there are none
    double mean = 0.0;                   ///< of finite values; 0 if there are none
    size_t nan = 0, infinite = 0;        ///< values that are NaN, or +-infinity
};

/// `channel` < image.channels.
ChannelRange channel_range(const HostImage& image, unsigned channel);

nlohmann::ordered_json to_json(const ChannelRange& range);
