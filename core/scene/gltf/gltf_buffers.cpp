#include "core/scene/gltf/gltf_buffers.h"

#include "core/error.h"
#include "core/scene/gltf/gltf_uri.h"

namespace {
using nlohmann::json;
}

BufferReader::BufferReader(json& root, std::optional<std::span<const uint8_t>> binary, GltfFile& file)
    : root_(root),
      buffers_(root.contains("buffers") ? root["buffers"] : none_),
      binary_(binary),
      file_(file),
      is_read_(buffers_.size(), false) {
    file.buffers.resize(buffers_.size());
}

void BufferReader::read_what_views_show() {
    if (!root_.contains("bufferViews")) return;
    const json& views = root_["bufferViews"];
    for (size_t i = 0; i < views.size(); ++i)
        check_view(views[i], file_.name() + ": bufferViews[" + std::to_string(i) + "]");
    for (const json& view : views) read(view["buffer"].get<size_t>());
}

void BufferReader::check_view(const json& view, const std::string& where) const {
    const auto buffer = view["buffer"].get<size_t>();
    if (buffer >= buffers_.size()) fail(where, " names buffer ", buffer, ", but there are ", buffers_.size());
    const auto length = buffers_[buffer]["byteLength"].get<uint64_t>(), begin = view.value("byteOffset", uint64_t(0)),
               size = view["byteLength"].get<uint64_t>();
    if (begin > length || size > length - begin)
        fail(where, ": ", size, " bytes from byte ", begin, " on pass the end of its buffer of ", length, " bytes");
}

bool BufferReader::has_data(size_t index) const {
    return index < buffers_.size() && (is_read_[index] || buffers_[index].contains("uri") || (index == 0 && binary_));
}

void BufferReader::read(size_t index) {
    if (is_read_[index]) return;
    const std::string what = file_.name() + ": buffers[" + std::to_string(index) + "]";
    file_.buffers[index] = bytes_of(buffers_[index], index, what);
    is_read_[index] = true;
    const auto length = buffers_[index]["byteLength"].get<uint64_t>();
    if (file_.buffers[index].size() < length)
        fail(what, " has ", file_.buffers[index].size(), " bytes, fewer than its byteLength of ", length,
             ": the file is cut, or not the file that the glTF names");
}

std::span<const uint8_t> BufferReader::bytes_of(json& buffer, size_t index, const std::string& what) {
    if (!buffer.contains("uri")) {
        if (index == 0 && binary_) return *binary_;
        fail(what, " has no 'uri', and the file no binary chunk that would be this buffer");
    }
    const std::string uri = std::move(buffer["uri"].get_ref<std::string&>());
    buffer.erase("uri");
    const std::string title = what + " ('" + shown_uri(uri) + "')";
    std::string bytes = read_uri(file_.folder(), uri, title);
    file_.memory.add(double(bytes.size()), title + ": " + std::to_string(bytes.size()) + " bytes");
    return file_.keep(std::move(bytes));
}
