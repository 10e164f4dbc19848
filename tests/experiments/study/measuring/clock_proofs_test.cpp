#include "experiments/study/measuring/times/clock_proofs.h"
#include "core/files.h"
#include "core/json.h"

#include <gtest/gtest.h>

namespace fs = std::filesystem;

TEST(KeptClockProof, IsMadeOnceForEachMakerAndOnlyKeptIfItPassed) {
    const fs::path folder = fs::temp_directory_path() / "kept_clock_proof_test";
    fs::remove_all(folder);
    unsigned proven = 0;
    ClockCheck check{.stage_kind = "compute", .measured_ms = {1.0, 1.0, 1.0}, .foreign_load = 0.01, .attempts = 2};
    const auto proof_of = [&](const std::string& maker) {
        return kept_clock_proof(folder, {{"device", maker}}, [&] {
            ++proven;
            judge(check);
            return ClockProof{.method = "host_fence", .empty_submit_ms = 0.25, .checks = {check, check, check}};
        });
    };
    proof_of("a");
    EXPECT_EQ(proof_of("a").verdict(), ClockVerdict::failed);
    EXPECT_EQ(proven, 2u);

    check.measured_ms = {1.0, 10.0, 100.0};
    const ClockProof made = proof_of("a"), kept = proof_of("a");
    EXPECT_EQ(proven, 3u);
    EXPECT_EQ(kept.verdict(), ClockVerdict::passed);
    EXPECT_EQ(clock_entry(kept), clock_entry(made));
    proof_of("b");
    EXPECT_EQ(proven, 4u) << "of another device";

    // What a file claims is judged again, and a broken one is none.
    for (const auto& file : fs::directory_iterator(folder)) {
        nlohmann::json entry = read_json(file);
        for (const char* key : {"measured_ms", "expected"}) entry["checks"][0][key] = {1.0, 1.0, 1.0};
        write_text(file.path(), entry.dump());
    }
    proof_of("a");
    EXPECT_EQ(proven, 5u);
    for (const auto& file : fs::directory_iterator(folder)) write_text(file.path(), "{\"method\": 1}");
    EXPECT_EQ(proof_of("a").verdict(), ClockVerdict::passed);
    EXPECT_EQ(proven, 6u);
    fs::remove_all(folder);
}
