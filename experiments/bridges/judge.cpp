#include "experiments/bridges/judge.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "core/scene/load_scene.h"
#include "experiments/results/answers/answers.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/results/cells/image_path.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/verdicts/judge_rows.h"
#include "experiments/results/verdicts/study_points.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/study/config/comparisons.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/config/shots/capture_folder.h"

#include <re2/re2.h>
#include <algorithm>
#include <map>
#include <set>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

std::set<unsigned> frames_in(const fs::path& folder) {
    static const RE2 pattern(R"(f(\d{1,6})\.s0\.exr)");
    std::set<unsigned> frames;
    for (const auto& entry : fs::directory_iterator(folder)) {
        unsigned frame = 0;
        if (RE2::FullMatch(entry.path().filename().string(), pattern, &frame)) frames.insert(frame);
    }
    return frames;
}

}  // namespace

std::vector<FramesOfView> views_of_frames(const fs::path& folder, const std::string& scene,
                                          const std::vector<fs::path>& search_path) {
    static const RE2 size(R"((.+)\.([1-9]\d{0,4})x([1-9]\d{0,4}))");
    std::vector<FramesOfView> views;
    for (const auto& entry : fs::directory_iterator(folder)) {
        FramesOfView view{.folder = entry.path()};
        std::string names;
        if (!entry.is_directory() ||
            !RE2::FullMatch(entry.path().filename().string(), size, &names, &view.width, &view.height))
            continue;
        if (!scene.empty() && !names.starts_with(scene + ".")) continue;
        view.frames = frames_in(entry.path());
        if (view.frames.empty() || names.find('.') == std::string::npos) continue;
        view.name = scene.empty() ? view_name(names, entry.path(), search_path)
                                  : ViewName{.scene = scene, .camera = names.substr(scene.size() + 1)};
        views.push_back(std::move(view));
    }
    std::ranges::sort(views, {},
                      [](const FramesOfView& v) { return std::tuple(v.name.scene, v.name.camera, v.width, v.height); });
    return views;
}

namespace {

json shots_of(const JudgeSettings& settings) {
    if (!settings.capture.empty()) {
        json shot = {{"gbuffer", fs::absolute(settings.capture).string()},
                     {"reference", fs::absolute(settings.reference).string()}};
        for (const auto& [frame, folder] : capture_frames(settings.capture)) shot["frames"].push_back(frame);
        return {shot};
    }
    const std::string name = settings.scene.empty() ? "" : load_scene(settings.scene, settings.run.search_path).name;
    json shots = json::array();
    for (const FramesOfView& view : views_of_frames(settings.frames, name, settings.run.search_path)) {
        if (view.name.is_of_capture)
            fail(view.folder.string(), " holds frames of a capture; judge them with `--capture ", view.name.scene,
                 " --reference FILE.exr`, where ", view.name.scene, " is the capture's folder");
        shots.push_back({{"scene", name.empty() ? view.name.scene : settings.scene},
                         {"camera", view.name.camera},
                         {"resolution", {view.width, view.height}},
                         {"frames", view.frames}});
    }
    if (shots.empty())
        fail(settings.frames.string(), " holds no images of ", name.empty() ? "a view" : "'" + name + "'",
             "; name images SCENE.CAMERA.WIDTHxHEIGHT/fFRAME.s0.exr");
    return shots;
}

constexpr const char *judged_point = "frames", *before_point = "before";

/// The study that judges.
Config study_of(const JudgeSettings& settings, const std::string& engine) {
    json techniques = {{{"technique", "none"}, {"baseline", settings.against.empty()}},
                       {{"external", fs::absolute(settings.frames).string()},
                        {"point", judged_point},
                        {"label", fs::absolute(settings.frames).filename().string()}}};
    if (!settings.against.empty())
        techniques.push_back({{"external", fs::absolute(settings.against).string()},
                              {"point", before_point},
                              {"label", fs::absolute(settings.against).filename().string() + " (before)"},
                              {"baseline", true}});
    json study = {{"title", engine},
                  {"shots", shots_of(settings)},
                  {"techniques", techniques},
                  {"metrics", {"mse", "flip", "relmse", "cvvdp_0_5_6"}},
                  {"masks", {"all", "reflective", "edge", "roughness_0_0.1", "roughness_0.1_0.3", "roughness_0.3_0.6"}},
                  {"targets", {"specular", "image"}},
                  {"primary", {{"margin", settings.limits.margin}}},
                  {"timing", {{"frames", 0}}}};
    if (settings.capture.empty()) study["reference"] = {{"samples", settings.samples}};
    const fs::path file = settings.run.out / "judge.json";
    write_text(file, study.dump(1) + "\n");
    return read_config(file);
}

/// The images of a folder with the hashes of their bytes.
std::map<fs::path, std::string> images_in(const fs::path& folder) {
    std::map<fs::path, std::string> images;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".exr") images[fs::relative(entry.path(), folder)] = file_hash(entry.path());
    return images;
}

