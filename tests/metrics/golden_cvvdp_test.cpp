#include "core/json.h"
#include "core/near_miss.h"
#include "metrics/cvvdp/cvvdp.h"
#include "metrics/cvvdp/temporal_filters.h"
#include "tests/metrics/npy_file.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdlib>

// Scores and stages that the authors' program, ColorVideoVDP 0.5.6, made in float32.

namespace {

std::filesystem::path golden_cvvdp() {
    const char* vectors = std::getenv("SSRLAB_VECTORS");
    return std::filesystem::path(vectors ? vectors : SSRLAB_SOURCE_DIR "/tests/data/vectors") / "cvvdp";
}

/// A pair of the index, or a variant of one.
struct GoldenCase {
    nlohmann::json entry, pair;

    Viewing viewing() const {
        Viewing viewing{.display = display_named(entry["display"]), .nits_per_unit = 1};
        viewing.display.pixels_per_degree = entry.value("pixels_per_degree", viewing.display.pixels_per_degree);
        return viewing;
    }
};

std::vector<GoldenCase> golden_cases() {
    const nlohmann::json index = read_json(golden_cvvdp() / "index.json");
    std::vector<GoldenCase> cases;
    for (const nlohmann::json& pair : index["pairs"]) cases.push_back({pair, pair});
    for (const nlohmann::json& variant : index["variants"])
        for (const nlohmann::json& pair : index["pairs"])
            if (pair["name"] == variant["of"]) cases.push_back({variant, pair});
    return cases;
}

std::vector<HostImage> frames_of(const GoldenCase& golden, const char* role) {
    const NpyArray array = read_npy(golden_cvvdp() / golden.pair[role].get<std::string>());
    const float scale = golden.pair["pixels"] == "cd/m2" ? 1.0f : 1 / 255.0f;
    std::vector<HostImage> frames;
    for (size_t f = 0; f < array.shape.at(0); ++f) {
        HostImage frame({unsigned(array.shape.at(2)), unsigned(array.shape.at(1))}, unsigned(array.shape.at(3)));
        for (size_t i = 0; i < frame.values.size(); ++i)
            frame.values[i] = scale * array.values[f * frame.values.size() + i];
        frames.push_back(std::move(frame));
    }
    return frames;
}

struct Frames {
    std::vector<HostImage> reference, test;

    explicit Frames(const GoldenCase& golden)
        : reference(frames_of(golden, "reference")), test(frames_of(golden, "test")) {
        if (golden.entry.value("swapped", false)) std::swap(reference, test);
    }
};

double video_jod(const GoldenCase& golden, const Frames& frames, TemporalPadding padding) {
    CvvdpVideo video(frames.test[0].extent, golden.viewing(), golden.entry["frames_per_second"], padding);
    for (size_t f = 0; f < frames.test.size(); ++f) video.add(frames.reference[f], frames.test[f]);
    return video.score().jod;
}

/// The largest difference relative to the file's largest absolute value.
double deviation(const std::vector<float>& ours, std::span<const float> golden) {
    EXPECT_EQ(ours.size(), golden.size());
    double greatest = 0, worst = 0;
    for (size_t i = 0; i < std::min(ours.size(), golden.size()); ++i) {
        greatest = std::max(greatest, std::abs(double(golden[i])));
        worst = std::max(worst, std::abs(double(ours[i]) - golden[i]));
    }
    return worst / greatest;
}

std::vector<float> joined_values(const std::vector<const FloatPlane*>& planes) {
    std::vector<float> all;
    for (const FloatPlane* plane : planes) all.insert(all.end(), plane->values.begin(), plane->values.end());
    return all;
}

/// Our values of all stages, by the names that the golden files have.
using Stages = std::map<std::string, std::vector<float>>;

template <class Planes>
std::vector<float> joined_values(const Planes& planes) {
    std::vector<const FloatPlane*> all;
    for (const FloatPlane& plane : planes) all.push_back(&plane);
    return joined_values(all);
}

void add_bands(const std::vector<BandStages>& bands, Stages& stages) {
    for (size_t b = 0; b < bands.size(); ++b) {
        const std::string band = "_" + std::to_string(b);
        stages["contrast" + band] = joined_values(bands[b].contrast[0]);
        const std::vector<float> of_reference = joined_values(bands[b].contrast[1]);
        stages["contrast" + band].insert(stages["contrast" + band].end(), of_reference.begin(), of_reference.end());
        stages["log10_background" + band] = joined_values(bands[b].background);
        for (float& v : stages["log10_background" + band]) v = std::log10(v);
        stages["sensitivity" + band] = joined_values(bands[b].sensitivity);
        stages["mutual_mask" + band] = joined_values(bands[b].mutual_mask);
        stages["difference" + band] = joined_values(bands[b].difference);
    }
}

std::vector<float> displayed(const HostImage& image, const Viewing& viewing) {
    std::vector<float> interleaved(image.values.size()), planar;
    displayed_light(viewing, image.values.data(), interleaved.data(), interleaved.size());
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = c; i < interleaved.size(); i += 3) planar.push_back(interleaved[i]);
    return planar;
}

