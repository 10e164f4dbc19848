#include "groundtruth/paths/path_lanes.h"

#include "groundtruth/paths/lamp_reflection.h"
#include "groundtruth/paths/prefetched_hits.h"
#include "groundtruth/paths/shadow_roulette.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace {

/// Roulette by what paths promise: one that is expected to bring 1 / promise_window of its pixel's light goes on, and
/// one that is expected to bring nothing still with least_survival, since what is expected can be wrong. Measured over
/// windows of 1, 1.5, 3 and 10.
constexpr float promise_window = 2.0f, least_survival = 0.1f;

uint32_t bits_of(const Lanes<uint32_t>& flags) {
    uint32_t bits = 0;
    for (int lane = 0; lane < lane_count; ++lane) bits |= flags[lane] << lane;
    return bits;
}

/// The unit direction from a point to the camera; where that is behind the surface, to its mirror image before it, so
/// that every surface has a lit colour on the side that was met. Branchless.
vec3 to_camera(const CameraView& camera, vec3 position, vec3 normal) {
    const vec3 to_eye = camera.to_eye(position);
    const float height = dot(to_eye, normal), depth_behind = height < 0.0f ? height : 0.0f;
    const vec3 towards = to_eye - (2.0f * depth_behind) * normal;
    return towards * (1.0f / sqrt(dot(towards, towards)));
}

}  // namespace

PathLanes::PathLanes(const TracedScene& scene, PathGoal goal)
    : scene_(scene),
      goal_(goal),
      has_lights_(!scene.lights.empty()),
      has_images_(scene.lights.mirrored_lamps().count() > 0) {
    std::ranges::fill(mirrored_weight_.value, 1.0f);
}

void PathLanes::start(const PathStart& path) {
    while (resume_branches(), busy_ == all_lanes) advance();
    const int lane = std::countr_one(busy_);
    busy_ |= 1u << lane;
    estimate_[lane] = path.estimate;
    seed_a_[lane] = path.sequence.seed_a, seed_b_[lane] = path.sequence.seed_b;
    origin_.set(lane, path.origin);
    direction_.set(lane, path.direction);
    throughput_.set(lane, vec3(1.0f));
    radiance_.set(lane, vec3(0.0f));
    weight_.set(lane, path.weight);
    pdf_[lane] = path.pdf;
    light_cell_[lane] = path.light_cell;
    depth_[lane] = 1;
    pair_[lane] = path.is_specular ? uint32_t(pair_first_free) : diffuse_stream;
    reversed_sample_[lane] = path.reversed_sample;
    is_specular_[lane] = path.is_specular;
    per_estimate_[lane] = path.per_estimate;
    ++path.estimate->paths;
    records_ |= path.estimate->radiance_record != nullptr;
}

void PathLanes::finish() {
    while (resume_branches(), busy_ != 0) advance();
}

void PathLanes::trace_rays() {
    RTCRayHit ray[lane_count];
    uint32_t hits = 0;
    const uint32_t on_their_way = busy_ & ~resumed_;
    PrefetchedHits prefetched(scene_);
    for_each_bit(on_their_way, [&](int lane) {
        const vec3 origin = origin_.get(lane), direction = direction_.get(lane);
        ++estimate_[lane]->rays;
        if (!intersect(scene_.geometry.handle(), origin, direction, ray[lane])) return;
        hits |= 1u << lane;
        prefetched.add(ray[lane].hit);
    });
    prefetched.finish();
    if (scene_.has_environment || goal_ == PathGoal::lit_color) leave(on_their_way & ~hits);
    continues_ = {};
    for_each_bit(resumed_, [&](int lane) { continues_[lane] = 1; });
    for_each_bit(hits, [&](int lane) {
        meet(lane, ray[lane]);
        const size_t index = scene_.lights.grid().index(position_.get(lane), geometric_normal_.get(lane));
        learnt_index_[lane] = uint32_t(index);
        scene_.expected.prefetch(index);
        scene_.lights.choice().prefetch(index);
    });
}

/// Paths that meet nothing see the environment. `lanes`: a bit each.
void PathLanes::leave(uint32_t lanes) {
    const LightSampler& lights = scene_.lights;
    const bool has_table = lights.has_environment_table();
    vec2 place[lane_count];
    if (has_table)
        for_each_bit(lanes, [&](int lane) { place[lane] = lights.environment().place(direction_.get(lane)); });
    for_each_bit(lanes, [&](int lane) {
        const vec3 direction = direction_.get(lane);
        if (goal_ == PathGoal::lit_color && depth_[lane] == 1)
            is_on_screen_[lane] = is_on_screen(scene_, direction, *estimate_[lane]);
        const float light_pdf = has_table ? lights.environment_pdf(light_cell_[lane], place[lane]) : 0.0f;
        const vec3 radiance = has_table ? lights.environment().radiance(place[lane], direction)
                                        : scene_.scene.environment.radiance(direction);
        const float weight = scene_.mis.of_bsdf(pdf_[lane], light_pdf);
        radiance_.set(lane, radiance_.get(lane) + throughput_.get(lane) * radiance * weight);
    });
}

