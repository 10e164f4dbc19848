#include "experiments/study/shots/shot_facts.h"

#include "groundtruth/reference/reference_audit.h"
#include "groundtruth/reference/reference_error.h"

#include <algorithm>

nlohmann::json fact_entries(const std::vector<SceneFact>& facts) {
    nlohmann::json entries = nlohmann::json::array();
    for (const SceneFact& fact : facts)
        entries.push_back({{"fact", fact.name}, {"value", fact.value}, {"why", fact.why}});
    return entries;
}

nlohmann::json reference_entry(const Reference& reference, unsigned frame, const Config& config) {
    std::vector<float> samples = reference.sample_count.values;
    std::ranges::nth_element(samples, samples.begin() + long(samples.size() / 2));
    const ErrorSummary error =
        relative_error_summary(reference, reference.is_lit_only() ? reference.diffuse : reference.specular);
    const ReferenceAudit audit = audit_reference(reference);
    nlohmann::json halves;
    for (const auto& [output, of_output] : audit.outputs)
        halves[output] = {{"mean_z_squared", of_output.mean_z_squared},
                          {"low", of_output.low},
                          {"high", of_output.high},
                          {"correlation", of_output.correlation},
                          {"most_correlation", of_output.most_correlation}};
    return {{"frame", frame},
            {"hash", reference.hash},
            {"lit_only", reference.is_lit_only()},
            {"samples_median", samples[samples.size() / 2]},
            {"passes", reference.passes},
            {"seconds", reference.seconds},
            {"rays", reference.rays},
            {"max_depth", config.reference.max_depth},
            {"target_relative_error", json_number(config.reference.target_relative_error)},
            {"relative_error", {{"median", error.median}, {"p95", error.p95}, {"mean", error.mean}}},
            {"reached_share", reference.reached_share},
            {"non_finite_samples", reference.non_finite_samples},
            {"halves", halves},
            {"light_cut", audit.light_cut},
            {"warnings", audit.warnings},
            {"from_cache", reference.from_cache}};
}
