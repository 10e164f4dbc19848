#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

/// What the report shows of the tables that `ssrlab stability` wrote into `folder`; null where there are none:
///
///     lead        what they say, in a few sentences
///     verdicts    [{name, meaning}], from the best to the worst
///     cases       [{name, group, why}]; techniques: [{variant, point}]; both in the order of stability.csv
///     rows        [[case, technique, verdict, {column: value}]], of the columns that are not empty and not 0
///     stages      [[case, technique, "stage: image", NaN, Inf]]
///     failures    [{variant, points, place, cases, nan, infinite, first, unexplained, explanations}], by variant and
///                 place = "stage: image". `first`: pairs of case and technique in which no stage before it fails;
///                 `unexplained`: those of them that failures.json does not tell of
///
/// Fails with Error, naming file and line, where a table is malformed.
nlohmann::json stability_report_data(const std::filesystem::path& folder);

/// Where values that are not finite come from, and how it is mended, as a table for terminals.
std::string failures_text(const nlohmann::json& data);

/// The values of the section `stability` of report/page/no_scripts.html: the lead, how often each technique got each
/// verdict, and the failures. `data`: as stability_report_data() returns it.
nlohmann::json stability_without_scripts(const nlohmann::json& data);