/// Takes in the surface at the end of a ray, and its emission.
void PathLanes::meet(int lane, const RTCRayHit& ray) {
    const uint32_t instance = ray.hit.instID[0], triangle = ray.hit.primID;
    const vec3 direction = direction_.get(lane);
    const auto take = [&](const ShadedPoint& surface) {
        if (surface.emitted != vec3(0.0f)) {
            const float light_pdf = scene_.lights.triangle_pdf(light_cell_[lane], origin_.get(lane), instance, triangle,
                                                               surface.geometric_normal, direction, ray.ray.tfar);
            const float weight = scene_.mis.of_bsdf(pdf_[lane], light_pdf);
            radiance_.set(lane, radiance_.get(lane) + throughput_.get(lane) * surface.emitted * weight);
        }
        position_.set(lane, surface.origin);
        error_.set(lane, surface.error);
        geometric_normal_.set(lane, surface.geometric_normal);
        normal_.set(lane, surface.normal);
        base_color_.set(lane, surface.base_color);
        dielectric_f0_.set(lane, surface.dielectric_f0);
        metalness_[lane] = surface.metalness;
        roughness_[lane] = surface.roughness;
        specular_[lane] = surface.specular;
        continues_[lane] = !surface.is_unlit;
        if (has_images_) [[unlikely]]
            mirror_[lane] = scene_.lights.mirrored_lamps().mirror(instance, triangle);
        if (goal_ == PathGoal::lit_color && depth_[lane] == 1)
            is_on_screen_[lane] =
                is_on_screen(scene_, surface.origin, surface.error, surface.geometric_normal, *estimate_[lane]);
    };
    scene_.materials.shade(instance, triangle, ray.hit.u, ray.hit.v, -direction, ray.ray.tfar, take);
}

void PathLanes::sample_lights() {
    Lanes<uint32_t> x, y;
    FOR_EACH_LANE {
        const glm::uvec2 bits = sequence(lane).bits(reversed_sample_[lane], pair_[lane]);
        x[lane] = bits.x;
        y[lane] = bits.y;
    }
    scene_.lights.sample(continues_, position_, light_cell_, x, y, lights_);
}

/// Light that a mirror reflects to the vertex before may have been found by a light sample of that vertex as well.
/// `reached`: the lanes whose path has a new vertex.
void PathLanes::weigh_images(uint32_t reached) {
    FOR_EACH_LANE { mirrored_weight_[lane] = 1.0f; }
    for_each_bit(reached, [&](int lane) {
        if (mirror_[lane] == MirroredLamps::none || !lights_.is_delta[lane]) return;
        const float pdf = scene_.lights.image_pdf(last_cell_[lane], origin_.get(lane), direction_.get(lane),
                                                  mirror_[lane], lights_.group[lane], lights_.light[lane]);
        mirrored_weight_[lane] = scene_.mis.of_bsdf(pdf_[lane], pdf);
    });
}

void PathLanes::look_ahead() {
    const bool splits = scene_.settings.splitting && goal_ == PathGoal::reflection;
    const LightChoice& choice = scene_.lights.choice();
    for_each_bit(bits_of(continues_), [&](int lane) {
        if (has_images_) [[unlikely]]
            last_cell_[lane] = light_cell_[lane];
        light_cell_[lane] = choice.cell(learnt_index_[lane]);
        choice.prefetch_cell(light_cell_[lane]);
    });
    for_each_bit(bits_of(continues_) & ~resumed_, [&](int lane) {
        promise_[lane] = per_estimate_[lane] > 0 ? per_estimate_[lane] * scene_.expected.at(learnt_index_[lane]) : 0.0f;
        part_[lane] = 1.0f;
        if (!splits || depth_[lane] >= scene_.settings.max_depth) return;
        // A path that promises more than twice the window is split into parts that bring about the window each. Half of
        // that gains a little more of the mean variance and costs rays that the median pixel does not need
        // (groundtruth/measurements.md). The direction is not known yet: about what the surface reflects stands for it.
        const vec3 reflectance = base_color_.get(lane) + 0.04f;
        const float parts =
            luminance(weight_.get(lane) * throughput_.get(lane) * reflectance) * promise_[lane] / promise_window;
        if (parts >= 2.0f) split(lane, parts);
    });
}

