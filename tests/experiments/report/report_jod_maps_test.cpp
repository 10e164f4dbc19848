#include "core/exr/exr.h"
#include "core/json.h"
#include "experiments/report/image_encoding.h"
#include "experiments/report/report_images.h"
#include "metrics/cvvdp/cvvdp.h"
#include "metrics/cvvdp_metric.h"
#include "tests/experiments/report/report_fixture.h"

#include <gtest/gtest.h>
#include <algorithm>

using nlohmann::json;

TEST(ReportJodMaps, AreMadeWhereTheStudyMeasuresThem) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "report_jod_maps";
    write_report_fixture(folder);
    auto manifest = read_json(folder / "manifest.json");
    const auto maps_of = [](const ReportImages& images) {
        std::vector<size_t> places;
        for (size_t i = 0; i < images.descriptions.size(); ++i)
            if (images.descriptions[i]["kind"] == "jod") places.push_back(i);
        return places;
    };
    const auto exr_of = [&](const std::string& shot, const std::string& technique, const std::string& point) {
        for (const json& image : manifest["images"])
            if (image["shot"] == shot && image["technique"] == technique && image.value("point", "") == point &&
                image.value("target", "") == "image" && image.value("seed", 0) == 0)
                return folder / image["exr"].get<std::string>();
        return std::filesystem::path();
    };
    const ReportImages all = embedded_images(folder, manifest);
    ASSERT_EQ(maps_of(all).size(), 9u);
    for (const size_t i : maps_of(all)) {
        const json& map = all.descriptions[i];
        const std::string shot = map["shot"];
        const HostImage reference = read_exr_rgb(exr_of(shot, "reference", "")),
                        result = read_exr_rgb(exr_of(shot, map["technique"], map["point"]));
        float exposure_ev = 0;
        for (const json& entry : manifest["shots"])
            if (entry["shot"] == shot) exposure_ev = entry["exposure_ev"];
        const Plane expected = CvvdpStills(reference.extent, exposed_viewing({.exposure_ev = exposure_ev}))
                                   .score(reference, result, true)
                                   .map;
        EXPECT_GT(std::ranges::max(expected.values), 0.1) << "so that there is something to see";
        HostImage grey(reference.extent, 3);
        for (size_t pixel = 0; pixel < expected.values.size(); ++pixel)
            for (size_t c = 0; c < 3; ++c) grey.values[3 * pixel + c] = float(expected.values[pixel]);
        size_t clamped = 0;
        EXPECT_EQ(all.data[i], base64(encode_halves(grey, clamped))) << shot << ' ' << map["point"];
    }
    // Beside the page they are made again when their reference is another, or the exposure.
    const ReportImages linked = report_images(folder, manifest, 0);
    const auto file = [&](size_t i) { return folder / linked.descriptions[i]["file"].get<std::string>(); };
    const auto changed_by = [&](const auto& change) {
        const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
        for (const size_t i : maps_of(linked)) std::filesystem::last_write_time(file(i), old);
        change();
        report_images(folder, manifest, 0);
        return std::ranges::count_if(maps_of(linked),
                                     [&](size_t i) { return std::filesystem::last_write_time(file(i)) != old; });
    };
    EXPECT_EQ(changed_by([] {}), 0);
    const std::string shot = manifest["shots"][0]["shot"];
    EXPECT_EQ(changed_by([&] {
                  std::filesystem::last_write_time(exr_of(shot, "reference", ""), std::chrono::file_clock::now());
              }),
              3);
    EXPECT_EQ(changed_by([&] { manifest["shots"][0]["exposure_ev"] = 3.0; }), 3);
    manifest["metrics"].erase("cvvdp_0_5_6");
    EXPECT_EQ(maps_of(report_images(folder, manifest, 0)).size(), 0u);
    std::filesystem::remove_all(folder);
}
