#include "core/gbuffer/gbuffer_images.h"

namespace {

const GBufferImage all_images[] = {
    {"depth", &GBuffer::depth, &HostGBuffer::depth, Format::r32f, Format::r32f,
     "device depth, from 0 to 1: 0 at the near plane, or 1 there if `camera.depth.w` is 1", "`camera.depth.z`"},
    {"geometric_normal", &GBuffer::geometric_normal, &HostGBuffer::geometric_normal, Format::rgba32f, Format::rgba16f,
     "xyz: unit normal of the triangle, in world space, towards the camera", "0"},
    {"normal", &GBuffer::normal, &HostGBuffer::normal, Format::rgba32f, Format::rgba16f,
     "xyz: unit shading normal, in world space; w: perceptual roughness, from 0 to 1", "0; roughness 1"},
    {"base_color", &GBuffer::base_color, &HostGBuffer::base_color, Format::rgba32f, Format::rgba8,
     "rgb: base colour, linear Rec. 709; a: metalness; all from 0 to 1", "0"},
    {"emission", &GBuffer::emission, &HostGBuffer::emission, Format::rgba32f, Format::rgba16f,
     "rgb: emitted radiance; a: factor of what dielectrics reflect, from 0 to 1, and 0 for unlit surfaces", "0"},
    {"motion", &GBuffer::motion, &HostGBuffer::motion, Format::rg32f, Format::rg16f,
     "uv now minus uv in the previous frame, of camera and objects, without jitter; y is down; 0 in the first frame",
     "motion of the sky at infinity"},
    {"material_id", &GBuffer::material_id, &HostGBuffer::material_id, Format::r32ui, Format::r32ui,
     "number of the material, from 1; read by a usampler2D", "0"},
    {"previous_depth", &GBuffer::previous_depth, &HostGBuffer::previous_depth, Format::r32f, Format::r32f,
     "`depth` of the previous frame; in the first frame this frame's", "`camera.depth.z`"},
    {"previous_normal", &GBuffer::previous_normal, &HostGBuffer::previous_normal, Format::rgba32f, Format::rgba16f,
     "`normal` of the previous frame; in the first frame this frame's", "0; roughness 1"},
    {"lit", &GBuffer::lit, &HostGBuffer::lit, Format::rgba32f, Format::rgba16f,
     "rgb: emitted and diffusely reflected radiance towards the camera, which reflections show; from 0 on",
     "the environment"},
    {"fallback", &GBuffer::fallback, &HostGBuffer::fallback, Format::rgba32f, Format::rgba16f,
     "rgb: radiance of the environment, averaged over the pixel's specular lobe; from 0 on", "0"},
    {"second_depth", &GBuffer::second_depth, &HostGBuffer::second_depth, Format::r32f, Format::r32f,
     "device depth of the next surface behind the visible one, or the far plane's; captures lack it",
     "`camera.depth.z`", true},
    {"back_depth", &GBuffer::back_depth, &HostGBuffer::back_depth, Format::r32f, Format::r32f,
     "`second_depth` where that is the back of a surface, else `depth`; captures lack it", "`camera.depth.z`", true},
    {"dielectric_f0", &GBuffer::dielectric_f0, &HostGBuffer::dielectric_f0, Format::rgba32f, Format::rgba16f,
     "rgb: reflectance of dielectrics at normal incidence, from 0 to 1; one texel of 0.04 if all dielectrics have it",
     "0", true},
};

}  // namespace

std::span<const GBufferImage> gbuffer_images() { return all_images; }