template <bool has_lights, PathGoal goal, bool has_dielectric_f0>
void PathLanes::scatter() {
    const bool has_roulette = scene_.settings.russian_roulette;
    const bool has_shadow_roulette = scene_.settings.shadow_roulette;
    const ReflectionModel model = scene_.settings.model;
    const uint32_t max_depth = scene_.settings.max_depth;
    const MisHeuristic mis = scene_.mis;
    const CameraView camera = scene_.camera;
    FOR_EACH_LANE {
        const vec3 geometric_normal = geometric_normal_.get(lane), throughput = throughput_.get(lane);
        const mat3 world_from_local = basis_from_normal(unit_normal(normal_.get(lane), geometric_normal));
        const bool is_lit_color = goal == PathGoal::lit_color && depth_[lane] == 1;
        vec3 to_viewer = -direction_.get(lane);
        if constexpr (goal == PathGoal::lit_color)
            to_viewer = choose(is_lit_color, to_camera(camera, position_.get(lane), geometric_normal), to_viewer);
        const vec3 o = to_viewer * world_from_local;
        const Lobes lobes = [&] {
            if constexpr (has_dielectric_f0)
                return make_lobes(base_color_.get(lane), metalness_[lane], roughness_[lane], specular_[lane],
                                  dielectric_f0_.get(lane), o, model);
            else
                return make_lobes(base_color_.get(lane), metalness_[lane], roughness_[lane], specular_[lane], o, model);
        }();
        const float q = is_lit_color ? 0.0f : lobes.specular_probability;
        const float specular_share = is_lit_color ? 0.0f : 1.0f;       // the lit colour is without reflections
        const bool reflects = (continues_[lane] != 0) & (o.z > 0.0f);  // the viewer may be below the shading horizon
        const bool is_last = depth_[lane] >= max_depth;

        if constexpr (has_lights) {
            const vec3 to_light = lights_.direction.get(lane);
            const LobeValues f = evaluate(lobes, to_light * world_from_local);
            const float light_pdf = lights_.pdf[lane], bsdf_pdf = mix(f.diffuse_pdf, f.specular_pdf, q);
            const float weight = lights_.is_delta[lane] ? 1.0f : mis.of_light(light_pdf, bsdf_pdf);
            const bool is_used =
                reflects & !is_last & (light_pdf > 0) & (bsdf_pdf > 0) & (dot(to_light, geometric_normal) > 0);
            const float light_share = specular_share * mirrored_weight_[lane];
            rarity_[lane] = light_pdf / bsdf_pdf;
            const vec3 direct =
                throughput * (f.diffuse + f.specular * light_share) * lights_.radiance.get(lane) * (weight / light_pdf);
            const float promised = luminance(weight_.get(lane) * direct) * per_estimate_[lane];
            const float chance = shadow_ray_chance(promised, has_shadow_roulette & (per_estimate_[lane] > 0.0f));
            const bool is_traced = sequence(lane).random(reversed_sample_[lane], pair_[lane] + 1) < chance;
            direct_.set(lane, keep_if(is_used & is_traced, direct * (1.0f / chance)));
            aim_shadow_ray(position_.get(lane), error_.get(lane), geometric_normal, lane, lights_);
        }

        // One number chooses the lobe and, stretched again, places the sample on it.
        const vec2 u = sequence(lane).pair(reversed_sample_[lane], pair_[lane] + 1);
        const bool is_specular = u.x < q;
        const vec2 stretched(is_specular ? u.x / q : (u.x - q) / (1.0f - q), u.y);
        const vec3 i =
            choose(is_specular, sample_ggx_reflection_bounded(o, lobes.alpha, stretched), sample_cosine(stretched));
        const LobeValues f = evaluate(lobes, i);
        const float pdf = mix(f.diffuse_pdf, f.specular_pdf, q);
        const vec3 direction = world_from_local * i;
        const vec3 next = throughput * part_[lane] * (f.diffuse + f.specular * specular_share) * (1.0f / pdf);

        const float greatest = max(next.x, max(next.y, next.z));
        const bool by_promise = per_estimate_[lane] > 0.0f;
        const float promised = promise_window * luminance(weight_.get(lane) * next) * promise_[lane];
        const float bounded = max(promised, least_survival);  // apart: inside the choice it is a branch to the compiler
        const float chance = by_promise ? bounded : greatest;
        const bool plays = has_roulette & (by_promise | (depth_[lane] >= 2)) & (chance < 1.0f);
        const float survival = plays ? chance : 1.0f;
        const bool survives = sequence(lane).random(reversed_sample_[lane], pair_[lane]) < survival;
        const bool goes_on =
            reflects & (i.z > 0) & (dot(direction, geometric_normal) > 0) & (pdf > 0) & (greatest > 0) & survives;

        continues_[lane] = goes_on & !is_last;
        cut_.set(lane, keep_if(goes_on & is_last, next * (1.0f / survival)));
        throughput_.set(lane, next * (1.0f / survival));
        pdf_[lane] = pdf;
        origin_.set(lane, offset_origin(position_.get(lane), error_.get(lane), geometric_normal, direction));
        direction_.set(lane, direction);
        depth_[lane] += 1;
        pair_[lane] += pairs_per_vertex;
    }
}

