#include "core/gbuffer/environment_tree.h"

#include "core/shared/brdf.h"
#include "core/shared/environment.h"

namespace {

const unsigned max_width = 1024;

/// Solid angle of a texel in row y: a band of the sphere cut in `extent.x` pieces.
double texel_solid_angle(glm::uvec2 extent, unsigned y) {
    const double top = std::cos(pi * double(y) / extent.y), bottom = std::cos(pi * double(y + 1) / extent.y);
    return 2 * pi / extent.x * (top - bottom);
}

/// The environment in directions of texel centres, at its own resolution if it is an image.
HostImage texels(const Environment& environment) {
    if (environment.type == Environment::Type::image) return environment.latlong;
    HostImage image({256, 128}, 3);
    for (unsigned y = 0; y < image.extent.y; ++y)
        for (unsigned x = 0; x < image.extent.x; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(image.extent);
            image.set_rgb(size_t(y) * image.extent.x + x,
                          environment.radiance(environment_direction(uv, environment.rotation)));
        }
    return image;
}

EnvironmentTree::Level leaves(const HostImage& image, float rotation) {
    EnvironmentTree::Level level{.extent = image.extent};
    for (unsigned y = 0; y < image.extent.y; ++y) {
        const double solid_angle = texel_solid_angle(image.extent, y);
        const float sine = std::sin(pi * (y + 0.5f) / image.extent.y);
        const glm::vec2 size(2 * pi / image.extent.x * sine, pi / image.extent.y);
        for (unsigned x = 0; x < image.extent.x; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / glm::vec2(image.extent);
            level.flux.push_back(image.rgb(size_t(y) * image.extent.x + x) * float(solid_angle));
            level.solid_angle.push_back(float(solid_angle));
            level.centre.push_back(environment_direction(uv, rotation));
            level.flux_centre.push_back(level.centre.back());
            level.radius.push_back(0.5f * glm::length(size));
        }
    }
    return level;
}

/// How much the light of a node pulls the mean direction of its parent; negative radiance, which broken files hold,
/// counts as light too, so that the mean stays inside the node.
float pull(glm::vec3 flux) { return std::abs(flux.x) + std::abs(flux.y) + std::abs(flux.z); }

EnvironmentTree::Level parents(const EnvironmentTree::Level& below) {
    EnvironmentTree::Level level{.extent = (below.extent + 1u) / 2u};
    for (unsigned y = 0; y < level.extent.y; ++y)
        for (unsigned x = 0; x < level.extent.x; ++x) {
            glm::vec3 flux(0), centre(0), flux_centre(0);
            float solid_angle = 0, radius = 0;
            for (unsigned child = 0; child < 4; ++child) {
                const glm::uvec2 p(2 * x + (child & 1), 2 * y + (child >> 1));
                if (p.x >= below.extent.x || p.y >= below.extent.y) continue;
                const size_t i = below.index(p.x, p.y);
                flux += below.flux[i];
                solid_angle += below.solid_angle[i];
                centre += below.centre[i] * below.solid_angle[i];
                flux_centre += below.flux_centre[i] * pull(below.flux[i]);
                radius = std::max(radius, below.radius[i]);
            }
            // A ring around a pole, or the whole sphere, has no mean direction; such nodes are always split.
            const auto unit = [](glm::vec3 v, glm::vec3 fallback) {
                return glm::length(v) > 0 ? glm::normalize(v) : fallback;
            };
            level.flux.push_back(flux);
            level.solid_angle.push_back(solid_angle);
            level.centre.push_back(unit(centre, glm::vec3(0, 1, 0)));
            level.flux_centre.push_back(unit(flux_centre, level.centre.back()));
            level.radius.push_back(2 * radius);
        }
    return level;
}

/// Halves the width and height, keeping the flux.
HostImage halved(const HostImage& image) {
    HostImage half((image.extent + 1u) / 2u, 3);
    std::vector<double> weight(half.pixel_count(), 0.0);
    std::vector<glm::dvec3> sum(half.pixel_count(), glm::dvec3(0));
    for (unsigned y = 0; y < image.extent.y; ++y)
        for (unsigned x = 0; x < image.extent.x; ++x) {
            const size_t target = size_t(y / 2) * half.extent.x + x / 2;
            const double w = texel_solid_angle(image.extent, y);
            sum[target] += w * glm::dvec3(image.rgb(size_t(y) * image.extent.x + x));
            weight[target] += w;
        }
    for (size_t i = 0; i < sum.size(); ++i) half.set_rgb(i, glm::vec3(sum[i] / weight[i]));
    return half;
}

}  // namespace

EnvironmentTree build_environment_tree(const Environment& environment) {
    HostImage image = texels(environment);
    while (image.extent.x > max_width) image = halved(image);
    EnvironmentTree tree;
    tree.levels.push_back(leaves(image, environment.rotation));
    while (tree.levels.back().flux.size() > 1) tree.levels.push_back(parents(tree.levels.back()));
    return tree;
}
