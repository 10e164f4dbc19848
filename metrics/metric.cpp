#include "metrics/metric.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/png.h"
#include "metrics/pixel_metrics.h"
#include "metrics/pooling.h"
#include "metrics/ssim.h"

#include <algorithm>
#include <map>

namespace {

HostImage decoded(const HostImage& codes) {
    HostImage linear = codes;
    tbb::parallel_for(size_t(0), size_t(codes.extent.y), [&](size_t y) {
        const size_t row = size_t(codes.extent.x) * 3;
        for (size_t i = y * row; i < (y + 1) * row; ++i) linear.values[i] = linear_from_srgb(codes.values[i]);
    });
    return linear;
}

std::vector<Plane> flip_layers(const ImagePair& pair) {
    return {flip_map(decoded(pair.reference_codes), decoded(pair.test_codes), pair.settings.pixels_per_degree)};
}

std::vector<Plane> hdr_flip_layers(const ImagePair& pair) {
    if (!pair.settings.flip_exposures)
        fail("hdr_flip needs a range of exposures, taken once from the scene's full reference image");
    return {hdr_flip_map(pair.reference, pair.test, *pair.settings.flip_exposures, pair.settings.hdr_flip_tone_map,
                         pair.settings.pixels_per_degree)};
}

std::vector<Metric> make_table() {
    std::vector<Metric> table = pixel_metrics();
    const size_t first_of_most_one = table.size();  // a similarity, or an error that an eye can see
    for (Metric& metric : ssim_metrics()) table.push_back(std::move(metric));
    table.push_back({"flip", "flip_ldr", "1", Better::lower, Domain::display,
                     "mean LDR-FLIP of the codes (Andersson et al. 2020)", flip_layers, pooled_mean});
    table.push_back(
        {"hdr_flip", "flip_hdr", "1", Better::lower, Domain::linear,
         "mean of the greatest LDR-FLIP over a range of exposures that is fixed per scene (Andersson et al. 2021)",
         hdr_flip_layers, pooled_mean});
    for (Metric& metric : std::span(table).subspan(first_of_most_one)) metric.greatest = 1;
    return table;
}

}  // namespace

const std::vector<Metric>& all_metrics() {
    static const std::vector<Metric> table = make_table();
    return table;
}

std::vector<std::string> metric_names() {
    std::vector<std::string> names;
    for (const Metric& metric : all_metrics()) names.push_back(metric.name);
    return names;
}

/// Metrics that configs may name and that are gone, with what tells the same.
static const std::map<std::string, std::string>& replaced_metrics() {
    static const std::map<std::string, std::string> all = {
        {"relmse_b", "relmse"}, {"relmse_c", "relmse"}, {"ssim_sample", "ssim"}, {"ms_ssim", "ssim"}};
    return all;
}

const Metric& metric_named(const std::string& name) {
    const auto found = std::ranges::find(all_metrics(), name, &Metric::name);
    if (const auto instead = replaced_metrics().find(name); instead != replaced_metrics().end())
        fail("there is no metric '", name, "'; use ", instead->second);
    if (found == all_metrics().end()) fail("no metric named '", name, "'", suggestion(name, metric_names()));
    return *found;
}

double measure(const Metric& metric, const ImagePair& pair, const Mask* mask) {
    const std::vector<Plane> layers = metric.layers(pair);
    return metric.pool(layers, mask ? intersection(*mask, pair.finite) : pair.finite);
}
