#pragma once
#include "experiments/results/files/columns.h"
#include "experiments/results/verdicts/study_results.h"

#include <array>
#include <string>
#include <vector>

/// NumberChange::verdict.
namespace change {
inline constexpr const char* equal = "equal";  ///< but for rounding
inline constexpr const char* changed = "changed";
inline constexpr const char* equivalent = "equivalent";  ///< of errors: certainly changed by less than the margin
inline constexpr const char* undecided = "undecided";    ///< chance may have made the difference, or hidden one
inline constexpr const char* not_judged = "not judged";  ///< `how` says why
}  // namespace change

/// What became of one number that both studies have: an error, or the median time of a point's frame.
struct NumberChange {
    std::string shot, frame, technique, point, target, metric,
        mask;  ///< of a time: metric "total_ms", no target, no mask
    std::optional<double> before, after;
    std::optional<double> p;       ///< two-sided, of "nothing changed"; none where that is not a matter of chance
    std::optional<double> p_holm;  ///< p adjusted for its family, see diff_studies()
    std::optional<double> p_equivalent = {};  ///< of "it changed by the margin or more", of errors; not adjusted
    std::string verdict;
    std::string how;  ///< by what it was judged, or why it was not

    /// Of the relative change of values that both are there, in either direction: |ln(after / before)|.
    double size() const;

    COLUMNS(NumberChange, shot, frame, technique, point, target, metric, mask, before, after, p, p_holm, verdict, how)
};

using PointOfShot = std::array<std::string, 3>;  ///< shot, technique, point

/// A shot whose times are of another machine in each study.
struct MovedShot {
    std::string shot, before, after;
};

struct StudyDiff {
    std::vector<NumberChange> errors, times;
    std::vector<MovedShot> moved;                      ///< their times are not compared
    std::vector<PointOfShot> only_before, only_after;  ///< that one study has
};

/// Compares the errors that represent their shots, and the medians of all stages' times.
///
/// Where both studies have the same seeds against the same pixels of the truth, errors are paired by seed: what no edit
/// touched is equal, but for the order of sums. A pair that differs has changed with certainty if chance has no part in
/// it (one seed, or a point that does not depend on it); else by Student's t of the differences. Other pairs are
/// compared by both intervals (p_by_intervals()) if both hold all that is random; such as are not ranked, as those of
/// points that are not repeatable, are not judged.
///
/// Times are compared on one machine, by their intervals and by what two copies of a point differ by in each study
/// (aa_floor()), as normal deviations with as many degrees of freedom as there were pairs of copies. Not judged are
/// times where no point was timed twice, or where other programs disturbed half of the frames or more.
///
/// All p-values of the errors are adjusted together (Holm 1979); those of times with them if `judges_times`, and else
/// by themselves. Errors that did not change significantly are equivalent where they changed by less than `margin` of
/// themselves for certain (two one-sided tests, adjusted likewise). Of two runs of one program at most 5 % have a
/// change: simulated in tests/experiments/evaluation.
StudyDiff diff_studies(const StudyResults& before, const StudyResults& after, bool judges_times,
                       double margin = PrimaryComparisons().margin);

/// How many of them have this verdict.
size_t count_of(const std::vector<NumberChange>& changes, const std::string& verdict);
