// Device depth of the point that each pixel shows, as the previous camera saw it.
#include "core/shaders/view.glsl"
uniform sampler2D depth;
layout(location = 0) out float reprojected_depth;
