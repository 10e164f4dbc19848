uniform sampler2D t0, t1, t2, t3, t4, t5, t6, t7, t8;
uniform sampler2D t9, t10, t11, t12, t13, t14, t15;
layout(location = 0) out vec4 color;
vec4 texel(sampler2D image) { return texelFetch(image, ivec2(0), 0); }
void main() {
    color = texel(t0) + texel(t1) + texel(t2) + texel(t3) + texel(t4) + texel(t5) + texel(t6) + texel(t7) + texel(t8) +
            texel(t9) + texel(t10) + texel(t11) + texel(t12) + texel(t13) + texel(t14) + texel(t15);
}
