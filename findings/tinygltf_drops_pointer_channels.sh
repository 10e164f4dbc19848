#!/usr/bin/env bash
# tinygltf leaves out every animation channel whose target has no node. It returns true without a warning; only the error text,
# which callers read of files that are refused, has "'node' property is missing."
# Such channels are valid: glTF 2.0, 3.11 (node is optional; extensions may give the target). KHR_animation_pointer forbids the node,
# so that all of its channels are lost, and a program that looks for the extension in the model finds nothing to report.
# For whom: who reads animated materials, lights or visibility with tinygltf, or says what of a file is not animated.
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

/// Of a file with one animation of a channel that moves a node, and of one with the given target.
size_t channels_read(const std::string& target, bool& is_loaded, std::string& warning, std::string& error) {
    const std::string text =
        R"({"asset": {"version": "2.0"}, "nodes": [{}], "materials": [{}], "extensionsUsed": ["KHR_animation_pointer"],
            "buffers": [{"byteLength": 24, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAA"}],
            "bufferViews": [{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteLength": 24}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 2, "min": [0], "max": [1]},
                          {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 2}],
            "animations": [{"samplers": [{"input": 0, "output": 1}],
                            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                                         {"sampler": 0, "target": )" + target + "}]}]}";
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    is_loaded = loader.LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), "");
    return model.animations.empty() ? 0 : model.animations[0].channels.size();
}
int main() {
    const std::string pointer = R"("path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/materials/0/emissiveFactor"}}})";
    struct { const char* what; std::string target; size_t channels; bool has_error; } cases[] = {
        {"two channels with a node", R"({"node": 0, "path": "scale"})", 2, false},
        {"one without, of KHR_animation_pointer", "{" + pointer, 1, true},
        {"the same with a node, which is not valid", R"({"node": 0, )" + pointer, 2, false}};
    bool same = true;
    for (const auto& c : cases) {
        bool is_loaded;
        std::string warning, error;
        const size_t found = channels_read(c.target, is_loaded, warning, error);
        std::printf("%-42s %s, channels: %zu, warning: '%s', error: '%s'\n", c.what, is_loaded ? "loaded" : "refused", found,
                    warning.c_str(), error.substr(0, error.find('\n')).c_str());
        same = same && is_loaded && found == c.channels && warning.empty() && error.empty() != c.has_error;
    }
    std::puts(same ? "as described" : "BEHAVIOUR CHANGED");
    return same ? 0 : 1;
}
CPP
g++ -std=c++17 -O0 -w -I"$tmp/root/usr/include" "$tmp/read.cpp" -o "$tmp/read"
"$tmp/read"
