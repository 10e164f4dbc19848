// The `main` of each test program.
#include "core/freed_memory.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>

/// Each run has a temporary folder of its own: ctest runs suites side by side, and their tests may choose the same
/// names.
int main(int argc, char** argv) {
    keep_freed_memory();
    testing::InitGoogleTest(&argc, argv);
    std::string folder = std::filesystem::temp_directory_path() / "ssrlab_XXXXXX";
    if (!mkdtemp(folder.data())) {
        std::cerr << "cannot make the folder " << folder << ": " << std::strerror(errno) << "\n";
        return EXIT_FAILURE;
    }
    setenv("TMPDIR", folder.c_str(), 1);
    const int failed = RUN_ALL_TESTS();
    std::filesystem::remove_all(folder);
    return failed;
}
