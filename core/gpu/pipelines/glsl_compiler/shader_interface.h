#pragma once
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

enum class ShaderLanguage { vulkan, webgl2 };

/// Stages are linked one by one, each with its own bindings: the vertex stage's begin here.
inline constexpr unsigned first_vertex_binding = 16;

/// The resources of a shader, found by glslang's reflection; names are those of variables and blocks.
struct ShaderInterface {
    enum class Kind { sampler, image, uniforms, storage };
    struct Resource {
        std::string name;
        unsigned binding;
        Kind kind;
        bool is_vertex;         ///< of the vertex stage, whose bindings begin at first_vertex_binding
        std::string type = {};  ///< "sampler2D", "uimage2D"; "" of a block
    };
    std::vector<Resource> resources;
    std::set<std::string> formatted_images;        ///< storage images that declare their format
    std::map<std::string, unsigned> push_offsets;  ///< bytes, of the members of the push_constant block
    std::map<std::string, unsigned> push_sizes;    ///< bytes, of the same
    unsigned push_size = 0;
    std::map<std::string, unsigned> outputs;  ///< location of each fragment output
    std::set<unsigned> constants;             ///< ids of the specialization constants that it uses
    std::array<unsigned, 3> local_size{1, 1, 1};
};
