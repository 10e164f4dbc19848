#include "groundtruth/paths/path_tracer.h"

#include "groundtruth/paths/composite_terms.h"
#include "groundtruth/paths/lamp_reflection.h"
#include "groundtruth/paths/path_lanes.h"
#include "groundtruth/paths/pixel_samples.h"
#include "groundtruth/paths/shadow_roulette.h"
#include "groundtruth/sampling/flush_denormals.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>

namespace {

bool is_finite(vec3 v) { return std::isfinite(v.x + v.y + v.z); }

/// The first hit of one pixel and the parts of it that are estimated.
struct FirstVertex {
    const FirstHit& hit;
    mat3 world_from_local{};
    Lobes lobes{};
    bool wants_diffuse = false, wants_specular = false;
    uint32_t light_cell = 0;               ///< see LightChoice::cell()
    float per_estimate[2] = {0.0f, 0.0f};  ///< see PathStart; diffuse, specular
    float share = 1.0f;                    ///< of one direction in its sample
};

// Of scenes whose dielectrics reflect other than 0.04. Not inlined, so that the code of all others keeps its rounding.
[[gnu::noinline]] Lobes lobes_of_own_f0(const FirstHit& hit, vec3 o, ReflectionModel model) {
    return make_lobes(hit.base_color, hit.metalness, hit.roughness, hit.specular, hit.dielectric_f0, o, model);
}

/// Fills in all but the hit; false if the surface reflects nothing: the background, unlit materials, and where the
/// viewer is below the horizon of the shading normal.
bool prepare(const TracedScene& scene, FirstVertex& vertex) {
    const FirstHit& hit = vertex.hit;
    if (!hit.is_hit || hit.is_unlit) return false;
    vertex.world_from_local = basis_from_normal(hit.normal);
    const vec3 o = hit.view * vertex.world_from_local;
    if (o.z <= 0) return false;
    vertex.lobes = make_lobes(hit.base_color, hit.metalness, hit.roughness, hit.specular, o, scene.settings.model);
    if (scene.materials.any_dielectric_f0()) vertex.lobes = lobes_of_own_f0(hit, o, scene.settings.model);
    vertex.light_cell = scene.lights.choice().cell(scene.lights.grid().index(hit.ray_origin, hit.geometric_normal));
    vertex.wants_diffuse = scene.settings.diffuse && vertex.lobes.has_diffuse;
    vertex.wants_specular = scene.settings.specular && vertex.lobes.has_specular;
    return true;
}

/// Specularly reflected radiance of all punctual lights, in closed form but for their visibility.
void add_highlight(const TracedScene& scene, FirstHit& hit) {
    FirstVertex vertex{.hit = hit};
    if (scene.lights.punctual_lights().empty() || !prepare(scene, vertex) || !vertex.wants_specular) return;
    PixelEstimate cost;
    const ReflectingPoint point{hit.position, hit.ray_origin, hit.position_error, hit.geometric_normal};
    for (const PunctualLight& light : scene.lights.punctual_lights())
        hit.highlight += specular_reflection(scene, light, point, vertex.lobes, vertex.world_from_local, cost);
    hit.shadow_rays = unsigned(cost.rays);
    hit.is_highlight_finite = is_finite(hit.highlight);
    if (!hit.is_highlight_finite) hit.highlight = vec3(0.0f);
}

/// A light sample's part of the lower rungs: emission is the same towards the camera.
void add_emission(const TracedScene& scene, const LightLanes& lights, int lane, vec3 incident,
                  PixelEstimate& estimate) {
    if (incident == vec3(0.0f)) return;
    const vec3 direction = lights.direction.get(lane), normal = lights.normal.get(lane);
    const vec3 lit_side = dot(direction, normal) < 0 ? normal : -normal;
    estimate.camera_radiance += glm::dvec3(incident);
    const bool is_shown = lights.is_infinite[lane] ? is_on_screen(scene, direction, estimate)
                                                   : is_on_screen(scene, lights.position.get(lane),
                                                                  lights.error.get(lane), lit_side, estimate);
    if (is_shown) estimate.on_screen += glm::dvec3(incident);
}

/// Light samples at the first hit.
void add_direct_light(const TracedScene& scene, const FirstVertex& vertex, const SampleLanes& samples) {
    const FirstHit& hit = vertex.hit;
    Lanes<uint32_t> x, y;
    Lanes<uint32_t> is_wanted, cell;
    LanesVec3 point;
    FOR_EACH_LANE {
        const glm::uvec2 bits = samples.sequence(lane).bits(samples.reversed_sample[lane], pair_light);
        x[lane] = bits.x;
        y[lane] = bits.y;
        is_wanted[lane] = lane < samples.count;
        cell[lane] = vertex.light_cell;
        point.set(lane, hit.position);
    }
    LightLanes lights;
    scene.lights.sample(is_wanted, point, cell, x, y, lights);

    // Copies, which no store of the loop can reach.
    const Lobes lobes = vertex.lobes;
    const mat3 world_from_local = vertex.world_from_local;
    const vec3 origin = hit.ray_origin, error = hit.position_error, geometric_normal = hit.geometric_normal;
    const MisHeuristic mis = scene.mis;
    const bool wants_diffuse = vertex.wants_diffuse, wants_specular = vertex.wants_specular;
    const float per_diffuse = vertex.per_estimate[0], per_specular = vertex.per_estimate[1];
    const bool plays = scene.settings.shadow_roulette & (!wants_diffuse | (per_diffuse > 0.0f)) &
                       (!wants_specular | (per_specular > 0.0f));
    LanesVec3 diffuse, specular, incident;
    FOR_EACH_LANE {
        const vec3 to_light = lights.direction.get(lane);
        const LobeValues f = evaluate(lobes, to_light * world_from_local);
        const float pdf = lights.pdf[lane];
        const bool is_delta = lights.is_delta[lane] != 0, is_used = (pdf > 0) & (dot(to_light, geometric_normal) > 0);
        // Each output is an estimator of its own: the light shares its weight with the lobe of that output.
        const float diffuse_weight = (is_delta ? 1.0f : mis.of_light(pdf, f.diffuse_pdf)) / pdf;
        const float specular_weight = mis.of_light(pdf, f.specular_pdf) / pdf;
        const vec3 radiance = lights.radiance.get(lane);
        const bool adds_diffuse = is_used & wants_diffuse, adds_specular = is_used & !is_delta & wants_specular;
        const vec3 to_diffuse = keep_if(adds_diffuse, f.diffuse * radiance * diffuse_weight);
        const vec3 to_specular = keep_if(adds_specular, f.specular * radiance * specular_weight);
        const vec3 to_incident = keep_if(adds_specular, radiance * (f.specular_pdf * specular_weight));
        const float promised = max(luminance(to_diffuse) * per_diffuse, luminance(to_specular) * per_specular);
        const float chance = shadow_ray_chance(promised, plays);
        const bool is_traced = samples.sequence(lane).random(samples.reversed_sample[lane], pair_light) < chance;
        diffuse.set(lane, keep_if(is_traced, to_diffuse * (1.0f / chance)));
        specular.set(lane, keep_if(is_traced, to_specular * (1.0f / chance)));
        incident.set(lane, keep_if(is_traced, to_incident * (1.0f / chance)));
        aim_shadow_ray(origin, error, geometric_normal, lane, lights);
    }
    for (int lane = 0; lane < samples.count; ++lane) {
        PixelEstimate& estimate = *samples.estimate[lane];
        vec3 parts[3] = {diffuse.get(lane), specular.get(lane), incident.get(lane)};
        const vec3 sum = parts[0] + parts[1] + parts[2];
        estimate.non_finite += !is_finite(sum);
        const bool is_used = sum != vec3(0.0f) && is_finite(sum);
        const vec3 arriving = is_used ? ::arriving(scene, lights, lane, 1, estimate) : vec3(0.0f);
        const bool arrives = arriving != vec3(0.0f);
        for (vec3& part : parts) part = part * arriving;
        if (estimate.light_record) [[unlikely]] {
            const LobeValues f = evaluate(lobes, lights.direction.get(lane) * world_from_local);
            estimate.light_record->push_back({hit.ray_origin, hit.geometric_normal, lights.group[lane],
                                              lights.light[lane], arrives ? luminance(parts[0] + parts[1]) : 0.0f,
                                              lights.pdf[lane] / max(f.diffuse_pdf, f.specular_pdf)});
        }
        if (!arrives) continue;
        estimate.diffuse += glm::dvec3(parts[0] * vertex.share);
        estimate.specular += glm::dvec3(parts[1] * vertex.share);
        estimate.incident += glm::dvec3(parts[2]);
        const bool is_emitted = scene.lights.image(lights.group[lane]) == MirroredLamps::none;
        if (scene.settings.ladder && is_emitted) add_emission(scene, lights, lane, parts[2], estimate);
    }
}

/// Starts their paths of one lobe.
void start_paths(const FirstVertex& vertex, const SampleLanes& samples, bool is_specular, PathLanes& paths) {
    const float share = vertex.share, per_estimate = vertex.per_estimate[is_specular] / share;
    const FirstHit& hit = vertex.hit;
    LanesVec3 origin, direction, weight;
    Lanes<float> pdf, local_height;
    FOR_EACH_LANE {
        const vec2 u =
            samples.sequence(lane).pair(samples.reversed_sample[lane], is_specular ? pair_specular : pair_diffuse);
        const vec3 i =
            choose(is_specular, sample_ggx_reflection_bounded(vertex.lobes.o, vertex.lobes.alpha, u), sample_cosine(u));
        const LobeValues f = evaluate(vertex.lobes, i);
        const float lobe_pdf = is_specular ? f.specular_pdf : f.diffuse_pdf;
        const vec3 towards = vertex.world_from_local * i;
        pdf[lane] = lobe_pdf;
        local_height[lane] = dot(towards, hit.geometric_normal);
        direction.set(lane, towards);
        weight.set(lane, choose(is_specular, f.specular, f.diffuse) * (share / lobe_pdf));
        origin.set(lane, offset_origin(hit.ray_origin, hit.position_error, hit.geometric_normal, towards));
    }
    for (int lane = 0; lane < samples.count; ++lane) {
        if (!(pdf[lane] > 0)) continue;
        if (is_specular) ++samples.estimate[lane]->lobe_samples;
        if (local_height[lane] <= 0) continue;
        paths.start({samples.estimate[lane], samples.sequence(lane), origin.get(lane), direction.get(lane),
                     weight.get(lane), pdf[lane], vertex.light_cell, samples.reversed_sample[lane], is_specular,
                     per_estimate});
    }
}

/// Specular paths alone, and what they found of each batch.
std::vector<SampleBatch> trace_specular(const TracedScene& scene, const FirstVertex& vertex,
                                        const PixelSamples& samples, PathGoal goal) {
    std::vector<SampleBatch> found = samples.empty_batches();
    PathLanes paths(scene, goal);
    samples.with(found).for_each_lanes([&](const SampleLanes& lanes) { start_paths(vertex, lanes, true, paths); });
    paths.finish();
    return found;
}

/// The lower rungs of the truth ladder, along the same directions as the specular paths.
void add_lit_colors(const TracedScene& scene, const FirstVertex& vertex, const PixelSamples& samples) {
    const std::vector<SampleBatch> found = trace_specular(scene, vertex, samples, PathGoal::lit_color);
    for (size_t b = 0; b < found.size(); ++b) {
        const PixelEstimate& lit = found[b].estimate;
        PixelEstimate& estimate = samples.batches()[b].estimate;
        estimate.camera_radiance += lit.camera_radiance;
        estimate.on_screen += lit.on_screen;
        // Directions below the geometric horizon meet the surface itself, which the image shows, and carry no light.
        estimate.on_screen_samples += lit.on_screen_samples + (lit.lobe_samples - lit.paths);
        estimate.non_finite += lit.non_finite;
        estimate.rays += lit.rays;
        estimate.paths += lit.paths;
    }
}

/// Samples that teach what the scene is like, at least, where few things are learnt of each cell and where more are,
/// and of how many pixels at most. Their seeds are no other's: what a render draws must not depend on what it learnt
/// from.
constexpr unsigned few_groups = 8, learning_samples_of_few = 1u << 15, learning_samples_of_more = 1u << 16;
constexpr unsigned learning_pixels = 1u << 11;
constexpr uint64_t light_seed = 0x6c69676874730a01u, radiance_seed = 0x7261646961e0a02u;

/// A pixel darker than this share of the image's mean promises paths as much as one that is so bright.
constexpr double estimate_floor = 0.1;

}  // namespace

