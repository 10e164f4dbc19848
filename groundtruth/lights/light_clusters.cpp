#include "groundtruth/lights/light_clusters.h"

#include "groundtruth/lights/light_groups.h"

#include <algorithm>
#include <cmath>

namespace {

/// Facing of a cluster that faces away, since single lights of it may face the point: every light keeps a chance.
constexpr float least_facing = 0.1f;

/// Sums of the values up to each, by fours whose sums do not wait for each other. Returns the sum of all.
float add_up(const float* values, float* ends, size_t count) {
    float before = 0.0f;
    for (size_t four = 0; four < count; four += 4) {
        const float two = values[four] + values[four + 1], three = two + values[four + 2];
        ends[four] = before + values[four];
        ends[four + 1] = before + two;
        ends[four + 2] = before + three;
        ends[four + 3] = before = before + (three + values[four + 3]);
    }
    return before;
}

}  // namespace

LightClusters::LightClusters(std::span<const LightExtent> lights) : members_(lights.size()) {
    vec3 low = lights[0].center, high = low;
    double power = 0;
    for (const LightExtent& light : lights) {
        low = glm::min(low, light.center), high = glm::max(high, light.center);
        power += light.power;
    }
    const float extent = std::max(glm::length(high - low), std::sqrt(lights[0].square_radius));
    // Lights that face opposite ways are as far apart as twice the extent: measured over 0, 0.1, 0.3 and 1 of it.
    std::vector<PlacedPower> placed;
    for (const LightExtent& light : lights) {
        const vec3 at = light.center / extent, facing = light.normal;
        placed.push_back({{at.x, at.y, at.z, facing.x, facing.y, facing.z}, light.power});
    }
    std::ranges::fill(radius_, 1.0f);  // beyond the last cluster: no division by zero
    for (auto& members : divide_lights(placed, most_clusters, 0)) add_cluster(lights, std::move(members), power);
    lanes_ = clusters_.size() > vector ? most_clusters : vector;
}

void LightClusters::add_cluster(std::span<const LightExtent> lights, std::vector<uint32_t> members,
                                double group_power) {
    const size_t at = clusters_.size();
    glm::dvec3 center(0.0), normal(0.0);
    std::vector<double> powers;
    double power = 0, square_radius = 0;
    for (const uint32_t light : members) {
        powers.push_back(lights[light].power);
        power += powers.back();
        center += powers.back() * glm::dvec3(lights[light].center);
        normal += powers.back() * glm::dvec3(lights[light].normal);
    }
    center /= power, normal /= power;
    for (size_t i = 0; i < members.size(); ++i) {
        const LightExtent& light = lights[members[i]];
        const glm::dvec3 offset = glm::dvec3(light.center) - center;
        square_radius += powers[i] / power * (light.square_radius + glm::dot(offset, offset));
    }
    x_[at] = float(center.x), y_[at] = float(center.y), z_[at] = float(center.z);
    normal_x_[at] = float(normal.x), normal_y_[at] = float(normal.y), normal_z_[at] = float(normal.z);
    spread_[at] = float(std::max(1 - glm::length(normal), 0.0));
    radius_[at] = float(std::sqrt(square_radius));
    share_[at] = float(power / group_power);
    const AliasTable table(powers);
    for (size_t i = 0; i < members.size(); ++i) members_[members[i]] = {uint32_t(at), float(table.probability(i))};
    clusters_.push_back({std::move(members), table});
}

/// The irradiance that each cluster without shadows would bring a surface that faces it, in any unit; with the sums up
/// to each. Returns the sum of all. A cluster that is near, or whose lights face many ways, counts as facing the point.
float LightClusters::weigh(vec3 point, Values& weights, Values& ends) const {
    for (size_t i = 0; i < lanes_; ++i) {
        const float x = point.x - x_[i], y = point.y - y_[i], z = point.z - z_[i], radius = radius_[i];
        const float square = std::max(x * x + y * y + z * z, radius * radius);
        const float per_distance = 1.0f / std::sqrt(square);
        const float cosine = x * normal_x_[i] + y * normal_y_[i] + z * normal_z_[i];  // times the distance
        const float facing = (cosine + radius) * per_distance + spread_[i];
        weights[i] = share_[i] * std::max(facing, least_facing) * per_distance * per_distance;
    }
    const float sum = add_up(weights, ends, lanes_);
    if (sum > 0.0f) return sum;
    std::ranges::copy(share_, weights);  // the distance overflows, or is not a number
    return add_up(weights, ends, lanes_);
}

LightClusters::Choice LightClusters::sample(vec3 point, uint32_t bits) const {
    alignas(64) Values weights, ends;
    const float sum = weigh(point, weights, ends);
    // Counted, since no processor predicts a random choice. Roundings move 1e-7 of the choice between clusters.
    const double wanted = bits * 0x1p-32 * double(sum);
    const auto bound = float(wanted);
    uint32_t at = 0;
    for (size_t i = 0; i < lanes_; ++i) at += bound >= ends[i];
    at = std::min(at, uint32_t(clusters_.size() - 1));
    const double into = (wanted - (double(ends[at]) - double(weights[at]))) / double(weights[at]);
    const auto rest = uint32_t(std::clamp(into, 0.0, 1.0 - 0x1p-32) * 0x1p32);
    const float probability = weights[at] / sum;
    const Cluster& cluster = clusters_[at];
    if (cluster.lights.size() == 1) return {cluster.lights[0], rest, probability};
    const AliasTable::Choice chosen = cluster.table.sample(rest);
    const uint32_t light = cluster.lights[chosen.index];
    return {light, chosen.rest, probability * members_[light].probability};
}

float LightClusters::probability(uint32_t light, vec3 point) const {
    alignas(64) Values weights, ends;
    const float sum = weigh(point, weights, ends);
    const Member& member = members_[light];
    return weights[member.cluster] / sum * member.probability;
}
