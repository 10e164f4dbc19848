#pragma once
#include "experiments/results/verdicts/study_results.h"

/// The mean estimated times of a chip over places of one kind.
struct CostsOfKind {
    std::string group;               ///< of the shots of the study of costs; "": all of them
    std::vector<std::string> sizes;  ///< of these shots, such as "1920x1080"
    size_t places = 0;               ///< scenes, each counted once
    double widest = 0;  ///< the widest interval of a mean: half of its width / the mean; 0 below four places
};

/// Gives each shot of `errors` the estimated times of `chip` that another study has: of each point, the mean over the
/// places of the shot's kind, with its 95 % interval over places (Student's t). A shot belongs to the longest group of
/// `costs` that its own group begins with ("rooms" for "rooms, at rest"); a study of costs without groups serves all
/// shots. A point that any of these places refuses is refused.
/// Errors are thus of one size and times of another: a search needs thousands of small images, and times of small
/// images say nothing about large ones.
/// Fails with Error if `costs` has no estimate of the chip, no group for a shot, or other parameters for a point of
/// the same name.
std::vector<CostsOfKind> take_costs_from(const StudyResults& costs, const std::string& chip, StudyResults& errors);
