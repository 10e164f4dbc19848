#include "experiments/bridges/shader_export/export_page.h"

#include "core/list_text.h"

#include <algorithm>

namespace {

using nlohmann::json;

std::string text_of(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// A row of a table. A bar would end a cell, and a line of GLSL may have one.
std::string row(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (std::string cell : cells) {
        for (size_t at = 0; (at = cell.find('|', at)) != std::string::npos; at += 2) cell.insert(at, "\\");
        line += ' ' + cell + " |";
    }
    return line + '\n';
}

std::string table(const std::vector<std::string>& titles) {
    return '\n' + row(titles) + row(std::vector<std::string>(titles.size(), "---"));
}

std::string code(const json& value) { return "`" + text_of(value) + "`"; }

std::string size_of(const json& image) {
    const std::string share = image.at("share");
    return share.empty() ? text_of(image.at("size").at(0)) + " x " + text_of(image.at("size").at(1)) : share;
}

std::string yes(const json& is_so) { return is_so == true ? "yes" : ""; }

std::string dispatch_of(const json& step) {
    if (step.at("kind") == "fragment")
        return "Draws a triangle over " + step.at("draw").at("pixels")[0].dump() + " x " +
               step["draw"]["pixels"][1].dump() + " pixels.";
    const json& local = step.at("local_size");
    const std::string size =
        " A workgroup has " + local[0].dump() + " x " + local[1].dump() + " x " + local[2].dump() + " invocations.";
    if (step.contains("indirect"))
        return "Indirect dispatch: the buffer " + code(step["indirect"]["buffer"]) +
               " holds the three numbers of workgroups from byte " + step["indirect"]["offset"].dump() + " on." + size;
    const json& groups = step.at("groups");
    const std::string share = step.at("groups_share");
    const std::string count = groups[0].dump() + " x " + groups[1].dump() + " x " + groups[2].dump();
    const bool is_fixed = share.find('W') == std::string::npos;
    return "Workgroups: " + count + (is_fixed ? " on every screen." : ", which is " + share + ".") + size;
}

std::string mips_of(const json& use) {
    const unsigned first = use.at("first_mip"), count = use.at("mips");
    return count == 1 ? "mip " + std::to_string(first)
                      : "mips " + std::to_string(first) + " to " + std::to_string(first + count - 1);
}

std::string resources_of(const json& step) {
    std::string text = table({"set", "binding", "name", "GLSL type", "format", "size", "access", "holds"});
    for (const json& use : step.at("resources")) {
        const bool is_buffer = use.at("type") == "buffer";
        std::string holds = use.at("name") == use.at("resource") ? "" : code(use.at("resource"));
        if (use.contains("side"))
            holds += (holds.empty() ? "" : ", ") + use["side"].get<std::string>() + " side of the history";
        if (use.contains("first_mip")) holds += (holds.empty() ? "" : ", ") + mips_of(use);
        std::string access = use.at("access");
        if (use.value("filter", "") == "linear") access += ", linear filter";
        text += row({use["set"].dump(), use["binding"].dump(), code(use["name"]), use["type"],
                     is_buffer ? use["layout"].get<std::string>() : use["format"].get<std::string>(),
                     is_buffer ? use["share"].get<std::string>() + " bytes" : size_of(use), access, holds});
    }
    for (const json& use : step.value("targets", json::array()))
        text += row({"", "location " + use["location"].dump(), code(use["name"]), "attachment", use["format"],
                     size_of(use), "write", use["name"] == use["resource"] ? "" : code(use["resource"])});
    return text;
}

std::string push_of(const json& step) {
    if (step.at("push_constants").empty()) return "";
    std::string text = "\nPush constants:\n" + table({"offset", "name", "type", "value", "changes each frame"});
    for (const json& push : step["push_constants"])
        text += row({push["offset"].dump(), code(push["name"]), push["type"], push["value"].dump(),
                     yes(push["changes_each_frame"])});
    return text;
}

std::string tests_of(const json& step) {
    std::string text;
    if (step.contains("depth_test"))
        text += "\nDepth test with " + code(step["depth_test"]["image"]) + ": " +
                text_of(step["depth_test"]["compare"]) +
                (step["depth_test"]["is_written"] == true ? ", written.\n" : ", not written.\n");
    if (step.contains("stencil_test"))
        text += "\nStencil with " + code(step["stencil_test"]["image"]) +
                (step["stencil_test"]["writes"] == true ? ": writes " : ": keeps pixels that equal ") +
                step["stencil_test"]["value"].dump() + ".\n";
    return text;
}

std::string steps_of(const json& description) {
    std::string text = "\n## Which passes run, in which order?\n";
    size_t number = 0;
    for (const json& step : description.at("steps")) {
        const std::string title = "\n### " + std::to_string(++number) + ". ";
        if (step.at("kind") == "clear") {
            text += title + "clear " + text_of(step["resource"]) + "\n\nSets all of " + code(step["resource"]) +
                    " to " + text_of(step["value"]) + ".\n";
            continue;
        }
        text += title + text_of(step.at("stage")) + "\n\nFile: " + code(step.at("file")) + ". " + dispatch_of(step) +
                '\n' + resources_of(step) + push_of(step) + tests_of(step);
    }
    return text;
}

std::string inputs_of(const json& description) {
    std::string text = R"(
## What must the engine supply?

The engine writes these images before the first pass. Formats are those of ssrlab; shaders read floats of any format.
)" + table({"name", "format", "size", "meaning"});
    for (const json& input : description.at("inputs"))
        text += row({code(input["name"]), input["format"], size_of(input),
                     input["meaning"] == "" ? "see the shaders that read it" : input["meaning"].get<std::string>()});
    if (description.at("fixed_images").empty()) return text;
    text += R"(
These images never change. A file holds the texels in the format, row by row, the top row first.
)" + table({"name", "format", "size", "file"});
    for (const json& image : description["fixed_images"])
        text += row({code(image["name"]), image["format"], size_of(image), code(image["file"])});
    return text;
}

