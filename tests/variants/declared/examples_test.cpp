// The techniques of experiments/examples are those of ssrlab that they are written after: the same bits and the same
// work left out, with all of their presets.
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

    /// With the values of all presets of the technique, and with these.
    void expect_same_everywhere(const std::string& technique, const nlohmann::json& with,
                                const std::vector<nlohmann::json>& more) {
        const std::string declared = add_example(technique);
        for (const Preset& preset : find_variant(technique).presets)
            expect_same(technique, declared, changed(preset.parameters, with));
        for (const nlohmann::json& parameters : more) expect_same(technique, declared, changed(with, parameters));
    }
};

using Json = nlohmann::json;

TEST_F(DeclaredExamples, LinearTracing) {
    expect_same_everywhere("mcguire_dda", Json::object(),
                           {Json::object(),
                            {{"tracer", "hierarchy"}},
                            {{"tracer", "frostbite_linear"}},
                            {{"dda.layers", "2"}},
                            {{"tracer", "exact_scene"}},
                            {{"bilinear_color", true}, {"repair_inputs", true}}});
}

TEST_F(DeclaredExamples, SimpleTechniques) {
    expect_same_everywhere("simple_ssr", Json::object(),
                           {{{"draw", "normals"}, {"rays", 2}}, {{"blur_width", 0.1}, {"max_roughness", 0.4}}});
}

TEST_F(DeclaredExamples, BlendOverTime) {
    expect_same_everywhere("four_mode_ssr", {{"mode", "temporal"}},
                           {{{"float_histories", true}},
                            {{"history_place", "reflection"}},
                            {{"mode", "stochastic"}},
                            {{"mode", "hiz"}},
                            {{"mode", "simple_linear"}}});
}

/// One preset for each resolve.
TEST_F(DeclaredExamples, AnyMarchAndAnyResolve) {
    expect_same_everywhere("composed_ssr", Json::object(),
                           {{{"tracer", "hierarchy"}, {"max_rays", 2}},
                            {{"misses", "weight"}, {"previous_frame", true}},
                            {{"half_resolution", false}, {"draw_directions", false}, {"resolve", "mean"}}});
}

TEST_F(DeclaredExamples, HaveTheParametersOfTheTechnique) {
    for (const std::string technique : {"mcguire_dda", "simple_ssr", "four_mode_ssr", "composed_ssr"}) {
        SCOPED_TRACE(technique);
        const auto expected = make_variant(technique), found = make_variant(add_example(technique));
        Json schema = expected->params.schema();
        if (technique == "four_mode_ssr") schema["properties"]["mode"]["default"] = "temporal";
        for (const auto& [name, of_parameter] : schema["properties"].items()) {
            Json of_found = found->params.schema()["properties"][name];
            if (name == "mode") of_found["description"] = of_parameter["description"];
            EXPECT_EQ(of_found, of_parameter) << name;
        }
        EXPECT_EQ(found->params.values().size(), expected->params.values().size());
    }
}

}  // namespace
