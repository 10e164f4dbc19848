#pragma once
#include "experiments/results/files/columns.h"

#include <optional>
#include <string>
#include <vector>

/// What a case is called: a row of stability_cases.csv.
struct StabilityCaseName {
    std::string name, group, why;
    std::string family;  ///< its name without the values of `each`

    static constexpr auto columns() {
        using Row = StabilityCaseName;
        return std::tuple(Column{"case", &Row::name}, Column{"family", &Row::family}, Column{"group", &Row::group},
                          Column{"why", &Row::why});
    }
};

/// What one image of one stage has held, over the frames that were looked at.
struct StageFinding {
    std::string stage, image;
    size_t nan = 0, infinite = 0;  ///< values, summed over frames
    double largest = 0;            ///< of the finite magnitudes
};

/// What is wrong with what one point made of one case.
struct CaseFindings {
    size_t non_finite = 0;         ///< values of all stages
    std::string first_non_finite;  ///< "stage: image"
    size_t spread_pixels = 0;      ///< most pixels of one frame that are not finite though their inputs are
    unsigned spread_frames = 0;    ///< frames with such pixels after the last one with a fault
    // Finite pixels of all frames:
    size_t negative = 0, too_bright = 0;  ///< by radiance: brighter than all light
    double excess = 0;                    ///< the largest radiance, less the brightest light
    size_t bad_confidence = 0;            ///< outside of [0, 1]
    std::string refusal;                  ///< why it could not be rendered

    size_t out_of_range() const { return negative + too_bright + bad_confidence; }
};

/// From the best to the worst.
enum class Verdict { ok, worse, out_of_range, inside, spreads, refused };

/// What a verdict is called in tables, and what it says.
struct VerdictName {
    std::string name, meaning;
};
const std::vector<VerdictName>& verdict_names();  ///< by Verdict
std::string csv_field(Verdict verdict);
void read_field(const CsvReader& csv, const char* name, Verdict& verdict);
inline nlohmann::json column_json(Verdict verdict) { return size_t(verdict); }

/// One technique in one case: a row of stability.csv.
struct StabilityRow : CaseFindings {
    std::string case_name, group, technique, point;
    Verdict verdict = Verdict::ok;
    std::optional<double> error, benign_error, error_ratio;  ///< of means over the seeds
    unsigned seeds = 1;
    std::optional<double> time_ratio;
    /// Amplification of inputs, see Perturbation.
    std::optional<double> depth_median, depth_p999, normal_median, normal_p999, lit_median, lit_p999;
    /// Of long sequences: relative change of the mean from the first to the second half of the last three quarters of
    /// the frames, and its standard error, from the means of blocks of frames.
    std::optional<double> drift, drift_noise;
    /// Of a fed back image: by how much each change of the mean is smaller than the one before.
    std::optional<double> gain;
    std::vector<StageFinding> stages = {};

    static constexpr auto columns() {
        return std::tuple_cat(
            std::tuple(Column{"case", &StabilityRow::case_name}),
            MEMBER_COLUMNS(StabilityRow, group, technique, point, verdict, error, benign_error, error_ratio, seeds,
                           non_finite, first_non_finite, spread_pixels, spread_frames, negative, too_bright, excess,
                           bad_confidence, time_ratio, depth_median, depth_p999, normal_median, normal_p999, lit_median,
                           lit_p999, drift, drift_noise, gain, refusal));
    }
};

/// Sets both errors, and their ratio where there is one.
void set_errors(StabilityRow& row, std::optional<double> error, std::optional<double> benign_error);
Verdict verdict_of(const StabilityRow& row);
/// Whether another seed might make a verdict of `worse`, or take it back, in a picture of so many pixels.
bool is_near_worse(const StabilityRow& row, size_t pixels);

/// What one image of one stage held in one row of stability.csv: a row of stability_stages.csv.
struct StageRow : StageFinding {
    std::string case_name, technique, point;

    static constexpr auto columns() {
        return std::tuple_cat(std::tuple(Column{"case", &StageRow::case_name}),
                              MEMBER_COLUMNS(StageRow, technique, point, stage, image, nan, infinite, largest));
    }
};
/// Those that hold a value that is not finite, or all.
std::vector<StageRow> stage_rows(const std::vector<StabilityRow>& rows, bool has_all);
