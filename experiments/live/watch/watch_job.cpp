#include "experiments/live/watch/watch_job.h"

#include "core/elapsed.h"
#include "core/files.h"
#include "core/path_inside.h"
#include "experiments/live/watch/watch_study.h"
#include "experiments/results/cells/host_info.h"

#include <limits>

namespace fs = std::filesystem;

namespace {

std::string name_of(JobKind kind) {
    using namespace watch_folder;
    const char* const names[] = {truth, coarse, now, why, times, kept};  // in the order of JobKind
    return names[size_t(kind)];
}

/// With its config written.
std::vector<std::string> arguments_of(JobKind kind, const WatchSettings& settings, const nlohmann::json& study,
                                      bool prunes) {
    const fs::path config = path_inside(settings.out, name_of(kind) + ".json");
    write_text(config, study.dump(1) + "\n");
    std::vector<std::string> arguments = {this_program().string(), "run", config.string(), "--replace"};
    arguments.push_back("--out=" + path_inside(settings.out, name_of(kind)).string());
    if (kind == JobKind::truth) arguments.push_back("--cells=references");
    if (kind != JobKind::truth && kind != JobKind::kept) arguments.push_back("--no-report");
    if (prunes) arguments.push_back("--prune");
    arguments.insert(arguments.end(), settings.run_options.begin(), settings.run_options.end());
    return arguments;
}

double patience_with(JobKind kind, double seconds) {
    return kind == JobKind::truth   ? std::numeric_limits<double>::infinity()
           : kind == JobKind::times ? 4 * seconds
                                    : seconds;
}

}  // namespace

WatchJob::WatchJob(JobKind kind, const WatchSettings& settings, const nlohmann::json& study, bool prunes)
    : kind(kind),
      results(path_inside(settings.out, name_of(kind))),
      output_(path_inside(settings.out, name_of(kind) + ".out")),
      errors_(path_inside(settings.out, name_of(kind) + ".err")),
      patience_(patience_with(kind, settings.patience)),
      program_(arguments_of(kind, settings, study, prunes), output_, errors_,
               kind == JobKind::truth ? RunningProgram::Priority::background : RunningProgram::Priority::normal) {}

uintmax_t WatchJob::said() const {
    std::error_code error;
    uintmax_t bytes = 0;
    for (const fs::path& file : {output_, errors_})
        if (const uintmax_t size = fs::file_size(file, error); !error) bytes += size;
    return bytes;
}

WatchJob::State WatchJob::state() {
    if (const auto code = program_.exit_code()) return *code == 0 ? State::done : State::failed;
    if (const uintmax_t now = said(); now != said_) said_ = now, since_ = std::chrono::steady_clock::now();
    return seconds_since(since_) > patience_ ? State::hanging : State::running;
}

std::string WatchJob::error() const {
    const std::string said = "\n" + read_text(errors_), mark = "\nerror: ";
    const size_t at = said.find(mark);  // behind lines of progress
    if (at != std::string::npos) return said.substr(at + mark.size());
    return said == "\n" ? "rendering ended without a message" : said.substr(1);
}
