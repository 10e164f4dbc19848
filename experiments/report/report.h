#pragma once
#include "experiments/results/answers/answers.h"

#include <filesystem>

/// A page is mailed and opened at once: the images of larger ones lie beside it.
inline constexpr size_t page_bytes = 30'000'000;

/// A page of `data` (page/data.js). `values`: those of page/template.html that are not the same on all pages, and of
/// page/no_scripts.html.
std::string page_text(const std::string& title, const nlohmann::json& data, nlohmann::json values);

/// Reads manifest.json, results.csv, splits.csv, effects.csv, times.csv (these three may be absent) and the EXR images
/// of a results folder (experiments/RESULTS.md), and writes summary.csv, time_summary.csv and report.html into it, each
/// atomically. The page needs no network. It is one file with its images in it as long as it stays below 30 MB; else,
/// or if `links_images`, they lie in report_images/ beside it. Where the folder also holds the tables of `ssrlab
/// stability`, the page shows them; where it holds these alone, it shows nothing else. Fails with Error, naming the
/// file, if one is missing or malformed. Returns what the page says first.
StudyAnswers write_report(const std::filesystem::path& results_folder, bool links_images = false);

/// RunSettings::write_report.
inline StudyAnswers write_page(const std::filesystem::path& results_folder) { return write_report(results_folder); }
