#ifndef SCREEN_PROBE_WIDTH_H
#define SCREEN_PROBE_WIDTH_H
#include "core/shared/language.h"

/// Width of the map of all directions in texels of about 13 degrees; must be even.
const uint screen_probe_width = 16u;

#endif
