#pragma once
#include "tests/variants/synthetic_gbuffer.h"
#include "variants/tracers/outcome.h"
#include "variants/tracers/tracers.h"

/// A ray from the surface of a pixel.
struct BenchRay {
    glm::uvec2 pixel;
    glm::vec3 direction;  ///< view space; of any length
    float random = 0;
};

/// TraceEnd of variants/tracers/trace.glsl, and what it took.
struct BenchEnd {
    glm::ivec2 pixel;
    glm::vec2 position;
    float distance, confidence;
    unsigned outcome, fetches;

    bool is_hit() const { return outcome == outcome_hit; }
};
std::ostream& operator<<(std::ostream& out, const BenchEnd& end);

/// A G-buffer made by formulas, whose depth and normals tests may change, and tracers run on rays of their own.
class TracerBench {
public:
    TracerBench(Device& device, glm::uvec2 extent) : device_(device) { view.extent = extent; }

    CameraPose pose{.vertical_fov = 1.0f, .near = 0.1f, .far = 100.0f};
    FrameView view;  ///< set both before show()

    CameraData camera{};
    HostImage depth, normal;                   ///< device depth; world-space normal, geometric and shading
    HostImage shading_normal;                  ///< that for shading, where it is another one; else empty
    float device_depth(float distance) const;  ///< of a distance from the camera plane (m)

    void show(const SyntheticScene& scene);
    /// A wall before the camera that faces it.
    void show_wall(float distance);
    /// One pixel, or a column of them, at a distance from the camera plane (m).
    void set_pixel(glm::uvec2 pixel, float distance, glm::vec3 ws_normal);
    void set_column(unsigned x, float distance, glm::vec3 ws_normal);

    glm::vec3 position(glm::uvec2 pixel) const;     ///< view space
    glm::vec2 screen(glm::vec3 vs_position) const;  ///< un-jittered (pixels)
    /// From a pixel to a point of another pixel, a distance before the camera plane (m).
    BenchRay ray_to(glm::uvec2 from, glm::vec2 to_screen, float distance) const;

    std::vector<BenchEnd> trace(const std::string& tracer, const std::vector<BenchRay>& rays,
                                const nlohmann::json& parameters = nlohmann::json::object());
    BenchEnd trace(const std::string& tracer, const BenchRay& ray,
                   const nlohmann::json& parameters = nlohmann::json::object()) {
        return trace(tracer, std::vector{ray}, parameters).front();
    }

private:
    glm::vec3 unproject(glm::vec2 screen, float device_depth) const;

    Device& device_;
};
