#pragma once
#include "experiments/results/files/columns.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// Names of a case: a row of stability_cases.csv.
struct StabilityCaseName {
    std::string name, group, why;
    std::string family;  ///< its name without the values of `each`

    static constexpr auto columns() {
        using Row = StabilityCaseName;
        return std::tuple(Column{"case", &Row::name}, Column{"family", &Row::family}, Column{"group", &Row::group},
                          Column{"why", &Row::why});
    }
};

/// The values of one image of one stage, over the scanned frames.
struct StageFinding {
    std::string stage, image;
    size_t nan = 0, infinite = 0;  ///< values, summed over frames
    double largest = 0;            ///< largest finite magnitude
};

/// By stage, of those whose shaders have some: products with a constant 0
/// (experiments/gpu_costs/spirv/zero_products.h). None: they cannot be counted.
using ZeroProductCounts = std::map<std::string, std::optional<unsigned>>;

/// Defects in the result of one point in one case.
struct CaseFindings {
    size_t non_finite = 0;         ///< number of values, over all stages
    std::string first_non_finite;  ///< "stage: image"
    size_t spread_pixels = 0;      ///< most non-finite pixels of one frame whose inputs are finite
    unsigned spread_frames = 0;    ///< frames with such pixels after the last one with a fault
    // Finite pixels of all frames:
    size_t negative = 0, too_bright = 0;  ///< by radiance; too bright: brighter than all light
    double excess = 0;                    ///< largest radiance - brightest light
    size_t bad_confidence = 0;            ///< outside of [0, 1]
    std::string refusal;                  ///< why the case could not be rendered

    size_t out_of_range() const { return negative + too_bright + bad_confidence; }
};

/// Verdicts from best to worst.
enum class Verdict { ok, worse, out_of_range, inside, spreads, refused };

/// A verdict's name in tables, and its meaning.
struct VerdictName {
    std::string name, meaning;
};
const std::vector<VerdictName>& verdict_names();  ///< by Verdict
std::string csv_field(Verdict verdict);
void read_field(const CsvReader& csv, size_t place, Verdict& verdict);
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
    /// For long sequences: relative change of the mean between both halves of the last three quarters of the frames,
    /// and its standard error from means of blocks of frames.
    std::optional<double> drift, drift_noise;
    /// For a case that feeds images back: ratio of each change of the mean to the change before.
    std::optional<double> gain;
    std::vector<StageFinding> stages = {};
    ZeroProductCounts zero_products = {};

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
/// Whether another seed might change the verdict to or from `worse`, in a picture of `pixels` pixels.
bool is_near_worse(const StabilityRow& row, size_t pixels);

/// A row of stability_stages.csv: values of one image of one stage, for one row of stability.csv.
struct StageRow : StageFinding {
    std::string case_name, technique, point;

    static constexpr auto columns() {
        return std::tuple_cat(std::tuple(Column{"case", &StageRow::case_name}),
                              MEMBER_COLUMNS(StageRow, technique, point, stage, image, nan, infinite, largest));
    }
};
/// The stage rows that hold a non-finite value; with `has_all` all of them.
std::vector<StageRow> stage_rows(const std::vector<StabilityRow>& rows, bool has_all);
