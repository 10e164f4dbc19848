#include "core/error.h"
#include "core/json.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace {

std::string message(const auto& action) {
    try {
        action();
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST(Json, SyntaxErrorsNameLineAndColumn) {
    const auto file = std::filesystem::temp_directory_path() / "ssrlab_json_test.json";
    std::ofstream(file) << "{\n  \"a\": 1,\n  \"b\" 2\n}\n";
    EXPECT_NE(message([&] { read_json(file); }).find(file.string() + ":3:7: not valid JSON"), std::string::npos)
        << message([&] { read_json(file); });
    std::filesystem::remove(file);
}

TEST(Json, EveryKeyMustBeKnownAndInRange) {
    const auto json = nlohmann::json::parse(R"({"width": 20, "hieght": 3})");
    JsonObject object(json, "config.json");
    EXPECT_EQ(object.integer("width", 1, 100), 20);
    EXPECT_EQ(object.integer("height", 1, 100, 5), 5);
    EXPECT_EQ(message([&] { object.finish(); }), "config.json: unknown key 'hieght'; did you mean 'height'?");
    EXPECT_EQ(message([&] { object.integer("width", 1, 10); }), "config.json: 'width' = 20 is outside [1, 10]");
}
