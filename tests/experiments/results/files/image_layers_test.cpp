// What readers are told of the layers of image files is what ssrlab writes.
#include "experiments/results/files/image_layers.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/scene/load_scene.h"
#include "groundtruth/reference/reference_file.h"

#include <gtest/gtest.h>
#include <regex>
#include <set>

namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

/// Names with their channels.
Names stated(std::initializer_list<std::span<const DescribedLayer>> with_noise,
             std::initializer_list<std::span<const DescribedLayer>> alone) {
    Names names;
    for (const auto& layers : with_noise)
        for (const DescribedLayer& layer : layers)
            for (const char* part : {"", ".a", ".b", ".variance"})
                names.insert(std::string(layer.name) + part + " " + layer.channels);
    for (const auto& layers : alone)
        for (const DescribedLayer& layer : layers) names.insert(std::string(layer.name) + " " + layer.channels);
    return names;
}

Names written(bool has_ladder) {
    const fs::path file = fs::temp_directory_path() / "image_layers_test.exr";
    const Scene scene = load_scene("fence", {fs::path(SSRLAB_SOURCE_DIR) / "scenes"});
    const ScenePose pose = pose_scene(scene, 0);
    const ReferenceSettings settings{.max_samples = 16, .adaptive_share = 1, .ladder = has_ladder};
    Reference reference = render_reference(scene, pose, pose_camera(scene.cameras.front(), pose, 0), {8, 4}, settings);
    write_reference(file, reference, settings);
    Names names;
    for (const Layer& layer : read_exr(file).layers) names.insert(layer.name + " " + layer.channel_names);
    fs::remove(file);
    return names;
}

}  // namespace

TEST(ImageLayers, OfReferencesAreThoseOfTheFile) {
    const ReferenceLayers l = reference_layers();
    EXPECT_EQ(written(false), stated({l.estimates}, {l.others}));
    EXPECT_EQ(written(true), stated({l.estimates, l.rungs}, {l.others, l.of_rungs}));
}

TEST(ImageLayers, KindsOfResultsAreThoseThatTheSourceNames) {
    const std::string source = read_text(fs::path(SSRLAB_SOURCE_DIR) / "experiments/study/shots/result_images.cpp");
    const std::regex kind(R"re((?:keep\(|"kind", |entry_of\(row, )"(\w+)")re");
    Names named, told;
    for (std::sregex_iterator at(source.begin(), source.end(), kind), end; at != end; ++at) named.insert((*at)[1]);
    for (const DescribedLayer& one : result_image_kinds()) told.insert(one.name);
    EXPECT_EQ(told, named);
}
