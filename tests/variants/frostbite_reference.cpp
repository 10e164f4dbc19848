#include "tests/variants/frostbite_reference.h"

#include "variants/denoisers/first_turn.h"

using glm::dmat3, glm::dvec2, glm::dvec3, glm::dvec4;

namespace {

dvec3 rgb(const HostImage& image, glm::uvec2 at) {
    const float* p = image.pixel(at.x, at.y);
    return {p[0], p[1], p[2]};
}

double luminance(dvec3 c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

bool is_hit(const StoredRay& ray) { return ray.target < ray_into_surface; }

/// Smith's Lambda of GGX: Heitz 2014, eq. 72.
double lambda(double mu, double alpha) { return (std::sqrt(1 + alpha * alpha * (1 / (mu * mu) - 1)) - 1) / 2; }

double distribution(double cosine, double alpha) {
    const double s = cosine * cosine * (alpha * alpha - 1) + 1;
    return alpha * alpha / (M_PI * s * s);
}

}  // namespace

FrostbiteReference::FrostbiteReference(FrostbiteBench& bench, const std::vector<StoredRay>& rays,
                                       const Environment& environment)
    : bench_(bench),
      rays_(rays),
      environment_(environment),
      view_from_clip_(bench.camera.view_from_clip),
      view_from_world_(glm::mat3(bench.camera.view_from_world)),
      depth_(bench.pass_list.download(bench.gbuffer.depth)),
      normal_(bench.pass_list.download(bench.gbuffer.normal)),
      geometric_normal_(bench.pass_list.download(bench.gbuffer.geometric_normal)),
      base_color_(bench.pass_list.download(bench.gbuffer.base_color)),
      emission_(bench.pass_list.download(bench.gbuffer.emission)),
      dielectric_f0_(bench.pass_list.download(bench.gbuffer.dielectric_f0)),
      motion_(bench.pass_list.download(bench.gbuffer.motion)) {}

FrostbiteReference::Surface FrostbiteReference::surface(glm::uvec2 pixel) const {
    Surface s;
    const dvec2 uv = (dvec2(pixel) + 0.5 + dvec2(bench_.camera.jitter)) / dvec2(depth_.extent);
    const dvec4 p = view_from_clip_ * dvec4(uv * 2.0 - 1.0, *depth_.pixel(pixel.x, pixel.y), 1);
    s.position = dvec3(p) / p.w;
    s.n = normalize(view_from_world_ * rgb(normal_, pixel));
    s.geometric_n = normalize(view_from_world_ * rgb(geometric_normal_, pixel));
    s.o = -normalize(s.position);
    s.mu_o = dot(s.n, s.o);
    s.alpha = std::pow(normal_.pixel(pixel.x, pixel.y)[3], 2);
    const double metalness = base_color_.pixel(pixel.x, pixel.y)[3], specular = emission_.pixel(pixel.x, pixel.y)[3];
    s.f0 = glm::mix(rgb(dielectric_f0_, pixel) * specular, rgb(base_color_, pixel), metalness);
    s.f90 = glm::mix(specular, 1.0, metalness);
    return s;
}

dvec3 FrostbiteReference::reflectance_density(const Surface& s, dvec3 l) const {
    const dvec3 h = normalize(s.o + l);
    const double mu_i = dot(s.n, l);
    if (mu_i <= 0) return dvec3(0);
    const double masking = 1 / (1 + lambda(s.mu_o, s.alpha) + lambda(mu_i, s.alpha));
    const dvec3 fresnel = s.f0 + (dvec3(s.f90) - s.f0) * std::pow(1 - dot(s.o, h), 5);
    return fresnel * distribution(dot(s.n, h), s.alpha) * masking / (4 * s.mu_o);
}

double FrostbiteReference::lobe_density(const Surface& s, dvec3 l) const {
    const dvec3 h = normalize(s.o + l);
    const double cosine = dot(s.n, h), o_h = dot(s.o, h);
    if (bench_.ray_parameters.lobe.is("normals"))
        return distribution(cosine, s.alpha) * std::abs(cosine) / (4 * std::abs(o_h));
    return cosine <= 0 ? 0 : distribution(cosine, s.alpha) / ((1 + lambda(s.mu_o, s.alpha)) * s.mu_o * 4);
}

double FrostbiteReference::inverse_density(const StoredRay& ray, dvec3 l, double length) const {
    if (!bench_.resolve_parameters.reuse_jacobian) return ray.inverse_density;
    const glm::uvec2 hit(ray.target & 0xffff, ray.target >> 16);
    const dvec3 n = normalize(view_from_world_ * rgb(geometric_normal_, hit));
    const double from = std::max(std::abs(dot(n, dvec3(ray.direction))), 1e-3),
                 to = std::max(std::abs(dot(n, l)), 1e-3);
    const double area_density = from / ray.inverse_density / (double(ray.length) * ray.length);
    return to / (area_density * length * length);
}

dvec2 FrostbiteReference::color_place(glm::uvec2 pixel) const {
    const dvec2 centre = dvec2(pixel) + 0.5;
    if (!bench_.resolve_parameters.previous_frame || bench_.camera.frame.w == 0) return centre;
    const float* m = motion_.pixel(pixel.x, pixel.y);
    const glm::vec4 jitter = bench_.camera.jitter;
    return centre + dvec2(jitter.x - jitter.z, jitter.y - jitter.w) - dvec2(m[0], m[1]) * dvec2(motion_.extent);
}

FrostbiteReference::Result FrostbiteReference::resolve(glm::uvec2 pixel, const std::vector<glm::uvec2>& taps,
                                                       const std::function<dvec3(dvec2)>& color) const {
    const auto& parameters = bench_.resolve_parameters;
    const Surface s = surface(pixel);
    const unsigned max_rays = bench_.ray_parameters.max_rays, width = bench_.traced_extent().x;
    const bool is_half = bench_.ray_parameters.half_resolution;
    const unsigned turn = (bench_.camera.frame.x + first_turn(bench_.camera.frame.y)) % 4;
    const glm::uvec2 turns[4] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};

