#include "experiments/stability/stability_rows.h"

#include "experiments/tables/csv.h"

#include <cmath>

namespace {

/// An error this much larger, as a ratio and in the units of relative_error(), is one that a picture shows.
constexpr double worse_ratio = 1.5, worse_by = 0.02;

const Amplification* find(const StabilityRow& row, const std::string& input) {
    for (const Amplification& a : row.amplifications)
        if (a.input == input) return &a;
    return nullptr;
}

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

std::optional<double> StabilityRow::error_ratio() const {
    if (!error || !benign_error || *benign_error <= 0) return std::nullopt;
    return *error / *benign_error;
}

Verdict verdict_of(const StabilityRow& row) {
    if (!row.run.refusal.empty()) return Verdict::refused;
    if (row.run.spread_pixels > 0) return Verdict::spreads;
    if (row.run.non_finite > 0) return Verdict::inside;
    if (row.run.out_of_range() > 0) return Verdict::out_of_range;
    const bool is_worse = row.error && row.benign_error && *row.error > worse_ratio * *row.benign_error &&
                          *row.error > *row.benign_error + worse_by;
    return is_worse ? Verdict::worse : Verdict::ok;
}

bool is_near_worse(const StabilityRow& row, size_t pixels) {
    const std::optional<double> ratio = row.error_ratio();
    // Found of 290 rows with two seeds each: at 96x54 ratios differ by up to a tenth, at 64 pixels by up to a factor
    // of 2.
    const double seed_margin = 1 + 10 / std::sqrt(double(pixels));
    return ratio && *ratio > worse_ratio / seed_margin &&
           *ratio<worse_ratio * seed_margin&& * row.error> * row.benign_error + worse_by / 2;
}

std::string stability_csv(const std::vector<StabilityRow>& rows) {
    std::string text =
        "case,group,variant,point,verdict,error,benign_error,error_ratio,seeds,non_finite,first_non_finite,spread_"
        "pixels,"
        "spread_frames,negative,too_bright,excess,bad_confidence,time_ratio,depth_median,depth_p999,normal_median,"
        "normal_p999,lit_median,lit_p999,"
        "drift,drift_noise,gain,refusal\n";
    for (const StabilityRow& r : rows) {
        const auto amplified = [&](const std::string& input, double Amplification::*part) {
            const Amplification* a = find(r, input);
            return a ? std::optional(a->*part) : std::nullopt;
        };
        text +=
            csv_line(r.case_name, r.group, r.variant, r.point, verdict_names()[size_t(r.verdict)].name, r.error,
                     r.benign_error, r.error_ratio(), r.seeds, r.run.non_finite, r.run.first_non_finite,
                     r.run.spread_pixels, r.run.spread_frames, r.run.negative, r.run.too_bright, double(r.run.excess),
                     r.run.bad_confidence, r.time_ratio, amplified("depth", &Amplification::median),
                     amplified("depth", &Amplification::p999), amplified("normal", &Amplification::median),
                     amplified("normal", &Amplification::p999), amplified("lit", &Amplification::median),
                     amplified("lit", &Amplification::p999), r.drift, r.drift_noise, r.gain, r.run.refusal);
    }
    return text;
}

std::string stability_cases_csv(const std::vector<StabilityCase>& cases) {
    std::string text = "case,family,group,why\n";
    for (const StabilityCase& c : cases) text += csv_line(c.name, c.family, c.group, c.why);
    return text;
}

std::string stability_stages_csv(const std::vector<StabilityRow>& rows, bool has_all) {
    std::string text = "case,variant,point,stage,image,nan,infinite,largest\n";
    for (const StabilityRow& r : rows)
        for (const StageFinding& f : r.run.stages)
            if (has_all || f.nan + f.infinite > 0)
                text +=
                    csv_line(r.case_name, r.variant, r.point, f.stage, f.image, f.nan, f.infinite, double(f.largest));
    return text;
}
