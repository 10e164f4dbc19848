#ifndef TRACERS_OUTCOME_H
#define TRACERS_OUTCOME_H
#include "core/shared/language.h"

// How a ray ended, for GLSL and C++. If a tracer cannot distinguish outcomes, it gives the first one that applies.

const uint outcome_hit = 0u;
const uint outcome_off_screen = 1u;     ///< the ray left the screen
const uint outcome_behind_camera = 2u;  ///< the ray reached the near plane
const uint outcome_unfinished = 3u;     ///< the ray's steps, its length or its subgroup's patience ran out
const uint outcome_background = 4u;     ///< the ray ended where nothing was drawn, or at the far plane
const uint outcome_too_thick = 5u;      ///< the ray ended farther behind a surface than counts as solid
const uint outcome_from_behind = 6u;    ///< the ray met the side of a surface that the camera does not see
const uint outcome_own_surface = 7u;    ///< the ray met the surface that it started from
const uint outcome_hidden = 8u;         ///< the ray met something that the screen does not show; only exact_scene knows
const uint outcome_count = 9u;
const uint outcome_unanswered = 9u;  ///< the march decides: only of ExactHit, with exact_rays
#endif
