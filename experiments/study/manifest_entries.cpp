#include "experiments/study/manifest_entries.h"

#include "core/own_files.h"
#include "experiments/results/files/manifest.h"
#include "experiments/study/config/comparisons.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/config/points/technique_of.h"
#include "experiments/study/config/shots/read_shots.h"
#include "experiments/study/shots/shot_facts.h"
#include "variants/registry.h"

#include <algorithm>
#include <set>

namespace {

/// What another program says of its images.
nlohmann::json external_entry(const ExternalImages& images) {
    nlohmann::json entry = {{"engine", images.engine}, {"version", images.version}};
    if (!images.driver.empty()) entry["driver"] = images.driver;
    if (!images.licence.empty()) entry["licence"] = images.licence;
    if (images.milliseconds) entry["stated_milliseconds"] = *images.milliseconds;
    return entry;
}

/// An entry of a config's "techniques" that makes the point: the values that differ from the technique's defaults.
nlohmann::json config_entry(const PointConfig& point, const Technique& technique) {
    nlohmann::json entry = {{"technique", point.technique}};
    const nlohmann::json defaults = plain_technique_of(point)->params.values(), values = technique.params.values();
    for (const auto& [name, value] : values.items())
        if (defaults.at(name) != value) entry["parameters"][name] = value;
    return entry;
}

nlohmann::json technique_entries(const Config& config) {
    nlohmann::json entries = nlohmann::json::array();
    const std::vector<SingleChange> changes = single_changes(config.techniques);
    for (const PointConfig& v : config.techniques) {
        const auto technique = technique_of(v);
        entries.push_back(
            {{"technique", v.technique},
             {"point", v.point},
             {"title", v.external ? v.external->engine : find_technique(v.technique).title},
             {"source", v.external ? "version " + v.external->version : find_technique(v.technique).source},
             {"parameters", v.external ? v.external->settings : technique->params.values()},
             {"depends_on_seed", technique->depends_on_seed()}});
        if (v.external)
            entries.back()["external"] = external_entry(*v.external);
        else
            entries.back()["entry"] = config_entry(v, *technique);
        if (!v.label.empty()) entries.back()["label"] = v.label;
        if (!v.group.empty()) entries.back()["group"] = v.group;
        if (!v.swept.empty()) entries.back()["swept"] = v.swept;
        if (technique->uses_scene_data()) entries.back()["uses_scene_data"] = true;
        if (v.is_baseline) entries.back()["baseline"] = true;
        for (const SingleChange& c : changes)
            if (c.technique == v.technique && c.point == v.point)
                entries.back()["single_change"] = {{"parameter", c.parameter}, {"value", c.value}};
        if (technique->limits != Limits::none) entries.back()["limits"] = name_of(technique->limits);
        if (const std::string why = technique->not_repeatable(); !why.empty()) entries.back()["not_repeatable"] = why;
    }
    return entries;
}

/// Within the source tree relative to it, as documents name it.
std::string shown_path(const std::filesystem::path& file) {
    const std::filesystem::path inside = std::filesystem::proximate(file, own_files());
    return (inside.empty() || inside.begin()->string() == ".." ? file : inside).string();
}

/// What the parameters of the study's techniques mean: {technique: {parameter: meaning}}.
nlohmann::json parameter_docs(const Config& config) {
    nlohmann::json docs = nlohmann::json::object();
    for (const PointConfig& v : config.techniques)
        for (const auto technique = plain_technique_of(v); const Parameter& p : technique->params)
            docs[v.technique][p.name] = p.doc;
    return docs;
}

/// What is said of what was left out.
nlohmann::json left_out_entry(const LeftOut& part) {
    return {{"what", full_name(part)},
            {"stage", part.stage.empty() ? part.what : part.stage},
            {"fact", part.fact},
            {"why", part.why},
            {"keeps_bits", part.keeps_bits},
            {"saved_ms", nullptr}};
}

/// What path tracer, rasteriser and techniques leave out, each once.
nlohmann::json left_out_entries(const std::vector<LeftOutBy>& left_out) {
    nlohmann::json entries = nlohmann::json::array();
    for (const auto& [who, part] : left_out) {
        nlohmann::json entry = left_out_entry(part);
        const bool says_whose = part.what.find('/') != std::string::npos || !part.stage.empty();
        if (!says_whose) entry["what"] = who + ": " + part.what;
        if (std::ranges::find(entries, entry) == entries.end()) entries.push_back(entry);
    }
    return entries;
}

}  // namespace

