#include "experiments/bridges/scene_for/glb_file.h"

#include "core/error.h"
#include "core/files.h"

#include <algorithm>
#include <limits>
#include <string>

namespace {

constexpr unsigned component_float = 5126, component_uint = 5125;                           // glTF 2.0, section 5.1.3
constexpr uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;  // section 4.4

const char* type_of(unsigned components) {
    constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return types[components - 1];
}

void append_word(std::string& text, size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) text += char(value >> shift & 255);  // little endian
}

/// Chunks start at multiples of 4 bytes.
void append_chunk(std::string& text, uint32_t type, std::string_view content, char filling) {
    const size_t filled = (content.size() + 3) / 4 * 4;
    append_word(text, filled), append_word(text, type);
    text += content;
    text.append(filled - content.size(), filling);
}

}  // namespace

size_t GlbFile::add(const char* array, nlohmann::json element) {
    json[array].push_back(std::move(element));
    return json[array].size() - 1;
}

void GlbFile::uses_extension(const char* name) {
    nlohmann::json& used = json["extensionsUsed"];
    if (std::ranges::find(used, name) == used.end()) used.push_back(name);
}

size_t GlbFile::add_bytes(std::span<const std::byte> bytes) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    const size_t offset = buffer_.size();
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

size_t GlbFile::add_floats(std::span<const float> values, unsigned components, bool has_bounds) {
    nlohmann::json accessor = {{"bufferView", add_bytes(std::as_bytes(values))},
                               {"componentType", component_float},
                               {"type", type_of(components)},
                               {"count", values.size() / components}};
    for (unsigned c = 0; has_bounds && c < components; ++c) {
        float least = std::numeric_limits<float>::max(), most = std::numeric_limits<float>::lowest();
        for (size_t i = c; i < values.size(); i += components)
            least = std::min(least, values[i]), most = std::max(most, values[i]);
        accessor["min"].push_back(least), accessor["max"].push_back(most);
    }
    return add("accessors", std::move(accessor));
}

size_t GlbFile::add_indices(std::span<const uint32_t> indices) {
    return add("accessors", {{"bufferView", add_bytes(std::as_bytes(indices))},
                             {"componentType", component_uint},
                             {"type", "SCALAR"},
                             {"count", indices.size()}});
}

void GlbFile::write(const std::filesystem::path& file) {
    if (!buffer_.empty()) json["buffers"] = {{{"byteLength", buffer_.size()}}};
    std::string content;
    append_chunk(content, json_chunk, json.dump(), ' ');
    if (!buffer_.empty())
        append_chunk(content, binary_chunk, {reinterpret_cast<const char*>(buffer_.data()), buffer_.size()}, '\0');
    std::string whole;
    const size_t length = 12 + content.size();
    if (length > std::numeric_limits<uint32_t>::max())
        fail(file.string(), " would have ", length,
             " bytes, more than the 4 GiB that a .glb can have; choose a smaller scene");
    append_word(whole, magic), append_word(whole, 2), append_word(whole, length);
    write_text(file, whole + content);
}
