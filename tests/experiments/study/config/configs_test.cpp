// The studies that come with ssrlab: each can be read, and finds its scenes and cameras.
#include "core/error.h"
#include "core/files.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "variants/registry.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

const fs::path source = SSRLAB_SOURCE_DIR;

std::set<std::string> own_scenes() {
    std::set<std::string> names;
    for (const auto& folder : fs::directory_iterator(source / "scenes"))
        if (fs::exists(folder.path() / "scene.glb")) names.insert(folder.path().filename());
    return names;
}

}  // namespace

TEST(Configs, JudgeOnScenesThatNoSearchSaw) {
    const auto scenes_of = [](const nlohmann::json& shots) {
        std::set<std::string> names;
        for (const nlohmann::json& shot : shots)
            for (const nlohmann::json& name :
                 shot["scene"].is_array() ? shot["scene"] : nlohmann::json({shot["scene"]}))
                names.insert(name);
        return names;
    };
    const auto common = [](const std::set<std::string>& a, const std::set<std::string>& b) {
        std::vector<std::string> both;
        std::ranges::set_intersection(a, b, std::back_inserter(both));
        return both;
    };
    // Linear tracing's `best` is of an earlier search, search_mcguire_dda.json of commit 5cf9fef; the rest of its
    // scenes are in tune_scenes.json, too.
    std::set<std::string> searched = {"grazing", "disocclusion", "offscreen_mirror"};
    unsigned judged = 0;
    for (const auto& file : fs::directory_iterator(source / "experiments/studies/configs")) {
        if (!file.path().stem().string().starts_with("tune_")) continue;
        const Config config = read_config(file.path());
        std::set<std::string> own;
        for (const ShotConfig& shot : config.shots) own.insert(shot.scene);
        searched.insert(own.begin(), own.end());
        if (!config.source["tune"].contains("judge")) continue;
        EXPECT_EQ(common(own, scenes_of(config.source["tune"]["judge"]["shots"])), std::vector<std::string>())
            << file.path();
        ++judged;
    }
    EXPECT_GE(judged, 2u);
    std::set<std::string> quickstart;
    for (const ShotConfig& shot : read_config(source / "experiments/studies/configs/quickstart.json").shots)
        quickstart.insert(shot.scene);
    EXPECT_GE(quickstart.size(), 4u);
    EXPECT_EQ(common(searched, quickstart), std::vector<std::string>()) << "it compares presets that were searched";
}

TEST(Configs, AreReadAndFindTheirShots) {
    const std::set<std::string> own = own_scenes();
    unsigned files = 0;
    for (const auto& file : fs::directory_iterator(source / "experiments/studies/configs")) {
        if (file.path().stem().string().ends_with("_figures")) continue;  // for `ssrlab figures`
        SCOPED_TRACE(file.path());
        ++files;
        for (const ShotConfig& config : read_config(file.path()).shots) {
            if (!own.contains(config.scene)) continue;  // third-party
            EXPECT_FALSE(load_shot(config, {source / "scenes"}).steps.empty());
        }
    }
    EXPECT_GE(files, 5u);
}

TEST(Configs, KeepTheNamesOfTheirPoints) {
    // Results, figures and tables know points by their names.
    std::map<std::string, std::string> golden;
    std::istringstream lines(read_text(source / "tests/data/point_names.txt"));
    for (std::string name, hash; lines >> name >> hash;) golden[name] = hash;
    for (const auto& file : fs::directory_iterator(source / "experiments/studies/configs")) {
        const std::string name = file.path().stem().string();
        if (name.ends_with("_figures")) continue;
        ContentHash hash;
        for (const PointConfig& technique : read_config(file.path()).techniques)
            hash.add(technique.technique + " " + technique.point + "\n");
        EXPECT_EQ(golden[name], hash.hex())
            << "points of " << name
            << " have other names; if that is meant, tests/data/point_names.txt has to say: " << name << " "
            << hash.hex();
        golden.erase(name);
    }
    for (const auto& [name, hash] : golden) ADD_FAILURE() << "tests/data/point_names.txt: there is no config " << name;
}

