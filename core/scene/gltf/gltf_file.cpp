#include "core/scene/gltf/gltf_file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/scene/gltf/gltf_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

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

/// Whose parts tinygltf 2.7 does not compare: it would read behind the end of a buffer.
void check_buffer_views(const json& root, const std::string& name) {
    static const json none = json::array();
    const auto list = [&](const char* key) -> const json& { return root.contains(key) ? root[key] : none; };
    const json &buffers = list("buffers"), &views = list("bufferViews");
    for (size_t i = 0; i < views.size(); ++i) {
        const std::string where = name + ": bufferViews[" + std::to_string(i) + "]";
        const auto buffer = views[i]["buffer"].get<size_t>();
        if (buffer >= buffers.size()) fail(where, " names buffer ", buffer, ", but there are ", buffers.size());
        const auto length = buffers[buffer]["byteLength"].get<uint64_t>(),
                   begin = views[i].value("byteOffset", uint64_t(0)), size = views[i]["byteLength"].get<uint64_t>();
        if (begin > length || size > length - begin || size > INT32_MAX)
            fail(where, ": bytes ", begin, " to ", begin + size, " pass the end of its buffer of ", length, " bytes");
    }
}

size_t count_objects(const json& value) {
    size_t count = value.is_object();
    if (value.is_structured())
        for (const json& part : value) count += count_objects(part);
    return count;
}

void check_extensions(const json& root, GltfFile& file) {
    const auto names = [&](const char* key) { return root.value(key, std::set<std::string>()); };
    for (const std::string& extension : names("extensionsRequired"))
        if (!supported_extensions.contains(extension) && !opaque_extensions.contains(extension))
            fail(file.name(), " requires the glTF extension ", extension, ", which ssrlab does not support");
    for (const std::string& extension : names("extensionsUsed"))
        if (!supported_extensions.contains(extension) && !opaque_extensions.contains(extension))
            file.warn("The glTF extension " + extension + " is ignored.");
}

bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

/// What tinygltf asks of the file system. It looks beside the glTF, and then in the working folder, where a file of the
/// same name is not the one that the glTF means.
struct Neighbours {
    GltfFile& file;
    std::string folder;

    /// The neighbour of that name; none if the path is not in the folder.
    std::optional<std::filesystem::path> at(const std::string& path) const {
        if (!path.starts_with(folder + "/")) return {};
        return file_below(folder, path.substr(folder.size() + 1), file.name());
    }
    static bool exists(const std::string& path, void* self) {
        const auto neighbour = static_cast<Neighbours*>(self)->at(path);
        std::error_code error;
        return neighbour && std::filesystem::exists(*neighbour, error);
    }
    static bool read(std::vector<unsigned char>* bytes, std::string*, const std::string& path, void* self) {
        const Neighbours& neighbours = *static_cast<Neighbours*>(self);
        const std::string text = read_text(*neighbours.at(path));
        neighbours.file.memory.add(copies * double(text.size()), path + ": " + std::to_string(text.size()) + " bytes");
        bytes->assign(text.begin(), text.end());
        return true;
    }
    static constexpr double copies = 2;  ///< of what is read: as text, and as the bytes of a buffer or an image
};

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
    check_gltf_schema(root, file.name());
    check_buffer_views(root, file.name());
    check_extensions(root, file);

    // As text, in both documents, as a buffer and as an image; and each object as the largest of tinygltf's structures.
    constexpr double copies = 5;
    file.memory.add(copies * double(bytes.size()) + double(count_objects(root)) * sizeof(tinygltf::Material),
                    file.name() + ": what it describes");
    Neighbours neighbours{file, path.parent_path().empty() ? "." : path.parent_path().string()};
    const std::string& folder = neighbours.folder;
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_encoded, nullptr);
    loader.SetFsCallbacks({Neighbours::exists, [](const std::string& name, void*) { return name; }, Neighbours::read,
                           tinygltf::WriteWholeFile, &neighbours});
    std::string error, warning;
    bool is_loaded = false;
    try {
        const auto size = static_cast<unsigned>(bytes.size());
        is_loaded =
            is_binary ? loader.LoadBinaryFromMemory(&file.model, &error, &warning,
                                                    reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                      : loader.LoadASCIIFromString(&file.model, &error, &warning, bytes.data(), size, folder);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
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
