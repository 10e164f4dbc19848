#include "experiments/study/plan/study_plan.h"

#include "core/error.h"
#include "core/files.h"
#include "experiments/results/cells/source_code.h"
#include "experiments/study/config/points/conditions.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/config/points/technique_of.h"
#include "experiments/study/config/shots/scene_warnings.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/manifest_entries.h"
#include "experiments/study/measuring/frames/capture.h"
#include "experiments/study/measuring/shot_truth.h"
#include "variants/denoisers/denoisers.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace {

/// A point as cells are named by it.
struct PointIdentity {
    std::string parameters;  ///< all values, and the content of its folder if it is declared by one
    std::vector<std::string>
        sources;  ///< the folders of its technique and of the tracers and the denoiser that it has chosen
};

PointIdentity identity_of(const PointConfig& config) {
    if (config.external)
        return {.parameters = config.external->settings.dump(),
                .sources = {"experiments/study/shots/external_frames.cpp"}};
    const std::unique_ptr<Technique> technique = technique_of(config);
    const nlohmann::json values = technique->params.values();
    const auto& folder = find_technique(config.technique).folder;
    PointIdentity identity{.parameters = values.dump() + folder->content_hash, .sources = folder->sources};
    identity.sources.push_back("variants/declared/");
    if (technique->uses_scene_data()) identity.sources.push_back("variants/tracers/exact_scene/");
    for (const auto& [name, value] : values.items())
        for (const TracerEntry& tracer : tracer_table())
            if (value == tracer.name) {
                identity.sources.push_back("variants/" + tracer.shader.substr(0, tracer.shader.rfind('/') + 1));
                identity.parameters += tracer.content_hash;
            }
    if (values.contains("denoiser")) {
        const DenoiserEntry& denoiser = find_denoiser(values.at("denoiser"));
        identity.sources.insert(identity.sources.end(), denoiser.sources.begin(), denoiser.sources.end());
        identity.parameters += denoiser.content_hash;
    }
    return identity;
}

/// Names the cells of a study.
class CellNames {
public:
    CellNames(const Config& config, const DeviceInfo& device, bool keep_all, std::vector<SourceFile> sources)
        : config_(config), device_(device.name + device.driver), keep_all_(keep_all), code_(std::move(sources)) {
        for (const PointConfig& technique : config.techniques) points_.push_back(identity_of(technique));
    }

    /// The chips that costs cells compile for, which their names hold with the compiler's version.
    const GpuCompilers& compilers() const { return compilers_; }