std::string own_resources_of(const json& description) {
    std::string text = R"(
## Which images and buffers does the technique own?

A history has two sides. Before each frame the engine exchanges them: the current side becomes the previous side.
Histories, and all that is kept between frames, begin with zeros.
)" + table({"name", "format", "size", "mips", "history", "kept between frames"});
    for (const json& image : description.at("images"))
        text += row({code(image["name"]), image["format"], size_of(image), image["mips"].dump(),
                     yes(image["is_history"]), yes(image["is_kept"])});
    if (description.at("buffers").empty()) return text;
    text += table({"buffer", "bytes", "kept between frames"});
    for (const json& buffer : description["buffers"])
        text += row({code(buffer["name"]), buffer["share"], yes(buffer["is_kept"])});
    return text;
}

std::string result_of(const json& description) {
    const json& result = description.at("result");
    const char channel = "rgba"[result.at("confidence_channel").get<size_t>()];
    return "\n## What is the result?\n\nChannels rgb of " + code(result.at("radiance")) +
           " hold the reflected radiance, before the BRDF.\nChannel " + std::string(1, channel) + " of " +
           code(result.at("confidence")) +
           " holds the confidence: 1 where that radiance counts, 0 where the engine's other reflections count.\n";
}

std::string block_of(const json& block) {
    const std::string name = block.at("name");
    size_t unread = 0;
    std::string text = table({"offset", "member", "type", "value", "unit", "meaning"});
    for (const json& member : block.at("members")) {
        const bool is_array = member.contains("stride");
        if (member["is_read"] == false && block["layout"] == "std140") {
            ++unread;
            continue;
        }
        text += row({member["offset"].dump() + (is_array ? " + " + member["stride"].dump() + " i" : ""),
                     code(member["name"]), member["type"], member.contains("value") ? text_of(member["value"]) : "",
                     member.value("unit", ""), member["meaning"]});
    }
    text = "\n" + code(block["name"]) + ", " + text_of(block["layout"]) + ", set 0, binding " +
           block["binding"].dump() +
           (block["changes_each_frame"] == true && name == "Camera" ? ", written each frame" : "") + ":\n" + text;
    if (unread > 0)
        text += "\n" + counted(unread, "more member") + " of the block " + (unread == 1 ? "is" : "are") +
                " not read with these values.\n";
    return text;
}

std::string shaders_of(const json& description) {
    std::string text = "\n## Which blocks and constants do the shaders have?\n";
    for (const json& shader : description.at("files")) {
        text += "\n### " + text_of(shader.at("name")) + '\n';
        for (const json& block : shader.at("blocks")) text += block_of(block);
        if (shader.at("constants").empty()) continue;
        text += "\nSpecialization constants. The text holds these values, so a pipeline needs to set none:\n" +
                table({"id", "constant", "value", "meaning"});
        for (const json& constant : shader["constants"])
            text += row({constant["id"].dump(), code(constant["name"]),
                         constant.contains("parameter_value") ? text_of(constant["parameter_value"])
                                                              : text_of(constant["value"]),
                         constant.value("meaning", "a fact about the scene")});
    }
    return text;
}

}  // namespace

std::string export_page(const json& description) {
    const json &screen = description.at("screen"), &ssrlab = description.at("ssrlab");
    const std::string commit = ssrlab.at("commit");
    return "# The passes of " + text_of(description.at("technique")) + "\n\n" + text_of(description.at("title")) +
           ".\nParameters: " + text_of(description.at("point")) + ".\nSource: " + text_of(description.at("source")) +
           "\n\nssrlab " + text_of(ssrlab.at("version")) + (commit.empty() ? "" : ", commit " + commit) +
           ", wrote this folder. The licence is " + text_of(description.at("license")) +
           R"(, see [LICENSE](LICENSE).
[passes.json](passes.json) has the same content for programs.

The shaders are GLSL 4.60 for Vulkan 1.2 or newer. All resources are in descriptor set 0.
Storage images have no format in the text, so the device needs the feature `shaderStorageImageWriteWithoutFormat`.

W and H are the width and height of the screen in pixels.
)" + "Numbers without W and H, and values of push constants, are those of a test scene with " +
           screen[0].dump() + " x " + screen[1].dump() + " pixels.\n" + inputs_of(description) +
           own_resources_of(description) + result_of(description) + steps_of(description) + shaders_of(description);
}
