#include "experiments/bridges/shader_export/export_description.h"

#include "core/error.h"
#include "core/files.h"
#include "core/list_text.h"
#include "experiments/bridges/shader_export/described_resources.h"
#include "experiments/bridges/shader_export/described_shader.h"
#include "experiments/bridges/shader_export/file_heads.h"
#include "experiments/results/cells/host_info.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

using nlohmann::json;

constexpr const char* vertex_file = "fullscreen.vert";

std::string file_name(size_t number, const FrameCommand& command) {
    std::string stage = command.stage;
    std::ranges::replace(stage, '/', '_');
    return (number < 10 ? "0" : "") + std::to_string(number) + "_" + stage +
           (command.recipe.is_compute ? ".comp" : ".frag");
}

const char* compare_name(DepthTest::Compare compare) {
    constexpr const char* names[] = {"less", "greater", "less or equal", "greater or equal", "equal", "always"};
    return names[size_t(compare)];  // in the order of Compare
}

void add_tests(json& step, const FrameCommand& command) {
    if (command.depth_image)
        step["depth_test"] = {{"image", command.depth_image->resource},
                              {"compare", compare_name(command.depth.compare)},
                              {"is_written", command.depth.is_written}};
    if (command.stencil_image)
        step["stencil_test"] = {{"image", command.stencil_image->resource},
                                {"writes", command.stencil.mode == Stencil::Mode::write},
                                {"value", command.stencil.value}};
}

json clear_step(const FrameCommand& command) {
    const UsedResource& what = command.targets.empty() ? command.buffers.front() : command.targets.front();
    return {{"kind", "clear"},
            {"resource", what.resource},
            {"first_mip", what.first_mip},
            {"mips", what.mips},
            {"value", command.clear_value}};
}

class Describer {
public:
    Describer(const PointConfig& point, const FramePasses& frames, const FramePasses& other)
        : point_(point),
          frames_(frames),
          other_(other),
          facts_(declared_facts(point)),
          layouts_(layouts_of(frames.frames[1])),
          lives_(frames, layouts_),
          resources_(frames, other, facts_, lives_) {}

    ShaderExport result() {
        const std::vector<FrameCommand>& frame = frames_.frames[1];
        json steps = json::array();
        for (size_t i = 0; i < frame.size(); ++i)
            steps.push_back(frame[i].is_clear() ? clear_step(frame[i]) : pass_step(i));
        for (const FrameCommand& command : frames_.frames[0])
            if (!command.is_clear() && !names_.contains(command.pipeline))
                fail("pass ", command.stage, " runs in the first frame only, which an export cannot describe");
        json description = header();
        description["fixed_images"] = resources_.take_fixed_images();
        description["inputs"] = resources_.inputs, description["images"] = resources_.images;
        description["buffers"] = resources_.buffers;
        description["steps"] = std::move(steps), description["files"] = shaders_;
        for (const FixedTexels& fixed : frames_.fixed)
            for (const json& image : description["fixed_images"])
                if (image.at("name") == fixed.image.resource)
                    files_[image.at("file")] = {reinterpret_cast<const char*>(fixed.texels.data()),
                                                fixed.texels.size()};
        files_["LICENSE"] = heads_.license();
        return {std::move(files_), std::move(description)};
    }

private:
    static std::vector<ShaderLayout> layouts_of(const std::vector<FrameCommand>& frame) {
        std::vector<ShaderLayout> layouts;
        for (const FrameCommand& command : frame)
            layouts.push_back(command.is_clear() ? ShaderLayout{} : layout_of(command.recipe));
        return layouts;
    }

    json header() const {
        const TechniqueEntry& entry = find_technique(point_.technique);
        const json build = build_info();
        return {{"ssrlab",
                 {{"version", build.at("version")}, {"commit", build.at("commit")}, {"dirty", build.at("dirty")}}},
                {"license", heads_.license_name()},
                {"technique", point_.technique},
                {"title", entry.title},
                {"source", entry.source},
                {"point", point_.point},
                {"parameters", make_technique(point_.technique, point_.parameters, point_.preset)->params.values()},
                {"screen", {frames_.screen.x, frames_.screen.y}},
                {"result",
                 {{"radiance", frames_.result.radiance},
                  {"confidence", frames_.result.confidence},
                  {"confidence_channel", frames_.result.confidence_channel}}}};
    }

