// The functions that double_shader.cpp brings along, at each pixel's argument: the value, and what a float leaves of it.
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint function; };
uniform sampler2D argument;
uniform writeonly image2D value;

float value_of(float x) {
    switch (function) {
        case 0u: return exp2(x);
        case 1u: return exp(x);
        case 2u: return log2(abs(x));
        case 3u: return log(abs(x));
        case 4u: return pow(abs(x), 1.7);
        case 5u: return sin(x);
        case 6u: return cos(x);
        case 7u: return atan(x);
        case 8u: return atan(x, -0.75);
        case 9u: return acos(clamp(x, -1.0, 1.0));
        default: return 1.0 / 3.0 + x;
    }
}

void main() {
    ivec2 index = ivec2(gl_GlobalInvocationID.xy);
    if (index.x >= textureSize(argument, 0).x) return;
    float result = value_of(texelFetch(argument, index, 0).x);
    imageStore(value, index, vec4(result, result - uintBitsToFloat(floatBitsToUint(result)), 0.0, 0.0));
}
