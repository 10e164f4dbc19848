#include "core/gbuffer/prefiltered_environment.h"

#include "core/gbuffer/environment_tree.h"
#include "core/shared/brdf.h"
#include "core/shared/environment.h"

#include <tbb/parallel_for.h>
#include <array>

/// Compiled twice, for processors with and without 8-wide arithmetic; the one that suits is chosen when the program
/// starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__)
#define SSRLAB_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SSRLAB_WIDE
#endif

namespace {

/// A node is fine enough where its radius is below this share of the distance over which the kernel changes: with 0.3,
/// the sums are within 0.5 % of direct integration (tests/gbuffer/prefilter_test.cpp).
const float max_relative_radius = 0.3f;

const unsigned block_size = 8, block_texels = block_size * block_size;

/// The reflection lobe along the normal has density D(m) / 4 (core/shared/brdf.h with mu_o = 1); alpha = 0 stands for
/// the cosine lobe of irradiance. Both are needed up to a factor only.
struct Lobe {
    float alpha;

    /// `q` = sin^2 of half the angle to the axis. `sharpness` = 1 / width of the node: nodes cut by the horizon count
    /// by the share above it.
    float density(float q, float sharpness) const {
        const float a2 = alpha * alpha;
        const float d = a2 / (q + a2 * (1 - q));
        const float above = 0.5f + (1 - 2 * q) * sharpness;
        return d * d * 0.5f *
               (1 + std::abs(above) - std::abs(above - 1));  // above clamped to [0, 1], in a form GCC vectorises
    }

