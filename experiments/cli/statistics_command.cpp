// Statistics for the Python scripts, which choose what they are of: a process that answers questions costs less than a
// copy of the rules, and less than a library, which would need the same sources once more and a place to be found in.
#include "core/error.h"
#include "experiments/cli/commands.h"
#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/results/tables/counts_spread.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "metrics/median_interval.h"
#include "metrics/quantiles.h"
#include "metrics/statistics.h"

#include <cmath>
#include <iostream>

namespace {

using nlohmann::json;

json answer_to(const json& question) {
    const std::string asked = question.at("ask");
    if (asked == "model_range") return {model_range.low, model_range.high, model_range_text()};
    if (asked == "counts_spread") return json::array({counts_spread});
    if (asked == "mean_over_scenes") {
        std::vector<ShotValue> values;
        for (const json& v : question.at("values")) values.push_back({v.at(0), v.at(1)});
        const MeanOverScenes mean = mean_over_scenes(values);
        return {mean.value, column_json(mean.low), column_json(mean.high), mean.scenes};
    }
    if (asked == "p_holm") {
        const double degrees = question.at("degrees"), quantile = student_t_quantile(0.975, degrees);
        std::vector<double> p_values;
        for (const json& effect : question.at("values")) {
            const double mean = effect.at(0), half_width = effect.at(1);
            p_values.push_back(2 * student_t_cdf(-std::abs(mean) * quantile / half_width, degrees));
        }
        return holm_adjusted(p_values);
    }
    const std::vector<double> values = question.at("values");
    if (asked == "bootstrap_over_scenes") {
        const auto ends = bootstrap_over_scenes(values, question.at("seed"));
        return ends ? json{ends->first, ends->second} : json{nullptr, nullptr};
    }
    if (asked == "mean") {
        const Estimate mean = mean_estimate(values);
        return {mean.value, mean.low, mean.high};
    }
    if (asked == "median") {
        const MedianInterval median = median_interval(values);
        return {median.median, median.low, median.high};
    }
    if (asked == "sign_factor") return json::array({sign_variance_factor(values)});
    fail("no statistic is called '", asked, "'");
}

}  // namespace

static void statistics_command() {
    for (std::string line; std::getline(std::cin, line);) {
        json answer;
        try {
            answer = answer_to(json::parse(line));
        } catch (const json::exception& e) {
            answer = {{"error", e.what()}};
        } catch (const Error& e) {
            answer = {{"error", e.what()}};
        }
        std::cout << answer.dump() << std::endl;
    }
}

void add_statistics(Commands& line) {
    CLI::App& command = *line.app.add_subcommand("statistics", "Answer the questions of ssrlab's own scripts");
    command.group("")->callback([] { statistics_command(); });  // not shown by --help
}
