#include "experiments/results/stability/known_failures.h"

#include "core/json.h"
#include "core/own_files.h"

namespace {

bool names_any(const std::vector<std::string>& wanted, std::initializer_list<std::string> names) {
    return std::ranges::any_of(names, [&](const std::string& name) { return std::ranges::count(wanted, name) > 0; });
}

}  // namespace

std::vector<KnownFailure> read_known_failures(const std::filesystem::path& file) {
    const nlohmann::json json = read_json(file);
    JsonObject object(json, file.string());
    std::vector<KnownFailure> known;
    for (JsonObject& entry : object.objects("failures")) {
        KnownFailure failure;
        failure.techniques = entry.texts("techniques"), failure.stages = entry.texts("stages");
        failure.cases = entry.texts("cases");
        failure.operation = entry.text("operation"), failure.fix = entry.text("fix");
        entry.finish();
        known.push_back(failure);
    }
    object.finish();
    return known;
}

std::filesystem::path known_failures_file() { return own_files() / "experiments/results/stability/failures.json"; }

const KnownFailure* explanation_of(const StageRow& row, const StabilityCaseName& what,
                                   const std::vector<KnownFailure>& known) {
    const auto found = std::ranges::find_if(known, [&](const KnownFailure& failure) {
        return names_any(failure.techniques, {row.technique, row.technique + ":" + row.point}) &&
               names_any(failure.stages, {row.stage, row.stage + ": " + row.image}) &&
               (failure.cases.empty() || names_any(failure.cases, {what.name, what.family, what.group}));
    });
    return found == known.end() ? nullptr : &*found;
}
