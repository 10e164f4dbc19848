// Images of another program as rows of a study: those that ssrlab itself rendered and wrote as such err as before, and
// what cannot be compared is refused with the reason.
#include "core/error.h"
#include "core/files.h"
#include "tests/experiments/study/external_fixture.h"

#include <limits>
#include <map>
#include <set>

namespace {

bool says(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

struct ExternalImagesTest : StudyTest {
    const std::string view = "mirror_pillars.main.96x54";

    static std::string study_of(const std::string& techniques, const std::string& more = "") {
        return R"({"shots": [{"scene": "mirror_pillars", "resolution": [96, 54]}], "reference": {"samples": 64},
            "metrics": ["mse", "flip"], "masks": ["all", "reflective", "hit"], "targets": ["specular", "image", "incident"],
            "timing": {"frames": 0}, "seeds": 1, "techniques": [)" +
               techniques + "]" + more + "}";
    }
    fs::path run_text(const std::string& text, const std::string& out) {
        write_text(folder / "study.json", text);
        return run(read_config(folder / "study.json"), out);
    }
    void describe(const std::string& more = "") { describe_frames(folder / "frames", more); }

    /// What ssrlab rendered, as a program would write it; the result's rows by target, metric and mask.
    std::map<std::string, double> write_frames() {
        const fs::path out = run_text(study_of(R"({"technique": "none"}, {"technique": "mcguire_dda"})"), "own");
        frame = rendered_frame(out, "mcguire_dda");
        write(frame.image, "f0.s0"), write(frame.without_reflections(), "f0.off");
        describe();
        return errors_of(out, "mcguire_dda");
    }
    void write(const HostImage& rgb, const std::string& name) {
        write_exr(folder / "frames" / view / (name + ".exr"), rgb);
    }
    static std::map<std::string, double> errors_of(const fs::path& out, const std::string& technique) {
        std::map<std::string, double> errors;
        for (const ResultRow& r : read_rows<ResultRow>(out / "results.csv"))
            if (r.technique == technique) errors[r.target + " " + r.metric + " " + r.mask] = r.value.value();
        return errors;
    }
    /// What a study of the frames says; "" if it ran.
    std::string refusal() {
        try {
            run_text(study_of(R"({"technique": "none"}, {"external": "frames"})"), "refused");
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }

    RenderedFrame frame;
};

}  // namespace

TEST_F(ExternalImagesTest, ErrAsTheSameImagesOfATechnique) {
    const std::map<std::string, double> own = write_frames();
    describe(
        R"(, "driver": "Mesa", "licence": "MIT", "settings": {"maxDistance": 20, "blur": false}, "milliseconds": 18)");
    const std::string study =
        study_of(R"({"technique": "none", "baseline": true}, {"external": "frames", "label": "three"})");
    const fs::path out = run_text(study, "external");
    const std::map<std::string, double> external = errors_of(out, "three_ssr");
    std::set<std::string> compared;
    for (const auto& [what, error] : external) {
        compared.insert(what);
        // Images were kept as half floats: 2^-11, which FLIP of flat bright surfaces shows.
        EXPECT_NEAR(error, own.at(what), says(what, "flip") ? 0.001 : 0.005 * own.at(what)) << what;
    }
    EXPECT_EQ(compared, (std::set<std::string>{"specular mse all", "specular mse reflective", "specular flip all",
                                               "specular flip reflective", "image mse all", "image mse reflective",
                                               "image flip all", "image flip reflective"}))
        << "no confidence, and no incident radiance";
    const nlohmann::json manifest = read_json(out / "manifest.json");
    const nlohmann::json& entry = manifest["techniques"][1];
    EXPECT_EQ(entry["external"]["version"], "r187");
    EXPECT_EQ(entry["external"]["stated_milliseconds"], 18);
    EXPECT_EQ(entry["parameters"]["maxDistance"], 20);
    EXPECT_TRUE(says(manifest.dump(), "18 ms for a frame's reflections, which ssrlab did not measure"));

    // An image that changes is another result; one that does not is found again.
    for (float& v : frame.image.values) v *= 1.0001f;
    write(frame.image, "f0.s0");
    EXPECT_NE(errors_of(run_text(study, "external"), "three_ssr").at("specular mse all"),
              external.at("specular mse all"));
}

TEST_F(ExternalImagesTest, HaveSeedsAndABaselineOfTheirOwn) {
    write_frames();
    describe(R"(, "seeds": 3)");
    for (const char* seed : {"1", "2"}) write(frame.image, std::string("f0.s") + seed);
    fs::copy(folder / "frames", folder / "before", fs::copy_options::recursive);
    const fs::path out = run_text(
        study_of(R"({"external": "before", "point": "before", "baseline": true}, {"external": "frames"})"), "out");
    size_t rows = 0;
    for (const EffectRow& r : read_rows<EffectRow>(out / "effects.csv")) {
        if (r.metric != "mse" || r.target != "specular" || r.mask != "reflective") continue;
        ++rows;
        EXPECT_EQ(r.seeds, 3u);
        EXPECT_EQ(r.point + " " + r.against_point, "default before");
        EXPECT_EQ(r.ratio.value(), 1.0);
    }
    EXPECT_EQ(rows, 1u);
}

/// Where surfaces emit the light that scene-for wrote, every pixel proves something.
TEST_F(ExternalImagesTest, HoldTheGivenLightInEveryPixel) {
    write_frames();
    HostImage black_mirrors = frame.without_reflections(), lit_mirrors = black_mirrors;
    size_t mirrors = 0;
    for (size_t i = 0; i < frame.image.pixel_count(); ++i)
        if (frame.specular.rgb(i) != glm::vec3(0.0f))
            ++mirrors, black_mirrors.set_rgb(i, glm::vec3(0.0f)), lit_mirrors.set_rgb(i, glm::vec3(1.0f));
    ASSERT_GT(mirrors, 100u);
    write(lit_mirrors, "f0.off");
    EXPECT_EQ(refusal(), "")
        << "mirrors emit nothing, so that they prove nothing about a light that is the program's own";
    describe(R"(, "given_light": true)");
    EXPECT_TRUE(says(refusal(), "differ from the truth"));
    write(black_mirrors, "f0.off");
    EXPECT_EQ(refusal(), "");
    const std::string manifest = read_text(folder / "refused/manifest.json");
    EXPECT_NE(manifest.find("of " + std::to_string(frame.image.pixel_count()) + " pixels 0 differ"), std::string::npos);
}

/// Of a still scene, so that each frame errs as the only one did.
TEST_F(ExternalImagesTest, AreMeasuredFrameByFrame) {
    const std::map<std::string, double> own = write_frames();
    for (const char* name : {"s0", "off"})
        fs::copy_file(folder / "frames" / view / (std::string("f0.") + name + ".exr"),
                      folder / "frames" / view / (std::string("f1.") + name + ".exr"));
    std::string study = study_of(R"({"technique": "none"}, {"external": "frames"})", R"(, "frame_metrics": "mse")");
    study.replace(study.find(R"("resolution")"), 0, R"("frames": [0, 1], )");
    std::map<std::string, double> by_frame;
    for (const ResultRow& r : read_rows<ResultRow>(run_text(study, "sequence") / "results.csv"))
        if (r.technique == "three_ssr" && r.target == "specular" && r.metric == "mse" && r.mask == "reflective")
            by_frame[r.frame] = r.value.value();
    const double error = own.at("specular mse reflective");
    ASSERT_EQ(by_frame.size(), 3u) << "both frames and their mean";
    for (const auto& [frame, value] : by_frame) EXPECT_NEAR(value, error, 0.005 * error) << frame;  // half floats
    fs::remove(folder / "frames" / view / "f1.s0.exr");
    EXPECT_THROW(run_text(study, "sequence"), Error);
}

TEST_F(ExternalImagesTest, AreRefusedWhereTheyCannotBeCompared) {
    write_frames();
    EXPECT_EQ(refusal(), "");
    const HostImage &image = frame.image, off = frame.without_reflections();
    const auto with = [&](const HostImage& changed, const std::string& name) {
        write(changed, name);
        const std::string why = refusal();
        write(image, "f0.s0"), write(off, "f0.off");
        return why;
    };
    HostImage flipped(image.extent, 3);
    for (unsigned y = 0; y < image.extent.y; ++y)
        std::copy_n(off.pixel(0, image.extent.y - 1 - y), image.extent.x * 3, flipped.pixel(0, y));
    EXPECT_TRUE(says(with(flipped, "f0.off"), "upside down"));
    EXPECT_TRUE(fs::exists(folder / "refused/images" / ("refused.three_ssr." + view + ".f0.png")));
    HostImage brighter = image;
    for (float& v : brighter.values) v *= 2;
    EXPECT_TRUE(says(with(brighter, "f0.s0"), "2 times as bright"));
    HostImage broken = image;
    broken.values[5] = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(says(with(broken, "f0.s0"), "holds 1 values that are NaN or infinite"));
    EXPECT_TRUE(says(with(HostImage({48, 27}, 3), "f0.s0"), "has 48x27 pixels; the shot has 96x54"));
    fs::remove(folder / "frames" / view / "f0.off.exr");
    EXPECT_TRUE(says(refusal(), "f0.off.exr"));
    fs::remove_all(folder / "frames" / view);
    EXPECT_TRUE(says(refusal(), "holds no " + view)) << "a study that leaves all of its external images out";
}

TEST_F(ExternalImagesTest, AreRefusedWithoutWhatTheyNeedToBeNamedBy) {
    fs::create_directories(folder / "frames");
    EXPECT_TRUE(says(refusal(), "holds no external.json"));
    const auto with = [&](const std::string& text) {
        write_text(folder / "frames/external.json", text);
        return refusal();
    };
    EXPECT_TRUE(says(with(R"({"name": "a", "engine": "b"})"), "'version'"));
    EXPECT_TRUE(says(with(R"({"name": "a", "engine": "", "version": "1"})"), "'engine' is empty"));
    EXPECT_TRUE(says(with(R"({"name": "amd_sssr", "engine": "b", "version": "1"})"), "is a technique of ssrlab"));
    EXPECT_TRUE(says(with(R"({"name": "a/b", "engine": "b", "version": "1"})"), "is not a valid name"));
    EXPECT_TRUE(says(with(R"({"name": "a", "engine": "b", "version": "1", "seeds": 0})"), "'seeds'"));
    EXPECT_TRUE(
        says(with(R"({"name": "a", "engine": "b", "version": "1", "setings": {}})"), "did you mean 'settings'?"));
    EXPECT_TRUE(says(with(R"({"name": "a", "engine": "b", "version": "1", "settings": {"x": []}})"), "setting 'x'"));
}
