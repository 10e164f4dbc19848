#include "tests/variants/frostbite_emitter.h"

#include "tests/variants/lobe_quadrature.h"

namespace {

/// The integral of g over t in (0, infinity), by the trapezoidal rule over ln t: it converges geometrically.
template <class Function>
double integral_over_positive(const Function& g) {
    const double step = 0.25;
    double sum = 0;
    for (double x = -30; x < 12; x += step) sum += g(std::exp(x)) * std::exp(x) * step;
    return sum;
}

}  // namespace

glm::vec3 EmitterCase::o() const {
    return {std::sin(glm::radians(view_degrees)), 0, std::cos(glm::radians(view_degrees))};
}

bool EmitterCase::is_emitter(glm::vec3 local) const {
    const glm::vec3 axis(-std::sin(glm::radians(emitter_from_normal)), 0, std::cos(glm::radians(emitter_from_normal)));
    return local.z > 0 && dot(axis, local) > std::cos(glm::radians(emitter_degrees));
}

EmitterTruth emitter_truth(const EmitterCase& scene, unsigned lobe, float importance_bias) {
    const glm::vec3 o = scene.o();
    const LobeCase truncated{lobe, scene.roughness, scene.view_degrees, importance_bias};
    EmitterTruth truth;
    const int rows = 180, columns = 180;  // half a turn: the other half mirrors it
    double above = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double polar = (row + 0.5) / rows * M_PI / 2, azimuth = (column + 0.5) / columns * M_PI;
            const glm::vec3 i(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                              std::cos(polar));
            if (importance_bias > 0 && !is_left_by_truncation(truncated, normalize(glm::dvec3(o + i)))) continue;
            const LobePoint point{lobe_density(lobe, o, i, scene.alpha()) / (1 - importance_bias),
                                  ggx_specular(o, i, scene.alpha()) * i.z, scene.radiance(i),
                                  std::sin(polar) * M_PI / 2 / rows * 2 * M_PI / columns};
            truth.reflectance += point.reflected * point.solid_angle;
            truth.reflected += point.reflected * point.radiance * point.solid_angle;
            above += point.density * point.solid_angle;
            truth.points.push_back(point);
        }
    truth.below_horizon = 1 - above;
    return truth;
}

double bias_of_a(const EmitterTruth& truth, unsigned rays) {
    const double above = 1 - truth.below_horizon;
    const double mean = integral_over_positive([&](double t) {
        double numerator = 0, denominator = 0;
        for (const LobePoint& p : truth.points) {
            const double weight = p.reflected / p.density, share = p.density * p.solid_angle / above;
            numerator += share * weight * p.radiance * std::exp(-t * weight);
            denominator += share * std::exp(-t * weight);
        }
        return rays * numerator * std::pow(denominator, rays - 1);
    });
    return mean / truth.mean() - 1;
}

double bias_of_c(const EmitterTruth& truth) {
    double sum = 0;
    for (const LobePoint& p : truth.points) sum += p.density * p.radiance * p.solid_angle;
    return sum / (1 - truth.below_horizon) / truth.mean() - 1;
}

double redrawn_factor(const EmitterTruth& truth, unsigned regenerations) {
    double sum = 0, reached = 1;  // probability of this draw
    for (unsigned draw = 0; draw <= regenerations; ++draw, reached *= truth.below_horizon) sum += reached;
    return 1 / sum;
}

double bias_of_b(const EmitterTruth& truth, unsigned rays, unsigned regenerations) {
    const double failed = std::pow(truth.below_horizon, regenerations + 1);
    // Without regenerations draws below the horizon count their own q / p, which is 1.
    const double below = regenerations > 0 ? truth.below_horizon : 0;
    const double above = redrawn_factor(truth, regenerations) + below, else_below = regenerations > 0 ? below : 1;
    const double mean = integral_over_positive([&](double t) {
        const double decay = (1 - failed) * std::exp(-t * above) + failed * std::exp(-t * else_below);
        return rays * truth.reflected * std::exp(-t * above) * std::pow(decay, rays - 1);
    });
    return mean / truth.reflected - 1;
}

DrawnRay draw_ray(const EmitterCase& scene, unsigned lobe, float bias, unsigned regenerations, std::mt19937& random) {
    const auto uniform = [&] { return float(random() >> 8) * 0x1p-24f; };
    for (unsigned draw = 0;; ++draw) {
        const glm::vec2 u(uniform(), uniform());
        const LobeSample drawn = sample_lobe(lobe, scene.o(), scene.alpha(), bias, u);
        const bool is_below_horizon = drawn.direction.z <= 0;
        if (!is_below_horizon || draw == regenerations)
            return {drawn.direction, drawn.inverse_density, is_below_horizon};
    }
}
