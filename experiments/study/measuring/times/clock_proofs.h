#pragma once
#include "core/gpu/passes/clock.h"

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

// Clock proofs as JSON: in the manifest, and kept in the cache.

/// The entry of manifest.json's clock.proofs (experiments/docs/results_folder.md).
nlohmann::json clock_entry(const ClockProof& proof);

/// The clock's proof that was kept in `folder` since the machine started, by the same `maker` (provenance.h). Else the
/// result of `prove`, kept if it passed, since proving takes five seconds. Unreadable files count as absent, and
/// failures to write are ignored. Nothing is kept where the system does not state its start.
ClockProof kept_clock_proof(const std::filesystem::path& folder, const nlohmann::json& maker,
                            const std::function<ClockProof()>& prove);
