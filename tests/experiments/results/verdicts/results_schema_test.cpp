// What a results folder says of its own columns.
#include "experiments/results/results_schema.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/results/files/columns.h"
#include "experiments/study/measuring/rays/judged_hits.h"
#include "experiments/study/parameters_table.h"

#include <gtest/gtest.h>
#include <map>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

PointConfig point(const std::string& technique, const std::string& name, const json& parameters) {
    return {.technique = technique,
            .preset = "",
            .parameters = parameters,
            .swept = parameters,
            .point = name,
            .seeds = {0},
            .against = {},
            .against_point = {}};
}

}  // namespace

TEST(ResultsSchema, SaysTypesAndUnits) {
    const fs::path folder = fs::temp_directory_path() / "schema";
    write_parameters(folder, {point("mcguire_dda", "default", json::object())});
    const json schema = read_json(folder / "schema.json");
    fs::remove_all(folder);
    std::map<std::string, json> fields;
    for (const json& file : schema["resources"])
        for (const json& field : file["schema"]["fields"])
            fields[file["name"].get<std::string>() + " " + field["name"].get<std::string>()] = field;
    EXPECT_EQ(fields.at("results frame")["type"], "integer");
    EXPECT_EQ(fields.at("summary value")["type"], "number");
    EXPECT_EQ(fields.at("summary ranked")["type"], "boolean");
    EXPECT_EQ(fields.at("times milliseconds")["unit"], "ms");
    EXPECT_EQ(fields.at("times frame")["description"],
              "Number of the timed frame after the warm-up; gaps where frames were left out");
    for (size_t i = 0; i < ray_verdict_count; ++i)
        EXPECT_EQ(fields.at("hits quantity")["values"][i]["name"], ray_verdict_names()[i]);
    EXPECT_EQ(fields.at("costs quantity")["values"][0]["name"], "invocations");
    EXPECT_EQ(fields.at("parameters dda.stride")["type"], "integer");
    EXPECT_EQ(fields.at("parameters dda.thickness")["type"], "number");
    EXPECT_EQ(fields.at("parameters tracer")["type"], "string");
}

TEST(ResultsSchema, ParametersAreColumns) {
    const fs::path folder = fs::temp_directory_path() / "parameters";
    PointConfig labelled = point("mcguire_dda", "dda.stride=4", {{"dda.stride", 4}, {"dda.refine", true}});
    labelled.label = "DDA, 4 px", labelled.group = "marches";
    write_parameters(folder, {point("none", "default", json::object()), labelled});
    CsvReader csv(folder / "parameters.csv");
    ASSERT_TRUE(csv.next());
    EXPECT_EQ(csv.text("technique"), "none");
    EXPECT_EQ(csv.text("dda.stride"), "");
    ASSERT_TRUE(csv.next());
    EXPECT_EQ(csv.text("point"), "dda.stride=4");
    EXPECT_EQ(csv.text("label"), "DDA, 4 px");
    EXPECT_EQ(csv.text("group"), "marches");
    EXPECT_EQ(csv.text("dda.stride"), "4");
    EXPECT_EQ(csv.text("dda.refine"), "1");
    EXPECT_EQ(csv.text("tracer"), "dda");
    EXPECT_FALSE(csv.next());
    EXPECT_TRUE(fs::exists(folder / "schema.json"));
    fs::remove_all(folder);
}
