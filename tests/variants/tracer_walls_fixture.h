#pragma once
#include "tests/variants/technique_fixture.h"
#include "tests/variants/tracer_bench.h"

/// A wall 10 m before the camera with one column at 5 m, and one pixel at 5.02 m that faces to the right, from which
/// rays start: to the right, parallel to the image, they meet the column.
struct TracerAtWall : TechniqueTest {
    static constexpr unsigned column = 140;
    static constexpr glm::uvec2 start{20, 40};
    static inline const glm::vec3 to_left = glm::normalize(glm::vec3(-1, 0, 1));  ///< and to the camera
    TracerBench bench{device(), {200, 80}};

    void make_wall() {
        bench.show_wall(10);
        bench.set_column(column, 5, to_left);
        bench.set_pixel(start, 5.02f, {1, 0, 0});
    }
    void SetUp() override { make_wall(); }

    BenchRay to_column() const { return {start, {1, 0, 0}}; }
    float to_column_meters(float pixels = float(column - start.x)) const {
        const glm::vec3 origin = bench.position(start);
        return pixels / (bench.screen(origin + glm::vec3(1, 0, 0)).x - bench.screen(origin).x);
    }

    /// A floor that leans by a little, and rays that leave it at a third of their mirror rays' angles: their line comes
    /// behind samples of the floor.
    std::vector<BenchRay> show_floor() {
        bench.pose.world_from_view =
            glm::mat4(0.995f, 0.0998f, 0, 0, -0.0998f, 0.995f, 0, 0, 0, 0, 1, 0, 0, 0.3f, 0, 1);
        bench.show([](const CameraRay& ray) -> SyntheticHit {
            const float t = -ray.origin.y / ray.direction.y;
            return t > 0 && t < 90 ? SyntheticHit{.distance = t, .normal = {0, 1, 0}} : SyntheticHit{};
        });
        const glm::mat3 view_from_world(bench.camera.view_from_world);
        std::vector<BenchRay> rays;
        for (unsigned y = 50; y < bench.view.extent.y; y += 2)
            for (unsigned x = 10; x < bench.view.extent.x; x += 10) {
                const glm::vec3 towards =
                    glm::normalize(glm::mat3(bench.camera.world_from_view) * bench.position({x, y}));
                rays.push_back({{x, y}, view_from_world * glm::vec3(towards.x, -towards.y / 3, towards.z)});
            }
        return rays;
    }

    unsigned hits(const std::string& tracer, const std::vector<BenchRay>& rays,
                  const nlohmann::json& parameters = nlohmann::json::object()) {
        unsigned count = 0;
        for (const BenchEnd& end : bench.trace(tracer, rays, parameters)) count += end.is_hit();
        return count;
    }

    /// To the side that rays from the left do not come from.
    void turn_column() { bench.set_column(column, 5, {1, 0, 0}); }
};
