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

/// Reads the tables; empty where there are none. Fails with Error, naming file and line, where a table is malformed.
StabilityResults read_stability_results(const std::filesystem::path& folder);

/// An image of a stage that is not finite in runs of one technique.
struct StageFailure {
    std::string technique, place;  ///< "stage: image"
    std::vector<std::string> points, cases;
    size_t nan = 0, infinite = 0;
    size_t first = 0;        ///< runs in which no earlier stage fails
    size_t unexplained = 0;  ///< runs among `first` that failures.json does not explain
    std::vector<KnownFailure> known;

    /// Whether the stage itself fails, not only earlier stages whose values it reads.
    bool is_source() const { return first > 0 || !known.empty(); }
};

/// The failures of all stages by technique and place, in the order of stability_stages.csv.
std::vector<StageFailure> stage_failures(const StabilityResults& tables);

/// A summary of the tables in a few sentences.
std::string stability_lead(const StabilityResults& tables);

/// For each technique, the number of cases with each verdict, in the order of stability.csv.
std::vector<std::pair<std::string, std::vector<size_t>>> verdict_counts(const std::vector<StabilityRow>& rows);

/// The failures that are sources, and their fixes, as a table for terminals.
std::string failures_text(const std::vector<StageFailure>& failures);

/// The stages in which NaN or Inf may remain unseen, and the number of products with a constant 0 in each, of which the
/// driver may make 0 whatever the other number is. "" if there are none. `rows`: as run_stability() returns them.
std::string hidden_text(const std::vector<StabilityRow>& rows);

/// The values of the section `stability` of page/no_scripts.html: the lead, how often each technique got each
/// verdict, and the failures.
nlohmann::json stability_without_scripts(const StabilityResults& tables);
