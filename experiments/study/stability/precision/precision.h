#pragma once
#include "experiments/study/stability/precision/precision_run.h"
#include "experiments/study/stability/stability.h"

/// What a row of stability_precision.csv changes; each is compared with the same technique in float formats and float
/// arithmetic.
enum class PrecisionKind {
    method,      ///< nothing: the technique's own error
    own,         ///< one image, or all, in the technique's own format
    half,        ///< one image, or all, in half
    input,       ///< one group of the G-buffer's images in half
    arithmetic,  ///< one stage, or all, in double; for the technique "ggx_lobe" functions alone
    rays,        ///< rays of a stage in double, as they begin
    march,       ///< ends of bit-identical rays, by a stage in double
};
const char* name_of(PrecisionKind kind);
inline std::string csv_field(PrecisionKind kind) { return name_of(kind); }

/// A change below this share of the method's error is negligible.
inline constexpr double negligible_share = 0.01;

/// One comparison: a row of stability_precision.csv.
struct PrecisionRow {
    std::string case_name, technique, point;
    PrecisionKind kind{};
    std::string stage, image, format;  ///< "" for all; `stage`: for an image, the stages that write it
    std::optional<double> error;       ///< against the path-traced truth; relative_error()
    std::optional<double> change;      ///< of the specular image, in units of `error`; none where not measured
    std::optional<double> share;       ///< change / error of the method
    /// ValueChange of `image` in the last frame, or of rays' directions, origins or distances.
    std::optional<double> value_median, value_p999, differing;
    /// Shares of the image's nonzero values that are larger than any half, or so small that a half loses digits.
    std::optional<double> above_half, below_half;
    std::optional<double> wrong, wrong_in_double;  ///< share of rays that end in a wrong place of the scene
    size_t non_finite = 0;                         ///< pixels of the specular image, all frames
    std::string refusal;                           ///< why the run failed; "": it did not

    void set(const ValueChange& change) {
        value_median = change.median, value_p999 = change.p999, differing = change.differing;
    }

    static constexpr auto columns() {
        using Row = PrecisionRow;
        return std::tuple(Column{"case", &Row::case_name}, Column{"technique", &Row::technique},
                          Column{"point", &Row::point}, Column{"kind", &Row::kind}, Column{"stage", &Row::stage},
                          Column{"image", &Row::image}, Column{"format", &Row::format}, Column{"error", &Row::error},
                          Column{"change", &Row::change}, Column{"share_of_error", &Row::share},
                          Column{"value_median", &Row::value_median}, Column{"value_p999", &Row::value_p999},
                          Column{"differing", &Row::differing}, Column{"above_half", &Row::above_half},
                          Column{"below_half", &Row::below_half}, Column{"wrong", &Row::wrong},
                          Column{"wrong_in_double", &Row::wrong_in_double}, Column{"non_finite", &Row::non_finite},
                          Column{"refusal", &Row::refusal});
    }
};

/// Default points: each technique's best-known preset, and a technique of one mirror ray with each kind of march.
std::vector<PointConfig> precision_points();

/// Runs every point through every case of the table, changing one image or stage at a time. `done` gets all rows so far
/// and the share of the work done. If `selection.techniques` is empty, runs precision_points(). Fails with Error on
/// unknown names.
std::vector<PrecisionRow> run_precision(
    Device& device, const StabilitySelection& selection, const StabilityFolders& folders,
    const std::function<void(const std::vector<PrecisionRow>& rows, double share)>& done);

/// Compares float and double results of the functions of core/shared/brdf.h and variants/common/ggx_lobe.h for the same
/// arguments, by roughness: directions of visible normals, their densities and weights, and the BRDF. Rows have the
/// technique "ggx_lobe".
std::vector<PrecisionRow> lobe_rows(Device& device);

/// The table of cases that comes with ssrlab.
std::filesystem::path precision_case_table();
