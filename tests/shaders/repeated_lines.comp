// As many lines of one kind as a test includes, in a loop of as many turns as the lane's number and `turns` say.
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { int turns, per_lane; };
uniform sampler2D source;
layout(rgba32f) uniform writeonly image2D target;
void main() {
    int lane = int(gl_LocalInvocationIndex);
    vec4 x = vec4(lane, 1.0, 2.0, 3.0);
    float y = 0.5;
    for (int turn = 0; turn < turns + per_lane * lane; ++turn) {
        y += 1.0;
        if (y > 1e30) x.y += texelFetch(source, ivec2(turn, lane), 0).w;
#include "lines"
    }
    imageStore(target, ivec2(gl_GlobalInvocationID.x, 0), x + y);
}
