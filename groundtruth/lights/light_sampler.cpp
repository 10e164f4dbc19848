#include "groundtruth/lights/light_sampler.h"

#include "groundtruth/lights/light_groups.h"
#include "groundtruth/sampling/lobes.h"
#include "groundtruth/sampling/sobol.h"

#include <algorithm>
#include <cmath>

namespace {

/// Share of a textured emitter's choice that does not depend on what its probes of the texture found, so that no bright
/// texel between them is ever missed.
constexpr double unprobed_share = 0.1;
constexpr int probes_per_side = 4;

constexpr size_t max_groups_of_a_kind = 16;
/// Emissive triangles nearer to each other are not divided: a cell of LightChoice. As a share of the scene's
/// diagonal.
constexpr float least_extent = 1.0f / 48;
/// Triangles that face opposite ways are as far apart as twice this share.
constexpr float facing_scale = 0.05f;

/// Clusters are used where they lower the variance by more than this, per light sample and relative to the squared
/// light of the pixel. Of nine scenes, four save 0.04 to 0.5 in all groups together, and the others 0.0011 at most,
/// where the variance of the pixels does not change.
constexpr double worthwhile_saving = 1e-3;

/// Lamps have no extent. Nearer than this share of the scene's diagonal, their distance counts as this much.
constexpr float lamp_radius = 1e-3f;

/// Of any light (m^2), so that no distance is zero.
constexpr float least_square_radius = 1e-30f;

constexpr uint32_t in_environment = ~0u, in_mirror = ~1u;

/// Barycentrics that are uniform over a triangle (Turk 1990).
glm::vec2 triangle_barycentrics(glm::vec2 u) {
    const float root = std::sqrt(u.x);
    return {root * (1.0f - u.y), root * u.y};
}

double mean_emission(const MaterialTable& materials, uint32_t instance, uint32_t triangle) {
    double sum = 0;
    for (int y = 0; y < probes_per_side; ++y)
        for (int x = 0; x < probes_per_side; ++x) {
            const glm::vec2 at = triangle_barycentrics((glm::vec2(x, y) + 0.5f) / float(probes_per_side));
            sum += luminance(materials.emission(instance, triangle, at.x, at.y));
        }
    return sum / (probes_per_side * probes_per_side);
}

double punctual_power(const PunctualLight& light, double scene_radius) {
    const double intensity = luminance(light.intensity);
    if (light.type == LightType::directional) return intensity * M_PI * scene_radius * scene_radius;
    if (light.type == LightType::point) return intensity * 4 * M_PI;
    return intensity * 2 * M_PI * (1 - 0.5 * (light.inner_cone_cos + light.outer_cone_cos));
}

}  // namespace

LightSampler::LightSampler(const Scene& scene, const ScenePose& pose, const EmbreeScene& geometry,
                           const MaterialTable& materials, bool sample_environment, bool compensate, bool mirror_lamps)
    : geometry_(geometry), materials_(materials), first_triangle_(scene.instances.size(), no_light) {
    for (uint32_t i = 0; i < scene.instances.size(); ++i)
        if (materials.emits(geometry.instance(i).material)) add_triangles(scene, i);

    triangle_count_ = uint32_t(triangles_.size());

    const auto [low, high] = scene_bounds(scene, pose);
    grid_ = LearningGrid(low, high);
    const float diagonal = glm::length(high - low);
    const double radius = 0.5 * double(diagonal);
    for (const PunctualLight& light : pose.lights) {
        if (light.intensity == glm::vec3(0.0f)) continue;
        lights_.push_back(light);
        extents_.push_back({
            .center = light.position,
            .normal = light.type == LightType::spot ? light.direction : glm::vec3(0.0f),
            .square_radius = std::max(lamp_radius * lamp_radius * diagonal * diagonal, least_square_radius),
            // A direction of no length scale, or a scene without extent, still needs a chance.
            .power = std::max(punctual_power(light, radius), 1e-6 * luminance(light.intensity)),
        });
    }
    group_lights(diagonal);

    if (sample_environment && !scene.environment.is_black())
        environment_ = EnvironmentTable(scene.environment, compensate);
    first_image_ = uint32_t(groups_.size()) + environment_.part_count();
    if (mirror_lamps) mirrored_ = MirroredLamps(scene, geometry, lights_, diagonal);
    if (!empty()) choice_ = LightChoice(shares());
    needs_more_ = !lights_.empty() || has_environment_table();
    for (const Triangle& light : triangles_) needs_more_ |= light.emission_varies;
}