/// Returns the opponent channels.
FrameChannels add_first_stages(const HostImage& reference, const HostImage& test, const Viewing& viewing,
                               Stages& stages) {
    stages["display_test"] = displayed(test, viewing);
    stages["display_reference"] = displayed(reference, viewing);
    FrameChannels frame;
    for (std::vector<FloatPlane>& planes : frame)
        planes = float_planes(opponent_channels, test.extent.x, test.extent.y);
    EXPECT_EQ(to_opponent(reference, test, viewing, frame[1], frame[0]), 0u);
    stages["dkl_test"] = joined_values(frame[0]);
    stages["dkl_reference"] = joined_values(frame[1]);
    return frame;
}

void add_channels(const std::string& name, const FrameChannels& channels, Stages& stages) {
    stages[name] = joined_values(channels[0]);
    const std::vector<float> of_reference = joined_values(channels[1]);
    stages[name].insert(stages[name].end(), of_reference.begin(), of_reference.end());
}

Stages stages_of(const GoldenCase& golden, const nlohmann::json& recorded) {
    const Frames frames(golden);
    const size_t recorded_frame = recorded["frame"];
    Stages stages;
    const FrameChannels opponent =
        add_first_stages(frames.reference[recorded_frame], frames.test[recorded_frame], golden.viewing(), stages);
    if (frames.test.size() == 1) {
        FrameComparison comparison(frames.test[0].extent, golden.viewing().display.pixels_per_degree, opponent_channels,
                                   cvvdp_0_5_6_calibration());
        std::vector<BandStages> bands;
        comparison.compare(opponent, nullptr, &bands);
        add_bands(bands, stages);
        const CvvdpScore score =
            CvvdpStills(frames.test[0].extent, golden.viewing()).score(frames.reference[0], frames.test[0], true);
        for (const double v : score.map.values) stages["heatmap_raw"].push_back(float(v / 10));  // 1 is 10 JOD
        return stages;
    }
    CvvdpVideo video(frames.test[0].extent, golden.viewing(), golden.entry["frames_per_second"],
                     TemporalPadding::replicate);
    video.on_frame = [&](size_t frame, const FrameChannels& channels, const std::vector<BandStages>& bands,
                         const FloatPlane& map) {
        if (frame == 0) add_channels("channels_frame0", channels, stages);
        if (frame != recorded_frame) return;
        add_channels("channels", channels, stages);
        add_bands(bands, stages);
        for (const float v : map.values)
            stages["heatmap_raw"].push_back(float((10 - jod(v, cvvdp_0_5_6_calibration())) / 10));
    };
    for (size_t f = 0; f < frames.test.size(); ++f) video.add(frames.reference[f], frames.test[f]);
    return stages;
}

/// 1e-5 is some hundred roundings of float32. The original's own differences deviate by up to 3e-5 from a program in
/// float64, for its powers of small numbers cancel. Its heat map was stored as float16, which has 11 binary digits.
double stage_tolerance(const std::string& name) {
    if (name == "heatmap_raw") return 0.5 / 1024;
    return name.starts_with("difference_") ? 4e-5 : 1e-5;
}

