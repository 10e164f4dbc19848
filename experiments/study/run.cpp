#include "experiments/study/run.h"

#include "core/elapsed.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/scene/load_scene.h"
#include "core/signal_actions.h"
#include "experiments/results/answers/answers.h"
#include "experiments/results/cells/finished_run.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/study/folder_owner.h"
#include "experiments/study/manifest_entries.h"
#include "experiments/study/measuring/costs/gpu_estimates.h"
#include "experiments/study/plan/cell_selection.h"
#include "experiments/study/plan/estimate.h"
#include "experiments/study/plan/expected_time.h"
#include "experiments/study/plan/ranking_warnings.h"
#include "experiments/study/shots/shot_cells.h"
#include "experiments/study/write_results.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstring>
#include <map>
#include <optional>

namespace {

/// A first guess of what a unit of a cell takes, in seconds; what is measured corrects it (workload.h).
double guessed_seconds(const PlannedCell& cell, const Config& config) {
    constexpr double sample_seconds = 0.6, render_seconds = 1.5;  // of a million pixels
    const double megapixels = 1e-6 * double(cell.pixels);
    if (cell.kind != CellKind::references) return megapixels * render_seconds;
    if (!config.has_reference) return megapixels * render_seconds;
    const ReferenceSettings& reference = config.reference;
    const double samples = reference.max_samples > 0 ? reference.max_samples : ReferenceSettings::default_samples,
                 traced =
                     megapixels * sample_seconds * (samples * (1 + reference.adaptive_share) + reference.guide_samples);
    return reference.max_seconds > 0 ? std::min(traced, reference.max_seconds) : traced;
}

/// Of selected cells that are not there, by calibration: seconds by name, as in StudyEstimate. Nothing where a guess
/// says that the study is short, which is not worth ten seconds or more.
std::optional<StudyEstimate> estimate_long_study(StudySession& study, double guess) {
    constexpr double error_of_guess = 4;  // rooms have twice to four times the guess
    // Where a shader ended the process, the study was named before.
    if (guess * error_of_guess <= study.settings.names_after || !study.settings.ended.empty()) return {};
    study.progress.say("Estimating what this study takes ...");
    return estimate_study(study.device, study.config, study.plan, study.settings);
}

/// The sentence on a study that takes long; who gave a range of frames by mistake sees so.
void name_long_study(StudySession& study, const ExpectedTime& time) {
    if (time.seconds <= study.settings.names_after) return;
    study.progress.say("This study takes " + with_range(time.seconds, range_of_seconds(time.seconds)) +
                       ". What takes the time is shown by:");
    study.progress.say("  " + command_line("plan", study.config, study.settings));
    if (study.settings.confirm && !study.settings.confirm())
        fail("the study was not started; `ssrlab plan` shows what takes its time");
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
    for (const std::string& sentence : {answers.in_these_scenes, answers.in_scenes_like_these})
        if (!sentence.empty()) lines.insert(lines.end(), {"", sentence});
    if (answers.shots.size() > most_told_shots) {
        lines.insert(lines.end(),
                     {"", "The report answers for each of the " + std::to_string(answers.shots.size()) + " shots."});
        return lines;
    }
    for (const ShotAnswer& answer : answers.shots)
        lines.insert(lines.end(),
                     {"", answer.shot + ": " + answer.sentence +
                              (answer.perceptual_sentence.empty() ? "" : " " + answer.perceptual_sentence)});
    return lines;
}

std::string report_file(const StudySession& study) {
    return std::filesystem::absolute(study.settings.out / "report.html").lexically_normal().string();
}

void say_end(StudySession& study, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) study.progress.say(line);
    if (!study.settings.write_report) return;
    study.progress.say("");
    study.progress.say("Report: " + report_file(study));
}

/// All that decides what a run of the whole study leaves.
std::string key_of_run(const StudySession& study) {
    ContentHash hash;
    hash.add(study.maker.dump()), hash.add(study.config.source.dump()), hash.add(int(study.settings.keep_all));
    hash.add(int(bool(study.settings.write_report)));
    for (const PlannedShot& shot : study.plan.shots)
        for (const PlannedCell& cell : shot.cells) hash.add(cell.name);
    return hash.hex();
}

