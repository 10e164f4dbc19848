// What a technique's folder may not say: each mistake is a sentence with its place.
#include "core/gpu/pipelines/shader_error.h"
#include "tests/error_message.h"
#include "tests/reading_limits.h"
#include "tests/variants/declared/technique_folder.h"
#include "tests/variants/held_camera.h"

namespace {

using Json = nlohmann::json;

const Json sound = {
    {"title", "A test"},
    {"parameters",
     {{{"name", "mode"}, {"type", "choice"}, {"choices", {"a", "b"}}, {"default", "a"}, {"meaning", "m"}},
      {{"name", "limit"}, {"type", "float"}, {"range", {0, 1}}, {"default", 0.5}, {"meaning", "m"}}}},
    {"images", {{{"name", "radiance"}, {"format", "rgba16f"}}}},
    {"passes", {{{"shader", "shade.comp"}, {"reads", {"lit"}}, {"writes", {"radiance"}}}}},
    {"result", {{"radiance", "radiance"}, {"confidence", "radiance"}, {"channel", "a"}}},
    {"random", false}};

const char* const shader = R"(layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D lit;
uniform writeonly image2D radiance;
void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(radiance, pixel, vec4(texelFetch(lit, pixel, 0).rgb, 1.0));
}
)";

struct DeclaredRefusals : testing::Test {
    TemporaryTechnique technique{"refused"};
    DeclaredRefusals() { technique.write("shade.comp", shader); }

    /// What is said of the sound technique with `patch` applied (RFC 7396); of an array all of it.
    std::string error_with(const Json& patch) {
        Json changed = sound;
        changed.merge_patch(patch);
        technique.write("technique.json", changed.dump(1));
        return error_message([&] { technique.add(); });
    }
    std::string error_with_pass(const Json& patch) {
        Json pass = sound["passes"][0];
        pass.merge_patch(patch);
        return error_with({{"passes", {pass}}});
    }
    std::string error_with_shader(const std::string& text) {
        technique.write("shade.comp", text);
        return error_with(Json::object());
    }
};

void expect_part(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks: " << part;
}

TEST_F(DeclaredRefusals, NothingIsWrongWithASoundOne) { EXPECT_EQ(error_with(Json::object()), "no error"); }

TEST_F(DeclaredRefusals, Keys) {
    expect_part(error_with({{"parametres", Json::array()}}), "unknown key 'parametres'; did you mean 'parameters'?");
    expect_part(error_with({{"title", nullptr}}), "lacks the key 'title'");
    expect_part(error_with({{"result", nullptr}}), "lacks the key 'result'");
    expect_part(error_with({{"result", Json::array()}}), "'result' is empty");
    expect_part(error_with_pass({{"reeds", "lit"}}), "passes[0]: unknown key 'reeds'; did you mean 'reads'?");
    technique.write("technique.json", "{\n  \"title\": 1,\n");
    expect_part(error_message([&] { technique.add(); }), "refused/technique.json:");
    fs::remove(technique.folder / "technique.json");
    expect_part(error_message([&] { technique.add(); }), "it has no technique.json; `ssrlab new FOLDER");
}

TEST_F(DeclaredRefusals, Parameters) {
    const auto error_of = [&](const Json& patch) {
        Json parameter = {{"name", "x"}, {"type", "float"}, {"range", {0, 1}}, {"default", 0}, {"meaning", "m"}};
        parameter.merge_patch(patch);
        Json parameters = sound["parameters"];
        parameters.push_back(parameter);
        return error_with({{"parameters", parameters}});
    };
    EXPECT_EQ(error_of(Json::object()), "no error");
    expect_part(error_of({{"name", "mode"}}), "the parameter 'mode' is declared twice");
    expect_part(error_of({{"name", "repair_inputs"}}), "parameters[2]: the parameter 'repair_inputs' is one that");
    expect_part(error_of({{"name", "2x"}}), "'name' = '2x' cannot be a name in GLSL");
    expect_part(error_of({{"name", "dda.stride"}}), "cannot be a name in GLSL");
    expect_part(error_of({{"type", "double"}}), "'type' = \"double\" is not known");
    expect_part(error_of({{"default", 2}}), "parameter 'x' = 2 is outside of its range: [0, 1]");
    expect_part(error_of({{"default", "a"}}), "\"a\" is no float");
    expect_part(error_of({{"range", {1, 0}}}), "'range' = [1,0] has nothing in it");
    expect_part(error_of({{"range", {0}}}), "'range' must be [least, most], not [0]");
    expect_part(error_of({{"range", nullptr}}), "lacks the key 'range'");
    expect_part(error_of({{"type", "uint"}, {"default", 1}, {"range", {-1, 2}}}), "-1 is no uint");
    expect_part(error_of({{"type", "uint"}, {"default", 1}, {"range", {0, 1e10}}}),
                "is too large for a uint of 32 bits");
    expect_part(error_of({{"type", "choice"}, {"range", nullptr}, {"default", "b"}, {"choices", {"a"}}}),
                "'x' = \"b\" is outside of its range: a");
    expect_part(error_of({{"type", "choice"}, {"range", nullptr}, {"default", "a"}, {"choices", {"a", "a"}}}), "twice");
    expect_part(error_with({{"presets", {{{"name", "p"}, {"description", "d"}, {"parameters", {{"limt", 1}}}}}}}),
                "unknown parameter 'limt'; did you mean 'limit'?");
}

