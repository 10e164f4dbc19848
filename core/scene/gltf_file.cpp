#include "core/scene/gltf_file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>

namespace {
using nlohmann::json;

const std::set<std::string> supported_extensions = {"KHR_lights_punctual",    "KHR_materials_emissive_strength",
                                                    "KHR_materials_specular", "KHR_materials_unlit",
                                                    "KHR_mesh_quantization",  "KHR_texture_transform"};
// Drawn as if the extension were absent; the part that carries it says so in a warning of its own.
const std::set<std::string> opaque_extensions = {"KHR_materials_transmission"};

uint32_t little_endian(const std::string& bytes, size_t at) {
    const auto byte = [&](size_t i) { return uint32_t(uint8_t(bytes[at + i])); };
    return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

/// The JSON chunk of a .glb (glTF 2.0, section 4.4) after checking that both chunks lie within the file.
std::string glb_json(const std::string& bytes, const std::string& name) {
    const uint32_t json_chunk = 0x4E4F534A;
    if (bytes.size() < 20) fail(name, ": truncated .glb: ", bytes.size(), " bytes are less than its header");
    if (little_endian(bytes, 4) != 2)
        fail(name, ": .glb version ", little_endian(bytes, 4), " is not supported, only 2");
    const size_t length = little_endian(bytes, 8), json_length = little_endian(bytes, 12);
    if (length > bytes.size())
        fail(name, ": truncated .glb: its header says ", length, " bytes, the file has ", bytes.size());
    if (little_endian(bytes, 16) != json_chunk) fail(name, ": the first chunk of the .glb is not JSON");
    const size_t json_end = 20 + json_length;
    if (json_end > length)
        fail(name, ": truncated .glb: the JSON chunk of ", json_length, " bytes passes the end of the file");
    if (json_end + 8 <= length && json_end + 8 + little_endian(bytes, json_end) > length)
        fail(name, ": truncated .glb: the binary chunk of ", little_endian(bytes, json_end),
             " bytes passes the end of the file");
    return bytes.substr(20, json_length);
}

/// An unsigned integer member, or `fallback` if absent.
uint64_t unsigned_member(const json& object, const char* key, uint64_t fallback, const std::string& where) {
    const auto found = object.find(key);
    if (found == object.end()) return fallback;
    if (!found->is_number_unsigned())
        fail(where, ": '", key, "' must be a whole number of 0 or more, not ", shown(*found));
    return found->get<uint64_t>();
}

const json& list(const json& root, const char* key, const std::string& name) {
    static const json none = json::array();
    const auto found = root.find(key);
    if (found == root.end()) return none;
    const bool holds_objects =
        found->is_array() && std::ranges::all_of(*found, [](const json& o) { return o.is_object(); });
    if (!holds_objects) fail(name, ": '", key, "' must be an array of objects");
    return *found;
}

void check_buffer_views(const json& root, const std::string& name) {
    const json& buffers = list(root, "buffers", name);
    const json& views = list(root, "bufferViews", name);
    for (size_t i = 0; i < views.size(); ++i) {
        const std::string where = name + ": bufferViews[" + std::to_string(i) + "]";
        const uint64_t buffer = unsigned_member(views[i], "buffer", buffers.size(), where);
        if (buffer >= buffers.size()) fail(where, " names buffer ", buffer, ", but there are ", buffers.size());
        const uint64_t length =
            unsigned_member(buffers[buffer], "byteLength", 0, name + ": buffers[" + std::to_string(buffer) + "]");
        const uint64_t begin = unsigned_member(views[i], "byteOffset", 0, where);
        const uint64_t size = unsigned_member(views[i], "byteLength", 0, where);
        if (begin > length || size > length - begin || size > INT32_MAX)
            fail(where, ": bytes ", begin, " to ", begin + size, " pass the end of its buffer of ", length, " bytes");
    }
    for (const json& image : list(root, "images", name)) unsigned_member(image, "bufferView", 0, name + ": images");
}

void check_extensions(const json& root, GltfFile& file) {
    const auto names = [&](const char* key) {
        std::set<std::string> found;
        if (root.contains(key) && root[key].is_array())
            for (const json& extension : root[key])
                if (extension.is_string()) found.insert(extension.get<std::string>());
        return found;
    };
    for (const std::string& extension : names("extensionsRequired"))
        if (!supported_extensions.contains(extension) && !opaque_extensions.contains(extension))
            fail(file.name(), " requires the glTF extension ", extension, ", which ssrlab does not support");
    for (const std::string& extension : names("extensionsUsed"))
        if (!supported_extensions.contains(extension) && !opaque_extensions.contains(extension))
            file.warnings.insert("The glTF extension " + extension + " is ignored.");
}

bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

/// tinygltf also looks in the working folder, where a file of the same name is not the one that the glTF means.
bool exists_beside_gltf(const std::string& path, void* folder) {
    return path.starts_with(*static_cast<const std::string*>(folder)) && tinygltf::FileExists(path, nullptr);
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    std::ranges::replace(text, '\n', ';');
    return text;
}
}  // namespace

GltfFile read_gltf(const std::filesystem::path& path) {
    GltfFile file;
    file.path = path;
    const std::string bytes = read_text(path);
    const bool is_binary = bytes.starts_with("glTF");
    if (!is_binary && path.extension() == ".glb") fail(path.string(), " is not a .glb: it does not begin with 'glTF'");
    // tinygltf parses it again, recursing into what it is given.
    const json root = parse_json(is_binary ? glb_json(bytes, file.name()) : bytes, file.name());
    if (!root.is_object()) fail(file.name(), ": a glTF must be a JSON object");
    check_buffer_views(root, file.name());
    check_extensions(root, file);

    std::string folder = path.parent_path().empty() ? "." : path.parent_path().string();
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_encoded, nullptr);
    loader.SetFsCallbacks(
        {exists_beside_gltf, tinygltf::ExpandFilePath, tinygltf::ReadWholeFile, tinygltf::WriteWholeFile, &folder});
    std::string error, warning;
    bool is_loaded = false;
    try {
        const auto size = static_cast<unsigned>(bytes.size());
        is_loaded =
            is_binary ? loader.LoadBinaryFromMemory(&file.model, &error, &warning,
                                                    reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                      : loader.LoadASCIIFromString(&file.model, &error, &warning, bytes.data(), size, folder);
    } catch (const std::exception& e) {
        fail(file.name(), ": malformed glTF: ", e.what());
    }
    if (!is_loaded) fail(file.name(), ": malformed glTF: ", one_line(error));
    for (size_t i = 0; i < file.model.images.size(); ++i)
        if (file.model.images[i].image.empty())
            fail(file.name(), ": cannot read image ", i, " ('", file.model.images[i].uri, "')");
    return file;
}

size_t checked_index(const GltfFile& file, int index, size_t count, const std::string& what) {
    if (index < 0 || size_t(index) >= count)
        fail(file.name(), ": ", what, " ", index, " does not exist; there are ", count);
    return size_t(index);
}
