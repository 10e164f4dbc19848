#pragma once
#include "core/gbuffer/leading_vertices.h"
#include "core/gpu/passes/pass_list.h"
#include "core/scene/scene.h"

#include <map>
#include <memory>
#include <string>

/// A scene on the GPU: what the rasteriser draws.
class DrawnScene {
public:
    /// Which fragment shader a mesh needs: the cheapest that its material allows.
    enum class Kind { plain, textured, masked };

    /// Uploads all drawn meshes, materials and textures. With `has_dielectric_f0` no mesh is `plain`; with `keep_all`
    /// every mesh is `masked`.
    DrawnScene(PassList& pass_list, const Scene& scene, bool has_dielectric_f0, bool keep_all);

    /// Uploads transforms and deformed vertices of this frame. `previous`: the pose of the previous frame.
    void pose(const ScenePose& pose, const ScenePose& previous);

    const std::vector<Draw>& draws(Kind kind) const { return draws_[size_t(kind)]; }

private:
    struct MeshBuffers {
        Buffer vertices, indices;
    };
    /// An instance whose vertices joints or morph targets move. Each frame uploads its vertices of this and the
    /// previous frame.
    struct DeformedInstance {
        unsigned instance = 0;
        std::shared_ptr<const LeadingVertices> leading;  ///< of its mesh
        Buffer vertices;
        Deformation deformation;  ///< of `posed`
        std::vector<Vertex> posed, before;
        std::vector<float> floats;
    };
    Buffer upload_indices(const LeadingVertices& leading, size_t mesh);
    Buffer upload_vertices(const Mesh& mesh, const LeadingVertices& leading, size_t index);
    void pose(DeformedInstance& deformed, const ScenePose& pose, const ScenePose& previous);
    Image texture_image(const TextureSlot& slot);
    Kind kind_of(const Material& material) const;
    Draw::Cull cull_of(unsigned instance, bool is_mirrored) const;
    Draw make_draw(unsigned instance, const MeshBuffers& buffers, Kind kind);

    PassList& pass_list_;
    const Scene& scene_;
    bool has_dielectric_f0_, keep_all_;
    Buffer materials_, instances_;
    Image no_texture_;
    std::map<const void*, Image> images_;  ///< by the texels of Scene::textures that draws need
    std::vector<Draw> draws_[3];
    std::vector<DeformedInstance> deformed_;
};