struct PathTracer::State {
    CameraPose camera;
    glm::uvec2 extent;
    TracedScene scene;
    std::vector<LeftOut> left_out;
    HostImage per_estimate[2];  ///< 1 / luminance that a pixel is thought to hold, diffuse and specular; see expect()
    std::optional<CompositeTerms> composite_terms;  ///< with PathTracerSettings::ladder
};

/// What paths from pixels all over the image take down, in an order that no number of threads changes. Each pixel
/// stands somewhere else in its stretch of the rows, or images as wide as a multiple of the stretch would be looked at
/// in a few columns only.
template <class Observation>
std::vector<Observation> PathTracer::learn(uint64_t seed, unsigned wanted_samples,
                                           std::vector<Observation>* PixelEstimate::*record) const {
    const glm::uvec2 extent = state_->extent;
    const unsigned pixels = extent.x * extent.y, used = std::min(pixels, learning_pixels);
    const unsigned samples = std::max(wanted_samples / std::max(used, 1u), unsigned(lane_count));
    std::vector<std::vector<Observation>> seen(used);
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(0u, used, [&](unsigned i) {
            const uint64_t first = uint64_t(i) * pixels / used, end = uint64_t(i + 1) * pixels / used;
            const double turn = i * std::numbers::phi;
            const unsigned pixel = unsigned(first + uint64_t((turn - std::floor(turn)) * double(end - first)));
            const unsigned x = pixel % extent.x, y = pixel / extent.x;
            PixelEstimate estimate;
            estimate.*record = &seen[i];
            trace(x, y, first_hit(x, y), seed, 0, samples, estimate);
            if constexpr (std::is_same_v<Observation, LightObservation>) {  // what decides on clusters
                const double light = luminance(vec3(estimate.diffuse + estimate.specular)) / samples;
                for (LightObservation& light_seen : seen[i])
                    light_seen.relative = light > 0 ? float(light_seen.contribution / light) : 0.0f;
            }
        });
    });
    std::vector<Observation> all;
    for (const auto& part : seen) all.insert(all.end(), part.begin(), part.end());
    return all;
}

