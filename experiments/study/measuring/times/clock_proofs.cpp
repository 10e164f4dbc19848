#include "experiments/study/measuring/times/clock_proofs.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

#include <fstream>

namespace {

/// Anew whenever the machine is started; "" where the system has none.
std::string boot_id() {
    std::string id;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), id);
    return id;
}

ClockProof proof_of(const nlohmann::json& entry) {
    ClockProof proof{.method = entry.at("method"), .empty_submit_ms = entry.at("empty_submit_ms"), .checks = {}};
    for (const nlohmann::json& c : entry.at("checks")) {
        ClockCheck& check = proof.checks.emplace_back(ClockCheck{.stage_kind = c.at("stage_kind")});
        check.measured_ms = c.at("measured_ms").get<std::vector<double>>();
        if (check.measured_ms.size() != check.expected.size()) fail("a check of a clock without all its times");
        if (!c.at("foreign_load").is_null()) check.foreign_load = c.at("foreign_load").get<double>();
        judge(check);  // which the file has no say in
        check.attempts = c.at("attempts");
    }
    if (proof.checks.size() != 3) fail("a proof of a clock has three checks");
    return proof;
}

}  // namespace

nlohmann::json clock_entry(const ClockProof& proof) {
    nlohmann::json checks = nlohmann::json::array();
    for (const ClockCheck& c : proof.checks) {
        checks.push_back({{"stage_kind", c.stage_kind},
                          {"expected", c.expected},
                          {"measured_ms", c.measured_ms},
                          {"ratio", c.ratio},
                          {"foreign_load", nullptr},
                          {"attempts", c.attempts},
                          {"verdict", name_of(c.verdict)}});
        if (c.foreign_load) checks.back()["foreign_load"] = *c.foreign_load;
    }
    return {{"method", proof.method},
            {"empty_submit_ms", proof.empty_submit_ms},
            {"verdict", name_of(proof.verdict())},
            {"checks", checks}};
}

ClockProof kept_clock_proof(const std::filesystem::path& folder, const nlohmann::json& maker,
                            const std::function<ClockProof()>& prove) {
    const std::string start = boot_id();
    if (start.empty()) return prove();
    ContentHash hash;
    hash.add(maker.dump() + start);
    const std::filesystem::path file = folder / ("clock-" + hash.hex() + ".json");
    try {
        if (std::error_code error; std::filesystem::exists(file, error))
            if (ClockProof kept = proof_of(read_json(file)); kept.verdict() == ClockVerdict::passed) return kept;
    } catch (const Error&) {
    } catch (const nlohmann::json::exception&) {
    }
    ClockProof proof = prove();
    if (proof.verdict() == ClockVerdict::passed) try {
            std::filesystem::create_directories(folder);
            write_text(file, clock_entry(proof).dump(1) + "\n");
        } catch (const Error&) {
        } catch (const std::filesystem::filesystem_error&) {
        }
    return proof;
}
