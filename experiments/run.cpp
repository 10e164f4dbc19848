#include "experiments/run.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gbuffer/composite.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "experiments/host_info.h"
#include "experiments/manifest.h"
#include "experiments/measure.h"
#include "experiments/progress.h"
#include "experiments/report.h"
#include "experiments/results.h"
#include "experiments/timing.h"
#include "groundtruth/reference_cache.h"
#include "groundtruth/reference_file.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

/// One frame of a shot, ready for every variant: the truth, and the lit colour that comes with it.
struct PreparedFrame {
    unsigned frame;
    std::string shot_name, reference_hash;
    FrameTruth truth;
};

/// All that a study needs while it runs.
struct Study {
    const Config& config;
    const RunSettings& settings;
    Device& device;
    CellStore cells;
    Progress progress;
    double work_done = 0;
    std::string code;
    nlohmann::json manifest;
    std::vector<Cell> finished;

    /// Adds `share` of a step of `work` to what is done.
    void report(double work, double share, const std::string& what) { progress.update(work_done + work * share, what); }
};

// Shares of the progress bar, in about seconds of a small study.
constexpr double reference_work = 20, timing_work = 5, cell_work = 1;

double total_work(const Config& config) {
    double work = 0;
    for (const ShotConfig& shot : config.shots)
        work += reference_work * double(shot.frames.size()) + timing_work + cell_work * double(config.variants.size() * config.seeds.size() * shot.frames.size());
    return work;
}

HostImage one_channel(const HostImage& source, unsigned channel) {
    HostImage result(source.extent, 1);
    for (size_t i = 0; i < result.values.size(); ++i) result.values[i] = source.values[i * source.channels + channel];
    return result;
}

/// Renders the reference of one frame, or takes it from the cache.
Reference obtain_reference(Study& study, const Shot& shot, unsigned frame) {
    const ShotFrame now = shot_frame(shot, frame);
    ReferenceSettings settings = study.config.reference;
    settings.keep_all = study.settings.keep_all;
    ReferenceRun run;
    run.progress = [&](double fraction, double rays_per_second, double) {
        char rate[32];
        std::snprintf(rate, sizeof rate, "%.1f Mray/s", rays_per_second * 1e-6);
        study.report(reference_work, fraction, shot.name(frame) + ": reference, " + rate);
    };
    run.notice = [&](const std::string& text) { study.progress.say("note: " + text); };
    Reference reference = cached_reference(shot.scene, now.scene, now.camera, shot.config.extent, settings, study.settings.cache, run);
    study.work_done += reference_work;
    return reference;
}

/// The truth of one frame, and its entry in the manifest.
PreparedFrame prepare_frame(Study& study, const Shot& shot, FrameSource& source, unsigned frame, const Reference& reference) {
    const GBuffer gbuffer = source.render(frame, study.config.seeds.front(), reference.diffuse.mean);
    const HostGBuffer host = download_gbuffer(source.graph(), gbuffer, source.camera(), study.config.depth_format);
    PreparedFrame prepared{.frame = frame, .shot_name = shot.name(frame), .reference_hash = reference.hash,
                           .truth = frame_truth(reference, one_channel(host.normal, 3), specular_reflectance(host), study.config, shot.camera.exposure_ev)};
    study.manifest["shots"].push_back(shot_entry(shot, frame, reference, prepared.truth, study.config));
    for (const SceneFact& fact : list_facts(pixel_facts(host))) study.manifest["shots"].back()["needs"].push_back(fact_entry(fact));
    for (const LeftOut& part : source.left_out()) study.manifest["shots"].back()["left_out"].push_back(left_out_entry(part));
    for (nlohmann::json& image : save_reference_images(study.settings.out, prepared.shot_name, reference, shot.camera.exposure_ev))
        study.manifest["images"].push_back(std::move(image));
    return prepared;
}

/// The name of a cell: the hash of all that its numbers depend on.
std::string cell_hash(const Study& study, const Shot& shot, const std::vector<PreparedFrame>& frames, const std::string& what, const nlohmann::json& parameters, unsigned seed) {
    const Config& c = study.config;
    ContentHash hash;
    for (const std::string& part : {study.code, study.device.info().name + study.device.info().driver, shot.scene.content_hash, what, parameters.dump()}) hash.add(part);
    for (const PreparedFrame& frame : frames) hash.add(frame.shot_name), hash.add(frame.reference_hash);
    for (const auto& list : {c.metrics, c.masks, c.targets})
        for (const std::string& name : list) hash.add(name);
    hash.add(int(c.direct_lit)), hash.add(int(c.depth_format)), hash.add(int(c.depth_direction)), hash.add(int(study.settings.keep_all));
    hash.add(c.reflective_max_roughness), hash.add(c.reflective_min_reflectance), hash.add(shot.camera.exposure_ev), hash.add(seed);
    return hash.hex();
}

