#pragma once
#include "core/host_image.h"
#include "metrics/plane.h"

/// The magma colour map by Stefan van der Walt and Nathaniel Smith (matplotlib, CC0) as linear colour. 0 is black, 1 is
/// pale yellow, values outside are clamped. FLIP maps use it.
glm::vec3 magma(double value);

/// Colours `map` / `max_value` by magma(), for write_png(). NaN stays NaN, which write_png() shows as magenta.
HostImage false_color(const Plane& map, double max_value);

/// A signed map: blue below 0, white at 0, red above, full colour at +-max_value.
HostImage false_color_signed(const Plane& map, double max_value);
