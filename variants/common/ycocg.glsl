// Colours as luma, which weighs green twice, and two differences: orange to blue, green to violet. w is unchanged.
#ifndef COMMON_YCOCG_GLSL
#define COMMON_YCOCG_GLSL

// Luma and differences of a colour; w stays.
vec4 ycocg_of(vec4 color) {
    float red_blue = color.r + color.b;
    return vec4(0.25 * red_blue + 0.5 * color.g, 0.5 * (color.r - color.b), 0.5 * color.g - 0.25 * red_blue, color.w);
}

// The colour of luma and differences; w stays.
vec4 color_of_ycocg(vec4 v) { return vec4(v.x + v.y - v.z, v.x + v.z, v.x - v.y - v.z, v.w); }
#endif
