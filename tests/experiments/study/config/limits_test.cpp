// Variants are held to the limits of their API wherever they are rendered, and nobody else is.
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "experiments/study/measuring/render_variant.h"
#include "tests/experiments/study/study_fixture.h"
#include "variants/registry.h"

namespace {

/// Asks for a storage buffer, which WebGL 2 has not.
struct UsesBuffer : Variant {
    Reflections render(PassGraph& graph, const GBuffer&) override {
        graph.clear(graph.buffer("list", 4), 0);
        return {};
    }
};

}  // namespace

TEST(Limits, HoldForTheVariantsPassesOnly) {
    Device device;
    PassGraph graph(device, {8, 8});
    UsesBuffer variant;
    const auto render = [&] { render_variant(graph, variant, {}, 0, {}); };
    EXPECT_NO_THROW(render());
    variant.limits = Limits::webgl2;
    EXPECT_THROW(render(), Error);
    EXPECT_NO_THROW(graph.clear(graph.buffer("list", 4), 0)) << "a composite may follow";
    variant.limits = Limits::none;
    EXPECT_NO_THROW(render());
}

/// A whole study within them; the manifest says which points were.
TEST_F(StudyTest, RunsTechniquesWithinTheirLimits) {
    write_text(folder / "study.json", R"({"shots": [{"scene": "mirror_pillars", "resolution": [64, 36]}],
        "reference": {"samples": 16}, "metrics": "mse", "targets": "specular", "masks": "reflective",
        "timing": {"frames": 0}, "seeds": 1,
        "variants": [{"variant": "diligent_ssr", "sweep": {"hierarchy": ["intermediate", "mip_views"]}}]})");
    const nlohmann::json manifest = read_json(run(read_config(folder / "study.json"), "a") / "manifest.json");
    ASSERT_EQ(manifest["variants"].size(), 2u);
    for (const nlohmann::json& v : manifest["variants"])
        EXPECT_EQ(v.value("limits", ""),
                  v["parameters"]["hierarchy"] == "mip_views" ? "" : "WebGL 2 with EXT_color_buffer_float");
}
