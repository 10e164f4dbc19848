#include "tests/scene/gltf_writer.h"

#include <fstream>

std::string base64(const std::string& bytes) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::filesystem::path GltfWriter::write_glb(const std::filesystem::path& file) {
    const bool has_bytes = !bytes.empty();  // an empty chunk should be omitted (glTF 2.0, section 4.4.3.3)
    if (has_bytes) json["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4);
    std::ofstream out(file, std::ios::binary);
    const auto word = [&](size_t value) {
        const auto number = uint32_t(value);
        out.write(reinterpret_cast<const char*>(&number), 4);
    };
    word(0x46546c67), word(2), word(12 + 8 + text.size() + (has_bytes ? 8 + bytes.size() : 0));
    word(text.size()), word(0x4e4f534a);
    out << text;
    if (has_bytes) word(bytes.size()), word(0x004e4942);
    out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    return file;
}

std::filesystem::path GltfWriter::write_gltf(const std::filesystem::path& file) {
    const auto buffer = std::filesystem::path(file).replace_extension(".bin");
    json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", buffer.filename().string()}}};
    std::ofstream(buffer, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    std::ofstream(file) << json.dump(1);
    return file;
}