void PathTracer::learn_light_choice() {
    LightSampler& lights = state_->scene.lights;
    const uint32_t groups = lights.group_count() - lights.mirrored_lamps().count();  // of images few are left
    const unsigned samples = groups > few_groups ? learning_samples_of_more : learning_samples_of_few;
    lights.learn(learn(light_seed, samples, &PixelEstimate::light_record), state_->scene.settings.light_clusters);
}

void PathTracer::expect(const HostImage& diffuse, const HostImage& specular) {
    TracedScene& scene = state_->scene;
    if (!scene.expected.is_learnt())
        scene.expected.learn(learn(radiance_seed, learning_samples_of_few, &PixelEstimate::radiance_record),
                             scene.lights.grid());
    const HostImage* images[] = {&diffuse, &specular};
    for (const bool is_specular : {false, true}) {
        HostImage& per_estimate = state_->per_estimate[is_specular];
        per_estimate = HostImage(state_->extent, 1);
        double sum = 0;
        for (size_t i = 0; i < per_estimate.values.size(); ++i) {
            per_estimate.values[i] = luminance(images[is_specular]->rgb(i));
            sum += per_estimate.values[i];
        }
        const float floor = float(estimate_floor * sum / double(per_estimate.values.size()));
        for (float& value : per_estimate.values) value = floor > 0 ? 1.0f / std::max(value, floor) : 0.0f;
    }
}

