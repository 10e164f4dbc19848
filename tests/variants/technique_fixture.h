#pragma once
#include "core/gpu/device.h"
#include "variants/registry.h"

#include <gtest/gtest.h>

/// One channel, in whichever image it is.
inline HostImage download_confidence(PassList& pass_list, const Reflections& reflections) {
    const HostImage all = pass_list.download(reflections.confidence);
    HostImage confidence(all.extent, 1);
    for (size_t i = 0; i < confidence.values.size(); ++i)
        confidence.values[i] = all.values[i * all.channels + reflections.confidence_channel];
    return confidence;
}

/// One device for all tests of the program; every test ends with a silent validation layer.
struct TechniqueTest : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }
};
