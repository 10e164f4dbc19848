#include "experiments/results/verdicts/study_results.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/json_types.h"
#include "core/path_inside.h"
#include "experiments/results/cells/estimate_table.h"

#include <fstream>

namespace {

using nlohmann::json;

/// manifest.json as far as commands read it.
const json& manifest_types() {
    static const json types = json::parse(R"({
        "title?": "text", "is_complete?": "true or false", "study?": {"name?": "text", "config?": "text"},
        "primary?": {"metric?": "text", "mask?": "text", "target?": "text", "margin?": "number"},
        "written?": {"ssrlab?": "object"}, "config?": "object",
        "techniques?": [{"technique?": "text", "point?": "text", "label?": "text", "group?": "text",
                       "baseline?": "true or false", "uses_scene_data?": "true or false", "parameters?": "object"}],
        "shots?": [{"shot?": "text", "scene?": "text", "asset?": "text", "label?": "text", "group?": "text",
                    "exposure_ev?": "number", "references?": [{"hash?": "text"}],
                    "truth_ladder?": [{"rung?": "text", "target?": "text", "metric?": "text", "mask?": "text"}]}],
        "images?": [{"shot?": "text", "technique?": "text", "point?": "text", "kind?": "text", "target?": "text"}],
        "provenance?": [{"host?": {"name?": "text", "cpu?": "text"}, "device?": {"name?": "text"}, "ssrlab?": "object"}],
        "clock?": {"load?": [{"shot?": "text", "host?": {"name?": "text", "cpu?": "text"}}],
                   "proofs?": [{"verdict?": "text", "shots?": ["text"]}],
                   "aa_floors?": "object", "aa_pairs?": [{"shot?": "text"}]}
    })");
    return types;
}

/// What to do about a table that cannot be used.
std::string advice(const json& manifest) {
    const json maker = manifest.value("written", json::object()).value("ssrlab", json::object());
    const std::string commit = maker.value("commit", json("")).is_string() ? maker.value("commit", "") : "";
    return "; " +
           (commit.empty() ? "the manifest does not say which version of ssrlab wrote the folder"
                           : "ssrlab of commit " + commit + " wrote the folder") +
           ". Run `ssrlab run` or `ssrlab merge` again: finished cells are kept, and only the tables are made";
}

template <class Row>
void require_columns(const std::filesystem::path& file, const std::string& advice) {
    std::string header;
    std::getline(std::ifstream(file), header);
    header = "," + header.substr(0, header.find('\r')) + ",";
    for_each_column<Row>([&](const auto& column) {
        if (header.find("," + std::string(column.name) + ",") == std::string::npos)
            fail(file.string(), " has no column '", column.name, "'", advice);
    });
}

}  // namespace

void write_tables(const std::filesystem::path& folder, const StudyResults& study) {
    for_each_table([&](const auto& table) {
        const std::filesystem::path file = path_inside(folder, std::string(table.name) + ".csv");
        if (table.use == TableUse::if_any && (study.*table.rows).empty())
            std::filesystem::remove(file);
        else
            write_rows(file, rows_in_file(study.*table.rows));
    });
}

StudyResults read_study_results(const std::filesystem::path& folder, Runs runs) {
    const std::filesystem::path file = path_inside(folder, "manifest.json");
    if (!std::filesystem::exists(file))
        fail(folder.string(), " is no results folder: it has no manifest.json; `ssrlab run` makes one");
    StudyResults study;
    study.manifest = parse_json(read_text(file), file.string());
    require_type(study.manifest, manifest_types(), file.string(), OtherMembers::allowed);
    const std::string what_to_do = advice(study.manifest);
    for_each_table([&]<class Owner, class Row>(const Table<Owner, Row>& table) {
        if (table.use == TableUse::of_runs && runs == Runs::left_out) return;
        const std::filesystem::path csv = path_inside(folder, std::string(table.name) + ".csv");
        if (!std::filesystem::exists(csv)) {
            if (table.use == TableUse::if_any) return;
            fail(csv.string(), " is missing", what_to_do);
        }
        require_columns<Row>(csv, what_to_do);
        study.*table.rows = read_rows<Row>(csv);
    });
    return study;
}
