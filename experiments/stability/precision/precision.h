#pragma once
#include "experiments/stability/precision/precision_run.h"
#include "experiments/stability/stability.h"

#include <functional>

/// What a row of stability_precision.csv compares, each with the same technique in float formats and float arithmetic.
enum class PrecisionKind {
    method,      ///< nothing: the error that the technique has anyway
    own,         ///< one image in the technique's own format, or all
    half,        ///< one image in half, or all
    input,       ///< one group of the G-buffer's images in half
    arithmetic,  ///< one stage calculates in double, or all; of the variant "ggx_lobe" its functions alone
    rays,        ///< the rays of a stage that calculates in double, as they begin
    march,       ///< where rays end that are the same to the bit, by a stage that calculates in double
};
const char* name_of(PrecisionKind kind);

/// Below this share of the method's error a change is of no account.
inline constexpr double negligible_share = 0.01;

struct PrecisionRow {
    std::string case_name, variant, point;
    PrecisionKind kind{};
    std::string stage, image, format;   ///< "" for all; `stage`: of an image those that write it
    std::optional<double> error;        ///< against the path-traced truth; relative_error()
    std::optional<double> change;       ///< of the specular image, in the same units; none where it is not measured
    std::optional<double> share;        ///< change / the method's error
    std::optional<ValueChange> values;  ///< of `image` in the last frame; of rays' directions, origins or distances
    /// Share of the image's values but zeros that are larger than any half, or so small that halves lose digits of
    /// them.
    std::optional<double> above_half, below_half;
    std::optional<double> wrong, wrong_in_double;  ///< share of rays that do not end where they should in the scene
    size_t non_finite = 0;                         ///< pixels of the specular image, in all
    std::string refusal;                           ///< why this could not be run
};

/// Points that are compared if none are named: what each technique is known for, and a technique of one mirror ray with
/// each kind of march.
std::vector<StabilityPoint> precision_points();

/// Runs every point through every case of `table`, one image and one stage at a time. `done` as in run_stability().
/// Without `selection.variants` precision_points(). Fails with Error on unknown names.
std::vector<PrecisionRow> run_precision(
    Device& device, const std::filesystem::path& table, const StabilitySelection& selection,
    const std::vector<std::filesystem::path>& search_path,
    const std::function<void(const std::vector<PrecisionRow>& rows, double share)>& done);

/// What the functions of core/shared/brdf.h and variants/common/ggx_lobe.h make of the same arguments, in rows of the
/// variant "ggx_lobe": directions of visible normals, their densities and weights, and the BRDF, by roughness.
std::vector<PrecisionRow> lobe_rows(Device& device);

/// The table of cases that comes with ssrlab.
std::filesystem::path precision_case_table();

std::string precision_csv(const std::vector<PrecisionRow>& rows);
