#ifndef SCREEN_PROBE_WIDTH_H
#define SCREEN_PROBE_WIDTH_H
#include "core/shared/language.h"

/// Of the map of all directions, in texels, each about 13 degrees wide; even.
const uint screen_probe_width = 16u;

#endif
