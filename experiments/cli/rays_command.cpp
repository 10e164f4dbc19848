// ssrlab rays: where the mirror rays of scenes end.
#include "core/error.h"
#include "core/scene/load_scene.h"
#include "core/scene/scene_family.h"
#include "experiments/cli/commands.h"
#include "groundtruth/paths/mirror_rays.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace {

struct RaysOptions {
    std::vector<std::string> scenes;  ///< names, of which `room:*` stands for `count` from `first` on
    unsigned count = 100, first = 0;
    std::vector<unsigned> size{160, 90};
};

MirrorRayShares rays_of(const std::string& name, const RaysOptions& options, const CommonOptions& common) {
    const Scene scene = load_scene(name, scene_search_path(common.scene_path));
    const ScenePose pose = pose_scene(scene, 0.0f);
    return trace_mirror_rays(scene, pose, pose_camera(scene.cameras.front(), pose, 0.0f),
                             {options.size[0], options.size[1]}, true);
}

void print_row(const std::string& what, const MirrorRayShares& rays, bool is_first) {
    if (is_first)
        std::printf(
            "| scene | reflective pixels, %% | sees/hidden/off/behind/sky, %% | on thin things, %% | roughness | F0 |\n"
            "|---|---|---|---|---|---|\n");
    std::printf("| %s | %.0f | %.0f/%.0f/%.0f/%.0f/%.0f | %.0f | %.2f | %.3f |\n", what.c_str(), 100 * rays.reflective,
                100 * rays.seen, 100 * rays.hidden, 100 * rays.off, 100 * rays.behind, 100 * rays.sky, 100 * rays.thin,
                rays.roughness, rays.reflectance);
    std::fflush(stdout);
}

/// Of each quantity for itself; `share` in [0, 1].
MirrorRayShares quantile(const std::vector<MirrorRayShares>& all, double share) {
    MirrorRayShares found;
    for (double MirrorRayShares::*quantity :
         {&MirrorRayShares::reflective, &MirrorRayShares::seen, &MirrorRayShares::hidden, &MirrorRayShares::off,
          &MirrorRayShares::behind, &MirrorRayShares::sky, &MirrorRayShares::thin, &MirrorRayShares::roughness,
          &MirrorRayShares::reflectance}) {
        std::vector<double> values;
        for (const MirrorRayShares& rays : all) values.push_back(rays.*quantity);
        std::ranges::sort(values);
        found.*quantity = values[size_t(share * double(values.size() - 1) + 0.5)];
    }
    return found;
}

}  // namespace

static void rays_command(const RaysOptions& options, const CommonOptions& common) {
    bool is_first = true;
    const auto print = [&](const std::string& what, const MirrorRayShares& rays) {
        print_row(what, rays, std::exchange(is_first, false));
    };
    for (const std::string& name : options.scenes) {
        if (!names_several(name)) {
            print(name, rays_of(name, options, common));
            continue;
        }
        std::vector<MirrorRayShares> all;
        for (const std::string& scene : scenes_in_a_row(name, options.first, options.count))
            all.push_back(rays_of(scene, options, common));
        const std::string row = std::to_string(all.size()) + " of " + name + ", ";
        for (const int percent : {5, 25, 50, 75, 95})
            print(row + std::to_string(percent) + " %", quantile(all, percent / 100.0));
    }
}

void add_rays(Commands& line) {
    RaysOptions& rays = line.keep<RaysOptions>();
    CLI::App& command =
        line.add("rays", "Trace the mirror rays of reflective pixels, and print a table of where they end",
                 "ssrlab rays \"room:*\" --count 100");
    option(command, "scenes SCENE...", rays.scenes,
           "Scenes, each seen by its first camera; room:* stands for several rooms in a row")
        ->required();
    option(command, "--count N", rays.count, "Number of scenes that room:* stands for")
        ->check(CLI::Range(1u, largest_scene_number + 1))
        ->capture_default_str();
    option(command, "--first N", rays.first, "Number of the first of these scenes")
        ->check(CLI::Range(0u, largest_scene_number))
        ->capture_default_str();
    add_size(command, rays.size, "160 90");
    add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { rays_command(rays, line.common); });
}