/// The selected cells of all shots, and the work that they are.
void plan_work(StudySession& study, const CellSelection& selection) {
    const SpentTime::Span span(study.spent, "planning");
    study.plan = plan_study(study.config, study.device.info(), study.settings.search_path, study.settings.keep_all);
    std::map<const PlannedCell*, double> guesses;  // of the selected cells
    double to_do = 0;
    for (const PlannedShot& shot : study.plan.shots) {
        double others = 0;
        for (const PlannedCell& cell : shot.cells) {
            const bool is_times = cell.kind == CellKind::times;
            // A budget of nothing is not kept, and one of more than all is hardly used.
            const double share = std::clamp(double(study.config.timing.most_share), 0.1, 1.0);
            const double guess = is_times ? share * others : cell.units * guessed_seconds(cell, study.config);
            others += guess;
            if (!selection.holds(cell)) continue;
            guesses[&cell] = guess;
            if (!std::filesystem::exists(study.cells.file(cell.name))) to_do += guess;
        }
    }
    if (guesses.empty() && selection.is_shard())
        study.progress.say("note: this part of the study has no cell");
    else if (guesses.empty())
        fail("--cells selects none of the ", study.plan.cell_count(), " cells of this study; `",
             command_line("plan", study.config, study.settings), " --list` names them");
    const std::optional<StudyEstimate> estimate = estimate_long_study(study, to_do);
    ExpectedTime time;
    for (auto& [cell, guess] : guesses) {
        if (estimate) {
            guess = estimate->cells.at(cell->name).seconds;
            if (!std::filesystem::exists(study.cells.file(cell->name))) time.seconds += guess;
        }
        study.work.plan(name_of(cell->kind), kind_of_work(*cell), cell->units, guess / std::max(cell->units, 1e-9));
    }
    name_long_study(study, time);
}

/// Runs the cells of one study after another, and lets results be read meanwhile.
class Runner {
public:
    Runner(StudySession& study, const CellSelection& selection)
        : study_(study), selection_(selection), before_(read_manifest_before(study.settings.out / "manifest.json")) {}

    void run() {
        if (const auto said = find_finished()) return say_end(study_, *said);
        for (const PlannedShot& shot : study_.plan.shots) {
            do_cells(study_, shot, selection_, [&] {
                if (selection_.is_all() && are_results_due()) write_meanwhile();
            });
        }
        if (selection_.is_all()) {
            const std::vector<std::string> lines = lines_of(write(true));
            keep_finished(lines);
            return say_end(study_, lines);
        }
        study_.progress.say(std::to_string(study_.made) + " cells done, " +
                            std::to_string(study_.finished.size() - study_.made) +
                            " found done before; once all are there, tables and report are made by:");
        study_.progress.say("  " + command_line("merge", study_.config, study_.settings));
    }

private:
    /// Tables and report are of all cells so far: soon after the start for who looks on, then for a twenty-fifth of the
    /// time in the first ten minutes, and for half a hundredth of a long study's. Where nothing was made, those that
    /// are there will do.
    bool are_results_due() const {
        const double pause = took_ * (seconds_since(start_) < 600 ? 25 : 200);
        return study_.made > 0 && seconds_since(written_) > std::max(study_.settings.report_after, pause);
    }

    void write_meanwhile() {
        write(false);
        if (study_.settings.write_report && !std::exchange(has_said_where_, true))
            study_.progress.say("The report so far: " + report_file(study_) + " (it fills while the study runs)");
    }

    /// What the run said that left the folder as it is; nothing if there is something to do, or to ask for.
    std::optional<std::vector<std::string>> find_finished() const {
        const RunSettings& settings = study_.settings;
        if (!selection_.is_all() || settings.prunes || settings.takes_times_here || settings.takes_times_again)
            return {};
        return find_finished_run(settings.out, key_of_run(study_));
    }

    /// Not with times of another machine, of which every run says so, nor where every run asks a compiler again or
    /// tries a point again that was left out.
    void keep_finished(const std::vector<std::string>& lines) const {
        const bool has_more_to_say =
            !study_.settings.ended.empty() || std::ranges::any_of(study_.finished, [&](const Cell& cell) {
                return (!cell.timing.is_null() && cell.provenance.at("host") != study_.maker.at("host")) ||
                       !refusal_in(cell.compiled).empty() || !refusal_in(cell.estimates).empty();
            });
        if (!has_more_to_say) keep_finished_run(study_.settings.out, key_of_run(study_), lines);
    }

