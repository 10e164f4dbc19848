#pragma once
#include "experiments/results/stability/stability_rows.h"

/// Why a stage of a technique as published holds NaN or Inf, in words: one entry of failures.json.
struct KnownFailure {
    std::vector<std::string> techniques;  ///< names of techniques, or NAME:PRESET
    std::vector<std::string> stages;      ///< as "stage", or "stage: image"
    std::vector<std::string> cases;       ///< names, families or groups of cases; empty: all
    std::string operation;                ///< of the shader, that makes a finite value one that is not, or keeps it
    std::string fix;                      ///< how `corrected` or `best` avoids it

    bool operator==(const KnownFailure&) const = default;
};

/// Fails with Error on unknown keys.
std::vector<KnownFailure> read_known_failures(const std::filesystem::path& file);

/// The file that comes with ssrlab.
std::filesystem::path known_failures_file();

/// The first entry that explains why the stage, of a run of `what`, is not finite; null if none does.
const KnownFailure* explanation_of(const StageRow& stage, const StabilityCaseName& what,
                                   const std::vector<KnownFailure>& known);
