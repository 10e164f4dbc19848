#include "core/error.h"
#include "core/exr/exr.h"
#include "experiments/cli/diff_command.h"
#include "experiments/report/report.h"
#include "metrics/flip.h"
#include "tests/experiments/report/report_fixture.h"
#include "tests/experiments/report/report_shots_fixture.h"
#include "tests/experiments/report/report_stability_fixture.h"
#include "tests/experiments/report/report_study_fixture.h"

#include <half.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

static HostImage exposed_halves(const char* file, float gain) {
    HostImage image = read_exr_rgb(file);
    for (float& value : image.values) value = half(value) * gain;
    return image;
}

/// For the tests that look at a report from outside:
/// report_page DIR                     fills DIR with the made-up results folder and its report
/// report_page --link DIR              the same with its images beside the page
/// report_page --study DIR             the same with the made-up study of changes, and a run of `ssrlab stability`
/// report_page --stability DIR         the same with the latter alone
/// report_page --shots COUNT DIR       the same with a made-up study of so many shots
/// report_page --diff OLD NEW FILE.html writes the page of what changed from one to another of such folders
/// report_page --halves FILE.exr X Y   prints R G B of a pixel, rounded to half floats
/// report_page --flip REF.exr TEST.exr EV   prints LDR-FLIP at this exposure, pixel by pixel, of both rounded to half
/// floats
int main(int argc, char** argv) {
    try {
        if (argc == 2) {
            write_report_fixture(argv[1]);
            write_report(argv[1]);
        } else if (argc == 3 && argv[1] == std::string("--link")) {
            write_report_fixture(argv[2]);
            write_report(argv[2], true);
        } else if (argc == 3 && argv[1] == std::string("--study")) {
            write_study_fixture(argv[2]);
            write_stability_fixture(argv[2]);
            write_report(argv[2]);
        } else if (argc == 3 && argv[1] == std::string("--stability")) {
            write_stability_fixture(argv[2]);
            write_report(argv[2]);
        } else if (argc == 4 && argv[1] == std::string("--shots")) {
            write_shots_fixture(argv[3], size_t(std::atoi(argv[2])));
            write_report(argv[3]);
        } else if (argc == 5 && argv[1] == std::string("--diff")) {
            diff_command({.before = argv[2], .after = argv[3], .csv = {}, .page = argv[4]});
        } else if (argc == 5 && argv[1] == std::string("--halves")) {
            const HostImage image = read_exr_rgb(argv[2]);
            const float* pixel = image.pixel(unsigned(std::atoi(argv[3])), unsigned(std::atoi(argv[4])));
            std::printf("%.17g %.17g %.17g\n", double(half(pixel[0])), double(half(pixel[1])), double(half(pixel[2])));
        } else if (argc == 5 && argv[1] == std::string("--flip")) {
            const float gain = std::exp2(float(std::atof(argv[4])));
            const Plane map =
                flip_map(exposed_halves(argv[2], gain), exposed_halves(argv[3], gain), default_pixels_per_degree);
            for (const double value : map.values) std::printf("%.9g\n", value);
        } else {
            std::fprintf(stderr,
                         "usage: report_page DIR | --link DIR | --study DIR | --stability DIR | --shots COUNT DIR | "
                         "--diff OLD NEW FILE.html | "
                         "--halves FILE.exr X Y | "
                         "--flip REF.exr TEST.exr EV\n");
            return 2;
        }
    } catch (const Error& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        return 2;
    }
}
