// The same in the mode SimpleLinear.
#include "linear_tracer"
TraceEnd march(TraceRay ray) { return linear_trace(ray); }
#include "four_mode_ssr/trace_pixel.glsl"
