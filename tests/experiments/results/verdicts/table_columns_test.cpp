#include "experiments/study/table_columns.h"

#include "core/files.h"
#include "experiments/study/config/config_parts.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace fs = std::filesystem;

namespace {

const fs::path source = SSRLAB_SOURCE_DIR;

std::string mistake_in(const std::string& table) {
    const fs::path file = fs::temp_directory_path() / "table_columns.json";
    write_text(
        file,
        R"({"shots": [{"scene": "fence"}], "techniques": [{"technique": "mcguire_dda"}], "hits": {}, "costs": true, "gpu_compilers": ["navi21"],
 "tables": [{"name": "a", "caption": "", )" +
            table + "}]}");
    const std::string message = error_message([&] { check_table_columns(read_config(file)); });
    return message.starts_with(file.string()) ? message.substr(file.string().size()) : message;
}

}  // namespace

/// `ssrlab plan` and `run` check a config by this, before any work: else `ssrlab tables` would stumble after it.
TEST(TableColumns, AreThoseOfTheFilesOrParameters) {
    EXPECT_EQ(mistake_in(R"("of": "results", "rows": ["tecnique", "point"], "columns": "shot")"),
              ":2:59: tables[0]: 'rows': 'tecnique' is neither a column of these rows nor a parameter; did you mean "
              "'technique'?");
    const std::string rest = R"(, "rows": ["technique", "dda.stride"], "columns": "metric")";
    EXPECT_NE(mistake_in(R"("of": "results")" + rest + R"(, "over": "shoot")").find("did you mean 'shot'?"),
              std::string::npos);
    EXPECT_NE(mistake_in(R"("of": "results", "where": {"dda.strid": 1})" + rest).find("did you mean 'dda.stride'?"),
              std::string::npos);
    EXPECT_NE(
        mistake_in(R"("of": "results", "where": {"metric": ["mse", "filp"]})" + rest).find("did you mean 'flip'?"),
        std::string::npos);
    EXPECT_NE(mistake_in(R"("of": "results", "sort": "msee")" + rest).find("did you mean 'mse'?"), std::string::npos);
    EXPECT_NE(mistake_in(R"("of": "times")" + rest).find("'metric' is neither"), std::string::npos);
    EXPECT_EQ(mistake_in(R"("of": "estimates", "rows": ["stage", "bound"], "columns": ["chip", "quantity"])"),
              "no error");
    EXPECT_EQ(mistake_in(R"("of": "results", "where": {"mask": "!all", "dda.stride": [1, 2]}, "over": "shot")" + rest),
              "no error");
}

TEST(TableColumns, AreKnownOfAllThatTablesAreOf) {
    const Keys keys = table_keys();
    const auto& sources = std::ranges::find(keys, "of", &Key::name)->values.schema.at("enum");
    EXPECT_GT(sources.size(), 10u);
    for (const std::string source_name : sources) {
        const std::string mistake =
            mistake_in(R"("columns": "shot", "rows": "no column", "of": ")" + source_name + "\"");
        EXPECT_NE(mistake.find("neither a column"), std::string::npos) << source_name << ": " << mistake;
    }
}

TEST(TableColumns, AreRightInAllConfigs) {
    size_t count = 0;
    for (const auto& entry : fs::directory_iterator(source / "experiments/studies/configs")) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "paper_figures") continue;
        const Config config = read_config(entry.path());
        EXPECT_NO_THROW(check_table_columns(config)) << entry.path();
        count += config.source.contains("tables");
    }
    EXPECT_GT(count, 20u);
}
