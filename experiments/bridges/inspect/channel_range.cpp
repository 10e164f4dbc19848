#include "experiments/bridges/inspect/channel_range.h"

#include "core/parameters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace {

struct RangeSums {
    float least = std::numeric_limits<float>::infinity(), largest = -std::numeric_limits<float>::infinity();
    double sum = 0.0;
    size_t finite = 0, nan = 0;

    void add(float value) {
        const bool is_finite = std::isfinite(value);
        nan += std::isnan(value), finite += is_finite;
        if (!is_finite) return;
        least = std::min(least, value), largest = std::max(largest, value), sum += value;
    }
    void add(const RangeSums& other) {
        least = std::min(least, other.least), largest = std::max(largest, other.largest);
        sum += other.sum, finite += other.finite, nan += other.nan;
    }
};

}  // namespace

ChannelRange channel_range(const HostImage& image, unsigned channel) {
    const auto add_rows = [&](const tbb::blocked_range<size_t>& pixels, RangeSums sums) {
        for (size_t i = pixels.begin(); i < pixels.end(); ++i) sums.add(image.values[i * image.channels + channel]);
        return sums;
    };
    const auto join = [](RangeSums a, const RangeSums& b) {
        a.add(b);
        return a;
    };
    constexpr size_t grain = 1 << 16;  // fixed blocks: the mean has the same bits on any number of cores
    const RangeSums sums = tbb::parallel_deterministic_reduce(tbb::blocked_range<size_t>(0, image.pixel_count(), grain),
                                                              RangeSums(), add_rows, join);
    ChannelRange range{.nan = sums.nan, .infinite = image.pixel_count() - sums.finite - sums.nan};
    if (sums.finite > 0)
        range.least = sums.least, range.largest = sums.largest, range.mean = sums.sum / double(sums.finite);
    return range;
}

nlohmann::ordered_json to_json(const ChannelRange& range) {
    return {{"least", json_number(range.least)},
            {"mean", json_number(float(range.mean))},
            {"largest", json_number(range.largest)},
            {"nan", range.nan},
            {"infinite", range.infinite}};
}
