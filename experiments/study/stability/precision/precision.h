#pragma once
#include "experiments/study/stability/precision/precision_run.h"
#include "experiments/study/stability/stability.h"

/// What a row of stability_precision.csv compares, each with the same technique in float formats and float arithmetic.
enum class PrecisionKind {
    method,      ///< nothing: the error that the technique has anyway
    own,         ///< one image in the technique's own format, or all
    half,        ///< one image in half, or all
    input,       ///< one group of the G-buffer's images in half
    arithmetic,  ///< one stage calculates in double, or all; of the technique "ggx_lobe" its functions alone
    rays,        ///< the rays of a stage that calculates in double, as they begin
    march,       ///< where rays end that are the same to the bit, by a stage that calculates in double
};
const char* name_of(PrecisionKind kind);
inline std::string csv_field(PrecisionKind kind) { return name_of(kind); }

/// Below this share of the method's error a change is of no account.
inline constexpr double negligible_share = 0.01;

/// One comparison: a row of stability_precision.csv.
struct PrecisionRow {
    std::string case_name, technique, point;
    PrecisionKind kind{};
    std::string stage, image, format;  ///< "" for all; `stage`: of an image those that write it
    std::optional<double> error;       ///< against the path-traced truth; relative_error()
    std::optional<double> change;      ///< of the specular image, in the same units; none where it is not measured
    std::optional<double> share;       ///< change / the method's error
    /// ValueChange of `image` in the last frame; of rays' directions, origins or distances.
    std::optional<double> value_median, value_p999, differing;
    /// Share of the image's values but zeros that are larger than any half, or so small that halves lose digits of
    /// them.
    std::optional<double> above_half, below_half;
    std::optional<double> wrong, wrong_in_double;  ///< share of rays that do not end where they should in the scene
    size_t non_finite = 0;                         ///< pixels of the specular image, in all
    std::string refusal;                           ///< why this could not be run

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

/// Points that are compared if none are named: what each technique is known for, and a technique of one mirror ray with
/// each kind of march.
std::vector<PointConfig> precision_points();

/// Runs every point through every case of the table, one image and one stage at a time. `done` gets all rows so far
/// with the share of the work that is behind it. Without `selection.techniques` precision_points(). Fails with Error on
/// unknown names.
std::vector<PrecisionRow> run_precision(
    Device& device, const StabilitySelection& selection, const StabilityFolders& folders,
    const std::function<void(const std::vector<PrecisionRow>& rows, double share)>& done);

/// What the functions of core/shared/brdf.h and variants/common/ggx_lobe.h make of the same arguments, in rows of the
/// technique "ggx_lobe": directions of visible normals, their densities and weights, and the BRDF, by roughness.
std::vector<PrecisionRow> lobe_rows(Device& device);

/// The table of cases that comes with ssrlab.
std::filesystem::path precision_case_table();
