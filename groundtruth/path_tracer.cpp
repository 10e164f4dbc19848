#include "groundtruth/path_tracer.h"

#include "groundtruth/light_sampler.h"
#include "groundtruth/lobes.h"
#include "groundtruth/sobol.h"

#include <cmath>
#include <limits>
#include <pmmintrin.h>
#include <xmmintrin.h>

namespace {

/// Denormal operands slow BVH traversal down; the mode is a property of each thread.
class FlushDenormals {
public:
    FlushDenormals() : before_(_mm_getcsr()) {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~FlushDenormals() { _mm_setcsr(before_); }

private:
    unsigned before_;
};

/// Pairs of the Sobol' point that the first hit uses; each later vertex takes the next two of its path's stream.
enum : uint32_t { pair_specular, pair_light, pair_diffuse, pair_first_free };
constexpr uint32_t pairs_per_vertex = 2;
constexpr uint32_t diffuse_stream = 1u << 16;  ///< pairs of the path that leaves along the diffuse lobe

/// Shadow rays end this much before the light, relative to its distance, so that they do not meet the light itself.
constexpr float shadow_end = 0.9999f;
/// Where a surface lies in a coordinate plane through the origin, points on it are exact and nothing offsets them: only hits
/// at a distance of zero must be left out.
constexpr float nearest_hit = std::numeric_limits<float>::min();
constexpr float infinite_distance = std::numeric_limits<float>::infinity();

/// On a hit, instID[0] is the index of the instance, whether it was baked or not.
bool intersect(RTCScene scene, vec3 origin, vec3 direction, RTCRayHit& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    ray.ray = {origin.x, origin.y, origin.z, nearest_hit, direction.x, direction.y, direction.z, 0.0f, infinite_distance, ~0u, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    if (ray.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) ray.hit.instID[0] = ray.hit.geomID;
    return true;
}

bool is_occluded(RTCScene scene, vec3 origin, vec3 direction, float far) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{origin.x, origin.y, origin.z, nearest_hit, direction.x, direction.y, direction.z, 0.0f, far, ~0u, 0, 0};
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0;
}

void count_ray(PixelEstimate& estimate, vec3 origin, vec3 direction, float far, bool is_shadow) {
    ++estimate.rays;
    if (estimate.record) estimate.record->push_back({origin, direction, far, is_shadow});
}

bool is_finite(vec3 v) { return std::isfinite(v.x + v.y + v.z); }

}  // namespace

struct PathTracer::State {
    const Scene& scene;
    CameraPose camera;
    glm::uvec2 extent;
    PathTracerSettings settings;
    EmbreeScene geometry;
    MaterialTable materials;
    LightSampler lights;
    bool has_environment;  ///< that is not black
    std::vector<LeftOut> left_out;

    State(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent, const PathTracerSettings& settings)
        : scene(scene),
          camera(camera),
          extent(extent),
          settings(settings),
          geometry(scene, pose, settings.keep_all),
          materials(scene, geometry, settings.keep_all),
          lights(scene, pose, geometry, materials,
                 settings.strategy == LightStrategy::light_only ||
                     (settings.strategy != LightStrategy::bsdf_only && scene.environment.type == Environment::Type::image),
                 settings.strategy != LightStrategy::light_only),
          has_environment(settings.keep_all || !scene.environment.is_black()) {}

    vec3 path(const SobolPoint& point, uint32_t pair, vec3 origin, vec3 direction, float pdf, PixelEstimate& estimate) const;

