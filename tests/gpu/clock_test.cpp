#include "core/gpu/clock.h"
#include "core/gpu/device.h"

#include <gtest/gtest.h>

TEST(Clock, SeesWorkInItsTrueRatio) {
    Device device;
    const ClockProof proof = prove_clock(device);
    EXPECT_TRUE(proof.passed());
    EXPECT_GT(proof.empty_submit_ms, 0.0);
    for (const ClockCheck& check : proof.checks)
        std::printf("%s %s: %.3f %.3f %.3f ms, ratio %.1f : %.1f : %.1f, empty submit %.3f ms\n", proof.method.c_str(),
                    check.stage_kind.c_str(), check.measured_ms[0], check.measured_ms[1], check.measured_ms[2],
                    check.ratio[0], check.ratio[1], check.ratio[2], proof.empty_submit_ms);
}
