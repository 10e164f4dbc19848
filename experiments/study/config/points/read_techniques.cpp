#include "experiments/study/config/points/read_techniques.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "experiments/study/config/points/conditions.h"
#include "experiments/study/config/points/design.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/config/points/point_name.h"
#include "variants/registry.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <span>

namespace {

/// A technique's own are obeyed to the letter. Of those that a study names for all, a point that does not depend on
/// them needs one.
std::vector<unsigned> seeds_of(const std::optional<std::vector<unsigned>>& own,
                               const std::optional<std::vector<unsigned>>& of_study, bool depends_on_seed) {
    if (own) return *own;
    if (of_study) return depends_on_seed ? *of_study : std::vector{of_study->front()};
    std::vector<unsigned> seeds(depends_on_seed ? default_seeds : 1);
    std::iota(seeds.begin(), seeds.end(), 0u);
    return seeds;
}

/// The technique; fails with the place in the file if there is none such.
std::unique_ptr<Technique> make_checked(const std::string& where, const std::string& name,
                                        const nlohmann::json& parameters = nlohmann::json::object(),
                                        const std::string& preset = "") {
    try {
        return make_technique(name, parameters, preset);
    } catch (const Error& e) {
        fail(where, ": ", e.what());
    }
}

/// An object of parameter values; null if the key is absent.
nlohmann::json read_values(ConfigObject& entry, const std::string& key, const ParameterSet& declared) {
    if (!entry.has(key)) return {};
    const JsonObject object = entry.plain(key);
    nlohmann::json values = entry[key];
    for (auto& [name, value] : values.items()) value = checked_value(declared, name, value, object.at(name));
    return values;
}

nlohmann::json with_values(nlohmann::json parameters, const nlohmann::json& changed) {
    parameters.update(changed);
    return parameters;
}

/// What the points of an entry have in common.
struct Shared {
    std::string where, label, group;
    std::optional<std::vector<unsigned>> own_seeds, study_seeds;
    bool is_timed = true;
    std::vector<PointCondition> conditions;
};

/// The rest of a point that has its technique, preset and values. False if a condition leaves it out.
bool complete_point(PointConfig& point, const Shared& shared, ConfigObject& object) {
    const auto made = make_checked(shared.where, point.technique, point.parameters, point.preset);
    nlohmann::json values = made->params.values();
    point.conditions = shared.conditions;
    if (!is_wanted(point.conditions, values)) return false;
    point.point = point_name(point.preset, point.swept);
    values["preset"] = point.preset;
    point.label = fill_in(shared.label, values, object.at("label") + ": 'label'");
    point.group = fill_in(shared.group, values, object.at("group") + ": 'group'");
    point.depends_on_seed = made->depends_on_seed();
    point.is_timed = shared.is_timed && !made->uses_scene_data();
    point.seeds = seeds_of(shared.own_seeds, shared.study_seeds, point.depends_on_seed);
    if (!point.against.is_null())
        make_checked(object.at("against"), point.technique, with_values(point.parameters, point.against), point.preset);
    return true;
}

/// The parameter of a chosen tracer or denoiser whose name is like that of another's; "" if there is none.
std::string meant_by(const std::string& name, const ParameterSet& params) {
    const auto leaf = [](const std::string& whole) { return whole.substr(whole.find('.') + 1); };
    std::vector<std::string> leaves;
    std::map<std::string, std::string> names;
    for (const Parameter& p : params)
        if (!p.part().empty() && is_read(params, p.name))
            if (names.try_emplace(leaf(p.name), p.name).second) leaves.push_back(leaf(p.name));
    std::string near = nearest_name(leaf(name), leaves);
    for (const std::string& other : leaves)  // "thickness" of "depth_buffer_thickness"
        if (near.empty() && leaf(name).ends_with("_" + other)) near = other;
    return near.empty() ? "" : names.at(near);
}

/// Fails if a design varies a parameter that none of its points reads: all its values would be one point.
void refuse_unread(std::span<const PointConfig> points, const std::string& where) {
    std::set<std::string> read, varied;
    for (const PointConfig& point : points) {
        std::vector<std::string> names;  // that are not known to be read
        for (const auto& [name, value] : point.swept.items())
            if (!read.contains(name)) names.push_back(name);
        if (names.empty()) continue;
        varied.insert(names.begin(), names.end());
        const auto made = make_technique(point.technique, point.parameters, point.preset);
        for (const std::string& name : names)
            if (is_read(made->params, name)) read.insert(name);
    }
    for (const std::string& name : varied) {
        if (read.contains(name)) continue;
        const PointConfig& first = points.front();
        const std::string meant =
            meant_by(name, make_technique(first.technique, first.parameters, first.preset)->params);
        fail(where, ": no point reads '", name, "', a parameter of a tracer or denoiser that none of them uses",
             meant.empty() ? "" : "; did you mean '" + meant + "'?");
    }
}

/// technique_keys() of the technique with its defaults, made once: they hold the schemas of all its parameters several
/// times, and took most of the time in which a study of many entries was read.
std::shared_ptr<const Keys> kept_keys(const std::string& name, const Technique& plain) {
    static std::mutex mutex;
    static std::map<std::string, std::shared_ptr<const Keys>> kept;
    const TechniqueEntry& entry = find_technique(name);
    const std::lock_guard lock(mutex);
    std::shared_ptr<const Keys>& keys = kept[name + (entry.folder ? entry.folder->content_hash : "")];
    if (!keys) keys = std::make_shared<const Keys>(technique_keys(plain));
    return keys;
}

/// The name of the technique that an entry names; where that is a folder, from the config's, it is added to the table.
std::string read_technique_name(JsonObject& entry, const std::filesystem::path& folder) {
    const std::string named = entry.text("technique");
    try {
        return technique_name(named, folder);
    } catch (const Error& error) {
        fail(entry.at("technique"), ": ", error.what());
    }
}

/// `folder`: of the config.
void read_entry(JsonObject entry, const std::optional<std::vector<unsigned>>& study_seeds,
                const std::filesystem::path& folder, std::vector<PointConfig>& techniques) {
    const std::string name = read_technique_name(entry, folder);
    const auto plain = make_checked(entry.at("technique"), name);
    ConfigObject object(std::move(entry), kept_keys(name, *plain));
    if (object.has("remove"))
        fail(object.at("remove"), ": 'remove' needs a config that 'extends' another; delete the entry instead");
    object.has("technique");
    const std::vector<std::string> presets = object.texts("preset");
    for (const std::string& preset : presets) make_checked(object.at("preset"), name, {}, preset);
    nlohmann::json parameters = read_values(object, "parameters", plain->params);
    if (parameters.is_null()) parameters = nlohmann::json::object();
    const std::vector<nlohmann::json> points = read_design(object, plain->params);
    const nlohmann::json against = read_values(object, "against", plain->params);
    if (object.has("against") && against.empty())
        fail(object.at("against"), ": 'against' must be an object of parameter values, not ", shown(against));
    const auto is_baseline = object.get<bool>("baseline");
    const Shared shared{.where = object.where(),
                        .label = object.get<std::string>("label"),
                        .group = object.get<std::string>("group"),
                        .own_seeds = read_seeds(object),
                        .study_seeds = study_seeds,
                        .is_timed = object.get<bool>("timing"),
                        .conditions = read_conditions(object, plain->params)};
    object.finish();
    if (techniques.size() + presets.size() * points.size() > most_points)
        fail(object.where(), ": with this entry the study has ", techniques.size() + presets.size() * points.size(),
             " points; at most ", most_points, " are allowed");
    const size_t before = techniques.size();
    for (const std::string& preset : presets)
        for (const nlohmann::json& values : points) {
            PointConfig point{.technique = name,
                              .preset = preset,
                              .parameters = with_values(parameters, values),
                              .swept = values,
                              .point = "",
                              .seeds = {},
                              .is_baseline = is_baseline,
                              .against = against};
            if (complete_point(point, shared, object)) techniques.push_back(std::move(point));
        }
    if (techniques.size() == before) fail(object.where(), ": the conditions of this entry exclude all of its points");
    refuse_unread(std::span(techniques).subspan(before), object.where());
}

/// `folder`: of the config.
void read_external_entry(JsonObject entry, const std::filesystem::path& folder, std::vector<PointConfig>& techniques) {
    ConfigObject object(std::move(entry), external_keys());
    if (object.has("remove"))
        fail(object.at("remove"), ": 'remove' needs a config that 'extends' another; delete the entry instead");
    const std::shared_ptr<const ExternalImages> images =
        read_external_images(folder / object.get<std::string>("external"), object.at("external"));
    PointConfig point{.technique = images->name,
                      .preset = "",
                      .parameters = nlohmann::json::object(),
                      .swept = nlohmann::json::object(),
                      .point = images->point,
                      .label = object.get<std::string>("label"),
                      .group = object.get<std::string>("group"),
                      .seeds = std::vector<unsigned>(images->seeds),
                      .depends_on_seed = images->seeds > 1,
                      .is_baseline = object.get<bool>("baseline"),
                      .is_timed = false,
                      .external = images};
    if (object.has("point")) point.point = object.get<std::string>("point");
    std::iota(point.seeds.begin(), point.seeds.end(), 0u);
    object.finish();
    techniques.push_back(std::move(point));
}

/// The pairs (technique, point) name cells and rows, so they must differ, and one label for two would hide which is
/// which.
void refuse_repetition(const std::vector<PointConfig>& techniques, const std::string& where) {
    std::set<std::pair<std::string, std::string>> points;
    std::set<std::string> labels;
    for (const PointConfig& v : techniques) {
        if (!points.insert({v.technique, v.point}).second)
            fail(where, ": techniques: '", v.technique, "' comes twice with the point '", v.point,
                 "'; give the second a preset or a sweep that distinguishes them");
        if (!v.label.empty() && !labels.insert(v.label).second)
            fail(where, ": techniques: two points have the label '", v.label,
                 "'; distinguish them by {preset} or the name of a parameter in braces");
    }
}

}  // namespace

