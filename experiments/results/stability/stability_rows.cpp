#include "experiments/results/stability/stability_rows.h"

#include "core/error.h"

#include <cmath>

namespace {

/// An error this much larger, as a ratio and in the units of relative_error(), is one that a picture shows.
constexpr double worse_ratio = 1.5, worse_by = 0.02;

}  // namespace

const std::vector<VerdictName>& verdict_names() {
    static const std::vector<VerdictName> names = {
        {"ok", "finite in every stage, and about as wrong as in the benign case"},
        {"worse", "finite in every stage, but more than 1.5 times as wrong as in the benign case"},
        {"out of range", "finite, but negative, brighter than all light, or of a confidence outside [0, 1]"},
        {"non-finite inside", "a stage holds NaN or Inf; the result, where its inputs are finite, does not"},
        {"spreads", "the result is NaN or Inf where the inputs are finite"},
        {"refused", "not rendered: the reason is in stability.csv"}};
    return names;
}

std::string csv_field(Verdict verdict) { return verdict_names()[size_t(verdict)].name; }

void read_field(const CsvReader& csv, size_t place, Verdict& verdict) {
    const auto found = std::ranges::find(verdict_names(), csv.text(place), &VerdictName::name);
    if (found == verdict_names().end()) fail("stability.csv: unknown verdict '", csv.text(place), "'");
    verdict = Verdict(found - verdict_names().begin());
}

void set_errors(StabilityRow& row, std::optional<double> error, std::optional<double> benign_error) {
    row.error = error, row.benign_error = benign_error, row.error_ratio.reset();
    if (error && benign_error && *benign_error > 0) row.error_ratio = *error / *benign_error;
}

Verdict verdict_of(const StabilityRow& row) {
    if (!row.refusal.empty()) return Verdict::refused;
    if (row.spread_pixels > 0) return Verdict::spreads;
    if (row.non_finite > 0) return Verdict::inside;
    if (row.out_of_range() > 0) return Verdict::out_of_range;
    const bool is_worse = row.error && row.benign_error && *row.error > worse_ratio * *row.benign_error &&
                          *row.error > *row.benign_error + worse_by;
    return is_worse ? Verdict::worse : Verdict::ok;
}

bool is_near_worse(const StabilityRow& row, size_t pixels) {
    const std::optional<double> ratio = row.error_ratio;
    // Found of 290 rows with two seeds each: at 96x54 ratios differ by up to a tenth, at 64 pixels by up to a factor
    // of 2.
    const double seed_margin = 1 + 10 / std::sqrt(double(pixels));
    return ratio && *ratio > worse_ratio / seed_margin &&
           *ratio<worse_ratio * seed_margin&& * row.error> * row.benign_error + worse_by / 2;
}

std::vector<StageRow> stage_rows(const std::vector<StabilityRow>& rows, bool has_all) {
    std::vector<StageRow> all;
    for (const StabilityRow& row : rows)
        for (const StageFinding& finding : row.stages)
            if (has_all || finding.nan + finding.infinite > 0)
                all.push_back({finding, row.case_name, row.technique, row.point});
    return all;
}
