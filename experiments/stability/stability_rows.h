#pragma once
#include "experiments/stability/amplification.h"

/// From the best to the worst.
enum class Verdict { ok, worse, out_of_range, inside, spreads, refused };

/// What a verdict is called in tables, and what it says.
struct VerdictName {
    std::string name, meaning;
};
const std::vector<VerdictName>& verdict_names();  ///< by Verdict

/// One technique in one case.
struct StabilityRow {
    std::string case_name, group, variant, point;
    Verdict verdict = Verdict::ok;
    std::optional<double> error, benign_error;  ///< means over the seeds
    unsigned seeds = 1;
    std::optional<double> time_ratio;
    std::optional<double> drift;  ///< of long sequences: relative change of the mean from the second quarter of the
                                  ///< frames to the last quarter
    std::optional<double> drift_noise;  ///< standard error of it, from the means of blocks of frames
    std::optional<double>
        gain;  ///< of a fed back image: by how much each change of the mean is smaller than the one before
    std::vector<Amplification> amplifications;
    CaseResult run;

    std::optional<double> error_ratio() const;
};

Verdict verdict_of(const StabilityRow& row);
/// Whether another seed might make a verdict of `worse`, or take it back, in a picture of so many pixels.
bool is_near_worse(const StabilityRow& row, size_t pixels);

/// One line for each case and technique, one for each case, and one for each stage of the former that holds a
/// non-finite value, or for all of their stages.
std::string stability_csv(const std::vector<StabilityRow>& rows);
std::string stability_cases_csv(const std::vector<StabilityCase>& cases);
std::string stability_stages_csv(const std::vector<StabilityRow>& rows, bool has_all);
