#pragma once
#include "core/scene/load_scene.h"
#include "groundtruth/reference/reference_guide.h"
#include "groundtruth/reference/reference_passes.h"
#include "metrics/masks.h"

#include <tbb/parallel_for.h>

/// A scene as its path tracer sees it.
struct View {
    glm::uvec2 extent;
    Scene scene;
    ScenePose pose;
    CameraPose camera;
    bool has_ladder;
    PathTracer path_tracer;
    PixelTracer tracer;
    ReferenceGuide guide;

    View(const std::string& name, glm::uvec2 size, float frame = 0, bool has_ladder = true)
        : extent(size),
          scene(load_scene(name, {std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes"})),
          pose(pose_scene(scene, frame)),
          camera(pose_camera(scene.cameras.front(), pose, frame)),
          has_ladder(has_ladder),
          path_tracer(scene, pose, camera, extent, {.ladder = has_ladder}),
          tracer(pixel_tracer(path_tracer)),
          guide(render_guide(tracer, extent, ReferenceSettings().guide_samples, {}).means) {
        path_tracer.expect(guide.diffuse, guide.specular);
    }

    Reference reference(unsigned samples, unsigned seed) const {
        ReferenceState state = empty_state(extent, {.ladder = has_ladder});
        tbb::parallel_for(0u, extent.x * extent.y, [&](unsigned p) {
            add_samples(state.reference, tracer, p % extent.x, p / extent.x,
                        {.seed = seed, .batch_samples = samples / batch_count});
        });
        state.reference.guide = guide;
        return std::move(state.reference);
    }
};

/// Of the names that masks of one frame have.
inline std::vector<Mask> surface_masks(const View& view, const Reference& reference,
                                       const std::vector<std::string>& names) {
    HostImage roughness(view.extent, 1);
    const HostImage confidence(view.extent, 1);
    for (unsigned p = 0; p < view.extent.x * view.extent.y; ++p)
        roughness.values[p] = view.path_tracer.first_hit(p % view.extent.x, p / view.extent.x).roughness;
    const MaskInputs inputs{.view_depth = reference.depth,
                            .normal = reference.normal,
                            .material_id = reference.material_id,
                            .roughness = roughness,
                            .reflectance = reference.ladder.reflectance,
                            .confidence = confidence,
                            .reflective_max_roughness = 0.6f,
                            .reflective_min_reflectance = 0.02f,
                            .previous = nullptr};
    std::vector<Mask> masks;
    for (const std::string& name : names) masks.push_back(make_mask(name, inputs));
    return masks;
}
