// The technique of experiments/studies/examples is that of ssrlab which it is written after: the same bits and the same work
// left out, with all of its presets.
#include "tests/variants/declared/technique_folder.h"
#include "tests/variants/held_camera.h"
#include "tests/variants/mirror_scenes.h"

namespace {

struct DeclaredExamples : HeldCamera {
    DeclaredExamples() { view.extent = {48, 36}; }

    /// A floor whose roughness grows to the right, before a wall.
    static SyntheticHit scene(const CameraRay& ray) {
        SyntheticHit hit = floor_before_white(ray);
        if (hit.metalness > 0) hit.roughness = 0.35f + 0.3f * ray.direction.x;
        return hit;
    }

    void expect_same(const std::string& technique, const std::string& declared, const nlohmann::json& parameters) {
        SCOPED_TRACE(technique + " " + parameters.dump());
        const auto expected = make_variant(technique, parameters), found = make_variant(declared, parameters);
        EXPECT_EQ(found->depends_on_seed(), expected->depends_on_seed());
        EXPECT_EQ(found->needs_depth_layers(), expected->needs_depth_layers());
        EXPECT_EQ(found->uses_scene_data(), expected->uses_scene_data());
        if (expected->uses_scene_data() || expected->needs_depth_layers()) return;  // these scenes have neither
        const Frame before = render(*expected, scene, 3, 0.5f);
        std::vector<std::string> stages;
        for (const PassTime& time : times) stages.push_back(time.stage);
        const Frame after = render(*found, scene, 3, 0.5f);
        EXPECT_EQ(after.radiance.values, before.radiance.values);
        EXPECT_EQ(after.confidence.values, before.confidence.values);
        std::vector<std::string> found_stages;
        for (const PassTime& time : times) found_stages.push_back(time.stage);
        EXPECT_EQ(found_stages, stages);
        EXPECT_GT(*std::ranges::max_element(after.confidence.values), 0.0f);
        expect_same_left_out(*expected, *found);
    }

    static void expect_same_left_out(Variant& expected, Variant& found) {
        const SceneFacts mirrors{.has_geometry = true, .has_reflective = true, .has_matte = false, .min_roughness = 0},
            rough{.has_geometry = true, .has_reflective = true, .min_roughness = 0.9f, .max_roughness = 1},
            moving{.has_geometry = true,
                   .has_reflective = true,
                   .min_roughness = 0,
                   .max_roughness = 1,
                   .camera_moves = true,
                   .has_environment = true};
        for (const SceneFacts& facts : {mirrors, rough, moving, SceneFacts()}) {
            const auto names = [&](Variant& variant) {
                std::multiset<std::string> names;
                for (const LeftOut& part : variant.leave_out(facts))
                    names.insert(full_name(part) + (part.keeps_bits ? "" : " (other bits)"));
                return names;
            };
            EXPECT_EQ(names(found), names(expected)) << facts.min_roughness;
        }
    }
};

using Json = nlohmann::json;

/// One preset for each resolve.
TEST_F(DeclaredExamples, AnyMarchAndAnyResolve) {
    const std::string declared = add_example("composed_ssr");
    for (const Preset& preset : find_variant("composed_ssr").presets)
        expect_same("composed_ssr", declared, preset.parameters);
    for (const Json& parameters :
         {Json{{"tracer", "hierarchy"}, {"max_rays", 2}}, Json{{"misses", "weight"}, {"previous_frame", true}},
          Json{{"half_resolution", false}, {"draw_directions", false}, {"resolve", "mean"}}})
        expect_same("composed_ssr", declared, parameters);
}

TEST_F(DeclaredExamples, HasTheParametersOfTheTechnique) {
    const auto expected = make_variant("composed_ssr"), found = make_variant(add_example("composed_ssr"));
    EXPECT_EQ(found->params.schema(), expected->params.schema());
}

}  // namespace
