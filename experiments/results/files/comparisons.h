#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

using PointName = std::pair<std::string, std::string>;  // technique, point

/// A point as people read it: by its label, if the study gave it one, else by technique and point.
std::string point_text(const PointName& name, const std::string& label = "");
std::string point_text(const PointName& name, const std::map<PointName, std::string>& labels);

/// A point of a study, with what it is compared with.
struct ComparedPoint {
    std::string technique, point;
    bool depends_on_seed = true;
    bool is_baseline = false;   ///< all other points are compared with it
    std::string against;        ///< "estimator=a": the values in which alone `against_point` differs; "": none
    std::string against_point;  ///< of the same technique
};

/// EffectRow::against of points that are compared with a point marked as a baseline.
inline const std::string baseline_name = "baseline";

/// What a point is compared with, and as what: baseline_name, or ComparedPoint::against.
struct PointComparison {
    const ComparedPoint *point, *baseline;
    std::string against;
};

/// Every point against every point marked as a baseline, and those with an `against_point` against that. `points` must
/// outlive them.
std::vector<PointComparison> comparisons_of(const std::vector<ComparedPoint>& points);

/// The comparisons that a study is made for: one error of all points and shots. All others are exploratory.
struct PrimaryComparisons {
    std::string metric = "mse", mask = "reflective", target = "specular";
    double margin = 0.05;  ///< errors that differ by a smaller share than this are equivalent; in (0, 1]
};