TEST_F(DeclaredRefusals, Images) {
    const auto error_of = [&](const Json& patch) {
        Json image = sound["images"][0];
        image.merge_patch(patch);
        return error_with({{"images", {image}}});
    };
    expect_part(error_of({{"format", "rgba16"}}), "'format' = \"rgba16\" is not known; did you mean 'rgba16f'?");
    expect_part(error_of({{"name", "lit"}}), "every technique has an image 'lit' already");
    expect_part(error_of({{"size", {100000, 1}}}), "'size' must be [width, height] in pixels, each in [1, 16384]");
    expect_part(error_of({{"mips", 16}}), "'mips' = 16 is outside [1, 15]");
    expect_part(error_of({{"divisor", 2}}), "the result 'radiance' must be of the screen's size");
    expect_part(error_of({{"cleared", {{"to", 1e39}}}}), "'to' has the number 1e+39 outside of [-3.4028235e+38");
    expect_part(error_of({{"cleared", {{"to", {0, 0, -1e39, 0}}}}}), "'to' has the number -1e+39 outside");
    expect_part(error_of({{"format", "rg16f"}}), "'radiance' is rg16f, which lacks it");
    expect_part(error_of({{"history", true}, {"mips", 2}}), "an image with a history has no mips");
    Json images = sound["images"];
    images.push_back({{"name", "unused"}, {"format", "r8"}});
    expect_part(error_with({{"images", images}}), "images[1]: no pass writes the image 'unused'");
}

TEST_F(DeclaredRefusals, Denoisers) {
    const auto error_of = [&](const Json& patch) {
        Json changed = {{"result", nullptr},
                        {"images", nullptr},
                        {"tracers", {{"slots", {{{"name", "tracer"}, {"default", "dda"}}}}}},
                        {"denoiser", {{"default", "mean"}, {"defaults", {{"lobe", "visible_normals"}}}}},
                        {"passes",
                         {{{"shader", "composed_ssr/trace.comp"},
                           {"tracers", "tracer"},
                           {"rays", "max_rays"},
                           {"over", "traced_pixels"},
                           {"reads", {"below_horizon"}},
                           {"buffers", {"directions", "hits"}}}}}};
        for (const auto& [key, value] : patch.items()) {
            Json& changed_value = key == "pass" ? changed["passes"][0] : changed[key];
            value.is_object() ? changed_value.merge_patch(value) : void(changed_value = value);
        }
        return error_with(changed);
    };
    EXPECT_EQ(error_of(Json::object()), "no error");
    expect_part(error_of({{"denoiser", {{"default", "meen"}}}}),
                "'default' = \"meen\" is not known; did you mean 'mean'?");
    expect_part(error_of({{"denoiser", {{"default", nullptr}}}}), "lacks the key 'default'");
    expect_part(error_of({{"denoiser", {{"defaults", {{"lobee", "normals"}}}}}}), "did you mean 'lobe'?");
    expect_part(error_of({{"result", sound["result"]}}), "a technique with a 'denoiser' has no 'result'");
    expect_part(error_of({{"reflects", {{"up_to", "limit"}}}}), "a technique with a 'denoiser' has no 'reflects'");
    expect_part(error_of({{"pass", {{"buffers", {"directions"}}}}}),
                "denoiser: no pass has 'hits' among its 'buffers'");
    expect_part(error_of({{"pass", {{"when", {{"mode", "a"}}}}}}),
                "'buffers', for rays that the denoiser reads, where");
    expect_part(error_of({{"buffers", {{{"name", "hits"}, {"bytes", 4}}}}}), "has a buffer 'hits' already");
    expect_part(error_of({{"images", {{{"name", "below_horizon"}, {"format", "r8"}}}}}),
                "image 'below_horizon' already");
    const auto parameters_and = [](const char* name) {
        Json parameters = sound["parameters"];
        parameters.push_back(sound["parameters"][1]);
        parameters.back()["name"] = name;
        return parameters;
    };
    expect_part(error_of({{"parameters", parameters_and("max_rays")}}), "the parameter 'max_rays' is one that every");
    expect_part(error_with({{"parameters", parameters_and("denoiser")}}), "the parameter 'denoiser' chooses one of");
    expect_part(error_with_pass({{"over", "traced_pixels"}}), "there is no image 'traced_pixels'");
    expect_part(error_with_pass({{"buffers", {"hits"}}}), "there is no buffer 'hits'");
}