nlohmann::json study_entry(const Config& config) {
    nlohmann::json warnings = nlohmann::json::array();
    if (std::ranges::any_of(config.shots, &ShotConfig::direct_lit))
        warnings.push_back(
            "SSR read rasterised direct light, not the truth's lit colour: part of its error is that light's");
    if (std::ranges::any_of(config.shots, &ShotConfig::lit_has_environment))
        warnings.push_back("the lit image that SSR read held the environment's specular reflections, as engines' do");
    if (std::ranges::any_of(config.shots, &ShotConfig::has_probe))
        warnings.push_back(
            "reflections fell back to a probe at the camera's first place, not to the environment: the same probe in "
            "all studies of a scene, so that no interval holds what its own noise adds");
    if (config.composite == CompositeFormula::additive_fresnel)
        warnings.push_back(
            "reflections were added to an image that holds the environment's already, as an engine's document prints "
            "it: "
            "where both are found, both count");
    std::set<unsigned> bits;
    for (const ShotConfig& shot : config.shots) bits.insert(shot.normal_bits);
    for (const unsigned count : bits)
        if (count > 0)
            warnings.push_back("techniques and composite read normals of 2 x " + std::to_string(count) +
                               " bits; the truth has its own");
    if (std::ranges::any_of(config.shots,
                            [](const ShotConfig& s) { return s.gbuffer_formats == GBufferFormats::packed; }))
        warnings.push_back(
            "techniques and composite read a packed G-buffer: halves, base colour in bytes; the truth has its own");
    return {{"study", {{"name", config.file.stem().string()}, {"config", shown_path(config.file)}}},
            {"title", config.title},
            {"config", config.source},
            {"clock", nlohmann::json::object()},
            {"warnings", warnings},
            {"shots", nlohmann::json::array()},
            {"techniques", technique_entries(config)},
            {"primary",
             {{"metric", config.primary.metric},
              {"mask", config.primary.mask},
              {"target", config.primary.target},
              {"margin", config.primary.margin}}},
            {"metrics", metric_descriptions()},
            {"parameter_docs", parameter_docs(config)},
            {"images", nlohmann::json::array()}};
}

void complete_shot_entry(nlohmann::json& entry, const nlohmann::json& rendered) {
    for (const auto& [key, value] : rendered.items())
        if (key == "needs" || key == "warnings")
            entry[key].insert(entry[key].end(), value.begin(), value.end());
        else
            entry[key] = value;
}

nlohmann::json new_shot_entry(const Shot& shot, const Config& config, const std::vector<std::string>& scene_warnings,
                              const std::vector<LeftOutBy>& left_out) {
    const nlohmann::json needs =
        shot.config.gbuffer.empty() ? fact_entries(list_facts(shot.scene, shot.facts)) : nlohmann::json::array();
    nlohmann::json entry = {{"shot", shot.name()},
                            {"scene", shot.scene.name},
                            {"asset", shot.scene.asset.empty() ? shot.scene.name : shot.scene.asset},
                            {"camera", shot.camera.name},
                            {"width", shot.config.extent.x},
                            {"height", shot.config.extent.y},
                            {"frame", shot.config.frames.back()},
                            {"frames", shot.config.frames},
                            {"warm_up", shot.config.warm_up},
                            {"repeat", shot.config.repeat},
                            {"measure", shot.config.measures_last_only ? "last" : "all"},
                            {"measure_from", std::max(shot.config.measure_from, shot.config.frames.front())},
                            {"exposure_ev", shot.camera.exposure_ev},
                            {"warnings", scene_warnings},
                            {"needs", needs},
                            {"left_out", left_out_entries(left_out)}};
    if (shot.config.change) entry["change"] = *shot.config.change;
    if (!shot.config.label.empty()) entry["label"] = shot.config.label;
    if (!shot.config.group.empty()) entry["group"] = shot.config.group;
    entry.update(shot_settings(shot.config));
    if (config.filters_lit && config.has_reference && shot.config.gbuffer.empty() && !shot.config.direct_lit)
        entry["lit"] = "filtered";
    return entry;
}
