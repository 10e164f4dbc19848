// What a results folder says of its own columns.
#include "experiments/results/results_schema.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/results/files/columns.h"
#include "experiments/study/parameters_table.h"

#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

std::map<std::string, std::set<std::string>> columns_of(const json& schema) {
    std::map<std::string, std::set<std::string>> columns;
    for (const json& file : schema["resources"])
        for (const json& field : file["schema"]["fields"]) columns[file["path"]].insert(field["name"]);
    return columns;
}

/// The columns that each file's section of the document explains: what is in backticks in the first cell of the rows of
/// its table of columns.
std::map<std::string, std::set<std::string>> explained_columns() {
    std::map<std::string, std::set<std::string>> columns;
    std::istringstream text(read_text(fs::path(SSRLAB_SOURCE_DIR) / "experiments/RESULTS.md"));
    std::string section;
    bool is_of_columns = false;
    const std::regex name("`([a-z_]+)`");
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("## ")) section = line.substr(3);
        is_of_columns = line.starts_with("| column |") || (is_of_columns && line.starts_with("|"));
        if (!is_of_columns || section.find(".csv") == std::string::npos) continue;
        const std::string cell = line.substr(0, line.find(" | "));
        for (std::sregex_iterator at(cell.begin(), cell.end(), name), end; at != end; ++at)
            columns[section].insert((*at)[1]);
    }
    return columns;
}

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

TEST(ResultsSchema, AgreesWithTheDocument) {
    const auto columns = columns_of(results_schema({})), explained = explained_columns();
    std::set<std::string> before;  // a column is explained where it comes first
    for (const std::string section :
         {"results.csv", "splits.csv", "effects.csv", "times.csv", "time_effects.csv", "hits.csv", "costs.csv",
          "compiled.csv", "parameters.csv", "summary.csv and time_summary.csv"}) {
        ASSERT_TRUE(explained.contains(section)) << section;
        std::set<std::string> own;
        for (const auto& [file, names] : columns)
            if (section.starts_with(file) || section.ends_with(" " + file)) own.insert(names.begin(), names.end());
        EXPECT_FALSE(own.empty()) << section;
        for (const std::string& name : explained.at(section)) {
            EXPECT_TRUE(own.contains(name)) << section << " has no column " << name;
            before.insert(name);
        }
        for (const std::string& name : own)
            EXPECT_TRUE(before.contains(name)) << section << " does not explain " << name;
    }
}

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
    EXPECT_EQ(fields.at("times frame")["description"], "number of the timed frame, after the warm-up");
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
