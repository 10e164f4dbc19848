#pragma once
#include "experiments/results/verdicts/study_diff.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// A results folder and its manifest.
struct ComparedStudy {
    std::filesystem::path folder;
    const nlohmann::json& manifest;
};

/// Writes the page of `ssrlab diff`: of every shot and point whose numbers or images differ the pictures of both runs,
/// their difference and the numbers with their verdicts, in the order of the largest change, and the report's viewer
/// with the images of both. It is one file of 30 MB or so: of the points for whose images there is no room the numbers
/// alone. Fails with Error if an image that a manifest lists is missing or broken.
void write_diff_page(const std::filesystem::path& page, const StudyDiff& diff, const ComparedStudy& before,
                     const ComparedStudy& after);
