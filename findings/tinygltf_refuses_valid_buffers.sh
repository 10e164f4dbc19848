#!/usr/bin/env bash
# tinygltf knows data URIs by six exact spellings. One with a parameter (;charset=utf-8), or whose scheme is written DATA:, is taken
# for the name of a file: a buffer is refused with all of its base64 in the message, and an image is left empty with a
# warning, while the file counts as loaded. A buffer's file that is longer than byteLength is refused, too.
# All three are valid: RFC 2397 (parameters), RFC 3986, 3.1 (schemes in either case), glTF 2.0, 3.6.1.1 (a buffer has at
# least byteLength bytes).
# For whom: who reads glTF of other programs and takes a false return for a broken file, or a true one for a whole scene.
# Version: libtinygltf-dev 2.7.0+dfsg-2 (Debian 12).
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
apt-get update -qq
(cd "$tmp" && apt-get -o APT::Sandbox::User=root download -qq libtinygltf-dev=2.7.0+dfsg-2 nlohmann-json3-dev=3.11.2-2 >/dev/null)
for package in "$tmp"/*.deb; do dpkg -x "$package" "$tmp/root"; done

cat >"$tmp/read.cpp" <<'CPP'
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>
#include <cstdio>
#include <fstream>

bool images_are_decoded = false;
bool note_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
    return images_are_decoded = true;
}
struct Answer {
    bool is_loaded, is_decoded;
    std::string error, warning;
};
/// Of a file of one buffer of 12 bytes and one image.
Answer read(const std::string& folder, const std::string& buffer, const std::string& image) {
    const std::string text = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 12, "uri": ")" + buffer +
                             R"("}], "images": [{"uri": ")" + image + "\"}]}";
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    Answer answer;
    images_are_decoded = false;
    loader.SetImageLoader(note_image, nullptr);
    answer.is_loaded = loader.LoadASCIIFromString(&model, &answer.error, &answer.warning, text.data(), unsigned(text.size()), folder);
    answer.is_decoded = images_are_decoded;
    return answer;
}
int main(int, char** arguments) {
    const std::string folder = arguments[1], bytes = "base64,AAAAAAAAAAAAAAAA", picture = "data:image/png;" + bytes;
    std::ofstream(folder + "/exact.bin") << std::string(12, 'x');
    std::ofstream(folder + "/longer.bin") << std::string(16, 'x');
    struct { const char* what; std::string buffer, image; bool loads, decodes; } cases[] = {
        {"the spellings that it knows", "data:application/octet-stream;" + bytes, picture, true, true},
        {"a buffer with a parameter", "data:application/octet-stream;charset=utf-8;" + bytes, picture, false, false},
        {"a buffer of DATA:", "DATA:application/octet-stream;" + bytes, picture, false, false},
        {"an image with a parameter", "data:application/octet-stream;" + bytes, "data:image/png;charset=utf-8;" + bytes, true, false},
        {"an image of DATA:", "data:application/octet-stream;" + bytes, "DATA:image/png;" + bytes, true, false},
        {"a buffer's file of 12 bytes", "exact.bin", picture, true, true},
        {"a buffer's file of 16 bytes", "longer.bin", picture, false, false}};
    bool same = true;
    for (const auto& c : cases) {
        const Answer answer = read(folder, c.buffer, c.image);
        std::string said = answer.error.empty() ? answer.warning : answer.error;
        said = said.substr(0, said.find('\n')).substr(0, 60);
        std::printf("%-28s %-8s image %-8s %s\n", c.what, answer.is_loaded ? "loaded," : "refused,", answer.is_decoded ? "decoded" : "empty", said.c_str());
        same = same && answer.is_loaded == c.loads && answer.is_decoded == c.decodes;
    }
    std::puts(same ? "as described" : "BEHAVIOUR CHANGED");
    return same ? 0 : 1;
}
CPP
g++ -std=c++17 -O0 -w -I"$tmp/root/usr/include" "$tmp/read.cpp" -o "$tmp/read"
"$tmp/read" "$tmp"
