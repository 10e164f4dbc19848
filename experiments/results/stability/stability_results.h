#pragma once
#include "experiments/results/files/comparisons.h"
#include "experiments/results/stability/known_failures.h"
#include "experiments/results/stability/stability_rows.h"

/// The tables that `ssrlab stability` writes into a folder.
struct StabilityResults {
    std::vector<StabilityRow> rows;
    std::vector<StabilityCaseName> cases;  ///< as far as stability_cases.csv has them
    std::vector<StageRow> stages;
};

/// Nothing where there are none. Fails with Error, naming file and line, where a table is malformed.
StabilityResults read_stability_results(const std::filesystem::path& folder);

/// An image of a stage that is not finite in runs of one technique.
struct StageFailure {
    std::string technique, place;  ///< "stage: image"
    std::vector<std::string> points, cases;
    size_t nan = 0, infinite = 0;
    size_t first = 0;        ///< runs in which no stage before it fails
    size_t unexplained = 0;  ///< those of them that failures.json does not explain
    std::vector<KnownFailure> known;

    /// What is not only had what other stages passed it.
    bool is_source() const { return first > 0 || !known.empty(); }
};

/// By technique and place, in the order of stability_stages.csv.
std::vector<StageFailure> stage_failures(const StabilityResults& tables);

/// What the tables say, in a few sentences.
std::string stability_lead(const StabilityResults& tables);

/// How many cases each technique got each verdict in, in the order of stability.csv.
std::vector<std::pair<std::string, std::vector<size_t>>> verdict_counts(const std::vector<StabilityRow>& rows);

/// The sources among the failures, and how they are fixed, as a table for terminals.
std::string failures_text(const std::vector<StageFailure>& failures);

/// The values of the section `stability` of page/no_scripts.html: the lead, how often each technique got each
/// verdict, and the failures.
nlohmann::json stability_without_scripts(const StabilityResults& tables);
