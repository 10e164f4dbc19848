// ssrlab advise: which technique to use, from a table of studies, and making this table.
#include "core/error.h"
#include "core/files.h"
#include "core/own_files.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/gpu_costs/chips/chip_rates.h"
#include "experiments/results/advice/advice_answer.h"

#include <iostream>

namespace {

struct AdviseOptions {
    AdviceQuestion question;
    bool is_moving = false, is_at_rest = false;
    std::filesystem::path table = own_files() / "experiments/studies/advice.csv", json;
    std::vector<std::filesystem::path> studies, costs_from;
    std::filesystem::path keep;

    bool makes_table() const { return !studies.empty() || !costs_from.empty() || !keep.empty(); }
};

void make_table(const AdviseOptions& options) {
    if (options.studies.empty() || options.costs_from.empty() || options.keep.empty())
        fail("a table needs --study, --costs-from and --keep together; leave them out to ask a question");
    if (options.keep.extension() != ".csv") fail("--keep ", options.keep.string(), " must end in .csv");
    const auto read = [](const std::vector<std::filesystem::path>& folders) {
        std::vector<StudyResults> studies;
        for (const std::filesystem::path& folder : folders)
            studies.push_back(read_study_results(folder, Runs::left_out));
        return studies;
    };
    const Advice advice = make_advice(read(options.studies), read(options.costs_from));
    write_advice(options.keep, advice);
    std::cout << shown_text(options.keep.string()) << ": " << advice.rows.size() << " rows\n";
}

}  // namespace

static void advise_command(const AdviseOptions& options) {
    if (options.makes_table()) return make_table(options);
    if (options.is_moving && options.is_at_rest) fail("--motion and --rest exclude each other; leave one of them out");
    AdviceQuestion question = options.question;
    question.chip = chip_named(question.chip);
    question.movement = options.is_moving ? "in motion" : options.is_at_rest ? "at rest" : "";
    const Advice advice = read_advice(options.table);
    const std::string answer = advice_answer(advice, question);
    if (options.json != "-") std::cout << answer;
    if (options.json.empty()) return;
    const std::string points = advised_points(advice, question).dump(2) + "\n";
    if (options.json == "-")
        std::cout << points;
    else
        write_text(options.json, points);
}

void add_advise(Commands& line) {
    AdviseOptions& advise = line.keep<AdviseOptions>();
    CLI::App& command = line.add(
        "advise", "Name the technique and parameters of least error within a time on a GPU, from a table of studies",
        "ssrlab advise --chip navi21 --ms 1 --place room --motion");
    option(command, "--chip NAME", advise.question.chip,
           "Chip or product, such as navi21 or \"RX 6800 XT\"; default: all of the table, in short");
    option(command, "--ms MS", advise.question.ms,
           "Time that reflections may take at 1920x1080; default: all of the table, in short")
        ->check(positive());
    option(command, "--place NAME", advise.question.place, "room or street; default: both");
    command.add_flag("--motion", advise.is_moving, "The camera or things move; default: both at rest and in motion");
    command.add_flag("--rest", advise.is_at_rest, "Nothing moves; not together with --motion");
    option(command, "--surface NAME", advise.question.surface,
           "Surfaces whose error counts; all: everything that reflects")
        ->check(name_among({"all", "mirrors", "glossy", "rough"}))
        ->capture_default_str();
    option(command, "--json FILE", advise.json,
           "Also write the points of least error as the \"techniques\" of a study; -: print them alone");
    option(command, "--table FILE.csv", advise.table, "Table to ask; default: the included table");
    option(command, "--study DIR", advise.studies,
           "Makes a table: results folders of studies of errors, whose groups of shots are as \"rooms, at rest\"");
    option(command, "--costs-from DIR", advise.costs_from,
           "Makes a table: results folders with estimated times of the same points, each of its own chips");
    option(command, "--keep FILE.csv", advise.keep,
           "Makes a table: file to write, with a file of the same name in .json that says what it rests on");
    add_reading(command);
    command.callback([&] { advise_command(advise); });
}