    /// Angle (rad) over which the density changes much, at an angular distance from the axis.
    float scale(float distance) const {
        const float widest = 0.4f;
        if (alpha == 0) return widest;
        return std::min(std::sqrt(4 * alpha * alpha + distance * distance), widest);
    }
};

/// What an 8 x 8 block of one map's texels sums up: their directions, and the sums.
struct Block {
    std::array<float, block_texels> x, y, z, red{}, green{}, blue{}, weight{};
    glm::vec3 centre{0.0f};
    float radius = 0.0f;  ///< rad
};

/// Adds one node to all texels of the block. Area counts where the light is, so that light and weight err together: a
/// constant environment comes out exactly.
SSRLAB_WIDE void add_node(Block& block, const EnvironmentTree::Level& level, size_t i, const Lobe lobe) {
    const glm::vec3 light = level.flux_centre[i], flux = level.flux[i];
    const float solid_angle = level.solid_angle[i], sharpness = 0.5f / level.radius[i];
    float q[block_texels], density[block_texels];
    for (unsigned t = 0; t < block_texels; ++t) {
        const float x = light.x - block.x[t], y = light.y - block.y[t], z = light.z - block.z[t];
        q[t] = 0.25f * (x * x + y * y + z * z);
    }
    if (lobe.alpha == 0)
        for (unsigned t = 0; t < block_texels; ++t) density[t] = std::max(1 - 2 * q[t], 0.0f);
    else
        for (unsigned t = 0; t < block_texels; ++t) density[t] = lobe.density(q[t], sharpness);
    for (unsigned t = 0; t < block_texels; ++t) {
        block.red[t] += density[t] * flux.x;
        block.green[t] += density[t] * flux.y;
        block.blue[t] += density[t] * flux.z;
        block.weight[t] += density[t] * solid_angle;
    }
}

void gather(Block& block, const EnvironmentTree& tree, size_t depth, unsigned x, unsigned y, const Lobe& lobe) {
    const EnvironmentTree::Level& level = tree.levels[depth];
    const size_t i = level.index(x, y);
    // A chord is shorter than its angle, so this errs to the finer side.
    const float distance = std::max(0.0f, glm::length(level.centre[i] - block.centre) - block.radius - level.radius[i]);
    if (depth == 0 || level.radius[i] < max_relative_radius * lobe.scale(distance)) {
        add_node(block, level, i, lobe);
        return;
    }
    const glm::uvec2 below = tree.levels[depth - 1].extent;
    for (unsigned child = 0; child < 4; ++child) {
        const unsigned cx = 2 * x + (child & 1), cy = 2 * y + (child >> 1);
        if (cx < below.x && cy < below.y) gather(block, tree, depth - 1, cx, cy, lobe);
    }
}

/// The block whose first texel is (left, top) of a map.
Block block_at(unsigned left, unsigned top, glm::vec2 extent) {
    Block block;
    const auto direction = [&](unsigned t) {
        const glm::vec2 texel(left + t % block_size, top + t / block_size);
        return environment_direction((texel + 0.5f) / extent, 0.0f);
    };
    for (unsigned t = 0; t < block_texels; ++t) {
        const glm::vec3 d = direction(t);
        block.x[t] = d.x, block.y[t] = d.y, block.z[t] = d.z;
        block.centre += d;
    }
    block.centre = glm::normalize(block.centre);
    for (unsigned t = 0; t < block_texels; ++t)
        block.radius = std::max(block.radius, std::acos(std::clamp(glm::dot(direction(t), block.centre), -1.0f, 1.0f)));
    return block;
}

void filter_map(const EnvironmentTree& tree, unsigned level, HostImage& atlas) {
    const unsigned width = prefilter_width(level), height = width / 2, first_row = prefilter_row(level);
    const float roughness = float(level) / prefilter_roughness_steps;
    const Lobe lobe{level == prefilter_irradiance_level ? 0.0f : ggx_alpha(roughness)};
    const unsigned columns = width / block_size;
    tbb::parallel_for(0u, columns * (height / block_size), [&](unsigned index) {
        const unsigned left = index % columns * block_size, top = index / columns * block_size;
        Block block = block_at(left, top, {width, height});
        gather(block, tree, tree.levels.size() - 1, 0, 0, lobe);
        for (unsigned t = 0; t < block_texels; ++t) {
            float* texel = atlas.pixel(left + t % block_size, first_row + top + t / block_size);
            texel[0] = block.red[t] / block.weight[t];
            texel[1] = block.green[t] / block.weight[t];
            texel[2] = block.blue[t] / block.weight[t];
        }
    });
}

glm::vec3 sample_level(const HostImage& atlas, unsigned level, glm::vec3 direction) {
    const PrefilterTap tap = prefilter_tap(level, environment_uv(direction, 0.0f));
    const auto texel = [&](unsigned x, unsigned y) {
        const float* p = atlas.pixel(x, y);
        return glm::vec3(p[0], p[1], p[2]);
    };
    const glm::vec3 top = mix(texel(tap.columns.x, tap.rows.x), texel(tap.columns.y, tap.rows.x), tap.fraction.x);
    const glm::vec3 bottom = mix(texel(tap.columns.x, tap.rows.y), texel(tap.columns.y, tap.rows.y), tap.fraction.x);
    return mix(top, bottom, tap.fraction.y);
}

}  // namespace

PrefilteredEnvironment prefilter_environment(const Environment& environment) {
    PrefilteredEnvironment result;
    if (environment.type == Environment::Type::constant) return result;
    const EnvironmentTree tree = build_environment_tree(environment);
    result.atlas = HostImage({prefilter_atlas_width, prefilter_atlas_height}, 3);
    for (unsigned level = 1; level <= prefilter_irradiance_level; ++level) filter_map(tree, level, result.atlas);
    return result;
}

glm::vec3 mean_over_lobe(const Environment& environment, const PrefilteredEnvironment& prefiltered, glm::vec3 direction,
                         float roughness) {
    if (prefiltered.atlas.values.empty()) return environment.radiance(direction);
    const PrefilterBlend blend = prefilter_blend(roughness);
    const glm::vec3 sharp =
        blend.level == 0 ? environment.radiance(direction) : sample_level(prefiltered.atlas, blend.level, direction);
    return mix(sharp, sample_level(prefiltered.atlas, blend.level + 1, direction), blend.fraction);
}
