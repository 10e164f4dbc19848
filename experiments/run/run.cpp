#include "experiments/run/run.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/run/shots/shot_cells.h"
#include "experiments/run/study_results.h"
#include "experiments/store/finished_run.h"
#include "experiments/store/folder_owner.h"
#include "experiments/store/manifest.h"

#include <unistd.h>
#include <algorithm>
#include <csignal>

namespace {

/// A first guess of what a unit of a cell takes, in seconds; what is measured corrects it (workload.h).
double guessed_seconds(const PlannedCell& cell) {
    constexpr double reference_seconds = 200, render_seconds = 1.5;  // of a million pixels
    return 1e-6 * double(cell.pixels) * (cell.kind == CellKind::references ? reference_seconds : render_seconds);
}

/// What a run before left, which may be of any version; null if it cannot be read.
nlohmann::json read_manifest_before(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    try {
        return read_json(file);
    } catch (const MachineError&) {
        throw;
    } catch (const Error&) {
        return {};
    }
}

/// What a reader wants to know first.
std::vector<std::string> lines_of(const StudyAnswers& answers) {
    std::vector<std::string> lines;
    if (!answers.over_scenes.empty()) lines.push_back("\n" + answers.over_scenes);
    for (const ShotAnswer& answer : answers.shots)
        lines.push_back("\n" + answer.shot + ": " + answer.sentence +
                        (answer.perceptual_sentence.empty() ? "" : " " + answer.perceptual_sentence));
    return lines;
}

void say_end(StudySession& study, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) study.progress.say(line);
    study.progress.say("\nReport: " +
                       std::filesystem::absolute(study.settings.out / "report.html").lexically_normal().string());
}

/// All that decides what a run of the whole study leaves.
std::string key_of_run(const StudySession& study) {
    ContentHash hash;
    hash.add(study.maker.dump()), hash.add(study.config.source.dump()), hash.add(int(study.settings.keep_all));
    for (const PlannedShot& shot : study.plan.shots)
        for (const PlannedCell& cell : shot.cells) hash.add(cell.name);
    return hash.hex();
}

/// The selected cells of all shots, and the work that they are.
void plan_work(StudySession& study, const CellSelection& selection) {
    const SpentTime::Span span(study.spent, "planning");
    study.plan = plan_study(study.config, study.device.info(), study.settings.search_path, study.settings.keep_all);
    size_t selected = 0;
    for (const PlannedShot& shot : study.plan.shots) {
        double others = 0;
        for (const PlannedCell& cell : shot.cells) {
            const bool is_times = cell.kind == CellKind::times;
            // A budget of nothing is not kept, and one of more than all is hardly used.
            const double share = std::clamp(double(study.config.timing.most_share), 0.1, 1.0);
            const double guess = is_times ? share * others : guessed_seconds(cell);
            others += cell.units * guess;
            if (!selection.holds(cell)) continue;
            ++selected;
            study.work.plan(name_of(cell.kind), kind_of_work(cell), cell.units, guess);
        }
    }
    if (selected == 0 && selection.is_shard())
        study.progress.say("note: this part of the study has no cell");
    else if (selected == 0)
        fail("--cells selects none of the ", study.plan.cell_count(), " cells of this study; `ssrlab plan ",
             study.config.file.string(), " --list` names them");
}

/// Runs the cells of one study after another, and lets results be read meanwhile.
class Runner {
public:
    Runner(StudySession& study, const CellSelection& selection)
        : study_(study), selection_(selection), before_(read_manifest_before(study.settings.out / "manifest.json")) {}

    void run() {
        if (const auto said = find_finished()) return say_end(study_, *said);
        for (const PlannedShot& shot : study_.plan.shots) {
            do_cells(study_, shot, selection_);
            if (selection_.is_all() && &shot != &study_.plan.shots.back() && are_results_due()) write(false);
        }
        if (selection_.is_all()) {
            const std::vector<std::string> lines = lines_of(write(true));
            keep_finished(lines);
            return say_end(study_, lines);
        }
        study_.progress.say(std::to_string(study_.made) + " cells done, " +
                            std::to_string(study_.finished.size() - study_.made) +
                            " found done before; `ssrlab merge` makes tables and report once all are there");
    }

private:
    /// Tables and report are of all shots so far: of a long study's time half a hundredth goes into those that
    /// it does not end with. Where nothing was made, those that are there will do.
    bool are_results_due() const {
        return study_.made > 0 && std::chrono::steady_clock::now() - written_ > 200 * took_;
    }

    /// What the run said that left the folder as it is; nothing if there is something to do, or to ask for.
    std::optional<std::vector<std::string>> find_finished() const {
        const RunSettings& settings = study_.settings;
        if (!selection_.is_all() || settings.prunes || settings.takes_times_here || settings.takes_times_again)
            return {};
        return find_finished_run(settings.out, key_of_run(study_));
    }

    /// Not with times of another machine, of which every run says so.
    void keep_finished(const std::vector<std::string>& lines) const {
        const bool has_others_times = std::ranges::any_of(study_.finished, [&](const Cell& cell) {
            return !cell.timing.is_null() && cell.provenance.at("host") != study_.maker.at("host");
        });
        if (!has_others_times) keep_finished_run(study_.settings.out, key_of_run(study_), lines);
    }

    StudyAnswers write(bool is_complete) {
        const auto start = std::chrono::steady_clock::now();
        StudyAnswers answers = write_results(study_, is_complete, before_);
        written_ = std::chrono::steady_clock::now(), took_ = written_ - start;
        return answers;
    }

    StudySession& study_;
    const CellSelection& selection_;
    nlohmann::json before_;
    std::chrono::steady_clock::time_point written_ = {};  ///< when results were last written ...
    std::chrono::steady_clock::duration took_ = {};       ///< ... and how long that took
};

/// While it lives Ctrl-C ends the program with a sentence, unless whoever started it ignores it. Nothing is lost:
/// cells are written as a whole.
class ExplainedInterrupt {
public:
    ExplainedInterrupt() {
        struct sigaction explain {};
        explain.sa_handler = [](int) {
            constexpr char text[] = "\nstopped; the same command continues where it was\n";
            [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
            _exit(130);
        };
        sigaction(SIGINT, nullptr, &before_);
        if (before_.sa_handler != SIG_IGN) sigaction(SIGINT, &explain, nullptr);
    }
    ~ExplainedInterrupt() { sigaction(SIGINT, &before_, nullptr); }
    ExplainedInterrupt(const ExplainedInterrupt&) = delete;
    ExplainedInterrupt& operator=(const ExplainedInterrupt&) = delete;

private:
    struct sigaction before_ {};
};

}  // namespace

void run_study(const Config& config, const RunSettings& settings) {
    const ExplainedInterrupt explained;
    const CellSelection selection(settings.cells);
    StudySession study(config, settings);
    const auto say = [&](const std::string& text) { study.progress.say(text); };
    const SpentTime::Span span(study.spent, "else");
    const nlohmann::json entry = study_entry(config);
    for (const auto& warning : entry["warnings"]) say("warning: " + warning.get<std::string>());
    plan_work(study, selection);
    const FolderOwner owner(settings.out, config, settings.keep_all, settings.replaces, say);
    Runner(study, selection).run();
}
