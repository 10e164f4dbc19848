#include "experiments/results/advice/advice.h"

#include "core/error.h"
#include "core/json.h"
#include "core/json_types.h"
#include "core/list_text.h"

namespace {

const char* const how_to_make_advice = "experiments/docs/advise.md says how to make the table";

std::filesystem::path sources_beside(std::filesystem::path csv) { return csv.replace_extension(".json"); }

const nlohmann::json& types_of_sources() {
    static const nlohmann::json types = nlohmann::json::parse(R"({
        "errors": [{"title": "text", "config": "text", "commit": "text", "finished": "text", "sizes": ["text"]}],
        "costs": [{"title": "text", "config": "text", "commit": "text", "finished": "text", "sizes": ["text"],
                   "compilers": {"*": "text"}}],
        "points": {"*": {"*": "object"}},
        "rows": "size"
    })");
    return types;
}

void check_advice(const std::filesystem::path& csv, const Advice& advice) {
    require_type(advice.sources, types_of_sources(), sources_beside(csv).string());
    if (const size_t rows = advice.sources["rows"].get<size_t>(); rows != advice.rows.size() || rows == 0)
        fail(csv.string(), " has ", advice.rows.size(), " rows, and ", sources_beside(csv).string(), " says ", rows);
    for (const AdviceRow& row : advice.rows) {
        if ((row.reason.empty() || row.rank) && !row.ratio)
            fail(csv.string(), ": a row of ", row.technique, " has neither a ratio nor a reason");
        const nlohmann::json points = advice.sources["points"].value(row.technique, nlohmann::json::object());
        if (!points.contains(row.point))
            fail(sources_beside(csv).string(), " has no parameters of ", row.technique, " ", row.point);
    }
}

}  // namespace

void write_advice(const std::filesystem::path& csv, const Advice& advice) {
    write_rows(csv, advice.rows);
    write_text(sources_beside(csv), advice.sources.dump(2) + "\n");
}

Advice read_advice(const std::filesystem::path& csv) {
    for (const std::filesystem::path& file : {csv, sources_beside(csv)})
        if (!std::filesystem::exists(file)) fail(file.string(), " is missing; ", how_to_make_advice);
    try {
        Advice advice{.rows = read_rows<AdviceRow>(csv), .sources = read_json(sources_beside(csv))};
        check_advice(csv, advice);
        return advice;
    } catch (const MachineError&) {
        throw;
    } catch (const Error& damage) {
        fail(damage.what(), "; ", how_to_make_advice);
    }
}