Keys technique_keys(const Technique& technique) {
    const Values parameters = {technique.params.schema(), "an object of parameter values", {}, {{"type", "object"}}};
    const Keys keys = {
        {"technique", any_text(), required,
         "Name from `ssrlab list techniques`, or the folder of your own technique, relative to the config and with a "
         "`/` in it: `./my_ssr`"},
        {"preset", some_of(any_text()), Default("", "none"),
         "Presets to start from, by their names in `ssrlab list presets`"},
        {"parameters", parameters, none,
         "Values of parameters, which replace those of the preset. `experiments/docs/reference/techniques` lists the "
         "parameters"},
        {"label", any_text(), Default("", "its name"),
         "Name of a point in reports, figures and tables; names of parameters in braces and `{preset}` are filled in"},
        {"group", any_text(), Default("", "none"), "Name of a group of points, with the same braces"},
        {"seeds", seeds(), otherwise("the study's"), "Seeds of these points, which replace those of the study"},
        {"baseline", flag(), false, "Compare every other point with this one, over their common seeds (`effects.csv`)"},
        {"against", parameters, otherwise("nothing"),
         "Values of parameters, for example `{\"estimator\": \"a\"}`. Each point is compared with the point that has "
         "these values and is otherwise the same"},
        {"timing", flag(), true, "`false`: errors are measured, but no times"},
        {"remove", flag(), otherwise("false"), "Removes this entry from the config that this config `extends`"}};
    return joined(joined(keys, design_keys(technique.params)), condition_keys());
}

