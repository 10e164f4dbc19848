#pragma once
#include "experiments/results/files/columns.h"
#include "experiments/results/verdicts/study_results.h"

#include <array>
#include <string>
#include <vector>

/// NumberChange::verdict.
namespace change {
inline constexpr const char* equal = "equal";  ///< equal except for rounding
inline constexpr const char* changed = "changed";
inline constexpr const char* equivalent = "equivalent";  ///< for errors: certainly changed by less than the margin
inline constexpr const char* undecided = "undecided";    ///< chance may have made the difference, or hidden one
inline constexpr const char* not_judged = "not judged";  ///< `how` says why
}  // namespace change

/// The change of one number that both studies have: an error, or the median time of a point's frame.
struct NumberChange {
    std::string shot, frame, technique, point, target, metric,
        mask;  ///< times have the metric "total_ms", no target, no mask
    std::optional<double> before, after;
    std::optional<double> p;                  ///< two-sided, of "nothing changed"; none if chance has no part
    std::optional<double> p_holm;             ///< p adjusted for its family, see diff_studies()
    std::optional<double> p_equivalent = {};  ///< of "changed by the margin or more", for errors; not adjusted
    std::string verdict;
    std::string how;  ///< how the change was judged, or why not

    /// Size of the relative change in either direction, if both values exist: |ln(after / before)|.
    double size() const;

    COLUMNS(NumberChange, shot, frame, technique, point, target, metric, mask, before, after, p, p_holm, verdict, how)
};

using PointOfShot = std::array<std::string, 3>;  ///< shot, technique, point

/// A shot that was timed on different machines in both studies.
struct MovedShot {
    std::string shot, before, after;
};

struct StudyDiff {
    std::vector<NumberChange> errors, times;
    std::vector<MovedShot> moved;                      ///< shots whose times are not compared
    std::vector<PointOfShot> only_before, only_after;  ///< points that only one study has
};

/// Compares the errors that represent their shots, and the medians of all stages' times.
///
/// Errors are paired by seed if both studies have the same seeds against the same pixels of the truth. Whatever no edit
/// touched is then equal except for the order of sums. If chance has no part (one seed, or a point that does not depend
/// on it), any difference is a certain change; else Student's t of the differences decides. Other pairs are compared by
/// both intervals (p_by_intervals()) if both include all that is random. Points that are not ranked are not judged, for
/// example those that are not repeatable.
///
/// Times are compared on one machine, by their intervals and the difference of two copies of a point in each study
/// (aa_floor()). Both are normal deviations with as many degrees of freedom as there were pairs of copies. Times are
/// not judged where no point was timed twice, or where other programs disturbed half of the frames or more.
///
/// All p-values of errors are adjusted together (Holm 1979), with those of times if `judges_times`, else without.
/// Errors without a significant change are equivalent if they certainly changed by less than the share `margin` (two
/// one-sided tests, adjusted likewise). At most 5 % of pairs of runs of one program show a change: simulated in
/// tests/experiments/evaluation.
StudyDiff diff_studies(const StudyResults& before, const StudyResults& after, bool judges_times,
                       double margin = PrimaryComparisons().margin);

/// The number of changes with this verdict.
size_t count_of(const std::vector<NumberChange>& changes, const std::string& verdict);