/// One variant at one point with one seed, over all frames of a shot: the heart of ssrlab.
Cell run_cell(Study& study, const Shot& shot, FrameSource& source, const std::vector<PreparedFrame>& frames, const VariantConfig& config, unsigned seed) {
    const std::unique_ptr<Variant> variant = make_variant(config.variant, config.parameters, config.preset);
    if (!study.settings.keep_all) variant->leave_out(shot.facts);
    PassGraph graph(study.device, shot.config.extent);
    Compositor compositor(graph);
    Cell cell;
    for (const PreparedFrame& frame : frames) {
        const GBuffer gbuffer = source.render(frame.frame, seed, frame.truth.diffuse);
        graph.begin_frame(source.camera(), variant->params, gbuffer.images());
        const Reflections reflections = variant->render(graph, gbuffer);
        const Composite composite = compositor.render(gbuffer, reflections);

        const CompositedImages images = download_results(graph, gbuffer, reflections, composite, frame.truth.reflectance);
        const ResultRow row{.shot = frame.shot_name, .scene = shot.scene.name, .camera = shot.camera.name, .frame = frame.frame, .width = shot.config.extent.x,
                            .height = shot.config.extent.y, .variant = config.variant, .point = config.point, .seed = seed};
        for (ResultRow& r : measure_result(frame.truth, images, study.config, row)) cell.rows.push_back(std::move(r));
        if (seed == study.config.seeds.front())
            for (nlohmann::json& entry : save_result_images(study.settings.out, row, frame.truth, images, shot.camera.exposure_ev)) cell.images.push_back(std::move(entry));
    }
    return cell;
}

/// A result while the study runs: one number that matters, with its interval.
void say_result(Study& study, const Cell& cell) {
    const auto is_headline = [&](const ResultRow& r) { return r.target == "specular" && r.metric == "relmse" && r.mask == "reflective"; };
    for (const ResultRow& r : cell.rows)
        if (is_headline(r) && r.value) {
            char line[160];
            std::snprintf(line, sizeof line, "  %-24s %-24s seed %-3u relmse of reflective pixels %.4g", r.variant.c_str(), r.point.c_str(), r.seed, *r.value);
            char interval[64] = "";
            if (r.low && r.high) std::snprintf(interval, sizeof interval, "  [%.4g, %.4g]", *r.low, *r.high);
            study.progress.say(std::string(line) + interval);
        }
}

/// Loads the cell if it was done before, else does it and keeps it.
template <class Work>
void do_cell(Study& study, const std::string& hash, double work, const std::string& what, const Work& make) {
    study.report(work, 0.0, what);
    std::optional<Cell> cell = study.cells.load(hash);
    if (!cell) {
        cell = make();
        study.cells.save(hash, *cell);
    }
    study.work_done += work;
    say_result(study, *cell);
    study.finished.push_back(std::move(*cell));
}

/// All variants, points and seeds of a shot, then their times.
void run_variants(Study& study, const Shot& shot, FrameSource& source, const std::vector<PreparedFrame>& frames) {
    const Config& config = study.config;
    for (const VariantConfig& variant : config.variants) {
        const nlohmann::json parameters = make_variant(variant.variant, variant.parameters, variant.preset)->params.values();
        for (const unsigned seed : config.seeds)
            do_cell(study, cell_hash(study, shot, frames, variant.variant + "\n" + variant.point, parameters, seed), cell_work * double(frames.size()),
                    frames.front().shot_name + ": " + variant.variant + " " + variant.point, [&] { return run_cell(study, shot, source, frames, variant, seed); });
    }
    const nlohmann::json timed = {{"variants", study.manifest["variants"]}, {"frames", config.timing.frames}, {"warm_up", config.timing.warm_up}};
    do_cell(study, cell_hash(study, shot, frames, "times", timed, 0), timing_work, frames.front().shot_name + ": timing", [&] {
        const ShotTimes times = time_variants(source, shot, config, frames.front().truth.diffuse, study.settings.keep_all,
                                              [&](double share) { study.report(timing_work, share, frames.front().shot_name + ": timing"); });
        return Cell{.rows = {}, .times = times.rows, .images = {{{"aa_floor", times.aa_floor}}}};
    });
}

