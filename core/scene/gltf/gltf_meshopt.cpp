#include "core/scene/gltf/gltf_meshopt.h"

#include "core/error.h"

#include <meshoptimizer.h>
#include <tbb/parallel_for.h>
#include <algorithm>

namespace {
using nlohmann::json;

const char* const meshopt_extensions[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

struct Layout {
    size_t count, stride;
    std::string mode, filter;
};

/// What the extension says, checked by its rules: meshoptimizer's functions take them on trust.
Layout checked_layout(const json& compression, const json& uncompressed, const std::string& what) {
    const Layout layout{compression["count"].get<size_t>(), compression["byteStride"].get<size_t>(),
                        compression["mode"].get<std::string>(), compression.value("filter", "NONE")};
    const auto need = [&](bool is_met, const std::string& rule) {
        if (!is_met)
            fail(what, ": ", rule, ", but has a byteStride of ", layout.stride, " and a count of ", layout.count);
    };
    if (layout.mode == "ATTRIBUTES") {
        need(layout.stride % 4 == 0 && layout.stride >= 4 && layout.stride <= 256,
             "the mode ATTRIBUTES needs a stride that is a multiple of 4 up to 256");
    } else {
        need(layout.stride == 2 || layout.stride == 4, "the mode " + layout.mode + " needs a stride of 2 or 4");
        need(layout.mode != "TRIANGLES" || layout.count % 3 == 0,
             "the mode TRIANGLES needs three indices per triangle");
        if (layout.filter != "NONE") fail(what, ": the mode ", layout.mode, " takes no filter");
    }
    if (layout.filter == "OCTAHEDRAL")
        need(layout.stride == 4 || layout.stride == 8, "the filter OCTAHEDRAL needs a stride of 4 or 8");
    if (layout.filter == "QUATERNION") need(layout.stride == 8, "the filter QUATERNION needs a stride of 8");
    const auto length = uncompressed["byteLength"].get<size_t>();
    if (layout.count > SIZE_MAX / 256 || length != layout.count * layout.stride)
        fail(what, ": ", layout.count, " elements of ", layout.stride, " bytes do not fill its byteLength of ", length);
    return layout;
}

/// False if the bytes are damaged, or of a version that the library does not know.
bool decode_into(std::string& bytes, const Layout& layout, std::span<const uint8_t> compressed) {
    const auto [count, stride, mode, filter] = layout;
    const uint8_t* from = compressed.data();
    const size_t size = compressed.size();
    const int result = mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, size)
                       : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, size)
                                             : meshopt_decodeIndexSequence(bytes.data(), count, stride, from, size);
    if (result != 0) return false;
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
    return filter != "COLOR";  // of KHR_meshopt_compression; meshoptimizer 0.18 has none
}

/// Whether the file says that the buffer has no data for those who read the extension.
bool is_placeholder(const json& buffer) {
    return std::ranges::any_of(meshopt_extensions, [&](const char* extension) {
        const json::json_pointer place(std::string("/extensions/") + extension + "/fallback");
        return buffer.contains(place) && buffer[place] == json(true);
    });
}
}  // namespace

MeshoptViews::MeshoptViews(json& root, const std::string& file) {
    if (!root.contains("bufferViews")) return;
    json& views = root["bufferViews"];
    for (size_t i = 0; i < views.size(); ++i)
        for (const char* extension : meshopt_extensions) {
            const json::json_pointer place(std::string("/extensions/") + extension);
            if (!views[i].contains(place)) continue;
            const json compression = views[i][place];
            views_.push_back(
                {i, views[i], compression, extension, file + ": bufferViews[" + std::to_string(i) + "]." + extension});
            views[i] = {{"buffer", compression["buffer"]}, {"byteLength", compression["byteLength"]}};
            if (compression.contains("byteOffset")) views[i]["byteOffset"] = compression["byteOffset"];
            break;
        }
}

void MeshoptViews::decode(json& root, BufferReader& buffers, GltfFile& file) const {
    struct Result {
        std::string bytes;
        bool is_whole = false;
    };
    std::vector<Result> results(views_.size());
    tbb::parallel_for(size_t(0), views_.size(), [&](size_t i) {
        const auto& [index, uncompressed, compression, extension, what] = views_[i];
        const Layout layout = checked_layout(compression, uncompressed, what);
        const size_t size = layout.count * layout.stride;
        file.memory.add(double(size), what + " of " + std::to_string(size) + " bytes");
        results[i].bytes.resize(size);
        const size_t begin = compression.value("byteOffset", size_t(0)),
                     length = compression["byteLength"].get<size_t>();
        results[i].is_whole = decode_into(results[i].bytes, layout,
                                          file.buffers[compression["buffer"].get<size_t>()].subspan(begin, length));
    });
    for (size_t i = 0; i < views_.size(); ++i) {
        const auto& [index, uncompressed, compression, extension, what] = views_[i];
        json& view = root["bufferViews"][index];
        view = uncompressed;
        view.erase("extensions");
        if (results[i].is_whole) {
            view["buffer"] = file.buffers.size(), view["byteOffset"] = 0;
            file.add_buffer(std::move(results[i].bytes));
            continue;
        }
        const auto buffer = uncompressed["buffer"].get<size_t>();
        if (!buffers.has_data(buffer) || is_placeholder(root["buffers"][buffer]))
            fail(what,
                 " cannot be decoded: it is damaged, or of a version that ssrlab does not read; `gltfpack -i IN.glb -o "
                 "OUT.glb -noq` writes a file that does without it");
        buffers.read(buffer),
            buffers.check_view(uncompressed, file.name() + ": bufferViews[" + std::to_string(index) + "]");
        file.warn("The " + extension + " of buffer view " + std::to_string(index) +
                  " cannot be decoded; the file's fallback is shown.");
    }
}
