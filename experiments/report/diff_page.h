#pragma once
#include "experiments/results/verdicts/study_diff.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// A results folder and its manifest.
struct ComparedStudy {
    std::filesystem::path folder;
    const nlohmann::json& manifest;
};

/// Writes the page of `ssrlab diff`, ordered by largest change. Each shot and point with different numbers or images
/// has both runs' pictures, their difference, and the numbers with verdicts; the report's viewer shows the images of
/// both. The page is one file of about 30 MB: points whose images do not fit have numbers alone. Fails with Error if an
/// image that a manifest lists is missing or broken.
void write_diff_page(const std::filesystem::path& page, const StudyDiff& diff, const ComparedStudy& before,
                     const ComparedStudy& after);
