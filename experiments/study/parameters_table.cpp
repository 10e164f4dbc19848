#include "experiments/study/parameters_table.h"

#include "core/files.h"
#include "experiments/results/files/csv.h"
#include "experiments/results/results_schema.h"
#include "experiments/study/config/points/technique_of.h"

#include <map>

namespace {

using nlohmann::json;

/// By name. Two techniques may have a parameter of one name.
std::vector<ParameterColumn> parameter_columns(const std::vector<PointConfig>& techniques) {
    std::map<std::string, ParameterColumn> columns;
    for (const PointConfig& v : techniques)
        for (const auto made = plain_technique_of(v); const Parameter& p : made->params) {
            const std::string type = !p.choices.empty()       ? "string"
                                     : p.glsl_type == "bool"  ? "boolean"
                                     : p.glsl_type == "float" ? "number"
                                                              : "integer";
            const auto [at, is_new] = columns.try_emplace(p.name, ParameterColumn{p.name, type, p.unit, p.doc});
            if (!is_new && at->second.type != type)
                at->second = {p.name, "string", "", "differs from technique to technique"};
        }
    std::vector<ParameterColumn> list;
    for (const auto& [name, column] : columns) list.push_back(column);
    return list;
}

std::string csv_value(const json& value) {
    if (value.is_boolean()) return csv_field(value.get<bool>());
    return csv_field(value.is_string() ? value.get<std::string>() : value.dump());
}

}  // namespace

void write_parameters(const std::filesystem::path& folder, const std::vector<PointConfig>& techniques) {
    const std::vector<ParameterColumn> columns = parameter_columns(techniques);
    std::string text;
    for (const char* name : names_of_points) text += std::string(name) + ",";
    for (const ParameterColumn& column : columns) text += csv_field(column.name) + ",";
    text.back() = '\n';
    for (const PointConfig& v : techniques) {
        const json values = technique_of(v)->params.values();
        for (const std::string& name : {v.technique, v.point, v.label, v.group, v.preset})
            text += csv_field(name) + ",";
        for (const ParameterColumn& column : columns)
            text += (values.contains(column.name) ? csv_value(values[column.name]) : "") + ",";
        text.back() = '\n';
    }
    write_text(folder / "parameters.csv", text);
    write_text(folder / "schema.json", results_schema(columns).dump(1) + "\n");
}
