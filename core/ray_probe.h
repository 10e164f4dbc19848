#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

/// A ray that a technique traced, and the end that its tracer found. The layout is that of
/// variants/tracers/record.glsl.
struct RayRecord {
    glm::vec3 origin;     ///< view space (m)
    float is_traced;      ///< 1; 0: the technique traced no such ray
    glm::vec3 direction;  ///< view space, unit
    float confidence;     ///< of the hit; 0: a miss
    glm::vec2 position;   ///< where it ended: un-jittered screen (pixels)
    float distance;       ///< along the ray (m)
    uint32_t outcome;     ///< variants/tracers/outcome.h
    glm::uvec2 pixel;     ///< the pixel whose surface it met
    uint32_t fetches;     ///< of depth, by its march
    uint32_t unused;
};
static_assert(sizeof(RayRecord) == 64);

/// What a ray truly meets. The layout is that of variants/tracers/exact_scene/exact_scene.glsl.
struct ExactHit {
    glm::vec2 position{0};  ///< un-jittered screen (pixels), even if hidden; only for hits in front of the camera
    float distance = 0;     ///< along the ray (m); to the far plane if the ray meets nothing
    uint32_t outcome = 0;   ///< variants/tracers/outcome.h: hit, if the screen shows the point
};

/// Which rays of a pass the scene answers instead of their march: the parameters exact_rays and exact_share.
struct AskedRays {
    std::string selector;  ///< "oracle", "confidence", "variance" or "random"
    double share = 0;      ///< share of the traced rays
};

/// All rays of one pass of a frame: `rays_per_pixel` for each pixel, row by row.
struct RecordedRays {
    std::string stage;  ///< label of the pass
    unsigned rays_per_pixel = 1;
    std::vector<RayRecord> rays;
};

/// What experiments insert between a technique and its tracer. Techniques run unchanged without it.
struct RayProbe {
    /// Records the rays of later frames, which are traced a second time for it.
    bool is_recording = false;
    std::vector<RecordedRays> recorded;  ///< one per pass, in order; the reader clears them

    /// Rays (origin and direction) that the passes of their stages trace instead of the technique's. A pixel without a
    /// ray misses. Empty: nothing is replaced.
    std::vector<RecordedRays> replayed;

    /// What the rays truly meet, for the tracer exact_scene; in the order of the rays.
    std::function<std::vector<ExactHit>(const RecordedRays&)> exact_hits;

    /// The same for a share of a pass's rays, whose marches ended as `marched` says; outcome_unanswered for all others.
    std::function<std::vector<ExactHit>(const RecordedRays& marched, const AskedRays&)> answers;
};
