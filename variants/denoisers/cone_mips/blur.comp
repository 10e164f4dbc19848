// One level of the mips: the level before at half the size, blurred along rows and then along columns.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { float level; };
uniform sampler2D finer;
uniform writeonly image2D coarser;

const int group = 8, reach = 3, tile = group + 2 * reach;

// A Gaussian of standard deviation 2.02 texels. Their sum is 1, the variance of what they leave of it 2.7153.
const float weights[reach + 1] = float[4](0.21460643, 0.18987923, 0.13151412, 0.07130343);

shared vec4 texels[tile * tile], blurred_rows[tile * group];

float weight_of(vec4 color) { return even_weights ? 1.0 : mix(min(miss_weight * level, 1.0), 1.0, color.a); }

void add(inout vec4 sum, inout float weight_sum, vec4 color, int offset) {
    float weight = weights[abs(offset)] * weight_of(color);
    sum += weight * color;
    weight_sum += weight;
}

vec4 mean(vec4 sum, float weight_sum) { return weight_sum > 0.0 ? sum / weight_sum : vec4(0.0); }

void load_texels(ivec2 corner, vec2 extent) {
    for (int i = int(gl_LocalInvocationIndex); i < tile * tile; i += group * group)
        texels[i] = textureLod(finer, (vec2(corner + ivec2(i % tile, i / tile)) + 0.5) / extent, 0.0);
}

void blur_rows() {
    for (int i = int(gl_LocalInvocationIndex); i < tile * group; i += group * group) {
        vec4 sum = vec4(0.0);
        float weight_sum = 0.0;
        int center = i / group * tile + i % group + reach;
        for (int offset = -reach; offset <= reach; ++offset) add(sum, weight_sum, texels[center + offset], offset);
        blurred_rows[i] = mean(sum, weight_sum);
    }
}

vec4 blurred_column(ivec2 place) {
    vec4 sum = vec4(0.0);
    float weight_sum = 0.0;
    for (int offset = -reach; offset <= reach; ++offset)
        add(sum, weight_sum, blurred_rows[(place.y + reach + offset) * group + place.x], offset);
    return mean(sum, weight_sum);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy), extent = imageSize(coarser);
    load_texels(ivec2(gl_WorkGroupID.xy) * group - reach, vec2(extent));
    barrier();
    blur_rows();
    barrier();
    if (all(lessThan(texel, extent))) imageStore(coarser, texel, blurred_column(ivec2(gl_LocalInvocationID.xy)));
}
