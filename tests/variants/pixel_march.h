#pragma once
#include "core/host_image.h"
#include "core/shared/camera.h"

/// A ray from the centre of a pixel, as Frostbite's tracers get it.
struct PixelRay {
    glm::ivec2 pixel;
    glm::vec3 origin, direction, normal;  ///< view space; the normal of the surface that it leaves
    float jitter = 0;                     ///< of the first linear step
};

struct PixelMarchResult {
    bool is_hit = false;
    glm::ivec2 pixel{-1};
    double distance = 0;
    bool is_close_call = false;  ///< some decision lay within float's rounding: another outcome is no error
};

/// Looks at every pixel that the ray crosses on the screen, in their order and in double: it hits where the depths that
/// it has within the pixel overlap those from the visible surface z to (1 + thickness) z, unless that surface is less
/// than half as high above the plane that the ray leaves as the ray is. `depth`: device depth.
PixelMarchResult march_every_pixel(const HostImage& depth, const CameraData& camera, const PixelRay& ray,
                                   double thickness);

/// Looks at the ends of steps on the screen, `steps` of them to the border, and at the border: there the ray must be
/// behind the surface, and somewhere on the step not behind (1 + thickness) z. Otherwise the same rule. The step that
/// hits is halved down to a pixel, at most `refinements` times, and the nearest half that hits counts.
PixelMarchResult march_equal_steps(const HostImage& depth, const CameraData& camera, const PixelRay& ray,
                                   double thickness, unsigned steps, unsigned refinements);
