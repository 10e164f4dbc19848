#pragma once
#include "experiments/results/verdicts/judgement.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// What `ssrlab judge` says, for the terminal, the page and verdict.json.
struct VerdictText {
    std::string headline;              ///< the verdict, and what decides it
    std::vector<std::string> rules;    ///< what the words mean
    std::vector<std::string> numbers;  ///< each view's, the most certain first
    size_t deciding = 0;               ///< so many of `numbers` have the verdict of the whole; they come first

    /// The first lines of a page: the rules, and the most certain numbers that decide.
    std::vector<std::string> lead() const;
};

/// `before`: name of the earlier frames. `primary`: for the name of its metric.
VerdictText verdict_text(const Judgement& judged, const PrimaryComparisons& primary, const JudgeLimits& limits,
                         const std::string& before);

/// Of frames without earlier ones. `errors`: a sentence for each view.
VerdictText text_without_verdict(const std::vector<std::string>& errors);

/// Writes verdict.json into a results folder. `judged` is null without earlier frames.
void write_verdict(const std::filesystem::path& folder, const VerdictText& text, const Judgement* judged,
                   const JudgeLimits& limits);

/// What a page begins with.
struct VerdictLead {
    std::string headline;
    std::vector<std::string> sentences;
};

/// From verdict.json of a results folder; none if there is no such file. Fails with Error, naming the file, if it is
/// malformed.
std::optional<VerdictLead> read_verdict(const std::filesystem::path& folder);

/// Removes verdict.json, which was of other numbers.
void remove_verdict(const std::filesystem::path& folder);
