// Writes `traced`: the mean colour of each pixel's hits, and the confidence, in all modes but SimpleLinear.
#include "tracer"
TraceEnd march(TraceRay ray) { return trace(ray); }
#include "four_mode_ssr/trace_pixel.glsl"
