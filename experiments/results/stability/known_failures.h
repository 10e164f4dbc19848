#pragma once
#include "experiments/results/stability/stability_rows.h"

/// One entry of failures.json: why a stage of a published technique holds NaN or Inf.
struct KnownFailure {
    std::vector<std::string> techniques;  ///< names of techniques, or NAME:PRESET
    std::vector<std::string> stages;      ///< as "stage", or "stage: image"
    std::vector<std::string> cases;       ///< names, families or groups of cases; empty: all
    std::string operation;                ///< shader operation that makes a value non-finite, or keeps it so
    std::string fix;                      ///< how `corrected` or `best` avoids the failure

    bool operator==(const KnownFailure&) const = default;
};

/// Fails with Error on unknown keys.
std::vector<KnownFailure> read_known_failures(const std::filesystem::path& file);

/// The file that comes with ssrlab.
std::filesystem::path known_failures_file();

/// The first entry that explains a stage's values that are not finite, in a run of `what`; null if none does.
const KnownFailure* explanation_of(const StageRow& stage, const StabilityCaseName& what,
                                   const std::vector<KnownFailure>& known);