    Result result;
    std::vector<Weighed> weighed;
    double density_ratios = 0;
    for (const glm::uvec2 tap : taps)
        for (unsigned k = 0; k < max_rays; ++k) {
            const StoredRay& ray = rays_[(tap.y * width + tap.x) * max_rays + k];
            if (ray.inverse_density == 0) continue;
            const glm::uvec2 source = is_half ? min(2u * tap + turns[turn], depth_.extent - 1u) : tap;
            dvec3 l = ray.direction;
            double length = 0, inverse = ray.inverse_density, confidence = 0;
            dvec3 radiance(0);
            if (is_hit(ray)) {
                length = ray.length;
                if (parameters.neighbor_ray.is("hit_point") && source != pixel) {
                    const dvec3 to_hit = surface(source).position + double(ray.length) * l - s.position;
                    length = glm::length(to_hit);
                    l = to_hit / length;
                    inverse = inverse_density(ray, l, length);
                }
                const dvec2 place = color_place({ray.target & 0xffff, ray.target >> 16}), screen(depth_.extent);
                const bool is_inside = place.x >= 0 && place.y >= 0 && place.x <= screen.x && place.y <= screen.y;
                const dvec2 edge = min(abs(place), abs(screen - place));
                result.is_close_call = result.is_close_call || std::min(edge.x, edge.y) < 1e-3;
                confidence = is_inside ? ray.confidence : 0;
                radiance = color(place);
            }
            const double height = dot(s.geometric_n, l);
            const bool is_black = height <= 0;
            if (ray.target == ray_into_surface && !is_black) continue;
            if (is_black) confidence = 1, length = 0, radiance = dvec3(0);
            if (parameters.misses.is("fallback") && !is_black) {
                const glm::vec3 ws = glm::mat3(bench_.camera.world_from_view) * glm::vec3(l);
                radiance = glm::mix(dvec3(environment_.radiance(ws)), radiance, confidence);
            }
            const double mu_i = dot(s.n, l), ratio = lobe_density(s, l) * inverse;
            const double lowest = std::min(std::abs(mu_i), std::abs(height));
            result.is_close_call = result.is_close_call || lowest < 1e-4 || std::abs(ratio - 1e-3) < 1e-5;
            const bool is_lost = ray.target == ray_below_horizon;
            if (!is_lost || mu_i <= 0) density_ratios += ratio;
            if (is_lost || mu_i <= 0) continue;
            const dvec3 weight = parameters.estimator.is("c") ? dvec3(ratio) : reflectance_density(s, l) * inverse;
            weighed.push_back({weight, radiance, confidence, length, ratio});
        }

    dvec3 sum(0), weights(0), known(0);
    double lengths = 0, length_weights = 0, shortest = 0, longest = 0;
    for (const Weighed& w : weighed) {
        const double share = parameters.misses.is("fallback") ? 1 : w.confidence;
        sum += share * w.weight * w.radiance;
        known += share * w.weight;
        weights += w.weight;
        if (w.length == 0 || w.confidence == 0) continue;
        lengths += luminance(w.weight) * w.confidence * w.length;
        length_weights += luminance(w.weight) * w.confidence;
        if (w.density_ratio < 1e-3) continue;
        shortest = shortest == 0 ? w.length : std::min(shortest, w.length);
        longest = std::max(longest, w.length);
    }
    result.length = parameters.reflection_depth.is("min")   ? shortest
                    : parameters.reflection_depth.is("max") ? longest
                    : length_weights > 0                    ? lengths / length_weights
                                                            : 0;
    if (luminance(weights) == 0) {
        result.confidence = parameters.estimator.is("b") && density_ratios > 0 ? 1 : 0;
        return result;
    }
    result.confidence = luminance(known) / luminance(weights);
    if (result.confidence == 0) return result;
    result.radiance = parameters.estimator.is("b") ? sum / density_ratios / result.confidence : sum / known;
    return result;
}