    StudyAnswers write(bool is_complete) {
        const auto start = std::chrono::steady_clock::now();
        StudyAnswers answers = write_results(study_, is_complete, before_);
        took_ = seconds_since(start), written_ = std::chrono::steady_clock::now();
        study_.work.add_overhead(took_);
        return answers;
    }

    StudySession& study_;
    const CellSelection& selection_;
    nlohmann::json before_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point written_ = start_;  ///< when results were last written ...
    double took_ = 0;                                         ///< ... and the seconds that it took
    bool has_said_where_ = false;                             ///< the report of a study that is not done yet
};

/// The end by Ctrl-C, and by SIGTERM as batch systems send it at a job's time limit, with a sentence. Nothing is lost:
/// cells are written as a whole.
struct sigaction explained_end() {
    struct sigaction explain {};
    explain.sa_handler = [](int signal) {
        constexpr char text[] = "\nstopped; the same command continues where it was\n";
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
        _exit(128 + signal);
    };
    return explain;
}

Config without_ended(Config config, const std::vector<EndedPoint>& ended) {
    for (const EndedPoint& point : ended)
        for (PointConfig& found : config.techniques) {
            if (found.technique != point.technique || found.point != point.point) continue;
            if (found.is_baseline)
                fail_machine(found.technique, " ", found.point, ", with which all points are compared: ", point.how);
            found.how_it_ended = point.how;
        }
    return config;
}

std::string listed(const std::vector<EndedPoint>& ended) {
    std::string text;
    for (const EndedPoint& point : ended)
        text += (text.empty() ? "" : ", and of ") + point.technique + " " + point.point + " (" + point.how + ")";
    return text;
}

/// As a POSIX shell takes it for one word.
std::string quoted(const std::string& text) {
    const auto is_plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("_-./:=,@%+", c); };
    if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
}

}  // namespace

std::string command_line(const std::string& command, const Config& config, const RunSettings& settings) {
    const auto whole = [](const std::filesystem::path& path) {
        return std::filesystem::absolute(path).lexically_normal().string();
    };
    std::vector<std::string> words = {this_program().string(), command, whole(config.file),
                                      "--out=" + whole(settings.out)};
    if (settings.keep_all) words.push_back("--keep-all");
    if (!settings.device.empty()) words.push_back("--device=" + settings.device);
    const std::vector<std::filesystem::path> usual = scene_search_path();
    for (const std::filesystem::path& folder : settings.search_path)
        if (!std::ranges::count(usual, folder)) words.push_back("--scene-path=" + whole(folder));
    if (command == "run" && !settings.cells.empty()) {
        words.push_back("--cells=");
        for (const std::string& term : settings.cells)
            words.back() += (&term == &settings.cells.front() ? "" : ",") + term;
    }
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
    return line;
}

void run_study(const Config& asked, const RunSettings& settings) {
    const SignalActions explained(std::array{SIGINT, SIGTERM}, explained_end());
    const CellSelection selection(settings.cells);
    const Config config = without_ended(asked, settings.ended);
    StudySession study(config, settings);
    const auto say = [&](const std::string& text) { study.progress.say(text); };
    const SpentTime::Span span(study.spent, "else");
    const nlohmann::json entry = study_entry(config);
    for (const auto& warning : entry["warnings"]) say("warning: " + warning.get<std::string>());
    plan_work(study, selection);
    for (const std::string& warning : ranking_warnings(config, study.plan)) say("warning: " + warning);
    for (const GpuCompilers::Entry& compiler : study.plan.compilers.entries)
        if (!compiler.refusal.empty())
            say("warning: compiled.csv gets no numbers of " + compiler.chip.name + ": " + compiler.refusal);
    const FolderOwner owner(settings.out, config, settings.keep_all, settings.replaces, say);
    Runner(study, selection).run();
    if (!settings.ended.empty())
        fail_machine("the study has no results of ", listed(settings.ended),
                     "; the same command tries again, once the shader or the driver is corrected");
}
