// The judge of the clock on made-up times; what a machine's own clock gives is a study's to report, not a test's.
#include "core/gpu/passes/clock.h"
#include "core/gpu/device.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

ClockCheck judged(std::vector<double> measured_ms, std::optional<double> foreign_load = 0.0) {
    ClockCheck check{.measured_ms = std::move(measured_ms), .foreign_load = foreign_load};
    judge(check);
    return check;
}

}  // namespace

TEST(ClockJudge, PassesTheRatiosOfTheWork) {
    EXPECT_EQ(judged({0.3, 3, 30}).verdict, ClockVerdict::passed);
    EXPECT_EQ(judged({0.33, 3.2, 30}).verdict, ClockVerdict::passed);
    EXPECT_EQ(judged({0.3, 3, 30}, {}).verdict, ClockVerdict::passed);
    EXPECT_EQ(judged({0.3, 3, 30}, 0.9).verdict, ClockVerdict::passed)
        << "a busy machine cannot make wrong times right";
    EXPECT_DOUBLE_EQ(judged({0.3, 3, 30}).ratio[0], 1.0);
}

TEST(ClockJudge, FailsOthersOnAQuietMachine) {
    EXPECT_EQ(judged({0.565, 6.57, 100}).verdict, ClockVerdict::failed);
    EXPECT_EQ(judged({1, 10, 70}).verdict, ClockVerdict::failed);
    EXPECT_EQ(judged({0, 10, 100}).verdict, ClockVerdict::failed) << "work that takes no time";
    EXPECT_EQ(judged({10, 100, 1}).verdict, ClockVerdict::failed) << "stamps one pass late";
    EXPECT_EQ(judged({11, 110, 111}).verdict, ClockVerdict::failed) << "stamps that enclose the neighbour";
    EXPECT_EQ(judged({0, 0, 0}).verdict, ClockVerdict::failed);
    EXPECT_EQ(judged({NAN, 10, 100}).verdict, ClockVerdict::failed);
    EXPECT_EQ(judged({0.5, 10, 100}, {}).verdict, ClockVerdict::failed) << "without a known load the verdict stands";
    EXPECT_EQ(judged({0.5, 10, 100}, disturbing_load).verdict, ClockVerdict::failed);
}

TEST(ClockJudge, DoesNotJudgeWhereOthersAreAtWork) {
    EXPECT_EQ(judged({0.565, 6.57, 100}, 0.3).verdict, ClockVerdict::not_judged);
    EXPECT_EQ(judged({0, 0, 0}, 0.3).verdict, ClockVerdict::not_judged);
}

TEST(ClockJudge, ProofIsAsGoodAsItsWorstCheck) {
    const auto proof = [](std::vector<ClockVerdict> verdicts) {
        ClockProof proof;
        for (const ClockVerdict verdict : verdicts) proof.checks.push_back({.verdict = verdict});
        return proof.verdict();
    };
    using enum ClockVerdict;
    EXPECT_EQ(proof({passed, passed}), passed);
    EXPECT_EQ(proof({passed, not_judged, passed}), not_judged);
    EXPECT_EQ(proof({passed, not_judged, failed}), failed);
    EXPECT_EQ(proof({}), not_judged);
}

TEST(Clock, IsProvenByThreeKindsOfStages) {
    Device device;
    // A machine that is said to be busy: whatever the times are, nothing is blamed on the clock.
    double seconds = 0;
    const ClockProof proof = prove_clock(device, [&] {
        seconds += 1;
        return CpuTimes{.machine = 2 * seconds, .own = 0, .wall = seconds, .cpus = 2};
    });
    ASSERT_EQ(proof.checks.size(), 3u);
    EXPECT_GT(proof.empty_submit_ms, 0.0);
    for (const ClockCheck& check : proof.checks) {
        EXPECT_NE(check.verdict, ClockVerdict::failed);
        EXPECT_EQ(check.foreign_load, 1.0);
        EXPECT_EQ(check.measured_ms.size(), 3u);
        EXPECT_LE(check.attempts, clock_attempts);
        std::printf("%s %s: %s, %.3f %.3f %.3f ms, ratio %.3f : %.2f : %.0f, empty submit %.3f ms\n",
                    proof.method.c_str(), check.stage_kind.c_str(), name_of(check.verdict), check.measured_ms[0],
                    check.measured_ms[1], check.measured_ms[2], check.ratio[0], check.ratio[1], check.ratio[2],
                    proof.empty_submit_ms);
    }
}
