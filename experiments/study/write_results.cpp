#include "experiments/study/write_results.h"

#include "core/files.h"
#include "core/path_inside.h"
#include "experiments/results/answers/answers.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/results/cells/provenance.h"
#include "experiments/results/cells/stale_files.h"
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/evaluation.h"
#include "experiments/results/verdicts/verdict_text.h"
#include "experiments/study/config/comparisons.h"
#include "experiments/study/manifest_entries.h"
#include "experiments/study/measuring/times/timing.h"
#include "experiments/study/parameters_table.h"
#include "experiments/study/technique_copies.h"

#include <sys/resource.h>
#include <set>

namespace {

nlohmann::json manifest_of(const StudySession& study, bool is_complete) {
    nlohmann::json manifest = study_entry(study.config);
    std::map<std::string, const Cell*> finished;
    for (const Cell& cell : study.finished) finished[cell.name] = &cell;
    // All shots first: what was timed of one is added to its entry.
    for (const PlannedShot& shot : study.plan.shots)
        if (const auto references = finished.find(shot.cells.front().name); references != finished.end()) {
            nlohmann::json& entry = manifest["shots"].emplace_back(shot.entry);
            complete_shot_entry(entry, references->second->shot);
        }
    if (!study.plan.skipped.empty()) manifest["skipped"] = study.plan.skipped;
    for (const EndedPoint& point : study.settings.ended)
        manifest["warnings"].push_back(point.technique + " " + point.point + " was left out: " + point.how);
    for (const Cell& cell : study.finished) {
        for (const nlohmann::json& entry : cell.images) manifest["images"].push_back(entry);
        for (const std::string& note : cell.notes) manifest["notes"].push_back(note);
        if (cell.timing.is_null()) continue;
        add_timing(manifest, cell.timing);
        if (cell.provenance.is_object()) manifest["clock"]["load"].back()["host"] = cell.provenance.at("host");
    }
    manifest["provenance"] = provenance_entries(study.finished);
    manifest["is_complete"] = is_complete;
    manifest["cells"] = {{"done", study.finished.size()}, {"planned", study.plan.cell_count()}};
    manifest["written"] = {{"ssrlab", study.maker["ssrlab"]}, {"at", time_stamp()}};
    return manifest;
}

/// What this run took. Overhead is all but cells, and the compilation of their shaders, which they find done.
nlohmann::json run_entry(const StudySession& study) {
    const std::map<std::string, double> seconds = study.spent.seconds();
    double all = 0, overhead = 0;
    for (const auto& [what, spent] : seconds) {
        all += spent;
        if (std::ranges::count(cell_kind_names(), what) == 0 && what != compiling) overhead += spent;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return {{"seconds", all},
            {"spent", seconds},
            {"overhead_share", all > 0 ? overhead / all : 0.0},
            {"cells_made", study.made},
            {"cells_found", study.finished.size() - study.made},
            {"peak_memory_mib", double(usage.ru_maxrss) / 1024}};
}

/// Lists what earlier versions of the study left in the folder, or removes it.
void handle_stale_files(StudySession& study, nlohmann::json& manifest, const nlohmann::json& before) {
    std::set<std::string> used;
    for (const Cell& cell : study.finished) used.insert(cell.name);
    const std::filesystem::path& out = study.settings.out;
    const StaleFiles stale = find_stale_files(out, study.cells, used, manifest, before);
    if (stale.is_empty()) return;
    if (study.settings.prunes) return remove_stale_files(out, study.cells, stale);
    manifest["stale"] = {{"cells", stale.cells}, {"images", stale.images}};
    study.progress.say("note: " + std::to_string(stale.cells.size()) + " cells and " +
                       std::to_string(stale.images.size()) + " images of earlier versions of this study stay in " +
                       out.string() + "; `ssrlab run " + path_inside(out, "study.json").string() +
                       " --out=" + out.string() + " --prune` removes them");
}

}  // namespace

StudyAnswers write_results(StudySession& study, bool is_complete, const nlohmann::json& before) {
    nlohmann::json manifest;
    const std::filesystem::path file = study.settings.out / "manifest.json";
    {
        const SpentTime::Span span(study.spent, "tables");
        manifest = manifest_of(study, is_complete);
        // Files of a point that is left out now are not old.
        if (is_complete && study.settings.ended.empty()) handle_stale_files(study, manifest, before);
        write_text(file, manifest.dump(1) + "\n");
        StudyResults results{rows_of(study.finished), manifest};
        evaluate(results, compared_points(study.config.techniques), study.config.primary);
        write_tables(study.settings.out, results);
        write_parameters(study.settings.out, study.config.techniques);
        write_technique_copies(study.settings.out, study.config.techniques);
    }
    remove_verdict(study.settings.out);  // of other numbers, as the report that is replaced or removed
    StudyAnswers answers;
    if (study.settings.write_report) {
        const SpentTime::Span span(study.spent, "report");
        answers = study.settings.write_report(study.settings.out);
    } else {
        std::error_code error;
        std::filesystem::remove(study.settings.out / "report.html", error);
    }
    manifest["run"] = run_entry(study);
    write_text(file, manifest.dump(1) + "\n");
    return answers;
}
