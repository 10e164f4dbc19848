#include "experiments/stability/stage_scan.h"

#include <algorithm>
#include <cmath>

void StageScan::resume() {
    graph_.observe([this](const std::string& stage, std::span<const Image> written) {
        for (const Image& image : written) scan(stage, image);
    });
}

void StageScan::scan(const std::string& stage, const Image& image) {
    auto finding = std::ranges::find_if(
        findings_, [&](const StageFinding& f) { return f.stage == stage && f.image == image.name; });
    if (finding == findings_.end()) finding = findings_.insert(findings_.end(), {.stage = stage, .image = image.name});
    for (const float value : graph_.download(image).values) {
        finding->nan += std::isnan(value), finding->infinite += std::isinf(value);
        if (std::isfinite(value)) finding->largest = std::max(finding->largest, std::abs(value));
    }
}

size_t StageScan::non_finite() const {
    size_t count = 0;
    for (const StageFinding& f : findings_) count += f.nan + f.infinite;
    return count;
}

std::string StageScan::first_non_finite() const {
    for (const StageFinding& f : findings_)
        if (f.nan + f.infinite) return f.stage + ": " + f.image;
    return {};
}
