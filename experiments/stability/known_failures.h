#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Why a stage of a technique as published holds NaN or Inf, in words: one entry of failures.json.
struct KnownFailure {
    std::vector<std::string> techniques;  ///< names of variants, or NAME:PRESET
    std::vector<std::string> stages;      ///< as "stage", or "stage: image"
    std::vector<std::string> cases;       ///< names, families or groups of cases; empty: all
    std::string operation;                ///< of the shader, that makes a finite value one that is not, or keeps it
    std::string mend;                     ///< how `corrected` or `best` avoids it
};

/// Fails with Error on unknown keys.
std::vector<KnownFailure> read_known_failures(const std::filesystem::path& file);

/// The file that comes with ssrlab.
std::filesystem::path known_failures_file();

/// What is not finite, and where.
struct FailurePlace {
    std::string variant, point, stage, image;
    std::string case_name, family, group;
};
/// The first entry that tells of `place`; null if none does.
const KnownFailure* explanation_of(const FailurePlace& place, const std::vector<KnownFailure>& known);
