// Textures as the path tracer filters them: level 0, bilinear in float32 (hardware filters weigh by 1/256 steps, which
// would cut alpha masks elsewhere), colours decoded from sRGB before filtering.
uniform sampler2D base_color_texture;
uniform sampler2D metalness_roughness_texture;
uniform sampler2D normal_texture;
uniform sampler2D emission_texture;

// IEC 61966-2-1.
vec3 linear_from_srgb(vec3 code) {
    return mix(code / 12.92, pow((code + 0.055) / 1.055, vec3(2.4)), greaterThan(code, vec3(0.04045)));
}

vec4 texel(sampler2D image, ivec2 p, ivec2 size, uint sampling) {
    ivec2 wrapped = ivec2(wrap_texel(p.x, size.x, sampling >> sampling_wrap_u_shift & 3u), wrap_texel(p.y, size.y, sampling >> sampling_wrap_v_shift & 3u));
    vec4 value = texelFetch(image, wrapped, 0);
    if ((sampling & sampling_is_srgb) != 0u) value.rgb = linear_from_srgb(value.rgb);
    return value;
}

vec4 filtered(sampler2D image, vec2 uv, uint sampling) {
    ivec2 size = textureSize(image, 0);
    vec2 p = clamp(uv * vec2(size), vec2(-1e9), vec2(1e9));
    if ((sampling & sampling_is_nearest) != 0u) return texel(image, ivec2(floor(p)), size, sampling);
    p -= 0.5;
    ivec2 corner = ivec2(floor(p));
    vec2 f = p - floor(p);
    vec4 top = mix(texel(image, corner, size, sampling), texel(image, corner + ivec2(1, 0), size, sampling), f.x);
    vec4 bottom = mix(texel(image, corner + ivec2(0, 1), size, sampling), texel(image, corner + ivec2(1, 1), size, sampling), f.x);
    return mix(top, bottom, f.y);
}

// The slot's value at this fragment; 1 where the material has no texture.
vec4 slot_value(sampler2D image, DrawnMaterial m, uint slot) {
    uint sampling = m.sampling[slot / 4u][slot % 4u];
    if ((sampling & sampling_has_texture) == 0u) return vec4(1.0);
    vec3 uv1 = vec3(m.slot_u[slot].w == 0.0 ? uvs.xy : uvs.zw, 1.0);
    return filtered(image, vec2(dot(m.slot_u[slot].xyz, uv1), dot(m.slot_v[slot].xyz, uv1)), sampling);
}
