#include "core/scene/gltf/gltf_file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/scene/gltf/gltf_buffers.h"
#include "core/scene/gltf/gltf_chunks.h"
#include "core/scene/gltf/gltf_draco.h"
#include "core/scene/gltf/gltf_extensions.h"
#include "core/scene/gltf/gltf_meshopt.h"
#include "core/scene/gltf/gltf_schema.h"
#include "core/scene/gltf/gltf_uri.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace {
using nlohmann::json;

/// Takes the list of that name out of the object; empty where there is none.
json take_list(json& object, const char* key) {
    json taken = json::array();
    if (const auto found = object.find(key); found != object.end()) taken = std::move(*found), object.erase(found);
    return taken;
}

size_t count_objects(const json& value) {
    size_t count = value.is_object();
    if (value.is_structured())
        for (const json& part : value) count += count_objects(part);
    return count;
}

/// What depends on another key, which the schema does not say.
void check_types(const json& root, const std::string& file) {
    const auto check = [&](const json& object, const std::string& part, const std::string& where) {
        if (!object.contains(part))
            fail(file, ": ", where, ": lacks the key '", part, "', which the type '", part, "' must have");
    };
    const json cameras = root.value("cameras", json::array());
    for (size_t i = 0; i < cameras.size(); ++i)
        check(cameras[i], cameras[i]["type"].get<std::string>(), "cameras[" + std::to_string(i) + "]");
    const json::json_pointer place("/extensions/KHR_lights_punctual/lights");
    if (!root.contains(place)) return;
    for (size_t i = 0; i < root[place].size(); ++i)
        if (const json& light = root[place][i]; light["type"] == "spot")
            check(light, "spot", "extensions.KHR_lights_punctual.lights[" + std::to_string(i) + "]");
}

/// Parts of the JSON that tinygltf 2.7 would misread or refuse though they are valid, or harmless: it gets the JSON
/// without them, and the model has them afterwards.
struct PartsOfOurs {
    json images;
    std::vector<size_t> strides;            ///< of buffer views; 0: packed. tinygltf wants multiples of 4
    std::vector<std::vector<int>> indices;  ///< per mesh and primitive. tinygltf wants a buffer view behind each

    explicit PartsOfOurs(json& root) : images(take_list(root, "images")) {
        root.erase("buffers");
        if (root.contains("bufferViews"))
            for (json& view : root["bufferViews"]) {
                strides.push_back(view.value("byteStride", size_t(0)));
                view.erase("byteStride");
            }
        if (root.contains("meshes"))
            for (json& mesh : root["meshes"]) {
                indices.emplace_back();
                for (json& primitive : mesh["primitives"]) {
                    indices.back().push_back(primitive.value("indices", -1));
                    primitive.erase("indices");
                }
            }
        // Which glTF 2.0, section 3.11, lets out, and tinygltf does not.
        if (root.contains("animations"))
            for (json& animation : root["animations"])
                for (json& channel : animation["channels"]) channel["target"].emplace("node", -1);
    }

    void put_into(tinygltf::Model& model) const {
        for (size_t i = 0; i < strides.size(); ++i) model.bufferViews[i].byteStride = strides[i];
        for (size_t mesh = 0; mesh < indices.size(); ++mesh)
            for (size_t i = 0; i < indices[mesh].size(); ++i)
                model.meshes[mesh].primitives[i].indices = indices[mesh][i];
        for (const json& source : images) {
            tinygltf::Image& image = model.images.emplace_back();
            image.name = source.value("name", ""), image.uri = source.value("uri", "");
            image.mimeType = source.value("mimeType", ""), image.bufferView = source.value("bufferView", -1);
        }
    }
};

/// As the JSON has them: tinygltf 2.7 drops channels without a node.
void find_animated_properties(const json& root, GltfFile& file) {
    for (const json& animation : root.value("animations", json::array()))
        for (const json& channel : animation["channels"]) {
            static const json::json_pointer place("/target/extensions/KHR_animation_pointer/pointer");
            if (channel.contains(place))
                file.animated_properties.push_back({animation.value("name", ""), channel.at(place).get<std::string>()});
        }
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    std::ranges::replace(text, '\n', ';');
    return text;
}

void parse_model(json& root, GltfFile& file) {
    const PartsOfOurs ours(root);
    const std::string text = root.dump();
    tinygltf::TinyGLTF loader;
    std::string error, warning;
    bool is_loaded = false;
    try {
        is_loaded = loader.LoadASCIIFromString(&file.model, &error, &warning, text.data(), unsigned(text.size()), "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        fail(file.name(), ": malformed glTF: ", e.what());
    }
    if (!is_loaded) fail(file.name(), ": malformed glTF: ", one_line(error));
    ours.put_into(file.model);
}
}  // namespace

std::span<const uint8_t> GltfFile::keep(std::string text) {
    bytes.push_back(std::make_shared<const std::string>(std::move(text)));
    return {reinterpret_cast<const uint8_t*>(bytes.back()->data()), bytes.back()->size()};
}

GltfFile read_gltf(const std::filesystem::path& path) {
    GltfFile file;
    file.path = path;
    file.keep(read_text(path));
    const std::string& bytes = *file.bytes.front();
    file.memory.add(double(bytes.size()), file.name() + ": " + std::to_string(bytes.size()) + " bytes");
    const GltfChunks chunks = split_chunks(bytes, file.name());
    json root = parse_json(chunks.json, file.name());
    if (root.is_object()) make_integers_whole(root);
    check_gltf_schema(root, file.name());
    check_types(root, file.name());
    check_required_extensions(root, file.name());
    warn_of_extensions(root, file);
    find_animated_properties(root, file);

    // As text and in both documents, and each object as the largest of tinygltf's structures.
    constexpr double copies = 3;
    file.memory.add(copies * double(chunks.json.size()) + double(count_objects(root)) * sizeof(tinygltf::Material),
                    file.name() + ": what it describes");
    const MeshoptViews compressed_views(root, file.name());
    BufferReader buffers(root, chunks.binary, file);
    buffers.read_what_views_show();
    compressed_views.decode(root, buffers, file);
    decode_draco(root, file);
    parse_model(root, file);
    return file;
}

std::string image_title(const GltfFile& file, size_t index) {
    const tinygltf::Image& image = file.model.images[index];
    return file.name() + ": image " + std::to_string(index) + " ('" +
           shown_uri(image.uri.empty() ? image.name : image.uri) + "')";
}

void read_image_file(const GltfFile& file, size_t index, ImageFile& image) {
    const tinygltf::Image& source = file.model.images[index];
    const std::string title = image_title(file, index);
    if (source.uri.empty()) {
        if (source.bufferView < 0) fail(title, " has neither a 'uri' nor a 'bufferView'");
        const auto& views = file.model.bufferViews;
        const auto& view = views[checked_index(file, source.bufferView, views.size(),
                                               "image " + std::to_string(index) + ": buffer view")];
        image.bytes = file.buffers[size_t(view.buffer)].subspan(view.byteOffset, view.byteLength);
        return;
    }
    image.owned = read_uri(file.folder(), source.uri, title);
    image.memory.add(double(image.owned.size()), title + ": " + std::to_string(image.owned.size()) + " bytes");
    image.bytes = {reinterpret_cast<const uint8_t*>(image.owned.data()), image.owned.size()};
}

size_t checked_index(const GltfFile& file, int index, size_t count, const std::string& what) {
    if (index < 0 || size_t(index) >= count)
        fail(file.name(), ": ", what, " ", index, " does not exist; there are ", count);
    return size_t(index);
}
