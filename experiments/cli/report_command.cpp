// ssrlab report: the page of a results folder.
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/report/report.h"

#include <cstdio>

static void report_command(const std::filesystem::path& folder, bool links_images) {
    write_report(folder, links_images);
    std::printf("Report: %s\n",
                shown_text(std::filesystem::absolute(folder / "report.html").lexically_normal().string()).c_str());
}

void add_report(Commands& line) {
    auto& report_folder = line.keep<std::filesystem::path>();
    CLI::App& command = line.add("report", "Write report.html again from the tables of a results folder",
                                 "ssrlab report results/quickstart");
    option(command, "results DIR", report_folder, "Results folder that `ssrlab run` or `ssrlab stability` filled")
        ->required();
    bool& links_images = line.keep<bool>();
    command.add_flag("--link-images", links_images,
                     "Keep all images in report_images/ beside the page, even if they are small");
    add_reading(command);
    command.callback([&] { report_command(report_folder, links_images); });
}
