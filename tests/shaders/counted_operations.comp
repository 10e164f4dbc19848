// 64 x: 3 of a vec3's sum, 5 of a dot product of three, 28 of a matrix and a vector, 4 of a vec4's square root, and two
// comparisons and an addition of a loop of 2, with a third comparison that ends it.
layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D target;
void main() {
    vec3 a = vec3(gl_LocalInvocationID);
    float sum = dot(a + a, a);
    vec4 b = sqrt(camera.clip_from_view * vec4(a, sum));
    for (int i = 0; i < 2; ++i) barrier();
    imageStore(target, ivec2(gl_LocalInvocationID.xy), b);
}
