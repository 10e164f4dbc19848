// Which techniques depend on their seed: what they declare, and what they render.
#include "core/gbuffer/composite.h"
#include "core/gpu/device.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/shots/result_images.h"
#include "tests/experiments/study/study_fixture.h"
#include "variants/registry.h"

#include <cstring>

namespace {

struct Point {
    std::string preset;
    nlohmann::json parameters = nlohmann::json::object();
};

/// The default, all presets, and what the declarations turn on. Every parameter of every technique at both ends of its
/// range, and every choice, was tried once, which takes minutes: a point that declares itself free of seeds always is.
/// Six that do not are none the less equal for two seeds, as they find nothing in this scene:
/// hierarchy.max_traversal_intersections = 0 of both, hierarchy.min_traversal_occupancy = 128, dark_exit_radiance = 1,
/// and at 32x18 hierarchy.most_detailed_mip = 6 and alpha_interpolation = 0.
std::vector<Point> points_of(const TechniqueEntry& entry) {
    std::vector<Point> points = {{}};
    for (const Preset& preset : entry.presets) points.push_back({.preset = preset.name});
    if (entry.name == "amd_sssr")
        for (const float threshold : {0.0f, 1.0f})
            points.push_back({.parameters = {{"roughness_threshold_alpha", threshold}}});
    if (entry.name == "composed_ssr")
        for (const bool is_half : {false, true})
            points.push_back(
                {.parameters = {{"denoiser", "mean"}, {"draw_directions", false}, {"half_resolution", is_half}}});
    if (entry.name != "diligent_ssr") return points;
    for (const float threshold : {0.0f, 1.0f}) points.push_back({.parameters = {{"roughness_threshold", threshold}}});
    for (const float bias : {0.0f, 1.0f})
        for (const bool is_towards_mirror : {false, true})
            points.push_back(
                {.parameters = {{"ggx_importance_sample_bias", bias}, {"bias_towards_mirror", is_towards_mirror}}});
    return points;
}

/// A small scene of all roughnesses, with a wall to be met, held for three frames so that histories count.
struct SeedDependence : testing::Test {
    Device device;
    Config config;
    Shot shot =
        load_shot({.scene = "roughness_gradient", .camera = "", .extent = {32, 18}, .repeat = 3, .direct_lit = true},
                  {fs::path(SSRLAB_SOURCE_DIR) / "scenes"});
    std::unique_ptr<FrameSource> source = scene_source(device, shot, config, false);
    FrameStore store{*source, shot.config, size_t(1) << 28};

    /// All presets of all techniques run here, with synchronisation checks (SSRLAB_VALIDATE=1); all tracers do so in
    /// TracersTest.
    void TearDown() override { EXPECT_EQ(device.validation_messages(), std::vector<std::string>()); }

    /// All bits of what a seed gives.
    std::vector<float> rendered(const std::string& technique, const Point& point, unsigned seed) {
        const std::unique_ptr<Technique> made = make_technique(technique, point.parameters, point.preset);
        PassList pass_list(device, shot.config.extent);
        Compositor compositor(pass_list);
        std::vector<float> values;
        for (const FrameStep& step : shot.steps) {
            const FrameStore::Frame frame = store.frame(step, {});
            const Reflections reflections = render_technique(pass_list, *made, frame.camera, seed, frame.gbuffer);
            const Composite composite = compositor.render(frame.gbuffer, reflections);
            const CompositedImages images = download_results(pass_list, frame.gbuffer, reflections, composite, {});
            values.insert(values.end(), images.specular.values.begin(), images.specular.values.end());
        }
        return values;
    }
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace

TEST_F(SeedDependence, IsAsDeclared) {
    for (const TechniqueEntry& entry : technique_table())
        for (const Point& point : points_of(entry)) {
            const bool is_declared = make_technique(entry.name, point.parameters, point.preset)->depends_on_seed();
            const bool depends = !same_bits(rendered(entry.name, point, 1), rendered(entry.name, point, 2));
            EXPECT_EQ(is_declared, depends) << entry.name << " " << point.preset << " " << point.parameters;
        }
}
