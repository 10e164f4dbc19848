// ssrlab capture: what a capture holds.
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/study/measuring/frames/capture.h"

#include <cstdio>

namespace {

struct CaptureCommandOptions {
    std::filesystem::path folder;
};

}  // namespace

static void capture_command(const CaptureCommandOptions& options) {
    Capture capture(options.folder);
    const ShotConfig config{.frames = capture.frames(), .gbuffer = options.folder};
    const Shot shot = capture_shot(config, capture);
    const CaptureContents contents = inspect_capture(shot, capture);
    std::printf("%s: %zu frame%s of %ux%u, %s lit colour, %s\n", shown_text(shot.scene.name).c_str(),
                config.frames.size(), config.frames.size() == 1 ? "" : "s", shot.config.extent.x, shot.config.extent.y,
                contents.has_lit ? "with a" : "without a",
                capture.environment() ? "with an environment" : "without an environment");
    std::printf("layers:");
    for (const std::string& layer : contents.layers) std::printf(" %s", layer.c_str());
    std::printf("\n");
    const unsigned last = config.frames.back();
    const bool has_before = config.frames.size() > 1;
    std::printf("frame %u:\n", last);
    for (const SceneFact& fact : list_facts(
             pixel_facts(capture.played(last, has_before ? std::optional(last - 1) : std::optional<unsigned>()))))
        std::printf("  %-18s %-10s %s\n", fact.name.c_str(), fact.value.c_str(), fact.why.c_str());
    for (const std::string& note : contents.notes) std::printf("note: %s\n", shown_text(note).c_str());
}

void add_capture(Commands& line) {
    CaptureCommandOptions& capture = line.keep<CaptureCommandOptions>();
    CLI::App& command = line.add("capture", "Check a capture of an engine's G-buffers, and list its layers",
                                 "ssrlab capture my_capture");
    option(command, "folder DIR", capture.folder,
           "Folder with gbuffer.exr and camera.json, or with one folder frame_<number> for each frame")
        ->required();
    add_reading(command);
    command.callback([&] { capture_command(capture); });
}
