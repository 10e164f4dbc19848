#include "experiments/bridges/shader_export/file_heads.h"

#include "core/files.h"
#include "core/list_text.h"
#include "core/own_files.h"
#include "experiments/results/cells/host_info.h"
#include "variants/registry.h"

using nlohmann::json;

FileHeads::FileHeads() : license_(read_text(own_files() / "LICENSE")), build_(build_info()) {}

/// Of the first line, "MIT License".
std::string FileHeads::license_name() const { return license_.substr(0, license_.find(" License")); }

std::string FileHeads::lines_of_all() const {
    const size_t copyright = license_.find("Copyright");
    const std::string holder = license_.substr(copyright, license_.find('\n', copyright) - copyright);
    const std::string commit = build_.at("commit");
    return "// SPDX-License-Identifier: " + license_name() + "\n// " + holder +
           ", see LICENSE.\n// Written by ssrlab " + build_.at("version").get<std::string>() +
           (commit.empty() ? "" : ", commit " + commit) + (build_.at("dirty") == true ? " with changes" : "") + ".\n";
}

std::string FileHeads::head_of_pass(const PointConfig& point, const json& step) const {
    std::vector<std::string> read, written;
    for (const char* part : {"resources", "targets"})
        for (const json& use : step.at(part)) {
            const std::string access = use.at("access");
            if (access.starts_with("read")) read.push_back(use.at("name"));
            if (access.ends_with("write")) written.push_back(use.at("name"));
        }
    return "// Pass " + step.at("stage").get<std::string>() + " of the technique " + point.technique + ", " +
           point.point + ".\n// Source: " + find_technique(point.technique).source +
           "\n// Reads: " + (read.empty() ? "nothing" : joined(read)) +
           ".\n// Writes: " + (written.empty() ? "nothing" : joined(written)) + ".\n" + lines_of_all();
}

std::string FileHeads::head_of_vertex_stage() const {
    return "// The vertex stage of all fragment passes: a triangle that covers the image.\n// Draw 3 vertices without "
           "vertex buffers.\n" +
           lines_of_all();
}
