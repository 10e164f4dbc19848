#include "experiments/stability/known_failures.h"

#include "core/error.h"
#include "core/json.h"

namespace {

std::vector<std::string> read_texts(JsonObject& object, const std::string& key) {
    const nlohmann::json& list = object.any(key);
    const bool is_list = list.is_array() && !list.empty() &&
                         std::ranges::all_of(list, [](const nlohmann::json& text) { return text.is_string(); });
    if (!is_list) fail(object.where(), ": '", key, "' must be an array of texts, not ", shown(list));
    return list.get<std::vector<std::string>>();
}

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
        failure.techniques = read_texts(entry, "techniques"), failure.stages = read_texts(entry, "stages");
        if (entry.has("cases")) failure.cases = read_texts(entry, "cases");
        failure.operation = entry.text("operation"), failure.mend = entry.text("mend");
        entry.finish();
        known.push_back(failure);
    }
    object.finish();
    return known;
}

std::filesystem::path known_failures_file() {
    return std::filesystem::path(SSRLAB_SOURCE_DIR) / "experiments/stability/failures.json";
}

const KnownFailure* explanation_of(const FailurePlace& p, const std::vector<KnownFailure>& known) {
    const auto found = std::ranges::find_if(known, [&](const KnownFailure& failure) {
        return names_any(failure.techniques, {p.variant, p.variant + ":" + p.point}) &&
               names_any(failure.stages, {p.stage, p.stage + ": " + p.image}) &&
               (failure.cases.empty() || names_any(failure.cases, {p.case_name, p.family, p.group}));
    });
    return found == known.end() ? nullptr : &*found;
}
