#include "groundtruth/lights/light_groups.h"

#include <algorithm>

namespace {

struct Part {
    std::vector<uint32_t> lights;
    size_t axis = 0;  ///< the longest
    float extent = 0;
    double power = 0;

    Part(std::span<const PlacedPower> all, std::vector<uint32_t> members) : lights(std::move(members)) {
        for (size_t i = 0; i < all[lights[0]].place.size(); ++i) {
            const auto [low, high] =
                std::ranges::minmax(lights, {}, [&](uint32_t light) { return all[light].place[i]; });
            const float length = all[high].place[i] - all[low].place[i];
            if (length > extent) extent = length, axis = i;
        }
        for (const uint32_t light : lights) power += all[light].power;
    }
};

}  // namespace

std::vector<std::vector<uint32_t>> divide_lights(std::span<const PlacedPower> lights, size_t max_groups,
                                                 float least_extent) {
    std::vector<uint32_t> shining;
    for (uint32_t i = 0; i < lights.size(); ++i)
        if (lights[i].power > 0) shining.push_back(i);
    if (shining.empty()) return {};

    std::vector<Part> parts{Part(lights, std::move(shining))};
    const auto gain = [&](const Part& part) { return part.extent > least_extent ? part.power * part.extent : 0.0; };
    while (parts.size() < max_groups) {
        const auto widest = std::ranges::max_element(parts, {}, gain);
        if (!(gain(*widest) > 0)) break;
        std::vector<uint32_t> members = std::move(widest->lights);
        const size_t axis = widest->axis;
        std::ranges::stable_sort(members, {}, [&](uint32_t light) { return lights[light].place[axis]; });
        size_t cut = 0;
        for (double below = 0; cut < members.size() - 1 && (cut == 0 || below < 0.5 * widest->power); ++cut)
            below += lights[members[cut]].power;
        Part upper(lights, {members.begin() + std::ptrdiff_t(cut), members.end()});
        members.resize(cut);
        *widest = Part(lights, std::move(members));
        parts.push_back(std::move(upper));
    }
    std::vector<std::vector<uint32_t>> groups;
    for (Part& part : parts) groups.push_back(std::move(part.lights));
    return groups;
}
