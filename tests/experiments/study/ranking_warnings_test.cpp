// What is said before a study that will rank nothing by its primary error.
#include "experiments/study/plan/ranking_warnings.h"
#include "tests/experiments/study/study_fixture.h"

namespace {

struct RankingWarnings : StudyTest {
    /// Of a study of one technique that draws random numbers, in these scenes; `more`: keys of the config.
    std::vector<std::string> of(const std::string& scenes, const std::string& more,
                                const std::string& size = "[16, 9]") {
        write_text(folder / "study.json",
                   R"({"shots": [{"scene": )" + scenes + R"(, "resolution": )" + size + R"(}], )" + more +
                       R"("techniques": [{"technique": "none"}, {"technique": "amd_sssr", "preset": "best"}]})");
        const Config config = read_config(folder / "study.json");
        const StudyPlan plan =
            plan_study(config, {.name = "d", .driver = "1"}, {fs::path(SSRLAB_SOURCE_DIR) / "scenes"}, false);
        return ranking_warnings(config, plan);
    }
};

using Sentences = std::vector<std::string>;

}  // namespace

TEST_F(RankingWarnings, NameSeedsAndSamples) {
    EXPECT_EQ(of(R"("fence")", R"("seeds": 4, )"), Sentences());
    EXPECT_EQ(of(R"("fence")", R"("seeds": 1, )"),
              Sentences{"amd_sssr best has 1 seed, so no shot ranks it. Set \"seeds\": 4."});
    EXPECT_EQ(
        of(R"(["fence", "rails", "grazing", "corridor"])", R"("seeds": 1, )"),
        Sentences{"amd_sssr best has 1 seed, so no shot ranks it. The 4 scenes together still compare it. To rank "
                  "it in each shot, set \"seeds\": 4."});
    EXPECT_EQ(
        of(R"("fence")", R"("seeds": 4, "reference": {"samples": 16}, )", "[16, 9]"),
        Sentences{"fence.main.16x9: all pixels together have fewer than 4096 samples of the reference, so no error "
                  "has an interval. Increase reference.samples or the resolution."});
}

TEST_F(RankingWarnings, KnowWhatFurnishedScenesTake) {
    EXPECT_EQ(
        of(R"(["room:3", "fence"])", R"("seeds": 4, "metrics": ["mse", "flip"], "reference": {"samples": 64}, )"),
        Sentences{"room:3: few paths find the lamps that furnished scenes reflect, so mse with 64 samples detects only "
                  "large differences there (metrics/README.md). Make flip the primary metric, or set "
                  "reference.samples to 1024."});
    const std::string enough = R"("seeds": 4, "metrics": ["mse"], "reference": {"samples": 1024}, )";
    EXPECT_EQ(of(R"("room:3")", enough), Sentences());
    EXPECT_EQ(of(R"("room:3")", R"("seeds": 4, "primary": {"metric": "flip"}, "metrics": ["flip"], )"), Sentences());
}