Keys external_keys() {
    return {
        {"external", any_text(), required, "Folder of images that another program rendered, relative to the config"},
        {"point", any_text(), otherwise("what external.json says"), "Name of these images in results"},
        {"label", any_text(), Default("", "its name"), "Name of these images in reports, figures and tables"},
        {"group", any_text(), Default("", "none"), "Name of a group of points"},
        {"baseline", flag(), false, "Compare every other point with these images"},
        {"remove", flag(), otherwise("false"), "Removes this entry from the config that this config `extends`"}};
}

Values seeds() { return counts(100000); }

std::optional<std::vector<unsigned>> read_seeds(ConfigObject& object) {
    if (!object.has("seeds")) return {};
    return numbers_of(object["seeds"], object.at("seeds") + ": 'seeds'");
}

std::vector<PointConfig> read_techniques(ConfigObject& study, const std::filesystem::path& folder) {
    const std::optional<std::vector<unsigned>> seeds = read_seeds(study);
    std::vector<PointConfig> techniques;
    for (JsonObject& entry : study.elements("techniques"))
        if (entry.has("external"))
            read_external_entry(std::move(entry), folder, techniques);
        else
            read_entry(std::move(entry), seeds, folder, techniques);
    refuse_repetition(techniques, study.where());
    return techniques;
}
