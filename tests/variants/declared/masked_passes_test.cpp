// Fragment passes that a technique.json lets a depth or a stencil buffer decide.
#include "tests/error_message.h"
#include "tests/variants/declared/technique_folder.h"
#include "tests/variants/held_camera.h"
#include "tests/variants/mirror_scenes.h"

namespace {

using Json = nlohmann::json;

/// Marks the right half, and shades what is marked: by stencil 7 where it is equal, by a depth of 0 where 0 is not
/// less.
const char* const masked = R"({
  "title": "Halves",
  "parameters": [
    {"name": "by", "type": "choice", "choices": ["stencil", "depth", "nothing"], "default": "stencil", "meaning": "m"},
    {"name": "lifted", "type": "bool", "default": false, "meaning": "m"}
  ],
  "images": [{"name": "mask", "format": "d32f_s8"}, {"name": "radiance", "format": "rgba16f"}],
  "passes": [
    {"clear": "mask", "value": [1, 0, 0, 0]},
    {"clear": "radiance"},
    {"shader": "mark.frag",
     "stencil": {"image": "mask", "write": 7, "when": {"by": "stencil"}},
     "depth": {"image": "mask", "compare": "always", "write": true, "when": {"by": {"not": "stencil"}}}},
    {"shader": "shade.frag", "writes": "radiance",
     "stencil": {"image": "mask", "equal": 7, "when": {"by": "stencil"}},
     "depth": {"image": "mask", "when": {"by": "depth"}}}
  ],
  "result": {"radiance": "radiance", "confidence": "radiance", "channel": "a"},
  "random": false,
  "limits": {"api": "webgl2", "lifted_by": {"lifted": true}}
})";

struct DeclaredMasks : HeldCamera {
    DeclaredMasks() {
        view.extent = {16, 8};
        technique.write("mark.frag",
                        "uniform sampler2D lit;\nvoid main() {\n"
                        "    if (2.0 * gl_FragCoord.x < float(textureSize(lit, 0).x)) discard;\n}\n");
        technique.write("shade.frag",
                        "layout(location = 0) out vec4 radiance;\nvoid main() { radiance = vec4(1.0); }\n");
    }

    std::string error_with(const Json& patch) {
        Json changed = Json::parse(masked);
        changed["passes"].back().merge_patch(patch);
        technique.write("technique.json", changed.dump(1));
        return error_message([&] { technique.add(); });
    }

    TemporaryTechnique technique{"masked"};
};

}  // namespace

TEST_F(DeclaredMasks, DrawWhereTheBufferSaysSo) {
    technique.write("technique.json", masked);
    const std::string name = technique.add().name;
    for (const auto& [by, left, right] :
         {std::tuple("stencil", 0.0f, 1.0f), {"depth", 1.0f, 0.0f}, {"nothing", 1.0f, 1.0f}}) {
        SCOPED_TRACE(by);
        const auto technique = make_technique(name, {{"by", by}});
        EXPECT_EQ(technique->limits, Limits::webgl2);
        const Frame frame = render(*technique, floor_before_white, 1);
        for (unsigned x = 0; x < 16; ++x) EXPECT_EQ(*frame.confidence.pixel(x, 3), x < 8 ? left : right) << x;
    }
    EXPECT_EQ(make_technique(name, {{"lifted", true}})->limits, Limits::none);
}

TEST_F(DeclaredMasks, Refusals) {
    const auto expect_part = [](const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks: " << part;
    };
    EXPECT_EQ(error_with(Json::object()), "no error");
    expect_part(error_with({{"stencil", {{"image", "radiance"}}}}), "'radiance' is rgba16f, which has no stencil");
    expect_part(error_with({{"depth", {{"image", "radiance"}}}}), "which is no format of depth: d32f");
    expect_part(error_with({{"stencil", {{"image", "musk"}}}}), "there is no image 'musk'; did you mean 'mask'?");
    expect_part(error_with({{"stencil", {{"equal", 256}}}}), "'equal' = 256 is outside [0, 255]");
    expect_part(error_with({{"stencil", {{"equal", nullptr}}}}),
                "has either a value to 'write', or one that is 'equal'");
    expect_part(error_with({{"depth", {{"compare", "lesser"}}}}), "did you mean 'less'?");
    expect_part(error_with({{"shader", "shade.comp"}}), "only a fragment shader is tested by depth or stencil");

    expect_part(error_with({{"reads", "mask"}, {"depth", {{"write", true}, {"when", {{"by", "nothing"}}}}}}),
                "the pass reads 'mask' and writes it, too; write another image, where by is 'nothing'");
    EXPECT_EQ(error_with({{"reads", "mask"}}), "no error") << "it is only tested by it";

    Json unmarked = Json::parse(masked);
    unmarked["passes"].erase(2);
    unmarked["passes"].erase(0);
    technique.write("technique.json", unmarked.dump(1));
    expect_part(error_message([&] { technique.add(); }),
                "the pass is tested by 'mask', which no pass before it writes");
    Json smaller = Json::parse(masked);
    smaller["images"][0]["divisor"] = 2;
    technique.write("technique.json", smaller.dump(1));
    expect_part(error_message([&] { technique.add(); }), "'mask' must have the size of 'radiance'");
    Json other_api = Json::parse(masked);
    other_api["limits"] = "webgl";
    technique.write("technique.json", other_api.dump(1));
    expect_part(error_message([&] { technique.add(); }), "did you mean 'webgl2'?");
}