    /// `place`: in the second frame.
    json pass_step(size_t place) {
        const FrameCommand& command = frames_.frames[1][place];
        const FrameCommand* const same = same_run(place, other_.frames[1]);
        if (!same) fail("pass ", command.stage, " has other shaders on another screen; choose another --size");
        const FrameCommand& elsewhere = *same;
        const ShaderLayout& layout = layouts_[place];
        json uses = json::array(), targets = json::array();
        for (size_t i = 0; i < command.samplers.size(); ++i)
            uses.push_back(resources_.image_use(command, command.samplers[i], elsewhere.samplers.at(i), layout));
        for (size_t i = 0; i < command.images.size(); ++i)
            uses.push_back(resources_.image_use(command, command.images[i], elsewhere.images.at(i), layout));
        for (size_t i = 0; i < command.buffers.size(); ++i)
            uses.push_back(resources_.buffer_use(command, command.buffers[i], elsewhere.buffers.at(i), layout));
        for (size_t i = 0; i < command.targets.size(); ++i) {
            targets.push_back(resources_.image_use(command, command.targets[i], elsewhere.targets.at(i), {}));
            targets.back()["location"] = i, targets.back()["access"] = "write";
        }
        std::sort(uses.begin(), uses.end(), [](const json& a, const json& b) { return a["binding"] < b["binding"]; });
        json step = {{"kind", command.recipe.is_compute ? "compute" : "fragment"},
                     {"stage", command.stage},
                     {"resources", uses},
                     {"targets", targets},
                     {"push_constants", described_push(command, same_run(place, frames_.frames[0]), layout)}};
        add_size(step, command, elsewhere);
        add_tests(step, command);
        step["file"] = file_of(command, layout, step);
        return step;
    }

    /// The run in another frame of the pass that the second frame runs at `place`: the first for its first run, and so
    /// on. Null if there is none.
    const FrameCommand* same_run(size_t place, const std::vector<FrameCommand>& other) const {
        const std::vector<FrameCommand>& frame = frames_.frames[1];
        const std::string& key = frame[place].pipeline;
        const auto has_key = [&](const FrameCommand& command) { return command.pipeline == key; };
        auto runs = std::count_if(frame.begin(), frame.begin() + long(place), has_key);
        for (const FrameCommand& command : other)
            if (has_key(command) && runs-- == 0) return &command;
        return nullptr;
    }

    void add_size(json& step, const FrameCommand& command, const FrameCommand& elsewhere) const {
        if (!command.recipe.is_compute) {
            const UsedResource& area = !command.targets.empty() ? command.targets.front()
                                       : command.depth_image    ? *command.depth_image
                                                                : *command.stencil_image;
            step["draw"] = {{"vertices", 3}, {"pixels", {area.extent.x, area.extent.y}}};
            return;
        }
        step["local_size"] = command.recipe.local_size;
        if (const auto found = facts_.arguments.find(command.shader); found != facts_.arguments.end()) {
            step["indirect"] = {{"buffer", found->second.buffer}, {"offset", found->second.offset}};
            return;
        }
        const glm::uvec3 groups = command.groups;
        step["groups"] = {groups.x, groups.y, groups.z};
        step["groups_share"] = resources_.share_of(glm::uvec2(groups), glm::uvec2(elsewhere.groups));
    }

    /// The name of the shader's file, which is written at its first use.
    std::string file_of(const FrameCommand& command, const ShaderLayout& layout, const json& step) {
        const auto [entry, is_new] = names_.try_emplace(command.pipeline, file_name(names_.size() + 1, command));
        if (!is_new) return entry->second;
        const StandaloneGlsl glsl = standalone_glsl(command, heads_.head_of_pass(point_, step));
        files_[entry->second] = glsl.text;
        json shader = {{"name", entry->second},
                       {"stage", command.stage},
                       {"constants", described_constants(glsl)},
                       {"blocks", described_blocks(command, layout, glsl.text)}};
        if (!command.recipe.is_compute) {
            shader["vertex"] = vertex_file;
            files_[vertex_file] = fullscreen_vertex_glsl(heads_.head_of_vertex_stage());
        }
        shaders_.push_back(std::move(shader));
        return entry->second;
    }

    const PointConfig& point_;
    const FramePasses &frames_, &other_;
    const DeclaredFacts facts_;
    const std::vector<ShaderLayout> layouts_;  ///< of the second frame
    const ResourceLives lives_;
    const FileHeads heads_;
    DescribedResources resources_;
    std::map<std::string, std::string> names_;  ///< of files, by FrameCommand::pipeline
    std::map<std::string, std::string> files_;
    json shaders_ = json::array();
};

}  // namespace

ShaderExport describe_export(const PointConfig& point, const FramePasses& frames, const FramePasses& other) {
    return Describer(point, frames, other).result();
}