/// Lamps and emissive triangles are divided by their places, triangles by where they face as well.
void LightSampler::group_lights(float diagonal) {
    if (!(diagonal > 0)) diagonal = 1;
    std::vector<PlacedPower> triangles, lamps, suns;
    for (uint32_t i = 0; i < triangle_count_; ++i) {
        const glm::vec3 at = extents_[i].center / diagonal, facing = extents_[i].normal * facing_scale;
        triangles.push_back({{at.x, at.y, at.z, facing.x, facing.y, facing.z}, extents_[i].power});
    }
    for (size_t i = 0; i < lights_.size(); ++i) {
        const bool is_sun = lights_[i].type == LightType::directional;
        const glm::vec3 at = is_sun ? lights_[i].direction : lights_[i].position / diagonal;
        const PlacedPower light{{at.x, at.y, at.z}, extents_[triangle_count_ + i].power}, none{{}, 0};
        lamps.push_back(is_sun ? none : light);
        suns.push_back(is_sun ? light : none);
    }
    for (auto& group : divide_lights(triangles, max_groups_of_a_kind, least_extent)) add_group(std::move(group));
    for (const auto& kind : {lamps, suns})
        for (auto& group : divide_lights(kind, max_groups_of_a_kind, 0)) {
            for (uint32_t& light : group) light += triangle_count_;
            add_group(std::move(group));
        }
}

/// Of each group: all emissive triangles together, all parts of the environment together, all mirrored lamps together
/// and each group of lamps have the same share, so that no kind of light is short of samples because another was
/// divided into many groups.
std::vector<double> LightSampler::shares() const {
    uint32_t of_triangles = 0;
    for (const Group& group : groups_) of_triangles += group.lights[0] < triangle_count_;
    const uint32_t lamps = uint32_t(groups_.size()) - of_triangles, parts = environment_.part_count();
    const uint32_t images = mirrored_.count();
    const double share = 1.0 / (lamps + (of_triangles > 0) + (parts > 0) + (images > 0));
    std::vector<double> shares(of_triangles, share / of_triangles);
    shares.resize(groups_.size(), share);
    shares.resize(first_image_, share / parts);
    shares.resize(group_count(), share / images);
    return shares;
}

void LightSampler::add_group(std::vector<uint32_t> lights) {
    std::vector<double> powers;
    for (uint32_t place = 0; place < lights.size(); ++place) {
        powers.push_back(extents_[lights[place]].power);
        if (lights[place] >= triangle_count_) continue;
        triangles_[lights[place]].group = uint32_t(groups_.size());
        triangles_[lights[place]].place = place;
    }
    groups_.push_back({std::move(lights), AliasTable(powers), {}});
}

LightClusters::Choice LightSampler::Group::sample(glm::vec3 point, uint32_t bits) const {
    if (clusters) return clusters->sample(point, bits);
    const AliasTable::Choice chosen = table.sample(bits);
    return {chosen.index, chosen.rest, float(table.probability(chosen.index))};
}

float LightSampler::Group::probability(uint32_t place, glm::vec3 point) const {
    return clusters ? clusters->probability(place, point) : float(table.probability(place));
}