TEST(Configs, LimitAReferenceByWhatTheySet) {
    const auto limits = [](const std::string& reference) {
        const fs::path file = fs::temp_directory_path() / "reference_limits.json";
        write_text(file, R"({"shots": [{"scene": "sky_only", "resolution": [8, 8]}], "reference": )" + reference +
                             R"(, "techniques": [{"technique": "none"}]})");
        const ReferenceSettings settings = read_config(file).reference;
        fs::remove(file);
        return reference_key("s", settings);
    };
    EXPECT_EQ(limits("{}"), "s-n256");
    EXPECT_EQ(limits(R"({"samples": 64, "seconds": 5})"), "s-n64-t5");
    EXPECT_EQ(limits(R"({"target_relative_error": 0.5})"), "s-n16777216-e0.5");
    EXPECT_EQ(limits(R"({"samples": 128, "adaptive_share": 0.25})"), "s-n128");
    EXPECT_THROW(limits(R"({"adaptive_share": 0.25, "target_relative_error": 0.5})"), Error);
    EXPECT_THROW(limits(R"({"adaptive_image": true})"), Error);
}

TEST(Configs, TimePointsAloneWhereAsked) {
    const auto has_copies = [](const std::string& timing) {
        const fs::path file = fs::temp_directory_path() / "timing_copies.json";
        write_text(
            file,
            R"({"shots": [{"scene": "sky_only", "resolution": [8, 8]}], "techniques": [{"technique": "none"}], "timing": )" +
                timing + "}");
        const Config config = read_config(file);
        fs::remove(file);
        return config.timing.has_copies;
    };
    EXPECT_TRUE(has_copies("{}"));
    EXPECT_FALSE(has_copies(R"({"copies": false})"));
}

TEST(Configs, AdditiveCompositeHasNoIncidentRadiance) {
    const auto read = [](const std::string& more) {
        const fs::path file = fs::temp_directory_path() / "composite.json";
        write_text(file,
                   R"({"shots": [{"scene": "sky_only", "resolution": [8, 8]}], "techniques": [{"technique": "none"}])" +
                       more + "}");
        const Config config = read_config(file);
        fs::remove(file);
        return config;
    };
    EXPECT_EQ(read("").composite, CompositeFormula::split_sum);
    const Config additive = read(R"(, "composite": "additive_fresnel")");
    EXPECT_EQ(additive.composite, CompositeFormula::additive_fresnel);
    EXPECT_EQ(additive.targets, (std::vector<std::string>{"specular", "image"}));
    EXPECT_THROW(read(R"(, "composite": "additive_fresnel", "targets": ["incident"])"), Error);
    EXPECT_THROW(read(R"(, "composite": "additive")"), Error);
}

/// Corrections that change no pixel of a scene that is sound: `ssrlab stability` is their study.
bool is_of_stability(const std::string& name) { return name == "repair_inputs" || name == "hierarchy.finite_length"; }

TEST(Configs, OfAmdMeasureEachCorrectionAlone) {
    const Config config = read_config(source / "experiments/studies/configs/amd_sssr.json");
    std::set<std::string> scenes, points;
    for (const ShotConfig& shot : config.shots) scenes.insert(shot.scene);
    for (const PointConfig& technique : config.techniques) points.insert(technique.point);
    EXPECT_GE(scenes.size(), 6u);

    const nlohmann::json plain = make_technique("amd_sssr", {}, "repeatable")->params.values();
    const nlohmann::json corrected = make_technique("amd_sssr", {}, "corrected")->params.values();
    unsigned corrections = 0;
    for (const auto& [name, value] : corrected.items()) {
        if (value == plain[name] || is_of_stability(name)) continue;
        ++corrections;
        // The barrier only matters where shared memory is laid out as in the original.
        const std::string form = name == "barrier_before_average" ? " denoiser_form=faithful" : "";
        const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
        EXPECT_TRUE(points.contains("repeatable " + name + "=" + text + form)) << name;
    }
    EXPECT_GT(corrections, 0u);
}

