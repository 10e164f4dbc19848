#include "core/scene/gltf/gltf_chunks.h"

#include "core/error.h"

namespace {

uint32_t little_endian(std::string_view bytes, size_t at) {
    const auto byte = [&](size_t i) { return uint32_t(uint8_t(bytes[at + i])); };
    return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

/// A chunk's type as messages show it: its four letters.
std::string letters(uint32_t type) {
    std::string text;
    for (int i = 0; i < 4; ++i) {
        const char letter = char(type >> (8 * i));
        text += letter >= ' ' && letter <= '~' ? letter : letter == 0 ? ' ' : '?';
    }
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

GltfChunks split_glb(std::string_view bytes, const std::string& file) {
    constexpr uint32_t json_type = 0x4E4F534A, binary_type = 0x004E4942;
    constexpr size_t header_size = 12, chunk_header_size = 8;
    if (bytes.size() < header_size + chunk_header_size)
        fail(file, ": truncated .glb: ", bytes.size(), " bytes are less than its header");
    if (const uint32_t version = little_endian(bytes, 4); version != 2)
        fail(file, ": .glb version ", version, " is not supported, only 2",
             version == 1 ? "; `gltf-pipeline -i OLD.glb -o NEW.glb` makes glTF 2.0 of glTF 1.0" : "");
    const size_t length = little_endian(bytes, 8);
    if (length > bytes.size())
        fail(file, ": truncated .glb: its header says ", length, " bytes, the file has ", bytes.size());
    GltfChunks chunks;
    for (size_t at = header_size; at + chunk_header_size <= length;) {
        const size_t size = little_endian(bytes, at);
        const uint32_t type = little_endian(bytes, at + 4);
        at += chunk_header_size;
        if (size > length - at)
            fail(file, ": truncated .glb: the chunk '", letters(type), "' of ", size,
                 " bytes passes the end of the file");
        if ((type == json_type && chunks.json.data()) || (type == binary_type && chunks.binary))
            fail(file, ": the .glb has two chunks '", letters(type), "', but glTF 2.0, section 4.4.3, allows one");
        if (type == json_type) chunks.json = bytes.substr(at, size);
        if (type == binary_type) chunks.binary = {reinterpret_cast<const uint8_t*>(bytes.data()) + at, size};
        at += size;
    }
    if (!chunks.json.data()) fail(file, ": the .glb has no chunk 'JSON'");
    while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1);  // some exporters pad with zeros, not with blanks
    return chunks;
}

}  // namespace

GltfChunks split_chunks(std::string_view bytes, const std::string& file) {
    if (bytes.starts_with("glTF")) return split_glb(bytes, file);
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
        fail(file, " is UTF-16; glTF 2.0, section 2.7, has its JSON in UTF-8: `iconv -f UTF-16 -t UTF-8` converts it");
    const std::string_view mark = bytes.starts_with("\xEF\xBB\xBF") ? "\xEF\xBB\xBF" : "";
    const size_t first = bytes.find_first_not_of(" \t\r\n", mark.size());
    if (first == std::string_view::npos) fail(file, " is empty");
    if (bytes[first] != '{') fail(file, " is neither a .glb nor a .gltf: it begins neither with 'glTF' nor with '{'");
    return {.json = bytes, .binary = {}};
}
