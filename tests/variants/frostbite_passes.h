#pragma once
#include "tests/variants/frostbite_technique.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"
#include "variants/common/horizon_image.h"

/// The parameters of all passes, for tests that run them one by one.
struct FrostbiteParameters {
    FrostbiteParameters();

    ParameterSet params;
    FrostbiteRayParameters ray{params};
    FrostbiteResolveParameters resolve{params};
};

/// What the passes up to the tracers leave.
struct FrostbiteTraced {
    HostImage ray_count;
    std::vector<uint32_t> smooth_list, rough_list;
    std::vector<uint32_t> arguments;
    glm::uvec2 extent;
    std::vector<glm::vec4> directions;
    std::vector<glm::uvec4> hits;

    bool is_ray(size_t index) const { return directions[index].w != 0; }
    bool is_hit(size_t index) const { return is_ray(index) && hits[index].x < 0xfffffffdu; }
    glm::ivec2 hit_pixel(size_t index) const { return {hits[index].x & 0xffff, hits[index].x >> 16}; }
};

/// The first three passes over one frame of a G-buffer.
FrostbiteTraced trace_frostbite(PassList& pass_list, const GBuffer& gbuffer, const FrostbiteParameters& parameters);