    std::string of_references(const std::string& request) {
        return name({"experiments/study/shots/open_shot.cpp"}, request, with_images({}));
    }
    std::string of_renders(const std::string& request, size_t technique, const Shot& shot) {
        const PointIdentity& point = points_[technique];
        std::vector<std::string> sources = point.sources;
        sources.push_back("experiments/study/shots/point_renders.cpp"),
            sources.push_back("experiments/study/shots/open_shot.cpp");
        const PointConfig& v = config_.techniques[technique];
        std::vector<std::string> what = {v.technique, v.point, point.parameters};
        for (const unsigned seed : v.seeds) what.push_back(std::to_string(seed));
        if (!config_.measures_lit_noise) what.push_back("without lit noise");
        if (v.external) what.push_back(v.external->content_hash(shot));
        return name(sources, request, with_images(what));
    }
    std::string of_costs(const std::string& request, size_t technique) {
        const PointIdentity& point = points_[technique];
        std::vector<std::string> sources = point.sources;
        sources.push_back("experiments/study/measuring/costs/costs.cpp"),
            sources.push_back("experiments/study/shots/open_shot.cpp");
        const PointConfig& v = config_.techniques[technique];
        std::vector<std::string> what = {v.technique, v.point, point.parameters, std::to_string(v.seeds.front())};
        if (!config_.counts_costs) what.push_back("compiled alone");
        if (!config_.gpu_compilers.empty()) sources.push_back("experiments/study/measuring/costs/compiled_shaders.cpp");
        if (config_.counts_costs && !config_.gpu_compilers.empty())
            sources.push_back("experiments/study/measuring/costs/gpu_estimates.cpp");
        for (const GpuCompilers::Entry& entry : compilers_.entries)
            what.push_back(entry.chip.name), what.push_back(entry.chip.driver);
        return name(sources, request, what);
    }
    /// `runs`: by technique, whether it runs on the shot.
    std::string of_times(const std::string& request, const std::vector<bool>& runs) {
        std::vector<std::string> sources = {"experiments/study/measuring/times/timing.cpp",
                                            "experiments/study/shots/open_shot.cpp"};
        std::vector<std::string> what = {std::to_string(config_.timing.frames), std::to_string(config_.timing.warm_up),
                                         std::to_string(config_.timing.most_share)};
        if (!config_.timing.has_copies) what.push_back("alone");
        for (size_t i = 0; i < points_.size(); ++i) {
            const PointConfig& v = config_.techniques[i];
            if (!v.is_timed || !runs[i]) continue;
            sources.insert(sources.end(), points_[i].sources.begin(), points_[i].sources.end());
            what.insert(what.end(), {v.technique, v.point, points_[i].parameters, std::to_string(v.seeds.front())});
        }
        return name(sources, request, what);
    }

private:
    /// Times do not depend on which images are kept.
    std::vector<std::string> with_images(std::vector<std::string> what) const {
        if (config_.kept_images == KeptImages::measured) what.push_back("all images");
        if (config_.kept_images == KeptImages::played) what.push_back("played images");
        if (config_.kept_images == KeptImages::none) what.push_back("no images");
        return what;
    }
    std::string name(const std::vector<std::string>& sources, const std::string& request,
                     const std::vector<std::string>& what) {
        const Config& c = config_;
        ContentHash hash;
        auto [code, is_new] = hashes_.try_emplace(sources);
        if (is_new) code->second = code_.hash_of(sources);
        for (const std::string& part : {code->second, device_, request}) hash.add(part);
        for (const auto& list : {what, c.metrics, c.masks, c.targets, c.frame_metrics, c.frame_masks}) {
            hash.add(list.size());
            for (const std::string& text : list) hash.add(text);
        }
        hash.add(int(keep_all_)), hash.add(int(c.composite));
        hash.add(c.hits ? int(c.hits->every) : 0), hash.add(c.hits ? int(c.hits->seeds) : 0);
        hash.add(c.reflective_max_roughness), hash.add(c.reflective_min_reflectance);
        return hash.hex();
    }

    const Config& config_;
    GpuCompilers compilers_ = find_compilers(config_.gpu_compilers);
    std::string device_;
    bool keep_all_;
    SourceCode code_;
    std::vector<PointIdentity> points_;                       ///< as Config::techniques
    std::map<std::vector<std::string>, std::string> hashes_;  ///< of sources
};

Shot load(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path) {
    if (config.gbuffer.empty()) return load_shot(config, search_path);
    Capture capture(config.gbuffer);
    Shot shot = capture_shot(config, capture);
    shot.facts = inspect_capture(shot, capture).facts;
    return shot;
}

/// What a shot shows and how it is played: all that its cells depend on, but for what is rendered.
std::string request_of(const Shot& shot, const Config& config, bool keep_all) {
    const std::set<unsigned> compared = compared_frames(shot);
    ContentHash hash;
    hash.add(shot.scene.content_hash), hash.add(shot.name()), hash.add(shot.camera.exposure_ev);
    for (const unsigned frame : shot.config.frames) {
        hash.add(frame);
        if (!shot.config.reference.empty()) hash.add(read_text(capture_reference_file(shot.config, frame)));
        if (!shot.config.gbuffer.empty()) continue;
        const ShotFrame now = shot_frame(shot, frame);
        const ReferenceUse use{.is_of_last = frame == shot.config.frames.back(),
                               .is_compared = compared.contains(frame)};
        const ReferenceSettings settings = settings_of(config, use, keep_all);
        hash.add(reference_key(reference_request(shot.scene, now.scene, now.camera, shot.config.extent, settings),
                               settings));
    }
    for (const unsigned number :
         {shot.config.warm_up, shot.config.repeat, shot.config.change.value_or(0),
          unsigned(shot.config.measures_last_only), shot.config.measure_from, unsigned(config.has_reference),
          unsigned(shot.config.direct_lit), unsigned(shot.config.lit_has_environment), unsigned(shot.config.has_probe),
          unsigned(config.filters_lit), unsigned(shot.config.depth_format), unsigned(shot.config.depth_direction),
          shot.config.normal_bits, unsigned(shot.config.gbuffer_formats)})
        hash.add(number);
    return hash.hex();
}

