#pragma once
#include "core/exr/exr.h"
#include "core/json.h"
#include "core/shared/camera.h"

/// The folder that SSRLAB_VECTORS names, or the copy in the repository; its index.json lists what it holds.
std::filesystem::path golden_folder();

/// Files of the index whose names begin with `prefix`, in its order: golden_files("amd/S1_640x384/").
std::vector<std::string> golden_files(const std::string& prefix);

/// Folders with a meta.json that lie under `prefix` and hold files of the index, each once: golden_sets("amd/").
std::vector<std::string> golden_sets(const std::string& prefix);

bool is_golden(const std::string& file);

/// True if SSRLAB_VECTORS names the folder: then it must hold all kinds of files. The copy in the repository has no
/// random numbers, which carry no licence, and nothing that was made with them.
bool has_all_golden_kinds();

/// Those of `names` of which the folder has PREFIX + name + ".exr"; fails with Error if it has none, so that a loop
/// over them compares something.
std::vector<std::string> golden_names(const std::string& prefix, const std::vector<std::string>& names);

/// Reads a file of the index. Fails with Error if its size in bytes, its extent or its channels differ from the index.
LayeredImage read_golden(const std::string& file);

/// The layer of that name; fails with Error if there is none.
const HostImage& golden_layer(const LayeredImage& image, const std::string& name);

nlohmann::json golden_meta(const std::string& set);

/// The camera block of a recorded camera. The recorded clip space has y up, ours has y down; the recorded view may look
/// along z, ours looks along -z. `index`: number of frames rendered before.
CameraData golden_camera(const nlohmann::json& meta, const nlohmann::json& camera, unsigned index);

/// A set's name with all but letters and digits replaced, as GoogleTest wants its parameters named.
std::string golden_test_name(const std::string& set);