TEST_F(DeclaredRefusals, Passes) {
    expect_part(error_with_pass({{"shader", "shade.glsl"}}), "must end in .comp");
    expect_part(error_with_pass({{"shader", "shad.comp"}}), "did you mean 'shade.comp'?");
    expect_part(error_with_pass({{"shader", "../shade.comp"}}), "has no '..'");
    expect_part(error_with_pass({{"reads", {"radiance"}}}),
                "the pass reads and writes an image of the name 'radiance'");
    expect_part(error_with_pass({{"reads", {{{"image", "radiance"}, {"as", "before"}}}}}),
                "the pass reads 'radiance' and writes it, too");
    expect_part(error_with_pass({{"reads", {"litt"}}}), "there is no image 'litt'; did you mean 'lit'?");
    expect_part(error_with_pass({{"writes", {"depth"}}}), "no pass can write 'depth', which all techniques read");
    expect_part(error_with_pass({{"writes", nullptr}}), "the pass writes nothing");
    expect_part(error_with_pass({{"tracers", "tracer"}}), "'tracers' has no slot 'tracer'");
    expect_part(error_with_pass({{"rays", "limit"}}), "is no parameter of whole numbers in [1, 64]");
    expect_part(error_with_pass({{"set", {{"x", "1"}}}}), "must be a whole number (int, uint), one with a point");
    expect_part(error_with_pass({{"set", {{"x", 1e39}}}}), "'x' has the number 1e+39 outside of [-3.4028235e+38");
    expect_part(error_with_pass({{"set", {{"x", {0, 0, -1e39, 0}}}}}), "'x' has the number -1e+39 outside");
    Json passes = sound["passes"];
    passes.insert(passes.begin(), Json({{"shader", "shade.comp"}, {"reads", {"late"}}, {"writes", {"radiance"}}}));
    Json images = sound["images"];
    images.push_back({{"name", "late"}, {"format", "r8"}});
    passes.push_back({{"shader", "shade.comp"}, {"writes", {"late"}}});
    expect_part(error_with({{"passes", passes}, {"images", images}}),
                "passes[0]: reads[0]: the pass reads 'late', which no pass before it writes");
}

TEST_F(DeclaredRefusals, WhatIsMissingUnderSomeCondition) {
    expect_part(error_with_pass({{"when", {{"mode", "a"}}}}),
                "no pass writes the result 'radiance', where mode is 'b'");
    expect_part(error_with_pass({{"when", {{"limit", {{"above", 0.3}}}}}}), "where limit is 0.29");
    expect_part(error_with({{"result", {{"when", {{"mode", "a"}}}}}}), "there is no result, where mode is 'b'");
    expect_part(error_with_pass({{"when", {{"mood", "a"}}}}), "'mood' is no parameter and no fact of a shot");
    expect_part(error_with_pass({{"when", {{"mode", 1}}}}), "is compared with 1, but its values are like \"a\"");
    expect_part(error_with_pass({{"when", {{"limit", {{"below", 1e39}}}}}}), "'below' has the number 1e+39 outside");
}

TEST_F(DeclaredRefusals, Includes) {
    expect_part(error_with_shader("\n#include \"../x.glsl\"\n"), "refused/shade.comp:2: #include \"../x.glsl\"");
    expect_part(error_with_shader("#include \"/etc/passwd\"\n"), "is no path below");
    expect_part(error_with_shader("#include \"common/halton.glsl\"\n"), "there is no such shader");
    expect_part(error_with_shader("#include \"tests/error_message.h\"\n"), "there is no such shader");
    technique.write("a.glsl", "#include \"b.glsl\"\n");
    technique.write("b.glsl", "\n#include \"a.glsl\"\n");
    expect_part(error_with_shader("#include \"a.glsl\"\n"),
                "refused/b.glsl:2: #include \"a.glsl\": refused/a.glsl includes itself");
    fs::remove(technique.folder / "a.glsl");
    fs::create_symlink("/etc/passwd", technique.folder / "a.glsl");
    expect_part(error_with_shader("#include \"a.glsl\"\n"), "is a symbolic link");
}