TEST(Configs, OfDiligentMeasureEachCorrectionAlone) {
    std::set<std::string> scenes, points;
    for (const char* file :
         {"experiments/studies/configs/diligent.json", "experiments/studies/configs/diligent_half_resolution.json"}) {
        const Config config = read_config(source / file);
        for (const ShotConfig& shot : config.shots) scenes.insert(shot.scene);
        for (const PointConfig& technique : config.techniques) points.insert(technique.point);
    }
    EXPECT_GE(scenes.size(), 6u);
    const nlohmann::json plain = make_technique("diligent_ssr", {}, "current")->params.values();
    unsigned changes = 0;
    for (const std::string preset : {"april_2024", "corrected"}) {
        const nlohmann::json changed = make_technique("diligent_ssr", {}, preset)->params.values();
        for (const auto& [name, value] : changed.items()) {
            if (value == plain[name] || name == "mask" || is_of_stability(name))
                continue;  // either mask leaves out the same pixels
            ++changes;
            const std::string change = " " + name + "=" + (value.is_string() ? value.get<std::string>() : value.dump());
            EXPECT_TRUE(std::ranges::any_of(points, [&](const std::string& point) { return point.ends_with(change); }))
                << change;
        }
    }
    EXPECT_GT(changes, 20u);
}

/// Every switch and choice of the technique, alone. Those that matter from two rays on, or after many frames, have
/// studies of theirs.
TEST(Configs, OfFrostbiteMeasureEachChoiceAlone) {
    std::set<std::string> changed;
    for (const char* study : {"frostbite_whole.json", "frostbite_tiles.json", "half_histories.json"})
        for (const PointConfig& technique : read_config(source / "experiments/studies/configs" / study).techniques)
            if (technique.technique == "frostbite_sssr")
                for (const auto& [name, value] : technique.parameters.items()) changed.insert(name);
    const std::unique_ptr<Technique> technique = make_technique("frostbite_sssr");
    // Other tracers, parameters that only they read, and exact rays are none of Frostbite's choices.
    const auto is_own = [](const std::string& name) {
        const bool is_of_part = name.find('.') != std::string::npos;
        return name != "tracer" && name != "rough_tracer" && name != "exact_rays" && !is_of_stability(name) &&
               (!is_of_part || name.starts_with("frostbite."));
    };
    for (const Parameter& parameter : technique->params)
        if (is_own(parameter.name) && (parameter.glsl_type == "bool" || !parameter.choices.empty())) {
            EXPECT_TRUE(changed.contains(parameter.name)) << parameter.name;
        }
}

/// Values decide, not labels: what a point is compared with may stand in another entry, under another name.
TEST(Configs, AgainstFindsThePointThatIsOtherwiseTheSame) {
    const fs::path file = fs::temp_directory_path() / "against.json";
    const auto against_points = [&](const std::string& techniques) {
        write_text(file, R"({"shots": [{"scene": "fence"}], "techniques": [)" + techniques + "]}");
        std::map<std::string, std::string> found;
        for (const PointConfig& v : read_config(file).techniques) found[v.point] = v.against_point;
        return found;
    };
    using Expected = std::map<std::string, std::string>;
    EXPECT_EQ(against_points(R"({"technique": "mcguire_dda"},
                                {"technique": "mcguire_dda", "against": {"dda.stride": 1},
                                 "sweep": {"dda.stride": [1, 2], "dda.refine": [true]}},
                                {"technique": "mcguire_dda", "against": {"dda.stride": 1, "dda.refine": false},
                                 "sweep": {"dda.stride": [4], "dda.refine": [true]}})"),
              (Expected{{"default", ""},
                        {"dda.refine=true dda.stride=1", ""},
                        {"dda.refine=true dda.stride=2", "dda.refine=true dda.stride=1"},
                        {"dda.refine=true dda.stride=4", "default"}}));
    const std::string alone =
        R"({"technique": "mcguire_dda", "against": {"dda.stride": 1}, "sweep": {"dda.stride": [2]}})";
    EXPECT_THROW(against_points(alone), Error) << "nothing to compare with";
    for (const char* values : {"{}", "true", R"({"dda.strid": 1})", R"({"dda.stride": 0})"})
        EXPECT_THROW(against_points(R"({"technique": "mcguire_dda", "against": )" + std::string(values) + "}"), Error)
            << values;
}