void run_scene_shot(Study& study, const ShotConfig& shot_config) {
    const Shot shot = load_shot(shot_config, study.settings.search_path);
    study.progress.say(shot.scene.name + ", camera " + shot.camera.name);
    const std::unique_ptr<FrameSource> source = scene_source(study.device, shot, study.config, study.settings.keep_all);
    std::vector<PreparedFrame> frames;
    for (const unsigned frame : shot.config.frames) frames.push_back(prepare_frame(study, shot, *source, frame, obtain_reference(study, shot, frame)));
    run_variants(study, shot, *source, frames);
}

/// A capture: measured if it comes with a reference, else only rendered and timed.
void run_gbuffer_shot(Study& study, const ShotConfig& shot_config) {
    LoadedGBuffer loaded = load_gbuffer(shot_config.gbuffer);
    const Shot shot = gbuffer_shot(shot_config, loaded.gbuffer);
    study.progress.say(shot.scene.name + ", from files");
    for (const std::string& note : loaded.notes) study.progress.say("note: " + note);
    study.work_done += reference_work;
    // A reference brings the path-traced lit colour; `ssrlab gbuffer` saves unshadowed direct light.
    if (!shot_config.reference.empty() && !study.config.direct_lit) loaded.gbuffer.lit = {};
    const HostImage file_lit = loaded.gbuffer.lit;
    const std::unique_ptr<FrameSource> source = file_source(study.device, std::move(loaded.gbuffer));
    std::vector<PreparedFrame> frames;
    if (!shot_config.reference.empty()) {
        const Reference reference = read_reference(shot_config.reference);
        if (reference.extent != shot.config.extent)
            fail(shot_config.reference.string(), " is ", reference.extent.x, "x", reference.extent.y, ", but the G-buffer is ", shot.config.extent.x, "x", shot.config.extent.y);
        frames.push_back(prepare_frame(study, shot, *source, 0, reference));
    } else {
        HostImage lit(shot.config.extent, 3);
        for (size_t i = 0; i < file_lit.pixel_count(); ++i) lit.set_rgb(i, file_lit.rgb(i));
        frames.push_back({.frame = 0, .shot_name = shot.name(0), .reference_hash = "none", .truth = frame_without_truth(file_lit.values.empty() ? HostImage{} : std::move(lit))});
        study.manifest["shots"].push_back(gbuffer_shot_entry(shot));
    }
    for (const std::string& note : loaded.notes) study.manifest["shots"].back()["warnings"].push_back(note);
    run_variants(study, shot, *source, frames);
}

/// Writes what is finished so far, so that a long study can be read while it runs.
void write_results(Study& study, bool is_last) {
    nlohmann::json manifest = study.manifest;
    for (const Cell& cell : study.finished)
        for (const nlohmann::json& entry : cell.images) {
            if (entry.contains("aa_floor"))
                manifest["clock"]["aa_floor"] = std::max(manifest["clock"].value("aa_floor", 0.0), entry["aa_floor"].get<double>());
            else
                manifest["images"].push_back(entry);
        }
    if (is_last) manifest["finished"] = time_stamp();
    write_text(study.settings.out / "manifest.json", manifest.dump(1) + "\n");
    write_tables(study.settings.out, study.finished);
    write_report(study.settings.out);
}

}  // namespace

void run_study(const Config& config, const RunSettings& settings) {
    Device device(settings.device);
    Study study{.config = config, .settings = settings, .device = device, .cells = CellStore(settings.out / "cells"), .progress = Progress(total_work(config)),
                .code = code_hash(), .manifest = study_entry(config, device), .finished = {}};
    for (const auto& warning : study.manifest["warnings"]) study.progress.say("warning: " + warning.get<std::string>());
    for (const ShotConfig& shot : config.shots) {
        if (shot.gbuffer.empty())
            run_scene_shot(study, shot);
        else
            run_gbuffer_shot(study, shot);
        write_results(study, &shot == &config.shots.back());
    }
    study.progress.say("\nReport: " + std::filesystem::absolute(settings.out / "report.html").lexically_normal().string());
}
