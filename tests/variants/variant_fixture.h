#pragma once
#include "core/gpu/device.h"
#include "variants/registry.h"

#include <gtest/gtest.h>

/// One device for all tests of the program; every test ends with a silent validation layer.
struct VariantTest : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }
};
