// usage: source_table ROOT OUT: writes OUT, C++ that tells the program which sources it was compiled from.
#include "core/files.h"
#include "experiments/results/cells/source_code.h"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    if (argc != 3) return 2;
    write_text(argv[2],
               "#include <string_view>\nextern const std::string_view compiled_source_table;\n"
               "const std::string_view compiled_source_table = R\"table(" +
                   source_table(read_sources(argv[1])) + ")table\";\n");
} catch (const std::exception& e) {
    std::fprintf(stderr, "source_table: %s\n", e.what());
    return 1;
}
