#pragma once
#include "experiments/report/report_images.h"
#include "experiments/results/answers/answers.h"

#include <filesystem>

/// Largest page with its images inside: a page is mailed and opened at once. Images of larger pages lie beside the
/// page.
inline constexpr size_t page_bytes = 30'000'000;

/// A page of `data` (page/study/data.js), as script_text(), with the scripts of `script`: "report" or "diff". `values`:
/// for page/report.html and page/no_scripts.html.
std::string report_page(const std::string& script, const std::string& title, std::string data,
                        const ReportImages& images, nlohmann::json values);

/// Reads a results folder (experiments/docs/results_folder.md) and writes summary.csv, time_summary.csv and report.html
/// into it, each atomically. Returns the page's first answers. It reads manifest.json, results.csv, splits.csv,
/// effects.csv and times.csv (the last three may be absent) and the EXR images.
///
/// The page needs no network. Below 30 MB it is one file with its images; else, or if `links_images`, they lie in
/// report_images/ beside it. If the folder has tables of `ssrlab stability`, the page shows them, too, or them alone.
/// Fails with Error, naming the file, if one is missing or malformed.
StudyAnswers write_report(const std::filesystem::path& results_folder, bool links_images = false);

/// RunSettings::write_report.
inline StudyAnswers write_page(const std::filesystem::path& results_folder) { return write_report(results_folder); }
