#include "experiments/study/measuring/noise_places.h"

#include "core/parameters.h"

#include <algorithm>
#include <functional>
#include <iterator>

NoisePlaces noise_places(const HostImage& variance, const HostImage& roughness, const Mask& mask) {
    constexpr size_t classes = std::size(noise_class_edges) - 1;
    NoisePlaces places;
    std::vector<double> variances;
    double total = 0, squares = 0, of_class[classes] = {}, pixels_of_class[classes] = {};
    for (size_t i = 0; i < mask.inside.size(); ++i) {
        if (!mask.inside[i]) continue;
        const double v = (double(variance.values[3 * i]) + variance.values[3 * i + 1] + variance.values[3 * i + 2]) / 3;
        variances.push_back(v), total += v, squares += v * v;
        size_t c = 0;
        while (c + 1 < classes && roughness.values[i] >= noise_class_edges[c + 1]) ++c;
        of_class[c] += v, ++pixels_of_class[c];
    }
    places.pixels = variances.size();
    const double share = total > 0 ? 1 / total : 0;
    const auto noisiest = variances.begin() + std::ptrdiff_t((variances.size() + 99) / 100);
    std::ranges::partial_sort(variances, noisiest, std::greater());
    for (auto v = variances.begin(); v != noisiest; ++v) places.noisiest_share += *v * share;
    places.carriers = squares > 0 ? total * total / squares : 0;
    for (size_t c = 0; c < classes; ++c)
        if (pixels_of_class[c] > 0)
            places.by_roughness.push_back({.edges = {noise_class_edges[c], noise_class_edges[c + 1]},
                                           .pixel_share = pixels_of_class[c] / double(places.pixels),
                                           .variance_share = of_class[c] * share});
    return places;
}

nlohmann::json noise_entry(const NoisePlaces& places, const std::string& target, const std::string& mask) {
    nlohmann::json classes = nlohmann::json::array();
    for (const NoisePlaces::Class& c : places.by_roughness)
        classes.push_back({{"from", json_number(c.edges.from)},
                           {"below", json_number(c.edges.below)},
                           {"pixel_share", c.pixel_share},
                           {"variance_share", c.variance_share}});
    return {{"target", target},
            {"mask", mask},
            {"pixels", places.pixels},
            {"noisiest_share", places.noisiest_share},
            {"carriers", places.carriers},
            {"by_roughness", classes}};
}