void LightSampler::add_triangles(const Scene& scene, uint32_t instance_index) {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    first_triangle_[instance_index] = uint32_t(triangles_.size());
    const bool varies = materials_.emission_varies(instance.material),
               emits_behind = scene.materials[instance.material].is_double_sided;
    for (uint32_t t = 0; t < instance.mesh->indices.size() / 3; ++t) {
        Triangle& light = triangles_.emplace_back();
        light.error = glm::vec3(0.0f);
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 position = instance.triangles[t].position[k];
            light.position[k] =
                instance.is_baked ? position : glm::vec3(instance.world_from_object * glm::vec4(position, 1.0f));
            light.error = glm::max(light.error, geometry_.point(instance_index, t, float(k == 1), float(k == 2)).error);
        }
        const glm::dvec3 p0(light.position[0]), p1(light.position[1]), p2(light.position[2]);
        const double area = 0.5 * glm::length(glm::cross(p1 - p0, p2 - p0));
        light.instance = instance_index;
        light.triangle = t;
        light.emission_varies = varies;
        light.emits_behind = emits_behind;
        light.radiance = materials_.emission(instance_index, t, 1.0f / 3, 1.0f / 3);
        light.front_normal = geometry_.point(instance_index, t, 1.0f / 3, 1.0f / 3).front_normal;
        light.per_area = area > 0 ? float(1 / area) : 0.0f;
        double emission = luminance(light.radiance);
        if (varies)
            emission = (1 - unprobed_share) * mean_emission(materials_, instance_index, t) +
                       unprobed_share * luminance(materials_.greatest_emission(instance.material));
        const glm::dvec3 center = (p0 + p1 + p2) / 3.0;
        double square_radius = 0;  // of a triangle, a twelfth of the sum over its corners
        for (const glm::dvec3& corner : {p0, p1, p2}) square_radius += glm::dot(corner - center, corner - center) / 12;
        extents_.push_back({
            .center = glm::vec3(center),
            .normal = emits_behind ? glm::vec3(0.0f) : light.front_normal,
            .square_radius = std::max(float(square_radius), least_square_radius),
            .power = area * emission * M_PI * (emits_behind ? 2 : 1),
        });
    }
}

void LightSampler::learn(std::vector<LightObservation> observations, bool may_cluster) {
    if (may_cluster) cluster_groups(observations);
    if (mirrored_.count() > 0) drop_images(observations);
    choice_.learn(observations, grid_);
}

/// Clusters are used where they lower the variance enough to pay for their time. The observed samples c were drawn by
/// power. Their sums of c^2, and of c^2 q / p with the probabilities q by power and p by clusters, estimate the second
/// moments of both choices, since the other choice would have brought c q / p.
void LightSampler::cluster_groups(std::span<const LightObservation> observations) {
    for (Group& group : groups_) {
        const bool are_suns = group.lights[0] >= triangle_count_ &&
                              lights_[group.lights[0] - triangle_count_].type == LightType::directional;
        std::vector<LightExtent> extents;
        for (const uint32_t light : group.lights) extents.push_back(extents_[light]);
        if (extents.size() > 1 && !are_suns) group.clusters.emplace(extents);
    }
    std::vector<double> saved(groups_.size(), 0.0);
    for (const LightObservation& seen : observations) {
        if (seen.group >= groups_.size() || !groups_[seen.group].clusters) continue;
        const Group& group = groups_[seen.group];
        const double by_power = group.table.probability(seen.light),
                     by_clusters = double(group.clusters->probability(seen.light, seen.position));
        saved[seen.group] += double(seen.relative) * double(seen.relative) * (1 - by_power / by_clusters);
    }
    for (size_t g = 0; g < groups_.size(); ++g)
        if (!(saved[g] > worthwhile_saving * double(observations.size()))) groups_[g].clusters.reset();
}

/// An image is sampled where this saves more variance than it costs. A contribution c of density p would be c p / q if
/// the lobe had found it by chance, with its density q: sums of c^2 p / q estimate the second moment that samples of
/// the image save. They take their share s of the samples from other lights. The variance of these grows by s of the
/// squared light, and the image's own is about as much. All is relative to the light of the pixel; s is the mean of c.
void LightSampler::drop_images(std::vector<LightObservation>& observations) {
    std::vector<double> gain(mirrored_.count(), 0.0);
    for (const LightObservation& seen : observations) {
        const double c = double(seen.relative);
        if (image(seen.group) != MirroredLamps::none && c > 0)
            gain[image(seen.group)] += c * c * double(seen.rarity) - 2 * c;
    }
    const std::vector<double> shares_before = shares();
    std::vector<uint32_t> kept;
    for (uint32_t i = 0; i < gain.size(); ++i)
        if (gain[i] > 0) kept.push_back(i);
    mirrored_.keep(kept);

    // The observations as the images that are left would have brought them.
    const std::vector<double> shares_now = shares();
    std::vector<uint32_t> group_now(shares_before.size(), no_group);
    for (uint32_t g = 0; g < first_image_; ++g) group_now[g] = g;
    for (uint32_t i = 0; i < kept.size(); ++i) group_now[first_image_ + kept[i]] = first_image_ + i;
    std::erase_if(observations, [&](const LightObservation& seen) { return group_now[seen.group] == no_group; });
    for (LightObservation& seen : observations) {
        const uint32_t now = group_now[seen.group];
        seen.contribution *= float(shares_before[seen.group] / shares_now[now]);
        seen.group = now;
    }
    choice_ = LightChoice(shares_now);
}

