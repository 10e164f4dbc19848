#ifndef SHARED_DRAWN_SCENE_H
#define SHARED_DRAWN_SCENE_H
#include "core/shared/language.h"

// A scene as the rasteriser's shaders see it. Only vec4, uvec4 and mat4, so that C++ and std430 agree.

/// Texture slots of a material, in the order of the arrays below.
const uint slot_base_color = 0u;
const uint slot_metalness_roughness = 1u;
const uint slot_normal = 2u;
const uint slot_emission = 3u;
const uint slot_specular = 4u;
const uint slot_specular_color = 5u;

/// Bits of DrawnMaterial::sampling.
const uint sampling_has_texture = 1u;
const uint sampling_is_srgb = 2u;
const uint sampling_is_nearest = 4u;
const uint sampling_wrap_u_shift = 3u;  ///< two bits: TextureWrap
const uint sampling_wrap_v_shift = 5u;

struct DrawnMaterial {
    vec4 base_color;      ///< rgb, alpha
    vec4 factors;         ///< metalness, perceptual roughness, normal scale, alpha cutoff
    vec4 emission;        ///< rgb radiance, specular factor
    vec4 specular_color;  ///< rgb reflectance of dielectrics at normal incidence, to be clamped to 1 after its
                          ///< texture
    vec4 slot_u[6];       ///< uv_transform's first row; w: set of texture coordinates
    vec4 slot_v[6];       ///< ... second row
    uvec4 sampling[2];    ///< per slot, four in each
    uvec4 flags;          ///< 1 if unlit, 1 if double-sided
};

struct DrawnInstance {
    mat4 world_from_object;
    mat4 previous_world_from_object;
    mat4 normal_matrix;  ///< of world_from_object: NormalTransform::matrix
    uvec4 ids;           ///< material, 1 if the determinant is negative, where in `vertices` the positions of the frame
                         ///< before begin (floats; 0: they are those of this frame)
};

/// Floats per vertex: position, normal, tangent (4), two uv, colour (4); then, for the triangle that it leads, the
/// geometric normal (3) and the alpha that the corners' colours share (-1: they differ). After all vertices of a
/// deformed instance follow their positions in the previous frame, three floats each.
const uint vertex_stride = 22u;

/// Texel column or row for an index that may lie outside (glTF 2.0, sampler.wrapS); mode: TextureWrap.
SHARED int wrap_texel(int index, int size, uint mode) {
    if (mode == 2u) return clamp(index, 0, size - 1);
    int period = mode == 0u ? size : 2 * size;
    int folded = index % period;
    if (folded < 0) folded += period;
    return folded < size ? folded : period - 1 - folded;
}
#endif
