// Techniques are held to the limits of their API wherever they are rendered, and nobody else is.
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "experiments/study/measuring/render_technique.h"
#include "tests/experiments/study/study_fixture.h"
#include "variants/registry.h"

namespace {

/// Asks for a storage buffer, which WebGL 2 has not.
struct UsesBuffer : Technique {
    Reflections render(PassList& pass_list, const GBuffer&) override {
        pass_list.clear(pass_list.buffer("list", 4), 0);
        return {};
    }
};

}  // namespace

TEST(Limits, HoldForTheTechniquesPassesOnly) {
    Device device;
    PassList pass_list(device, {8, 8});
    UsesBuffer technique;
    const auto render = [&] { render_technique(pass_list, technique, {}, 0, {}); };
    EXPECT_NO_THROW(render());
    technique.limits = Limits::webgl2;
    EXPECT_THROW(render(), Error);
    EXPECT_NO_THROW(pass_list.clear(pass_list.buffer("list", 4), 0)) << "a composite may follow";
    technique.limits = Limits::none;
    EXPECT_NO_THROW(render());
}

/// A whole study within them; the manifest says which points were.
TEST_F(StudyTest, RunsTechniquesWithinTheirLimits) {
    write_text(folder / "study.json", R"({"shots": [{"scene": "mirror_pillars", "resolution": [64, 36]}],
        "reference": {"samples": 16}, "metrics": "mse", "targets": "specular", "masks": "reflective",
        "timing": {"frames": 0}, "seeds": 1,
        "techniques": [{"technique": "diligent_ssr", "sweep": {"hierarchy": ["intermediate", "mip_views"]}}]})");
    const nlohmann::json manifest = read_json(run(read_config(folder / "study.json"), "a") / "manifest.json");
    ASSERT_EQ(manifest["techniques"].size(), 2u);
    for (const nlohmann::json& v : manifest["techniques"])
        EXPECT_EQ(v.value("limits", ""),
                  v["parameters"]["hierarchy"] == "mip_views" ? "" : "WebGL 2 with EXT_color_buffer_float");
}