void LightSampler::sample(const Lanes<uint32_t>& is_wanted, const LanesVec3& point, const Lanes<uint32_t>& cell,
                          const Lanes<uint32_t>& x, const Lanes<uint32_t>& y, LightLanes& lights) const {
    Lanes<uint32_t> choice, rest, emits_behind;
    LanesVec3 p0, p1, p2;
    Lanes<float> u, v, probability;
    for (int lane = 0; lane < lane_count; ++lane) {
        if (!is_wanted[lane]) continue;
        const LightChoice::Choice group = choice_.sample(cell[lane], x[lane]);
        lights.group[lane] = group.group;
        probability[lane] = choice_.probability(cell[lane], group.group);
        if (group.group >= groups_.size()) {
            choice[lane] = group.group < first_image_ ? in_environment : in_mirror;
            lights.light[lane] = 0;
            rest[lane] = group.rest;
            continue;
        }
        const LightClusters::Choice chosen = groups_[group.group].sample(point.get(lane), group.rest);
        lights.light[lane] = chosen.light;
        choice[lane] = groups_[group.group].lights[chosen.light];
        rest[lane] = chosen.rest;
        probability[lane] *= chosen.probability;
        if (choice[lane] >= triangle_count_) continue;
        const Triangle& light = triangles_[choice[lane]];
        p0.set(lane, light.position[0]);
        p1.set(lane, light.position[1]);
        p2.set(lane, light.position[2]);
        lights.error.set(lane, light.error);
        lights.normal.set(lane, light.front_normal);
        lights.radiance.set(lane, light.radiance);
        lights.pdf[lane] = light.per_area * probability[lane];
        emits_behind[lane] = light.emits_behind;
    }
    FOR_EACH_LANE {
        const glm::vec2 at = triangle_barycentrics({unit_float(rest[lane]), unit_float(y[lane])});
        u[lane] = at.x;
        v[lane] = at.y;
        const glm::vec3 position = (1.0f - at.x - at.y) * p0.get(lane) + at.x * p1.get(lane) + at.y * p2.get(lane);
        const glm::vec3 to_light = position - point.get(lane);
        const float square = glm::dot(to_light, to_light);
        const glm::vec3 direction = to_light * (1.0f / std::sqrt(square));
        const float cosine = -glm::dot(direction, lights.normal.get(lane));
        const bool is_lit = (cosine > 0.0f) | ((cosine < 0.0f) & (emits_behind[lane] != 0));
        lights.position.set(lane, position);
        lights.direction.set(lane, direction);
        lights.pdf[lane] = is_lit ? lights.pdf[lane] * square / std::fabs(cosine) : 0.0f;
        lights.is_delta[lane] = 0;
        lights.is_infinite[lane] = 0;
    }
    uint32_t to_environment = 0;  // bit per lane
    for (int lane = 0; lane < lane_count && needs_more_; ++lane) {
        if (!is_wanted[lane]) continue;
        const uint32_t index = choice[lane];
        if (index < triangle_count_) {
            if (triangles_[index].emission_varies)
                lights.radiance.set(lane, materials_.emission(triangles_[index].instance, triangles_[index].triangle,
                                                              u[lane], v[lane]));
            continue;
        }
        if (index == in_environment)
            to_environment |= 1u << lane;
        else if (index == in_mirror)
            sample_image(image(lights.group[lane]), point.get(lane), {unit_float(rest[lane]), unit_float(y[lane])},
                         probability[lane], lane, lights);
        else
            sample_punctual(lights_[index - triangle_count_], point.get(lane), probability[lane], lane, lights);
    }
    if (to_environment) sample_environment(to_environment, rest, y, probability, lights);
}

