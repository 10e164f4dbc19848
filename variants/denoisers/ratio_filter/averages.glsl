// How colours are averaged.
#ifndef RATIO_FILTER_AVERAGES_GLSL
#define RATIO_FILTER_AVERAGES_GLSL
#include "denoisers/ratio_filter/shown.glsl"

const bool is_logarithmic = averages == 0u;

vec3 logarithm_of(vec3 color) { return log2(1.0 + color); }
vec3 color_of_logarithm(vec3 logarithm) { return exp2(logarithm) - 1.0; }

// Mean and variance of what comes, by its weights (West 1979, "Updating Mean and Variance Estimates"): equal values
// stay what they are, and nothing overflows.
struct Running {
    float weight;
    vec3 mean, variance;
};

const Running no_values = Running(0.0, vec3(0.0), vec3(0.0));

void add_value(inout Running values, float weight, vec3 value) {
    const float least_weight = 1e-30;  // whose share of their sum has a number
    if (weight < least_weight) return;
    values.weight += weight;
    float share = weight / values.weight;
    vec3 change = value - values.mean;
    values.mean += share * change;
    values.variance = (1.0 - share) * (values.variance + share * change * change);
}
#endif
