#include "experiments/study/measuring/frame_means.h"

#include "metrics/direction.h"

#include <algorithm>

namespace {

/// Of means of maps; that of decibels is none.
NoiseGrowth mean_growth(const std::vector<ResultRow>& rows) {
    NoiseGrowth mean;
    for (const ResultRow& row : rows) {
        if (row.growth.empty() || metric_named(row.metric).of_mean) return {};
        mean.resize(row.growth.size());
        for (size_t i = 0; i < mean.size(); ++i) mean[i] += row.growth[i] / float(rows.size());
    }
    return mean;
}

std::optional<double> mean_of_rows(const std::vector<ResultRow>& rows, std::optional<double> ResultRow::*member) {
    double total = 0;
    for (const ResultRow& row : rows) {
        if (!(row.*member)) return {};
        total += *(row.*member);
    }
    return total / double(rows.size());
}

}  // namespace

void FrameMeans::add(const FrameRows& frame) {
    for (size_t i = 0; i < frame.rows.size(); ++i) {
        const ResultRow& row = frame.rows[i];
        Sums& sums = sums_[{row.metric, row.formula, row.mask}];
        sums.rows.push_back(row);
        if (frame.noise[i].is_empty()) sums.has_noise = false;
        if (sums.has_noise) add_noise(sums.noise, frame.noise[i], full_mask(frame.noise[i].swapped.extent));
    }
}

std::vector<ResultRow> FrameMeans::rows() const {
    std::vector<ResultRow> means;
    for (const auto& [key, sums] : sums_) {
        ResultRow r = sums.rows.front();
        r.frame = over_frames;
        for (const auto member : {&ResultRow::value, &ResultRow::uncorrected, &ResultRow::floor, &ResultRow::lit_noise,
                                  &ResultRow::lit_half_width})
            r.*member = mean_of_rows(sums.rows, member);
        r.low = r.high = std::nullopt;
        r.pixels = r.non_finite = r.negative = 0;
        for (const ResultRow& row : sums.rows)
            r.pixels += row.pixels, r.non_finite += row.non_finite, r.negative += row.negative;
        if (sums.has_noise && r.value)
            if (const auto sum = noise_half_width(sums.noise, full_mask(sums.noise.swapped.extent))) {
                const double half_width = *sum / double(sums.rows.size());
                r.low = *r.value - half_width, r.high = *r.value + half_width;
            }
        r.growth = mean_growth(sums.rows);
        if (const auto found = extrapolated_interval(r.growth); found && r.value)
            r.low = is_error(r.metric) ? std::max(found->low, 0.0) : found->low, r.high = found->high;
        r.growth.clear();
        means.push_back(std::move(r));
    }
    return means;
}
