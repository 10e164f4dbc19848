// ssrlab export-shaders: a technique's passes as GLSL for an engine.
#include "core/gpu/device.h"
#include "core/list_text.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/bridges/shader_export/shader_export.h"
#include "experiments/cli/commands.h"
#include "experiments/study/config/points/all_points.h"
#include "variants/registry.h"

#include <cstdio>

namespace {

struct ExportOptions {
    std::string technique, preset;
    nlohmann::json parameters = nlohmann::json::object();
    std::filesystem::path out;
    std::vector<unsigned> size{480, 270};
};

}  // namespace

static void export_shaders_command(const ExportOptions& options, const CommonOptions& common) {
    const ExportRequest request{.point = single_point(options.technique, options.preset, options.parameters),
                                .screen = {options.size[0], options.size[1]},
                                .scene_path = scene_search_path(common.scene_path)};
    make_technique(request.point.technique, request.point.parameters, request.point.preset);  // or says what is wrong
    check_export_folder(options.out);
    Device device(common.device);
    const size_t shaders = export_shaders(device, request, options.out);
    const std::string folder = shown_text(options.out.string());
    std::printf("%s: %s of %s. Read %s\n", folder.c_str(), counted(shaders, "shader").c_str(),
                request.point.technique.c_str(), shown_text((options.out / "README.md").string()).c_str());
}

void add_export_shaders(Commands& line) {
    ExportOptions& exported = line.keep<ExportOptions>();
    CLI::App& command = line.add(
        "export-shaders",
        "Write a technique's passes for an engine: one self-contained GLSL file for each pass, and a description of "
        "bindings, images, buffers and dispatches",
        "ssrlab export-shaders composed_ssr --out composed_shaders");
    option(command, "technique NAME", exported.technique,
           "Technique (see: ssrlab list techniques), or its folder, written with a /")
        ->required();
    option(command, "--out DIR", exported.out, "New or empty folder, or that of an earlier export, which is replaced")
        ->required();
    add_values(command, exported.preset, exported.parameters);
    add_size(command, exported.size, "480 270. Of the screen in the description; the shaders fit every screen");
    add_device(command, line.common), add_scene_path(command, line.common);
    command.callback([&] { export_shaders_command(exported, line.common); });
}