/// `lanes`: a bit each.
void LightSampler::sample_environment(uint32_t lanes, const Lanes<uint32_t>& x, const Lanes<uint32_t>& y,
                                      const Lanes<float>& probability, LightLanes& lights) const {
    AliasTable::Choice choice[lane_count];
    glm::vec2 place[lane_count];
    const auto part = [&](int lane) { return lights.group[lane] - uint32_t(groups_.size()); };
    const auto bits = [&](int lane) { return glm::uvec2(x[lane], y[lane]); };
    for_each_bit(lanes, [&](int lane) { environment_.prefetch(part(lane), bits(lane)); });
    for_each_bit(lanes, [&](int lane) { choice[lane] = environment_.choose(part(lane), bits(lane)); });
    for_each_bit(lanes, [&](int lane) {
        float pdf;
        place[lane] = environment_.place(part(lane), choice[lane], bits(lane), pdf);
        lights.pdf[lane] = pdf * probability[lane];
        lights.is_infinite[lane] = 1;
    });
    for_each_bit(lanes, [&](int lane) {
        const glm::vec3 direction = environment_.direction(place[lane]);
        lights.direction.set(lane, direction);
        lights.radiance.set(lane, environment_.radiance(place[lane], direction));
    });
}

void LightSampler::sample_punctual(const PunctualLight& light, glm::vec3 point, float probability, int lane,
                                   LightLanes& lights) const {
    const PunctualArrival arriving = arrival(light, point);
    const bool is_apart = arriving.is_infinite || light.position != point;
    lights.is_delta[lane] = 1;
    lights.is_infinite[lane] = arriving.is_infinite;
    lights.pdf[lane] = is_apart ? probability : 0.0f;
    lights.direction.set(lane, arriving.direction);
    lights.radiance.set(lane, arriving.irradiance);
    lights.position.set(lane, light.position);
    lights.error.set(lane, glm::vec3(0.0f));
    lights.normal.set(lane, glm::vec3(0.0f));
}

void LightSampler::sample_image(uint32_t image, glm::vec3 point, glm::vec2 u, float probability, int lane,
                                LightLanes& lights) const {
    const MirroredLamps::Sample sample = mirrored_.sample(image, point, u);
    lights.is_infinite[lane] = 1;  // the ray finds the mirror
    lights.pdf[lane] = sample.pdf * probability;
    lights.direction.set(lane, sample.direction);
    lights.radiance.set(lane, glm::vec3(sample.radiance));
}

float LightSampler::triangle_pdf(uint32_t cell, glm::vec3 point, uint32_t instance, uint32_t triangle, glm::vec3 normal,
                                 glm::vec3 direction, float distance) const {
    if (first_triangle_[instance] == no_light) return 0.0f;
    const Triangle& light = triangles_[first_triangle_[instance] + triangle];
    const float cosine = std::abs(glm::dot(normal, direction));
    if (light.group == no_group || !(cosine > 0)) return 0.0f;
    const float probability =
        choice_.probability(cell, light.group) * groups_[light.group].probability(light.place, point);
    return light.per_area * probability * distance * distance / cosine;
}

float LightSampler::environment_pdf(uint32_t cell, glm::vec2 place) const {
    const EnvironmentTable::Density density = environment_.density(place);
    return density.pdf * choice_.probability(cell, uint32_t(groups_.size()) + density.part);
}

float LightSampler::image_pdf(uint32_t cell, glm::vec3 point, glm::vec3 direction, uint32_t mirror, uint32_t group,
                              uint32_t light) const {
    const uint32_t image = mirrored_.image(mirror, groups_[group].lights[light] - triangle_count_);
    if (image == MirroredLamps::none) return 0.0f;
    return choice_.probability(cell, first_image_ + image) * mirrored_.pdf(image, point, direction);
}
