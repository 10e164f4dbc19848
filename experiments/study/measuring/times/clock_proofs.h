#pragma once
#include "core/gpu/passes/clock.h"

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

// Clock proofs as JSON: in the manifest, and kept in the cache.

/// As manifest.json has it in clock.proofs (experiments/RESULTS.md).
nlohmann::json clock_entry(const ClockProof& proof);

/// The proof of the clock that was kept in `folder` since the machine was started, of the same `maker` (provenance.h);
/// else what `prove` gives, kept if it passed: proving takes five seconds, and a clock stays what it is. A file that
/// cannot be read or written is as if it were not there; where the system does not tell its start, nothing is kept.
ClockProof kept_clock_proof(const std::filesystem::path& folder, const nlohmann::json& maker,
                            const std::function<ClockProof()>& prove);
