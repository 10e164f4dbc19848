#include "experiments/study/shots/told_results.h"

#include "core/list_text.h"
#include "core/number_text.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <optional>

namespace {

/// The one number that matters of a point, over the seeds.
struct ShownResult {
    std::string point, frame;
    std::optional<double> value;  ///< the mean
    size_t seeds = 0;             ///< of which it is the mean
    size_t non_finite = 0;        ///< pixels, of the worst seed
};

ShownResult shown_result(const Config& config, const Cell& cell) {
    const PrimaryComparisons& shown = config.primary;
    ShownResult result{.point = display_name(config, cell.results.front().technique, cell.results.front().point),
                       .frame = "",
                       .value = {}};
    std::map<std::string, std::vector<double>> values;  // by frame
    for (const ResultRow& r : cell.results)
        if (r.target == shown.target && r.metric == shown.metric && r.mask == shown.mask) {
            result.non_finite = std::max(result.non_finite, size_t(r.non_finite));
            if (r.value) values[r.frame].push_back(*r.value);
        }
    if (values.empty()) return result;
    const auto& [frame, seeds] = values.contains(over_frames) ? *values.find(over_frames) : *values.rbegin();
    result.frame = frame == over_frames ? "over all frames" : "frame " + frame;
    result.value = std::accumulate(seeds.begin(), seeds.end(), 0.0) / double(seeds.size()), result.seeds = seeds.size();
    return result;
}

}  // namespace

void say_result(StudySession& study, const Cell& cell) {
    if (cell.results.empty()) return;
    const ShownResult result = shown_result(study.config, cell);
    const PrimaryComparisons& shown = study.config.primary;
    const auto pixels = [](size_t count) { return counted(count, "pixel"); };
    if (result.value) {
        char line[240];
        std::snprintf(line, sizeof line, "  %-56s %s of %s pixels %.4g (%s, %s)", result.point.c_str(),
                      shown.metric.c_str(), shown.mask.c_str(), *result.value, result.frame.c_str(),
                      counted(result.seeds, "seed").c_str());
        study.progress.say(line +
                           (result.non_finite > 0 ? ", without " + pixels(result.non_finite) + " not finite" : ""));
    } else if (result.non_finite > 0)
        study.progress.say("  " + result.point + ": no value, for " + pixels(result.non_finite) + " not finite");
}

void say_results(StudySession& study, const std::string& shot, std::span<const Cell> cells) {
    const PrimaryComparisons& shown = study.config.primary;
    std::vector<ShownResult> results;
    for (const Cell& cell : cells) {
        if (cell.results.empty()) continue;
        const ShownResult result = shown_result(study.config, cell);
        if (result.non_finite > 0) say_result(study, cell);
        if (result.value) results.push_back(result);
    }
    std::string line = shot + ": " + counted(cells.size(), "cell");
    if (!results.empty()) {
        const auto [least, most] = std::ranges::minmax_element(results, {}, &ShownResult::value);
        const auto text = [](const ShownResult& r) { return number_text(*r.value) + " (" + r.point + ")"; };
        line += ", " + shown.metric + " of " + shown.mask + " pixels " + text(*least);
        if (results.size() > 1) line += " to " + text(*most);
        line += ", " + least->frame;
    }
    study.progress.say(line);
}