/// A technique may be left out of shots by its conditions; images that no shot uses are a mistake.
void refuse_unused_images(const Config& config, const StudyPlan& plan) {
    for (const PointConfig& technique : config.techniques) {
        if (!technique.external) continue;
        const auto is_used = [&](const PlannedShot& shot) {
            return std::ranges::any_of(shot.cells,
                                       [&](const PlannedCell& cell) { return cell.technique == &technique; });
        };
        if (std::ranges::any_of(plan.shots, is_used)) continue;
        for (const nlohmann::json& skipped : plan.skipped)
            if (skipped["technique"] == technique.technique && skipped["point"] == technique.point)
                fail(config.file.string(), ": no shot uses the images in ", technique.external->folder.string(), ": ",
                     skipped["shot"].get<std::string>(), ": ", skipped["condition"].get<std::string>());
    }
}

}  // namespace

const std::vector<std::string>& cell_kind_names() {
    static const std::vector<std::string> names = {"references", "renders", "costs", "times"};
    return names;
}

const std::string& name_of(CellKind kind) { return cell_kind_names()[size_t(kind)]; }

size_t StudyPlan::cell_count() const {
    return std::accumulate(shots.begin(), shots.end(), size_t(0),
                           [](size_t sum, const PlannedShot& shot) { return sum + shot.cells.size(); });
}

StudyPlan plan_study(const Config& config, const DeviceInfo& device,
                     const std::vector<std::filesystem::path>& search_path, bool keep_all,
                     std::vector<SourceFile> sources) {
    CellNames names(config, device, keep_all, std::move(sources));
    StudyPlan plan;
    plan.compilers = names.compilers();
    LeftOutFinder left_out(config.techniques);
    std::set<std::string> known, warned;
    for (const ShotConfig& of_shot : config.shots) {
        const Shot shot = load(of_shot, search_path);
        if (!known.insert(shot.name()).second)
            fail("two shots have the name '", shot.name(),
                 "' in results; give one of both other frames, another camera or another resolution");
        const std::string request = request_of(shot, config, keep_all);
        PlannedShot& planned = plan.shots.emplace_back();
        planned.config = shot.config, planned.name = shot.name();
        const std::vector<std::string> warnings = warning_sentences(shot.scene);
        for (const std::string& text : warnings)
            if (warned.insert(shot.scene.name + ": " + text).second)
                planned.scene_warnings.push_back(shot.scene.name + ": " + text);
        planned.entry = new_shot_entry(shot, config, warnings, keep_all ? std::vector<LeftOutBy>{} : left_out.of(shot));
        const auto add = [&](CellKind kind, std::string name, const std::string& what, double units) -> PlannedCell& {
            return planned.cells.emplace_back(
                PlannedCell{.kind = kind,
                            .name = std::move(name),
                            .what = planned.name + ": " + what,
                            .shot = planned.name,
                            .units = units,
                            .pixels = size_t(shot.config.extent.x) * shot.config.extent.y});
        };
        std::vector<bool> runs;
        for (const PointConfig& technique : config.techniques) {
            const std::string why = why_skipped(technique, shot);
            runs.push_back(why.empty());
            if (!why.empty())
                plan.skipped.push_back({{"shot", planned.name},
                                        {"technique", technique.technique},
                                        {"point", technique.point},
                                        {"condition", why}});
        }
        add(CellKind::references, names.of_references(request), "references", double(shot.config.frames.size()));
        for (size_t i = 0; i < config.techniques.size(); ++i) {
            const PointConfig& technique = config.techniques[i];
            if (!runs[i]) continue;
            add(CellKind::renders, names.of_renders(request, i, shot), technique.technique + " " + technique.point,
                double(shot.steps.size() * technique.seeds.size()))
                .technique = &technique;
        }
        for (size_t i = 0; i < config.techniques.size() && config.has_cost_cells(); ++i) {
            const PointConfig& technique = config.techniques[i];
            if (!runs[i] || technique.external) continue;
            add(CellKind::costs, names.of_costs(request, i), "costs of " + technique.technique + " " + technique.point,
                double(shot.steps.size()))
                .technique = &technique;
        }
        const Config on_shot = config_on(config, shot);
        if (config.timing.frames > 0 && std::ranges::any_of(on_shot.techniques, &PointConfig::is_timed))
            add(CellKind::times, names.of_times(request, runs), "times", 1);
    }
    refuse_unused_images(config, plan);
    return plan;
}
