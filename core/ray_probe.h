#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

/// A ray that a technique traced, and where its tracer says that it ended. The layout is that of
/// variants/tracers/record.glsl.
struct RayRecord {
    glm::vec3 origin;     ///< view space (m)
    float is_traced;      ///< 1; 0: the technique traced no such ray
    glm::vec3 direction;  ///< view space, unit
    float confidence;     ///< of the hit; 0: a miss
    glm::vec2 position;   ///< where it ended: un-jittered screen (pixels)
    float distance;       ///< along the ray (m)
    uint32_t outcome;     ///< variants/tracers/outcome.h
    glm::uvec2 pixel;     ///< whose surface it met
    uint32_t fetches;     ///< of depth
    uint32_t unused;
};
static_assert(sizeof(RayRecord) == 64);

/// What a ray truly meets. The layout is that of variants/tracers/exact_scene/exact_scene.glsl.
struct ExactHit {
    glm::vec2 position{0};  ///< un-jittered screen (pixels), also of what is hidden; of hits in front of the camera
    float distance = 0;     ///< along the ray (m); of rays that meet nothing the distance of the far plane
    uint32_t outcome = 0;   ///< variants/tracers/outcome.h: hit, if the screen shows the point
};

/// Which of a pass's rays are answered by the scene in place of their march: the parameters exact_rays and exact_share.
struct AskedRays {
    std::string selector;  ///< "oracle", "confidence", "variance" or "random"
    double share = 0;      ///< of the rays that are traced
};

/// All rays of one pass of a frame: `rays_per_pixel` for each pixel, row by row.
struct RecordedRays {
    std::string stage;  ///< label of the pass
    unsigned rays_per_pixel = 1;
    std::vector<RayRecord> rays;
};

/// What experiments plug in between a technique and its tracer. Without it techniques run as they are.
struct RayProbe {
    /// Keeps the rays of the frames that follow; they are traced a second time for it.
    bool is_recording = false;
    std::vector<RecordedRays> recorded;  ///< by pass in their order; whoever reads them clears them

    /// Traced in place of those that the technique draws, by the passes of their stages: origin and direction; a pixel
    /// without a ray here misses. Empty: nothing is replaced.
    std::vector<RecordedRays> replayed;

    /// What the rays truly meet, for the tracer exact_scene; in the order of the rays.
    std::function<std::vector<ExactHit>(const RecordedRays&)> exact_hits;

    /// The same for a share of a pass's rays in place of their march, where it ended; of all others
    /// outcome_unanswered.
    std::function<std::vector<ExactHit>(const RecordedRays& marched, const AskedRays&)> answers;
};