TEST(Configs, FormerNamesAreRead) {
    const fs::path file = fs::temp_directory_path() / "former.json", base = fs::temp_directory_path() / "base.json";
    write_text(base, R"({"shots": [{"scene": "fence"}], "variants": [{"variant": "composed_ssr", "preset": "blur"}]})");
    write_text(file, R"({"extends": "base.json", "techniques": [
        {"technique": "composed_ssr", "preset": "blur", "parameters": {"resolve": "mean"}}]})");
    const std::vector<PointConfig> points = read_config(file).techniques;
    ASSERT_EQ(points.size(), 1u);
    EXPECT_EQ(points[0].technique, "composed_ssr");
    EXPECT_EQ(points[0].parameters, (nlohmann::json{{"denoiser", "mean"}}));
}

TEST(Configs, EachChangesOneParameterAtATime) {
    const fs::path file = fs::temp_directory_path() / "each.json";
    write_text(file, R"({"shots": [{"scene": "fence"}], "techniques": [
        {"technique": "mcguire_dda", "preset": "coarse", "each": {"dda.stride": [2, 8], "dda.refine": [false]}}]})");
    std::vector<std::string> points;
    for (const PointConfig& technique : read_config(file).techniques) {
        EXPECT_EQ(technique.parameters.size(), 1u);
        points.push_back(technique.point);
    }
    EXPECT_EQ(points,
              (std::vector<std::string>{"coarse dda.stride=2", "coarse dda.stride=8", "coarse dda.refine=false"}));
    write_text(file, R"({"shots": [{"scene": "fence"}], "techniques": [
        {"technique": "mcguire_dda", "each": {"dda.stride": [2]}, "sweep": {"dda.refine": [false]}}]})");
    EXPECT_THROW(read_config(file), Error);
}

/// Else tables.py would stumble after the study has run.
TEST(Configs, TablesAreCheckedBeforeTheStudyRuns) {
    const fs::path file = fs::temp_directory_path() / "tables.json";
    const auto mistake_in = [&](const std::string& table, const std::string& costs = "false") -> std::string {
        write_text(file, R"({"shots": [{"scene": "fence"}], "techniques": [{"technique": "none"}], "costs": )" + costs +
                             R"(,
            "tables": [{"name": "a", "caption": "", "rows": "stage", "columns": "quantity", )" +
                             table + "}]}");
        try {
            read_config(file);
            return "none";
        } catch (const Error& e) {
            return std::string(e.what()).substr(file.string().size());
        }
    };
    EXPECT_EQ(mistake_in(R"("of": "costs")", "true"), "none");
    EXPECT_EQ(mistake_in(R"("of": "hits")"), ":2:93: tables[0]: the study judges no rays; add \"hits\": {}");
    EXPECT_EQ(mistake_in(R"("of": "results", "best": "row")"), "none");
    EXPECT_NE(mistake_in(R"("of": "estimates")", "true"), "none") << "which compiler?";
    EXPECT_EQ(mistake_in(R"("of": "estimates")", R"(true, "gpu_compilers": ["navi21"])"), "none");
    for (const auto& [table, mistake] : std::map<std::string, std::string>{
             {R"("of": "costs")", ":2:93: tables[0]: the study counts no costs; add \"costs\": true"},
             {R"("of": "compiled")",
              ":2:93: tables[0]: the study compiles for no GPU; add \"gpu_compilers\": [\"navi21\"]"},
             {R"("of": "estimates")",
              ":2:93: tables[0]: the study estimates no GPU's times; add \"costs\": true and \"gpu_compilers\": "
              "[\"navi21\"]"},
             {R"("of": "result")", ":2:93: tables[0]: 'of' = \"result\" is not known; did you mean 'results'?"},
             {R"("of": "results", "row": "x")", ":2:110: tables[0]: unknown key 'row'; did you mean 'rows'?"},
             {R"("of": "hits", "best": "row")",
              ":2:107: tables[0]: 'best' is for tables of 'results' and 'limits', which have a standing, not of "
              "'hits'"},
             {R"("of": "results", "best": "row", "over": "shot")",
              ":2:110: tables[0]: means over \"shot\" have no 'best'; remove it: `ssrlab tradeoff` compares over "
              "scenes"}})
        EXPECT_EQ(mistake_in(table), mistake);
}