TEST_F(DeclaredRefusals, SoManyParametersThatNoCompilerEnds) {
    Json many = sound["parameters"];
    for (int i = 0; i < 20000; ++i)
        many.push_back({{"name", "p" + std::to_string(i)},
                        {"type", "float"},
                        {"range", {0, 1}},
                        {"default", 0.5},
                        {"meaning", "m"}});
    expect_part(error_with({{"parameters", many}}), "there are 20002 parameters, and a technique takes at most 500");
}

/// Many commands print them.
TEST_F(DeclaredRefusals, TextsThatATerminalObeys) {
    expect_part(error_with({{"title", "A \x1b[31mtest"}}),
                "technique.json:47:2: the text 'A \\x1b[31mtest' has a character that a terminal obeys");
    expect_part(error_with({{"description", "a\nerror: forged"}}), "'a\\nerror: forged'");
    expect_part(error_with({{"par\u202e", 1}}), "'par\\u202e'");
}

TEST_F(DeclaredRefusals, Names) {
    const TemporaryTechnique builtin("none"), other("bad-name");
    for (const TemporaryTechnique* t : {&builtin, &other}) {
        t->write("technique.json", sound.dump());
        t->write("shade.comp", shader);
    }
    expect_part(error_message([&] { builtin.add(); }), "'none' is one of ssrlab's own techniques");
    expect_part(error_message([&] { other.add(); }), "its name 'bad-name' must be of small letters, digits and '_'");
    technique.write("technique.json", sound.dump());
    technique.add();
    fs::create_directories(technique.parent / "elsewhere");
    fs::copy(technique.folder, technique.parent / "elsewhere/refused");
    expect_part(error_message([&] { add_technique_folder(technique.parent / "elsewhere/refused"); }),
                "is called 'refused', too");
}

/// On a device.
struct DeclaredShaders : HeldCamera {
    TemporaryTechnique technique{"shaded"};
    DeclaredShaders() {
        view.extent = {8, 8};
        technique.write("technique.json", sound.dump());
    }
    static SyntheticHit wall(const CameraRay&) { return {.distance = 1, .lit = glm::vec3(0.25f)}; }
    std::string error_of_shader(const std::string& text) {
        technique.write("shade.comp", text);
        technique.add();
        return error_message([&] { render(*make_technique("shaded"), wall); });
    }
};

TEST_F(DeclaredShaders, AnEditCounts) {
    technique.write("shade.comp", shader);
    technique.add();
    EXPECT_EQ(render(*make_technique("shaded"), wall).radiance.values[0], 0.25f);
    std::string edited = shader;
    edited.replace(edited.find(".rgb"), 4, ".rgb * 2.0");
    technique.write("shade.comp", edited);
    EXPECT_EQ(render(*make_technique("shaded"), wall).radiance.values[0], 0.25f) << "what was read is what runs";
    technique.add();
    EXPECT_EQ(render(*make_technique("shaded"), wall).radiance.values[0], 0.5f);
}

/// Refused before anything is taken.
TEST_F(DeclaredShaders, ImagesAndBuffersStayWithinTheMemoryThatIsAllowed) {
    const auto error_with = [&](const Json& patch) {
        Json changed = sound;
        changed.merge_patch(patch);
        technique.write("technique.json", changed.dump(1));
        return error_of_shader(shader);
    };
    const LimitsOf limits({.memory = 100 << 20});
    EXPECT_EQ(error_with(Json::object()), "no error");
    const Json big = {{"name", "big"}, {"format", "rgba32f"}, {"size", {4096, 4096}}};
    expect_part(
        error_with({{"images", {sound["images"][0], big}}, {"passes", {{{"clear", "big"}}, sound["passes"][0]}}}),
        "technique 'shaded': its images and buffers at 8x8");
    const Json list = {{"name", "list"}, {"bytes", 1 << 28}};
    Json pass = sound["passes"][0];
    pass["buffers"] = {"list"};
    expect_part(error_with({{"buffers", {list}}, {"passes", {pass}}}), "--max-memory");
}

TEST_F(DeclaredShaders, MistakesNameFileLineAndTheLineItself) {
    expect_part(error_of_shader("void main() {\n    int x = undeclared;\n}\n"),
                "shaded/shade.comp:2: 'undeclared' : undeclared identifier \n    int x = undeclared;");
    technique.write("part.glsl", "\n\nfloat broken( { }\n");
    const std::string error = error_of_shader("#include \"part.glsl\"\nvoid main() {}\n");
    expect_part(error, "shaded/part.glsl:3:");
    expect_part(error, "(included by shaded/shade.comp:1)\n    float broken( { }");
    expect_part(error_of_shader("layout(local_size_x = 8) in;\nuniform sampler2D lit;\nvoid main() {}\n"),
                "pass shaded/shade reads 'lit', which shaded/shade.comp does not use");
}

}  // namespace