/// `reached`: the lanes whose path has a new vertex.
void PathLanes::trace_shadow_rays(uint32_t reached) {
    for_each_bit(reached, [&](int lane) {
        const vec3 promised = direct_.get(lane);
        const vec3 direct = promised == vec3(0.0f)
                                ? promised
                                : promised * arriving(scene_, lights_, lane, depth_[lane], *estimate_[lane]);
        const bool arrives = direct != vec3(0.0f);
        if (arrives) radiance_.set(lane, radiance_.get(lane) + direct);
        std::vector<LightObservation>* const lights = estimate_[lane]->light_record;
        if (lights && depth_[lane] <= scene_.settings.max_depth) [[unlikely]]  // not the last vertex
            lights->push_back({position_.get(lane), geometric_normal_.get(lane), lights_.group[lane],
                               lights_.light[lane], arrives ? luminance(weight_.get(lane) * direct) : 0.0f,
                               rarity_[lane]});
    });
}

template <bool has_dielectric_f0>
void PathLanes::scatter() {
    constexpr PathGoal lit_color = PathGoal::lit_color, reflection = PathGoal::reflection;
    if (goal_ == lit_color)
        has_lights_ ? scatter<true, lit_color, has_dielectric_f0>() : scatter<false, lit_color, has_dielectric_f0>();
    else
        has_lights_ ? scatter<true, reflection, has_dielectric_f0>() : scatter<false, reflection, has_dielectric_f0>();
}

/// One segment of every path: to the next vertex, light there, and a new direction.
void PathLanes::advance() {
    trace_rays();
    look_ahead();
    const uint32_t reached = bits_of(continues_) & ~std::exchange(resumed_, 0);  // branches took their light before
    if (has_lights_) sample_lights();
    if (has_images_) weigh_images(reached);
    scene_.materials.any_dielectric_f0() ? scatter<true>() : scatter<false>();
    if (has_lights_) trace_shadow_rays(reached);
    const uint32_t continuing = bits_of(continues_);
    for_each_bit(busy_ & ~continuing, [&](int lane) { end(lane); });
    busy_ &= continuing;
    if (records_) [[unlikely]]
        record(continuing);
}

void PathLanes::record(uint32_t continuing) {
    visits_.resize(lane_count);
    for_each_bit(continuing, [&](int lane) {
        if (!estimate_[lane]->radiance_record) return;
        visits_[lane].push_back({position_.get(lane), geometric_normal_.get(lane), luminance(throughput_.get(lane)),
                                 luminance(radiance_.get(lane))});
    });
}

void PathLanes::end(int lane) {
    PixelEstimate& estimate = *estimate_[lane];
    if (!visits_.empty()) [[unlikely]] {
        for (const Visit& visit : visits_[lane]) {
            const float brought = (luminance(radiance_.get(lane)) - visit.radiance) / visit.throughput;
            if (std::isfinite(brought)) estimate.radiance_record->push_back({visit.position, visit.normal, brought});
        }
        visits_[lane].clear();
    }
    if (const vec3 cut = weight_.get(lane) * cut_.get(lane);
        goal_ == PathGoal::reflection && std::isfinite(cut.x + cut.y + cut.z))
        estimate.cut += glm::dvec3(cut);
    const vec3 radiance = radiance_.get(lane), reflected = weight_.get(lane) * radiance;
    if (!std::isfinite(reflected.x + reflected.y + reflected.z)) {
        ++estimate.non_finite;
    } else if (goal_ == PathGoal::lit_color) {
        estimate.camera_radiance += glm::dvec3(radiance);
        if (!is_on_screen_[lane]) return;
        estimate.on_screen += glm::dvec3(radiance);
        ++estimate.on_screen_samples;
    } else if (is_specular_[lane]) {
        estimate.specular += glm::dvec3(reflected);
        estimate.incident += glm::dvec3(radiance);
    } else {
        estimate.diffuse += glm::dvec3(reflected);
    }
}