std::string case_name(const testing::TestParamInfo<GoldenCase>& info) { return info.param.entry["name"]; }

class CvvdpPair : public testing::TestWithParam<GoldenCase> {};

}  // namespace

TEST_P(CvvdpPair, HasTheScoreOfTheOriginal) {
    const GoldenCase& golden = GetParam();
    const Frames frames(golden);
    // The last digit of the golden scores is 1e-6, and float32 sums differ by 1e-5 of the pooled difference.
    constexpr double tolerance = 1e-4;
    if (frames.test.size() == 1) {
        const CvvdpScore score =
            CvvdpStills(frames.test[0].extent, golden.viewing()).score(frames.reference[0], frames.test[0]);
        EXPECT_NEAR(score.jod, golden.entry["jod"].get<double>(), tolerance);
        EXPECT_EQ(score.frames[0].size(), golden.entry["bands"].get<size_t>());
        return;
    }
    EXPECT_NEAR(video_jod(golden, frames, TemporalPadding::replicate), golden.entry["jod"].get<double>(), tolerance);
    if (golden.entry.contains("jod_symmetric_padding")) {
        EXPECT_NEAR(video_jod(golden, frames, TemporalPadding::symmetric),
                    golden.entry["jod_symmetric_padding"].get<double>(), tolerance);
    }
}

INSTANTIATE_TEST_SUITE_P(golden, CvvdpPair, testing::ValuesIn(golden_cases()), case_name);

TEST(GoldenCvvdp, HasTheStagesOfTheOriginal) {
    size_t compared = 0;
    for (const GoldenCase& golden : golden_cases()) {
        if (!golden.entry.contains("stages")) continue;
        const nlohmann::json recorded = read_json(golden_cvvdp() / golden.entry["stages"].get<std::string>());
        const Stages stages = stages_of(golden, recorded);
        for (const auto& [name, file] : recorded["files"].items()) {
            ASSERT_TRUE(stages.contains(name)) << name;
            const NpyArray array = read_npy(golden_cvvdp() / file.get<std::string>());
            EXPECT_LE(deviation(stages.at(name), array.values), stage_tolerance(name))
                << golden.entry["name"] << " " << name;
            ++compared;
        }
    }
    EXPECT_GT(compared, 10u);
}

TEST(GoldenCvvdp, HasTheTemporalFiltersOfTheOriginal) {
    const nlohmann::json golden = read_json(golden_cvvdp() / "temporal_filters.json");
    for (const auto& [rate, channels] : golden["frames_per_second"].items()) {
        const auto filters = temporal_filters(std::stod(rate), cvvdp_0_5_6_calibration());
        for (unsigned c = 0; c < cvvdp_channels; ++c) {
            ASSERT_EQ(filters[c].size(), channels[c].size()) << rate;
            for (size_t j = 0; j < filters[c].size(); ++j)  // two roundings of 0.5 to float32, ours and its
                EXPECT_NEAR(filters[c][j], channels[c][j].get<double>(), 1.2e-7) << rate << " " << c << " " << j;
        }
    }
}

TEST(GoldenCvvdp, SensitivitiesAreThoseOfTheOriginal) {
    const std::filesystem::path file = golden_cvvdp() / "csf.json";
    if (!exists(file)) GTEST_SKIP() << "the table is not in the repository";
    const nlohmann::json table = read_json(file)["log10_sensitivity"];
    const char* names[] = {"sustained_luminance", "sustained_red_green", "sustained_yellow_violet",
                           "transient_luminance"};
    for (unsigned c = 0; c < cvvdp_channels; ++c)
        for (unsigned background = 0; background < sensitivity_nodes; ++background)
            for (unsigned f = 0; f < sensitivity_nodes; ++f)
                ASSERT_EQ(sensitivity_table()[c][background][f], table[names[c]][background][f].get<float>());
}