/// Fails if `other` lacks a frame that `folder` has: a verdict would leave it out.
void refuse_missing_frames(const fs::path& folder, const fs::path& other) {
    const auto there = images_in(other);
    for (const auto& [image, hash] : images_in(folder))
        if (image.string().ends_with(".s0.exr") && !there.contains(image))
            fail(other.string(), " lacks ", image.string(), ", which ", folder.string(),
                 " has; frames are judged against frames of the same views");
}

/// Of each shot the error over its frames, or of its only one.
std::vector<ViewError> errors_of(const fs::path& out, const PrimaryComparisons& primary) {
    std::map<std::string, std::pair<MetricSummary, MetricSummary>> rows;  // of the frames, and of no reflections
    for (const MetricSummary& r : read_rows<MetricSummary>(out / "summary.csv")) {
        if (r.metric != primary.metric || r.mask != primary.mask || r.target != primary.target) continue;
        if (r.technique != "none" && r.point != judged_point) continue;
        auto& [frames, none] = rows[r.shot];
        MetricSummary& kept = r.technique == "none" ? none : frames;
        if (kept.shot.empty() || r.frame == over_frames) kept = r;
    }
    std::vector<ViewError> errors;
    for (const auto& [shot, pair] : rows) {
        const auto& [frames, none] = pair;
        ViewError& error = errors.emplace_back(ViewError{shot, frames.value, frames.low, frames.high, {}});
        if (frames.value && none.value && *none.value > 0) error.ratio_to_none = *frames.value / *none.value;
    }
    return errors;
}

/// What the study measured, from the cells that are of it as it is: tables lack the estimates behind their intervals.
MeasuredRows rows_of_study(const fs::path& out, const json& manifest) {
    const CellStore store(out, [](const std::string& unread) { fail(unread); });
    const json stale = manifest.value("stale", json::object()).value("cells", json::array());
    std::vector<Cell> cells;
    for (const std::string& name : store.names())
        if (std::ranges::count(stale, json(name)) == 0)
            if (std::optional<Cell> cell = store.read(name)) cells.push_back(std::move(*cell));
    return rows_of(cells);
}

Judgement judgement_of(const fs::path& out, const Config& study, const JudgeLimits& limits, const std::string& name) {
    const json manifest = read_json(out / "manifest.json");
    return judge_rows(rows_of_study(out, manifest), compared_points(study.techniques), points_not_repeatable(manifest),
                      study.primary, {name, judged_point}, {name, before_point}, limits);
}

std::string error_text(const ViewError& view) {
    if (!view.error) return view.shot + ": no error: nothing reflects in this view";
    std::string text = view.shot + ": mse " + number_text(*view.error);
    if (view.low && view.high) text += " [" + number_text(*view.low) + ", " + number_text(*view.high) + "]";
    if (view.ratio_to_none) text += ", " + number_text(*view.ratio_to_none, 3) + " times that of no reflections";
    return text;
}

/// Writes no page once all is done: the verdict is not known then.
std::function<StudyAnswers(const fs::path&)> page_meanwhile(const RunSettings& run) {
    if (!run.write_report) return {};
    return [write = run.write_report](const fs::path& out) {
        return read_json(out / "manifest.json").value("is_complete", true) ? StudyAnswers{} : write(out);
    };
}

void write_page_of(const JudgeSettings& settings) {
    if (settings.run.write_report) settings.run.write_report(settings.run.out);
}

}  // namespace

JudgedFrames judge_frames(const JudgeSettings& settings) {
    const auto images = read_external_images(settings.frames, "judge");
    if (!settings.against.empty()) {
        const auto before = read_external_images(settings.against, "--against");
        if (before->name != images->name)
            fail(settings.against.string(), " holds images of '", before->name, "', ", settings.frames.string(),
                 " of '", images->name, "'; frames are judged against frames of the same renderer");
        refuse_missing_frames(settings.frames, settings.against);
        refuse_missing_frames(settings.against, settings.frames);
    }
    const Config study = study_of(settings, images->engine + " " + images->version);
    RunSettings run = settings.run;
    run.replaces = true;
    run.write_report = page_meanwhile(settings.run);
    run_study(study, run);
    JudgedFrames judged{.errors = errors_of(run.out, study.primary)};
    try {
        if (!settings.against.empty())
            judged.against = images_in(settings.frames) == images_in(settings.against)
                                 ? Judgement{.views = {}, .verdict = judgement::identical}
                                 : judgement_of(run.out, study, settings.limits, images->name);
    } catch (const Error&) {
        write_page_of(settings);
        throw;
    }
    const std::string before = settings.against.string();
    judged.text = judged.against ? verdict_text(*judged.against, study.primary, settings.limits, before)
                                 : text_without_verdict(names_of(judged.errors, error_text));
    write_verdict(run.out, judged.text, judged.against ? &*judged.against : nullptr, settings.limits);
    write_page_of(settings);
    return judged;
}