PathTracer::PathTracer(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                       const PathTracerSettings& settings)
    : state_(new State{camera, extent, {scene, pose, CameraView(camera, extent), settings}, {}, {}, {}}) {
    if (settings.ladder) state_->composite_terms.emplace(state_->scene);
    state_->left_out = left_out_features(state_->scene);
    if (settings.learns_lights && state_->scene.lights.group_count() > 1 &&
        settings.strategy != LightStrategy::bsdf_only)
        learn_light_choice();
}

PathTracer::~PathTracer() = default;

const std::vector<LeftOut>& PathTracer::left_out() const { return state_->left_out; }

FirstHit PathTracer::first_hit(unsigned x, unsigned y) const {
    const FlushDenormals flush;
    const CameraRay camera_ray = ::camera_ray(state_->camera, state_->extent, {float(x) + 0.5f, float(y) + 0.5f});
    const TracedScene& scene = state_->scene;
    FirstHit hit;
    hit.view = -camera_ray.direction;
    RTCRayHit ray;
    if (!intersect_from_camera(scene.geometry.handle(), scene.camera, camera_ray.origin, camera_ray.direction, ray)) {
        hit.emitted = scene.scene.environment.radiance(camera_ray.direction);
        return hit;
    }
    const uint32_t instance = ray.hit.instID[0];
    const auto take = [&](const ShadedPoint& surface) {
        hit.position = surface.position;
        hit.ray_origin = surface.origin;
        hit.position_error = surface.error;
        hit.geometric_normal = surface.geometric_normal;
        hit.normal = unit_normal(surface.normal, surface.geometric_normal);
        hit.base_color = surface.base_color;
        hit.metalness = surface.metalness;
        hit.roughness = surface.roughness;
        hit.specular = surface.specular;
        hit.dielectric_f0 = surface.dielectric_f0;
        hit.emitted = surface.emitted;
        hit.is_unlit = surface.is_unlit;
    };
    scene.materials.shade(instance, ray.hit.primID, ray.hit.u, ray.hit.v, hit.view, ray.ray.tfar, take);
    hit.is_hit = true;
    hit.distance = glm::length(hit.position - camera_ray.origin);
    hit.depth =
        glm::dot(hit.position - vec3(state_->camera.world_from_view[3]), -vec3(state_->camera.world_from_view[2]));
    hit.material = scene.geometry.instance(instance).material;
    hit.instance = instance;
    add_highlight(scene, hit);
    if (state_->composite_terms) state_->composite_terms->add_to(hit);
    return hit;
}