    /// Weight of the technique with density `pdf` where the other has density `other`.
    float mis_weight(float pdf, float other) const {
        if (settings.strategy == LightStrategy::balance) return pdf / (pdf + other);
        const float ratio = other / pdf;
        return 1.0f / (1.0f + ratio * ratio);
    }
    float bsdf_weight(float bsdf_pdf, float light_pdf) const {
        if (light_pdf == 0 || settings.strategy == LightStrategy::bsdf_only) return 1.0f;
        return settings.strategy == LightStrategy::light_only ? 0.0f : mis_weight(bsdf_pdf, light_pdf);
    }
    float light_weight(const LightSample& light, float bsdf_pdf) const {
        if (light.is_delta || settings.strategy == LightStrategy::light_only) return 1.0f;
        return settings.strategy == LightStrategy::bsdf_only ? 0.0f : mis_weight(light.pdf, bsdf_pdf);
    }
    bool is_visible(vec3 position, vec3 error, vec3 normal, const LightSample& light, PixelEstimate& estimate) const;
};

bool PathTracer::State::is_visible(vec3 position, vec3 error, vec3 normal, const LightSample& light, PixelEstimate& estimate) const {
    const vec3 origin = offset_origin(position, error, normal, light.direction);
    vec3 direction = light.direction;
    float far = infinite_distance;
    if (!light.is_infinite) {
        direction = (light.is_delta ? light.position : offset_origin(light.position, light.error, light.normal, -direction)) - origin;
        far = shadow_end;
    }
    count_ray(estimate, origin, direction, far, true);
    return !is_occluded(geometry.handle(), origin, direction, far);
}

/// Radiance that arrives along a ray which was drawn with density `pdf`, so that lights it meets share their weight with
/// the light samples taken where it starts.
vec3 PathTracer::State::path(const SobolPoint& point, uint32_t pair, vec3 origin, vec3 direction, float pdf,
                             PixelEstimate& estimate) const {
    vec3 radiance(0.0f), throughput(1.0f);
    for (unsigned depth = 1;; ++depth, pair += pairs_per_vertex) {
        RTCRayHit ray;
        count_ray(estimate, origin, direction, infinite_distance, false);
        if (!intersect(geometry.handle(), origin, direction, ray)) {
            if (has_environment)
                radiance += throughput * scene.environment.radiance(direction) * bsdf_weight(pdf, lights.environment_pdf(direction));
            return radiance;
        }
        const uint32_t instance = ray.hit.instID[0], triangle = ray.hit.primID;
        const ShadedPoint surface = materials.shade(instance, triangle, ray.hit.u, ray.hit.v, -direction);
        if (surface.emitted != vec3(0.0f)) {
            const float light_pdf = lights.triangle_pdf(instance, triangle, surface.geometric_normal, direction, ray.ray.tfar);
            radiance += throughput * surface.emitted * bsdf_weight(pdf, light_pdf);
        }
        if (depth >= settings.max_depth || surface.is_unlit) return radiance;

        const mat3 world_from_local = basis_from_normal(surface.normal);
        const vec3 o = -direction * world_from_local;
        if (o.z <= 0) return radiance;
        const Lobes lobes = make_lobes(surface.base_color, surface.metalness, surface.roughness, surface.specular, o, settings.model);
        const float q = lobes.specular_probability;

        if (!lights.empty()) {
            const LightSample light = lights.sample(surface.position, point.bits(pair));
            const vec3 i = light.direction * world_from_local;
            if (light.pdf > 0 && i.z > 0 && dot(light.direction, surface.geometric_normal) > 0) {
                const LobeValues f = evaluate(lobes, i);
                const float bsdf_pdf = mix(f.diffuse_pdf, f.specular_pdf, q);
                const vec3 part = throughput * (f.diffuse + f.specular) * light.radiance * (light_weight(light, bsdf_pdf) / light.pdf);
                if (part != vec3(0.0f) && is_visible(surface.position, surface.error, surface.geometric_normal, light, estimate))
                    radiance += part;
            }
        }

        // One number chooses the lobe and, stretched again, places the sample on it.
        vec2 u = point.pair(pair + 1);
        const bool is_specular = u.x < q;
        u.x = is_specular ? u.x / q : (u.x - q) / (1.0f - q);
        const vec3 i = is_specular ? sample_ggx_reflection_bounded(o, lobes.alpha, u) : sample_cosine(u);
        direction = world_from_local * i;
        if (i.z <= 0 || dot(direction, surface.geometric_normal) <= 0) return radiance;
        const LobeValues f = evaluate(lobes, i);
        pdf = mix(f.diffuse_pdf, f.specular_pdf, q);
        if (!(pdf > 0)) return radiance;
        throughput *= (f.diffuse + f.specular) / pdf;

        const float survival = max(throughput.x, max(throughput.y, throughput.z));
        if (!(survival > 0)) return radiance;
        if (settings.russian_roulette && depth >= 2 && survival < 1) {
            if (point.random(pair) >= survival) return radiance;
            throughput /= survival;
        }
        origin = offset_origin(surface.position, surface.error, surface.geometric_normal, direction);
    }
}

PathTracer::PathTracer(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                       const PathTracerSettings& settings)
    : state_(std::make_unique<State>(scene, pose, camera, extent, settings)) {}

PathTracer::~PathTracer() = default;

const std::vector<LeftOut>& PathTracer::left_out() const { return state_->left_out; }

size_t PathTracer::replay(std::span<const RecordedRay> rays) const {
    const FlushDenormals flush;
    size_t hits = 0;
    RTCRayHit hit;
    for (const RecordedRay& ray : rays)
        hits += ray.is_shadow ? is_occluded(state_->geometry.handle(), ray.origin, ray.direction, ray.far)
                              : intersect(state_->geometry.handle(), ray.origin, ray.direction, hit);
    return hits;
}

FirstHit PathTracer::first_hit(unsigned x, unsigned y) const {
    const FlushDenormals flush;
    const CameraRay camera_ray = ::camera_ray(state_->camera, state_->extent, {float(x) + 0.5f, float(y) + 0.5f});
    FirstHit hit;
    hit.view = -camera_ray.direction;
    RTCRayHit ray;
    if (!intersect(state_->geometry.handle(), camera_ray.origin, camera_ray.direction, ray)) {
        hit.emitted = state_->scene.environment.radiance(camera_ray.direction);
        return hit;
    }
    const uint32_t instance = ray.hit.instID[0];
    const ShadedPoint surface = state_->materials.shade(instance, ray.hit.primID, ray.hit.u, ray.hit.v, hit.view);
    hit.is_hit = true;
    hit.position = surface.position;
    hit.position_error = surface.error;
    hit.distance = glm::length(surface.position - camera_ray.origin);
    hit.depth = glm::dot(surface.position - vec3(state_->camera.world_from_view[3]), -vec3(state_->camera.world_from_view[2]));
    hit.geometric_normal = surface.geometric_normal;
    hit.normal = surface.normal;
    hit.base_color = surface.base_color;
    hit.metalness = surface.metalness;
    hit.roughness = surface.roughness;
    hit.specular = surface.specular;
    hit.material = state_->geometry.instance(instance).material;
    hit.instance = instance;
    hit.emitted = surface.emitted;
    hit.is_unlit = surface.is_unlit;
    return hit;
}

void PathTracer::trace(unsigned x, unsigned y, const FirstHit& hit, uint64_t seed, unsigned first_sample, unsigned count,
                       PixelEstimate& estimate) const {
    const State& state = *state_;
    const FlushDenormals flush;
    estimate.samples += count;
    if (!hit.is_hit || hit.is_unlit) return;
    const mat3 world_from_local = basis_from_normal(hit.normal);
    const vec3 o = hit.view * world_from_local;
    if (o.z <= 0) return;
    const Lobes lobes = make_lobes(hit.base_color, hit.metalness, hit.roughness, hit.specular, o, state.settings.model);
    const bool wants_specular = state.settings.specular && lobes.has_specular, wants_diffuse = state.settings.diffuse && lobes.has_diffuse;
    const uint64_t pixel_seed = mix_bits(seed ^ mix_bits(uint64_t(y) << 32 | x));

    for (unsigned sample = first_sample; sample < first_sample + count; ++sample) {
        const SobolPoint point(pixel_seed, sample);
        vec3 diffuse(0.0f), specular(0.0f), incident(0.0f);
        if (!state.lights.empty()) {
            const LightSample light = state.lights.sample(hit.position, point.bits(pair_light));
            const vec3 i = light.direction * world_from_local;
            if (light.pdf > 0 && i.z > 0 && dot(light.direction, hit.geometric_normal) > 0) {
                if (state.is_visible(hit.position, hit.position_error, hit.geometric_normal, light, estimate)) {
                    const LobeValues f = evaluate(lobes, i);
                    const vec3 arriving = light.radiance / light.pdf;
                    const float specular_weight = state.light_weight(light, f.specular_pdf);
                    if (wants_diffuse) diffuse += f.diffuse * arriving * state.light_weight(light, f.diffuse_pdf);
                    if (wants_specular) {
                        specular += f.specular * arriving * specular_weight;
                        if (!light.is_delta) incident += f.specular_pdf * arriving * specular_weight;
                    }
                }
            }
        }
        if (wants_specular) {
            const vec3 i = sample_ggx_reflection_bounded(o, lobes.alpha, point.pair(pair_specular));
            const vec3 direction = world_from_local * i;
            const LobeValues f = evaluate(lobes, i);
            if (f.specular_pdf > 0) {
                ++estimate.lobe_samples;
                if (dot(direction, hit.geometric_normal) > 0) {
                    ++estimate.paths;
                    const vec3 origin = offset_origin(hit.position, hit.position_error, hit.geometric_normal, direction);
                    const vec3 arriving = state.path(point, pair_first_free, origin, direction, f.specular_pdf, estimate);
                    specular += f.specular / f.specular_pdf * arriving;
                    incident += arriving;
                }
            }
        }
        if (wants_diffuse) {
            const vec3 i = sample_cosine(point.pair(pair_diffuse));
            const vec3 direction = world_from_local * i;
            const LobeValues f = evaluate(lobes, i);
            if (f.diffuse_pdf > 0 && dot(direction, hit.geometric_normal) > 0) {
                ++estimate.paths;
                const vec3 origin = offset_origin(hit.position, hit.position_error, hit.geometric_normal, direction);
                diffuse += f.diffuse / f.diffuse_pdf *
                           state.path(point, diffuse_stream, origin, direction, f.diffuse_pdf, estimate);
            }
        }
        if (!is_finite(diffuse) || !is_finite(specular) || !is_finite(incident)) {
            ++estimate.non_finite;
            continue;
        }
        estimate.diffuse += glm::dvec3(diffuse);
        estimate.specular += glm::dvec3(specular);
        estimate.incident += glm::dvec3(incident);
    }
}
