#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <span>

/// What a scene holds and a shot of it shows. The lack of something lets passes leave work out. Only what is drawn
/// counts: materials of visible triangles, lights that shine, motion within the frames of the shot.
struct SceneFacts {
    bool has_geometry = false;
    bool has_reflective = false;  ///< a surface whose specular reflectance is not zero
    bool has_matte = true;        ///< a surface whose specular reflectance is zero, also in 8 bits; true until known
    float min_roughness = 1.0f,
          max_roughness = 0.0f;  ///< perceptual, over reflective surfaces and all texels of their textures
    bool camera_moves = false,   ///< also by jitter
        objects_move = false;
    bool has_environment = false;  ///< an environment that is not black
    bool has_textures = false, has_alpha_masks = false, has_normal_maps = false, has_vertex_colors = false;
    bool has_dielectric_f0 = false;  ///< a dielectric whose reflectance is not 0.04 times one factor
    bool hides_backs = false;        ///< a single-sided surface in a scene that does not draw such backs
    bool has_faulty_inputs = false;  ///< a G-buffer from files has values that are not finite, or normals that are not
                                     ///< unit; a rasterised one never has

    bool is_still() const { return !camera_moves && !objects_move; }
};

/// The facts of these frames of one camera, rendered in this order; the first of them has no predecessor, so nothing
/// moves in it.
SceneFacts derive_facts(const Scene& scene, const SceneCamera& camera, std::span<const unsigned> frames);

/// The facts that do not depend on a shot; nothing moves.
SceneFacts material_facts(const Scene& scene);

/// Whether a surface has a specular term in every format of a G-buffer. `factor`: the larger of its specular factor and
/// its metalness, which the packed formats keep in 8 bits.
inline bool is_stored_as_reflective(float factor) { return factor >= 1.0f / 255.0f; }

/// What the pixels of one frame show, as shares of all pixels.
struct PixelFacts {
    float background = 0.0f;                           ///< no surface
    float reflective = 0.0f;                           ///< specular reflectance is not zero
    float mirror = 0.0f;                               ///< ... and as smooth as both renderers distinguish
    float moving = 0.0f;                               ///< surfaces whose motion vector exceeds a hundredth of a pixel
    float min_roughness = 1.0f, max_roughness = 0.0f;  ///< of reflective pixels
};
PixelFacts pixel_facts(const HostGBuffer& gbuffer);

/// One line of `ssrlab needs`.
struct SceneFact {
    std::string name, value, why;
};
/// All facts of a scene and of the pixels of a frame, in the order in which they are printed.
std::vector<SceneFact> list_facts(const Scene& scene, const SceneFacts& facts);
std::vector<SceneFact> list_facts(const PixelFacts& facts);
