#include "core/error.h"
#include "experiments/report.h"
#include "tests/experiments/report_fixture.h"

#include <cstdio>

/// report_page DIR: fills DIR with the made-up results folder and its report, for the tests that look at it from outside.
int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: report_page DIR\n"), 2;
    try {
        write_report_fixture(argv[1]);
        write_report(argv[1]);
    } catch (const Error& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        return 2;
    }
}
