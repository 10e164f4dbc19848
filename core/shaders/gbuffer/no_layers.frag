// What the layers hold where nothing lies behind the visible surface.
uniform sampler2D depth;
layout(location = 0) out float second_depth;
layout(location = 1) out float back_depth;

void main() {
    second_depth = camera.depth.z;
    back_depth = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
}
