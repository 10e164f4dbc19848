#include "core/exr/exr.h"
#include "core/json.h"
#include "core/png.h"
#include "metrics/metric.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

// The numbers that the manifest records for every pair: pixel metrics and SSIM by independent programs, FLIP by the
// authors' own. FLIP entries carry the program's exposures, which are handed in.

namespace {

std::filesystem::path folder() {
    const char* vectors = std::getenv("SSRLAB_VECTORS");
    return std::filesystem::path(vectors ? vectors : SSRLAB_SOURCE_DIR "/tests/data/vectors") / "metrics";
}

nlohmann::json manifest() { return read_json(folder() / "manifest.json"); }

/// The name of our metric for each recorded number, and how near it must come: |ours - theirs| <= relative |theirs| +
/// absolute.
struct Recorded {
    const char* metric;
    double relative, absolute;
};

/// Pixel metrics of float32 radiance are exact but for the order of summation. Codes n / 255 are rounded to float32, by
/// up to 3e-8 each, so a difference of two by 6e-8: 1.5e-5 of one code step and twice that of its square, and as much
/// in dB as 10 log10(1 + 3e-5) = 1.3e-4. Numbers near 0 may be off by what relative errors make of 6e-8: at most
/// (6e-8)^2 / 1e-4.
const std::map<std::string, Recorded> recorded_on_radiance = {
    {"mse", {"mse", 1e-9, 0}},
    {"mae", {"mae", 1e-9, 0}},
    {"relmse_eps1e-2_sqref", {"relmse", 1e-9, 0}},
    {"smape_1", {"smape", 1e-9, 0}},
    {"relmse_eps1e-2_trim_top0.1pct", {"relmse_trimmed", 1e-9, 0}},
};

std::map<std::string, Recorded> recorded_on_codes() {
    std::map<std::string, Recorded> all = recorded_on_radiance;
    for (auto& [key, recorded] : all) recorded.relative = 3e-5;
    all["psnr"] = {"psnr", 0, 1.3e-4};
    // SSIM of the codes' float32 roundings; the double-precision sums themselves agree to 1e-9.
    all["ssim_skimage"] = all["ssim_valid_numpy"] = {"ssim", 0, 1e-6};
    return all;
}

double number(const nlohmann::json& value) {
    return value.is_string() && value == "inf" ? INFINITY : value.get<double>();
}

void expect_recorded(const nlohmann::json& numbers, const std::map<std::string, Recorded>& known,
                     const ImagePair& pair) {
    EXPECT_EQ(numbers.at("trim_k").get<size_t>(), pair.finite.count() / 1000)
        << "relmse_trimmed drops another number of pixels";
    const bool has_windows = std::min(pair.test.extent.x, pair.test.extent.y) >= 11;
    for (const auto& [key, recorded] : known) {
        if (key.starts_with("ssim") && !has_windows) continue;
        const double ours = measure(metric_named(recorded.metric), pair), theirs = number(numbers.at(key));
        if (std::isinf(theirs))
            EXPECT_EQ(ours, theirs) << key;
        else
            EXPECT_NEAR(ours, theirs, recorded.relative * std::abs(theirs) + recorded.absolute) << key;
    }
}

/// Both maps are float32 chains of some hundred operations. The tool and an independent float64 version differ by up
/// to 1.1e-4 per pixel and 9e-6 in the mean (4e-4 over more than 20 exposures, where features of nearly 0 pass through
/// a square root).
void expect_flip(const Plane& map, const nlohmann::json& entry, const std::string& where) {
    double mean = 0, greatest = 0;
    for (const double v : map.values) mean += v / double(map.values.size()), greatest = std::max(greatest, v);
    const double pixel_tolerance = entry.value("num", 1) > 20 ? 4e-4 : 2e-4;
    size_t compared = 0;
    for (const char* version : {"1.6", "1.7"}) {
        const std::string prefix = std::string("flip_v") + version + "_cpp_";
        if (!entry.contains(prefix + "mean")) continue;
        ++compared;
        EXPECT_NEAR(mean, entry[prefix + "mean"].get<double>(), 2e-5) << where;
        EXPECT_NEAR(greatest, entry[prefix + "max"].get<double>(), pixel_tolerance) << where;
    }
    EXPECT_EQ(compared, 1u) << where << ": no recorded FLIP mean";
    if (entry.contains("flip_float64_numpy_mean")) {
        EXPECT_NEAR(mean, entry["flip_float64_numpy_mean"].get<double>(), 2e-5) << where;
    }
    if (entry.contains("float64_numpy")) {
        EXPECT_NEAR(mean, entry["float64_numpy"]["mean"].get<double>(), 2e-5) << where;
    }
    if (!entry.contains("flip_map")) return;
    const HostImage expected = read_exr_rgb(folder() / entry["flip_map"].get<std::string>());
    ASSERT_EQ(expected.extent, map.extent) << where;
    double worst = 0;
    for (size_t i = 0; i < map.values.size(); ++i)
        worst = std::max(worst, std::abs(map.values[i] - double(expected.rgb(i).x)));
    EXPECT_LE(worst, pixel_tolerance) << where << ": per pixel";
}

HostImage linear_from_codes(HostImage codes) {
    for (float& v : codes.values) v = linear_from_srgb(v);
    return codes;
}

void check_display_pair(const nlohmann::json& entry) {
    const HostImage reference = read_png_codes(folder() / entry["reference"].get<std::string>());
    const HostImage test = read_png_codes(folder() / entry["test"].get<std::string>());
    // Pixel metrics were recorded on the codes themselves, so those stand in for radiance.
    expect_recorded(entry["metrics_on_srgb_codes_over_255"], recorded_on_codes(),
                    image_pair(reference, test, reference, test, {}));
    expect_flip(flip_map(linear_from_codes(reference), linear_from_codes(test), entry["flip_ppd"].get<float>()), entry,
                "LDR-FLIP");
}

void check_radiance_pair(const nlohmann::json& entry) {
    const HostImage reference = read_exr_rgb(folder() / entry["reference"].get<std::string>());
    const HostImage test = read_exr_rgb(folder() / entry["test"].get<std::string>());
    expect_recorded(entry["metrics_on_linear_values"], recorded_on_radiance, image_pair(reference, test, {}));
    ASSERT_FALSE(entry["flip"].empty());
    for (const nlohmann::json& flip : entry["flip"]) {
        const ToneMap map = tone_map_named(flip["tonemapper"]);
        const FlipExposures exposures{flip["start"].get<float>(), flip["stop"].get<float>(),
                                      flip["num"].get<unsigned>()};
        const std::string where = "HDR-FLIP " + name_of(map) + " from " + std::to_string(exposures.start) + " to " +
                                  std::to_string(exposures.stop);
        expect_flip(hdr_flip_map(reference, test, exposures, map, default_pixels_per_degree), flip, where);
        // Version 1.7 replaces a median of 0 by 1e-7, which we refuse to; all ranges of 1.6 must come out.
        if (flip["exposures_given"] || flip.contains("flip_v1.7_cpp_mean")) continue;
        const FlipExposures chosen = flip_exposure_range(reference, map);
        EXPECT_NEAR(chosen.start, exposures.start, 2e-6) << where;  // float32 logarithms
        EXPECT_NEAR(chosen.stop, exposures.stop, 2e-6) << where;
        EXPECT_EQ(chosen.count, exposures.count) << where;
    }
}

std::vector<std::string> pair_names() {
    std::vector<std::string> names;
    const nlohmann::json all = manifest();
    for (const nlohmann::json& entry : all["pairs"]) names.push_back(entry["name"]);
    return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

class MetricPair : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(MetricPair, HasTheRecordedNumbers) {
    const nlohmann::json all = manifest();
    for (const nlohmann::json& entry : all["pairs"]) {
        if (entry["name"] != GetParam()) continue;
        const std::string type = entry["type"];
        ASSERT_TRUE(type == "ldr" || type == "hdr") << "unknown type '" << type << "'";
        type == "ldr" ? check_display_pair(entry) : check_radiance_pair(entry);
    }
}

INSTANTIATE_TEST_SUITE_P(golden_metrics, MetricPair, testing::ValuesIn(pair_names()), test_name);
