#pragma once
#include "core/files.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace fs = std::filesystem;

struct Outcome {
    int code;
    std::string text;
};

/// `ssrlab` in a temporary folder with a cache of its own.
struct CommandLine : testing::Test {
    fs::path folder = fs::temp_directory_path() / "command_test";

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    Outcome ssrlab(const std::string& arguments, const std::string& before = "") {
        const std::string command = "cd '" + folder.string() + "'; " + before + " SSRLAB_CACHE='" + folder.string() +
                                    "/cache' '" SSRLAB_PROGRAM "' " + arguments + " 2>&1";
        FILE* pipe = popen(command.c_str(), "r");
        std::string text;
        char buffer[512];
        while (std::fgets(buffer, sizeof buffer, pipe)) text += buffer;
        return {WEXITSTATUS(pclose(pipe)), text};
    }
    void expect_mistake(const std::string& arguments, const std::string& says) {
        const Outcome o = ssrlab(arguments);
        EXPECT_EQ(o.code, 2) << o.text;
        EXPECT_NE(o.text.find(says), std::string::npos) << arguments << "\n" << o.text;
        std::string text = o.text;
        if (const size_t hint = text.find("note: `ssrlab inspect "); hint != std::string::npos)
            text.erase(hint, text.find('\n', hint) + 1 - hint);
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << "one sentence, not: " << o.text;
    }
    void config(const std::string& text) { write_text(folder / "study.json", text); }
};
