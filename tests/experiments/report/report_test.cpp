#include "experiments/report/report.h"

#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/report/image_encoding.h"
#include "experiments/report/report_images.h"
#include "experiments/report/report_warnings.h"
#include "experiments/results/files/csv.h"
#include "experiments/results/verdicts/interval.h"
#include "experiments/results/verdicts/summary.h"
#include "tests/error_message.h"
#include "tests/experiments/report/report_fixture.h"

#include <gtest/gtest.h>
#include <half.h>
#include <unistd.h>
#include <zlib.h>
#include <array>
#include <cmath>
#include <random>

namespace {

using nlohmann::json;

/// The made-up folder, for each test anew.
struct Report : testing::Test {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / "report_test";
    void SetUp() override { write_report_fixture(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string message() const {
        try {
            write_report(folder);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }
};

std::vector<ResultRow> seed_rows(std::vector<double> values, std::optional<double> half_width,
                                 std::optional<double> floor) {
    std::vector<ResultRow> rows;
    for (const double v : values) {
        ResultRow row{.shot = "s",
                      .technique = "v",
                      .point = "p",
                      .seed = unsigned(rows.size()),
                      .target = "specular",
                      .metric = "mse",
                      .mask = "all",
                      .value = v,
                      .floor = floor};
        if (half_width) row.low = v - *half_width, row.high = v + *half_width;
        rows.push_back(row);
    }
    return rows;
}

std::vector<unsigned char> inflated(const std::vector<unsigned char>& packed, size_t expected) {
    std::vector<unsigned char> bytes(expected);
    uLongf size = expected;
    EXPECT_EQ(uncompress(bytes.data(), &size, packed.data(), packed.size()), Z_OK);
    EXPECT_EQ(size, expected);
    return bytes;
}

bool contains(const std::vector<std::string>& texts, const std::string& part) {
    return std::ranges::any_of(texts, [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

}  // namespace

TEST(Csv, ReadsQuotedFieldsAndNamesLineAndColumnOfMistakes) {
    const auto file = std::filesystem::temp_directory_path() / "csv_test.csv";
    write_text(file, "name,value\r\n\"a \"\"b\"\",\nc\",0.25\nd,\n");
    CsvReader csv(file);
    ASSERT_TRUE(csv.next());
    EXPECT_EQ(csv.text("name"), "a \"b\",\nc");
    EXPECT_EQ(csv.number("value"), 0.25);
    ASSERT_TRUE(csv.next());
    EXPECT_FALSE(csv.optional_number("value"));
    EXPECT_FALSE(csv.next());
    const auto mistake = [&](const std::string& content, const char* column) -> std::string {
        write_text(file, content);
        try {
            for (CsvReader bad(file); bad.next();) bad.number(column);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_NE(mistake("value\n1\nx2\n", "value").find("csv_test.csv:3: 'value' = \"x2\""), std::string::npos);
    EXPECT_NE(mistake("value\n1e999\n", "value").find(":2:"), std::string::npos);
    EXPECT_NE(mistake("value\n1,2\n", "value").find(":2: 2 fields"), std::string::npos);
    EXPECT_NE(mistake("value\n1\n", "valeu").find("did you mean 'value'"), std::string::npos);
    EXPECT_NE(mistake("value\n\"1\n", "value").find("not closed"), std::string::npos);
    EXPECT_NE(mistake("", "value").find("is empty"), std::string::npos);
    std::filesystem::remove(file);
}

TEST(Summary, JoinsTheSpreadOfSeedsWithTheNoiseOfTheReference) {
    const auto s = summarise(seed_rows({5, 6, 7}, 0.5, 0.1)).at(0);
    EXPECT_EQ(s.seeds, 3u);
    EXPECT_DOUBLE_EQ(*s.value, 6.0);
    EXPECT_DOUBLE_EQ(*s.seed_deviation, 1.0);
    // With two degrees of freedom Student's t has the closed form (2p - 1) sqrt(2 / (4p (1 - p))); it joins 0.5 of the
    // reference.
    const double t = 0.95 * std::sqrt(2.0 / (4.0 * 0.975 * 0.025));
    EXPECT_NEAR(*s.high - 6.0, std::hypot(t / std::sqrt(3.0), 0.5), 1e-9);
    EXPECT_NEAR(6.0 - *s.low, *s.high - 6.0, 1e-12);
    EXPECT_FALSE(summarise(seed_rows({2}, 0.5, 0.1)).at(0).seed_deviation);
}

TEST(Summary, GivesNoMeanWhereASeedHasNoValue) {
    auto rows = seed_rows({1, 2}, 0.5, 0.1);
    rows[1].value.reset();
    EXPECT_FALSE(summarise(rows).at(0).value);
    EXPECT_EQ(summarise(rows).at(0).interval, interval::no_value);
}

TEST(Summary, AddsUpAStageThatRunsTwiceInAFrame) {
    std::vector<TimeRow> rows;
    for (unsigned frame = 0; frame < 3; ++frame)
        for (const double ms : {1.0, 2.0}) rows.push_back({"s", "v", "p", 0, "mips", frame, ms + frame, "host_fence"});
    const auto t = summarise(rows).at(0);
    EXPECT_EQ(t.frames, 3u);
    EXPECT_EQ(t.median, 5.0);
    EXPECT_EQ(t.low, 3.0);
    EXPECT_EQ(t.high, 7.0);
}

TEST(ReportImages, HalvesComeBackBitByBit) {
    constexpr unsigned width = 5, pixels = 15;
    HostImage image({width, pixels / width}, 3);
    std::mt19937 random(3);
    for (float& v : image.values) v = std::generate_canonical<float, 24>(random) * 10.0f - 1.0f;
    image.values[0] = NAN, image.values[4] = INFINITY, image.values[9] = 1e6f, image.values[12] = 1e-7f;
    image.values[13] = -0.0f, image.values[14] = -65504.0f, image.values[17] = 65504.0f;
    size_t clamped = 0;
    const std::vector<unsigned char> bytes = inflated(encode_halves(image, clamped), 6 * pixels);
    EXPECT_EQ(clamped, 1u);
    std::array<std::array<int16_t, pixels>, 3> planes{};
    for (size_t p = 0; p < 3; ++p)
        for (size_t i = 0; i < pixels; ++i) {
            const size_t x = i % width, at = p * pixels + i;
            const int w = x ? planes[p][i - 1] : 0, n = i >= width ? planes[p][i - width] : 0,
                      nw = x && i >= width ? planes[p][i - width - 1] : 0;
            const int inner = nw >= std::max(w, n)   ? std::min(w, n)
                              : nw <= std::min(w, n) ? std::max(w, n)
                                                     : w + n - nw;
            const int code = bytes[at] | bytes[3 * pixels + at] << 8;
            planes[p][i] = int16_t((x && i >= width ? inner : x ? w : n) + (code & 1 ? -1 - code / 2 : code / 2));
        }
    for (size_t i = 0; i < pixels; ++i)
        for (const auto& [c, ordered] : {std::pair<size_t, int>(1, planes[0][i]),
                                         {0, planes[0][i] + planes[1][i]},
                                         {2, planes[0][i] + planes[2][i]}}) {
            const int16_t whole = int16_t(ordered);
            const float value = image.values[i * 3 + c];
            const uint16_t expected = half(value == 1e6f ? 65504.0f : value).bits();
            EXPECT_EQ(uint16_t(whole < 0 ? 0x7fff - whole : whole), expected) << i << ' ' << c;
        }
    EXPECT_EQ(base64({'M'}), "TQ==");  // RFC 4648, section 10 has the like
    EXPECT_EQ(base64({'f', 'o', 'o', 'b', 'a'}), "Zm9vYmE=");
    EXPECT_EQ(base64({'f', 'o', 'o', 'b', 'a', 'r'}), "Zm9vYmFy");
}

TEST(ReportImages, KeepsWhatNeedsNoHalvesInBytes) {
    HostImage shares({6, 1}, 1);
    shares.values = {0.0f, 1.0f, 0.5f, NAN, -3.0f, 1.2f};
    EXPECT_EQ(inflated(encode_bytes(shares), 6), (std::vector<unsigned char>{0, 254, 127, 255, 0, 254}));
    const auto linear = [](int code) { return float(half(std::pow(float(code) / 255.0f, 2.2f))); };
    HostImage verdicts({3, 1}, 3);
    verdicts.set_rgb(0, {linear(204), linear(121), linear(167)});
    verdicts.set_rgb(2, verdicts.rgb(0));
    nlohmann::json palette;
    EXPECT_EQ(inflated(encode_palette(verdicts, palette), 3), (std::vector<unsigned char>{0, 1, 0}));
    EXPECT_EQ(palette, nlohmann::json::parse("[[204, 121, 167], [0, 0, 0]]"));
}

TEST_F(Report, PutsImagesBesideThePageThatAreTooManyForIt) {
    const auto manifest = read_json(folder / "manifest.json");
    const ReportImages all = report_images(folder, manifest, 100'000'000);
    // Targets x shots x (reference and three points), of the first seed only; then two rungs, roughness, confidence of
    // each point, two maps of verdicts, and a map of visible differences of each shot's three points.
    const size_t images = 2u * 3u * 4u + 2u + 1u + 3u + 2u + 9u;
    EXPECT_EQ(all.data.size(), images);
    EXPECT_EQ(all.descriptions.size(), images);
    EXPECT_TRUE(all.notes.empty());
    size_t text = 0;
    for (const std::string& data : all.data) text += data.size();
    EXPECT_EQ(report_images(folder, manifest, text).data.size(), 0u) << "descriptions count, too";
    EXPECT_TRUE(std::filesystem::exists(folder / report_image_folder));
    const ReportImages linked = report_images(folder, manifest, text / 2);
    ASSERT_EQ(linked.descriptions.size(), images);
    for (size_t i = 0; i < images; ++i) {
        const std::string file = linked.descriptions[i].value("file", "");
        EXPECT_TRUE(read_text(folder / file).ends_with("\nregisterImage(\"" + file + "\",\"" + all.data[i] + "\");\n"));
        EXPECT_EQ(linked.descriptions[i]["width"], all.descriptions[i]["width"]) << "nothing is reduced";
    }
    // A script is made again where its image, or what an image is encoded as, is another.
    const auto file = [&](size_t i) { return folder / linked.descriptions[i]["file"].get<std::string>(); };
    const auto time_of = [&](size_t i) { return std::filesystem::last_write_time(file(i)); };
    const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    for (size_t i = 0; i < images; ++i) std::filesystem::last_write_time(file(i), old);
    const auto exr = std::filesystem::relative(file(1), folder / report_image_folder).replace_extension(".exr");
    std::filesystem::last_write_time(folder / exr, old);
    write_text(file(2), "registerImage(\"another\",\"\");\n");
    const ReportImages again = report_images(folder, manifest, 0);
    EXPECT_EQ(again.descriptions, linked.descriptions);
    EXPECT_EQ(again.notes, linked.notes);
    EXPECT_EQ(time_of(0), old) << "kept";
    EXPECT_NE(time_of(1), old) << "its image was written since";
    EXPECT_TRUE(read_text(file(2)).ends_with("\",\"" + all.data[2] + "\");\n"));
    write_text(folder / report_image_folder / "mine.txt", "");
    EXPECT_EQ(report_images(folder, manifest, 100'000'000).data.size(), images);
    size_t left = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder / report_image_folder))
        left += file.path().filename() == "mine.txt" ? 1 : 100;
    EXPECT_EQ(left, 1u) << "scripts of an earlier report go, other files stay";
}

TEST_F(Report, ReachesNothingOutsideItsFolder) {
    const std::filesystem::path outside = folder.string() + "_outside";
    write_text(outside / "a.js", "the user's own");
    auto manifest = read_json(folder / "manifest.json");
    std::filesystem::copy(folder / manifest["images"][0]["exr"].get<std::string>(), outside / "a.exr");
    const auto refused = [&](const std::string& exr) {
        manifest["images"][0]["exr"] = exr;
        const std::string said = error_message([&] { report_images(folder, manifest, 0); });
        EXPECT_NE(said.find("manifest.json: images: 'exr': "), std::string::npos) << exr << ": " << said;
    };
    std::filesystem::create_directory_symlink(outside, folder / "images/x");
    for (const std::string& exr :
         {"../" + outside.filename().string() + "/a.exr", "images/../../" + outside.filename().string() + "/a.exr",
          (outside / "a.exr").string(), std::string("images/x/a.exr")})
        refused(exr);
    manifest = read_json(folder / "manifest.json");
    std::filesystem::remove_all(folder / report_image_folder);
    std::filesystem::create_directory_symlink(outside, folder / report_image_folder);
    for (const size_t budget : {size_t(0), size_t(100'000'000)})
        EXPECT_NE(error_message([&] { report_images(folder, manifest, budget); }).find("is a symbolic link"),
                  std::string::npos);
    EXPECT_EQ(read_text(outside / "a.js"), "the user's own");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(outside), {}), 2);
    std::filesystem::remove(folder / report_image_folder);
    std::filesystem::remove(folder / "summary.csv");
    std::filesystem::create_symlink(outside / "a.js", folder / "summary.csv");
    EXPECT_NE(message().find("summary.csv is a symbolic link"), std::string::npos);
    std::filesystem::remove_all(outside);
}

TEST_F(Report, ShowsTheFirstSeedOfEachFrame) {
    auto manifest = read_json(folder / "manifest.json");
    const size_t before = report_images(folder, manifest, 100'000'000).descriptions.size();
    for (const json& image : json(manifest["images"])) {
        manifest["images"].push_back(image);
        manifest["images"].back()["frame"] = 4;
        manifest["images"].back()["seed"] = image.value("seed", 0) + 3;
    }
    const ReportImages of_two = report_images(folder, manifest, 100'000'000);
    EXPECT_EQ(of_two.descriptions.size(), 2 * before);
    for (const json& image : of_two.descriptions) EXPECT_EQ(image["seed"], image["frame"] == 4 ? 3 : 0);
}

TEST_F(Report, WarnsOfAllThatSpoilsNumbers) {
    const auto errors = summarise(read_rows<ResultRow>(folder / "results.csv"));
    const auto times = summarise(read_rows<TimeRow>(folder / "times.csv"));
    auto manifest = read_json(folder / "manifest.json");
    const auto warnings = report_warnings(manifest, errors, times);
    EXPECT_TRUE(contains(warnings, "This study: a clause that the study has to say."));
    EXPECT_TRUE(contains(warnings, "Timer validation failed"));
    EXPECT_TRUE(contains(
        warnings,
        "roughness_gradient.side.161x91: only 62 % of the reference's pixels reached the relative error of 3 %"));
    EXPECT_TRUE(contains(warnings, "fence.low.160x90, mcguire_dda (stride=4), specular: 1 pixel is NaN"));
    EXPECT_EQ(warnings.size(), 5u);  // and the like for target `image`
    std::vector<MetricSummary> many(40, errors.front());
    for (size_t i = 0; i < many.size(); ++i) many[i].point = std::to_string(i), many[i].negative = 2;
    const auto counted = report_warnings(manifest, many, times);
    EXPECT_TRUE(contains(counted, "28 more warnings about pixels"));
    EXPECT_EQ(counted.size(), warnings.size() - 2 + 12 + 1);
    manifest["shots"][0]["warnings"] = {"a texture is missing"};
    manifest["is_complete"] = false;
    EXPECT_TRUE(
        contains(report_warnings(manifest, errors, times), "mirror_pillars.front.160x90: a texture is missing."));
    EXPECT_TRUE(contains(report_warnings(manifest, errors, times), "not finished"));
    EXPECT_TRUE(contains(report_warnings(nlohmann::json::object(), errors, times), "No timer was validated"));
    manifest["clock"]["proofs"][0]["verdict"] = "not_judged";
    EXPECT_TRUE(contains(report_warnings(manifest, errors, times), "The timer was not validated"));
}

TEST_F(Report, WarnsOfDisturbedTimesAndOfSeveralMakers) {
    const auto errors = summarise(read_rows<ResultRow>(folder / "results.csv"));
    auto rows = read_rows<TimeRow>(folder / "times.csv");
    auto manifest = read_json(folder / "manifest.json");
    const auto now = [&] { return report_warnings(manifest, errors, summarise(rows)); };
    const size_t before = now().size();
    for (TimeRow& row : rows) row.disturbed = row.shot == fixture_shots[1] && row.frame < 3;
    EXPECT_TRUE(contains(now(), "fence.low.160x90: other programs disturbed 20 % of the timed frames"));
    EXPECT_EQ(now().size(), before + 1);

    manifest["provenance"].push_back(manifest["provenance"][0]);
    EXPECT_EQ(now().size(), before + 1) << "the same maker";
    manifest["provenance"][1]["host"]["cores"] = 64;
    EXPECT_TRUE(contains(now(), "Parts of this study were made by different hosts:"));
    EXPECT_TRUE(contains(now(), "says which. Compare times within one shot only."));
    nlohmann::json& load = manifest["clock"]["load"];
    const nlohmann::json node = {{"name", "node1"}, {"cpu", "a CPU"}};
    load = {{{"shot", "one"}, {"host", node}}, {{"shot", "two"}, {"host", node}}, {{"shot", "three"}, {"host", node}}};
    EXPECT_TRUE(contains(now(), "All times were measured on one machine"));
    load[1]["host"]["name"] = "node2";
    EXPECT_TRUE(
        contains(now(), "Compare times within one shot only: one, three on node1 (a CPU); two on node2 (a CPU)."));
    EXPECT_TRUE(contains(now(), "`provenance` in manifest.json says which."));
    manifest["provenance"][1]["ssrlab"]["commit"] = "another";
    EXPECT_TRUE(contains(now(), "Parts of this study were made by different hosts, versions of ssrlab:"));
    EXPECT_FALSE(contains(now(), "differ from the commit"));
    manifest["provenance"][1]["ssrlab"]["dirty"] = true;
    EXPECT_TRUE(contains(now(), "differ from the commit"));
}

TEST_F(Report, WarnsOfLightThatIsTooNoisy) {
    auto errors = summarise(read_rows<ResultRow>(folder / "results.csv"));
    const auto manifest = read_json(folder / "manifest.json");
    const size_t before = report_warnings(manifest, errors, {}).size();
    for (MetricSummary& e : errors) e.lit_noise = 0.09 * std::abs(*e.value);
    EXPECT_EQ(report_warnings(manifest, errors, {}).size(), before);
    for (MetricSummary& e : errors)
        if (e.shot == fixture_shots[0] && e.mask == "reflective") e.lit_noise = 0.23 * std::abs(*e.value);
    const auto warnings = report_warnings(manifest, errors, {});
    EXPECT_EQ(warnings.size(), before + 1) << "one of each shot";
    EXPECT_TRUE(contains(warnings, fixture_shots[0] + ": the noise of the path-traced light"));
    EXPECT_TRUE(contains(warnings, "23 % of an error"));
}

TEST_F(Report, IsOneSmallFileThatNeedsNothingElse) {
    write_report(folder);
    const std::string page = read_text(folder / "report.html");
    EXPECT_LT(page.size(), 30'000'000u);
    EXPECT_FALSE(std::filesystem::exists(folder / report_image_folder));
    const std::string names = "http://www.w3.org/";  // of XML's vocabularies: nothing is fetched from there
    for (size_t at = 0; (at = page.find("http://", at)) != std::string::npos; ++at)
        EXPECT_EQ(page.substr(at, names.size()), names);
    EXPECT_EQ(page.find("https://"), std::string::npos);
    EXPECT_EQ(page.find("{{"), std::string::npos);
    EXPECT_NE(page.find("Linear tracing &lt;/script&gt; against the truth"), std::string::npos);
    EXPECT_EQ(page.find("tracing </script>"), std::string::npos);
}

TEST_F(Report, DoesWithoutTimesAndWithOneShot) {
    write_rows(folder / "time_summary.csv", std::vector<TimeSummary>());
    auto manifest = read_json(folder / "manifest.json");
    for (const char* key : {"clock", "provenance", "shots", "images", "techniques"}) manifest.erase(key);
    write_text(folder / "manifest.json", manifest.dump());
    EXPECT_EQ(message(), "");
}

TEST_F(Report, NamesTheFileThatIsMissingOrBroken) {
    const std::string summary = read_text(folder / "summary.csv"), manifest = read_text(folder / "manifest.json");
    const auto after = [&](const char* file, const std::string& content) {
        write_text(folder / file, content);
        return message();
    };
    EXPECT_NE(after("summary.csv", summary + "s,").find("summary.csv:"), std::string::npos);
    std::string older = summary;
    older.replace(older.find("standing"), 8, "position");
    const std::string of_older = after("summary.csv", older);
    EXPECT_NE(of_older.find("summary.csv has no column 'standing'; "), std::string::npos) << of_older;
    EXPECT_NE(of_older.find("Run `ssrlab run`"), std::string::npos) << of_older;
    write_text(folder / "summary.csv", summary);
    EXPECT_NE(after("manifest.json", "[1, 2]").find("manifest.json must be an object"), std::string::npos);
    EXPECT_NE(after("manifest.json", manifest.substr(0, 100)).find("manifest.json:"), std::string::npos);
    EXPECT_NE(after("manifest.json", R"({"images": [{"shot": 1}]})").find("images[0]: shot must be a text"),
              std::string::npos);
    EXPECT_NE(after("manifest.json", R"({"images": 3})").find("images must be an array"), std::string::npos);
    write_text(folder / "manifest.json", manifest);
    const auto image = folder / "images" / fixture_shots[0] / "reference_image.exr";
    std::filesystem::resize_file(image, 500);
    EXPECT_NE(message().find("reference_image.exr"), std::string::npos);
    std::filesystem::remove(image);
    EXPECT_NE(message().find("reference_image.exr: no such file"), std::string::npos);
    std::filesystem::remove(folder / "summary.csv");
    EXPECT_NE(message().find("summary.csv is missing"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}
