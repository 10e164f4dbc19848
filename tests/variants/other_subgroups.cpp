#include "tests/variants/other_subgroups.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>

LayeredImage written_with_vectors_of(const std::string& bits, const std::string& disabled_test) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "subgroups.exr";
    const std::string command = "LP_NATIVE_VECTOR_WIDTH=" + bits + " SSRLAB_TEST_OUTPUT=" + file.string() + " " +
                                std::filesystem::read_symlink("/proc/self/exe").string() +
                                " --gtest_also_run_disabled_tests --gtest_filter='" + disabled_test + "' >&2";
    EXPECT_EQ(std::system(command.c_str()), 0);
    const LayeredImage image = read_exr(file);
    std::filesystem::remove(file);
    return image;
}

void write_for_caller(const LayeredImage& image) {
    const char* file = std::getenv("SSRLAB_TEST_OUTPUT");
    ASSERT_TRUE(file);
    write_exr(file, image);
}
