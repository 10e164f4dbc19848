// Colours as passes hand them to each other.
#ifndef RATIO_FILTER_SHOWN_GLSL
#define RATIO_FILTER_SHOWN_GLSL

// Squares of it are finite, and weights of 1e30 times it.
const float largest_radiance = 1e17;

// Colours of which a share is known: their mean is that of the known share, beside the mean of the shares. Passes hand
// on the product of both, and the share.
vec4 shown_color(vec3 color, float confidence) { return vec4(color * confidence, confidence); }
vec3 known_color(vec4 shown) {
    const float least_confidence = 1e-6;  // below which the quotient says nothing
    return shown.a < least_confidence ? vec3(0.0) : shown.rgb / shown.a;
}

// Of pixels that reflect nothing.
const vec4 no_reflection = vec4(0.0, 0.0, 0.0, -1.0);
bool is_reflection(vec4 shown) { return shown.a >= 0.0; }
#endif
