#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

using PointName = std::pair<std::string, std::string>;  // technique, point

/// The name of a point for readers: its label, if the study gave one, else technique and point.
std::string point_text(const PointName& name, const std::string& label = "");
std::string point_text(const PointName& name, const std::map<PointName, std::string>& labels);

/// A point of a study, and what it is compared with.
struct ComparedPoint {
    std::string technique, point;
    bool depends_on_seed = true;
    bool is_baseline = false;   ///< all other points are compared with this one
    std::string against;        ///< "estimator=a": the only values in which `against_point` differs; "": none
    std::string against_point;  ///< a point of the same technique
};

/// EffectRow::against of comparisons with a baseline.
inline const std::string baseline_name = "baseline";

/// A comparison of a point with a baseline. `against`: baseline_name, or ComparedPoint::against.
struct PointComparison {
    const ComparedPoint *point, *baseline;
    std::string against;
};

/// Each point against each baseline, and each point with an `against_point` against that point. `points` must outlive
/// the result.
std::vector<PointComparison> comparisons_of(const std::vector<ComparedPoint>& points);

/// The error that a study is made to compare, of all points and shots. All other comparisons are exploratory.
struct PrimaryComparisons {
    std::string metric = "mse", mask = "reflective", target = "specular";
    double margin = 0.05;  ///< errors that differ by a smaller share are equivalent; in (0, 1]
};
