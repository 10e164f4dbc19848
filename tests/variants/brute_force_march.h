#pragma once
#include "core/host_image.h"
#include "core/shared/camera.h"

/// The parameters of mcguire_dda that the march on the CPU knows.
struct MarchSettings {
    double stride = 1, jitter = 1, thickness = 0.1, relative_thickness = 0, max_distance = 1e5;
    bool interval_from_origin = false;
};

struct MarchResult {
    bool is_hit = false;
    glm::ivec2 pixel{-1};
    double distance = 0;
    bool is_close_call =
        false;  ///< up to its end, some decision lay within float's rounding: another outcome is no error
};

/// The march of McGuire & Mara without its DDA: the distance along the ray at each visited pixel follows from
/// intersecting it, in double, with the plane that the pixel's column or row spans with the eye. `depth`: device depth.
MarchResult brute_force_march(const HostImage& depth, const CameraData& camera, glm::vec3 origin, glm::vec3 direction,
                              const MarchSettings& settings);
