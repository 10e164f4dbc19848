#include "core/scene/view_shares.h"

#include "core/scene/deform.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace {

/// What is nearest at each pixel: the smaller of equal depths' instances, so that no order of triangles matters.
class DepthBuffer {
public:
    static constexpr uint32_t nothing = ~0u;

    explicit DepthBuffer(glm::uvec2 extent)
        : extent_(extent), depth_(size_t(extent.x) * extent.y, 1.0f), shown_(size_t(extent.x) * extent.y, nothing) {}

    uint32_t shown(size_t pixel) const { return shown_[pixel]; }

    /// Corners in clip space (Vulkan's: y down, depth in [0, w]). `is_mirrored`: the front is clockwise.
    void draw(const std::array<glm::vec4, 3>& corners, uint32_t instance, bool is_mirrored, bool hides_back) {
        for (int axis : {0, 1}) {  // outside of the picture
            if (corners[0][axis] > corners[0].w && corners[1][axis] > corners[1].w && corners[2][axis] > corners[2].w)
                return;
            if (corners[0][axis] < -corners[0].w && corners[1][axis] < -corners[1].w &&
                corners[2][axis] < -corners[2].w)
                return;
        }
        std::array<glm::vec4, 4> polygon;
        const size_t count = clip_at_near(corners, polygon);
        for (size_t i = 2; i < count; ++i)
            fill(place(polygon[0]), place(polygon[i - 1]), place(polygon[i]), instance, is_mirrored, hides_back);
    }

    void add(const DepthBuffer& other) {
        for (size_t i = 0; i < shown_.size(); ++i) put(i, other.depth_[i], other.shown_[i]);
    }

private:
    /// What lies behind the near plane; a corner in the eye's plane has no place in the picture.
    static size_t clip_at_near(const std::array<glm::vec4, 3>& corners, std::array<glm::vec4, 4>& polygon) {
        size_t count = 0;
        for (size_t i = 0; i < 3; ++i) {
            const glm::vec4 &a = corners[i], &b = corners[(i + 1) % 3];
            const bool has_a = a.z >= 0.0f && a.w > 0.0f, has_b = b.z >= 0.0f && b.w > 0.0f;
            if (has_a) polygon[count++] = a;
            if (has_a == has_b) continue;
            const glm::vec4 cut = a + (b - a) * (a.z / (a.z - b.z));
            if (cut.w > 0.0f) polygon[count++] = cut;
        }
        return count;
    }

    /// Pixels, and depth.
    glm::dvec3 place(const glm::vec4& clip) const {
        const glm::dvec4 c(clip);
        return {(c.x / c.w * 0.5 + 0.5) * extent_.x, (c.y / c.w * 0.5 + 0.5) * extent_.y, c.z / c.w};
    }

    void fill(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, uint32_t instance, bool is_mirrored,
              bool hides_back) {
        const glm::dvec2 ab = glm::dvec2(b - a), ac = glm::dvec2(c - a);
        const double area = ab.x * ac.y - ab.y * ac.x;
        if (!(std::abs(area) > 0.0) || !std::isfinite(area)) return;
        const bool is_front = (area < 0) != is_mirrored;  // y points down
        if (hides_back && !is_front) return;
        // Rows whose centres lie within, and in each the centres between two edges.
        const auto first = [](double at, unsigned end) {
            return unsigned(std::clamp(std::ceil(at - 0.5), 0.0, double(end)));
        };
        const unsigned y_first = first(std::min({a.y, b.y, c.y}), extent_.y),
                       y_end = first(std::max({a.y, b.y, c.y}), extent_.y);
        const glm::dvec3* const corner[] = {&a, &b, &c, &a};
        for (unsigned y = y_first; y < y_end; ++y) {
            const double row = y + 0.5;
            double low = extent_.x, high = 0.0;
            for (int edge = 0; edge < 3; ++edge) {
                const glm::dvec3 &from = *corner[edge], &to = *corner[edge + 1];
                if ((from.y > row) == (to.y > row)) continue;
                const double x = from.x + (to.x - from.x) * ((row - from.y) / (to.y - from.y));
                low = std::min(low, x), high = std::max(high, x);
            }
            for (unsigned x = first(low, extent_.x), end = first(high, extent_.x); x < end; ++x) {
                const glm::dvec2 at(x + 0.5 - a.x, row - a.y);
                const double u = (at.x * ac.y - at.y * ac.x) / area, v = (ab.x * at.y - ab.y * at.x) / area;
                put(size_t(y) * extent_.x + x, float(a.z + u * (b.z - a.z) + v * (c.z - a.z)), instance);
            }
        }
    }

    void put(size_t pixel, float depth, uint32_t instance) {
        if (!(depth < depth_[pixel] || (depth == depth_[pixel] && instance < shown_[pixel]))) return;
        depth_[pixel] = depth, shown_[pixel] = instance;
    }

    glm::uvec2 extent_;
    std::vector<float> depth_;
    std::vector<uint32_t> shown_;
};

}  // namespace

ViewShares view_shares(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent) {
    constexpr size_t grain = 4096;
    const CameraData data = camera_data(camera, nullptr, {.extent = extent});
    const glm::dmat4 clip_from_world =
        glm::dmat4(data.clip_from_view) * glm::inverse(glm::dmat4(camera.world_from_view));
    tbb::enumerable_thread_specific<DepthBuffer> buffers([&] { return DepthBuffer(extent); });
    std::vector<Vertex> deformed;
    std::vector<glm::vec4> clip;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        const std::span<const Vertex> vertices = posed_vertices(scene, pose, i, deformed);
        const glm::mat4 clip_from_object(clip_from_world * glm::dmat4(pose.world_from_instance[i]));
        const bool is_mirrored = glm::determinant(glm::dmat3(pose.world_from_instance[i])) < 0,
                   hides_back = scene.hides_backs_of(scene.materials[mesh.material]);
        clip.resize(vertices.size());
        tbb::parallel_for(tbb::blocked_range<size_t>(0, vertices.size(), grain), [&](const auto& range) {
            for (size_t v = range.begin(); v < range.end(); ++v)
                clip[v] = clip_from_object * glm::vec4(vertices[v].position, 1.0f);
        });
        tbb::parallel_for(tbb::blocked_range<size_t>(0, mesh.indices.size() / 3, grain), [&](const auto& range) {
            DepthBuffer& buffer = buffers.local();
            for (size_t t = range.begin(); t < range.end(); ++t)
                buffer.draw({clip[mesh.indices[3 * t]], clip[mesh.indices[3 * t + 1]], clip[mesh.indices[3 * t + 2]]},
                            uint32_t(i), is_mirrored, hides_back);
        });
    }
    DepthBuffer all(extent);
    for (const DepthBuffer& buffer : buffers) all.add(buffer);
    ViewShares shares{.of_material = std::vector<double>(scene.materials.size()),
                      .of_instance = std::vector<double>(scene.instances.size())};
    const size_t pixels = size_t(extent.x) * extent.y;
    for (size_t i = 0; i < pixels; ++i) {
        const uint32_t instance = all.shown(i);
        if (instance == DepthBuffer::nothing) continue;
        shares.of_instance[instance] += 1.0 / double(pixels);
        shares.of_material[scene.meshes[scene.instances[instance].mesh].material] += 1.0 / double(pixels);
    }
    return shares;
}
