#pragma once
#include "experiments/results/answers/answers.h"

#include <filesystem>

/// A page is mailed and opened at once: the images of larger ones lie beside it.
inline constexpr size_t page_bytes = 30'000'000;

/// A page of `data` (page/study/data.js) with the scripts of `script`, "report" or "diff". `values`: those of
/// page/report.html and page/no_scripts.html.
std::string report_page(const std::string& script, const std::string& title, const nlohmann::json& data,
                        nlohmann::json values);

/// Adds the texts of ReportImages::data to the values of a report_page().
void add_images(nlohmann::json& values, const std::vector<std::string>& texts);

/// Reads manifest.json, results.csv, splits.csv, effects.csv, times.csv (these three may be absent) and the EXR images
/// of a results folder (experiments/RESULTS.md), and writes summary.csv, time_summary.csv and report.html into it, each
/// atomically. The page needs no network. It is one file with its images in it as long as it stays below 30 MB; else,
/// or if `links_images`, they lie in report_images/ beside it. Where the folder also holds the tables of `ssrlab
/// stability`, the page shows them; where it holds these alone, it shows nothing else. Fails with Error, naming the
/// file, if one is missing or malformed. Returns what the page says first.
StudyAnswers write_report(const std::filesystem::path& results_folder, bool links_images = false);

/// RunSettings::write_report.
inline StudyAnswers write_page(const std::filesystem::path& results_folder) { return write_report(results_folder); }