void PathTracer::trace(unsigned x, unsigned y, const FirstHit& hit, uint64_t seed, unsigned first_sample,
                       unsigned count, PixelEstimate& estimate) const {
    SampleBatch batch{.seed = seed, .estimate = estimate};
    trace(x, y, hit, first_sample, count, {&batch, 1});
    estimate = batch.estimate;
}

void PathTracer::trace(unsigned x, unsigned y, const FirstHit& hit, unsigned first_sample, unsigned count,
                       std::span<SampleBatch> batches, Directions directions) const {
    const FlushDenormals flush;
    for (SampleBatch& batch : batches) batch.estimate.samples += count;
    const TracedScene& scene = state_->scene;
    FirstVertex vertex{.hit = hit};
    if (!prepare(scene, vertex)) return;
    vertex.wants_diffuse = vertex.wants_diffuse && directions.diffuse > 0;
    vertex.wants_specular = vertex.wants_specular && directions.specular > 0;
    for (const int lobe : {0, 1})
        if (const HostImage& image = state_->per_estimate[lobe]; !image.values.empty())
            vertex.per_estimate[lobe] = *image.pixel(x, y);

    const auto samples_of = [&](unsigned each) {
        return PixelSamples(x, y, first_sample * each, count * each, batches);
    };
    PathLanes paths(scene, PathGoal::reflection);
    const auto add = [&](FirstVertex part, unsigned each) {
        part.share = 1.0f / float(each);
        samples_of(each).for_each_lanes([&](const SampleLanes& lanes) {
            if (!scene.lights.empty()) add_direct_light(scene, part, lanes);
            if (part.wants_specular) start_paths(part, lanes, true, paths);
            if (part.wants_diffuse) start_paths(part, lanes, false, paths);
        });
    };
    if (directions.diffuse == directions.specular) {
        add(vertex, directions.diffuse);
    } else {
        FirstVertex diffuse = vertex, specular = vertex;
        diffuse.wants_specular = specular.wants_diffuse = false;
        if (vertex.wants_specular) add(specular, directions.specular);
        if (vertex.wants_diffuse) add(diffuse, directions.diffuse);
    }
    paths.finish();
    if (scene.settings.ladder && vertex.wants_specular) add_lit_colors(scene, vertex, samples_of(directions.specular));
    if (scene.settings.keep_all && scene.settings.specular &&
        !vertex.wants_specular)  // the price of not leaving them out
        trace_specular(scene, vertex, samples_of(directions.specular), PathGoal::reflection);
}
