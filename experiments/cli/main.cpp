// ssrlab: the command line.
#include "core/error.h"
#include "core/former_names.h"
#include "core/freed_memory.h"
#include "core/gpu/pipelines/shader_error.h"
#include "core/memory_fault.h"
#include "core/own_files.h"
#include "core/shown_text.h"
#include "core/terminal.h"
#include "experiments/bridges/inspect/inspect_hint.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/help_page.h"
#include "experiments/cli/request_error.h"
#include "experiments/cli/supervised.h"
#include "experiments/results/cells/host_info.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <new>
#include <set>
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

/// All commands, in the groups of `ssrlab --help`; the example of each group is that of its first command.
void add_commands(Commands& line) {
    const auto add = [&](const char* group, const std::vector<void (*)(Commands&)>& commands) {
        line.group = group;
        for (const auto command : commands) command(line);
    };
    add("Compare techniques", {add_run, add_plan, add_tradeoff, add_figures, add_tables});
    add("Look at scenes and files",
        {add_inspect, add_list, add_describe, add_needs, add_reference, add_gbuffer, add_rays});
    add("Choose and tune", {add_advise, add_tune});
    add("Write a technique", {add_new, add_watch, add_stability, add_shaders, add_export_shaders, add_record});
    add("Judge frames and images", {add_judge, add_scene_for, add_capture, add_compare});
    add("Maintain results", {add_diff, add_merge, add_report});
}

/// `ssrlab` alone and `ssrlab help` mean --help, `ssrlab help COMMAND` means `ssrlab COMMAND --help`.
std::vector<std::string> with_help_option(std::vector<std::string> words) {
    if (words.empty() || words.front() == "help") {
        if (words.size() > 2)
            fail("`ssrlab help` takes one command, not ", words.size() - 1, "; for example `ssrlab help ", words[1],
                 "`");
        if (!words.empty()) words.erase(words.begin());
        if (words == std::vector<std::string>{"help"}) words.clear();
        words.push_back("--help");
    }
    return words;
}

enum class Does { the_work, nothing };

/// Parses the words behind `ssrlab`, and does what they ask for, or nothing. Returns the exit code; fails with Error
/// on what the command line does not take.
int parse_words(std::vector<std::string> words, const std::vector<EndedPoint>& ended, Does what) {
    words = with_help_option(std::move(words));
    CLI::App app{
        "ssrlab compares screen-space reflection techniques with path-traced truth.\n"
        "Exit codes: 0 done, 1 a check that did not pass, 2 an error in the request, 3 a fault of this machine, 130 "
        "stopped by Ctrl-C.\n"
        "Scenes, studies and documents are in " +
            own_files().string() + ". Paths such as experiments/docs/quickstart.md begin there.",
        "ssrlab"};
    app.require_subcommand(1);
    app.formatter(std::make_shared<HelpPage>());
    app.set_version_flag(
        "--version", [] { return build_info().dump(); },
        "Print version, commit and the hash of all code, as manifest.json has them");
    Commands line(app);
    line.ended = ended;
    add_commands(line);
    if (!words.front().starts_with('-')) refuse_unknown_command(app, words.front());
    if (what == Does::nothing)
        for (CLI::App* command : app.get_subcommands({})) command->callback({});
    std::ranges::reverse(words);  // as CLI11 takes them
    try {
        app.parse(std::move(words));
    } catch (const CLI::Success& asked) {  // for help or the version
        return what == Does::nothing ? 0 : app.exit(asked);
    } catch (const CLI::ParseError& refusal) {
        fail(request_error(app, refusal));
    }
    return line.status;
}

/// `--check-lines`, for tests of documents: of each line of the standard input, a JSON array of the words behind
/// `ssrlab`, it prints a line with what is wrong with them, empty if nothing. Arguments of scripts are not parsed.
int check_lines() {
    for (std::string text; std::getline(std::cin, text);) try {
            parse_words(nlohmann::json::parse(text).get<std::vector<std::string>>(), {}, Does::nothing);
            std::printf("\n");
        } catch (const Error& mistake) {
            std::printf("%s\n", shown_text(mistake.what()).c_str());
        }
    return 0;
}

int parse_and_run(int argc, char** argv, const std::vector<EndedPoint>& ended) {
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) words.push_back(present_word(argv[i], words));
    refuse_other_encodings(words);
    if (words == std::vector<std::string>{"--check-lines"}) return check_lines();
    return parse_words(words, ended, Does::the_work);
}

/// Whether memory or a thread is missing, as the system says it, or Vulkan by VK_ERROR_OUT_OF_HOST_MEMORY and
/// VK_ERROR_OUT_OF_DEVICE_MEMORY.
bool is_of_memory(const std::error_code& code) {
    if (std::string_view(code.category().name()) == "vk::Result") return code.value() == -1 || code.value() == -2;
    return code == std::errc::not_enough_memory || code == std::errc::resource_unavailable_try_again;
}

int say_memory_is_short() {
    say_error(std::string("not enough memory; ") + more_memory);
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
        say_error(shown_text(e.what()));
        return 3;
    } catch (const ShaderError& e) {
        say_error(shown_lines(e.what()));
        return 2;
    } catch (const Error& e) {
        say_error(shown_text(e.what()));
        say_how_to_inspect(argc, argv, e);
        return 2;
    } catch (const std::bad_alloc&) {
        return say_memory_is_short();
    } catch (const std::filesystem::filesystem_error& e) {
        say_error(shown_text(message_text("cannot use ", e.path1().string(), ": ", e.code().message())));
        return 3;
    } catch (const std::system_error& e) {
        const std::string text = is_of_memory(e.code()) ? memory_sentence(message_text(" (", e.what(), ")")) : e.what();
        say_error(shown_text(text));
        return 3;
    } catch (const std::exception& e) {
        // oneTBB's std::runtime_error where the addresses of another thread's stack are missing.
        if (std::string_view(e.what()).starts_with("pthread_create")) return say_memory_is_short();
        say_error(shown_text(e.what()));
        return 3;
    }
}

/// Commands that run no shader of a driver, which would need a process of its own (supervised.h). `ssrlab watch`
/// renders by `ssrlab run` alone.
bool runs_no_shader(const std::vector<std::string_view>& words) {
    static const std::set<std::string_view> commands = {"watch", "help", "describe", "advise"};
    const auto has = [&](std::string_view word) { return std::ranges::count(words, word) > 0; };
    if (words.empty() || commands.contains(words.front()) || has("--help")) return true;
    return words.front() == "list" && !has("devices");
}

/// The code, or 3 if the output cannot be written.
int code_with_output(int code) {
    if (std::cout.flush() && std::fflush(stdout) == 0) return code;
    say_error("the output cannot be written: is the disk full?");
    return 3;
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(end_uncaught);
    keep_freed_memory();
    const std::vector<std::string_view> words(argv + std::min(argc, 1), argv + argc);
    const auto parse = [&](const std::vector<EndedPoint>& ended) {
        return code_with_output(exit_code_of(argc, argv, [&] { return parse_and_run(argc, argv, ended); }));
    };
    if (runs_no_shader(words)) return parse({});
    return code_with_output(exit_code_of(argc, argv, [&] { return supervised(parse, words.front() == "run"); }));
}
