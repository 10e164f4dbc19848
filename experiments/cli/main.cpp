// ssrlab: the command line.
#include "core/error.h"
#include "core/former_names.h"
#include "core/gpu/pipelines/shader_error.h"
#include "core/memory_fault.h"
#include "core/shown_text.h"
#include "experiments/bridges/inspect/inspect_hint.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/supervised.h"
#include "experiments/results/cells/host_info.h"

#include <malloc.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string_view>
#include <system_error>

namespace {

/// Results hold paths and names as JSON, which is UTF-8. A study would end before its tables.
void refuse_other_encodings(const std::vector<std::string>& words) {
    for (const std::string& word : words)
        if (!is_utf8(word)) fail("'", word, "' is not UTF-8, the only encoding of ssrlab's files; rename the path");
    std::error_code none;
    if (const std::string here = std::filesystem::current_path(none).string(); !is_utf8(here))
        fail("the path of this folder, ", here, ", is not UTF-8, the only encoding of ssrlab's files; rename it");
}

/// CLI11 reports its own mistakes; they exit with 2 as all mistakes of the user do.
int parse_and_run(int argc, char** argv, const std::vector<EndedPoint>& ended) {
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) words.push_back(present_word(argv[i], words));
    refuse_other_encodings(words);
    CLI::App app{
        "ssrlab compares screen-space reflection techniques with path-traced truth.\n"
        "Exit codes: 0 done, 2 an error in the request, 3 a fault of this machine, 130 stopped by Ctrl-C."};
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    app.set_version_flag(
        "--version", [] { return build_info().dump(); },
        "Print version, commit and the hash of all code, as manifest.json has them");
    Commands line(app);
    line.ended = ended;
    for (const auto add : {add_run,     add_plan,           add_merge,   add_report,   add_figures, add_diff,
                           add_judge,   add_scene_for,      add_tables,  add_tradeoff, add_advise,  add_tune,
                           add_compare, add_reference,      add_gbuffer, add_capture,  add_inspect, add_needs,
                           add_shaders, add_export_shaders, add_rays,    add_record,   add_watch,   add_stability,
                           add_new,     add_describe,       add_list})
        add(line);
    if (!words.empty() && !words.front().starts_with('-')) refuse_unknown_command(app, words.front());
    std::ranges::reverse(words);  // as CLI11 takes them
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    return line.status;
}

/// Whether memory or a thread is missing, as the system says it, or Vulkan by VK_ERROR_OUT_OF_HOST_MEMORY and
/// VK_ERROR_OUT_OF_DEVICE_MEMORY.
bool is_of_memory(const std::error_code& code) {
    if (std::string_view(code.category().name()) == "vk::Result") return code.value() == -1 || code.value() == -2;
    return code == std::errc::not_enough_memory || code == std::errc::resource_unavailable_try_again;
}

int say_memory_is_short() {
    std::fprintf(stderr, "error: not enough memory; %s\n", more_memory);
    return 3;
}

const std::terminate_handler usual_end = std::get_terminate();

/// Threads of drivers and libraries throw where nobody catches.
[[noreturn]] void end_uncaught() {
    try {
        if (std::current_exception()) std::rethrow_exception(std::current_exception());
    } catch (const std::bad_alloc&) {
        std::_Exit(say_memory_is_short());
    } catch (...) {  // which the usual end shows
    }
    usual_end();
    std::abort();
}

/// A mistake in a file that is there is seen best by who looks at all that is understood of it.
void say_how_to_inspect(int argc, char** argv, const Error& error) {
    if (argc > 1 && std::string_view(argv[1]) == "inspect") return;
    const std::string hint = inspect_hint(error.what());
    if (!hint.empty()) std::fprintf(stderr, "note: %s\n", shown_text(hint).c_str());
}

/// What `work` returns; of what it throws, says it and returns its exit code.
int exit_code_of(int argc, char** argv, const std::function<int()>& work) {
    try {
        return work();
    } catch (const MachineError& e) {
        std::fprintf(stderr, "error: %s\n", shown_text(e.what()).c_str());
        return 3;
    } catch (const ShaderError& e) {
        std::fprintf(stderr, "error: %s\n", shown_lines(e.what()).c_str());
        return 2;
    } catch (const Error& e) {
        std::fprintf(stderr, "error: %s\n", shown_text(e.what()).c_str());
        say_how_to_inspect(argc, argv, e);
        return 2;
    } catch (const std::bad_alloc&) {
        return say_memory_is_short();
    } catch (const std::system_error& e) {
        const std::string text = is_of_memory(e.code()) ? memory_sentence(message_text(" (", e.what(), ")")) : e.what();
        std::fprintf(stderr, "error: %s\n", shown_text(text).c_str());
        return 3;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "error: %s\n", shown_text(e.what()).c_str());
        return 3;
    }
}

/// Results of hundreds of shots are many small objects and a few large ones, which come and go. By glibc's defaults
/// each goes back to the system and is asked for again, page by page: a third of the time of `ssrlab report` of 400
/// shots.
void keep_freed_memory() {
    mallopt(M_TRIM_THRESHOLD, 1 << 28);
    mallopt(M_TOP_PAD, 1 << 24);
    mallopt(M_MMAP_THRESHOLD, 1 << 25);  // glibc's largest; the defaults come to it step by step, unless one is set
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(end_uncaught);
    keep_freed_memory();
    const std::string_view command = argc > 1 ? argv[1] : "";
    const auto parse = [&](const std::vector<EndedPoint>& ended) {
        return exit_code_of(argc, argv, [&] { return parse_and_run(argc, argv, ended); });
    };
    if (command == "watch") return parse({});  // renders by `ssrlab run` alone
    return exit_code_of(argc, argv, [&] { return supervised(parse, command == "run"); });
}
